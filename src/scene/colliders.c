/* "colliders": bodies given by formulas. */
#include "scene/massspring.h"

#include <string.h>

#include "base/vector.h"
#include "scene/alternatives.h"
#include "scene/lists.h"

enum { COLLIDERS_MAX = 100000, NAME_MAX_LENGTH = CIPC_NAME_SIZE - 1 };

/* A required vector. */
static void read_vector(scene_reader *r, const scene_cursor *object, const char *key, scene_range range, double vector[3])
{
    scene_cursor member = scene_member(object, key);
    scene_vector_at(r, &member, range, vector);
}

/* A required direction, of any length but 0; becomes a unit vector. Scaled first, so that very long and very short ones are directions too. */
static void read_direction(scene_reader *r, const scene_cursor *object, const char *key, double direction[3])
{
    scene_cursor member = scene_member(object, key);
    scene_vector_at(r, &member, scene_any, direction);
    const double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    if (!(largest > 0)) {
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "has no direction: all three numbers are 0");
        return;
    }
    for (int k = 0; k < 3; k++) direction[k] /= largest;
    const double length = v3_norm(direction);
    for (int k = 0; k < 3; k++) direction[k] /= length;
}

static double read_size(scene_reader *r, const scene_cursor *object, const char *key)
{
    return scene_number(r, object, key, SCENE_REQUIRED_NUMBER, scene_positive);
}

static void read_plane(scene_reader *r, const scene_cursor *shape, cipc_collider *c)
{
    static const char *const keys[] = {"point", "normal", NULL};
    if (!scene_is_object(r, shape, keys)) return;
    read_vector(r, shape, "point", scene_any, c->center);
    read_direction(r, shape, "normal", c->axis);
}

static void read_sphere(scene_reader *r, const scene_cursor *shape, cipc_collider *c)
{
    static const char *const keys[] = {"center", "radius", NULL};
    if (!scene_is_object(r, shape, keys)) return;
    read_vector(r, shape, "center", scene_any, c->center);
    c->half[0] = read_size(r, shape, "radius");
}

static void read_box(scene_reader *r, const scene_cursor *shape, cipc_collider *c)
{
    static const char *const keys[] = {"center", "half", NULL};
    if (!scene_is_object(r, shape, keys)) return;
    read_vector(r, shape, "center", scene_any, c->center);
    read_vector(r, shape, "half", scene_positive, c->half);
}

static void read_disc(scene_reader *r, const scene_cursor *shape, cipc_collider *c)
{
    static const char *const keys[] = {"center", "axis", "radius", "half_height", NULL};
    if (!scene_is_object(r, shape, keys)) return;
    read_vector(r, shape, "center", scene_any, c->center);
    read_direction(r, shape, "axis", c->axis);
    c->half[0] = read_size(r, shape, "radius");
    c->half[1] = read_size(r, shape, "half_height");
}

static void read_capsule(scene_reader *r, const scene_cursor *shape, cipc_collider *c)
{
    static const char *const keys[] = {"begin", "end", "radii", NULL};
    if (!scene_is_object(r, shape, keys)) return;
    read_vector(r, shape, "begin", scene_any, c->center);
    read_vector(r, shape, "end", scene_any, c->axis);
    scene_numbers(r, shape, "radii", 2, scene_positive, c->half);
}

/* It must be one by which --set finds the collider, and no other. */
static void read_name(scene_reader *r, const scene_cursor *list, const scene_cursor *entry, size_t index)
{
    const char *name = scene_string(r, entry, "name", NULL);
    scene_cursor member = scene_member(entry, "name");
    if (r->status != CIPC_OK) return;
    if (name[0] == '\0' || strlen(name) > NAME_MAX_LENGTH || strpbrk(name, ".=") != NULL || strspn(name, "0123456789") == strlen(name))
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%.70s' is not a name: 1 to %d bytes, not only digits, without '.' and '='", name, NAME_MAX_LENGTH);
    for (size_t i = 0; i < index; i++)
        if (strcmp(name, json_string_value(json_object_get(json_array_get(list->value, i), "name"))) == 0)
            scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%s' is the name of collider %zu already", name, i);
}

static void read_collider(scene_reader *r, const scene_cursor *list, size_t index, cipc_collider *c)
{
    static const char *const keys[] = {"name", "friction", "plane", "sphere", "box", "disc", "capsule", NULL};
    static const char *const shapes[] = {"plane", "sphere", "box", "disc", "capsule", NULL}; /* in the order of cipc_collider_kind */
    static void (*const read[])(scene_reader *, const scene_cursor *, cipc_collider *) = {read_plane, read_sphere, read_box, read_disc, read_capsule};
    scene_cursor entry = scene_element(list, index);
    if (!scene_is_object(r, &entry, keys)) return;
    read_name(r, list, &entry, index);
    c->friction = scene_number(r, &entry, "friction", 0, scene_not_negative);
    const int kind = r->status == CIPC_OK ? scene_one_of(r, &entry, shapes) : -1;
    if (kind < 0) return;
    c->kind = (cipc_collider_kind)kind;
    scene_cursor shape = scene_member(&entry, shapes[kind]);
    read[kind](r, &shape, c);
}

void scene_read_colliders(scene_reader *r, const scene_cursor *root, cipc_scene *scene)
{
    scene_cursor list = scene_array_member(r, root, "colliders");
    if (r->status != CIPC_OK || !scene_is_array(r, &list, 0, COLLIDERS_MAX)) return;
    const size_t count = json_array_size(list.value);
    scene->colliders = cipc_alloc(count, sizeof *scene->colliders);
    if (scene->colliders == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    for (size_t i = 0; i < count && r->status == CIPC_OK; i++) read_collider(r, &list, i, &scene->colliders[i]);
    scene->collider_count = (int)count;
}

static void check_node(scene_reader *r, const scene_cursor *list, const cipc_scene *scene, int node)
{
    const cipc_body *body = &scene->model->bodies[scene->model->node_body[node]];
    for (int c = 0; c < scene->collider_count && !body->fixed; c++) {
        const double distance = cipc_collider_distance(&scene->colliders[c], scene->state->position + 3 * node, NULL);
        if (distance >= 0) continue;
        scene_cursor entry = scene_element(list, (size_t)c);
        scene_reject(r, &entry, CIPC_E_OUT_OF_RANGE, "node %d of '%s' starts inside of '%s', %.3g m deep", node - body->first_node, body->name,
                     json_string_value(json_object_get(entry.value, "name")), -distance);
        cipc_fail_remedy(&r->error, "move the collider, or the body by its transform.translate");
        return;
    }
}

void scene_check_colliders(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor list = scene_member(root, "colliders");
    for (int i = 0; i < scene->model->node_count && r->status == CIPC_OK; i++) check_node(r, &list, scene, i);
}
