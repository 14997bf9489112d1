/* The 3x3 inverse: exact on small integers, and its determinant off by no more than roundings of the matrix, where cofactors are. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <mpfr.h>

#include "energy/inverse3.h"
#include "energy/samplers.h"

enum { SAMPLES = 300, BITS = 400 };
static const unsigned long SEED = 20261201;

/* Two eliminations, each off by a rounding of the product and one of the difference, of entries that complete pivoting keeps below 9/4 of the largest (its
 * bound for 3x3): the computed pivots are those of A + dA with |dA| <= 4 * 9/4 u max|A| in each entry, and det moves by tr(A^-1 dA) <= 3 |A^-1| |dA|; three
 * more roundings in the product. In units of u |A| |A^-1|, Frobenius. */
static const double ROUNDINGS = 32 * DBL_EPSILON / 2;

static double frobenius(const double A[9])
{
    double sum = 0;
    for (int i = 0; i < 9; i++) sum += A[i] * A[i];
    return sqrt(sum);
}

/* The determinant of the doubles themselves, and by cofactors in doubles. */
static double exact_determinant(const double A[9])
{
    mpfr_t sum, term;
    mpfr_inits2(BITS, sum, term, (mpfr_ptr)0);
    mpfr_set_zero(sum, 1);
    for (int j = 0; j < 3; j++) {
        int a = (j + 1) % 3, b = (j + 2) % 3;
        for (int sign = 1; sign >= -1; sign -= 2) {
            mpfr_set_d(term, sign * A[j], MPFR_RNDN);
            mpfr_mul_d(term, term, A[3 + (sign > 0 ? a : b)], MPFR_RNDN);
            mpfr_mul_d(term, term, A[6 + (sign > 0 ? b : a)], MPFR_RNDN);
            mpfr_add(sum, sum, term, MPFR_RNDN);
        }
    }
    double determinant = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(sum, term, (mpfr_ptr)0);
    return determinant;
}

static double by_cofactors(const double A[9])
{
    return A[0] * (A[4] * A[8] - A[5] * A[7]) + A[1] * (A[5] * A[6] - A[3] * A[8]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}

/* U diag(sigma) V^T. */
static void draw_matrix(gsl_rng *rng, const double sigma[3], double A[9])
{
    double U[3][3], V[3][3];
    energy_draw_rotation(rng, U);
    energy_draw_rotation(rng, V);
    for (int i = 0; i < 9; i++) A[i] = sigma[0] * U[0][i / 3] * V[0][i % 3] + sigma[1] * U[1][i / 3] * V[1][i % 3] + sigma[2] * U[2][i / 3] * V[2][i % 3];
}

/* Every order of the pivots. Multiples of powers of two and three: the products are exact. */
static void test_permutations(void **state)
{
    (void)state;
    const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const double sizes[3] = {2, 8, 0.5};
    for (int p = 0; p < 6; p++) {
        double A[9] = {0}, inverse[9];
        for (int i = 0; i < 3; i++) A[3 * i + orders[p][i]] = sizes[i];
        assert_true(energy_inverse3(A, inverse) == (p < 3 ? 8 : -8));
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) assert_true(inverse[3 * j + i] == (j == orders[p][i] ? 1 / sizes[i] : 0));
        }
    }
}

static void test_small_integers(void **state)
{
    (void)state;
    const double A[9] = {2, 1, 0, 1, 1, 0, 0, 3, 1}, want[9] = {1, -1, 0, -1, 2, 0, 3, -6, 1};
    double inverse[9], condition = frobenius(A) * frobenius(want);
    assert_true(fabs(energy_inverse3(A, inverse) - 1) <= ROUNDINGS * condition);
    for (int i = 0; i < 9; i++) assert_true(fabs(inverse[i] - want[i]) <= ROUNDINGS * condition * frobenius(want));
}

static void test_singular_matrices_have_no_determinant(void **state)
{
    (void)state;
    const double zero[9] = {0}, rank_one[9] = {1, 2, 4, 2, 4, 8, 4, 8, 16}, rank_two[9] = {1, 0, 1, 0, 1, 1, 1, 1, 2}, nan[9] = {1, 0, 0, 0, NAN, 0, 0, 0, 1};
    double inverse[9];
    assert_true(energy_inverse3(zero, inverse) == 0);
    assert_true(energy_inverse3(rank_one, inverse) == 0);
    assert_true(energy_inverse3(rank_two, inverse) == 0);
    assert_false(energy_inverse3(nan, inverse) > 0);
}

static void test_determinant_and_inverse_of_near_singular_matrices(void **state)
{
    (void)state;
    const double shapes[][3] = {{1, 1, 1}, {1, 0.7, 1e-8}, {1, 1e-4, 1e-4}, {1, 1e-7, 0.9e-7}, {1, 1e-3, 1e-6}, {1e90, 1e90, 1e88}, {1e-90, 1e-91, 1e-92}};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    int cofactors_off = 0;
    assert_non_null(rng);
    gsl_rng_set(rng, SEED);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        for (int k = 0; k < SAMPLES; k++) {
            double A[9], inverse[9];
            draw_matrix(rng, shapes[s], A);
            double determinant = energy_inverse3(A, inverse), exact = exact_determinant(A), condition = frobenius(A) * frobenius(inverse);
            double allowed = ROUNDINGS * condition * fabs(exact);
            if (!(fabs(determinant - exact) <= allowed)) fail_msg("shape %zu: off by %.3g of %.3g", s, fabs(determinant - exact), allowed);
            cofactors_off += fabs(by_cofactors(A) - exact) > allowed;
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) {
                    double product = A[3 * i] * inverse[j] + A[3 * i + 1] * inverse[3 + j] + A[3 * i + 2] * inverse[6 + j];
                    assert_true(fabs(product - (i == j)) <= ROUNDINGS * condition);
                }
            }
        }
    }
    assert_true(cofactors_off > SAMPLES); /* this is not an idle bound */
    gsl_rng_free(rng);
    mpfr_free_cache();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_permutations),
        cmocka_unit_test(test_small_integers),
        cmocka_unit_test(test_singular_matrices_have_no_determinant),
        cmocka_unit_test(test_determinant_and_inverse_of_near_singular_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
