/* Exactly one of several keys. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/alternatives.h"
#include "support/scene_trial.h"

static const char *const keys[] = {"box", "ball", "mesh", NULL};

static int choose(const char *text, cipc_status status, const char *place, const char *what)
{
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    int way = scene_one_of(&r, &root, keys);
    if (status == CIPC_OK)
        assert_int_equal(r.status, CIPC_OK);
    else
        assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
    return way;
}

static void test_the_one_key_is_found(void **state)
{
    (void)state;
    assert_int_equal(choose("{\"box\": 1}", CIPC_OK, "", ""), 0);
    assert_int_equal(choose("{\"other\": 1, \"mesh\": null}", CIPC_OK, "", ""), 2);
}

static void test_none_or_several(void **state)
{
    (void)state;
    assert_int_equal(choose("{\"other\": 1}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of box, ball, mesh"), -1);
    assert_int_equal(choose("{\"box\": 1, \"ball\": 1}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "has 2 of box, ball, mesh, but must have one"), -1);
}

static void test_a_long_list_is_cut(void **state)
{
    (void)state;
    char text[8];
    scene_list_names(keys, text, sizeof text);
    assert_string_equal(text, "box, ba");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_one_key_is_found),
        cmocka_unit_test(test_none_or_several),
        cmocka_unit_test(test_a_long_list_is_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
