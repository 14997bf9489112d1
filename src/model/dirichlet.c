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

/* Frames belong to the nodes in their order, so the order must be the one that is kept. */
static cipc_status check_track(const cipc_dirichlet_set *set, cipc_error *error)
{
    const cipc_track *t = &set->track;
    if (t->frame_count == 0) return CIPC_OK;
    if (!isfinite(t->begin) || !(t->interval > 0) || !isfinite(t->interval))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a track begins at %g s with %g s from frame to frame", t->begin, t->interval);
    for (long i = 0; i < 3L * t->frame_count * set->node_count; i++)
        if (!isfinite(t->frames[i])) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a frame of a track has a number that is not finite");
    for (int i = 1; i < set->node_count; i++)
        if (set->nodes[i] <= set->nodes[i - 1]) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "the nodes of a track must ascend");
    return CIPC_OK;
}

static cipc_status check_set(const cipc_model *model, const cipc_dirichlet_set *set, cipc_error *error)
{
    if (set->node_count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "the set has no nodes");
    cipc_status status = check_track(set, error);
    if (status) return status;
    for (int i = 0; i < set->node_count; i++)
        if (set->nodes[i] < 0 || set->nodes[i] >= model->node_count)
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "node %d does not exist; the model has %d", set->nodes[i], model->node_count);
    for (int i = 0; i < set->motion_count; i++) {
        const cipc_motion *m = &set->motions[i];
        double numbers[] = {m->velocity[0], m->velocity[1], m->velocity[2], m->center[0], m->center[1], m->center[2],
                            m->axis[0], m->axis[1], m->axis[2], m->angular_velocity, m->begin};
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
            if (!isfinite(numbers[k])) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a motion has a number that is not finite");
        if (!(m->turn >= 0) || isinf(m->turn)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "dirichlet", "a motion turns every %g s", m->turn);
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
    size_t numbers = 3 * (size_t)set->track.frame_count * (size_t)set->node_count;
    copy.track.frames = numbers ? cipc_alloc(numbers, sizeof(double)) : NULL;
    if (!copy.nodes || !copy.motions || (numbers && !copy.track.frames)) {
        cipc_free(copy.nodes);
        cipc_free(copy.motions);
        cipc_free(copy.track.frames);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "dirichlet", "no memory for a set of %d nodes", set->node_count);
    }
    if (numbers) memcpy(copy.track.frames, set->track.frames, numbers * sizeof(double));
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

/* Where something is that moves to and fro at unit speed and turns every `turn` seconds. */
static double to_and_fro(double turn, double time)
{
    double part = fmod(time, 2 * turn);
    return part < turn ? part : 2 * turn - part;
}

/* Seconds forward less seconds backward of `duration` seconds that begin `elapsed` seconds after the window's begin. Between two turns that is the
 * duration itself, to the last bit. */
static double net_duration(double turn, double elapsed, double duration)
{
    if (!(turn > 0)) return duration;
    double rounding = 1e-9 * duration, first = floor((elapsed + rounding) / turn), last = floor((elapsed + duration - rounding) / turn);
    if (first == last) return fmod(first, 2) == 0 ? duration : -duration;
    return to_and_fro(turn, elapsed + duration) - to_and_fro(turn, elapsed);
}

/* The part of [time, time + h] inside the window drives the node; true if it moved it. */
static bool apply_motion(const cipc_motion *m, double time, double h, double y[3])
{
    /* Relative to the start of the step, so that a window that covers the step drives it for h exactly. */
    double from = fmax(m->begin - time, 0), to = fmin(m->end - time, h), duration = to - from;
    /* A window that starts at the end of the step, up to the rounding of step * h, has not started. */
    if (!(duration > 1e-9 * h)) return false;
    duration = net_duration(m->turn, from + (time - m->begin), duration);
    if (duration == 0) return false;
    if (m->angular_velocity != 0) rotate(y, m->center, m->axis, m->angular_velocity * duration);
    v3_axpy(y, duration, m->velocity);
    return true;
}

/* Where the track has its i-th node at the end of the step; at a frame's time that frame exactly. True if that is not where the node is. */
static bool follow_track(const cipc_dirichlet_set *set, int i, double end, double y[3])
{
    const cipc_track *t = &set->track;
    double place = fmin(fmax((end - t->begin) / t->interval, 0), t->frame_count - 1), nearest = round(place);
    if (fabs(place - nearest) < 1e-9) place = nearest; /* the rounding of step * h */
    int frame = (int)fmin(floor(place), fmax(t->frame_count - 2, 0));
    double part = place - frame, from[3];
    const double *a = t->frames + 3 * ((size_t)frame * (size_t)set->node_count + (size_t)i), *b = part > 0 ? a + 3 * (size_t)set->node_count : a;
    v3_copy(from, y);
    for (int k = 0; k < 3; k++) y[k] = part == 1 ? b[k] : a[k] + part * (b[k] - a[k]);
    return memcmp(from, y, sizeof from) != 0;
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
            bool moved = set->track.frame_count > 0 && follow_track(set, i, time + h, y);
            for (int k = 0; k < set->motion_count; k++) moved |= apply_motion(&set->motions[k], time, h, y);
            is_dirichlet[node] = true;
            if (moves) moves[node] = moved;
        }
    }
}
