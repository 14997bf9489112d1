/* Every scene of the catalogue loads in every size. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "cipc/scene.h"

/* Run from the project's folder, like every test. */
static cipc_scene *load(const char *file, const char *size)
{
    char option[64];
    const char *overrides[] = {option, "bodies.cloth.shell.irregular.nodes=100"};
    cipc_scene *scene;
    cipc_error error;
    snprintf(option, sizeof option, "size=%s", size);
    /* The largest meshes take seconds to make, and the generator has its own tests. */
    int count = strcmp(size, "paper") == 0 && strstr(file, "rotating") != NULL ? 2 : 1;
    if (cipc_scene_load(&scene, file, count, overrides, &error) != CIPC_OK) fail_msg("%s %s: %s: %s", file, size, error.place, error.what);
    return scene;
}

/* Nodes and steps that `cipc scenes` tells are those of the scene (nodes only where load() has not made the mesh smaller). */
static void assert_cost(const char *name, const cipc_scene *scene)
{
    const cipc_scene_cost *cost = cipc_scene_cost_of(name, scene->size);
    if (cost == NULL) fail_msg("%s, size %s: no row in src/scene/costs.inc; ci/scene-costs makes it", name, scene->size);
    if (cost->steps != scene->steps) fail_msg("%s, size %s: %d steps, src/scene/costs.inc says %d", name, scene->size, scene->steps, cost->steps);
    const bool reduced = strcmp(scene->size, "paper") == 0 && strstr(name, "rotating") != NULL;
    if (!reduced && cost->nodes != scene->model->node_count) fail_msg("%s, size %s: %d nodes, src/scene/costs.inc says %d", name, scene->size, scene->model->node_count, cost->nodes);
}

static void test_scenes_load_in_every_size(void **state)
{
    (void)state;
    const char *const sizes[] = {"ci", "desk", "paper"};
    int count;
    const cipc_scene_entry *entries = cipc_scene_catalogue(&count);
    assert_true(count >= 6);
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            cipc_scene *scene = load(entries[i].file, sizes[k]);
            assert_string_equal(scene->title, entries[i].title);
            assert_string_equal(scene->size, sizes[k]);
            assert_true(scene->steps > 0 && scene->model->node_count > 0);
            assert_cost(entries[i].name, scene);
            cipc_scene_destroy(scene);
        }
    }
}

/* Larger sizes are not smaller: nodes and steps never decrease from ci to desk. */
static void test_sizes_grow(void **state)
{
    (void)state;
    int count;
    const cipc_scene_entry *entries = cipc_scene_catalogue(&count);
    for (int i = 0; i < count; i++) {
        cipc_scene *ci = load(entries[i].file, "ci"), *desk = load(entries[i].file, "desk");
        assert_true(desk->model->node_count >= ci->model->node_count && desk->steps >= ci->steps);
        assert_true(desk->model->node_count > ci->model->node_count || desk->steps > ci->steps);
        cipc_scene_destroy(ci);
        cipc_scene_destroy(desk);
    }
}

static void test_names_are_distinct_and_name_their_file(void **state)
{
    (void)state;
    int count;
    const cipc_scene_entry *entries = cipc_scene_catalogue(&count);
    for (int i = 0; i < count; i++) {
        char file[128];
        snprintf(file, sizeof file, "tests/scenes/%s.json", entries[i].name);
        assert_string_equal(entries[i].file, file);
        assert_true(strlen(entries[i].source) > 0);
        for (int k = 0; k < i; k++) assert_string_not_equal(entries[i].name, entries[k].name);
    }
}

/* The one that is there to stall says so, to those who run all of them. */
static void test_one_scene_is_to_stall(void **state)
{
    (void)state;
    int count;
    const cipc_scene_entry *entries = cipc_scene_catalogue(&count);
    for (int i = 0; i < count; i++) {
        const bool stalls = strcmp(entries[i].name, "jammed-knot") == 0;
        assert_int_equal(entries[i].ends, stalls ? CIPC_E_NO_PROGRESS : CIPC_OK);
        assert_true(!stalls || strstr(entries[i].source, cipc_status_name(entries[i].ends)) != NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes_load_in_every_size),
        cmocka_unit_test(test_sizes_grow),
        cmocka_unit_test(test_names_are_distinct_and_name_their_file),
        cmocka_unit_test(test_one_scene_is_to_stall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
