/* Reading bodies: name, mesh, material, placement, start. */
#include "scene/bodies.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "scene/body_kind.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/nearest_name.h"
#include "scene/rest_mesh.h"
#include "scene/transform.h"

enum { BODIES_MAX = 10000 };

/* A fixed body needs neither density nor thickness for itself; these are what its nodes' mass is made of when the scene says nothing. */
static const double obstacle_density = 1000;   /* kg/m^3 */
static const double obstacle_thickness = 1e-3; /* m */

void scene_bodies_free(scene_bodies *bodies)
{
    for (int b = 0; b < bodies->count; b++) {
        scene_body *body = &bodies->bodies[b];
        cipc_mesh_free(&body->mesh);
        cipc_free(body->rest);
        cipc_free(body->position);
        cipc_free(body->velocity);
    }
    cipc_free(bodies->bodies);
    cipc_free(bodies->descriptions);
    *bodies = (scene_bodies){0};
}

/* Names are steps of dotted paths: no dots or '=', and not mistakable for an index. */
static bool is_addressable(const char *name)
{
    bool digits = true;
    for (const char *c = name; *c != '\0'; c++) {
        if (*c == '.' || *c == '=' || iscntrl((unsigned char)*c)) return false;
        digits = digits && isdigit((unsigned char)*c);
    }
    return !digits;
}

static void read_name(scene_reader *r, const scene_cursor *body, const scene_bodies *bodies, int index)
{
    const char *name = scene_string(r, body, "name", NULL);
    scene_cursor member = scene_member(body, "name");
    if (r->status != CIPC_OK) return;
    if (strlen(name) >= CIPC_NAME_SIZE || !is_addressable(name)) {
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%.70s' is not a name: 1 to %d bytes, not only digits, without '.' and '='", name,
                     CIPC_NAME_SIZE - 1);
        return;
    }
    for (int b = 0; b < index; b++) {
        if (strcmp(bodies->descriptions[b].name, name) != 0) continue;
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%s' is the name of body %d already", name, b);
        return;
    }
    snprintf(bodies->descriptions[index].name, CIPC_NAME_SIZE, "%s", name);
}

static bool allocate_nodes(scene_body *body)
{
    size_t numbers = 3 * (size_t)body->mesh.node_count;
    body->rest = cipc_alloc(numbers, sizeof *body->rest);
    body->position = cipc_alloc(numbers, sizeof *body->position);
    body->velocity = cipc_alloc(numbers, sizeof *body->velocity);
    return body->rest != NULL && body->position != NULL && body->velocity != NULL;
}

static void place(scene_reader *r, const scene_cursor *cursor, const scene_transform *transform, const double velocity[3],
                  const double *rest_nodes, scene_body *body)
{
    const cipc_mesh *mesh = &body->mesh;
    if (!allocate_nodes(body)) {
        scene_reject_memory(r, cursor);
        return;
    }
    scene_place_nodes(transform, mesh->nodes, mesh->node_count, body->position);
    scene_rest_nodes(transform, rest_nodes != NULL ? rest_nodes : mesh->nodes, mesh->node_count, body->rest);
    for (int i = 0; i < 3 * mesh->node_count; i++) body->velocity[i] = velocity[i % 3];
}

/* Mesh, placement and uniform start velocity. */
static void read_shape(scene_reader *r, const scene_cursor *cursor, unsigned long seed, scene_body *body)
{
    static const double zero[3] = {0, 0, 0};
    scene_transform transform;
    double velocity[3];
    cipc_body_kind kind = body->description.kind;
    scene_read_kind_mesh(r, cursor, kind, seed, &body->mesh);
    scene_read_transform(r, cursor, &transform);
    scene_vector(r, cursor, "velocity", zero, velocity);
    double *rest_nodes = scene_read_rest_mesh(r, cursor, scene_kind_mesh(kind), &body->mesh);
    if (r->status == CIPC_OK) place(r, cursor, &transform, velocity, rest_nodes, body);
    cipc_free(rest_nodes);
}

static void read_body(scene_reader *r, const scene_cursor *cursor, unsigned long seed, const scene_material_defaults *defaults,
                      scene_body *body)
{
    cipc_body_description *d = &body->description;
    d->kind = scene_read_kind(r, cursor);
    d->fixed = scene_boolean(r, cursor, "fixed", false);
    if (r->status != CIPC_OK) return;
    scene_read_material(r, cursor, d->kind, defaults, &d->material);
    d->offset = scene_number(r, cursor, "offset", 0, scene_not_negative);
    d->friction = scene_number(r, cursor, "friction", 0, scene_not_negative);
    if (json_object_get(cursor->value, "collision_group") != NULL) body->group = scene_string(r, cursor, "collision_group", NULL);
    read_shape(r, cursor, seed, body);
    d->node_count = body->mesh.node_count;
    d->rest = body->rest;
    d->position = body->position;
    d->velocity = body->velocity;
    d->triangle_count = body->mesh.triangle_count;
    d->triangles = (const int(*)[3])body->mesh.triangles;
    d->segment_count = body->mesh.segment_count;
    d->segments = (const int(*)[2])body->mesh.segments;
    d->tetrahedron_count = body->mesh.tetrahedron_count;
    d->tetrahedra = (const int(*)[4])body->mesh.tetrahedra;
}

static bool is_fixed(const scene_cursor *body)
{
    return json_is_true(json_object_get(body->value, "fixed"));
}

/* All free bodies, or all fixed ones. The material of the first free one is what "released" gives to obstacles (a volume has no thickness to
 * give). */
static void read_those(scene_reader *r, const scene_cursor *list, bool fixed, unsigned long seed, scene_material_defaults *defaults,
                       scene_bodies *bodies)
{
    bool first = true;
    for (int b = 0; b < bodies->count && r->status == CIPC_OK; b++) {
        scene_cursor cursor = scene_element(list, (size_t)b);
        if (is_fixed(&cursor) != fixed) continue;
        scene_body *body = &bodies->bodies[b];
        memcpy(body->description.name, bodies->descriptions[b].name, CIPC_NAME_SIZE);
        read_body(r, &cursor, seed, defaults, body);
        bodies->descriptions[b] = body->description;
        if (!fixed && defaults->released && first) {
            defaults->density = body->description.material.density;
            if (body->description.kind != CIPC_BODY_VOLUME) defaults->thickness = body->description.material.thickness;
        }
        first = false;
    }
}

static void check_total(scene_reader *r, const scene_cursor *list, const scene_bodies *bodies)
{
    long long nodes = 0;
    for (int b = 0; b < bodies->count; b++) nodes += bodies->bodies[b].mesh.node_count;
    if (nodes > SCENE_NODES_MAX)
        scene_reject(r, list, CIPC_E_OUT_OF_RANGE, "have %lld nodes together; at most %d are allowed", nodes, SCENE_NODES_MAX);
}

void scene_read_bodies(scene_reader *r, const scene_cursor *root, unsigned long seed, bool released, scene_bodies *bodies)
{
    *bodies = (scene_bodies){0};
    scene_cursor list = scene_member(root, "bodies");
    if (!scene_is_array(r, &list, 1, BODIES_MAX)) return;
    size_t count = json_array_size(list.value);
    bodies->bodies = cipc_alloc(count, sizeof *bodies->bodies);
    bodies->descriptions = cipc_alloc(count, sizeof *bodies->descriptions);
    if (bodies->bodies == NULL || bodies->descriptions == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    bodies->count = (int)count;
    for (int b = 0; b < bodies->count; b++) {
        scene_cursor body = scene_element(&list, (size_t)b);
        if (scene_is_body(r, &body)) read_name(r, &body, bodies, b);
    }
    scene_material_defaults defaults = {.density = obstacle_density, .thickness = obstacle_thickness, .released = released};
    read_those(r, &list, false, seed, &defaults, bodies);
    defaults.optional = true;
    read_those(r, &list, true, seed, &defaults, bodies);
    check_total(r, &list, bodies);
}

int scene_find_body(scene_reader *r, const scene_cursor *cursor, const scene_bodies *bodies)
{
    const char *name = scene_string_at(r, cursor), *nearest = NULL;
    if (r->status != CIPC_OK) return 0;
    for (int b = 0; b < bodies->count; b++) {
        const char *known = bodies->descriptions[b].name;
        if (strcmp(known, name) == 0) return b;
        if (nearest == NULL || scene_edit_distance(name, known) < scene_edit_distance(name, nearest)) nearest = known;
    }
    scene_reject(r, cursor, CIPC_E_OUT_OF_RANGE, "no body is called '%.60s'; the nearest is '%s'", name, nearest);
    return 0;
}
