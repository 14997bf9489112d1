#include "support/scene_frame.h"

#include <math.h>
#include <string.h>

/* ---- Names and places of the numbers ----------------------------------------------------------------------------------------- */

typedef struct quantity {
    const char *name, *unit;
    int first, numbers;
} quantity;

static const quantity quantities[] = {
#define X(name, count, unit) {#name, unit, (int)(offsetof(scene_frame, name) / sizeof(double)), count},
    SCENE_QUANTITIES(X)
#undef X
};

const char *scene_quantity_name(scene_quantity q)
{
    return quantities[q].name;
}

const char *scene_quantity_unit(scene_quantity q)
{
    return quantities[q].unit;
}

int scene_quantity_numbers(scene_quantity q)
{
    return quantities[q].numbers;
}

int scene_quantity_first(scene_quantity q)
{
    return quantities[q].first;
}

scene_quantity scene_quantity_of(int number)
{
    int q = QUANTITY_COUNT - 1;
    while (q > 0 && quantities[q].first > number) {
        q--;
    }
    return (scene_quantity)q;
}

double *scene_frame_numbers(scene_frame *frame)
{
    return (double *)(void *)frame; /* the address of the whole: these are more than its first member's */
}

const double *scene_frame_values(const scene_frame *frame)
{
    return (const double *)(const void *)frame;
}

/* ---- Which nodes ------------------------------------------------------------------------------------------------------------- */

bool scene_node_moves(const cipc_model *model, int node)
{
    return !model->bodies[model->node_body[node]].fixed;
}

static int count_of(const cipc_model *model, const bool *held)
{
    int count = 0;
    for (int i = 0; i < model->node_count; i++) {
        count += scene_node_moves(model, i) && (held == NULL || !held[i]);
    }
    return count;
}

void scene_probes(const cipc_model *model, const bool *held, int probe[SCENE_PROBES])
{
    const bool *out = count_of(model, held) > 0 ? held : NULL;
    const int count = count_of(model, out), wanted[SCENE_PROBES] = {0, count / 2, count - 1};
    int seen = 0;
    for (int i = 0; i < model->node_count; i++) {
        if (scene_node_moves(model, i) && (out == NULL || !out[i])) {
            for (int k = 0; k < SCENE_PROBES; k++) {
                probe[k] = seen == wanted[k] ? i : probe[k];
            }
            seen++;
        }
    }
}

/* ---- A frame ----------------------------------------------------------------------------------------------------------------- */

static void measure_nodes(const scene_step *s, scene_frame *f)
{
    double mass = 0;
    for (int k = 0; k < 3; k++) {
        f->box_low[k] = INFINITY;
        f->box_high[k] = -INFINITY;
    }
    for (int i = 0; i < s->model->node_count; i++) {
        if (scene_node_moves(s->model, i)) {
            mass += s->model->mass[i];
            for (int k = 0; k < 3; k++) {
                const double x = s->x[3 * i + k];
                f->centre_of_mass[k] += s->model->mass[i] * x;
                f->box_low[k] = fmin(f->box_low[k], x);
                f->box_high[k] = fmax(f->box_high[k], x);
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        f->centre_of_mass[k] /= mass;
    }
    memcpy(f->first_node, s->x + 3 * s->probe[0], sizeof f->first_node);
    memcpy(f->middle_node, s->x + 3 * s->probe[1], sizeof f->middle_node);
    memcpy(f->last_node, s->x + 3 * s->probe[2], sizeof f->last_node);
}

static double distance(const double *a, const double *b)
{
    return hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
}

static double largest_segment_stretch(const cipc_model *m, const double *x)
{
    double largest = 0;
    for (int i = 0; i < m->segment_count; i++) {
        const int *v = m->edges[m->first_segment + i];
        if (scene_node_moves(m, v[0])) {
            largest = fmax(largest, distance(x + 3 * v[0], x + 3 * v[1]) / distance(m->rest + 3 * v[0], m->rest + 3 * v[1]));
        }
    }
    return largest;
}

/* What does not depend on the method. */
static void measure(const scene_step *s, scene_frame *f)
{
    f->min_gap[0] = fmin(s->seen->min_gap, s->reach);
    f->largest_stretch[0] = s->seen->max_stretch;
    f->segment_stretch[0] = largest_segment_stretch(s->model, s->x);
    measure_nodes(s, f);
}

scene_frame scene_frame_of(const scene_step *s, const cipc_step_report *r)
{
    const cipc_energy_terms *terms = &r->incremental;
    scene_frame f = {
        .kinetic = {r->kinetic}, .gravitational = {r->gravitational}, .elastic = {r->elastic}, .membrane = {terms->membrane},
        .bending = {terms->bending}, .strain_limit = {terms->strain_limit}, .stretching = {terms->stretching}, .volume = {terms->volume},
        .stitches = {terms->stitches}, .damping = {terms->damping}, .barrier = {terms->barrier}, .friction = {terms->friction},
        .contacts = {r->contacts}, .newton_iterations = {s->before->newton_iterations[0] + r->newton_iterations},
    };
    measure(s, &f);
    return f;
}

scene_frame scene_frame_of_asynchronous(const scene_step *s, const cipc_asynchronous_report *r)
{
    scene_frame f = {
        .kinetic = {r->kinetic}, .gravitational = {r->gravitational}, .elastic = {r->elastic}, .contacts = {(double)s->seen->pairs_checked},
        .contact = {r->contact}, .layers = {r->layers}, .impulses = {s->before->impulses[0] + (double)r->events[CIPC_EVENT_PENALTY]},
    };
    measure(s, &f);
    return f;
}

scene_frame scene_frame_of_massspring(const scene_step *s, const cipc_massspring_report *r)
{
    scene_frame f = {
        .kinetic = {r->kinetic}, .gravitational = {r->gravitational}, .elastic = {r->elastic}, .contacts = {r->contacts}, .deformation = {r->deformation},
    };
    measure(s, &f);
    return f;
}
