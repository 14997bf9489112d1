/* The random shapes of the samplers: ranges, orthonormal rotations, placements that keep distances, the same bits from the same seed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "energy/samplers.h"

enum { DRAWS = 2000 };
static const double ROUNDINGS = 32 * DBL_EPSILON; /* some twenty operations on numbers of size one */

static gsl_rng *seeded(unsigned long seed)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, seed);
    return rng;
}

static void test_ranges_are_kept_and_filled(void **state)
{
    (void)state;
    gsl_rng *rng = seeded(1);
    int low_half = 0, low_decades = 0, seen[3] = {0};
    for (int i = 0; i < DRAWS; i++) {
        double uniform = energy_draw_uniform(rng, -1, 3), logarithmic = energy_draw_log(rng, 1e-6, 1);
        assert_true(uniform >= -1 && uniform <= 3);
        assert_true(logarithmic >= 1e-6 * (1 - ROUNDINGS) && logarithmic <= 1 + ROUNDINGS);
        low_half += uniform < 1;
        low_decades += logarithmic < 1e-3;
        seen[energy_draw_index(rng, 3)]++;
    }
    /* Binomial with standard deviation 22 (21 for thirds): five of them. */
    assert_true(abs(low_half - DRAWS / 2) < 110 && abs(low_decades - DRAWS / 2) < 110);
    for (int i = 0; i < 3; i++) assert_true(abs(seen[i] - DRAWS / 3) < 110);
    gsl_rng_free(rng);
}

static void test_rotations_are_orthonormal_and_right_handed(void **state)
{
    (void)state;
    gsl_rng *rng = seeded(2);
    for (int i = 0; i < DRAWS; i++) {
        double R[3][3], third[3];
        energy_draw_rotation(rng, R);
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) assert_true(fabs(v3_dot(R[a], R[b]) - (a == b)) < ROUNDINGS);
        }
        v3_cross(third, R[0], R[1]);
        assert_true(v3_dot(third, R[2]) > 0);
    }
    gsl_rng_free(rng);
}

static void test_placements_keep_distances_and_reach(void **state)
{
    (void)state;
    gsl_rng *rng = seeded(3);
    const double local[6] = {0, 0, 0, 1, 2, -2};
    for (int i = 0; i < DRAWS; i++) {
        double x[6], apart[3];
        energy_draw_placement(rng, 5, 2, local, x);
        v3_sub(apart, x + 3, x);
        assert_true(fabs(v3_norm(apart) - 3) < 8 * ROUNDINGS);
        for (int k = 0; k < 3; k++) assert_true(fabs(x[k]) <= 5);
    }
    gsl_rng_free(rng);
}

static void test_triangles_have_the_size_and_height_asked_for(void **state)
{
    (void)state;
    gsl_rng *rng = seeded(4);
    for (int i = 0; i < DRAWS; i++) {
        double rest[9];
        energy_draw_triangle(rng, 2, 0.05, rest);
        assert_true(rest[3] == 2 && rest[7] >= 0.1 * (1 - ROUNDINGS) && rest[7] <= 3 * (1 + ROUNDINGS));
    }
    gsl_rng_free(rng);
}

static void test_same_seed_gives_the_same_bits(void **state)
{
    (void)state;
    gsl_rng *a = seeded(5), *b = seeded(5);
    const double local[3] = {1, 2, 3};
    double x[3], y[3];
    energy_draw_placement(a, 1, 1, local, x);
    energy_draw_placement(b, 1, 1, local, y);
    assert_memory_equal(x, y, sizeof x);
    gsl_rng_free(a);
    gsl_rng_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranges_are_kept_and_filled),          cmocka_unit_test(test_rotations_are_orthonormal_and_right_handed),
        cmocka_unit_test(test_placements_keep_distances_and_reach), cmocka_unit_test(test_triangles_have_the_size_and_height_asked_for),
        cmocka_unit_test(test_same_seed_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
