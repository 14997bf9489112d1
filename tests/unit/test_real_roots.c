/* Roots of polynomials whose roots are known: products of (t - r), and quadratic factors without any. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "contact/real_roots.h"

/* c times (t - r); degree is c's before. */
static void times_root(double *c, int degree, double r)
{
    c[degree + 1] = c[degree];
    for (int i = degree; i >= 1; i--) c[i] = c[i - 1] - r * c[i];
    c[0] *= -r;
}

static void assert_roots(const double *c, int degree, double end, const double *expected, int count, double tolerance)
{
    double roots[CONTACT_POLYNOMIAL_DEGREE];
    int found = contact_real_roots(c, degree, end, roots);
    assert_int_equal(found, count);
    for (int i = 0; i < count; i++)
        if (!(fabs(roots[i] - expected[i]) <= tolerance)) fail_msg("root %d: %.17g, not %.17g", i, roots[i], expected[i]);
}

/* The condition of simple roots this far apart: some units of rounding times the coefficients' size over the slope, below 1e4 here. */
static const double CLEAR = 1e-11;

static void test_known_roots(void **state)
{
    (void)state;
    const double all[6] = {0.05, 0.2, 0.41, 0.6, 0.83, 0.99};
    for (int degree = 1; degree <= 6; degree++) {
        double c[7] = {-3}; /* the factor in front changes nothing */
        for (int i = 0; i < degree; i++) times_root(c, i, all[i]);
        assert_roots(c, degree, 1, all, degree, CLEAR);
        assert_roots(c, degree, 0.5, all, degree < 3 ? degree : 3, CLEAR);
    }
}

static void test_ends(void **state)
{
    (void)state;
    double c[7] = {1};
    times_root(c, 0, 0);
    times_root(c, 1, 1);
    assert_roots(c, 2, 1, (double[]){1}, 1, 0);   /* t = 0 is no root in (0, 1], t = 1 is */
    assert_roots(c, 2, 0.999, NULL, 0, 0);
    assert_roots((double[]){-0x1p-60, 1}, 1, 1, (double[]){0x1p-60}, 1, 0); /* small, and found to the last bit */
}

static void test_none(void **state)
{
    (void)state;
    assert_roots((double[]){0}, 0, 1, NULL, 0, 0);
    assert_roots((double[]){0, 0, 0, 0}, 3, 1, NULL, 0, 0);
    assert_roots((double[]){2, 0, 0}, 2, 1, NULL, 0, 0);
    assert_roots((double[]){0.26, -1, 1}, 2, 1, NULL, 0, 0);      /* (t - 1/2)^2 + 0.01 */
    assert_roots((double[]){0.5, 0.25, 0, 0, 0}, 4, 1, NULL, 0, 0); /* lower degree than it says; its root is -2 */
}

/* (t - 1/4)^2 (t - 3/4): the sign changes at the single root only; a triple root counts once. */
static void test_repeated_roots(void **state)
{
    (void)state;
    double c[7] = {1}, d[7] = {1};
    times_root(c, 0, 0.25);
    times_root(c, 1, 0.25);
    times_root(c, 2, 0.75);
    double roots[CONTACT_POLYNOMIAL_DEGREE];
    int count = contact_real_roots(c, 3, 1, roots); /* 1/4 is met exactly by chance or not at all */
    assert_true(count >= 1 && fabs(roots[count - 1] - 0.75) < CLEAR);
    for (int i = 0; i < 3; i++) times_root(d, i, 0.5);
    count = contact_real_roots(d, 3, 1, roots);
    assert_true(count >= 1 && fabs(roots[0] - 0.5) < 1e-5); /* the cube root of rounding */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_known_roots), cmocka_unit_test(test_ends), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_repeated_roots)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
