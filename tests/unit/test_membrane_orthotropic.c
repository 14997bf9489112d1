/* Orthotropic membrane: directions, exact energies, forces, the rest stiffness, the three limits (SPEC C.3). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

enum { SIZE = 9 };

/* Some twenty operations on numbers of size one. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static const double rest[SIZE] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, x_axis[3] = {1, 0, 0};
static const double moduli[4] = {16, 4, 8, 2}, limits[3] = {0.5, 0.25, 0.125};

/* Warp along x, weft along y, volume 1/2. */
static cipc_orthotropic cloth(void)
{
    cipc_orthotropic p;
    assert_true(cipc_orthotropic_init(&p, rest, 1, x_axis, NULL, moduli, limits));
    return p;
}

/* f1 = (a, 0, 0) and f2 = (b, c, 0). */
static const double *strained(double a, double b, double c, double x[SIZE])
{
    const double made[SIZE] = {0, 0, 0, a, 0, 0, b, c, 0};
    for (int i = 0; i < SIZE; i++) x[i] = made[i];
    return x;
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static double eta(double q, double Q)
{
    return -Q * log((Q - q) / Q);
}

static void test_axes(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    assert_true(p.warp[0] == 1 && p.warp[1] == 0 && p.weft[0] == 0 && p.weft[1] == 1);
    assert_true(p.rest_cosine == 0 && p.volume == 0.5);
    assert_true(p.a11 == 16 && p.a12 == 4 && p.a22 == 8 && p.g12 == 2);
    assert_true(p.limit11 == 0.5 && p.limit22 == 0.25 && p.limit12 == 0.125);
}

/* Whatever length the directions have, and however they stick out of the plane, they are unit vectors in it. */
static void test_directions_are_projected(void **state)
{
    (void)state;
    cipc_orthotropic p;
    const double warp[3] = {3, 4, 7}, weft[3] = {0, 2, -5};
    assert_true(cipc_orthotropic_init(&p, rest, 1, warp, weft, moduli, limits));
    assert_relative(p.warp[0], 0.6, ROUNDINGS);
    assert_relative(p.warp[1], 0.8, ROUNDINGS);
    assert_true(fabs(p.weft[0]) <= ROUNDINGS);
    assert_relative(p.weft[1], 1, ROUNDINGS);
    assert_relative(p.rest_cosine, 0.8, ROUNDINGS);
}

/* In a plane askew in space, with a skew triangle: the images at rest are unit vectors at the angle asked for. */
static void test_directions_of_a_triangle_in_space(void **state)
{
    (void)state;
    const double placed[SIZE] = {1, 2, 3, 1.5, 2.25, 3.5, 0.75, 2.5, 2}, warp[3] = {1, -2, 0.5}, weft[3] = {0.5, 1, 3};
    for (int given = 0; given < 2; given++) {
        cipc_orthotropic p;
        double f[2][3];
        assert_true(cipc_orthotropic_init(&p, placed, 1, warp, given ? weft : NULL, moduli, limits));
        for (int k = 0; k < 3; k++) {
            double d1 = placed[3 + k] - placed[k], d2 = placed[6 + k] - placed[k];
            f[0][k] = p.warp[0] * d1 + p.warp[1] * d2;
            f[1][k] = p.weft[0] * d1 + p.weft[1] * d2;
        }
        double w1 = 0, w2 = 0, cosine = 0, along = 0;
        for (int k = 0; k < 3; k++) {
            w1 += f[0][k] * f[0][k];
            w2 += f[1][k] * f[1][k];
            cosine += f[0][k] * f[1][k];
            along += f[0][k] * warp[k];
        }
        assert_relative(w1, 1, ROUNDINGS);
        assert_relative(w2, 1, ROUNDINGS);
        assert_true(along > 0 && fabs(cosine - p.rest_cosine) <= ROUNDINGS);
        assert_true(given || p.rest_cosine == 0);
        double g[SIZE];
        cipc_membrane_orthotropic_gradient(placed, &p, g);
        assert_true(cipc_membrane_orthotropic_value(placed, &p) <= p.volume * p.a11 * ROUNDINGS * ROUNDINGS);
        for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i]) <= p.volume * p.a11 * 4 * ROUNDINGS); /* weights of up to 4 per metre */
    }
}

static void test_what_has_no_directions_is_refused(void **state)
{
    (void)state;
    const double line[SIZE] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, z_axis[3] = {0, 0, 1}, twice[3] = {-2, 0, 1}, zero[3] = {0}, nan[3] = {NAN, 0, 0};
    cipc_orthotropic p = {.volume = 7};
    assert_false(cipc_orthotropic_init(&p, line, 1, x_axis, NULL, moduli, limits));
    assert_false(cipc_orthotropic_init(&p, rest, 1, z_axis, NULL, moduli, limits));
    assert_false(cipc_orthotropic_init(&p, rest, 1, x_axis, z_axis, moduli, limits));
    assert_false(cipc_orthotropic_init(&p, rest, 1, x_axis, twice, moduli, limits));
    assert_false(cipc_orthotropic_init(&p, rest, 1, zero, NULL, moduli, limits));
    assert_false(cipc_orthotropic_init(&p, rest, 1, nan, NULL, moduli, limits));
    assert_true(p.volume == 7 && p.a11 == 0); /* untouched */
}

/* f1 = (1.25, 0), f2 = (0.125, c): E11 = 0.28125, E12 = 0.078125. */
static void test_energy_of_strains(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    double x[SIZE], e11 = 0.28125, e12 = 0.5 * 1.25 * 0.125;
    const double lengths[] = {0.75, 1.125}; /* weft shorter and longer: the mixed term of either sign */
    for (int i = 0; i < 2; i++) {
        double e22 = 0.5 * (0.015625 + lengths[i] * lengths[i] - 1);
        double density = 8 * eta(e11 * e11, 0.25) + 4 * eta(e11 * e22, 0.125) + 4 * eta(e22 * e22, 0.0625) + 2 * eta(e12 * e12, 0.015625);
        assert_relative(cipc_membrane_orthotropic_value(strained(1.25, 0.125, lengths[i], x), &p), 0.5 * density, ROUNDINGS);
    }
}

/* Far from the limits it is the quadratic a11/2 E11^2 + a12 E11 E22 + a22/2 E22^2 + g12 E12^2; the terms beyond are E^2/L^2 of it. */
static void test_small_strains(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    double x[SIZE], t = 0x1p-20;
    assert_relative(cipc_membrane_orthotropic_value(strained(1 + t, 0, 1, x), &p), 0.5 * 8 * t * t, 4 * t);
    assert_relative(cipc_membrane_orthotropic_value(strained(1, 0, 1 + t, x), &p), 0.5 * 4 * t * t, 4 * t);
    assert_relative(cipc_membrane_orthotropic_value(strained(1, 2 * t, 1, x), &p), 0.5 * 2 * t * t, 64 * t);
    assert_relative(cipc_membrane_orthotropic_value(strained(1 + t, 0, 1 + t, x), &p), 0.5 * (8 + 4 + 4) * t * t, 4 * t);
}

/* a11, a12, a22, and g12/2 in each of the two columns that make up a shear. */
static void test_stiffness_at_rest(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    double H[SIZE * SIZE];
    cipc_membrane_orthotropic_hessian(rest, &p, H);
    assert_relative(H[3 * SIZE + 3], 0.5 * 16, ROUNDINGS);
    assert_relative(H[3 * SIZE + 7], 0.5 * 4, ROUNDINGS);
    assert_relative(H[7 * SIZE + 7], 0.5 * 8, ROUNDINGS);
    assert_relative(H[4 * SIZE + 4], 0.5 * 1, ROUNDINGS);
    assert_relative(H[4 * SIZE + 6], 0.5 * 1, ROUNDINGS);
    assert_true(fabs(H[5 * SIZE + 5]) <= ROUNDINGS);
}

/* Only the warp stretched: f1 = 1.25, E11 = 0.28125, Q = 1/4: eta' = Q/(Q - q), and through a12 the weft is pulled too. */
static void test_force_of_a_stretched_warp(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    double x[SIZE], g[SIZE], H[SIZE * SIZE], e = 0.28125, rate = 0.25 / (0.25 - e * e);
    strained(1.25, 0, 1, x);
    cipc_membrane_orthotropic_gradient(x, &p, g);
    cipc_membrane_orthotropic_hessian(x, &p, H);
    assert_relative(g[3], 0.5 * 16 * rate * e * 1.25, ROUNDINGS);
    assert_relative(g[7], 0.5 * 4 * e, ROUNDINGS); /* eta'(0) = 1 */
    assert_relative(g[0], -g[3], ROUNDINGS);
    double along = 16 * (rate + 2 * e * e * rate * rate / 0.25);
    assert_relative(H[3 * SIZE + 3], 0.5 * (along * 1.25 * 1.25 + 16 * rate * e), ROUNDINGS);
    assert_relative(H[5 * SIZE + 5], 0.5 * 16 * rate * e, ROUNDINGS); /* out of plane: tension */
    assert_relative(H[7 * SIZE + 7], 0.5 * (8 + 4 * e * e * 8 + 4 * e), ROUNDINGS); /* eta''(0) = 1/Q = 8 */
    assert_relative(H[3 * SIZE + 7], 0.5 * 4 * 1.25, ROUNDINGS);
}

static void test_limits(void **state)
{
    (void)state;
    cipc_orthotropic p = cloth();
    double x[SIZE], at = sqrt(2), inside = 0x1p-40;
    assert_true(isfinite(cipc_membrane_orthotropic_value(strained(at - inside, 0, 1, x), &p)));
    assert_true(cipc_membrane_orthotropic_value(strained(at + inside, 0, 1, x), &p) == INFINITY);
    at = sqrt(1.5);
    assert_true(isfinite(cipc_membrane_orthotropic_value(strained(1, 0, at - inside, x), &p)));
    assert_true(cipc_membrane_orthotropic_value(strained(1, 0, at + inside, x), &p) == INFINITY);
    at = sqrt(0.5); /* compression is limited alike */
    assert_true(isfinite(cipc_membrane_orthotropic_value(strained(1, 0, at + inside, x), &p)));
    assert_true(cipc_membrane_orthotropic_value(strained(1, 0, at - inside, x), &p) == INFINITY);
    for (int sign = -1; sign <= 1; sign += 2) {
        assert_true(isfinite(cipc_membrane_orthotropic_value(strained(1, sign * (0.25 - inside), 1, x), &p)));
        assert_true(cipc_membrane_orthotropic_value(strained(1, sign * 0.25, 1, x), &p) == INFINITY);
    }
    assert_true(cipc_membrane_orthotropic_value(strained(NAN, 0, 1, x), &p) == INFINITY);
}

/* The same deformation of the same cloth, cut into another triangle: energy per volume does not depend on the cut. */
static void test_independence_of_the_triangle(void **state)
{
    (void)state;
    const double other[SIZE] = {1, 1, 0, 3, 1.5, 0, 0.5, 4, 0};
    const double F[2][2] = {{1.1, 0.05}, {-0.03, 0.95}};
    double here[SIZE] = {0}, there[SIZE] = {0};
    cipc_orthotropic p = cloth(), q;
    assert_true(cipc_orthotropic_init(&q, other, 1, x_axis, NULL, moduli, limits));
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            here[3 * i + k] = F[k][0] * rest[3 * i] + F[k][1] * rest[3 * i + 1];
            there[3 * i + k] = F[k][0] * other[3 * i] + F[k][1] * other[3 * i + 1];
        }
    }
    /* energies of second order in strains of some 0.1 */
    assert_relative(cipc_membrane_orthotropic_value(here, &p) / p.volume, cipc_membrane_orthotropic_value(there, &q) / q.volume, 10 * ROUNDINGS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axes),
        cmocka_unit_test(test_directions_are_projected),
        cmocka_unit_test(test_directions_of_a_triangle_in_space),
        cmocka_unit_test(test_what_has_no_directions_is_refused),
        cmocka_unit_test(test_energy_of_strains),
        cmocka_unit_test(test_small_strains),
        cmocka_unit_test(test_stiffness_at_rest),
        cmocka_unit_test(test_force_of_a_stretched_warp),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_independence_of_the_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
