/* Doubles as exact integers and back: the ground that the oracle stands on. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "oracle/integers.h"
#include "support/exact_geometry.h"

static void test_round_trip(void **state)
{
    (void)state;
    const double x[] = {0.0, -0.0, 1.0, -3.0, 0.1, 1e308, -DBL_MAX, DBL_MIN, 0x1p-1074, -0x1.8p-1070, 0x1p-300, 0x1.fffffffffffffp+299};
    enum { COUNT = sizeof x / sizeof x[0] };
    int exponent = cipc_common_exponent(x, COUNT, 0);
    assert_int_equal(exponent, -1074);
    mpz_t z, one;
    mpz_init(z);
    mpz_init_set_ui(one, 1);
    for (int i = 0; i < COUNT; i++) {
        cipc_integer_from_double(z, x[i], exponent);
        assert_true(cipc_nearest_double(z, one, exponent) == x[i]);
    }
    mpz_clears(z, one, NULL);
}

static void test_common_exponent(void **state)
{
    (void)state;
    const double zeros[] = {0, 0}, mixed[] = {12.0, 0.375, 0};
    assert_int_equal(cipc_common_exponent(zeros, 2, 0), 0);
    assert_int_equal(cipc_common_exponent(zeros, 2, -7), -7);
    assert_int_equal(cipc_common_exponent(mixed, 3, 0), -3); /* 0.375 = 3/8 */
    assert_int_equal(cipc_common_exponent(mixed, 1, 5), 2);  /* 12 = 3 * 4 */
}

static void test_finite(void **state)
{
    (void)state;
    const double good[] = {0, -DBL_MAX, 0x1p-1074}, bad[] = {1, 2, NAN}, worse[] = {-INFINITY, 0, 0};
    assert_true(cipc_all_finite(good, 3));
    assert_false(cipc_all_finite(bad, 3));
    assert_true(cipc_all_finite(bad, 2));
    assert_false(cipc_all_finite(worse, 3));
}

/* numerator / denominator * 2^exponent as a double. */
static double nearest(const char *numerator, const char *denominator, long exponent)
{
    mpz_t n, d;
    mpz_init_set_str(n, numerator, 0);
    mpz_init_set_str(d, denominator, 0);
    double value = cipc_nearest_double(n, d, exponent);
    mpz_clears(n, d, NULL);
    return value;
}

static void test_ties_go_to_even(void **state)
{
    (void)state;
    assert_true(nearest("0x20000000000001", "1", 0) == 0x1p53);     /* 2^53 + 1: between 2^53 and 2^53 + 2 */
    assert_true(nearest("0x20000000000003", "1", 0) == 0x1p53 + 4); /* 2^53 + 3: between + 2 (odd) and + 4 */
    assert_true(nearest("-0x20000000000001", "1", 0) == -0x1p53);
    assert_true(nearest("0x200000000000010000000000000001", "1", 0) > 0x1p117);  /* just above the tie */
    assert_true(nearest("0x20000000000000ffffffffffffffff", "1", 0) == 0x1p117); /* just below it */
    assert_true(nearest("0x3fffffffffffff", "1", 0) == 0x1p54);                  /* carries into the next binade */
}

static void test_underflow_and_overflow(void **state)
{
    (void)state;
    assert_true(nearest("1", "1", -1074) == 0x1p-1074);
    assert_true(nearest("1", "1", -1075) == 0.0);       /* a tie with 0 */
    assert_true(nearest("3", "1", -1076) == 0x1p-1074); /* 0.75 of the least number */
    assert_true(nearest("1", "3", -1074) == 0.0);
    assert_true(nearest("2", "3", -1074) == 0x1p-1074);
    assert_true(nearest("5", "1", -1075) == 0x1p-1073); /* 2.5 units: a tie to the even 2 */
    assert_true(nearest("7", "1", -1075) == 0x1p-1072); /* 3.5 units: a tie to the even 4 */
    assert_true(nearest("1", "1", -5000) == 0.0);
    assert_true(nearest("0x1fffffffffffff", "1", 971) == DBL_MAX);
    assert_true(isinf(nearest("0x3fffffffffffff", "1", 970))); /* half an ulp above DBL_MAX */
    assert_true(nearest("-1", "1", 100000) == -INFINITY);
    assert_true(nearest("0", "7", 3) == 0.0);
}

/* Division of doubles is rounded to nearest by the processor: an independent judge. */
static void test_quotients(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 20000; i++) {
        double a = random_uniform(&seed, -1, 1), b = random_uniform(&seed, 0.25, 1) * (random_below(&seed, 2) ? 1 : 0x1p-20);
        mpz_t n, d;
        mpz_inits(n, d, NULL);
        mpz_set_d(n, ldexp(a, 200));
        mpz_set_d(d, ldexp(b, 200));
        assert_true(cipc_nearest_double(n, d, 0) == a / b);
        mpz_clears(n, d, NULL);
    }
}

static void test_vectors(void **state)
{
    (void)state;
    const double a[3] = {1.5, -2, 0.25}, b[3] = {4, 0.5, -8};
    cipc_integer3 u, v, w;
    mpz_t dot;
    mpz_init(dot);
    cipc_integer3_init(&u);
    cipc_integer3_init(&v);
    cipc_integer3_init(&w);
    cipc_integer3_from_doubles(&u, a, -2); /* 6, -8, 1 */
    cipc_integer3_from_doubles(&v, b, -2); /* 16, 2, -32 */
    cipc_integer3_cross(&w, &u, &v);
    assert_int_equal(mpz_get_si(w.c[0]), 254);
    assert_int_equal(mpz_get_si(w.c[1]), 208);
    assert_int_equal(mpz_get_si(w.c[2]), 140);
    cipc_integer3_dot(dot, &u, &v);
    assert_int_equal(mpz_get_si(dot), 48);
    cipc_integer3_sub(&u, &u, &v);
    assert_int_equal(mpz_get_si(u.c[0]), -10);
    assert_int_equal(mpz_get_si(u.c[2]), 33);
    cipc_integer3_clear(&u);
    cipc_integer3_clear(&v);
    cipc_integer3_clear(&w);
    mpz_clear(dot);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),      cmocka_unit_test(test_common_exponent),        cmocka_unit_test(test_finite),
        cmocka_unit_test(test_ties_go_to_even), cmocka_unit_test(test_underflow_and_overflow), cmocka_unit_test(test_quotients),
        cmocka_unit_test(test_vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
