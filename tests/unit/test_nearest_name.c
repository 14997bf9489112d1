/* Edit distance and the name suggested. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/nearest_name.h"

static void test_distance_counts_edits(void **state)
{
    (void)state;
    assert_int_equal(scene_edit_distance("", ""), 0);
    assert_int_equal(scene_edit_distance("dhat", "dhat"), 0);
    assert_int_equal(scene_edit_distance("", "abc"), 3);
    assert_int_equal(scene_edit_distance("kitten", "sitting"), 3);
    assert_int_equal(scene_edit_distance("thicknes", "thickness"), 1);
    assert_int_equal(scene_edit_distance("tihckness", "thickness"), 1); /* neighbours swapped */
    assert_int_equal(scene_edit_distance("DHat", "dhat"), 0);
}

static void test_distance_is_symmetric(void **state)
{
    (void)state;
    const char *const names[] = {"", "a", "poisson", "young", "yuong", "motion"};
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 6; k++) assert_int_equal(scene_edit_distance(names[i], names[k]), scene_edit_distance(names[k], names[i]));
    }
}

static void test_long_names_are_cut(void **state)
{
    (void)state;
    char a[200], b[200];
    memset(a, 'a', sizeof a - 1);
    memset(b, 'b', sizeof b - 1);
    a[sizeof a - 1] = b[sizeof b - 1] = '\0';
    assert_int_equal(scene_edit_distance(a, b), 63);
}

static void test_nearest(void **state)
{
    (void)state;
    const char *const names[] = {"cotton", "wool", "lycra", "polyester"};
    assert_string_equal(scene_nearest_name("coton", names, 4), "cotton");
    assert_string_equal(scene_nearest_name("WOOLL", names, 4), "wool");
    assert_string_equal(scene_nearest_name("poly", names, 2), "wool");
    assert_null(scene_nearest_name("cotton", names, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distance_counts_edits),
        cmocka_unit_test(test_distance_is_symmetric),
        cmocka_unit_test(test_long_names_are_cut),
        cmocka_unit_test(test_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
