/* Dirichlet sets: of one body, or the same of several bodies, which may be released one after the other. */
#include "scene/dirichlet_sets.h"

#include <math.h>

#include "scene/alternatives.h"
#include "scene/motions.h"
#include "scene/node_choice.h"
#include "scene/track.h"

enum { SETS_MAX = 100000 };

typedef struct set_reader {
    scene_reader *r;
    const scene_bodies *bodies;
    cipc_model *model;
    scene_node_choice choice;
} set_reader;

static void read_track(set_reader *s, const scene_cursor *cursor, int body, cipc_dirichlet_set *set)
{
    const cipc_body_description *d = &s->bodies->descriptions[body];
    const scene_tracked tracked = {d->name, d->node_count, set->nodes, set->node_count};
    scene_cursor track = scene_member(cursor, "track");
    if (track.value == NULL || s->r->status != CIPC_OK) return;
    if (set->motion_count > 0) scene_reject(s->r, &track, CIPC_E_OUT_OF_RANGE, "cannot stand beside motion: the nodes follow one of them");
    scene_read_track(s->r, &track, &tracked, &set->track);
}

/* The set of one body. `pattern` has what sets of several bodies share. */
static void add_set(set_reader *s, const scene_cursor *cursor, int body, const cipc_dirichlet_set *pattern)
{
    cipc_dirichlet_set set = *pattern;
    cipc_error error;
    set.nodes = scene_choose_nodes(&s->choice, s->r, cursor, body, &set.node_count);
    read_track(s, cursor, body, &set);
    for (int i = 0; i < set.node_count; i++) set.nodes[i] += s->model->bodies[body].first_node;
    if (s->r->status == CIPC_OK) scene_adopt(s->r, cursor, cipc_model_add_dirichlet(s->model, &set, &error), &error);
    cipc_free(set.nodes);
    cipc_free(set.track.frames);
}

/* What only several bodies have, or only one. */
static void check_number(set_reader *s, const scene_cursor *cursor, bool several)
{
    scene_cursor interval = scene_member(cursor, "release_interval"), track = scene_member(cursor, "track");
    if (!several && interval.value != NULL)
        scene_reject(s->r, &interval, CIPC_E_MISSING_KEY, "is the time from one body's release to the next's, but there is no 'bodies'");
    if (several && track.value != NULL)
        scene_reject(s->r, &track, CIPC_E_OUT_OF_RANGE, "has the vertices of one body, which 'body' must name");
}

/* A body after the other, copies in their order, each released an interval after the one before. */
static void add_sets(set_reader *s, const scene_cursor *cursor, cipc_dirichlet_set *pattern)
{
    scene_cursor names = scene_member(cursor, "bodies"), interval = scene_member(cursor, "release_interval");
    double first = pattern->release, step = 0;
    if (!scene_is_array(s->r, &names, 1, SETS_MAX)) return;
    if (isfinite(first))
        step = scene_number(s->r, cursor, "release_interval", 0, scene_not_negative);
    else if (interval.value != NULL)
        scene_reject(s->r, &interval, CIPC_E_MISSING_KEY, "follows the first release, but 'release' is never");
    int released = 0;
    for (size_t i = 0; i < json_array_size(names.value) && s->r->status == CIPC_OK; i++) {
        scene_cursor name = scene_element(&names, i);
        int count, body = scene_find_bodies(s->r, &name, s->bodies, &count);
        for (int k = 0; k < count && s->r->status == CIPC_OK; k++) {
            pattern->release = first + released * step; /* step 0 for "never" */
            released++;
            add_set(s, cursor, body + k, pattern);
        }
    }
}

static void read_set(set_reader *s, const scene_cursor *cursor)
{
    static const char *const keys[] = {"name", "body", "bodies", "select", "release", "release_interval", "motion", "track", NULL};
    static const char *const ways[] = {"body", "bodies", NULL};
    cipc_dirichlet_set pattern = {0};
    if (!scene_is_object(s->r, cursor, keys)) return;
    if (json_object_get(cursor->value, "name") != NULL) scene_string(s->r, cursor, "name", NULL);
    int way = scene_one_of(s->r, cursor, ways);
    check_number(s, cursor, way == 1);
    pattern.release = scene_time_or_never(s->r, cursor, "release");
    scene_read_motions(s->r, cursor, &pattern.motion_count, &pattern.motions);
    scene_cursor name = scene_member(cursor, "body");
    int body = s->r->status == CIPC_OK && way == 0 ? scene_find_body(s->r, &name, s->bodies) : 0;
    if (s->r->status == CIPC_OK && way == 0) add_set(s, cursor, body, &pattern);
    if (s->r->status == CIPC_OK && way == 1) add_sets(s, cursor, &pattern);
    cipc_free(pattern.motions);
}

void scene_read_dirichlet(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    set_reader s = {.r = r, .bodies = bodies, .model = model};
    scene_cursor list = scene_array_member(r, root, "dirichlet");
    if (!scene_is_array(r, &list, 0, SETS_MAX) || !scene_node_choice_init(&s.choice, r, &list, bodies)) return;
    for (size_t i = 0; i < json_array_size(list.value) && r->status == CIPC_OK; i++) {
        scene_cursor set = scene_element(&list, i);
        read_set(&s, &set);
    }
    scene_node_choice_free(&s.choice);
}
