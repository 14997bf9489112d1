/* Reading bodies: name, mesh, material, placement, start, copies. */
#include "scene/bodies.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/body_kind.h"
#include "scene/copies.h"
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
    cipc_free(bodies->entries);
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

/* NAME-1 to NAME-count. */
static bool is_copy_of(const scene_body_entry *entry, const char *name)
{
    const size_t length = strlen(entry->name);
    if (!entry->copied || strncmp(entry->name, name, length) != 0 || name[length] != '-') return false;
    const char *digits = name + length + 1;
    char *end;
    const long copy = strtol(digits, &end, 10);
    return isdigit((unsigned char)*digits) && *digits != '0' && *end == '\0' && copy <= entry->count;
}

/* The element before this one that has its name, or has a copy of that name, or is called as a copy of this one is; -1: none. */
static int taken_by(const scene_bodies *bodies, int entry)
{
    const scene_body_entry *own = &bodies->entries[entry];
    for (int e = 0; e < entry; e++) {
        const scene_body_entry *known = &bodies->entries[e];
        if (strcmp(known->name, own->name) == 0 || is_copy_of(known, own->name) || is_copy_of(own, known->name)) return e;
    }
    return -1;
}

/* Copies have a dash and a number more. */
static void read_name(scene_reader *r, const scene_cursor *body, scene_bodies *bodies, int entry)
{
    enum { DIGITS = 6 };
    const char *name = scene_string(r, body, "name", NULL);
    scene_cursor member = scene_member(body, "name");
    if (r->status != CIPC_OK) return;
    const int longest = CIPC_NAME_SIZE - 1 - (bodies->entries[entry].copied ? DIGITS : 0);
    if (strlen(name) > (size_t)longest || !is_addressable(name)) {
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%.70s' is not a name: 1 to %d bytes, not only digits, without '.' and '='", name, longest);
        return;
    }
    snprintf(bodies->entries[entry].name, CIPC_NAME_SIZE, "%s", name);
    const int other = taken_by(bodies, entry);
    if (other >= 0 && strcmp(bodies->entries[other].name, name) == 0)
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%s' is the name of body %d already", name, other);
    else if (other >= 0)
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%s' or one of its copies has a name that body %d, '%s', or one of its copies has already", name, other,
                     bodies->entries[other].name);
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

/* The copies share mesh and rest shape of the first of them. */
static void add_copies(scene_reader *r, const scene_cursor *cursor, const scene_copies *copies, scene_body *first)
{
    const cipc_body_description *d = &first->description;
    for (int i = 1; i < copies->count && r->status == CIPC_OK; i++) {
        scene_body *body = first + i;
        char name[CIPC_NAME_SIZE];
        memcpy(name, body->description.name, sizeof name);
        body->description = *d;
        memcpy(body->description.name, name, sizeof name);
        body->group = first->group;
        body->position = cipc_alloc(3 * (size_t)d->node_count, sizeof *body->position);
        if (body->position == NULL) {
            scene_reject_memory(r, cursor);
            return;
        }
        scene_place_copy(copies, i, d->position, d->node_count, body->position);
        body->description.position = body->position;
    }
}

static void read_entry(scene_reader *r, const scene_cursor *cursor, unsigned long seed, const scene_material_defaults *defaults,
                       const scene_body_entry *entry, scene_bodies *bodies)
{
    scene_copies copies;
    scene_body *first = &bodies->bodies[entry->first];
    read_body(r, cursor, seed, defaults, first);
    scene_read_copies(r, cursor, &copies);
    if (r->status == CIPC_OK) add_copies(r, cursor, &copies, first);
    for (int i = 0; i < entry->count; i++) bodies->descriptions[entry->first + i] = first[i].description;
}

/* All free bodies, or all fixed ones. The material of the first free one is what "released" gives to obstacles (a volume has no thickness to
 * give). */
static void read_those(scene_reader *r, const scene_cursor *list, bool fixed, unsigned long seed, scene_material_defaults *defaults,
                       scene_bodies *bodies)
{
    bool first = true;
    for (int e = 0; e < bodies->entry_count && r->status == CIPC_OK; e++) {
        scene_cursor cursor = scene_element(list, (size_t)e);
        const scene_body_entry *entry = &bodies->entries[e];
        if (is_fixed(&cursor) != fixed) continue;
        read_entry(r, &cursor, seed, defaults, entry, bodies);
        const cipc_body_description *d = &bodies->descriptions[entry->first];
        if (!fixed && defaults->released && first) {
            defaults->density = d->material.density;
            if (d->kind != CIPC_BODY_VOLUME) defaults->thickness = d->material.thickness;
        }
        first = false;
    }
}

static void check_total(scene_reader *r, const scene_cursor *list, const scene_bodies *bodies)
{
    long long nodes = 0;
    for (int b = 0; b < bodies->count; b++) nodes += bodies->descriptions[b].node_count;
    if (nodes > SCENE_NODES_MAX)
        scene_reject(r, list, CIPC_E_OUT_OF_RANGE, "have %lld nodes together; at most %d are allowed", nodes, SCENE_NODES_MAX);
}

/* Names, and how many bodies each element of the list stands for. */
static void read_entries(scene_reader *r, const scene_cursor *list, scene_bodies *bodies)
{
    for (int e = 0; e < bodies->entry_count && r->status == CIPC_OK; e++) {
        scene_cursor body = scene_element(list, (size_t)e);
        scene_copies copies = {0};
        scene_body_entry *entry = &bodies->entries[e];
        if (!scene_is_body(r, &body)) return;
        scene_read_copies(r, &body, &copies);
        *entry = (scene_body_entry){.first = bodies->count, .count = copies.count > 0 ? copies.count : 1, .copied = copies.count > 0};
        read_name(r, &body, bodies, e);
        bodies->count += entry->count;
        if (bodies->count > BODIES_MAX) scene_reject(r, list, CIPC_E_OUT_OF_RANGE, "are more than %d bodies with their copies", BODIES_MAX);
    }
}

static bool allocate_bodies(scene_bodies *bodies)
{
    bodies->bodies = cipc_alloc((size_t)bodies->count, sizeof *bodies->bodies);
    bodies->descriptions = cipc_alloc((size_t)bodies->count, sizeof *bodies->descriptions);
    if (bodies->bodies == NULL || bodies->descriptions == NULL) return false;
    for (int e = 0; e < bodies->entry_count; e++) {
        const scene_body_entry *entry = &bodies->entries[e];
        for (int i = 0; i < entry->count; i++) {
            char *name = bodies->bodies[entry->first + i].description.name;
            const int length = snprintf(name, CIPC_NAME_SIZE, "%.56s", entry->name);
            if (entry->copied)
                snprintf(name + length, (size_t)(CIPC_NAME_SIZE - length), "-%d", i + 1);
            else
                memcpy(name, entry->name, CIPC_NAME_SIZE);
            memcpy(bodies->descriptions[entry->first + i].name, name, CIPC_NAME_SIZE);
        }
    }
    return true;
}

void scene_read_bodies(scene_reader *r, const scene_cursor *root, unsigned long seed, bool released, scene_bodies *bodies)
{
    *bodies = (scene_bodies){0};
    scene_cursor list = scene_member(root, "bodies");
    if (!scene_is_array(r, &list, 1, BODIES_MAX)) return;
    size_t count = json_array_size(list.value);
    bodies->entries = cipc_alloc(count, sizeof *bodies->entries);
    if (bodies->entries == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    bodies->entry_count = (int)count;
    read_entries(r, &list, bodies);
    if (r->status == CIPC_OK && !allocate_bodies(bodies)) scene_reject_memory(r, &list);
    if (r->status != CIPC_OK) {
        bodies->count = 0;
        return;
    }
    scene_material_defaults defaults = {.density = obstacle_density, .thickness = obstacle_thickness, .released = released};
    read_those(r, &list, false, seed, &defaults, bodies);
    defaults.optional = true;
    read_those(r, &list, true, seed, &defaults, bodies);
    check_total(r, &list, bodies);
}

int scene_entry_of(const scene_bodies *bodies, int body)
{
    int e = 0;
    while (e + 1 < bodies->entry_count && bodies->entries[e + 1].first <= body) e++;
    return e;
}

const cipc_mesh *scene_mesh_of(const scene_bodies *bodies, int body)
{
    return &bodies->bodies[bodies->entries[scene_entry_of(bodies, body)].first].mesh;
}

int scene_find_bodies(scene_reader *r, const scene_cursor *cursor, const scene_bodies *bodies, int *count)
{
    const char *name = scene_string_at(r, cursor), *nearest = NULL;
    *count = 0;
    if (r->status != CIPC_OK) return 0;
    for (int e = 0; e < bodies->entry_count; e++) {
        const scene_body_entry *entry = &bodies->entries[e];
        if (strcmp(entry->name, name) == 0) {
            *count = entry->count;
            return entry->first;
        }
        if (nearest == NULL || scene_edit_distance(name, entry->name) < scene_edit_distance(name, nearest)) nearest = entry->name;
    }
    for (int b = 0; b < bodies->count; b++) {
        if (strcmp(bodies->descriptions[b].name, name) != 0) continue;
        *count = 1;
        return b;
    }
    scene_reject(r, cursor, CIPC_E_OUT_OF_RANGE, "no body is called '%.60s'; the nearest is '%s'", name, nearest);
    return 0;
}

int scene_find_body(scene_reader *r, const scene_cursor *cursor, const scene_bodies *bodies)
{
    int count = 0;
    const int body = scene_find_bodies(r, cursor, bodies, &count);
    if (count > 1 || (count == 1 && strcmp(bodies->descriptions[body].name, json_string_value(cursor->value)) != 0)) {
        scene_reject(r, cursor, CIPC_E_OUT_OF_RANGE, "'%s' is the name of %d copies; name one of them, '%s' for the first", json_string_value(cursor->value), count,
                     bodies->descriptions[body].name);
    }
    return r->status == CIPC_OK ? body : 0;
}
