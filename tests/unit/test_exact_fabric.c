/* The exact oracle of Green strains of woven cloth: strains known by hand, to one ulp, in directions that no double has. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"

static const double unit_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, along_x[3] = {2, 0, 0}, along_y[3] = {0, 0.125, 0}, none[3] = {0, 0, 0};

/* The strain's magnitude is this double exactly. */
static void assert_is(cipc_green_strain component, const double x[9], const double warp[3], const double weft[3], double strain)
{
    assert_int_equal(cipc_exact_compare_green_strain(component, unit_triangle, x, warp, weft, strain), 0);
    assert_int_equal(cipc_exact_compare_green_strain(component, unit_triangle, x, warp, weft, nextafter(strain, INFINITY)), 1);
    if (strain > 0) { assert_int_equal(cipc_exact_compare_green_strain(component, unit_triangle, x, warp, weft, nextafter(strain, 0)), -1); }
}

/* Stretched by 5/4 along x: (25/16 - 1)/2 = 9/32; compressed to 1/2 along y: -3/8. */
static void test_along_the_axes(void **state)
{
    (void)state;
    const double x[9] = {3, 4, 5, 4.25, 4, 5, 3, 4.5, 5};
    assert_is(CIPC_GREEN_WARP, x, along_x, along_y, 9. / 32);
    assert_is(CIPC_GREEN_WEFT, x, along_x, along_y, 3. / 8);
    assert_is(CIPC_GREEN_SHEAR, x, along_x, along_y, 0);
    assert_is(CIPC_GREEN_WARP, x, along_y, along_x, 3. / 8);
    assert_is(CIPC_GREEN_WEFT, x, along_x, none, 3. / 8); /* across the warp */
}

/* Simple shear by g: E12 = g/2, E22 = g^2/2. Along the diagonal x + y, whose unit vector is irrational: (g + g^2/2)/2, across it the same
 * with -g, between them E12 = (E22 - E11)/2 = g^2/4. */
static void test_shear(void **state)
{
    (void)state;
    const double g = 0.75, x[9] = {0, 0, 0, 1, 0, 0, g, 1, 0}, diagonal[3] = {1e-3, 1e-3, 0};
    assert_is(CIPC_GREEN_WARP, x, along_x, along_y, 0);
    assert_is(CIPC_GREEN_WEFT, x, along_x, along_y, g * g / 2);
    assert_is(CIPC_GREEN_SHEAR, x, along_x, along_y, g / 2);
    assert_is(CIPC_GREEN_WARP, x, diagonal, none, (g + g * g / 2) / 2);
    assert_is(CIPC_GREEN_WEFT, x, diagonal, none, (g - g * g / 2) / 2);
    assert_is(CIPC_GREEN_SHEAR, x, diagonal, none, g * g / 4);
}

/* What of a direction sticks out of the triangle's plane does not count; the plane may lie anywhere. */
static void test_projection(void **state)
{
    (void)state;
    const double out[3] = {2, 0, 77}, x[9] = {0, 0, 0, 1.25, 0, 0, 0, 1, 0};
    assert_is(CIPC_GREEN_WARP, x, out, along_y, 9. / 32);
    assert_is(CIPC_GREEN_WEFT, x, out, none, 0);
    const double rest[9] = {1, 1, 1, 4, 5, 1, 1, 1, 6}, now[9] = {0, 0, 0, 6.25, 0, 0, 0, 5, 0}, warp[3] = {7, 7, 0}; /* onto (3 4 0)/5 */
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, rest, now, warp, none, 9. / 32), 0);
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WEFT, rest, now, warp, none, 0), 0);
    const double away[3] = {0, 0, 1};
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, unit_triangle, x, away, along_y, 100), 0); /* nothing is below */
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_SHEAR, unit_triangle, x, along_x, away, 100), 0);
}

/* The strain in long double arithmetic, good to some digits. */
static long double plain_strain(cipc_green_strain component, const double rest[9], const double x[9], const double warp[3], const double weft[3])
{
    long double E[2][3], e[2][3], n[3], d[2][3], f[2][3], g[3];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 2; i++) {
            E[i][k] = (long double)rest[3 * i + 3 + k] - rest[k];
            e[i][k] = (long double)x[3 * i + 3 + k] - x[k];
        }
    }
    for (int k = 0; k < 3; k++) { n[k] = E[0][(k + 1) % 3] * E[1][(k + 2) % 3] - E[0][(k + 2) % 3] * E[1][(k + 1) % 3]; }
    for (int i = 0; i < 2; i++) {
        long double nn = 0, wn = 0, length = 0;
        for (int k = 0; k < 3; k++) {
            nn += n[k] * n[k];
            wn += n[k] * (i == 0 ? warp : weft)[k];
        }
        for (int k = 0; k < 3; k++) { d[i][k] = (i == 0 ? warp : weft)[k] - wn / nn * n[k]; }
        for (int k = 0; k < 3; k++) { length += d[i][k] * d[i][k]; }
        for (int k = 0; k < 3; k++) { d[i][k] /= sqrtl(length); }
        /* d = a E0 + b E1: by the cross products with the other edge. */
        long double a = 0, b = 0;
        for (int k = 0; k < 3; k++) {
            g[k] = d[i][(k + 1) % 3] * E[1][(k + 2) % 3] - d[i][(k + 2) % 3] * E[1][(k + 1) % 3];
            a += g[k] * n[k] / nn;
            b += (E[0][(k + 1) % 3] * d[i][(k + 2) % 3] - E[0][(k + 2) % 3] * d[i][(k + 1) % 3]) * n[k] / nn;
        }
        for (int k = 0; k < 3; k++) { f[i][k] = a * e[0][k] + b * e[1][k]; }
    }
    int i = component == CIPC_GREEN_WEFT, j = component != CIPC_GREEN_WARP;
    long double sum = 0;
    for (int k = 0; k < 3; k++) { sum += f[i][k] * f[j][k] - d[i][k] * d[j][k]; }
    return fabsl(sum) / 2;
}

static void test_against_long_doubles(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 3000; i++) {
        double rest[9], x[9], warp[3], weft[3];
        random_fill(&seed, rest, 9, 1);
        random_fill(&seed, x, 9, 1);
        random_fill(&seed, warp, 3, 1);
        random_fill(&seed, weft, 3, 1);
        cipc_green_strain component = (cipc_green_strain)(i % 3);
        double strain = (double)plain_strain(component, rest, x, warp, weft), room = 1e-9 * (1 + strain);
        assert_int_equal(cipc_exact_compare_green_strain(component, rest, x, warp, weft, strain + room), 1);
        if (strain > room) { assert_int_equal(cipc_exact_compare_green_strain(component, rest, x, warp, weft, strain - room), -1); }
        double axes[4], cosine, d[2][3];
        assert_true(cipc_exact_fabric_axes(rest, warp, weft, axes, &cosine));
        for (int k = 0; k < 6; k++) {
            d[k / 3][k % 3] = axes[k / 3 * 2] * (rest[3 + k % 3] - rest[k % 3]) + axes[k / 3 * 2 + 1] * (rest[6 + k % 3] - rest[k % 3]);
        }
        assert_true(fabs(norm3(d[0]) - 1) < 1e-9 && fabs(norm3(d[1]) - 1) < 1e-9);
        assert_true(fabs(d[0][0] * d[1][0] + d[0][1] * d[1][1] + d[0][2] * d[1][2] - cosine) < 1e-9);
    }
}

static void test_axes(void **state)
{
    (void)state;
    double axes[4], cosine;
    const double rest[9] = {0, 0, 0, 3, 0, 0, 0, 7, 0}, diagonal[3] = {1, 1, 0};
    assert_true(cipc_exact_fabric_axes(rest, diagonal, none, axes, &cosine));
    const double third = sqrt(0.5) / 3, seventh = sqrt(0.5) / 7;
    assert_true(fabs(axes[0] - third) <= 0x1p-52 * third && fabs(axes[1] - seventh) <= 0x1p-52 * seventh);
    assert_true(fabs(axes[2] + third) <= 0x1p-52 * third && fabs(axes[3] - seventh) <= 0x1p-52 * seventh && cosine == 0);
    assert_true(cipc_exact_fabric_axes(rest, along_x, diagonal, axes, &cosine));
    assert_true(axes[1] == 0 && fabs(axes[0] - 1. / 3) <= 0x1p-52 / 3 && fabs(cosine - sqrt(0.5)) <= 0x1p-52);
    const double away[3] = {0, 0, 1}, point[9] = {0}, bad[3] = {1, NAN, 0};
    assert_false(cipc_exact_fabric_axes(rest, away, along_x, axes, &cosine));
    assert_false(cipc_exact_fabric_axes(rest, along_x, away, axes, &cosine));
    assert_false(cipc_exact_fabric_axes(point, along_x, along_y, axes, &cosine));
    assert_false(cipc_exact_fabric_axes(rest, bad, along_y, axes, &cosine));
}

static void test_non_finite_proves_nothing(void **state)
{
    (void)state;
    double x[9];
    memcpy(x, unit_triangle, sizeof x);
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, unit_triangle, x, along_x, along_y, NAN), -1);
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, unit_triangle, x, along_x, along_y, INFINITY), -1);
    x[8] = NAN;
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, unit_triangle, x, along_x, along_y, 1), -1);
    assert_int_equal(cipc_exact_compare_green_strain(CIPC_GREEN_WARP, x, unit_triangle, along_x, along_y, 1), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_along_the_axes),
        cmocka_unit_test(test_shear),
        cmocka_unit_test(test_projection),
        cmocka_unit_test(test_against_long_doubles),
        cmocka_unit_test(test_axes),
        cmocka_unit_test(test_non_finite_proves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
