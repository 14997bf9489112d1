/* Strain limit: the published numbers, the ends of its range, accurate stretches, equal and collapsed stretches (SPEC C.2). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <mpfr.h>
#include <stdbool.h>

#include "cipc/energy.h"
#include "support/claim.h"

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
    claim_figure("C5", "b'' just above the threshold off 6 t/(s - shat)^2, t = 1e-8, relative", fabs(b[2] * width * width / (6 * t) - 1), "1", CLAIM_AT_MOST, 1e-6);
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
    double largest = 0;
    cipc_strain_limit at_rest = limit_of(1.0608, 1);
    cipc_strain_limit_gradient(rest, &at_rest, g);
    cipc_strain_limit_hessian(rest, &at_rest, H);
    for (int i = 0; i < SIZE; i++) largest = fmax(largest, fabs(g[i]));
    for (int i = 0; i < SIZE * SIZE; i++) largest = fmax(largest, fabs(H[i]));
    claim_figure("C5", "largest entry of gradient and Hessian at rest, s = 1.0608, shat = 1", largest, "N, N/m", CLAIM_EQUAL, 0);
}

static void test_rest_triangle_without_area_is_refused(void **state)
{
    (void)state;
    cipc_strain_limit params;
    const double line[SIZE] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    assert_false(cipc_strain_limit_init(&params, line, 1, 1.1, 1, 1));
}

/* ---- Refinement (claim C6) --------------------------------------------------------------------------------------------------- */

/* The square [0, 1]^2, stretched by 1 + 0.04 u along u and by 1 + 0.03 v along v. */
static void stretched(double u, double v, bool uniform, double x[3])
{
    x[0] = uniform ? 1.04 * u : u + 0.02 * u * u;
    x[1] = uniform ? 1.03 * v : v + 0.015 * v * v;
    x[2] = 0;
}

/* Node (i, j) of n x n cells; inner ones are displaced by up to a fifth of a cell, so that no two triangles are alike. */
static void place(int n, int i, int j, double uv[2])
{
    bool inner = i > 0 && i < n && j > 0 && j < n;
    uv[0] = (i + (inner ? 0.2 * sin(3.0 * i + 5.0 * j) : 0)) / n;
    uv[1] = (j + (inner ? 0.2 * sin(7.0 * i + 2.0 * j) : 0)) / n;
}

static double energy_of_cells(int n, bool uniform)
{
    static const int corner[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    double sum = 0;
    for (int cell = 0; cell < n * n; cell++)
        for (int t = 0; t < 2; t++) {
            double flat[SIZE] = {0}, x[SIZE];
            cipc_strain_limit params;
            for (int k = 0; k < 3; k++) {
                place(n, cell % n + corner[t][k][0], cell / n + corner[t][k][1], flat + 3 * k);
                stretched(flat[3 * k], flat[3 * k + 1], uniform, x + 3 * k);
            }
            assert_true(cipc_strain_limit_init(&params, flat, 0.1, 1.0608, 1, 1000));
            sum += cipc_strain_limit_value(x, &params);
        }
    return sum;
}

/* kappa_s t times the integral of b(sigma_1) + b(sigma_2), by Simpson's rule of 1000 panels: its error is far below those of the meshes. */
static double exact_energy(void)
{
    enum { PANELS = 1000 };
    double sum = 0, b[2][3];
    for (int i = 0; i <= PANELS; i++) {
        double at = (double)i / PANELS, weight = i == 0 || i == PANELS ? 1 : i % 2 ? 4 : 2;
        cipc_strain_limit_barrier(1 + 0.04 * at, 1.0608, 1, b[0]);
        cipc_strain_limit_barrier(1 + 0.03 * at, 1.0608, 1, b[1]);
        sum += weight * (b[0][0] + b[1][0]);
    }
    return 1000 * 0.1 * sum / (3 * PANELS);
}

/* The energy is an integral over the rest area: a uniform stretch has the same on every mesh, and another converges as what it is made of does, of second order. */
static void test_refinement(void **state)
{
    (void)state;
    /* 2 * 64^2 triangles, some ten roundings each, and the stretch of 1.04 over its distance from the limit, 50 times: 1e5 roundings if all had the same sign */
    static const double SUM_ROUNDINGS = 1e5 * DBL_EPSILON;
    double exact = exact_energy(), uniform = energy_of_cells(1, true), apart = 0, before = fabs(energy_of_cells(16, false) / exact - 1), order = INFINITY, highest = 0;
    for (int n = 2; n <= 64; n *= 2) apart = fmax(apart, fabs(energy_of_cells(n, true) / uniform - 1));
    for (int n = 32; n <= 128; n *= 2) {
        double error = fabs(energy_of_cells(n, false) / exact - 1);
        order = fmin(order, log2(before / error));
        highest = fmax(highest, log2(before / error));
        before = error;
    }
    claim_figure("C6", "uniform stretch: energies of 1 to 64 cells a side apart, relative", apart, "1", CLAIM_AT_MOST, SUM_ROUNDINGS);
    claim_within("C6", "uneven stretch, 16 to 128 irregular cells a side: order of convergence, smallest", order, "1", 1.7, 2.3);
    claim_within("C6", "the same, largest", highest, "1", 1.7, 2.3);
    claim_figure("C6", "the same: energy off the integral at 128 cells, relative", before, "1", CLAIM_LESS, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published_numbers),           cmocka_unit_test(test_scalar_barrier_against_high_precision),
        cmocka_unit_test(test_nothing_below_the_threshold), cmocka_unit_test(test_value_sums_the_stretches_and_ends_at_the_limit),
        cmocka_unit_test(test_principal_stretches),         cmocka_unit_test(test_gradient_of_a_dilation),
        cmocka_unit_test(test_hessian_of_a_dilation),       cmocka_unit_test(test_collapsed_triangle),
        cmocka_unit_test(test_inactive_triangles_are_zero), cmocka_unit_test(test_rest_triangle_without_area_is_refused),
        cmocka_unit_test(test_refinement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
