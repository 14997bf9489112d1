/* Paths of a JSON tree for people and for programs. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/cursor.h"

static const char text[] = "{\"bodies\": [{\"x\": 1}, {\"name\": \"cloth\", \"shell\": {\"grid\": 2}}]}";

static void test_paths(void **state)
{
    (void)state;
    json_t *value = json_loads(text, 0, NULL);
    char path[64];
    scene_cursor root = scene_root(value), bodies = scene_member(&root, "bodies"), first = scene_element(&bodies, 0),
                 cloth = scene_element(&bodies, 1);
    scene_cursor shell = scene_member(&cloth, "shell"), grid = scene_member(&shell, "grid"), missing = scene_member(&first, "name");
    scene_cursor_path(&root, path, sizeof path);
    assert_string_equal(path, "");
    scene_cursor_path(&grid, path, sizeof path);
    assert_string_equal(path, "bodies.cloth.shell.grid");
    scene_cursor_path(&missing, path, sizeof path);
    assert_string_equal(path, "bodies.0.name");
    assert_null(missing.value);
    assert_int_equal(json_integer_value(grid.value), 2);
    scene_cursor_address(&grid, path, sizeof path);
    assert_string_equal(path, "\x1f"
                              "bodies\x1f"
                              "1\x1f"
                              "shell\x1f"
                              "grid");
    json_decref(value);
}

static void test_a_small_buffer_cuts_the_path(void **state)
{
    (void)state;
    json_t *value = json_loads(text, 0, NULL);
    char path[9];
    memset(path, '#', sizeof path);
    scene_cursor root = scene_root(value), bodies = scene_member(&root, "bodies"), cloth = scene_element(&bodies, 1);
    scene_cursor_path(&cloth, path, sizeof path);
    assert_string_equal(path, "bodies.c");
    json_decref(value);
}

static void test_steps(void **state)
{
    (void)state;
    json_t *value = json_loads(text, 0, NULL);
    scene_step steps[SCENE_DEPTH];
    scene_cursor chain[SCENE_DEPTH + 3];
    chain[0] = scene_root(value);
    assert_int_equal(scene_cursor_steps(&chain[0], steps), 0);
    for (int i = 1; i < SCENE_DEPTH + 3; i++) chain[i] = scene_element(&chain[i - 1], (size_t)i);
    assert_int_equal(scene_cursor_steps(&chain[2], steps), 2);
    assert_null(steps[1].key);
    assert_int_equal(steps[1].index, 2);
    assert_int_equal(scene_cursor_steps(&chain[SCENE_DEPTH + 2], steps), SCENE_DEPTH); /* the first ones */
    assert_int_equal(steps[SCENE_DEPTH - 1].index, SCENE_DEPTH);
    json_decref(value);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paths),
        cmocka_unit_test(test_a_small_buffer_cuts_the_path),
        cmocka_unit_test(test_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
