/* Materials: names, factors, numbers, limits. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/shell_material.h"
#include "support/scene_trial.h"

static const scene_material_defaults plain = {.density = 1000, .thickness = 1e-3};

static cipc_material read_twice(const char *text, scene_material_defaults defaults)
{
    cipc_material first = {0}, second = {0};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_shell_material(&r, &root, &defaults, &first);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    defaults = plain; /* what the tree says now needs no defaults, and means the same */
    scene_read_shell_material(&r, &root, &defaults, &second);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(first.density == second.density && first.thickness == second.thickness && first.membrane == second.membrane);
    assert_true(first.membrane_young == second.membrane_young && first.membrane_poisson == second.membrane_poisson);
    assert_true(first.bending_young == second.bending_young && first.bending_poisson == second.bending_poisson);
    assert_true(first.hinge_constant == second.hinge_constant && first.strain_limit == second.strain_limit);
    assert_true(first.strain_activation == second.strain_activation && first.strain_stiffness == second.strain_stiffness);
    assert_true(first.strain_lower_limit == second.strain_lower_limit && first.strain_lower_activation == second.strain_lower_activation);
    assert_memory_equal(&first.orthotropic, &second.orthotropic, sizeof first.orthotropic);
    assert_null(json_object_get(r.root, "material"));
    scene_reader_free(&r);
    return first;
}

static void test_a_named_material_times_its_factors(void **state)
{
    (void)state;
    cipc_material m =
        read_twice("{\"material\": \"cotton\", \"membrane_factor\": 0.01, \"bending_factor\": 0.5, \"strain_limit\": \"material\"}", plain);
    assert_true(m.density == 472.641509 && m.thickness == 0.318e-3);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_NEO_HOOKEAN);
    assert_true(m.membrane_young == 0.01 * 0.821e6 && m.membrane_poisson == 0.243);
    assert_true(m.bending_young == 0.5 * 0.821e6 && m.bending_poisson == 0.243);
    assert_int_equal(m.hinge_constant, CIPC_HINGE_PLATE);
    assert_true(m.strain_limit == 1.0608 && m.strain_activation == 1 && m.strain_stiffness == 1e3);
}

static void test_numbers_win_over_the_name(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"material\": \"wool\", \"thickness\": 1e-3, \"membrane\": {\"model\": \"stvk\", \"young\": 5}, "
                                       "\"bending\": {\"constant\": \"cipc\"},"
                                       " \"strain_limit\": {\"activation\": 1.01, \"stiffness\": 7}}",
                                       plain);
    assert_true(m.thickness == 1e-3 && m.density == 413.380282);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_STVK);
    assert_true(m.membrane_young == 5 && m.membrane_poisson == 0.277);
    assert_true(m.bending_young == 0.170e6);
    assert_int_equal(m.hinge_constant, CIPC_HINGE_CIPC);
    assert_true(m.strain_limit == 1.085 && m.strain_activation == 1.01 && m.strain_stiffness == 7);
}

static void test_numbers_alone(void **state)
{
    (void)state;
    cipc_material m = read_twice(
        "{\"density\": 1, \"thickness\": 2, \"membrane\": {\"young\": 3, \"poisson\": 0.5}, \"bending\": {\"young\": 0}}", plain);
    assert_true(m.density == 1 && m.thickness == 2 && m.membrane_young == 3 && m.membrane_poisson == 0.5);
    assert_true(m.bending_young == 0 && m.strain_limit == 0);
    m = read_twice(
        "{\"density\": 1, \"thickness\": 2, \"membrane\": {\"model\": \"none\"}, \"bending\": {\"young\": 4, \"poisson\": -0.5}}", plain);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_NONE);
    assert_true(m.bending_young == 4 && m.bending_poisson == -0.5);
}

static void test_obstacles_need_nothing(void **state)
{
    (void)state;
    cipc_material m = read_twice("{}", (scene_material_defaults){.optional = true, .density = 8, .thickness = 9});
    assert_true(m.density == 8 && m.thickness == 9);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_NONE);
    assert_true(m.bending_young == 0 && m.strain_limit == 0);
}

static void test_released_hinges(void **state)
{
    (void)state;
    assert_int_equal(read_twice("{\"material\": \"cotton\"}", (scene_material_defaults){.released = true}).hinge_constant, CIPC_HINGE_CIPC);
    assert_int_equal(
        read_twice("{\"material\": \"cotton\", \"bending\": {\"constant\": \"plate\"}}", (scene_material_defaults){.released = true})
            .hinge_constant,
        CIPC_HINGE_PLATE);
}

/* The fabric gives density, thickness and bending by its shear modulus, which the membrane's factor does not multiply. */
static void test_a_fabric(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"denim\", \"factor\": 0.1}}", plain);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_ORTHOTROPIC);
    assert_true(m.density == 400 && m.thickness == 0.66e-3);
    assert_true(m.orthotropic.moduli[0] == 0.1 * 4.793e6 && m.orthotropic.moduli[3] == 0.1 * 2.448e6 && m.orthotropic.limits[2] == 0.05);
    assert_true(m.bending_young == 2.448e6 && m.bending_poisson == 0 && m.strain_limit == 0);
    m = read_twice("{\"density\": 7, \"thickness\": 8, \"bending_factor\": 0.5, \"membrane\": {\"model\": \"orthotropic\", \"fabric\": "
                   "\"silk\"}, \"strain_limit\": {\"limit\": 1.2}}",
                   plain);
    assert_true(m.density == 7 && m.thickness == 8 && m.bending_young == 0.5 * 0.57e6 && m.strain_limit == 1.2);
    m = read_twice("{\"bending\": {\"young\": 9, \"poisson\": 0.1}, \"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"silk\"}}", plain);
    assert_true(m.bending_young == 9 && m.bending_poisson == 0.1 && m.density == 83);
}

/* A named material beside moduli gives all but the membrane. */
static void test_an_orthotropic_membrane_of_numbers(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"material\": \"wool\", \"membrane\": {\"model\": \"orthotropic\", \"moduli\": [4, 1, 3, 2], \"limits\": "
                                 "[0.1, 0.2, 0.3]}}",
                                 plain);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_ORTHOTROPIC);
    assert_true(m.density == 413.380282 && m.bending_young == 0.170e6 && m.membrane_young == 0);
    assert_true(m.orthotropic.moduli[1] == 1 && m.orthotropic.limits[1] == 0.2);
}

/* Springs have one modulus; Poisson's ratio of a named material is not theirs. */
static void test_a_membrane_of_springs(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"density\": 7, \"thickness\": 8, \"membrane\": {\"model\": \"springs\", \"young\": 5}, \"bending\": {\"young\": 0}}", plain);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_SPRINGS);
    assert_true(m.membrane_young == 5 && m.membrane_poisson == 1.0 / 3);
    m = read_twice("{\"material\": \"cotton\", \"membrane_factor\": 0.5, \"membrane\": {\"model\": \"springs\"}}", plain);
    assert_int_equal(m.membrane, CIPC_MEMBRANE_SPRINGS);
    assert_true(m.membrane_young == 0.5 * 0.821e6 && m.membrane_poisson == 1.0 / 3 && m.bending_poisson == 0.243);
}

static void test_limits_of_compression(void **state)
{
    (void)state;
    cipc_material m = read_twice("{\"material\": \"wool\", \"strain_limit\": {\"limit\": 1.1, \"lower\": 0.7, \"lower_activation\": 0.75}}", plain);
    assert_true(m.strain_limit == 1.1 && m.strain_lower_limit == 0.7 && m.strain_lower_activation == 0.75);
    m = read_twice("{\"material\": \"wool\", \"strain_limit\": {\"lower\": 0.9}}", plain);
    assert_true(m.strain_limit == 1.085 && m.strain_lower_limit == 0.9 && m.strain_lower_activation == 1);
    m = read_twice("{\"density\": 1, \"thickness\": 2, \"membrane\": {\"young\": 3, \"poisson\": 0.5}, \"bending\": {\"young\": 0}, "
                   "\"strain_limit\": {\"lower\": 0.9, \"stiffness\": 5}}",
                   plain);
    assert_true(m.strain_limit == 0 && m.strain_lower_limit == 0.9 && m.strain_stiffness == 5);
}

static void assert_refused(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_material m = {0};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_shell_material(&r, &root, &plain, &m);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

#define NUMBERS "\"density\": 1, \"thickness\": 2, \"membrane\": {\"young\": 3, \"poisson\": 0.5}, \"bending\": {\"young\": 0}"

static void test_rejections(void **state)
{
    (void)state;
    assert_refused("{\"material\": \"coton\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 material",
                   "unknown material 'coton'; the nearest known one is 'cotton'");
    assert_refused("{\"material\": 3}", CIPC_E_WRONG_TYPE, "t.json:1:2 material", "a string");
    assert_refused("{}", CIPC_E_MISSING_KEY, "t.json:1:1 density", "missing");
    assert_refused("{\"density\": 1}", CIPC_E_MISSING_KEY, "t.json:1:1 thickness", "missing");
    assert_refused("{\"density\": 1, \"thickness\": -1}", CIPC_E_OUT_OF_RANGE, "t.json:1:16 thickness",
                   "is -1, but must be greater than 0");
    assert_refused("{\"density\": 0}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 density", "greater than 0");
    assert_refused("{\"density\": 1, \"thickness\": 2}", CIPC_E_MISSING_KEY, "t.json:1:1 membrane", "required where no material is named");
    assert_refused("{\"density\": 1, \"thickness\": 2, \"membrane\": {\"model\": \"none\"}}", CIPC_E_MISSING_KEY, "t.json:1:1 bending",
                   "required where");
    assert_refused("{\"density\": 1, \"thickness\": 2, \"membrane\": {\"young\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:32 membrane.poisson",
                   "missing");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"young\": 0}}", CIPC_E_OUT_OF_RANGE, "t.json:1:35 membrane.young",
                   "greater than 0");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"poisson\": 0.51}}", CIPC_E_OUT_OF_RANGE, "t.json:1:35 membrane.poisson",
                   "at most 0.5");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"model\": \"neohookean\"}}", CIPC_E_OUT_OF_RANGE, "t.json:1:35 membrane.model",
                   "'neo-hookean'");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"model\": \"springs\", \"poisson\": 0.3}}", CIPC_E_OUT_OF_RANGE, "t.json:1:55 membrane.poisson",
                   "springs make it 1/3: leave it out");
    assert_refused("{\"density\": 1, \"thickness\": 2, \"membrane\": {\"model\": \"springs\"}, \"bending\": {\"young\": 0}}", CIPC_E_MISSING_KEY,
                   "t.json:1:32 membrane.young", "missing");
    assert_refused("{\"material\": \"wool\", \"bending\": {\"constant\": \"paper\"}}", CIPC_E_OUT_OF_RANGE, "t.json:1:34 bending.constant",
                   "'plate'");
    assert_refused("{\"material\": \"wool\", \"bending\": {\"poisson\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:34 bending.poisson",
                   "greater than -1");
    assert_refused("{\"membrane_factor\": 2, " NUMBERS "}", CIPC_E_MISSING_KEY, "t.json:1:2 membrane_factor", "no 'material'");
    assert_refused("{\"material\": \"wool\", \"bending_factor\": -2}", CIPC_E_OUT_OF_RANGE, "t.json:1:22 bending_factor", "at least 0");
    assert_refused("{\"material\": \"wool\", \"bending_factor\": 2, \"bending\": {\"young\": 1}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:22 bending_factor", "cannot stand beside bending.young");
}

static void test_limits_are_rejected(void **state)
{
    (void)state;
    assert_refused("{\"material\": \"wool\", \"strain_limit\": {\"limit\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:39 strain_limit.limit",
                   "greater than 1");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": {\"limit\": 1.1, \"activation\": 1.1}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:53 strain_limit.activation", "less than 1.1");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": {\"activation\": 0.9}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:39 strain_limit.activation", "at least 1");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": {\"stiffness\": 0}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:39 strain_limit.stiffness", "greater than 0");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": {\"limt\": 1.1}}", CIPC_E_UNKNOWN_KEY, "t.json:1:39 strain_limit.limt",
                   "'limit'");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": true}", CIPC_E_WRONG_TYPE, "t.json:1:22 strain_limit",
                   "an object, \"material\" or false");
    assert_refused("{\"material\": \"wool\", \"strain_limit\": \"fabric\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:22 strain_limit", "'material'");
    assert_refused("{\"strain_limit\": {\"limit\": 1.1, \"lower\": 1}, " NUMBERS "}", CIPC_E_OUT_OF_RANGE, "t.json:1:33 strain_limit.lower", "less than 1");
    assert_refused("{\"strain_limit\": {\"lower\": 0.8, \"lower_activation\": 0.8}, " NUMBERS "}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:33 strain_limit.lower_activation", "greater than 0.8");
    assert_refused("{\"strain_limit\": {\"limit\": 1.1, \"lower_activation\": 0.8}, " NUMBERS "}", CIPC_E_MISSING_KEY,
                   "t.json:1:33 strain_limit.lower_activation", "there is no 'lower'");
    assert_refused("{\"strain_limit\": {\"lower\": 0.8, \"activation\": 1.1}, " NUMBERS "}", CIPC_E_MISSING_KEY,
                   "t.json:1:33 strain_limit.activation", "there is no 'limit'");
    assert_refused("{\"strain_limit\": {}, " NUMBERS "}", CIPC_E_MISSING_KEY, "t.json:1:2 strain_limit.limit", "missing");
    assert_refused("{\"strain_limit\": \"material\", " NUMBERS "}", CIPC_E_MISSING_KEY, "t.json:1:2 strain_limit", "no 'material'");
}

static void test_fabrics_are_rejected(void **state)
{
    (void)state;
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"silk\"}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:2 material", "cannot stand beside membrane.fabric");
    assert_refused("{\"membrane_factor\": 2, \"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"silk\"}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:2 membrane_factor", "use membrane.factor");
    assert_refused("{\"strain_limit\": \"material\", \"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"silk\"}}", CIPC_E_MISSING_KEY,
                   "t.json:1:2 strain_limit", "no 'material'");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"fabric\": \"silk\"}}", CIPC_E_UNKNOWN_KEY, "t.json:1:35 membrane.fabric",
                   "unknown key 'fabric'");
    assert_refused("{\"material\": \"wool\", \"membrane\": {\"model\": \"orthotropic\", \"young\": 1}}", CIPC_E_UNKNOWN_KEY,
                   "t.json:1:59 membrane.young", "unknown key 'young'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_named_material_times_its_factors),
        cmocka_unit_test(test_numbers_win_over_the_name),
        cmocka_unit_test(test_numbers_alone),
        cmocka_unit_test(test_obstacles_need_nothing),
        cmocka_unit_test(test_released_hinges),
        cmocka_unit_test(test_a_fabric),
        cmocka_unit_test(test_an_orthotropic_membrane_of_numbers),
        cmocka_unit_test(test_a_membrane_of_springs),
        cmocka_unit_test(test_limits_of_compression),
        cmocka_unit_test(test_rejections),
        cmocka_unit_test(test_limits_are_rejected),
        cmocka_unit_test(test_fabrics_are_rejected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
