/* Typed reading: values, defaults written into the tree, rejections with their place. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>

#include "support/scene_trial.h"

static const double zero[3] = {0, 0, 0};

static void test_values_are_read(void **state)
{
    (void)state;
    scene_reader r =
        reader_of("{\"n\": 2, \"x\": 1.5, \"b\": true, \"v\": [1, 2.5, 3], \"s\": \"text\", \"c\": \"two\", \"t\": \"never\", \"u\": 3}");
    static const char *const names[] = {"one", "two", NULL};
    scene_cursor root = scene_root(r.root);
    double v[3];
    assert_int_equal(scene_integer(&r, &root, "n", 0, 0, 9), 2);
    assert_true(scene_number(&r, &root, "n", 0, scene_positive) == 2);
    assert_true(scene_number(&r, &root, "x", 0, scene_positive) == 1.5);
    assert_true(scene_boolean(&r, &root, "b", false));
    scene_vector(&r, &root, "v", zero, v);
    assert_true(v[0] == 1 && v[1] == 2.5 && v[2] == 3);
    assert_string_equal(scene_string(&r, &root, "s", NULL), "text");
    assert_int_equal(scene_choice(&r, &root, "c", "number", names, 0), 1);
    assert_true(isinf(scene_time_or_never(&r, &root, "t")));
    assert_true(scene_time_or_never(&r, &root, "u") == 3);
    assert_int_equal(r.status, CIPC_OK);
    scene_reader_free(&r);
}

static void test_absent_values_get_their_default_and_leave_it_in_the_tree(void **state)
{
    (void)state;
    scene_reader r = reader_of("{}");
    static const char *const names[] = {"one", "two", NULL};
    static const double fallback[3] = {1, 2, 3};
    scene_cursor root = scene_root(r.root);
    double v[3];
    assert_true(scene_number(&r, &root, "x", 0.25, scene_positive) == 0.25);
    assert_int_equal(scene_integer(&r, &root, "n", 7, 0, 9), 7);
    assert_false(scene_boolean(&r, &root, "b", false));
    scene_vector(&r, &root, "v", fallback, v);
    assert_true(v[2] == 3);
    assert_string_equal(scene_string(&r, &root, "s", "d"), "d");
    assert_int_equal(scene_choice(&r, &root, "c", "number", names, 1), 1);
    assert_true(isinf(scene_time_or_never(&r, &root, "t")));
    scene_object_member(&r, &root, "o");
    scene_array_member(&r, &root, "a");
    json_t *want = json_loads("{\"x\": 0.25, \"n\": 7, \"b\": false, \"v\": [1.0, 2.0, 3.0], \"s\": \"d\", \"c\": \"two\", \"t\": "
                              "\"never\", \"o\": {}, \"a\": []}",
                              0, NULL);
    assert_true(json_equal(r.root, want));
    json_decref(want);
    scene_reader_free(&r);
}

static void test_wrong_types(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"a\": \"1\",\n \"b\": 1, \"c\": [1, \"x\", 2], \"d\": {}, \"e\": 1.5, \"f\": null}");
    static const char *const names[] = {"one", NULL};
    scene_cursor root = scene_root(r.root), c = scene_member(&root, "c");
    double v[3];
    scene_number(&r, &root, "a", 0, scene_any);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:2 a", "must be a number, but is a string");
    scene_boolean(&r, &root, "b", true);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:2 b", "must be true or false, but is an integer");
    scene_vector(&r, &root, "c", zero, v);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:19 c.1", "must be a number");
    scene_string(&r, &root, "d", NULL);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:28 d", "must be a string, but is an object");
    scene_integer(&r, &root, "e", 0, 0, 9);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:37 e", "must be an integer, but is a real number");
    scene_time_or_never(&r, &root, "f");
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:47 f", "but is null");
    scene_is_object(&r, &c, names);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:10 c", "must be an object, but is an array");
    scene_is_array(&r, &root, 0, 1);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:1", "must be an array, but is an object");
    scene_reader_free(&r);
}

static void test_ranges(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"a\": 0, \"b\": -1, \"c\": 1, \"d\": 9, \"e\": [1, 2]}");
    scene_cursor root = scene_root(r.root), e = scene_member(&root, "e");
    scene_number(&r, &root, "a", 1, scene_positive);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:2 a", "is 0, but must be greater than 0");
    assert_true(scene_number(&r, &root, "a", 1, scene_not_negative) == 0);
    scene_number(&r, &root, "b", 1, scene_not_negative);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:10 b", "is -1, but must be at least 0");
    scene_number(&r, &root, "c", 1, (scene_range){0, 1, true, true});
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:19 c", "must be greater than 0 and less than 1");
    scene_number(&r, &root, "d", 1, (scene_range){-INFINITY, 8, true, false});
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:27 d", "must be at most 8");
    scene_integer(&r, &root, "d", 1, 1, 8);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:27 d", "is 9, but must be at least 1 and at most 8");
    scene_integer(&r, &root, "b", 1, 0, INT_MAX);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:10 b", "is -1, but must be at least 0");
    assert_false(scene_is_array(&r, &e, 3, 3));
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:35 e", "has 2 elements, but must have 3");
    assert_false(scene_is_array(&r, &e, 3, 9));
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:35 e", "at least 3");
    assert_false(scene_is_array(&r, &e, 0, 1));
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:35 e", "at most 1");
    scene_reader_free(&r);
}

static void test_missing_and_unknown(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"o\": {\"densty\": 1},\n \"p\": {\"comment\": 1}, \"q\": {\"comment\": \"fine\"}, \"c\": \"tow\"}");
    static const char *const keys[] = {"thickness", "density", NULL}, *const names[] = {"one", "two", NULL};
    scene_cursor root = scene_root(r.root), o = scene_member(&root, "o"), p = scene_member(&root, "p"), q = scene_member(&root, "q");
    scene_number(&r, &o, "density", SCENE_REQUIRED_NUMBER, scene_any);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:2 o.density", "required, but missing: a number");
    assert_false(scene_is_object(&r, &o, keys));
    assert_rejection(&r, CIPC_E_UNKNOWN_KEY, "t.json:1:8 o.densty", "unknown key 'densty'; the nearest known key is 'density'");
    assert_false(scene_is_object(&r, &p, keys));
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:2:8 p.comment", "must be a string");
    assert_true(scene_is_object(&r, &q, keys));
    scene_choice(&r, &root, "c", "number", names, 0);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:2:49 c", "unknown number 'tow'; the nearest known one is 'two'");
    scene_choice(&r, &root, "d", "number", names, SCENE_REQUIRED);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 d", "missing");
    scene_reader_free(&r);
}

static void test_the_first_rejection_sticks(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"a\": \"x\", \"b\": \"y\"}");
    scene_cursor root = scene_root(r.root);
    scene_number(&r, &root, "a", 1, scene_any);
    scene_number(&r, &root, "b", 1, scene_any);
    scene_number(&r, &root, "c", 1, scene_any);
    assert_null(json_object_get(r.root, "c"));
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:2 a", "a number");
    scene_reader_free(&r);
}

static void test_a_long_file_name_does_not_push_out_the_place(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"a\": \"x\"}");
    char name[1200];
    for (size_t i = 0; i < sizeof name - 1; i++) name[i] = 'p';
    name[sizeof name - 1] = '\0';
    r.path = name;
    scene_cursor root = scene_root(r.root);
    scene_number(&r, &root, "a", 1, scene_any);
    char want[256];
    snprintf(want, sizeof want, "%.200s:1:2 a", name);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, want, "a number");
    scene_reader_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_read),
        cmocka_unit_test(test_absent_values_get_their_default_and_leave_it_in_the_tree),
        cmocka_unit_test(test_wrong_types),
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_missing_and_unknown),
        cmocka_unit_test(test_the_first_rejection_sticks),
        cmocka_unit_test(test_a_long_file_name_does_not_push_out_the_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
