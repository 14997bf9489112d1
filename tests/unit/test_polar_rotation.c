/* The rotation of the polar decomposition: orthogonal, what it leaves of F symmetric and positive definite, in residuals of 200 bits. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <mpfr.h>

#include "energy/polar_rotation.h"
#include "energy/samplers.h"

enum { SAMPLES = 300, BITS = 200 };
static const unsigned long SEED = 20261201;

/* In units of u. The last step averages X, within 2^-28 of R, and its inverse, in which elimination leaves some ten roundings: halved, with three of the
 * step's own, and twice that in R^T R. */
static const double ORTHOGONAL = 16 * DBL_EPSILON / 2;
/* In units of u |F|. R is the rotation of F + dF. A step leaves a dozen roundings of its matrix, its inverse's ten and its own; the first two steps act on
 * matrices of the condition of F. After them X is near a multiple of R, and what is added to its factor there is symmetric to first order. */
static const double SYMMETRIC = 24 * DBL_EPSILON / 2;

/* Sum over k of A[k][a] B[k][b] at 200 bits, less `minus`. */
static double product(const double A[9], const double B[9], int a, int b, double minus)
{
    mpfr_t sum, term;
    mpfr_inits2(BITS, sum, term, (mpfr_ptr)0);
    mpfr_set_d(sum, -minus, MPFR_RNDN);
    for (int k = 0; k < 3; k++) {
        mpfr_set_d(term, A[3 * k + a], MPFR_RNDN);
        mpfr_mul_d(term, term, B[3 * k + b], MPFR_RNDN);
        mpfr_add(sum, sum, term, MPFR_RNDN);
    }
    double result = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(sum, term, (mpfr_ptr)0);
    return result;
}

/* Largest of |R^T R - 1| and of |S - S^T|/|F|, S = R^T F. */
static double orthogonality(const double R[9])
{
    double most = 0;
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(product(R, R, i / 3, i % 3, i % 4 == 0)));
    return most;
}

static double skewness(const double F[9], const double R[9])
{
    double most = 0, size = 0;
    for (int i = 0; i < 9; i++) size = fmax(size, fabs(F[i]));
    for (int a = 0; a < 3; a++) most = fmax(most, fabs(product(R, F, a, (a + 1) % 3, product(R, F, (a + 1) % 3, a, 0))));
    return most / size;
}

/* All of S's principal minors positive: among the rotations that leave a symmetric S that is the polar one only. The smallest eigenvalue of S is known to a few u
 * |F|, and at least 1e-8 |F| in the shapes below. */
static bool is_positive(const double F[9], const double R[9])
{
    double S[9];
    for (int i = 0; i < 9; i++) S[i] = 0.5 * (product(R, F, i / 3, i % 3, 0) + product(R, F, i % 3, i / 3, 0));
    double minor = S[0] * S[4] - S[1] * S[3];
    double det = S[2] * (S[3] * S[7] - S[4] * S[6]) - S[5] * (S[0] * S[7] - S[1] * S[6]) + S[8] * minor;
    return S[0] > 0 && minor > 0 && det > 0;
}

static void check(const double F[9], const char *what)
{
    double R[9];
    if (!energy_polar_rotation(F, R)) fail_msg("%s: no rotation", what);
    if (!(orthogonality(R) <= ORTHOGONAL)) fail_msg("%s: R^T R off by %.3g u", what, orthogonality(R) * 2 / DBL_EPSILON);
    if (!(skewness(F, R) <= SYMMETRIC)) fail_msg("%s: S off by %.3g u", what, skewness(F, R) * 2 / DBL_EPSILON);
    if (!is_positive(F, R)) fail_msg("%s: another root", what);
}

static void test_shapes(void **state)
{
    (void)state;
    static const struct { const char *name; double sigma[3]; } shapes[] = {
        {"rotation", {1, 1, 1}},        {"nearly", {1, 1 + 1e-9, 1 - 1e-9}}, {"unequal", {3, 1, 0.2}},      {"two equal", {2, 2, 0.5}},
        {"flat", {1, 0.8, 1e-8}},       {"needle", {1, 2e-4, 1e-4}},         {"graded", {1, 1e-2, 1e-4}},   {"large", {1e100, 2e100, 3e99}},
        {"small", {1e-100, 1e-101, 1e-100}},
    };
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, SEED);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        for (int k = 0; k < SAMPLES; k++) {
            double U[3][3], V[3][3], F[9];
            const double *sigma = shapes[s].sigma;
            energy_draw_rotation(rng, U);
            energy_draw_rotation(rng, V);
            for (int i = 0; i < 9; i++) F[i] = sigma[0] * U[0][i / 3] * V[0][i % 3] + sigma[1] * U[1][i / 3] * V[1][i % 3] + sigma[2] * U[2][i / 3] * V[2][i % 3];
            check(F, shapes[s].name);
        }
    }
    gsl_rng_free(rng);
    mpfr_free_cache();
}

/* F = R S with R = [[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]] and S = diag(5, 10, 2). */
static void test_known_rotation(void **state)
{
    (void)state;
    const double F[9] = {3, -8, 0, 4, 6, 0, 0, 0, 2}, want[9] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
    double R[9];
    assert_true(energy_polar_rotation(F, R));
    for (int i = 0; i < 9; i++) assert_true(fabs(R[i] - want[i]) <= ORTHOGONAL);
}

/* A turn by half a circle is as good as any: two of the diagonal's signs. */
static void test_half_turn(void **state)
{
    (void)state;
    const double F[9] = {-2, 0, 0, 0, -3, 0, 0, 0, 1};
    double R[9];
    assert_true(energy_polar_rotation(F, R));
    for (int i = 0; i < 9; i++) assert_true(fabs(R[i] - (i == 8 ? 1 : i % 4 == 0 ? -1 : 0)) <= ORTHOGONAL);
}

static void test_flat_and_inverted_are_refused(void **state)
{
    (void)state;
    const double flat[9] = {1, 0, 1, 0, 1, 1, 1, 1, 2}, mirrored[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1}, nan[9] = {1, 0, 0, 0, NAN, 0, 0, 0, 1}, zero[9] = {0};
    double R[9];
    assert_false(energy_polar_rotation(flat, R));
    assert_false(energy_polar_rotation(mirrored, R));
    assert_false(energy_polar_rotation(nan, R));
    assert_false(energy_polar_rotation(zero, R));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_known_rotation),
        cmocka_unit_test(test_half_turn),
        cmocka_unit_test(test_flat_and_inverted_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
