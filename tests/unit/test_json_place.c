/* Line and column of a path in a JSON text. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/json_place.h"

static const char text[] = "{\n"
                           "  \"a\": 1, \"b\": [10, {\"c\": \"x\"}],\n"
                           "  \"\303\251\": \"}]\\\"\", \"d\": {\"a\": {}}\n"
                           "}\n";

static void assert_place(const scene_step *steps, int count, int line, int column, int matched)
{
    scene_place place = scene_find_place(text, strlen(text), steps, count);
    assert_int_equal(place.line, line);
    assert_int_equal(place.column, column);
    assert_int_equal(place.matched, matched);
}

static void test_members_are_placed_at_their_key(void **state)
{
    (void)state;
    assert_place((scene_step[]){{"a", 0}}, 1, 2, 3, 1);
    assert_place((scene_step[]){{"b", 0}}, 1, 2, 11, 1);
    assert_place((scene_step[]){{"b", 0}, {NULL, 1}, {"c", 0}}, 3, 2, 22, 3);
    assert_place((scene_step[]){{"d", 0}, {"a", 0}}, 2, 3, 22, 2);
}

static void test_elements_are_placed_at_their_value(void **state)
{
    (void)state;
    assert_place((scene_step[]){{"b", 0}, {NULL, 0}}, 2, 2, 17, 2);
    assert_place((scene_step[]){{"b", 0}, {NULL, 1}}, 2, 2, 21, 2);
}

static void test_columns_count_characters_not_bytes(void **state)
{
    (void)state;
    assert_place((scene_step[]){{"\303\251", 0}}, 1, 3, 3, 1);
    assert_place((scene_step[]){{"d", 0}}, 1, 3, 16, 1); /* one more if the bytes of the accented letter were counted */
}

static void test_a_missing_step_gives_what_lacks_it(void **state)
{
    (void)state;
    assert_place(NULL, 0, 1, 1, 0);
    assert_place((scene_step[]){{"z", 0}}, 1, 1, 1, 0);
    assert_place((scene_step[]){{"b", 0}, {NULL, 2}}, 2, 2, 11, 1);
    assert_place((scene_step[]){{"b", 0}, {NULL, 1}, {"z", 0}}, 3, 2, 21, 2);
    assert_place((scene_step[]){{"a", 0}, {"z", 0}}, 2, 2, 3, 1);
}

/* Whatever is cut off, the scanner stays inside the text: run under a sanitizer this test also checks the reads. */
static void test_cut_texts_are_survived(void **state)
{
    (void)state;
    const scene_step steps[] = {{"b", 0}, {NULL, 1}, {"c", 0}};
    for (size_t length = 0; length < strlen(text); length++) {
        scene_place place = scene_find_place(text, length, steps, 3);
        assert_in_range(place.matched, 0, 3);
        assert_in_range(place.line, 1, 4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_members_are_placed_at_their_key),
        cmocka_unit_test(test_elements_are_placed_at_their_value),
        cmocka_unit_test(test_columns_count_characters_not_bytes),
        cmocka_unit_test(test_a_missing_step_gives_what_lacks_it),
        cmocka_unit_test(test_cut_texts_are_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
