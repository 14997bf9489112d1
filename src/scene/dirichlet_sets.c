/* Friction of pairs and Dirichlet sets. */
#include "scene/constraints.h"

#include <math.h>
#include <stddef.h>

#include "scene/selection.h"
#include "scene/transform.h"

enum { SETS_MAX = 100000, MOTIONS_MAX = 1000, PAIRS_MAX = 1000000 };

static void read_between(scene_reader *r, const scene_cursor *pair, const scene_bodies *bodies, int between[2])
{
    scene_cursor member = scene_member(pair, "between");
    between[0] = between[1] = 0;
    if (member.value == NULL) scene_reject(r, &member, CIPC_E_MISSING_KEY, "required, but missing: the names of two bodies");
    if (!scene_is_array(r, &member, 2, 2)) return;
    for (size_t k = 0; k < 2; k++) {
        scene_cursor name = scene_element(&member, k);
        between[k] = scene_find_body(r, &name, bodies);
    }
}

static void read_pair(scene_reader *r, const scene_cursor *pair, const scene_bodies *bodies, cipc_model *model, bool *given)
{
    static const char *const keys[] = {"between", "mu", NULL};
    int between[2];
    if (!scene_is_object(r, pair, keys)) return;
    read_between(r, pair, bodies, between);
    double mu = scene_number(r, pair, "mu", SCENE_REQUIRED_NUMBER, scene_not_negative);
    if (r->status != CIPC_OK) return;
    int low = between[0] < between[1] ? between[0] : between[1], high = between[0] < between[1] ? between[1] : between[0];
    bool *seen = &given[(size_t)low * (size_t)bodies->count + (size_t)high];
    if (*seen) {
        scene_reject(r, pair, CIPC_E_OUT_OF_RANGE, "the pair %s, %s is given twice", bodies->descriptions[low].name,
                     bodies->descriptions[high].name);
        return;
    }
    *seen = true;
    cipc_model_set_friction(model, low, high, mu);
}

void scene_read_friction(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    scene_cursor list = scene_array_member(r, root, "friction");
    if (!scene_is_array(r, &list, 0, PAIRS_MAX)) return;
    bool *given = cipc_alloc((size_t)bodies->count * (size_t)bodies->count, sizeof *given);
    if (given == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    for (size_t i = 0; i < json_array_size(list.value) && r->status == CIPC_OK; i++) {
        scene_cursor pair = scene_element(&list, i);
        read_pair(r, &pair, bodies, model, given);
    }
    cipc_free(given);
}

static void read_motion(scene_reader *r, const scene_cursor *cursor, cipc_motion *motion)
{
    static const char *const keys[] = {"begin", "end", "velocity", "angular_velocity", "axis", "center", NULL};
    static const double zero[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    if (!scene_is_object(r, cursor, keys)) return;
    motion->begin = scene_number(r, cursor, "begin", 0, scene_any);
    motion->end = scene_time_or_never(r, cursor, "end");
    scene_vector(r, cursor, "velocity", zero, motion->velocity);
    motion->angular_velocity = scene_number(r, cursor, "angular_velocity", 0, scene_any);
    scene_read_axis(r, cursor, "axis", up, motion->axis);
    scene_vector(r, cursor, "center", zero, motion->center);
    scene_cursor end = scene_member(cursor, "end");
    if (!(motion->end > motion->begin))
        scene_reject(r, &end, CIPC_E_OUT_OF_RANGE, "is %g, but must be after the begin at %g", motion->end, motion->begin);
}

static void read_motions(scene_reader *r, const scene_cursor *set_cursor, cipc_dirichlet_set *set)
{
    scene_cursor list = scene_array_member(r, set_cursor, "motion");
    if (!scene_is_array(r, &list, 0, MOTIONS_MAX)) return;
    size_t count = json_array_size(list.value);
    set->motions = cipc_alloc(count, sizeof *set->motions);
    if (set->motions == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    set->motion_count = (int)count;
    for (size_t i = 0; i < count; i++) {
        scene_cursor motion = scene_element(&list, i);
        read_motion(r, &motion, &set->motions[i]);
    }
}

/* Selects in the body's own numbering, then counts from the model's first node. */
static void read_nodes(scene_reader *r, const scene_cursor *set_cursor, const scene_bodies *bodies, const cipc_model *model,
                       cipc_dirichlet_set *set)
{
    scene_cursor name = scene_member(set_cursor, "body"), select = scene_member(set_cursor, "select");
    int body = scene_find_body(r, &name, bodies);
    if (select.value == NULL) scene_reject(r, &select, CIPC_E_MISSING_KEY, "required, but missing: one of box, nodes, nearest, all");
    if (r->status != CIPC_OK) return;
    const cipc_body_description *d = &bodies->descriptions[body];
    set->nodes = cipc_alloc((size_t)d->node_count, sizeof *set->nodes);
    if (set->nodes == NULL) {
        scene_reject_memory(r, set_cursor);
        return;
    }
    set->node_count = scene_select_nodes(r, &select, d->position, d->node_count, set->nodes);
    for (int i = 0; i < set->node_count; i++) set->nodes[i] += model->bodies[body].first_node;
}

static void read_set(scene_reader *r, const scene_cursor *cursor, const scene_bodies *bodies, cipc_model *model)
{
    static const char *const keys[] = {"name", "body", "select", "release", "motion", NULL};
    cipc_dirichlet_set set = {0};
    if (!scene_is_object(r, cursor, keys)) return;
    if (json_object_get(cursor->value, "name") != NULL) scene_string(r, cursor, "name", NULL);
    read_nodes(r, cursor, bodies, model, &set);
    set.release = scene_time_or_never(r, cursor, "release");
    read_motions(r, cursor, &set);
    cipc_error error;
    if (r->status == CIPC_OK) {
        cipc_status status = cipc_model_add_dirichlet(model, &set, &error);
        if (status != CIPC_OK) scene_reject(r, cursor, status, "%s", error.what);
    }
    cipc_free(set.nodes);
    cipc_free(set.motions);
}

void scene_read_dirichlet(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    scene_cursor list = scene_array_member(r, root, "dirichlet");
    if (!scene_is_array(r, &list, 0, SETS_MAX)) return;
    for (size_t i = 0; i < json_array_size(list.value) && r->status == CIPC_OK; i++) {
        scene_cursor set = scene_element(&list, i);
        read_set(r, &set, bodies, model);
    }
}
