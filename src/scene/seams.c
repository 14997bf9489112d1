/* Stitches one by one, from a node to a point of an edge; seams that sew a row of nodes to another row, node to node; and seams that sew a side of
 * a garment's panels to another. */
#include "scene/seams.h"

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/panel_sides.h"

enum { STITCHES_MAX = 10000000 };

static const double default_stiffness = 10; /* N/m (SPEC C.6) */
static const scene_range closed_unit = {0, 1, false, false};

typedef struct seam_reader {
    scene_reader *r;
    const scene_bodies *bodies;
    const cipc_model *model;
    int count, capacity;
    cipc_stitching *stitches; /* owned */
} seam_reader;

static void append(seam_reader *s, const scene_cursor *cursor, cipc_stitching stitch)
{
    if (s->r->status != CIPC_OK) return;
    if (s->count == s->capacity) {
        int larger = s->capacity == 0 ? 64 : 2 * s->capacity;
        cipc_stitching *stitches = cipc_realloc(s->stitches, (size_t)larger, sizeof *stitches);
        if (stitches == NULL) {
            scene_reject_memory(s->r, cursor);
            return;
        }
        s->stitches = stitches;
        s->capacity = larger;
    }
    s->stitches[s->count++] = stitch;
}

static int read_body(seam_reader *s, const scene_cursor *object, const char *key)
{
    scene_cursor name = scene_member(object, key);
    return scene_find_body(s->r, &name, s->bodies);
}

/* {"body": name, "index": n}; returns the node of the model. */
static int read_node(seam_reader *s, const scene_cursor *node)
{
    static const char *const keys[] = {"body", "index", NULL};
    if (!scene_is_object(s->r, node, keys)) return 0;
    const cipc_body *body = &s->model->bodies[read_body(s, node, "body")];
    return body->first_node + scene_integer(s->r, node, "index", SCENE_REQUIRED, 0, body->node_count - 1);
}

/* {"body": name, "indices": [a, b]} */
static void read_edge(seam_reader *s, const scene_cursor *edge, int nodes[2])
{
    static const char *const keys[] = {"body", "indices", NULL};
    nodes[0] = nodes[1] = 0;
    if (!scene_is_object(s->r, edge, keys)) return;
    const cipc_body *body = &s->model->bodies[read_body(s, edge, "body")];
    scene_integers(s->r, edge, "indices", 2, 0, body->node_count - 1, nodes);
    scene_cursor indices = scene_member(edge, "indices");
    if (nodes[0] == nodes[1]) scene_reject(s->r, &indices, CIPC_E_OUT_OF_RANGE, "are the same node %d twice, but an edge has two", nodes[0]);
    for (int k = 0; k < 2; k++) nodes[k] += body->first_node;
}

static double read_stiffness(seam_reader *s, const scene_cursor *cursor)
{
    return scene_number(s->r, cursor, "stiffness", default_stiffness, scene_positive);
}

static void read_stitch(seam_reader *s, const scene_cursor *cursor)
{
    static const char *const keys[] = {"name", "node", "edge", "ratio", "stiffness", NULL};
    cipc_stitching stitch;
    if (!scene_is_object(s->r, cursor, keys)) return;
    scene_cursor node = scene_member(cursor, "node"), edge = scene_member(cursor, "edge");
    stitch.nodes[0] = read_node(s, &node);
    read_edge(s, &edge, &stitch.nodes[1]);
    stitch.ratio = scene_number(s->r, cursor, "ratio", SCENE_REQUIRED_NUMBER, closed_unit);
    stitch.stiffness = read_stiffness(s, cursor);
    if (stitch.nodes[0] == stitch.nodes[1] || stitch.nodes[0] == stitch.nodes[2])
        scene_reject(s->r, &node, CIPC_E_OUT_OF_RANGE, "is an end of the edge that it is to be sewn to");
    append(s, cursor, stitch);
}

/* One row of a seam, as nodes of the model (cipc_free); NULL if rejected. */
static int *read_row(seam_reader *s, const scene_cursor *seam, const char *body_key, const char *nodes_key, int *count)
{
    const cipc_body *body = &s->model->bodies[read_body(s, seam, body_key)];
    int *nodes = scene_integer_list(s->r, seam, nodes_key, 0, body->node_count - 1, 1, SCENE_NODES_MAX, count);
    for (int i = 0; i < *count; i++) nodes[i] += body->first_node;
    return nodes;
}

/* A stitch ends on an edge, so that with ratio 0 the other end of the edge is free to choose: the nearest node in the row that can be one. -1:
 * there is none. */
static int other_end(const int *row, int count, int i, int sewn)
{
    for (int apart = 1; apart < count; apart++) {
        const int candidates[2] = {i + apart, i - apart};
        for (int k = 0; k < 2; k++) {
            int j = candidates[k];
            if (j >= 0 && j < count && row[j] != row[i] && row[j] != sewn) return row[j];
        }
    }
    return -1;
}

static void sew_rows(seam_reader *s, const scene_cursor *seam, const int *a, const int *b, int count, double stiffness)
{
    scene_cursor nodes_a = scene_member(seam, "nodes_a"), nodes_b = scene_member(seam, "nodes_b");
    for (int i = 0; i < count && s->r->status == CIPC_OK; i++) {
        scene_cursor sewn = scene_element(&nodes_a, (size_t)i);
        int end = other_end(b, count, i, a[i]);
        if (a[i] == b[i]) scene_reject(s->r, &sewn, CIPC_E_OUT_OF_RANGE, "is to be sewn to itself");
        if (end < 0)
            scene_reject(s->r, &nodes_b, CIPC_E_OUT_OF_RANGE,
                         "needs a second node, which makes an edge with the one that is sewn to; a single stitch is given by node and edge");
        append(s, seam, (cipc_stitching){{a[i], b[i], end}, 0, stiffness});
    }
}

static void read_seam(seam_reader *s, const scene_cursor *seam)
{
    static const char *const keys[] = {"name", "body_a", "nodes_a", "body_b", "nodes_b", "stiffness", NULL};
    int count_a, count_b;
    if (!scene_is_object(s->r, seam, keys)) return;
    int *a = read_row(s, seam, "body_a", "nodes_a", &count_a), *b = read_row(s, seam, "body_b", "nodes_b", &count_b);
    double stiffness = read_stiffness(s, seam);
    scene_cursor nodes_b = scene_member(seam, "nodes_b");
    if (count_a != count_b)
        scene_reject(s->r, &nodes_b, CIPC_E_OUT_OF_RANGE, "has %d nodes, but nodes_a has %d", count_b, count_a);
    else if (a != NULL && b != NULL)
        sew_rows(s, seam, a, b, count_a, stiffness);
    cipc_free(a);
    cipc_free(b);
}

/* The body whose side it is; the side. */
static int read_side(seam_reader *s, const scene_cursor *seam, const char *body_key, const char *side_key, scene_side *side)
{
    static const char *const names[] = {"top", "bottom", "left", "right", NULL};
    int body = read_body(s, seam, body_key);
    scene_cursor name = scene_member(seam, body_key);
    *side = (scene_side)scene_choice(s->r, seam, side_key, "side", names, SCENE_REQUIRED);
    if (scene_mesh_of(s->bodies, body)->panel_count == 0)
        scene_reject(s->r, &name, CIPC_E_OUT_OF_RANGE, "'%s' has no sides: only gores and pleats have them; sew others by nodes_a and nodes_b",
                     s->bodies->descriptions[body].name);
    return body;
}

/* One node to the nearest point, where both start. Within a body, edges with the node itself are left out: two sides share a corner. */
static void sew_to_side(seam_reader *s, const scene_cursor *seam, int body_a, int node, int body_b, scene_side side, double stiffness)
{
    const scene_body *a = &s->bodies->bodies[body_a], *b = &s->bodies->bodies[body_b];
    scene_side_point point = scene_nearest_on_side(scene_mesh_of(s->bodies, body_b), b->position, side, a->position + 3 * node, body_a == body_b ? node : -1);
    if (point.nodes[0] < 0) {
        scene_reject(s->r, seam, CIPC_E_OUT_OF_RANGE, "node %d has no edge to be sewn to: it belongs to all of the side", node);
        return;
    }
    int first_a = s->model->bodies[body_a].first_node, first_b = s->model->bodies[body_b].first_node;
    append(s, seam, (cipc_stitching){{first_a + node, first_b + point.nodes[0], first_b + point.nodes[1]}, point.ratio, stiffness});
}

/* Every node of one side, in all panels, to the nearest point of the other. */
static void read_side_seam(seam_reader *s, const scene_cursor *seam)
{
    static const char *const keys[] = {"name", "body_a", "side_a", "body_b", "side_b", "stiffness", NULL};
    scene_side side_a, side_b;
    if (!scene_is_object(s->r, seam, keys)) return;
    int body_a = read_side(s, seam, "body_a", "side_a", &side_a), body_b = read_side(s, seam, "body_b", "side_b", &side_b);
    double stiffness = read_stiffness(s, seam);
    scene_cursor other = scene_member(seam, "side_b");
    if (body_a == body_b && side_a == side_b) scene_reject(s->r, &other, CIPC_E_OUT_OF_RANGE, "is the side that is to be sewn to it");
    const cipc_mesh *mesh = scene_mesh_of(s->bodies, body_a);
    for (int p = 0; p < mesh->panel_count; p++) {
        for (int i = 0; i < scene_side_length(mesh, side_a) && s->r->status == CIPC_OK; i++)
            sew_to_side(s, seam, body_a, scene_side_node(mesh, side_a, p, i), body_b, side_b, stiffness);
    }
}

static void read_entry(seam_reader *s, const scene_cursor *entry)
{
    static const char *const all[] = {"name",   "node",    "edge",   "ratio",  "stiffness", "body_a",
                                      "body_b", "nodes_a", "nodes_b", "side_a", "side_b",    NULL};
    static const char *const ways[] = {"node", "nodes_a", "side_a", NULL};
    if (!scene_is_object(s->r, entry, all)) return;
    if (json_object_get(entry->value, "name") != NULL) scene_string(s->r, entry, "name", NULL);
    int way = scene_one_of(s->r, entry, ways);
    if (way == 0) read_stitch(s, entry);
    if (way == 1) read_seam(s, entry);
    if (way == 2) read_side_seam(s, entry);
}

void scene_read_stitches(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    seam_reader s = {.r = r, .bodies = bodies, .model = model};
    scene_cursor list = scene_array_member(r, root, "stitches");
    if (!scene_is_array(r, &list, 0, STITCHES_MAX)) return;
    for (size_t i = 0; i < json_array_size(list.value) && r->status == CIPC_OK; i++) {
        scene_cursor entry = scene_element(&list, i);
        read_entry(&s, &entry);
    }
    cipc_error error;
    if (r->status == CIPC_OK && s.count > 0) scene_adopt(r, &list, cipc_model_add_stitches(model, s.stitches, s.count, &error), &error);
    cipc_free(s.stitches);
}
