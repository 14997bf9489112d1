/* Near-parallel edges over sixteen orders of magnitude of the angle: what the line-line formulas reach against MPFR, with and without the mollifier, and what
 * they would reach with the plain cross product (docs/theory/distance.md, sections 5 and 7; the table there is what this test prints). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/energy.h"
#include "cipc/oracle.h"
#include "energy/samplers.h"
#include "verify/condition.h"

enum { N = 12, TRIALS = 3, ORDERS = 16 };
static const unsigned long SEED = 20261127;
static const double u = VERIFY_UNIT;
/* eps_x of SPEC D.3 for edges of length 1: mollified below an angle of 0.03. */
static const double MOLLIFIER_EPS = 1e-3;

/* Two edges of length 1 at the angle and distance given, crossing well inside, turned at random; 2 is a bound of their size S. */
static void draw(gsl_rng *rng, double angle, double distance, double x[N])
{
    double R[3][3], o = energy_draw_uniform(rng, 0.2, 0.8), f = energy_draw_uniform(rng, 0.2, 0.8), c = cos(angle), s = sin(angle);
    const double local[N] = {-o * c, -o * s, distance, (1 - o) * c, (1 - o) * s, distance, -f, 0, 0, 1 - f, 0, 0};
    energy_draw_rotation(rng, R);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) x[3 * i + k] = v3_dot(local + 3 * i, R[k]);
}

/* (4) of distance.md without (9): the rounding of the cross product stays in. */
static double plain_distance2(const double x[N])
{
    double w[3], a[3], b[3], n[3];
    v3_sub(w, x, x + 6);
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 9, x + 6);
    v3_cross(n, a, b);
    double height = v3_dot(w, n);
    return height * height / v3_norm2(n);
}

/* Largest errors at one angle: of d over d; of gradients and Hessians over their largest entry, and over the tolerance. */
typedef struct line {
    double plain, distance, bound; /* |d - d*| / d, and the bound of section 5 */
    double g, H, H_most, g_over, H_over;
    double soft_g, soft_H, soft_H_most, soft_g_over, soft_H_over;
    int undetermined, soft_undetermined; /* trials whose Hessian a rounding of the nodes changes altogether */
} line;

typedef struct derivatives {
    double value, g[N], H[N * N];
} derivatives;

/* Raise the line's entries to these errors. */
static void compare(const cipc_oracle_function *f, const double *x, const double *fields, const derivatives *got, double size, double most[5], int *undetermined)
{
    derivatives want;
    if (cipc_oracle_evaluate(f, x, fields, &want.value, want.g, want.H) != CIPC_YES) fail_msg("%s: undecided", f->name);
    double change = verify_hessian_change(f, x, fields, want.g, want.H, size, 0x5a3c96);
    verify_tolerances tolerance = verify_tolerances_of(want.value, want.g, want.H, N, size, change);
    double g_error = verify_largest_error(got->g, want.g, N), H_error = verify_largest_error(got->H, want.H, N * N), H_most = verify_largest(want.H, N * N);
    *undetermined += change == INFINITY;
    most[0] = fmax(most[0], g_error / verify_largest(want.g, N));
    most[1] = fmax(most[1], H_error / H_most);
    most[2] = fmax(most[2], H_most);
    most[3] = fmax(most[3], g_error / tolerance.gradient);
    most[4] = fmax(most[4], H_error / tolerance.hessian);
}

static void measure(gsl_rng *rng, double angle, double distance, line *l)
{
    double x[N], size = 0, hard[5] = {0}, soft[5] = {0}, fields[CIPC_ENERGY_NUMBERS];
    derivatives got;
    draw(rng, angle, distance, x);
    for (int i = 0; i < N; i++) size = fmax(size, fabs(x[i] - x[i % 3]));
    const cipc_oracle_function *lines = cipc_oracle_function_find("distance2_line_line"), *barrier = cipc_oracle_function_find("barrier_edge_edge");
    cipc_contact_barrier params = {.stiffness = 1, .weight = 1, .dhat = 2 * distance, .mollifier_eps = MOLLIFIER_EPS, .feature = cipc_feature_at(CIPC_EDGE_EDGE, 8)};
    double d = sqrt(cipc_line_line_distance2_value(x)), d2;
    assert_int_equal(cipc_oracle_evaluate(lines, x, NULL, &d2, NULL, NULL), CIPC_YES);
    l->distance = fmax(l->distance, fabs(d - sqrt(d2)) / sqrt(d2));
    l->plain = fmax(l->plain, fabs(sqrt(plain_distance2(x)) - sqrt(d2)) / sqrt(d2));
    cipc_line_line_distance2_gradient(x, got.g);
    cipc_line_line_distance2_hessian(x, got.H);
    compare(lines, x, NULL, &got, size, hard, &l->undetermined);
    cipc_energy_numbers(cipc_energy_find("barrier_edge_edge"), &params, fields);
    cipc_barrier_edge_edge_gradient(x, &params, got.g);
    cipc_barrier_edge_edge_hessian(x, &params, got.H);
    compare(barrier, x, fields, &got, size, soft, &l->soft_undetermined);
    double *const to[10] = {&l->g, &l->H, &l->H_most, &l->g_over, &l->H_over, &l->soft_g, &l->soft_H, &l->soft_H_most, &l->soft_g_over, &l->soft_H_over};
    for (int i = 0; i < 10; i++) *to[i] = fmax(*to[i], i < 5 ? hard[i] : soft[i - 5]);
}

/* Section 5: 4 u S max |w| / d + (4 u / sin)^2, with S = 2, weights below 1, and as much again for what the formula does to n. */
static double distance_bound(double angle, double distance) { return 16 * u / distance + 2 * pow(4 * u / sin(angle), 2); }

static void sweep(double distance, line lines[ORDERS + 1])
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, SEED);
    print_message("d = %g S\n angle   d, plain cross   d    grad d2  Hess d2  |Hess d2|  (over tolerance)   mollified: grad  Hess  |Hess|  (over tolerance)\n", distance);
    for (int k = 0; k <= ORDERS; k++) {
        line *l = &lines[k];
        double angle = pow(10, -k);
        memset(l, 0, sizeof *l);
        l->bound = distance_bound(angle, distance);
        for (int t = 0; t < TRIALS; t++) measure(rng, angle, distance, l);
        print_message(" 1e-%02d  %.0e %.0e (%.0e)  %.0e %.0e %.0e (%.2f %.2f)  %.0e %.0e %.0e (%.2f %.2f)%s\n", k, l->plain, l->distance, l->bound, l->g, l->H,
                      l->H_most, l->g_over, l->H_over, l->soft_g, l->soft_H, l->soft_H_most, l->soft_g_over, l->soft_H_over,
                      l->soft_undetermined > 0 ? "  no doubles determine either Hessian" : l->undetermined > 0 ? "  no doubles determine Hess d2" : "");
    }
    gsl_rng_free(rng);
}

static void check(double distance)
{
    line lines[ORDERS + 1];
    sweep(distance, lines);
    for (int k = 0; k <= ORDERS; k++) {
        const line *l = &lines[k];
        double angle = pow(10, -k);
        if (!(l->distance <= l->bound)) fail_msg("angle 1e-%d: d is off by %g d, more than %g", k, l->distance, l->bound);
        if (!(l->g_over <= 1) || !(l->H_over <= 1)) fail_msg("angle 1e-%d: derivatives of d^2 beyond their condition", k);
        if (!(l->soft_g_over <= 1) || !(l->soft_H_over <= 1)) fail_msg("angle 1e-%d: derivatives of the mollified barrier beyond their condition", k);
        /* The growth is in the function: 8 (d/sin)^2, where that is larger than the 2 of parallel planes. */
        if (distance / angle > 10) assert_in_range((long)(100 * l->H_most / pow(distance / angle, 2)), 1, 3000);
    }
    /* With the mollifier the Hessian does not grow as the angle falls, and neither does its error as long as (u/sin)^2 is below the rounding that is there
     * anyway. */
    for (int k = 3; k < ORDERS; k++) assert_true(lines[k].soft_H_most <= 2 * lines[k - 1].soft_H_most);
    for (int k = 2; k < ORDERS; k++) {
        double limit = 64 * u / distance + pow(16 * u / pow(10, -k), 2);
        if (!(lines[k].soft_H <= limit)) fail_msg("angle 1e-%d: the mollified Hessian is off by %g, more than %g", k, lines[k].soft_H, limit);
    }
    /* The plain cross product loses the distance to u/sin: the bound of section 5 does notice. */
    assert_true(lines[8].plain > lines[8].bound && lines[9].plain > lines[9].bound);
}

static void test_far(void **state)
{
    (void)state;
    check(0.1);
}

static void test_near(void **state)
{
    (void)state;
    check(0.01);
}

static void test_close(void **state)
{
    (void)state;
    check(1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_far), cmocka_unit_test(test_near), cmocka_unit_test(test_close)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
