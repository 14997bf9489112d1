/* The layers against their definitions in long double: thickness, stiffness, stable step; how many act at a gap, ties included; the energy, term by term and against the
 * asymptote of finding F4. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <limits.h>

#include "cipc/asynchronous.h"
#include "support/exact_geometry.h"

/* Two square roots, a quotient and a product, each correctly rounded: 1/2 + 1/4 + 1/2... below 3 u, all told. */
static const double FEW_ROUNDINGS = 4 * UNIT_ROUNDOFF;

static void assert_near(double got, long double want, double relative) { assert_true(fabsl(got - want) <= relative * fabsl(want)); }

static void test_definitions(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 20000; i++) {
        const double eta1 = exp(random_uniform(&seed, -12, 2)), r1 = exp(random_uniform(&seed, -5, 15)), m = exp(random_uniform(&seed, -20, 3));
        const int l = 1 + random_below(&seed, i % 2 ? 20 : 4000);
        const long double L = l;
        assert_near(cipc_layer_thickness(eta1, l), eta1 * powl(L, -0.25L), FEW_ROUNDINGS);
        assert_near(cipc_layer_stiffness(r1, l), r1 * L * L * L, FEW_ROUNDINGS);
        /* Two nodes of mass m against each other: omega^2 = 2 r/m, and a step is a fraction of 2/omega. */
        assert_near(cipc_layer_step(r1, m, 0.025, l), 0.025L * 2 / sqrtl(2 * r1 * L * L * L / m), 2 * FEW_ROUNDINGS);
        assert_true(cipc_layer_thickness(eta1, l + 1) < cipc_layer_thickness(eta1, l));
    }
    assert_true(cipc_layer_thickness(0.1, 1) == 0.1 && cipc_layer_thickness(0.1, 16) == 0.05 && cipc_layer_stiffness(3, 10) == 3000);
}

/* ---- How many layers ---- */

static int count_one_by_one(double eta1, double gap)
{
    int n = 0;
    while (cipc_layer_thickness(eta1, n + 1) > gap) n++;
    return n;
}

/* Gaps anywhere; gaps that are a layer's thickness to the last bit, which that layer does not act at; and one unit to either side. */
static void test_count(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 4000; i++) {
        const double eta1 = exp(random_uniform(&seed, -12, 2));
        const int l = 1 + random_below(&seed, 3000);
        const double tie = cipc_layer_thickness(eta1, l), anywhere = eta1 * random_uniform(&seed, 0.14, 1.1);
        assert_int_equal(cipc_layer_count(eta1, tie), l - 1);
        assert_int_equal(cipc_layer_count(eta1, nextafter(tie, 0)), l);
        assert_int_equal(cipc_layer_count(eta1, nextafter(tie, INFINITY)), count_one_by_one(eta1, nextafter(tie, INFINITY)));
        assert_int_equal(cipc_layer_count(eta1, anywhere), count_one_by_one(eta1, anywhere));
    }
    assert_int_equal(cipc_layer_count(1, 2), 0);
    assert_int_equal(cipc_layer_count(1, INFINITY), 0);
}

/* With no gap left the layers are without number. */
static void test_no_gap(void **state)
{
    (void)state;
    const double none[] = {0, -1, NAN, 1e-300};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        assert_int_equal(cipc_layer_count(1, none[i]), INT_MAX);
        assert_true(cipc_layer_energy(1, 1, none[i]) == INFINITY);
    }
}

/* ---- The energy ---- */

static long double energy_term_by_term(double eta1, double r1, double gap)
{
    long double sum = 0;
    for (int l = 1; cipc_layer_thickness(eta1, l) > gap; l++) {
        const long double L = l, overlap = eta1 * powl(L, -0.25L) - gap;
        sum += 0.5L * r1 * L * L * L * overlap * overlap;
    }
    return sum;
}

static void test_energy(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 300; i++) {
        const double eta1 = exp(random_uniform(&seed, -8, 2)), r1 = exp(random_uniform(&seed, -3, 10)), gap = eta1 * random_uniform(&seed, 0.15, 1);
        const long double want = energy_term_by_term(eta1, r1, gap);
        /* A thickness off by 3 u shifts each overlap by as much of eta1: sqrt(2 E/r) of the first layer measures the overlaps. */
        assert_true(fabsl(cipc_layer_energy(eta1, r1, gap) - want) <= 1e-12L * want + 1e-14L * r1 * eta1 * eta1);
    }
    assert_true(cipc_layer_energy(1, 1, 1) == 0);
}

/* F4: V(d) -> (r1 eta1^2/840) (eta1/d)^14, ratio 1.0000 for d <= eta1/2. */
static void test_asymptote(void **state)
{
    (void)state;
    const double eta1 = 0.1, r1 = 1000;
    for (double d = 0.5 * eta1; d > 0.15 * eta1; d *= 0.93) {
        const double ratio = cipc_layer_energy(eta1, r1, d) / (r1 * eta1 * eta1 / 840 * pow(eta1 / d, 14));
        assert_true(fabs(ratio - 1) < 0.5e-4);
    }
    /* and no sooner: at 0.98 eta1 there is one layer, and its parabola is far from the asymptote */
    assert_true(fabs(cipc_layer_energy(eta1, r1, 0.98 * eta1) / (r1 * eta1 * eta1 / 840 * pow(1 / 0.98, 14)) - 1) > 0.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_definitions), cmocka_unit_test(test_count), cmocka_unit_test(test_no_gap), cmocka_unit_test(test_energy), cmocka_unit_test(test_asymptote),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
