/* Integer polynomials: arithmetic against values, and root isolation against roots that were put in. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_rng.h>
#include <math.h>

#include "oracle/polynomial.h"

static void set(oracle_polynomial *p, int degree, const long *c)
{
    for (int i = 0; i <= ORACLE_DEGREE_LIMIT; i++) mpz_set_si(p->c[i], i <= degree ? c[i] : 0);
    oracle_polynomial_trim(p);
}

/* p := p * (q s - r), with the root r/q. */
static void put_root(oracle_polynomial *p, long r, long q)
{
    oracle_polynomial factor;
    oracle_polynomial_init(&factor);
    set(&factor, 1, (long[]){-r, q});
    oracle_polynomial_mul(p, p, &factor);
    oracle_polynomial_clear(&factor);
}

static void test_arithmetic(void **state)
{
    (void)state;
    oracle_polynomial a, b, r;
    oracle_polynomial_init(&a);
    oracle_polynomial_init(&b);
    oracle_polynomial_init(&r);
    set(&a, 2, (long[]){1, -3, 2});
    set(&b, 1, (long[]){5, 7});
    oracle_polynomial_mul(&r, &a, &b); /* 5 - 8 s - 11 s^2 + 14 s^3 */
    assert_int_equal(r.degree, 3);
    static const long product[] = {5, -8, -11, 14};
    for (int i = 0; i < 4; i++) assert_int_equal(mpz_get_si(r.c[i]), product[i]);
    oracle_polynomial_derivative(&r, &r);
    assert_true(r.degree == 2 && mpz_get_si(r.c[0]) == -8 && mpz_get_si(r.c[1]) == -22 && mpz_get_si(r.c[2]) == 42 && mpz_sgn(r.c[3]) == 0);
    oracle_polynomial_sub(&r, &r, &r);
    assert_int_equal(r.degree, -1);
    oracle_polynomial_mul(&r, &a, &r);
    assert_int_equal(r.degree, -1);
    oracle_polynomial_add(&r, &a, &b);
    assert_true(r.degree == 2 && mpz_get_si(r.c[0]) == 6 && mpz_get_si(r.c[1]) == 4);
    mpz_t half;
    mpz_init_set_ui(half, 1);
    assert_int_equal(oracle_polynomial_sign_at(&a, half, 1), 0); /* a(1/2) = 0 */
    mpz_set_ui(half, 3);
    assert_int_equal(oracle_polynomial_sign_at(&a, half, 2), -1);
    mpz_clear(half);
    oracle_polynomial_clear(&a);
    oracle_polynomial_clear(&b);
    oracle_polynomial_clear(&r);
}

/* Is the rational r/q the root that is enclosed? */
static void assert_encloses(const oracle_root *root, long r, long q)
{
    mpz_t left, right;
    mpz_init_set(left, root->numerator);
    mpz_init_set_si(right, r);
    mpz_mul_si(left, left, q);
    mpz_mul_2exp(right, right, root->bits);
    int order = mpz_cmp(left, right); /* q numerator against r 2^bits */
    mpz_add_ui(left, root->numerator, root->exact ? 0 : 1);
    mpz_mul_si(left, left, q);
    int above = mpz_cmp(left, right);
    mpz_clear(left);
    mpz_clear(right);
    assert_true(root->exact ? order == 0 : order < 0 && above > 0);
}

/* Products of linear factors with known roots, some of them twice, some outside, some at 0 and 1. */
static void test_planted_roots(void **state)
{
    (void)state;
    enum { CASES = 400 };
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 11);
    oracle_polynomial p;
    oracle_root root[ORACLE_ROOT_LIMIT];
    oracle_polynomial_init(&p);
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_init(&root[i]);
    for (int c = 0; c < CASES; c++) {
        static const long places = 1009; /* a prime: dyadic only at 0 and 1 */
        long inside[6];
        int count = 0, factors = 1 + (int)gsl_rng_uniform_int(rng, 6);
        set(&p, 0, (long[]){c % 2 ? 1 : -3});
        while (p.degree < factors) {
            long r = (long)gsl_rng_uniform_int(rng, 2018) - 504;
            if (gsl_rng_uniform(rng) < 0.1) r = 1009;
            if (gsl_rng_uniform(rng) < 0.1) r = 0;
            put_root(&p, r, places);
            if (gsl_rng_uniform(rng) < 0.3 && p.degree < factors) put_root(&p, r, places); /* twice */
            if (r <= 0 || r > places) continue;
            int j = 0;
            while (j < count && inside[j] < r) j++;
            if (j < count && inside[j] == r) continue;
            for (int k = count++; k > j; k--) inside[k] = inside[k - 1];
            inside[j] = r;
        }
        int found = oracle_polynomial_roots(&p, root);
        assert_int_equal(found, count);
        for (int i = 0; i < found; i++) {
            assert_encloses(&root[i], inside[i], places);
            oracle_root_refine(&root[i], 200);
            assert_true(root[i].exact || root[i].bits >= 200);
            assert_encloses(&root[i], inside[i], places);
        }
        assert_true(!oracle_polynomial_no_root(&p) || count == 0);
    }
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_clear(&root[i]);
    oracle_polynomial_clear(&p);
    gsl_rng_free(rng);
}

/* Complex pairs next to the interval, dyadic roots, constants and zero. */
static void test_special_cases(void **state)
{
    (void)state;
    oracle_polynomial p;
    oracle_root root[ORACLE_ROOT_LIMIT];
    oracle_polynomial_init(&p);
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_init(&root[i]);
    assert_int_equal(oracle_polynomial_roots(&p, root), 0);
    set(&p, 0, (long[]){5});
    assert_int_equal(oracle_polynomial_roots(&p, root), 0);
    set(&p, 2, (long[]){250001, -1000000, 1000000}); /* (1000 s - 500)^2 + 1 */
    assert_int_equal(oracle_polynomial_roots(&p, root), 0);
    set(&p, 2, (long[]){1, -4, 4}); /* (2 s - 1)^2 */
    assert_int_equal(oracle_polynomial_roots(&p, root), 1);
    oracle_root_refine(&root[0], 100);
    assert_encloses(&root[0], 1, 2);
    set(&p, 3, (long[]){0, 3, -16, 16}); /* 16 s (s - 1/4)(s - 3/4) */
    assert_int_equal(oracle_polynomial_roots(&p, root), 2);
    assert_encloses(&root[0], 1, 4);
    assert_encloses(&root[1], 3, 4);
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_clear(&root[i]);
    oracle_polynomial_clear(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arithmetic),
        cmocka_unit_test(test_planted_roots),
        cmocka_unit_test(test_special_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
