/* The JSON printer: looks and round trip. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/base.h"
#include "scene/json_text.h"
#include "support/failing_memory.h"

static void test_layout(void **state)
{
    (void)state;
    json_t *value = json_loads("{\"a\":[1,2.5,\"x\"],\"b\":{},\"c\":[{\"d\":true}],\"e\":null,\"f\":[]}", 0, NULL);
    char *text = scene_json_text(value);
    assert_string_equal(
        text,
        "{\n  \"a\": [1, 2.5, \"x\"],\n  \"b\": {},\n  \"c\": [\n    {\n      \"d\": true\n    }\n  ],\n  \"e\": null,\n  \"f\": []\n}\n");
    cipc_free(text);
    json_decref(value);
}

static void test_reals_are_short_and_read_back_to_the_same_bits(void **state)
{
    (void)state;
    const double numbers[] = {0.04, 1.0 / 3, 0.1 + 0.2, 1e-3, 472.641509, 1, -0.0, 5e-324, 1.7976931348623157e308, 123456789012345680.0};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_t *value = json_pack("[f]", numbers[i]);
        char *text = scene_json_text(value);
        json_t *again = json_loads(text, 0, NULL);
        double read = json_real_value(json_array_get(again, 0));
        assert_true(read == numbers[i] && signbit(read) == signbit(numbers[i]));
        assert_true(json_is_real(json_array_get(again, 0)));
        cipc_free(text);
        json_decref(value);
        json_decref(again);
    }
    json_t *value = json_pack("[f]", 0.04);
    char *text = scene_json_text(value);
    assert_string_equal(text, "[0.04]\n");
    cipc_free(text);
    json_decref(value);
}

static void test_strings_are_escaped(void **state)
{
    (void)state;
    json_t *value = json_pack("{s:s}", "a\"\n", "\303\251\\");
    char *text = scene_json_text(value);
    json_t *again = json_loads(text, 0, NULL);
    assert_true(json_equal(value, again));
    cipc_free(text);
    json_decref(value);
    json_decref(again);
}

static void test_no_memory_gives_null(void **state)
{
    (void)state;
    json_t *value = json_pack("{s:[f,f,f],s:s}", "numbers", 1.0, 2.0, 3.0, "text", "a text that needs a second block");
    for (long n = 1;; n++) {
        fail_allocation(n);
        char *text = scene_json_text(value);
        cipc_free(text);
        if (!allocation_failed()) break;
        assert_null(text);
    }
    fail_allocation(0);
    json_decref(value);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_reals_are_short_and_read_back_to_the_same_bits),
        cmocka_unit_test(test_strings_are_escaped),
        cmocka_unit_test(test_no_memory_gives_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
