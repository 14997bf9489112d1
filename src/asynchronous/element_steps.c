/* Stable steps of the forces inside bodies, and their clocks (SPEC A.2, A.5; docs/theory/asynchronous.md (10)). */
#include "asynchronous/integrator.h"

#include <gsl/gsl_eigen.h>
#include <stdlib.h>
#include <string.h>

static cipc_status no_memory(cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for the clocks of forces inside bodies"); }

/* How many elements of the same kind of event share each node's mass. */
static void count_shares(const cipc_asynchronous *a, cipc_event_kind kind, int *shares)
{
    memset(shares, 0, (size_t)a->model->node_count * sizeof *shares);
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++)
        for (int i = 0; a->sets[s].kind == kind && i < a->sets[s].count * a->sets[s].energy->nodes; i++) shares[a->sets[s].nodes[i]]++;
}

/* Largest eigenvalue of M^(-1/2) H M^(-1/2) at rest, M the element's share of its nodes' masses: that of the assembled body is not larger, since the shares add up
 * to the masses (docs/theory/asynchronous.md (10)). */
static double largest_eigenvalue(const cipc_asynchronous *a, const asynchronous_set *set, int element, const int *shares, gsl_eigen_symm_workspace *work)
{
    const int count = set->energy->nodes, n = 3 * count, *nodes = set->nodes + (size_t)element * (size_t)count;
    double rest[12], H[144], eigenvalues[12];
    asynchronous_gather_rest(a->model, nodes, count, rest);
    set->energy->hessian(rest, (const char *)set->params + (size_t)element * set->energy->params_size, H);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) H[n * i + j] *= sqrt(shares[nodes[i / 3]] / a->model->mass[nodes[i / 3]]) * sqrt(shares[nodes[j / 3]] / a->model->mass[nodes[j / 3]]);
    gsl_matrix_view matrix = gsl_matrix_view_array(H, (size_t)n, (size_t)n);
    gsl_vector_view values = gsl_vector_view_array(eigenvalues, (size_t)n);
    gsl_eigen_symm(&matrix.matrix, &values.vector, work);
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, eigenvalues[i]);
    return largest;
}

/* h = gamma 2/omega; with stiffness-proportional damping beta the limit is where h^2 omega^2 + 2 h beta omega^2 = 4 (SPEC A.5, A.8). */
static double stable_step(const cipc_asynchronous *a, const cipc_material *m, double eigenvalue)
{
    const double omega = sqrt(eigenvalue), most = a->options.frame, damping = 0.5 * m->damping_stiffness * omega;
    if (!(omega > 0)) return most;
    return fmin(most, a->options.element_factor * 2 / (omega * (sqrt(1 + damping * damping) + damping)));
}

/* The longest frame / 2^k that is not longer than h. */
static double nested_step(double frame, double h)
{
    double step = frame;
    while (step > h) step /= 2;
    return step;
}

static cipc_status choose_steps(cipc_asynchronous *a, asynchronous_set *set, const int *shares, cipc_error *error)
{
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3 * (size_t)set->energy->nodes);
    if (!work) return no_memory(error);
    for (int i = 0; i < set->count; i++) {
        const cipc_body *body = asynchronous_body_of(a->model, set->nodes + (size_t)i * (size_t)set->energy->nodes);
        const double h = stable_step(a, &body->material, largest_eigenvalue(a, set, i, shares, work));
        if (asynchronous_is_too_short(a, h)) {
            gsl_eigen_symm_free(work);
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, body->name, "%s needs steps of %.3g s, more than %d in a frame: softer or heavier elements are needed", set->energy->name, h, ASYNCHRONOUS_MOST_TICKS);
        }
        set->step[i] = a->options.clocks == CIPC_CLOCKS_NESTED ? nested_step(a->options.frame, h) : h;
    }
    gsl_eigen_symm_free(work);
    return CIPC_OK;
}

/* ---- Clocks ----------------------------------------------------------------------------------------------------------------------------- */

typedef struct numbered_step { double step; int element; } numbered_step;

static int compare_steps(const void *p, const void *q)
{
    const numbered_step *s = p, *t = q;
    if (s->step != t->step) return s->step < t->step ? 1 : -1;
    return (s->element > t->element) - (s->element < t->element);
}

/* The elements of a set from place `first` on, slowest first; elements with the same step get one clock. */
static bool make_clocks(cipc_asynchronous *a, int set_number, int first)
{
    const asynchronous_set *set = &a->sets[set_number];
    numbered_step *steps = cipc_alloc((size_t)set->count, sizeof *steps);
    if (!steps) return false;
    for (int i = 0; i < set->count; i++) steps[i] = (numbered_step){set->step[i], i};
    qsort(steps, (size_t)set->count, sizeof *steps, compare_steps);
    for (int i = 0; i < set->count; i++) {
        a->elements[first + i] = steps[i].element;
        if (i == 0 || steps[i].step != steps[i - 1].step) {
            const int number = a->clock_count++;
            const uint32_t rank = ASYNCHRONOUS_RANK_ELEMENTS + (uint32_t)set_number;
            a->clocks[number] = (asynchronous_clock){.h = steps[i].step, .set = set_number, .first = first + i};
            a->clocks[number].event = asynchronous_queue_add(&a->queue, rank, (uint64_t)i, number);
        }
        a->clocks[a->clock_count - 1].count++;
    }
    cipc_free(steps);
    return true;
}

cipc_status asynchronous_clocks_create(cipc_asynchronous *a, cipc_error *error)
{
    int *shares = cipc_alloc((size_t)a->model->node_count, sizeof *shares), total = 0;
    cipc_status status = CIPC_OK;
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) total += a->sets[s].count;
    a->elements = cipc_alloc((size_t)total, sizeof *a->elements);
    a->clocks = cipc_alloc((size_t)total, sizeof *a->clocks);
    if (!shares || !a->elements || !a->clocks) status = no_memory(error);
    for (int s = 0, first = 0; s < ASYNCHRONOUS_SETS && !status; first += a->sets[s++].count) {
        count_shares(a, a->sets[s].kind, shares);
        status = choose_steps(a, &a->sets[s], shares, error);
        if (!status && !make_clocks(a, s, first)) status = no_memory(error);
    }
    for (int c = 0; c < a->clock_count && !status; c++)
        if (a->clocks[c].event < 0) status = no_memory(error);
    cipc_free(shares);
    return status;
}

void asynchronous_elements_start(cipc_asynchronous *a)
{
    for (int c = 0; c < a->clock_count; c++) {
        asynchronous_clock *clock = &a->clocks[c];
        clock->k = asynchronous_first_tick(a->options.mirror, clock->h, a->now);
        asynchronous_queue_schedule(&a->queue, clock->event, asynchronous_tick_time(a->options.mirror, clock->h, clock->k));
    }
}
