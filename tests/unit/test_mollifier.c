/* Edge-edge mollifier: value, gradient and Hessian against rational differences, component by component, on both sides of eps. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* Derivation, with A = max(|a|, |b|): an entry of n = a x b carries 4 roundings, so n is off by 4 u |a||b|, 
 * c = |n|^2 by 8 u |a||b| sqrt(c). With e' <= 2/eps and c < eps:
 *   value 2/eps 8 u |a||b| sqrt(c), and 4 u for the polynomial; gradient e' 2 b x n: 2/eps A |a||b| times 8 u for n and 16 u for e';
 *   Hessian e' c'' + e'' c' c'^T: 2/eps A^2 times 16 u for the first term and 16 u |a||b|/sqrt(eps) for n in the second. Doubled for the
 *   roundings of the sums. */
#define VALUE_TOLERANCE (8.0 * UNIT_ROUNDOFF)
#define GRADIENT_TOLERANCE (48.0 * UNIT_ROUNDOFF)
#define HESSIAN_TOLERANCE (32.0 * UNIT_ROUNDOFF)
/* eps as a fraction of |A|^2 |B|^2, SPEC D.3. */
#define MOLLIFIER_FRACTION 1e-3
#define SAMPLES 300
#define LEAST_PER_BRANCH 60

static void exact_cross2(mpq_t out, mpq_t *x)
{
    mpq_t a[3], b[3], n[3];
    q_init(a, 3), q_init(b, 3), q_init(n, 3);
    q_sub(a, x + 3, x), q_sub(b, x + 9, x + 6);
    q_cross(n, a, b);
    q_dot(out, n, n);
    q_clear(a, 3), q_clear(b, 3), q_clear(n, 3);
}

/* c/eps (2 - c/eps) below eps, 1 above. */
static void exact_mollifier(mpq_t out, mpq_t *x, const void *eps_pointer)
{
    mpq_t eps, two;
    mpq_inits(eps, two, NULL);
    mpq_set_d(eps, *(const double *)eps_pointer);
    mpq_set_ui(two, 2, 1);
    exact_cross2(out, x);
    if (mpq_cmp(out, eps) < 0) {
        mpq_div(out, out, eps);
        mpq_sub(two, two, out);
        mpq_mul(out, out, two);
    } else {
        mpq_set_ui(out, 1, 1);
    }
    mpq_clears(eps, two, NULL);
}

typedef struct edge_lengths {
    double a, b, longest;
} edge_lengths;

static edge_lengths lengths_of(const double x[12])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) a[k] = x[3 + k] - x[k], b[k] = x[9 + k] - x[6 + k];
    return (edge_lengths){norm3(a), norm3(b), fmax(norm3(a), norm3(b))};
}

/* Edges at any angle, with a threshold that is above c, below it, or close to it. Returns eps. */
static double draw(uint64_t *seed, int sample, double x[12])
{
    double scale = pow(10.0, random_uniform(seed, -6.0, 6.0)), angle = pow(10.0, random_uniform(seed, -10.0, 0.0));
    random_fill(seed, x, 12, scale);
    for (int k = 0; sample % 2 && k < 3; k++)
        x[9 + k] = x[6 + k] + 0.7 * (x[3 + k] - x[k]) + angle * random_uniform(seed, -scale, scale);
    edge_lengths l = lengths_of(x);
    double eps = MOLLIFIER_FRACTION * l.a * l.a * l.b * l.b;
    return sample % 5 == 0 ? cipc_edge_edge_cross2(x) * (1.0 + random_uniform(seed, -1e-3, 1e-3)) : eps;
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 71;
    int below = 0, above = 0, close = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], g[12], H[144], eps = draw(&seed, sample, x), c = cipc_edge_edge_cross2(x);
        edge_lengths l = lengths_of(x);
        double value = cipc_edge_edge_mollifier_value(x, eps), slope = 2.0 / eps, area = l.a * l.b;
        cipc_edge_edge_mollifier_gradient(x, eps, g);
        cipc_edge_edge_mollifier_hessian(x, eps, H);
        assert_true(value_error(exact_mollifier, &eps, x, 12, value) <=
                    VALUE_TOLERANCE * (slope * area * sqrt(c < eps ? c : 0.0) + 1.0));
        assert_true(gradient_error(exact_mollifier, &eps, x, 12, g) <= GRADIENT_TOLERANCE * slope * l.longest * area);
        assert_true(hessian_error(exact_mollifier, &eps, x, 12, H) <=
                    HESSIAN_TOLERANCE * slope * l.longest * l.longest * (1.0 + area / sqrt(eps)));
        below += c < 0.99 * eps;
        above += c > 1.01 * eps;
        close += c >= 0.99 * eps && c <= 1.01 * eps;
    }
    assert_true(below >= LEAST_PER_BRANCH && above >= LEAST_PER_BRANCH && close >= LEAST_PER_BRANCH / 2);
}

/* Above the threshold it is 1 and flat, exactly; a threshold of 0 (zero-length rest edge) switches it off. */
static void test_off(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1};
    const double thresholds[2] = {0.5, 0.0};
    for (int i = 0; i < 2; i++) {
        double g[12], H[144];
        assert_true(cipc_edge_edge_mollifier_value(x, thresholds[i]) == 1.0);
        cipc_edge_edge_mollifier_gradient(x, thresholds[i], g);
        cipc_edge_edge_mollifier_hessian(x, thresholds[i], H);
        for (int k = 0; k < 12; k++) assert_true(g[k] == 0.0);
        for (int k = 0; k < 144; k++) assert_true(H[k] == 0.0);
    }
}

/* Parallel edges: c and its gradient vanish, the Hessian does not. */
static void test_parallel(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 2, 0, 1};
    double g[12], H[144];
    assert_true(cipc_edge_edge_cross2(x) == 0.0);
    assert_true(cipc_edge_edge_mollifier_value(x, 1.0) == 0.0);
    cipc_edge_edge_mollifier_gradient(x, 1.0, g);
    cipc_edge_edge_mollifier_hessian(x, 1.0, H);
    for (int k = 0; k < 12; k++) assert_true(g[k] == 0.0);
    assert_true(H[12 * 4 + 4] == 2.0 / 1.0 * 2.0 * 4.0); /* e'(0) d2c/day2 = 2/eps 2 |b|^2 */
}

static void test_hessian_is_symmetric_to_the_bit(void **state)
{
    (void)state;
    uint64_t seed = 72;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], H[144], eps = draw(&seed, sample, x);
        cipc_edge_edge_mollifier_hessian(x, eps, H);
        for (int i = 0; i < 12; i++)
            for (int j = 0; j < i; j++) assert_true(H[12 * i + j] == H[12 * j + i]);
    }
}

/* A published bug: the gradient's sign and factor wrong. */
static void test_checker_rejects(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0.25, 0, 0, 0, 1, 1, 0.5, 1.125};
    double eps = 4.0, g[12], H[144];
    edge_lengths l = lengths_of(x);
    cipc_edge_edge_mollifier_gradient(x, eps, g);
    cipc_edge_edge_mollifier_hessian(x, eps, H);
    g[10] = -g[10];
    H[12 * 4 + 9] += 1e-9;
    assert_true(gradient_error(exact_mollifier, &eps, x, 12, g) > GRADIENT_TOLERANCE * 2.0 / eps * l.longest * l.a * l.b);
    assert_true(hessian_error(exact_mollifier, &eps, x, 12, H) >
                HESSIAN_TOLERANCE * 2.0 / eps * l.longest * l.longest * (1.0 + l.a * l.b / sqrt(eps)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),
        cmocka_unit_test(test_off),
        cmocka_unit_test(test_parallel),
        cmocka_unit_test(test_hessian_is_symmetric_to_the_bit),
        cmocka_unit_test(test_checker_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
