/* Exact orientation signs, against rational determinants, where rounding would go wrong; and that both stages of the predicate ran. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "geometry/predicates.h"
#include "support/exact_geometry.h"

#define SAMPLES 20000
#define LEAST_PER_BRANCH 500

enum { GENERAL, NEAR_PLANE, ONE_ULP, GRID, TINY, AT_UNDERFLOW_3D, AT_UNDERFLOW_2D, HUGE_SIZE, MIXED, FAMILIES };

/* Sign of det[b-a, c-a, d-a] by rational arithmetic. */
static int reference3d(const double x[12])
{
    mpq_t y[12], u[3], v[3], w[3], n[3], determinant;
    q_init(y, 12), q_init(u, 3), q_init(v, 3), q_init(w, 3), q_init(n, 3), mpq_init(determinant);
    q_set(y, x, 12);
    q_sub(u, y + 3, y), q_sub(v, y + 6, y), q_sub(w, y + 9, y);
    q_cross(n, v, w);
    q_dot(determinant, u, n);
    int sign = mpq_sgn(determinant);
    q_clear(y, 12), q_clear(u, 3), q_clear(v, 3), q_clear(w, 3), q_clear(n, 3), mpq_clear(determinant);
    return sign;
}

/* Sign of component `axis` of (b-a) x (c-a). */
static int reference2d(const double x[9], int axis)
{
    mpq_t y[9], u[3], v[3], n[3];
    q_init(y, 9), q_init(u, 3), q_init(v, 3), q_init(n, 3);
    q_set(y, x, 9);
    q_sub(u, y + 3, y), q_sub(v, y + 6, y);
    q_cross(n, u, v);
    int sign = mpq_sgn(n[axis]);
    q_clear(y, 9), q_clear(u, 3), q_clear(v, 3), q_clear(n, 3);
    return sign;
}

static void nudge(uint64_t *seed, double *value)
{
    int way = random_below(seed, 3);
    if (way) *value = nextafter(*value, way == 1 ? INFINITY : -INFINITY);
}

/* Points in general position; on a plane but for the rounding of their coordinates; on one exactly but for an ulp; on a grid of few
 * values; of sizes where products underflow or overflow, also mixed within one determinant. */
static int draw(uint64_t *seed, double x[12])
{
    int family = random_below(seed, FAMILIES);
    random_fill(seed, x, 12, 1.0);
    if (family == NEAR_PLANE || family == ONE_ULP) {
        double s = random_uniform(seed, -1.0, 1.0), t = random_uniform(seed, -1.0, 1.0);
        for (int k = 0; k < 3; k++) x[9 + k] = x[k] + s * (x[3 + k] - x[k]) + t * (x[6 + k] - x[k]);
    }
    if (family == ONE_ULP) {
        for (int i = 0; i < 12; i++) x[i] = (double)random_below(seed, 4) + 0.1;
        nudge(seed, &x[random_below(seed, 12)]);
    }
    if (family == GRID)
        for (int i = 0; i < 12; i++) x[i] = 0.1 * (double)random_below(seed, 5);
    for (int i = 0; i < 12; i++) {
        if (family == TINY) x[i] = ldexp(x[i], -340 - random_below(seed, 720));
        if (family == AT_UNDERFLOW_3D) x[i] = ldexp(x[i], -358); /* products of three are a few of the smallest numbers */
        if (family == AT_UNDERFLOW_2D) x[i] = ldexp(x[i], -537); /* the same for two */
        if (family == HUGE_SIZE) x[i] = ldexp(x[i], 330 + random_below(seed, 690));
        if (family == MIXED) x[i] = ldexp(x[i], random_below(seed, 2000) - 1000);
    }
    return family;
}

static void test_orient3d(void **state)
{
    (void)state;
    uint64_t seed = 81;
    int signs[3] = {0}, decided = 0, undecided = 0, families[FAMILIES] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12];
        families[draw(&seed, x)]++;
        int want = reference3d(x), filter = cipc_orient3d_filter(x, x + 3, x + 6, x + 9);
        assert_int_equal(cipc_orient3d(x, x + 3, x + 6, x + 9), want);
        assert_int_equal(cipc_orient3d_exact(x, x + 3, x + 6, x + 9), want);
        if (filter != CIPC_UNDECIDED) assert_int_equal(filter, want);
        filter == CIPC_UNDECIDED ? undecided++ : decided++;
        signs[want + 1]++;
    }
    for (int i = 0; i < 3; i++) assert_true(signs[i] >= LEAST_PER_BRANCH);
    for (int i = 0; i < FAMILIES; i++) assert_true(families[i] >= LEAST_PER_BRANCH);
    assert_true(decided >= LEAST_PER_BRANCH && undecided >= LEAST_PER_BRANCH);
}

static void test_orient2d(void **state)
{
    (void)state;
    uint64_t seed = 82;
    int signs[3] = {0}, decided = 0, undecided = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12];
        draw(&seed, x);
        for (int k = 0; sample % 2 && k < 3; k++) x[6 + k] = 0.5 * (x[k] + x[3 + k]); /* collinear but for rounding */
        for (int axis = 0; axis < 3; axis++) {
            int want = reference2d(x, axis), filter = cipc_orient2d_filter(x, x + 3, x + 6, axis);
            assert_int_equal(cipc_orient2d(x, x + 3, x + 6, axis), want);
            assert_int_equal(cipc_orient2d_exact(x, x + 3, x + 6, axis), want);
            if (filter != CIPC_UNDECIDED) assert_int_equal(filter, want);
            filter == CIPC_UNDECIDED ? undecided++ : decided++;
            signs[want + 1]++;
        }
    }
    for (int i = 0; i < 3; i++) assert_true(signs[i] >= LEAST_PER_BRANCH);
    assert_true(decided >= LEAST_PER_BRANCH && undecided >= LEAST_PER_BRANCH);
}

/* The sign convention: d on the side that (b-a) x (c-a) points to is positive, and swapping two points changes the sign. */
static void test_convention(void **state)
{
    (void)state;
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    assert_int_equal(cipc_orient3d(o, x, y, z), 1);
    assert_int_equal(cipc_orient3d(o, y, x, z), -1);
    assert_int_equal(cipc_orient2d(o, x, y, 2), 1);
    assert_int_equal(cipc_orient2d(o, y, z, 0), 1);
    assert_int_equal(cipc_orient2d(o, z, x, 1), 1);
}

/* The determinant in plain double gets some of these signs wrong: the samples are hard enough for the test to mean something. */
static void test_plain_arithmetic_would_fail(void **state)
{
    (void)state;
    uint64_t seed = 83;
    int wrong = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], p[3], q[3], r[3];
        draw(&seed, x);
        for (int k = 0; k < 3; k++) p[k] = x[3 + k] - x[k], q[k] = x[6 + k] - x[k], r[k] = x[9 + k] - x[k];
        double det = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
        wrong += (det > 0.0) - (det < 0.0) != reference3d(x);
    }
    assert_true(wrong >= LEAST_PER_BRANCH);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_orient3d),
        cmocka_unit_test(test_orient2d),
        cmocka_unit_test(test_convention),
        cmocka_unit_test(test_plain_arithmetic_would_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
