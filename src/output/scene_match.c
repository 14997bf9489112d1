/* Comparison of two resolved scenes, for --resume. */
#include "output/scene_match.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "cipc/base.h"

/* How long to run, what to look at and what to write along the way: none changes a frame. */
static const char *const irrelevant[] = {"title", "comment", "size", "sizes", "steps", "monitor", "output"};

static bool is_of(const json_t *scene, cipc_method wanted)
{
    const char *method = json_string_value(json_object_get(scene, "method"));
    return method != NULL && strcmp(method, cipc_method_name(wanted)) == 0;
}

/* Dropping fails if it is not there, which is fine. */
static void drop_irrelevant(json_t *scene, bool asynchronous, bool mass_spring)
{
    for (size_t i = 0; i < sizeof irrelevant / sizeof irrelevant[0]; i++) {
        json_object_del(scene, irrelevant[i]);
    }
    if (asynchronous) { /* after how many events a step counts as stalled: who raises that wants to go on */
        json_object_del(json_object_get(scene, "asynchronous"), "events");
    } else { /* of the other method; scenes resolved by older programs do not have them */
        json_object_del(scene, "asynchronous");
        json_object_del(scene, "loads");
    }
    if (!mass_spring) {
        json_object_del(scene, "mass_spring");
        json_object_del(scene, "colliders");
    }
}

static void append(char *path, size_t size, const char *format, const char *name, size_t index)
{
    size_t used = strlen(path);
    if (name != NULL) {
        snprintf(path + used, size - used, format, used > 0 ? "." : "", name);
    } else {
        char number[32];
        snprintf(number, sizeof number, "%zu", index);
        snprintf(path + used, size - used, format, used > 0 ? "." : "", number);
    }
}

static bool same(json_t *a, json_t *b, char *path, size_t size);

/* The member or element is appended to `path` only when it differs. */
static bool same_child(json_t *a, json_t *b, const char *name, size_t index, char *path, size_t size)
{
    if (a != NULL && b != NULL && json_equal(a, b)) {
        return true;
    }
    append(path, size, "%s%s", name, index);
    return a != NULL && b != NULL && same(a, b, path, size);
}

static bool same_object(json_t *a, json_t *b, char *path, size_t size)
{
    const char *key;
    json_t *value;
    json_object_foreach(a, key, value) {
        if (!same_child(value, json_object_get(b, key), key, 0, path, size)) {
            return false;
        }
    }
    json_object_foreach(b, key, value) {
        if (!same_child(json_object_get(a, key), value, key, 0, path, size)) {
            return false;
        }
    }
    return true;
}

static bool same(json_t *a, json_t *b, char *path, size_t size)
{
    if (json_is_object(a) && json_is_object(b)) {
        return same_object(a, b, path, size);
    }
    if (json_is_array(a) && json_is_array(b)) {
        size_t count_a = json_array_size(a), count_b = json_array_size(b), count = count_a > count_b ? count_a : count_b;
        for (size_t i = 0; i < count; i++) {
            if (!same_child(json_array_get(a, i), json_array_get(b, i), NULL, i, path, size)) {
                return false;
            }
        }
        return true;
    }
    return json_equal(a, b) != 0;
}

bool cipc_scene_match(const char *a, const char *b, char *path, size_t size)
{
    path[0] = '\0';
    if (strcmp(a, b) == 0) {
        return true;
    }
    json_t *scene_a = json_loads(a, 0, NULL), *scene_b = json_loads(b, 0, NULL);
    bool matches = false;
    if (scene_a != NULL && scene_b != NULL) {
        const bool asynchronous = is_of(scene_a, CIPC_METHOD_ASYNCHRONOUS) && is_of(scene_b, CIPC_METHOD_ASYNCHRONOUS);
        const bool mass_spring = is_of(scene_a, CIPC_METHOD_MASS_SPRING) && is_of(scene_b, CIPC_METHOD_MASS_SPRING);
        drop_irrelevant(scene_a, asynchronous, mass_spring);
        drop_irrelevant(scene_b, asynchronous, mass_spring);
        matches = same(scene_a, scene_b, path, size);
    }
    json_decref(scene_a);
    json_decref(scene_b);
    return matches;
}
