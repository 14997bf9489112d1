/* The scalar contact barrier against 200 bits of MPFR, and the ends of its support (SPEC C.4). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <mpfr.h>

#include "cipc/energy.h"

enum { BITS = 200 };

/* Some ten operations; D - Dhat is off by half a unit and enters squared; the logarithm is accurate on both sides of its switch. */
static const double ROUNDINGS = 16 * DBL_EPSILON;

static void assert_relative(double got, double want)
{
    if (!(fabs(got - want) <= ROUNDINGS * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* b, b', b'' as printed in SPEC C.4. */
static void reference(double D, double Dhat, double b[3])
{
    mpfr_t past, logarithm, ratio, sum, term;
    mpfr_inits2(BITS, past, logarithm, ratio, sum, term, (mpfr_ptr)0);
    mpfr_set_d(past, D, MPFR_RNDN);
    mpfr_div_d(logarithm, past, Dhat, MPFR_RNDN);
    mpfr_log(logarithm, logarithm, MPFR_RNDN);
    mpfr_sub_d(past, past, Dhat, MPFR_RNDN);
    mpfr_div_d(ratio, past, D, MPFR_RNDN);
    mpfr_sqr(sum, past, MPFR_RNDN);
    mpfr_mul(sum, sum, logarithm, MPFR_RNDN);
    b[0] = -mpfr_get_d(sum, MPFR_RNDN);
    mpfr_mul(sum, past, logarithm, MPFR_RNDN);
    mpfr_mul_ui(sum, sum, 2, MPFR_RNDN);
    mpfr_mul(term, past, ratio, MPFR_RNDN);
    mpfr_add(sum, sum, term, MPFR_RNDN);
    b[1] = -mpfr_get_d(sum, MPFR_RNDN);
    mpfr_sub_ui(term, ratio, 4, MPFR_RNDN);
    mpfr_mul(sum, ratio, term, MPFR_RNDN);
    mpfr_mul_ui(term, logarithm, 2, MPFR_RNDN);
    mpfr_sub(sum, sum, term, MPFR_RNDN);
    b[2] = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(past, logarithm, ratio, sum, term, (mpfr_ptr)0);
}

static void test_against_high_precision(void **state)
{
    (void)state;
    const double supports[] = {1e-6, 2.1e-5, 1, 3e4};
    const double shares[] = {1e-200, 1e-20, 1e-9, 1e-3, 0.3, 0.4999, 0.5001, 0.9, 0.999, 1 - 1e-9, 1 - 1e-15};
    for (size_t i = 0; i < sizeof supports / sizeof supports[0]; i++) {
        for (size_t j = 0; j < sizeof shares / sizeof shares[0]; j++) {
            double D = shares[j] * supports[i], got[3], want[3];
            cipc_barrier(D, supports[i], got);
            reference(D, supports[i], want);
            for (int k = 0; k < 3; k++) {
                if (isinf(want[k]))
                    assert_true(got[k] == want[k]); /* b'' ~ (Dhat/D)^2 overflows at 1e-200 */
                else
                    assert_relative(got[k], want[k]);
            }
        }
    }
    mpfr_free_cache();
}

static void test_signs(void **state)
{
    (void)state;
    double b[3];
    cipc_barrier(0.25, 1, b);
    assert_true(b[0] > 0 && b[1] < 0 && b[2] > 0); /* repels, and the more the nearer */
    assert_relative(b[0], 0.5625 * log(4));
}

static void test_no_force_beyond_the_support(void **state)
{
    (void)state;
    double b[3] = {1, 1, 1};
    cipc_barrier(1, 1, b);
    assert_true(b[0] == 0 && b[1] == 0 && b[2] == 0);
    b[0] = b[1] = b[2] = 1;
    cipc_barrier(7, 1, b);
    assert_true(b[0] == 0 && b[1] == 0 && b[2] == 0);
}

static void test_contact_is_infinite(void **state)
{
    (void)state;
    const double touching[] = {0, -0.0, -1e-30, -1, NAN};
    for (size_t i = 0; i < sizeof touching / sizeof touching[0]; i++) {
        double b[3] = {0, 1, 1};
        cipc_barrier(touching[i], 1, b);
        assert_true(b[0] == INFINITY && b[1] == 0 && b[2] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_high_precision),
        cmocka_unit_test(test_signs),
        cmocka_unit_test(test_no_force_beyond_the_support),
        cmocka_unit_test(test_contact_is_infinite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
