/* Strain limit: the published numbers, the ends of its range, accurate stretches, equal and collapsed stretches (SPEC C.2). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <mpfr.h>

#include "cipc/energy.h"

enum { SIZE = 9, BITS = 200 };

/* Some ten operations, and the rounding of t = (sigma - shat)/(s - shat), which the test's reference does not see because it uses the same
 * doubles sigma, s, shat: sigma - shat and s - sigma are off by half a unit each, and b, b', b'' are rational of degree at most 3 in them.
 * */
static const double ROUNDINGS = 16 * DBL_EPSILON;

static const double rest[SIZE] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static cipc_strain_limit limit_of(double limit, double activation)
{
    cipc_strain_limit params;
    assert_true(cipc_strain_limit_init(&params, rest, 0.1, limit, activation, 1000));
    return params;
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_published_numbers(void **state)
{
    (void)state;
    static const double PRINTED_DIGITS = 1e-8; /* nine digits are given */
    double b[3];
    cipc_strain_limit_barrier(1.02, 1.0608, 1, b);
    assert_relative(b[0], 0.0431643555, PRINTED_DIGITS);
    assert_relative(b[1], 6.96855249, PRINTED_DIGITS);
    assert_relative(b[2], 811.248031, PRINTED_DIGITS);
    cipc_strain_limit_barrier(1.05, 1.0608, 1, b);
    assert_relative(b[0], 1.16865833, PRINTED_DIGITS);
    assert_relative(b[1], 109.365761, PRINTED_DIGITS);
    assert_relative(b[2], 11742.5761, PRINTED_DIGITS);
}

/* b, b', b'' as printed in SPEC C.2, at 200 bits. */
static void reference(double sigma, double s, double shat, double b[3])
{
    mpfr_t width, below, above, logarithm, c, term;
    mpfr_inits2(BITS, width, below, above, logarithm, c, term, (mpfr_ptr)0);
    mpfr_set_d(width, s, MPFR_RNDN);
    mpfr_sub_d(width, width, shat, MPFR_RNDN);
    mpfr_set_d(below, shat, MPFR_RNDN);
    mpfr_sub_d(below, below, sigma, MPFR_RNDN); /* shat - sigma */
    mpfr_set_d(above, s, MPFR_RNDN);
    mpfr_sub_d(above, above, sigma, MPFR_RNDN); /* s - sigma */
    mpfr_div(logarithm, above, width, MPFR_RNDN);
    mpfr_log(logarithm, logarithm, MPFR_RNDN);
    mpfr_div(c, below, width, MPFR_RNDN);
    mpfr_sqr(c, c, MPFR_RNDN);
    mpfr_mul(c, c, logarithm, MPFR_RNDN);
    b[0] = -mpfr_get_d(c, MPFR_RNDN);
    mpfr_mul(c, below, logarithm, MPFR_RNDN);
    mpfr_mul_ui(c, c, 2, MPFR_RNDN);
    mpfr_sqr(term, below, MPFR_RNDN);
    mpfr_div(term, term, above, MPFR_RNDN);
    mpfr_add(c, c, term, MPFR_RNDN);
    mpfr_sqr(term, width, MPFR_RNDN);
    mpfr_div(c, c, term, MPFR_RNDN);
    b[1] = mpfr_get_d(c, MPFR_RNDN);
    mpfr_div(c, below, above, MPFR_RNDN);
    mpfr_sub_ui(term, c, 4, MPFR_RNDN);
    mpfr_mul(c, c, term, MPFR_RNDN);
    mpfr_mul_ui(logarithm, logarithm, 2, MPFR_RNDN);
    mpfr_sub(c, c, logarithm, MPFR_RNDN);
    mpfr_sqr(term, width, MPFR_RNDN);
    mpfr_div(c, c, term, MPFR_RNDN);
    b[2] = mpfr_get_d(c, MPFR_RNDN);
    mpfr_clears(width, below, above, logarithm, c, term, (mpfr_ptr)0);
}

static void test_scalar_barrier_against_high_precision(void **state)
{
    (void)state;
    const double limits[][2] = {{1.0608, 1}, {1.3, 1.1}, {1.001, 1.0005}};
    const double places[] = {1e-9, 1e-4, 0.1, 0.49999, 0.50001, 0.9, 1 - 1e-6, 1 - 1e-10};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        for (size_t j = 0; j < sizeof places / sizeof places[0]; j++) {
            double s = limits[i][0], shat = limits[i][1], sigma = shat + places[j] * (s - shat), got[3], want[3];
            cipc_strain_limit_barrier(sigma, s, shat, got);
            reference(sigma, s, shat, want);
            for (int k = 0; k < 3; k++) assert_relative(got[k], want[k], ROUNDINGS);
        }
    }
    mpfr_free_cache();
}

static void test_nothing_below_the_threshold(void **state)
{
    (void)state;
    double b[3];
    const double below[] = {0, 0.5, 1, 1.02};
    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++) {
        cipc_strain_limit_barrier(below[i], 1.0608, 1.02, b);
        assert_true(b[0] == 0 && b[1] == 0 && b[2] == 0);
    }
    /* Twice continuously differentiable: b'' starts from 0 as 6 t/(s - shat)^2. */
    double t = 1e-8, width = 0.0408;
    cipc_strain_limit_barrier(1.02 + t * width, 1.02 + width, 1.02, b);
    assert_relative(b[2] * width * width, 6 * t, 1e-6); /* sigma - shat has lost 8 digits */
}

static void test_value_sums_the_stretches_and_ends_at_the_limit(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(1.5, 1);
    const double both[SIZE] = {0, 0, 0, 1.25, 0, 0, 0, 1.125, 0}, at_limit[SIZE] = {0, 0, 0, 1.5, 0, 0, 0, 1, 0};
    const double beyond[SIZE] = {0, 0, 0, 1, 0, 0, 0, 2, 0}, not_a_number[SIZE] = {0, 0, 0, NAN, 0, 0, 0, 1, 0};
    /* t = 1/2 and 1/4: -t^2 ln(1 - t) each */
    double sum = -0.25 * log(0.5) - 0.0625 * log(0.75);
    assert_relative(cipc_strain_limit_value(both, &p), 1000 * 0.05 * sum, ROUNDINGS);
    assert_true(cipc_strain_limit_value(at_limit, &p) == INFINITY);
    assert_true(cipc_strain_limit_value(beyond, &p) == INFINITY);
    assert_true(cipc_strain_limit_value(not_a_number, &p) == INFINITY);
    assert_true(cipc_strain_limit_value(rest, &p) == 0);
}

static void test_principal_stretches(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(2, 1);
    double sigma[2], tiny = 1e-9;
    const double swapped[SIZE] = {0, 0, 0, 0.5, 0, 0, 0, 2, 0}, near_one[SIZE] = {0, 0, 0, 1 + tiny, 0, 0, 0, 1 - tiny, 0};
    const double line[SIZE] = {0, 0, 0, 3, 0, 0, 4, 0, 0}, point[SIZE] = {0};
    cipc_principal_stretches(swapped, p.inverse_rest, sigma);
    assert_true(sigma[0] == 2 && sigma[1] == 0.5);
    /* From the trace and determinant of C the difference of the stretches would come out with an error of sqrt(u) = 1e-8. */
    cipc_principal_stretches(near_one, p.inverse_rest, sigma);
    assert_true(fabs(sigma[0] - (1 + tiny)) < ROUNDINGS && fabs(sigma[1] - (1 - tiny)) < ROUNDINGS);
    cipc_principal_stretches(line, p.inverse_rest, sigma);
    assert_relative(sigma[0], 5, ROUNDINGS);
    assert_true(sigma[1] == 0);
    cipc_principal_stretches(point, p.inverse_rest, sigma);
    assert_true(sigma[0] == 0 && sigma[1] == 0);
}

static void test_gradient_of_a_dilation(void **state)
{
    (void)state;
    /* Equal stretches, where singular vectors are arbitrary: dE/dF = kappa_s V b' times the identity. */
    cipc_strain_limit p = limit_of(1.5, 1);
    const double x[SIZE] = {0, 0, 0, 1.25, 0, 0, 0, 1.25, 0};
    double g[SIZE], b[3];
    cipc_strain_limit_gradient(x, &p, g);
    cipc_strain_limit_barrier(1.25, 1.5, 1, b);
    double stress = 1000 * 0.05 * b[1];
    const double want[SIZE] = {-stress, -stress, 0, stress, 0, 0, 0, stress, 0};
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i] - want[i]) <= ROUNDINGS * stress);
}

static void test_hessian_of_a_dilation(void **state)
{
    (void)state;
    /* At equal stretches sigma: along b'', shear 1/2 (b'' + b'/sigma), coupling 1/2 (b'' - b'/sigma), out of plane b'/sigma; no jump when
     * they part. */
    cipc_strain_limit p = limit_of(1.5, 1);
    const double equal[SIZE] = {0, 0, 0, 1.25, 0, 0, 0, 1.25, 0}, apart[SIZE] = {0, 0, 0, 1.25 + 1e-12, 0, 0, 0, 1.25, 0};
    double H[SIZE * SIZE], K[SIZE * SIZE], b[3], scale = 1000 * 0.05;
    cipc_strain_limit_hessian(equal, &p, H);
    cipc_strain_limit_hessian(apart, &p, K);
    cipc_strain_limit_barrier(1.25, 1.5, 1, b);
    assert_relative(H[3 * SIZE + 3], scale * b[2], ROUNDINGS);                       /* along */
    assert_relative(H[4 * SIZE + 4], scale * 0.5 * (b[2] + b[1] / 1.25), ROUNDINGS); /* shear */
    assert_relative(H[4 * SIZE + 6], scale * 0.5 * (b[2] - b[1] / 1.25), ROUNDINGS); /* coupling */
    assert_relative(H[5 * SIZE + 5], scale * b[1] / 1.25, ROUNDINGS);                /* out of plane */
    /* b''' / b'' is about 10 here. */
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(fabs(H[i] - K[i]) <= 100 * 1e-12 * scale * b[2]);
}

static void test_collapsed_triangle(void **state)
{
    (void)state;
    /* sigma_2 = 0 exactly: no normal and no second singular vector, but a well-defined energy, force and stiffness. */
    cipc_strain_limit p = limit_of(1.5, 1);
    const double x[SIZE] = {0, 0, 0, 1.25, 0, 0, 0, 0, 0};
    double g[SIZE], H[SIZE * SIZE], b[3], scale = 1000 * 0.05;
    cipc_strain_limit_gradient(x, &p, g);
    cipc_strain_limit_hessian(x, &p, H);
    cipc_strain_limit_barrier(1.25, 1.5, 1, b);
    assert_relative(g[3], scale * b[1], ROUNDINGS);
    assert_relative(H[3 * SIZE + 3], scale * b[2], ROUNDINGS);
    assert_relative(H[4 * SIZE + 4], scale * b[1] / 1.25, ROUNDINGS);
    assert_relative(H[5 * SIZE + 5], scale * b[1] / 1.25, ROUNDINGS);
    assert_relative(H[6 * SIZE + 6], scale * b[1] / 1.25, ROUNDINGS); /* sqrt(sigma^2 + dx^2) */
    assert_true(H[7 * SIZE + 7] == 0 && H[8 * SIZE + 8] == 0);        /* the other stretch is free */
}

static void test_inactive_triangles_are_zero(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(1.5, 1.25);
    const double x[SIZE] = {0, 0, 0, 1.25, 0, 0, 0, 1.125, 0};
    double g[SIZE], H[SIZE * SIZE];
    cipc_strain_limit_gradient(x, &p, g);
    cipc_strain_limit_hessian(x, &p, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(H[i] == 0);
}

static void test_rest_triangle_without_area_is_refused(void **state)
{
    (void)state;
    cipc_strain_limit params;
    const double line[SIZE] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    assert_false(cipc_strain_limit_init(&params, line, 1, 1.1, 1, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published_numbers),           cmocka_unit_test(test_scalar_barrier_against_high_precision),
        cmocka_unit_test(test_nothing_below_the_threshold), cmocka_unit_test(test_value_sums_the_stretches_and_ends_at_the_limit),
        cmocka_unit_test(test_principal_stretches),         cmocka_unit_test(test_gradient_of_a_dilation),
        cmocka_unit_test(test_hessian_of_a_dilation),       cmocka_unit_test(test_collapsed_triangle),
        cmocka_unit_test(test_inactive_triangles_are_zero), cmocka_unit_test(test_rest_triangle_without_area_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
