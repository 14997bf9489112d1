/* Dirichlet nodes: which nodes are prescribed during a step, and where they are to end (SPEC C.7, R.2). */
#include "cipc/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"

static int compare_ints(const void *a, const void *b)
{
    int p = *(const int *)a, q = *(const int *)b;
    return (p > q) - (p < q);
}

static cipc_status check_set(const cipc_model *model, const cipc_dirichlet_set *set, cipc_error *error)
{
    if (set->node_count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "the set has no nodes");
    for (int i = 0; i < set->node_count; i++)
        if (set->nodes[i] < 0 || set->nodes[i] >= model->node_count)
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "node %d does not exist; the model has %d", set->nodes[i], model->node_count);
    for (int i = 0; i < set->motion_count; i++) {
        const cipc_motion *m = &set->motions[i];
        double numbers[] = {m->velocity[0], m->velocity[1], m->velocity[2], m->center[0], m->center[1], m->center[2],
                            m->axis[0], m->axis[1], m->axis[2], m->angular_velocity, m->begin};
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
            if (!isfinite(numbers[k])) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a motion has a number that is not finite");
        if (!(m->end > m->begin)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a motion ends at %g s, not after its begin %g s", m->end, m->begin);
        if (m->angular_velocity != 0 && !(v3_norm(m->axis) > 0)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a rotation needs an axis");
    }
    return CIPC_OK;
}

cipc_status cipc_model_add_dirichlet(cipc_model *model, const cipc_dirichlet_set *set, cipc_error *error)
{
    cipc_status status = check_set(model, set, error);
    if (status) return status;
    cipc_dirichlet_set *sets = cipc_realloc(model->dirichlet, (size_t)model->dirichlet_count + 1, sizeof *sets);
    if (!sets) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "dirichlet", "no memory for another set");
    model->dirichlet = sets;
    cipc_dirichlet_set copy = *set;
    copy.nodes = cipc_alloc((size_t)set->node_count, sizeof(int));
    copy.motions = cipc_alloc((size_t)set->motion_count, sizeof(cipc_motion));
    if (!copy.nodes || !copy.motions) {
        cipc_free(copy.nodes);
        cipc_free(copy.motions);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "dirichlet", "no memory for a set of %d nodes", set->node_count);
    }
    memcpy(copy.nodes, set->nodes, (size_t)set->node_count * sizeof(int));
    qsort(copy.nodes, (size_t)set->node_count, sizeof(int), compare_ints);
    int unique = 0;
    for (int i = 0; i < set->node_count; i++)
        if (i == 0 || copy.nodes[i] != copy.nodes[unique - 1]) copy.nodes[unique++] = copy.nodes[i];
    copy.node_count = unique;
    for (int i = 0; i < set->motion_count; i++) {
        copy.motions[i] = set->motions[i];
        double length = v3_norm(set->motions[i].axis);
        if (length > 0) v3_scale(copy.motions[i].axis, 1 / length, set->motions[i].axis);
    }
    model->dirichlet[model->dirichlet_count++] = copy;
    return CIPC_OK;
}

/* Rodrigues: rotate y about the axis through c by `angle`. */
static void rotate(double y[3], const double c[3], const double axis[3], double angle)
{
    double r[3], along = 0, across[3];
    v3_sub(r, y, c);
    along = v3_dot(axis, r);
    v3_cross(across, axis, r);
    double cosine = cos(angle), sine = sin(angle);
    for (int k = 0; k < 3; k++) y[k] = c[k] + cosine * r[k] + sine * across[k] + (1 - cosine) * along * axis[k];
}

/* The part of [time, time + h] inside the window drives the node; true if it moved it. */
static bool apply_motion(const cipc_motion *m, double time, double h, double y[3])
{
    /* Relative to the start of the step, so that a window that covers the step drives it for h exactly. */
    double from = fmax(m->begin - time, 0), to = fmin(m->end - time, h), duration = to - from;
    /* A window that starts at the end of the step, up to the rounding of step * h, has not started. */
    if (!(duration > 1e-9 * h)) return false;
    if (m->angular_velocity != 0) rotate(y, m->center, m->axis, m->angular_velocity * duration);
    v3_axpy(y, duration, m->velocity);
    return true;
}

void cipc_dirichlet_targets(const cipc_model *model, const double *position, double time, double h, bool *is_dirichlet, double *target, bool *moves)
{
    memcpy(target, position, 3 * (size_t)model->node_count * sizeof(double));
    memset(is_dirichlet, 0, (size_t)model->node_count * sizeof *is_dirichlet);
    if (moves) memset(moves, 0, (size_t)model->node_count * sizeof *moves);
    for (int s = 0; s < model->dirichlet_count; s++) {
        const cipc_dirichlet_set *set = &model->dirichlet[s];
        if (time >= set->release - 1e-9 * h) continue; /* same rounding allowance as apply_motion */
        for (int i = 0; i < set->node_count; i++) {
            int node = set->nodes[i];
            double *y = target + 3 * node;
            v3_copy(y, position + 3 * node);
            bool moved = false;
            for (int k = 0; k < set->motion_count; k++) moved |= apply_motion(&set->motions[k], time, h, y);
            is_dirichlet[node] = true;
            if (moves) moves[node] = moved;
        }
    }
}
