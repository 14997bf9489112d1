/* Setting values by path, and size blocks. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>

#include "scene/overrides.h"
#include "support/scene_trial.h"

static const char text[] = "{\n"
                           "  \"steps\": 1, \"gravity\": [0, 1, 2],\n"
                           "  \"bodies\": [{\"name\": \"ball\", \"friction\": 0}, {\"name\": \"cloth\"}],\n"
                           "  \"sizes\": {\n"
                           "    \"comment\": \"none\",\n"
                           "    \"ci\": {\"steps\": 2},\n"
                           "    \"desk\": {\"comment\": \"big\", \"steps\": 3,\n"
                           "      \"bodies.cloth.offset\": \"x\"}\n"
                           "  }\n"
                           "}\n";

static scene_reader applied(int count, const char *const *overrides)
{
    scene_reader r = reader_of(text);
    scene_apply_overrides(&r, count, overrides);
    return r;
}

static const json_t *body(const scene_reader *r, size_t index)
{
    return json_array_get(json_object_get(r->root, "bodies"), index);
}

static void test_the_size_block_is_ci_by_default(void **state)
{
    (void)state;
    scene_reader r = applied(0, NULL);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(json_integer_value(json_object_get(r.root, "steps")), 2);
    assert_string_equal(json_string_value(json_object_get(r.root, "size")), "ci");
    assert_null(json_object_get(r.root, "sizes"));
    scene_reader_free(&r);
}

static void test_the_last_size_named_is_chosen_and_overrides_come_after_it(void **state)
{
    (void)state;
    const char *const overrides[] = {"steps=9", "size=ci", "size=desk"};
    scene_reader r = applied(3, overrides);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(json_integer_value(json_object_get(r.root, "steps")), 9);
    assert_string_equal(json_string_value(json_object_get(r.root, "size")), "desk");
    assert_string_equal(json_string_value(json_object_get(body(&r, 1), "offset")), "x");
    scene_reader_free(&r);
}

static void test_values_are_json_or_else_text(void **state)
{
    (void)state;
    const char *const overrides[] = {"bodies.cloth.material=wool",
                                     "bodies.cloth.offset=1e-3",
                                     "bodies.0.fixed=true",
                                     "gravity=[1, 2, 3]",
                                     "gravity.1=7",
                                     "title=\"5\"",
                                     "new.deep.key=false",
                                     "empty="};
    scene_reader r = applied(8, overrides);
    assert_int_equal(r.status, CIPC_OK);
    assert_string_equal(json_string_value(json_object_get(body(&r, 1), "material")), "wool");
    assert_true(json_real_value(json_object_get(body(&r, 1), "offset")) == 1e-3);
    assert_true(json_is_true(json_object_get(body(&r, 0), "fixed")));
    assert_int_equal(json_integer_value(json_array_get(json_object_get(r.root, "gravity"), 1)), 7);
    assert_string_equal(json_string_value(json_object_get(r.root, "title")), "5");
    assert_true(json_is_false(json_object_get(json_object_get(json_object_get(r.root, "new"), "deep"), "key")));
    assert_string_equal(json_string_value(json_object_get(r.root, "empty")), "");
    scene_reader_free(&r);
}

/* null takes a member away, in a size block too. */
static void test_null_takes_away(void **state)
{
    (void)state;
    const char *const overrides[] = {"bodies.ball.friction=null", "gravity=null", "fresh={\"a\": 1, \"b\": 2}", "fresh.a=null"};
    scene_reader r = applied(4, overrides);
    assert_int_equal(r.status, CIPC_OK);
    assert_null(json_object_get(body(&r, 0), "friction"));
    assert_null(json_object_get(r.root, "gravity"));
    assert_int_equal(json_object_size(json_object_get(r.root, "fresh")), 1);
    scene_cursor root = scene_root(r.root), bodies = scene_member(&root, "bodies"), ball = scene_element(&bodies, 0);
    scene_number(&r, &ball, "friction", SCENE_REQUIRED_NUMBER, scene_any); /* what is missing then is the override's doing */
    assert_rejection(&r, CIPC_E_MISSING_KEY, "--set bodies.ball.friction=null", "missing");
    scene_reader_free(&r);
    r = reader_of("{\"sizes\": {\"ci\": {\"a.b\": null}}, \"a\": {\"b\": 1, \"c\": 2}}");
    scene_apply_overrides(&r, 0, NULL);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(json_object_size(json_object_get(r.root, "a")), 1);
    scene_reader_free(&r);
}

static void assert_refused(const char *override, cipc_status status, const char *what)
{
    char place[300];
    scene_reader r = applied(1, &override);
    snprintf(place, sizeof place, "--set %s", override);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_bad_overrides(void **state)
{
    (void)state;
    assert_refused("steps", CIPC_E_USAGE, "must be PATH=VALUE");
    assert_refused("=1", CIPC_E_USAGE, "must be PATH=VALUE");
    assert_refused("bodies..x=1", CIPC_E_USAGE, "empty or overlong key");
    assert_refused("bodies.cloth.=1", CIPC_E_USAGE, "empty or overlong key");
    assert_refused("bodies.clot.offset=1", CIPC_E_USAGE, "no element 'clot'; the nearest is cloth");
    assert_refused("bodies.2.offset=1", CIPC_E_USAGE, "no element '2'");
    assert_refused("gravity.3=1", CIPC_E_USAGE, "no element '3'");
    assert_refused("bodies.ball.frction=null", CIPC_E_USAGE, "no key to take away called 'frction'; the nearest is friction");
    assert_refused("neither.there=null", CIPC_E_USAGE, "no key to take away called 'there'");
    assert_refused("steps.x=1", CIPC_E_USAGE, "neither an object nor an array");
    assert_refused("steps.x.y=1", CIPC_E_USAGE, "neither an object nor an array");
    assert_refused("gravity=[1, 2", CIPC_E_SYNTAX, "expected");
    assert_refused("new={\"a\": 1, \"a\": 2}", CIPC_E_SYNTAX, "duplicate");
    assert_refused("title=\377", CIPC_E_SYNTAX, "UTF-8");
    assert_refused("sizes.ci.steps=1", CIPC_E_USAGE, "size blocks cannot be overridden");
    assert_refused("size=huge", CIPC_E_USAGE, "unknown size 'huge'; known sizes: ci, desk");
}

static void test_bad_size_blocks(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"size\": \"a\", \"sizes\": {\n\"b\": {}}}");
    scene_apply_overrides(&r, 0, NULL);
    assert_rejection(&r, CIPC_E_USAGE, "t.json:1:15 sizes", "unknown size 'a'; known sizes: b");
    scene_reader_free(&r);
    r = reader_of("{\"sizes\": {\n\"ci\": 5}}");
    scene_apply_overrides(&r, 0, NULL);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:1 sizes.ci", "object of overrides");
    scene_reader_free(&r);
    r = reader_of("{\"sizes\": 5}");
    scene_apply_overrides(&r, 0, NULL);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:2 sizes", "object of named sizes");
    scene_reader_free(&r);
    r = reader_of("{\"sizes\": {\"ci\": {\n  \"bodies.x\": 1}}, \"bodies\": [{}]}");
    scene_apply_overrides(&r, 0, NULL);
    assert_rejection(&r, CIPC_E_USAGE, "t.json:2:3 sizes.ci.bodies.x", "no element 'x'");
    scene_reader_free(&r);
    const char *const size = "size=desk";
    r = reader_of("{\"steps\": 5}");
    scene_apply_overrides(&r, 1, &size);
    assert_rejection(&r, CIPC_E_USAGE, "--set size=desk", "has no sizes");
    scene_reader_free(&r);
}

/* An error about a value that an override has set is placed at the override, not at a line of the file. */
static void test_errors_name_the_override(void **state)
{
    (void)state;
    const char *const overrides[] = {"bodies.ball.friction=\"much\"", "newton={\"norm\": 3}", "bodes.x.y=1", "size=desk"};
    scene_reader r = applied(4, overrides);
    scene_cursor root = scene_root(r.root), bodies = scene_member(&root, "bodies"), ball = scene_element(&bodies, 0),
                 cloth = scene_element(&bodies, 1);
    scene_cursor newton = scene_member(&root, "newton"), wrong = scene_member(&root, "bodes");
    scene_number(&r, &ball, "friction", 0, scene_any);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "--set bodies.ball.friction=\"much\"", "a number");
    scene_string(&r, &newton, "norm", NULL);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "--set newton={\"norm\": 3} newton.norm", "a string");
    scene_reject(&r, &wrong, CIPC_E_UNKNOWN_KEY, "unknown");
    assert_rejection(&r, CIPC_E_UNKNOWN_KEY, "--set bodes.x.y=1 bodes", "unknown");
    scene_number(&r, &cloth, "offset", 0, scene_any);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:8:7 sizes.desk.bodies.cloth.offset", "a number");
    scene_string(&r, &ball, "name", NULL);
    scene_number(&r, &ball, "name", 0, scene_any);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:3:15 bodies.ball.name", "a number");
    scene_reader_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_size_block_is_ci_by_default),
        cmocka_unit_test(test_the_last_size_named_is_chosen_and_overrides_come_after_it),
        cmocka_unit_test(test_values_are_json_or_else_text),
        cmocka_unit_test(test_null_takes_away),
        cmocka_unit_test(test_bad_overrides),
        cmocka_unit_test(test_bad_size_blocks),
        cmocka_unit_test(test_errors_name_the_override),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
