/* The table of named materials. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/materials.h"

static void test_names_and_rows_agree(void **state)
{
    (void)state;
    int count;
    const scene_material *table = scene_materials(&count);
    const char *const *names = scene_material_names();
    for (int i = 0; i < count; i++) assert_string_equal(names[i], table[i].name);
    assert_null(names[count]);
    assert_int_equal(count, 5);
}

/* Areal densities of woven fabric lie between 0.1 and 0.3 kg/m^2: a slip of a power of ten in density or thickness would show. */
static void test_numbers_are_those_of_cloth(void **state)
{
    (void)state;
    int count;
    const scene_material *table = scene_materials(&count);
    for (int i = 0; i < count; i++) {
        double areal = table[i].density * table[i].thickness;
        assert_true(areal > 0.1 && areal < 0.3);
        assert_true(table[i].poisson >= 0 && table[i].poisson <= 0.5);
        assert_true(table[i].strain_limit > 1 && table[i].strain_limit < 1.2);
        assert_true(table[i].young > 0);
        assert_true(strlen(table[i].source) > 0);
    }
    assert_true(table[0].density == 472.641509 && table[0].thickness == 0.318e-3 && table[0].young == 0.821e6 && table[0].poisson == 0.243);
    assert_true(table[0].strain_limit == 1.0608);
    assert_true(table[2].strain_limit == 1.134 && table[2].young == 0.076e6);
    assert_true(table[4].young == 3e9 && table[4].strain_limit == 1.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_and_rows_agree),
        cmocka_unit_test(test_numbers_are_those_of_cloth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
