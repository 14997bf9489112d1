/* What a step did: energies, and how often vertices changed their velocity. */
#include "asynchronous/integrator.h"

#include <stdlib.h>
#include <string.h>

/* The pair that the step begins with deepest. */
static void find_deepest(cipc_asynchronous *a)
{
    int deepest = -1;
    for (int i = 0; i < a->pairs.live_count; i++) {
        const int number = a->pairs.live[i], layers = a->pairs.pair[number].layers;
        if (layers <= a->report.layers) continue;
        a->report.layers = layers;
        deepest = number;
    }
    if (deepest >= 0) a->report.deepest = asynchronous_pair_place(a, deepest);
}

void asynchronous_report_begin(cipc_asynchronous *a)
{
    a->report = (cipc_asynchronous_report){.min_gap = INFINITY, .smallest_step = INFINITY, .max_contacts = a->pairs.in_contact};
    for (int i = 0; i < 4; i++) a->report.deepest.nodes[i] = -1;
    find_deepest(a);
    memset(a->kicks, 0, (size_t)a->model->node_count * sizeof *a->kicks);
    for (int i = 0; i < a->model->node_count; i++) v3_copy(a->before + 3 * i, a->nodes[i].v); /* what happened in earlier steps is not known of a state that is taken up */
}

static int compare_numbers(const void *p, const void *q)
{
    const double a = *(const double *)p, b = *(const double *)q;
    return (a > b) - (a < b);
}

/* Of the free nodes: the frame by the number of instants at which the velocity changed (as in figure 2 of the paper). Scratch: the targets of the script. */
static void find_vertex_steps(const cipc_asynchronous *a, cipc_asynchronous_report *r)
{
    int count = 0;
    double *steps = a->target;
    for (int i = 0; i < a->model->node_count; i++)
        if (a->nodes[i].inverse_mass > 0) steps[count++] = a->options.frame / (double)(a->kicks[i] > 0 ? a->kicks[i] : 1);
    qsort(steps, (size_t)count, sizeof *steps, compare_numbers);
    for (int q = 0; q < CIPC_QUANTILES; q++) r->vertex_steps[q] = count > 0 ? steps[(int)lround(cipc_quantiles[q] * (count - 1))] : a->options.frame;
}

/* In the middle of the last kick of this step, if there was one: leapfrog's velocity where its energy is nearly constant (SPEC A.2). */
static double kinetic_energy(const cipc_asynchronous *a)
{
    double sum = 0;
    for (int i = 0; i < a->model->node_count; i++) {
        double mean[3];
        if (!(a->nodes[i].inverse_mass > 0)) continue;
        for (int k = 0; k < 3; k++) mean[k] = 0.5 * (a->nodes[i].v[k] + a->before[3 * i + k]);
        sum += 0.5 / a->nodes[i].inverse_mass * v3_norm2(mean);
    }
    return sum;
}

static double gravitational_energy(const cipc_asynchronous *a, const double *x)
{
    double sum = 0;
    for (int i = 0; i < a->model->node_count; i++)
        if (a->nodes[i].inverse_mass > 0) sum -= a->model->mass[i] * v3_dot(a->model->gravity, x + 3 * i);
    return sum;
}

static double contact_energy(const cipc_asynchronous *a)
{
    double sum = 0;
    for (int i = 0; i < a->pairs.live_count; i++) {
        const asynchronous_pair *pair = &a->pairs.pair[a->pairs.live[i]];
        if (pair->layers > 0) sum += cipc_layer_energy(a->options.thickness, a->options.stiffness, asynchronous_pair_place(a, a->pairs.live[i]).gap);
    }
    return sum;
}

void asynchronous_report_end(cipc_asynchronous *a, cipc_asynchronous_report *report)
{
    cipc_asynchronous_report *r = &a->report;
    double *x = a->acceleration; /* free to use between ticks of gravity */
    for (int i = 0; i < a->model->node_count; i++) asynchronous_position(&a->nodes[i], a->now, x + 3 * i);
    r->contacts = a->pairs.in_contact;
    r->certificates = a->pairs.live_count;
    r->separations = a->broad.live_entries;
    r->kinetic = kinetic_energy(a);
    r->gravitational = gravitational_energy(a, x);
    r->elastic = asynchronous_elements_energy(a, x);
    r->contact = contact_energy(a);
    find_vertex_steps(a, r);
    if (!(r->smallest_step < INFINITY)) r->smallest_step = a->options.frame;
    *report = *r;
}
