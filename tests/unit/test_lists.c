/* Arrays of numbers, integers and points. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/lists.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

static void test_numbers_and_integers(void **state)
{
    (void)state;
    double numbers[2];
    int integers[3];
    scene_reader r = reader_of("{\"a\": [1.5, 2], \"b\": [3, 4, 5]}");
    scene_cursor root = scene_root(r.root);
    scene_numbers(&r, &root, "a", 2, scene_positive, numbers);
    scene_integers(&r, &root, "b", 3, 3, 5, integers);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(numbers[0] == 1.5 && numbers[1] == 2);
    assert_true(integers[0] == 3 && integers[1] == 4 && integers[2] == 5);
    scene_numbers(&r, &root, "c", 2, scene_positive, numbers);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 c", "an array of 2 numbers");
    scene_numbers(&r, &root, "b", 2, scene_positive, numbers);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:17 b", "has 3 elements, but must have 2");
    assert_true(numbers[0] == 0 && numbers[1] == 0);
    scene_integers(&r, &root, "a", 2, 0, 9, integers);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:8 a.0", "an integer");
    scene_integers(&r, &root, "b", 3, 0, 4, integers);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:29 b.2", "at most 4");
    scene_integers(&r, &root, "c", 3, 0, 4, integers);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 c", "an array of 3 integers");
    scene_reader_free(&r);
}

static void test_points(void **state)
{
    (void)state;
    int count;
    scene_reader r = reader_of("{\"a\": [[1, 2], [3, 4], [5, 6]], \"b\": [[1, 2], [3]], \"c\": [[1, \"x\"]]}");
    scene_cursor root = scene_root(r.root);
    double *points = scene_points(&r, &root, "a", 2, 1, 3, &count);
    assert_non_null(points);
    assert_int_equal(count, 3);
    assert_true(points[0] == 1 && points[3] == 4 && points[5] == 6);
    cipc_free(points);
    assert_null(scene_points(&r, &root, "a", 2, 4, 9, &count));
    assert_int_equal(count, 0);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:2 a", "at least 4");
    assert_null(scene_points(&r, &root, "b", 2, 1, 9, &count));
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:47 b.1", "has 1 elements, but must have 2");
    assert_null(scene_points(&r, &root, "c", 2, 1, 9, &count));
    assert_rejection(&r, CIPC_E_WRONG_TYPE, "t.json:1:63 c.0.1", "a number");
    assert_null(scene_points(&r, &root, "d", 2, 1, 9, &count));
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 d", "an array of points");
    fail_allocation(1);
    assert_null(scene_points(&r, &root, "a", 2, 1, 9, &count));
    fail_allocation(0);
    assert_rejection(&r, CIPC_E_OUT_OF_MEMORY, "t.json:1:2 a", "no memory");
    scene_reader_free(&r);
}

static void test_integer_lists(void **state)
{
    (void)state;
    int count;
    scene_reader r = reader_of("{\"a\": [1, 2, 9]}");
    scene_cursor root = scene_root(r.root);
    int *list = scene_integer_list(&r, &root, "a", 0, 9, 1, 9, &count);
    assert_non_null(list);
    assert_true(count == 3 && list[0] == 1 && list[2] == 9);
    cipc_free(list);
    assert_null(scene_integer_list(&r, &root, "a", 0, 8, 1, 9, &count));
    assert_int_equal(count, 0);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:14 a.2", "at most 8");
    assert_null(scene_integer_list(&r, &root, "b", 0, 8, 1, 9, &count));
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 b", "an array of integers");
    fail_allocation(1);
    assert_null(scene_integer_list(&r, &root, "a", 0, 9, 1, 9, &count));
    fail_allocation(0);
    assert_rejection(&r, CIPC_E_OUT_OF_MEMORY, "t.json:1:2 a", "no memory");
    scene_reader_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_and_integers),
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_integer_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
