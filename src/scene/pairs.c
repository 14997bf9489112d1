/* Lists of pairs of bodies, each pair once. */
#include "scene/pairs.h"

#include <string.h>

enum { PAIRS_MAX = 1000000 };

/* Which pairs a list has given so far. */
typedef struct pair_list {
    const scene_bodies *bodies;
    bool *given; /* bodies->count squared, lower index first */
} pair_list;

static bool *given_at(const pair_list *list, int a, int b)
{
    int low = a < b ? a : b, high = a < b ? b : a;
    return &list->given[(size_t)low * (size_t)list->bodies->count + (size_t)high];
}

/* The bodies of one name: one, or all copies. */
typedef struct body_range {
    int first, count;
} body_range;

/* Every pair of bodies of the two ranges, each once, whichever comes first. */
typedef struct pair_walk {
    body_range a, b;
    int i, j; /* the present one; -1, -1 before the first */
} pair_walk;

static bool next_pair(pair_walk *w)
{
    const bool same = w->a.first == w->b.first && w->a.count == w->b.count;
    if (w->i < 0) {
        w->i = w->j = 0;
    } else if (++w->j == w->b.count) {
        w->i++;
        w->j = same ? w->i : 0;
    }
    return w->i < w->a.count;
}

static pair_walk pairs_of(body_range a, body_range b)
{
    return (pair_walk){a, b, -1, -1};
}

/* The bodies of "between"; false if rejected. */
static bool read_between(scene_reader *r, const scene_cursor *pair, const pair_list *list, body_range between[2])
{
    scene_cursor member = scene_member(pair, "between");
    between[0] = between[1] = (body_range){0, 0};
    if (member.value == NULL) scene_reject(r, &member, CIPC_E_MISSING_KEY, "required, but missing: the names of two bodies");
    if (!scene_is_array(r, &member, 2, 2)) return false;
    for (size_t k = 0; k < 2; k++) {
        scene_cursor name = scene_element(&member, k);
        between[k].first = scene_find_bodies(r, &name, list->bodies, &between[k].count);
    }
    for (pair_walk w = pairs_of(between[0], between[1]); r->status == CIPC_OK && next_pair(&w);) {
        const int a = w.a.first + w.i, b = w.b.first + w.j;
        bool *seen = given_at(list, a, b);
        if (*seen)
            scene_reject(r, pair, CIPC_E_OUT_OF_RANGE, "the pair %s, %s is given twice", list->bodies->descriptions[a].name,
                         list->bodies->descriptions[b].name);
        *seen = true;
    }
    return r->status == CIPC_OK;
}

static void read_friction(scene_reader *r, const scene_cursor *pair, const pair_list *list, cipc_model *model)
{
    static const char *const keys[] = {"between", "mu", NULL};
    body_range between[2];
    if (!scene_is_object(r, pair, keys)) return;
    bool known = read_between(r, pair, list, between);
    double mu = scene_number(r, pair, "mu", SCENE_REQUIRED_NUMBER, scene_not_negative);
    for (pair_walk w = pairs_of(between[0], between[1]); known && r->status == CIPC_OK && next_pair(&w);)
        cipc_model_set_friction(model, w.a.first + w.i, w.b.first + w.j, mu);
}

static void read_collision(scene_reader *r, const scene_cursor *pair, const pair_list *list, cipc_model *model)
{
    static const char *const keys[] = {"between", "enabled", NULL};
    body_range between[2];
    if (!scene_is_object(r, pair, keys)) return;
    bool known = read_between(r, pair, list, between);
    scene_cursor enabled = scene_member(pair, "enabled");
    if (enabled.value == NULL) scene_reject(r, &enabled, CIPC_E_MISSING_KEY, "required, but missing: do these bodies meet, true or false");
    bool meet = scene_boolean(r, pair, "enabled", false);
    for (pair_walk w = pairs_of(between[0], between[1]); known && r->status == CIPC_OK && !meet && next_pair(&w);)
        cipc_model_set_apart(model, w.a.first + w.i, w.b.first + w.j);
}

typedef void read_entry(scene_reader *r, const scene_cursor *pair, const pair_list *list, cipc_model *model);

/* The array under `key`, entry by entry; list->given is the caller's to free. False if rejected. */
static bool read_list(scene_reader *r, const scene_cursor *root, const char *key, read_entry *read, pair_list *list, cipc_model *model)
{
    size_t count = (size_t)list->bodies->count;
    scene_cursor member = scene_array_member(r, root, key);
    if (!scene_is_array(r, &member, 0, PAIRS_MAX)) return false;
    list->given = cipc_alloc(count * count, sizeof *list->given);
    if (list->given == NULL) {
        scene_reject_memory(r, &member);
        return false;
    }
    for (size_t i = 0; i < json_array_size(member.value) && r->status == CIPC_OK; i++) {
        scene_cursor pair = scene_element(&member, i);
        read(r, &pair, list, model);
    }
    return r->status == CIPC_OK;
}

void scene_read_friction(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    pair_list list = {bodies, NULL};
    read_list(r, root, "friction", read_friction, &list, model);
    cipc_free(list.given);
}

static bool same_group(const scene_body *a, const scene_body *b)
{
    return a->group != NULL && b->group != NULL && strcmp(a->group, b->group) == 0;
}

/* A pair that is listed is as its entry says. */
static void part_groups(const pair_list *list, cipc_model *model)
{
    for (int a = 0; a < list->bodies->count; a++) {
        for (int b = a + 1; b < list->bodies->count; b++) {
            if (same_group(&list->bodies->bodies[a], &list->bodies->bodies[b]) && !*given_at(list, a, b)) cipc_model_set_apart(model, a, b);
        }
    }
}

void scene_read_collisions(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    pair_list list = {bodies, NULL};
    if (read_list(r, root, "collisions", read_collision, &list, model)) part_groups(&list, model);
    cipc_free(list.given);
}
