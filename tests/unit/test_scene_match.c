/* Which scenes may go on from one another's trajectories. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "output/scene_match.h"

static const char base[] =
    "{\"time_step\": 0.01, \"steps\": 3, \"newton\": {\"tolerance\": 1e-3}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}";

static void assert_matches(const char *other)
{
    char path[64];
    assert_true(cipc_scene_match(base, other, path, sizeof path));
}

static void assert_differs(const char *other, const char *where)
{
    char path[64];
    assert_false(cipc_scene_match(base, other, path, sizeof path));
    assert_string_equal(path, where);
    assert_false(cipc_scene_match(other, base, path, sizeof path)); /* whichever is the older */
    assert_string_equal(path, where);
}

static void test_order_and_layout_do_not_matter(void **state)
{
    (void)state;
    assert_matches(base);
    assert_matches("{\"bodies\":[{\"name\":\"a\"},{\"name\":\"b\"}],\"newton\":{\"tolerance\":0.001},\"steps\":3,\"time_step\":1e-2}");
}

static void test_members_that_change_no_frame(void **state)
{
    (void)state;
    assert_matches(
        "{\"time_step\": 0.01, \"steps\": 30, \"title\": \"t\", \"size\": \"ci\", \"sizes\": {}, \"monitor\": {\"enabled\": false}, "
        "\"output\": {\"obj\": true}, \"newton\": {\"tolerance\": 1e-3}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}");
}

static void test_first_difference_is_named(void **state)
{
    (void)state;
    assert_differs("{\"time_step\": 0.02, \"newton\": {\"tolerance\": 1e-3}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}",
                   "time_step");
    assert_differs("{\"time_step\": 0.01, \"newton\": {\"tolerance\": 1e-4}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}",
                   "newton.tolerance");
    assert_differs("{\"time_step\": 0.01, \"newton\": {}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}", "newton.tolerance");
    assert_differs("{\"time_step\": 0.01, \"newton\": {\"tolerance\": 1e-3}, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"c\"}]}",
                   "bodies.1.name");
    assert_differs("{\"time_step\": 0.01, \"newton\": {\"tolerance\": 1e-3}, \"bodies\": [{\"name\": \"a\"}]}", "bodies.1");
    assert_differs("{\"time_step\": 0.01, \"newton\": 3, \"bodies\": [{\"name\": \"a\"}, {\"name\": \"b\"}]}", "newton");
    assert_differs("[]", "");
}

/* The cap on events: who raises it wants to go on after a stall. Everything else of the block counts. */
static void test_the_method_asynchronous(void **state)
{
    (void)state;
    static const char one[] = "{\"method\": \"asynchronous\", \"asynchronous\": {\"thickness\": 1, \"events\": 5}, \"loads\": []}";
    char path[64];
    assert_true(cipc_scene_match(one, "{\"method\": \"asynchronous\", \"asynchronous\": {\"thickness\": 1, \"events\": 50}, \"loads\": []}", path, sizeof path));
    assert_false(cipc_scene_match(one, "{\"method\": \"asynchronous\", \"asynchronous\": {\"thickness\": 2, \"events\": 5}, \"loads\": []}", path, sizeof path));
    assert_string_equal(path, "asynchronous.thickness");
    assert_false(cipc_scene_match(one, "{\"method\": \"asynchronous\", \"asynchronous\": {\"thickness\": 1}, \"loads\": [{}]}", path, sizeof path));
    assert_string_equal(path, "loads.0");
    assert_false(cipc_scene_match(one, "{\"method\": \"asynchronous\", \"asynchronous\": {\"thickness\": 1}, \"loads\": [], \"events\": 1}", path, sizeof path));
    assert_string_equal(path, "events");
}

/* Of the method mass-spring its block and its colliders count; of no other, whose older scenes do not have them. */
static void test_the_method_mass_spring(void **state)
{
    (void)state;
    static const char one[] = "{\"method\": \"mass-spring\", \"mass_spring\": {\"step\": 1}, \"colliders\": [{\"name\": \"a\"}]}", older[] = "{\"method\": \"c-ipc\"}";
    char path[64];
    assert_false(cipc_scene_match(one, "{\"method\": \"mass-spring\", \"mass_spring\": {\"step\": 2}, \"colliders\": [{\"name\": \"a\"}]}", path, sizeof path));
    assert_string_equal(path, "mass_spring.step");
    assert_false(cipc_scene_match(one, "{\"method\": \"mass-spring\", \"mass_spring\": {\"step\": 1}, \"colliders\": [{\"name\": \"b\"}]}", path, sizeof path));
    assert_string_equal(path, "colliders.0.name");
    assert_true(cipc_scene_match(older, "{\"method\": \"c-ipc\", \"mass_spring\": {\"step\": 1}, \"colliders\": []}", path, sizeof path));
}

/* The block is of that method only, and an older program's scene does not have it. */
static void test_the_block_of_another_method(void **state)
{
    (void)state;
    static const char older[] = "{\"steps\": 1, \"method\": \"c-ipc\"}", newer[] = "{\"asynchronous\": {\"thickness\": 1}, \"loads\": [], \"method\": \"c-ipc\"}",
                      other[] = "{\"asynchronous\": {\"thickness\": 1}, \"loads\": [], \"method\": \"asynchronous\"}";
    char path[64];
    assert_true(cipc_scene_match(older, newer, path, sizeof path));
    assert_true(cipc_scene_match(newer, older, path, sizeof path));
    assert_true(cipc_scene_match("{}", "{\"asynchronous\": {}}", path, sizeof path)); /* c-ipc is the method of a scene that says nothing */
    assert_false(cipc_scene_match(newer, other, path, sizeof path));
    assert_string_equal(path, "method");
    assert_false(cipc_scene_match(other, newer, path, sizeof path));
    assert_string_equal(path, "method");
}

static void test_steps_count_below_the_root(void **state)
{
    (void)state;
    char path[64];
    assert_false(cipc_scene_match("{\"a\": {\"steps\": 1}}", "{\"a\": {\"steps\": 2}}", path, sizeof path));
    assert_string_equal(path, "a.steps");
}

static void test_text_that_is_not_json(void **state)
{
    (void)state;
    char path[64];
    assert_true(cipc_scene_match("plain", "plain", path, sizeof path));
    assert_false(cipc_scene_match("plain", "{}", path, sizeof path));
    assert_false(cipc_scene_match(base, "{", path, sizeof path));
}

static void test_long_path_is_cut(void **state)
{
    (void)state;
    char path[8];
    assert_false(cipc_scene_match("{\"newton\": {\"tolerance\": 1}}", "{\"newton\": {\"tolerance\": 2}}", path, sizeof path));
    assert_string_equal(path, "newton.");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_and_layout_do_not_matter), cmocka_unit_test(test_members_that_change_no_frame),
        cmocka_unit_test(test_first_difference_is_named),      cmocka_unit_test(test_steps_count_below_the_root),
        cmocka_unit_test(test_the_method_asynchronous), cmocka_unit_test(test_the_method_mass_spring),        cmocka_unit_test(test_the_block_of_another_method),
        cmocka_unit_test(test_text_that_is_not_json),          cmocka_unit_test(test_long_path_is_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
