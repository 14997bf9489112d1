/* What materials of all kinds share: particles' two numbers, damping, factors, the choice of the kind's reader. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/material.h"
#include "support/scene_trial.h"

static const scene_material_defaults plain = {.density = 1000, .thickness = 1e-3};
static const scene_material_defaults obstacle = {.optional = true, .density = 8, .thickness = 9};

static cipc_material accept(const char *text, cipc_body_kind kind, const scene_material_defaults *defaults)
{
    cipc_material m;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_material(&r, &root, kind, defaults, &m);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return m;
}

static void refuse(const char *text, cipc_body_kind kind, cipc_status status, const char *place, const char *what)
{
    cipc_material m;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_material(&r, &root, kind, &plain, &m);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_every_kind_has_its_reader(void **state)
{
    (void)state;
    cipc_material m = accept("{\"material\": \"wool\"}", CIPC_BODY_SHELL, &plain);
    assert_true(m.membrane_young == 0.170e6 && m.young == 0);
    m = accept("{\"density\": 1, \"diameter\": 2, \"young\": 3}", CIPC_BODY_RODS, &plain);
    assert_true(m.thickness == 2 && m.young == 3 && m.membrane == CIPC_MEMBRANE_NONE);
    m = accept("{\"density\": 1, \"diameter\": 2}", CIPC_BODY_PARTICLES, &plain);
    assert_true(m.density == 1 && m.thickness == 2);
    m = accept("{\"density\": 1, \"young\": 2, \"poisson\": 0.25}", CIPC_BODY_VOLUME, &plain);
    assert_true(m.density == 1 && m.thickness == 0 && m.poisson == 0.25);
    m = accept("{}", CIPC_BODY_PARTICLES, &obstacle);
    assert_true(m.density == 8 && m.thickness == 9);
}

static void test_damping(void **state)
{
    (void)state;
    cipc_material m = accept("{\"density\": 1, \"diameter\": 2, \"damping\": {\"stiffness\": 0.5, \"mass\": 3}}", CIPC_BODY_PARTICLES, &plain);
    assert_true(m.damping_stiffness == 0.5 && m.damping_mass == 3);
    m = accept("{\"density\": 1, \"diameter\": 2, \"damping\": {\"mass\": 3}}", CIPC_BODY_PARTICLES, &plain);
    assert_true(m.damping_stiffness == 0 && m.damping_mass == 3);
    refuse("{\"density\": 1, \"diameter\": 2, \"damping\": {\"mass\": -3}}", CIPC_BODY_PARTICLES, CIPC_E_OUT_OF_RANGE, "t.json:1:43 damping.mass",
           "at least 0");
    refuse("{\"density\": 1, \"diameter\": 2, \"damping\": {\"stifness\": 3}}", CIPC_BODY_PARTICLES, CIPC_E_UNKNOWN_KEY,
           "t.json:1:43 damping.stifness", "'stiffness'");
    refuse("{\"density\": 1, \"diameter\": 2, \"damping\": 3}", CIPC_BODY_PARTICLES, CIPC_E_WRONG_TYPE, "t.json:1:31 damping", "an object");
}

static void test_particles_need_their_numbers(void **state)
{
    (void)state;
    refuse("{\"diameter\": 2}", CIPC_BODY_PARTICLES, CIPC_E_MISSING_KEY, "t.json:1:1 density", "missing");
    refuse("{\"density\": 1}", CIPC_BODY_PARTICLES, CIPC_E_MISSING_KEY, "t.json:1:1 diameter", "missing");
    refuse("{\"density\": 1, \"diameter\": 0}", CIPC_BODY_PARTICLES, CIPC_E_OUT_OF_RANGE, "t.json:1:16 diameter", "greater than 0");
}

static void test_factors(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"f\": 2, \"part\": {\"young\": 1}, \"g\": -1, \"other\": {}}");
    scene_cursor root = scene_root(r.root);
    assert_true(scene_read_factor(&r, &root, "f", "other", "wool") == 2);
    assert_true(scene_read_factor(&r, &root, "none", "other", NULL) == 1);
    assert_int_equal(r.status, CIPC_OK);
    scene_read_factor(&r, &root, "f", "other", NULL);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:2 f", "no 'material'");
    scene_read_factor(&r, &root, "f", "part", "wool");
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:2 f", "cannot stand beside part.young");
    scene_read_factor(&r, &root, "g", "other", "wool");
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:32 g", "at least 0");
    scene_reader_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_kind_has_its_reader),
        cmocka_unit_test(test_damping),
        cmocka_unit_test(test_particles_need_their_numbers),
        cmocka_unit_test(test_factors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
