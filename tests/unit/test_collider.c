/* Signed distance of bodies given by formulas: against their support functions, which share no formula with it; normals by differences; digits near edges; queries without a nearest point. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "support/colliders.h"
#include "support/exact_geometry.h"

/* Some thirty operations on lengths of at most some metres, and as many in the support function. */
static const double ROUNDINGS = 3e-14;

/* A half space that contains the body is as far from x as the distance says: with the normal. And no other is further: random ones, and ones ever nearer to the normal. Returns the distance. */
static double assert_distance(uint64_t *seed, const cipc_collider *c, const double x[3])
{
    double n[3], u[3];
    const double distance = cipc_collider_distance(c, x, n);
    if (!(fabs(v3_norm(n) - 1) <= 4 * DBL_EPSILON)) fail_msg("%s: normal %.17g %.17g %.17g at a distance of %.17g", collider_names[c->kind], n[0], n[1], n[2], distance);
    assert_true(cipc_collider_distance(c, x, NULL) == distance);
    if (!(fabs(collider_support_gap(c, n, x) - distance) <= ROUNDINGS)) fail_msg("%s: %.17g, its half space says %.17g", collider_names[c->kind], distance, collider_support_gap(c, n, x));
    for (int trial = 0; trial < 100; trial++) {
        random_direction(seed, u);
        if (trial % 2) {
            v3_scale(u, pow(10, random_uniform(seed, -6, 0)), u);
            v3_add(u, u, n);
            v3_scale(u, 1 / v3_norm(u), u);
        }
        if (!(collider_support_gap(c, u, x) <= distance + ROUNDINGS)) fail_msg("%s: %.17g, another half space says %.17g", collider_names[c->kind], distance, collider_support_gap(c, u, x));
    }
    return distance;
}

static cipc_collider_kind random_kind(uint64_t *seed) { return (cipc_collider_kind)(CIPC_COLLIDER_SPHERE + random_below(seed, COLLIDER_KINDS - 1)); }

/* Anywhere, near the surface, on the axis or deep inside. */
static void random_point(uint64_t *seed, const cipc_collider *c, double x[3])
{
    const int where = random_below(seed, 4);
    double n[3];
    random_fill(seed, x, 3, 2);
    if (where == 0) return;
    v3_copy(x, c->center);
    random_direction(seed, n);
    v3_axpy(x, random_uniform(seed, 0, where == 1 ? fmin(fmin(c->half[0], c->half[1]), c->half[2]) : 1.5), where == 2 ? c->axis : n);
    if (where == 3) v3_axpy(x, pow(10, random_uniform(seed, -12, -1)) - cipc_collider_distance(c, x, n), n);
}

static void test_against_half_spaces(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int inside[COLLIDER_KINDS] = {0}, outside[COLLIDER_KINDS] = {0};
    for (int trial = 0; trial < 20000; trial++) {
        double x[3];
        const cipc_collider c = random_collider(&seed, random_kind(&seed), 1e-3);
        random_point(&seed, &c, x);
        (assert_distance(&seed, &c, x) < 0 ? inside : outside)[c.kind]++;
    }
    for (int kind = CIPC_COLLIDER_SPHERE; kind < COLLIDER_KINDS; kind++) assert_true(inside[kind] > 500 && outside[kind] > 500);
}

/* From a point of the plane: 3 m aside, then s along the normal. */
static void test_plane(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int trial = 0; trial < 1000; trial++) {
        const cipc_collider plane = random_collider(&seed, CIPC_COLLIDER_PLANE, 0.1);
        double x[3], aside[3], n[3], u[3];
        const double s = random_uniform(&seed, -2, 2);
        random_direction(&seed, u);
        v3_cross(aside, plane.axis, u);
        v3_copy(x, plane.center);
        v3_axpy(x, 3, aside);
        v3_axpy(x, s, plane.axis);
        assert_true(fabs(cipc_collider_distance(&plane, x, n) - s) <= ROUNDINGS);
        for (int k = 0; k < 3; k++) assert_true(n[k] == plane.axis[k]);
    }
}

/* By hand: a cone of slope 1 to 4 between balls of 0.5 m and 0.25 m that are 1 m apart. */
static void test_closed_forms(void **state)
{
    (void)state;
    const cipc_collider cone = {.kind = CIPC_COLLIDER_CAPSULE, .center = {0, 0, 0}, .axis = {1, 0, 0}, .half = {0.5, 0.25, 0}};
    double n[3];
    assert_true(cipc_collider_distance(&cone, (double[3]){2, 0, 0}, n) == 0.75 && n[0] == 1);
    assert_true(cipc_collider_distance(&cone, (double[3]){-1, 0, 0}, n) == 0.5 && n[0] == -1);
    for (int k = 0; k <= 4; k++) assert_true(fabs(cipc_collider_distance(&cone, (double[3]){0.25 * k, 0, 0}, NULL) + 0.5 - 0.0625 * k) <= DBL_EPSILON);
    const double sine = 0.25, cosine = sqrt(15) / 4, on_cone[3] = {0.5 + 0.675 * sine, 0, 0.675 * cosine}; /* 0.375 + 0.3 from the axis, where the inner ball's radius is 0.375 */
    assert_true(fabs(cipc_collider_distance(&cone, on_cone, n) - 0.3) <= 4 * DBL_EPSILON);
    assert_true(fabs(n[0] - sine) <= 2 * DBL_EPSILON && fabs(n[2] - cosine) <= 2 * DBL_EPSILON);
    const cipc_collider table = {.kind = CIPC_COLLIDER_DISC, .center = {1, 1, 1}, .axis = {0, 0, -1}, .half = {2, 0.25, 0}};
    assert_true(cipc_collider_distance(&table, (double[3]){2, 1, 1.75}, n) == 0.5 && n[2] == 1);
    assert_true(cipc_collider_distance(&table, (double[3]){6, 1, 1}, n) == 3 && n[0] == 1);
    assert_true(cipc_collider_distance(&table, (double[3]){6, 1, -3.25}, n) == sqrt(9 + 16) && fabs(n[2] + 0.8) <= DBL_EPSILON);
    assert_true(cipc_collider_distance(&table, (double[3]){1.5, 1, 1.125}, n) == -0.125 && n[2] == 1);
}

/* Beyond an edge by 3 and 4 units of 2^-44 m it is 5 units to it, all of them exact. */
static void test_digits_near_edges(void **state)
{
    (void)state;
    const double u = 0x1p-44, x[3] = {1 + 3 * u, 0, 1 + 4 * u};
    const cipc_collider box = {.kind = CIPC_COLLIDER_BOX, .half = {1, 1, 1}}, disc = {.kind = CIPC_COLLIDER_DISC, .axis = {0, 0, 1}, .half = {1, 1, 0}};
    const cipc_collider *const both[2] = {&box, &disc};
    for (int k = 0; k < 2; k++) {
        double n[3];
        assert_true(cipc_collider_distance(both[k], x, n) == 5 * u);
        assert_true(fabs(n[0] - 0.6) <= DBL_EPSILON && n[1] == 0 && fabs(n[2] - 0.8) <= DBL_EPSILON);
        assert_true(cipc_collider_distance(both[k], (double[3]){1 - 3 * u, 0, 1 - 4 * u}, n) == -3 * u && n[0] == 1);
    }
    assert_true(cipc_collider_distance(&box, (double[3]){1 + 2 * u, 1 + 3 * u, -1 - 6 * u}, NULL) == 7 * u);
}

/* Beside the axis by 1e-14 of the distance along it the normal of a tall cylinder has to be across the axis all the same. */
static void test_normals_near_the_axis(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int trial = 0; trial < 1000; trial++) {
        cipc_collider c = random_collider(&seed, CIPC_COLLIDER_DISC, 0.1);
        double x[3] = {0, 0, 0}, n[3], aside[3], u[3];
        c.half[0] = 0.01;
        c.half[1] = 2;
        for (int k = 0; k < 3; k++) c.center[k] = 0;
        random_direction(&seed, u);
        v3_cross(aside, c.axis, u);
        v3_axpy(x, random_uniform(&seed, -1.5, 1.5), c.axis);
        v3_axpy(x, 1e-14, aside);
        assert_true(fabs(cipc_collider_distance(&c, x, n) + 0.01) <= 2e-14);
        assert_true(fabs(v3_dot(n, c.axis)) <= 4 * DBL_EPSILON && fabs(v3_norm(n) - 1) <= 4 * DBL_EPSILON);
    }
}

/* No two points differ in distance by more than they are apart; some nearly as much. */
static void test_lipschitz(void **state)
{
    (void)state;
    uint64_t seed = 4;
    double most[COLLIDER_KINDS] = {0};
    for (int trial = 0; trial < 200000; trial++) {
        const cipc_collider c = random_collider(&seed, (cipc_collider_kind)random_below(&seed, COLLIDER_KINDS), 1e-3);
        double x[3], y[3], u[3];
        random_fill(&seed, x, 3, 2);
        random_direction(&seed, u);
        v3_copy(y, x);
        v3_axpy(y, pow(10, random_uniform(&seed, -6, 0.5)), u);
        v3_sub(u, y, x);
        const double change = fabs(cipc_collider_distance(&c, y, NULL) - cipc_collider_distance(&c, x, NULL)), way = v3_norm(u);
        assert_true(change <= way + ROUNDINGS);
        most[c.kind] = fmax(most[c.kind], change / way);
    }
    for (int kind = 0; kind < COLLIDER_KINDS; kind++) assert_true(most[kind] > 0.99);
}

/* Over the step the normal turns by `bend`: central differences are off by less than its square where the distance is smooth, and by a quarter of it where the curvature jumps, as where a face goes
 * over into an edge; 1e-9 is for rounding. Where the normal turns by much, a ridge of the distance lies in between. */
static void test_normals_by_differences(void **state)
{
    (void)state;
    const double h = 1e-5;
    uint64_t seed = 5;
    int compared[COLLIDER_KINDS] = {0}, ridges = 0;
    for (int trial = 0; trial < 20000; trial++) {
        const cipc_collider c = random_collider(&seed, (cipc_collider_kind)random_below(&seed, COLLIDER_KINDS), 0.05);
        double x[3], n[3], difference[3], bend = 0;
        random_fill(&seed, x, 3, 1.5);
        cipc_collider_distance(&c, x, n);
        for (int k = 0; k < 3; k++) {
            double y[3], left[3], right[3], jump[3];
            v3_copy(y, x);
            y[k] = x[k] - h;
            const double before = cipc_collider_distance(&c, y, left);
            y[k] = x[k] + h;
            difference[k] = (cipc_collider_distance(&c, y, right) - before) / (2 * h);
            v3_sub(jump, right, left);
            bend = fmax(bend, v3_norm(jump));
        }
        if (bend > 0.01) { ridges++; continue; }
        for (int k = 0; k < 3; k++) assert_true(fabs(difference[k] - n[k]) <= bend * bend + bend / 4 + 1e-9);
        compared[c.kind]++;
    }
    for (int kind = 0; kind < COLLIDER_KINDS; kind++) assert_true(compared[kind] > 3000);
    assert_true(ridges < 200);
}

/* Where many points of the surface are nearest, one of them is chosen. */
static void test_no_nearest_point(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int trial = 0; trial < 2000; trial++) {
        const cipc_collider c = random_collider(&seed, random_kind(&seed), 1e-3);
        double x[3];
        assert_distance(&seed, &c, c.center);
        if (c.kind == CIPC_COLLIDER_CAPSULE) assert_distance(&seed, &c, c.axis);
        v3_copy(x, c.center);
        v3_axpy(x, c.half[1] / 2, c.kind == CIPC_COLLIDER_DISC ? c.axis : (double[3]){1, 0, 0});
        assert_distance(&seed, &c, x);
    }
    const cipc_collider point = {.kind = CIPC_COLLIDER_CAPSULE, .center = {1, 2, 3}, .axis = {1, 2, 3}, .half = {0.25, 0.25, 0}}; /* ends that coincide: a ball */
    assert_true(assert_distance(&seed, &point, point.center) == -0.25);
    assert_true(assert_distance(&seed, &point, (double[3]){1, 3, 3}) == 0.75);
    const cipc_collider inner = {.kind = CIPC_COLLIDER_CAPSULE, .center = {0, 0, 0}, .axis = {0.25, 0, 0}, .half = {0.25, 0.5, 0}}; /* one ball touches the other from inside */
    assert_true(assert_distance(&seed, &inner, (double[3]){-1, 0, 0}) == 0.75);
    assert_true(assert_distance(&seed, &inner, (double[3]){0, 0, 0}) == -0.25);
    assert_true(assert_distance(&seed, &inner, (double[3]){0.25, 0, 0}) == -0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_half_spaces),
        cmocka_unit_test(test_plane),
        cmocka_unit_test(test_closed_forms),
        cmocka_unit_test(test_digits_near_edges),
        cmocka_unit_test(test_normals_near_the_axis),
        cmocka_unit_test(test_lipschitz),
        cmocka_unit_test(test_normals_by_differences),
        cmocka_unit_test(test_no_nearest_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
