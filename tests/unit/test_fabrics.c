/* The table of fabrics and its names; every fabric is stable at rest. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/fabrics.h"

static void test_names_follow_the_table(void **state)
{
    (void)state;
    int count;
    const scene_fabric *table = scene_fabrics(&count);
    assert_int_equal(count, 5);
    for (int i = 0; i < count; i++) assert_string_equal(scene_fabric_names()[i], table[i].name);
    assert_null(scene_fabric_names()[count]);
}

/* Convex: a12^2 < a11 a22 (SPEC C.3); a thickness in metres; an areal density between a veil's and a rug's, if the density is kg/m^3. */
static void test_numbers_are_of_cloth(void **state)
{
    (void)state;
    int count;
    const scene_fabric *table = scene_fabrics(&count);
    for (int i = 0; i < count; i++) {
        const double *a = table[i].moduli;
        assert_true(a[0] > 0 && a[2] > 0 && a[3] > 0 && a[1] * a[1] < a[0] * a[2]);
        assert_true(table[i].thickness > 1e-4 && table[i].thickness < 2e-3);
        assert_true(table[i].density * table[i].thickness > 0.01 && table[i].density * table[i].thickness < 1);
        for (int k = 0; k < 3; k++) assert_true(table[i].limits[k] > 0 && table[i].limits[k] < 1);
    }
}

static void test_values_of_the_release(void **state)
{
    (void)state;
    int count;
    const scene_fabric *cotton = &scene_fabrics(&count)[0], *denim = &scene_fabrics(&count)[4];
    assert_true(cotton->density == 103.6 && cotton->thickness == 0.18e-3 && cotton->moduli[2] == 25.004e6 && cotton->limits[2] == 0.063);
    assert_true(denim->density == 400 && denim->thickness == 0.66e-3 && denim->moduli[1] == 4.515e6 && denim->limits[0] == 0.28);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_follow_the_table),
        cmocka_unit_test(test_numbers_are_of_cloth),
        cmocka_unit_test(test_values_of_the_release),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
