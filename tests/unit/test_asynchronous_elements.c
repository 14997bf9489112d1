/* Forces inside bodies: which elements there are, of which bodies; springs that make a membrane of the modulus asked for (SPEC A.8). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "support/element_crowd.h"

static void test_sets(void **state)
{
    (void)state;
    asynchronous_scene s;
    element_crowd(&s, 4, CIPC_CLOCKS_NESTED, 0);
    const asynchronous_set *sets = s.integrator->sets;
    assert_int_equal(sets[ASYNCHRONOUS_NEO_HOOKEAN].count, 18);
    assert_int_equal(sets[ASYNCHRONOUS_STVK].count, 0);
    assert_int_equal(sets[ASYNCHRONOUS_SPRINGS].count, 33); /* every edge of the sheet of springs */
    assert_int_equal(sets[ASYNCHRONOUS_HINGES].count, 2 * 21); /* those of the two sheets, not the floor's */
    assert_int_equal(sets[ASYNCHRONOUS_RODS].count, 3);
    assert_int_equal(sets[ASYNCHRONOUS_JOINTS].count, 2);
    assert_int_equal(sets[ASYNCHRONOUS_STITCHES].count, 1);
    assert_int_equal(sets[ASYNCHRONOUS_COROTATIONAL].count, 0);
    assert_int_equal(sets[ASYNCHRONOUS_VOLUME_NEO_HOOKEAN].count, 5);
    asynchronous_scene_free(&s);
}

/* A patch of equilateral triangles, stretched and sheared evenly by a little: energy per area as of plane stress with E t and nu = 1/3, in every direction. */
static void test_springs_make_a_membrane(void **state)
{
    (void)state;
    enum { N = 5 };
    const double young = 3e5, thickness = 2e-3, poisson = 1.0 / 3, small = 1e-5, L = 0.1;
    double rest[3 * (N + 1) * (N + 1)];
    int triangle[2 * N * N][3], count = 0;
    for (int i = 0; i < (N + 1) * (N + 1); i++) {
        const int row = i / (N + 1), column = i % (N + 1);
        const double p[3] = {L * (column + 0.5 * row), 0, L * sqrt(0.75) * row};
        v3_copy(rest + 3 * i, p);
    }
    for (int i = 0; i < N * N; i++) {
        const int at = i / N * (N + 1) + i % N;
        const int two[2][3] = {{at, at + 1, at + N + 1}, {at + 1, at + N + 2, at + N + 1}};
        memcpy(triangle[count], two, sizeof two);
        count += 2;
    }
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    cipc_material *m = &sheet_add_body(&s.sheet, "patch", (N + 1) * (N + 1), rest, count, (const int(*)[3])triangle)->material;
    m->membrane = CIPC_MEMBRANE_SPRINGS;
    m->membrane_young = young;
    m->membrane_poisson = 0.1; /* not heard: springs have 1/3 */
    m->thickness = thickness;
    m->bending_young = 0;
    asynchronous_scene_build(&s);
    static const double strains[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {0.3, -0.7, 0.9}}; /* e11, e22, e12 */
    for (size_t i = 0; i < sizeof strains / sizeof *strains; i++) {
        const double e11 = strains[i][0] * small, e22 = strains[i][1] * small, e12 = strains[i][2] * small, area = count * sqrt(3) / 4 * L * L;
        double x[3 * (N + 1) * (N + 1)];
        for (int n = 0; n < (N + 1) * (N + 1); n++) {
            const double *p = rest + 3 * n, q[3] = {(1 + e11) * p[0] + e12 * p[2], 0, e12 * p[0] + (1 + e22) * p[2]};
            v3_copy(x + 3 * n, q);
        }
        const double density = young * thickness / (2 * (1 - poisson * poisson)) * (e11 * e11 + e22 * e22 + 2 * poisson * e11 * e22 + 2 * (1 - poisson) * e12 * e12);
        assert_true(fabs(asynchronous_elements_energy(s.integrator, x) / (area * density) - 1) < 10 * small);
    }
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_springs_make_a_membrane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
