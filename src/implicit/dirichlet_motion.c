/* Scripted nodes: moved to their targets at once where the way is free, otherwise pulled there by a penalty and put exactly on target at the end
 * (SPEC C.7, R.2; docs/theory/time_step.md). */
#include "implicit/stepper.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* From this progress on the rest of the way is tried in one go. */
static const double finishing_progress = 0.99;

void cipc_number_free_nodes(cipc_stepper *s)
{
    s->free_count = 0;
    for (int i = 0; i < s->model->node_count; i++) {
        s->free_index[i] = s->is_dirichlet[i] ? -1 : s->free_count;
        if (!s->is_dirichlet[i]) s->free_nodes[s->free_count++] = i;
    }
    cipc_assembly_invalidate(s);
}

static bool any_moves(const cipc_stepper *s)
{
    for (int i = 0; i < s->model->node_count; i++)
        if (s->moves[i]) return true;
    return false;
}

/* Contacts between prescribed nodes change nothing while all of these rest, and obstacles (fixed bodies) may interpenetrate; but a moving sheet that is not an
 * obstacle must not be driven into what stands still. Does not depend on the penalty: what is prescribed at the start of the step counts. */
static void find_passive(cipc_stepper *s)
{
    bool moving = any_moves(s);
    for (int i = 0; i < s->model->node_count; i++) {
        bool passive = s->is_dirichlet[i] && (!moving || s->model->bodies[s->model->node_body[i]].fixed);
        if (passive != s->passive[i]) s->cache.slack = 0; /* the candidates leave out pairs of passive nodes */
        s->passive[i] = passive;
    }
}

/* The way from x to the targets of the moving nodes, in s->direction. */
static void way_to_target(cipc_stepper *s)
{
    memset(s->direction, 0, 3 * (size_t)s->model->node_count * sizeof(double));
    for (int i = 0; i < s->model->node_count; i++)
        if (s->moves[i]) v3_sub(s->direction + 3 * i, s->target + 3 * i, s->x + 3 * i);
}

/* Largest part of that way that keeps the strain limit and meets no contact. */
static cipc_status free_part_of_way(cipc_stepper *s, double *alpha, cipc_error *error)
{
    *alpha = cipc_strain_step(s, s->x, s->direction);
    cipc_status status = cipc_cache_cover(s, s->x, s->direction, error);
    if (!status) *alpha = cipc_contact_step(s, *alpha);
    return status;
}

static void put_on_target(cipc_stepper *s)
{
    for (int i = 0; i < s->model->node_count; i++)
        if (s->moves[i]) v3_copy(s->x + 3 * i, s->target + 3 * i);
}

static void set_moving_free(cipc_stepper *s, bool is_free)
{
    for (int i = 0; i < s->model->node_count; i++)
        if (s->moves[i]) s->is_dirichlet[i] = !is_free;
}

/* Only a changed set of Dirichlet nodes needs a new numbering (and with it a new pattern). */
static void renumber_if_changed(cipc_stepper *s)
{
    for (int i = 0; i < s->model->node_count; i++)
        if ((s->free_index[i] < 0) != s->is_dirichlet[i]) {
            cipc_number_free_nodes(s);
            break;
        }
}

cipc_status cipc_dirichlet_begin(cipc_stepper *s, double time, cipc_error *error)
{
    cipc_dirichlet_targets(s->model, s->x, time, s->options.time_step, s->is_dirichlet, s->target, s->moves);
    s->penalty = 0;
    find_passive(s);
    renumber_if_changed(s);
    if (!any_moves(s)) return CIPC_OK;
    double alpha;
    way_to_target(s);
    cipc_status status = free_part_of_way(s, &alpha, error);
    if (status) return status;
    if (alpha == 1) {
        put_on_target(s);
        cipc_cache_recentre(s);
        return cipc_accept(s, -1, false, 0, 0, error);
    }
    s->penalty = 1e6; /* k_D of SPEC C.7 */
    set_moving_free(s, true);
    renumber_if_changed(s);
    return CIPC_OK;
}

double cipc_dirichlet_progress(const cipc_stepper *s)
{
    double left = 0, all = 0;
    if (s->penalty == 0) return 1;
    for (int i = 0; i < s->model->node_count; i++) {
        double d[3];
        if (!s->moves[i]) continue;
        v3_sub(d, s->target + 3 * i, s->x + 3 * i);
        left += v3_norm2(d);
        v3_sub(d, s->target + 3 * i, s->x_start + 3 * i);
        all += v3_norm2(d);
    }
    return all > 0 ? 1 - sqrt(left / all) : 1;
}

cipc_status cipc_dirichlet_finish(cipc_stepper *s, int iteration, bool *done, cipc_error *error)
{
    *done = false;
    if (cipc_dirichlet_progress(s) < finishing_progress) return CIPC_OK;
    double alpha;
    way_to_target(s);
    cipc_status status = free_part_of_way(s, &alpha, error);
    /* All of the way or nothing: a part of it, taken again and again, would shrink the gap in it tenfold each time. */
    if (status || alpha < 1) return status;
    put_on_target(s);
    s->penalty = 0;
    set_moving_free(s, false);
    renumber_if_changed(s);
    *done = true;
    status = cipc_cache_cover(s, s->x, NULL, error);
    if (!status) status = cipc_contacts_at(s, s->x, &s->contacts, error);
    return status ? status : cipc_accept(s, iteration, false, 0, 0, error);
}
