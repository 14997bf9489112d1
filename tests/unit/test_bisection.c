/* Bisection: iterations on planes counted exactly, the root on spheres, bounds on any body, what is detected and what is not, and an end in every case. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "support/colliders.h"
#include "support/exact_geometry.h"

static const double ROUNDINGS = 3e-14; /* some thirty operations on lengths of some metres */

static const cipc_collider ground = {.kind = CIPC_COLLIDER_PLANE, .axis = {0, 1, 0}};

static cipc_bisection_result fall(cipc_bisection_method method, double height, double way, double threshold)
{
    return cipc_bisection(method, &ground, (double[3]){0.5, height, 0}, (double[3]){-0.25, -way, 0}, threshold);
}

/* The distance is told of the very point that the caller gets from t. */
static double distance_at(const cipc_collider *c, const double x[3], const double d[3], double t)
{
    double at[3];
    for (int k = 0; k < 3; k++) at[k] = x[k] + t * d[k];
    return cipc_collider_distance(c, at, NULL);
}

/* Heights p, ways D and thresholds m in units of 2^-20 m: all that plain bisection computes is exact. After k midpoints the lower end is floor(2^k p/D)/2^k, and the node is below the threshold
 * there if and only if (2^k p mod D)/2^k < m. */
static int iterations_on_a_plane(uint64_t p, uint64_t D, uint64_t m)
{
    int k = 0;
    while (!(((p << k) % D) < (m << k))) k++;
    return k;
}

static int least_power_of_two_at_least(double ratio)
{
    int k = 0;
    while (ldexp(1, k) < ratio) k++;
    return k;
}

/* Plain bisection takes what is counted above, at most ceil(log2(D/m)), and that for heights just below the way's length; an interpolation hits the middle of the band at once. */
static void test_planes_exactly(void **state)
{
    (void)state;
    const double unit = 0x1p-20;
    uint64_t seed = 1;
    for (int trial = 0; trial < 20000; trial++) {
        const uint64_t D = 2 + random_bits(&seed) % 0xFFFFF, m = 1 + random_bits(&seed) % ((D - 1) >> random_below(&seed, 20) | 1);
        if (m >= D) continue;
        const int most = least_power_of_two_at_least((double)D / (double)m);
        const uint64_t p = trial % 4 ? m + random_bits(&seed) % (D - m) : D - 1;
        const cipc_bisection_result plain = fall(CIPC_BISECTION_PLAIN, (double)p * unit, (double)D * unit, (double)m * unit);
        const cipc_bisection_result improved = fall(CIPC_BISECTION_IMPROVED, (double)p * unit, (double)D * unit, (double)m * unit);
        assert_true(plain.hit && improved.hit);
        assert_int_equal(plain.iterations, iterations_on_a_plane(p, D, m));
        assert_true(plain.iterations <= most);
        assert_int_equal(improved.iterations, 1);
        assert_true(plain.distance >= 0 && plain.distance < (double)m * unit);
        assert_true(fabs(improved.distance - 0.5 * (double)m * unit) <= ROUNDINGS);
    }
    for (int k = 1; k <= 19; k++) { /* the most is reached: D/m = 2^k, the surface one unit from the end */
        const uint64_t D = 1u << 20, m = D >> k;
        assert_int_equal(fall(CIPC_BISECTION_PLAIN, (double)(D - 1) * unit, (double)D * unit, (double)m * unit).iterations, k);
        assert_int_equal(iterations_on_a_plane(D - 1, D, m), k);
    }
}

/* Root of |x + t d - c| = R on the way in, by the form that does not cancel. */
static double entry_time(const cipc_collider *sphere, const double x[3], const double d[3])
{
    double from[3];
    v3_sub(from, x, sphere->center);
    const double distance = v3_norm(from), b = -v3_dot(from, d), c = (distance - sphere->half[0]) * (distance + sphere->half[0]);
    return c / (b + sqrt(fmax(b * b - v3_norm2(d) * c, 0)));
}

/* The distance falls along the way at least as fast as at the root, as it is convex: below m is within m/|slope| before it. */
static void test_roots_of_spheres(void **state)
{
    (void)state;
    uint64_t seed = 2;
    int count = 0;
    while (count < 5000) {
        const cipc_collider sphere = random_collider(&seed, CIPC_COLLIDER_SPHERE, 0.05);
        const double m = pow(10, random_uniform(&seed, -8, -2));
        double x[3], d[3], at[3], n[3];
        random_fill(&seed, x, 3, 2);
        random_fill(&seed, d, 3, 2);
        if (cipc_collider_distance(&sphere, x, NULL) < m || distance_at(&sphere, x, d, 1) >= 0) continue;
        count++;
        const double root = entry_time(&sphere, x, d);
        v3_copy(at, x);
        v3_axpy(at, root, d);
        assert_true(fabs(cipc_collider_distance(&sphere, at, n)) <= ROUNDINGS);
        const double slope = -v3_dot(n, d);
        for (int method = 0; method < 2; method++) {
            const cipc_bisection_result r = cipc_bisection((cipc_bisection_method)method, &sphere, x, d, m);
            assert_true(r.hit && r.distance >= 0 && r.distance < m);
            assert_true(r.distance == distance_at(&sphere, x, d, r.t));
            assert_true(r.t <= root + ROUNDINGS / slope && r.t >= root - (m + ROUNDINGS) / slope);
        }
    }
}

/* N + 5 + 3 floor(log3(2 N - 1)), (8). */
static int bound_of_improved(int N)
{
    int sum = N + 5;
    for (int power = 3; power <= 2 * N - 1; power *= 3) sum += 3;
    return sum;
}

/* Any body: both end outside by less than the threshold, plain within ceil(log2(|d|/m)) and improved within few more, (8). */
static void test_bounds(void **state)
{
    (void)state;
    uint64_t seed = 3;
    int count[COLLIDER_KINDS] = {0}, most_above = 0;
    for (int trial = 0; trial < 200000; trial++) {
        const cipc_collider c = random_collider(&seed, (cipc_collider_kind)random_below(&seed, COLLIDER_KINDS), 0.02);
        const double m = pow(10, random_uniform(&seed, -8, -1));
        double x[3], d[3], end[3];
        random_fill(&seed, x, 3, 2);
        random_fill(&seed, end, 3, 0.5);
        v3_add(end, end, c.center);
        v3_sub(d, end, x);
        if (cipc_collider_distance(&c, x, NULL) < 0) continue;
        const int bound = least_power_of_two_at_least(v3_norm(d) / m);
        const bool hit = distance_at(&c, x, d, 1) < 0;
        int iterations[2];
        for (int method = 0; method < 2; method++) {
            const cipc_bisection_result r = cipc_bisection((cipc_bisection_method)method, &c, x, d, m);
            assert_true(r.hit == hit && r.distance >= 0 && r.distance == distance_at(&c, x, d, r.t));
            assert_true(hit ? r.distance < m && r.t < 1 : r.t == 1 && r.iterations == 0);
            iterations[method] = r.iterations;
        }
        assert_true(iterations[0] <= bound && iterations[1] <= bound_of_improved(bound));
        most_above = (int)fmax(most_above, iterations[1] - iterations[0]);
        count[c.kind] += hit;
    }
    for (int kind = 0; kind < COLLIDER_KINDS; kind++) assert_true(count[kind] > 300);
    print_message("improved bisection takes at most %d iterations more than plain on the same way\n", most_above);
}

/* All but through a table or a ball: from 1 m outside to 1e-12 m inside at the far side. */
static void test_nearly_through(void **state)
{
    (void)state;
    const cipc_collider table = {.kind = CIPC_COLLIDER_BOX, .half = {1, 0.05, 1}}, ball = {.kind = CIPC_COLLIDER_SPHERE, .half = {0.05, 0, 0}};
    const cipc_collider *const both[2] = {&table, &ball};
    const double x[3] = {0, 1.05, 0}, d[3] = {0, -1.1 + 1e-12, 0};
    for (int k = 0; k < 2; k++)
        for (double m = 1e-2; m > 1e-6; m *= 0.7) {
            const cipc_bisection_result r = cipc_bisection(CIPC_BISECTION_IMPROVED, both[k], x, d, m);
            assert_true(r.hit && r.distance >= 0 && r.distance < m);
            assert_true(r.iterations <= bound_of_improved(least_power_of_two_at_least(v3_norm(d) / m)));
        }
}

/* The end of the way decides: what flies through is not seen. A start in the band stays, one that leaves goes. */
static void test_what_is_detected(void **state)
{
    (void)state;
    const cipc_collider ball = {.kind = CIPC_COLLIDER_SPHERE, .half = {0.5, 0, 0}};
    for (int method = 0; method < 2; method++) {
        const cipc_bisection_method by = (cipc_bisection_method)method;
        cipc_bisection_result r = cipc_bisection(by, &ball, (double[3]){-1, 0, 0}, (double[3]){2, 0, 0}, 1e-3);
        assert_true(!r.hit && r.t == 1 && r.distance == 0.5 && r.iterations == 0);
        r = fall(by, 0.125, -1, 0.25); /* in the band, leaving */
        assert_true(!r.hit && r.t == 1 && r.distance == 1.125);
        r = fall(by, 0.125, 1, 0.25); /* in the band, going in */
        assert_true(r.hit && r.t == 0 && r.distance == 0.125 && r.iterations == 0);
        r = fall(by, 0, 1, 0.25); /* on the surface */
        assert_true(r.hit && r.t == 0 && r.distance == 0 && r.iterations == 0);
        r = fall(by, 0.25, 1, 0.25); /* the band is open above */
        assert_true(r.hit && r.t > 0 && r.distance < 0.25);
        r = fall(by, 1, 1, 0.25); /* ends on the surface: not inside */
        assert_true(!r.hit && r.t == 1 && r.distance == 0);
        r = fall(by, -0.25, 1, 0.25); /* inside from the start: stays, and says so */
        assert_true(r.hit && r.t == 0 && r.distance == -0.25 && r.iterations == 0);
    }
}

/* Thresholds finer than the numbers near the surface: the last number before it, and an end. */
static void test_always_ends(void **state)
{
    (void)state;
    uint64_t seed = 4;
    int unmet = 0;
    for (int trial = 0; trial < 5000; trial++) {
        const cipc_collider c = random_collider(&seed, (cipc_collider_kind)random_below(&seed, COLLIDER_KINDS), 0.02);
        double x[3], d[3], end[3];
        random_fill(&seed, x, 3, 2);
        random_fill(&seed, end, 3, 2);
        v3_sub(d, end, x);
        if (cipc_collider_distance(&c, x, NULL) < 0) continue;
        for (int method = 0; method < 2; method++) {
            const cipc_bisection_result r = cipc_bisection((cipc_bisection_method)method, &c, x, d, trial % 2 ? 1e-18 : 5e-324);
            assert_true(r.distance >= 0 && (!r.hit || (r.distance <= ROUNDINGS && r.iterations < 100)));
            unmet += r.hit && r.distance >= 1e-18;
        }
    }
    assert_true(unmet > 20);
    assert_true(!fall(CIPC_BISECTION_IMPROVED, 1, NAN, 0.1).hit && !fall(CIPC_BISECTION_IMPROVED, 1, -INFINITY, 0.1).hit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planes_exactly),
        cmocka_unit_test(test_roots_of_spheres),
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_nearly_through),
        cmocka_unit_test(test_what_is_detected),
        cmocka_unit_test(test_always_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
