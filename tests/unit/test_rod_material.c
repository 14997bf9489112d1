/* Rods: stretching, bending and curvature at rest. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/rod_material.h"
#include "support/scene_trial.h"

static const scene_material_defaults plain = {.density = 1000, .thickness = 1e-3};

/* What the tree says after the first reading needs no defaults, and means the same. */
static cipc_material read_twice(const char *text, scene_material_defaults defaults)
{
    cipc_material first = {0}, second = {0};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_rod_material(&r, &root, &defaults, &first);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_read_rod_material(&r, &root, &plain, &second);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(first.density == second.density && first.thickness == second.thickness && first.young == second.young);
    assert_true(first.bending_young == second.bending_young && first.curved == second.curved);
    assert_null(json_object_get(r.root, "bending_factor"));
    scene_reader_free(&r);
    return first;
}

static void test_one_modulus_for_both(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"density\": 1300, \"diameter\": 8e-5, \"young\": 4e8}", plain);
    assert_true(m.density == 1300 && m.thickness == 8e-5 && m.young == 4e8 && m.bending_young == 4e8 && !m.curved);
}

static void test_bending_of_its_own(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"density\": 1, \"diameter\": 2, \"young\": 4e8, \"bending_factor\": 0.01}", plain);
    assert_true(m.young == 4e8 && m.bending_young == 0.01 * 4e8);
    m = read_twice("{\"density\": 1, \"diameter\": 2, \"young\": 4e8, \"bending\": {\"young\": 0}}", plain);
    assert_true(m.young == 4e8 && m.bending_young == 0);
    m = read_twice("{\"density\": 1, \"diameter\": 2, \"young\": 0, \"bending\": {\"young\": 5}}", plain);
    assert_true(m.young == 0 && m.bending_young == 5);
}

static void test_curvature_at_rest(void **state)
{
    (void)state;
    assert_true(read_twice("{\"density\": 1, \"diameter\": 2, \"young\": 3, \"rest_curvature\": \"rest\"}", plain).curved);
    assert_false(read_twice("{\"density\": 1, \"diameter\": 2, \"young\": 3, \"rest_curvature\": \"straight\"}", plain).curved);
}

static void test_obstacles_need_nothing(void **state)
{
    (void)state;
    cipc_material m = read_twice("{}", (scene_material_defaults){.optional = true, .density = 8, .thickness = 9});
    assert_true(m.density == 8 && m.thickness == 9 && m.young == 0 && m.bending_young == 0);
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_material m = {0};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_rod_material(&r, &root, &plain, &m);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{\"diameter\": 2, \"young\": 3}", CIPC_E_MISSING_KEY, "t.json:1:1 density", "missing");
    refuse("{\"density\": 1, \"young\": 3}", CIPC_E_MISSING_KEY, "t.json:1:1 diameter", "missing");
    refuse("{\"density\": 1, \"diameter\": 2}", CIPC_E_MISSING_KEY, "t.json:1:1 young", "missing");
    refuse("{\"density\": 1, \"diameter\": 2, \"young\": -1}", CIPC_E_OUT_OF_RANGE, "t.json:1:31 young", "at least 0");
    refuse("{\"density\": 1, \"diameter\": 2, \"young\": 1, \"bending\": {\"yung\": 1}}", CIPC_E_UNKNOWN_KEY, "t.json:1:55 bending.yung", "'young'");
    refuse("{\"density\": 1, \"diameter\": 2, \"young\": 1, \"bending_factor\": 2, \"bending\": {\"young\": 1}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:43 bending_factor", "cannot stand beside bending.young");
    refuse("{\"density\": 1, \"diameter\": 2, \"young\": 1, \"bending_factor\": -2}", CIPC_E_OUT_OF_RANGE, "t.json:1:43 bending_factor",
           "at least 0");
    refuse("{\"density\": 1, \"diameter\": 2, \"young\": 1, \"rest_curvature\": \"curly\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:43 rest_curvature",
           "unknown rest curvature 'curly'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_modulus_for_both),  cmocka_unit_test(test_bending_of_its_own), cmocka_unit_test(test_curvature_at_rest),
        cmocka_unit_test(test_obstacles_need_nothing), cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
