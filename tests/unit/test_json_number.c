/* Doubles through JSON and back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/json_number.h"

static double there_and_back(double value)
{
    char text[64];
    json_t *array = json_array();
    assert_int_equal(json_array_append_new(array, cipc_json_number(value)), 0);
    size_t length = json_dumpb(array, text, sizeof text, CIPC_JSON_FORMAT);
    assert_in_range(length, 1, sizeof text);
    json_decref(array);
    array = json_loadb(text, length, 0, NULL);
    assert_non_null(array);
    double result = cipc_json_double(json_array_get(array, 0));
    json_decref(array);
    return result;
}

static void test_same_bits_back(void **state)
{
    (void)state;
    const double values[] = {0.0,      -0.0,     1.0, 0.1, -1.0 / 3, DBL_MAX, -DBL_MAX, DBL_MIN, DBL_TRUE_MIN, 1e22, 123456789012345678.0,
                             INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        const double back = there_and_back(values[i]);
        assert_memory_equal(&back, &values[i], sizeof back);
    }
    assert_true(isnan(there_and_back(NAN)));
}

static void test_what_is_no_number(void **state)
{
    (void)state;
    json_t *text = json_string("infinite"), *integer = json_integer(7);
    assert_true(isnan(cipc_json_double(text)));
    assert_true(isnan(cipc_json_double(NULL)));
    assert_true(cipc_json_double(integer) == 7);
    json_decref(text);
    json_decref(integer);
}

static void test_put_notices_a_missing_value(void **state)
{
    (void)state;
    bool good = true;
    json_t *object = json_object();
    cipc_json_put(object, "a", cipc_json_number(1), &good);
    assert_true(good);
    cipc_json_put(object, "b", NULL, &good);
    assert_false(good);
    cipc_json_put(object, "c", cipc_json_number(1), &good);
    assert_false(good); /* a failure is not forgotten */
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits_back),
        cmocka_unit_test(test_what_is_no_number),
        cmocka_unit_test(test_put_notices_a_missing_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
