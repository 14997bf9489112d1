/* Lines into capsules: the point of entry lies on the surface, nothing of the capsule lies before it, and lines that pass by are told from
 * those that hit, by the distance between line and segment. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "output/capsule.h"

static double distance_to_segment(const double p[3], const double a[3], const double b[3])
{
    double axis[3], q[3];
    v3_sub(axis, b, a);
    v3_sub(q, p, a);
    const double length2 = v3_dot(axis, axis), t = length2 > 0 ? fmin(fmax(v3_dot(q, axis) / length2, 0), 1) : 0;
    v3_axpy(q, -t, axis);
    return v3_norm(q);
}

static void point_at(double p[3], const double origin[3], const double direction[3], double t)
{
    v3_copy(p, origin);
    v3_axpy(p, t, direction);
}

/* Smallest distance of the line's points from the segment, by walking it: a twin that knows no formula. */
static double closest_approach(const double origin[3], const double direction[3], const cipc_capsule *c)
{
    enum { STEPS = 2000 };
    double least = INFINITY;
    for (int i = 0; i <= STEPS; i++) {
        double p[3];
        point_at(p, origin, direction, -1 + 4.0 * i / STEPS);
        least = fmin(least, distance_to_segment(p, c->a, c->b));
    }
    return least;
}

static double uniform(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed / 2147483648.0 - 1;
}

static void check_entry(const cipc_capsule *c, const double origin[3], const double direction[3], double t, const double normal[3])
{
    const double rounding = 1e-9; /* a square root of the difference of squares near a grazing line */
    double entry[3], before[3], inward[3];
    point_at(entry, origin, direction, t);
    assert_true(fabs(distance_to_segment(entry, c->a, c->b) - c->radius) < rounding);
    assert_true(fabs(v3_norm(normal) - 1) < rounding);
    assert_true(v3_dot(normal, direction) <= rounding);
    point_at(before, origin, direction, t - 1e-3); /* it comes from outside */
    assert_true(distance_to_segment(before, c->a, c->b) > c->radius);
    v3_copy(inward, entry);
    v3_axpy(inward, -c->radius, normal); /* the normal points away from the segment */
    assert_true(distance_to_segment(inward, c->a, c->b) < rounding);
}

static void test_random_lines(void **state)
{
    (void)state;
    unsigned seed = 7;
    const double step = 0.002 * 6; /* of the walk, times the longest direction */
    int hits = 0, misses = 0;
    for (int i = 0; i < 2000; i++) {
        cipc_capsule c = {.radius = 0.05 + 0.2 * fabs(uniform(&seed))};
        double origin[3], direction[3], t, normal[3];
        for (int k = 0; k < 3; k++) {
            c.a[k] = uniform(&seed);
            c.b[k] = i % 4 == 0 ? c.a[k] : uniform(&seed); /* every fourth is a ball */
            origin[k] = 2 * uniform(&seed);
            direction[k] = 0.5 * (c.a[k] + c.b[k]) + 0.4 * uniform(&seed) - origin[k]; /* roughly towards it */
        }
        const double least = closest_approach(origin, direction, &c);
        const bool entered = cipc_capsule_enter(&c, origin, direction, &t, normal);
        if (entered) {
            check_entry(&c, origin, direction, t, normal);
            hits++;
        } else {
            assert_true(least > c.radius - step);
            misses++;
        }
        assert_true(entered || least > c.radius); /* the walk enters only where there is something */
    }
    assert_true(hits > 500 && misses > 500);
}

/* Along the axis the side is never met: in through the ball at the first end, whichever way. */
static void test_along_the_axis(void **state)
{
    (void)state;
    const cipc_capsule c = {{0, 0, 1}, {0, 0, 4}, 0.5};
    const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, 1}, back[3] = {0, 0, -2}, beside[3] = {0.6, 0, 0};
    double t, n[3];
    assert_true(cipc_capsule_enter(&c, origin, ahead, &t, n));
    assert_true(t == 0.5 && n[2] == -1);
    assert_true(cipc_capsule_enter(&c, origin, back, &t, n));
    assert_true(t == -2.25 && n[2] == 1);
    assert_false(cipc_capsule_enter(&c, beside, ahead, &t, n));
}

/* What is no line or no capsule is missed. */
static void test_not_numbers(void **state)
{
    (void)state;
    const cipc_capsule c = {{0, 0, 1}, {0, 0, (double)NAN}, 0.5}, ball = {{0, 0, 1}, {0, 0, 1}, 0.5};
    const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, 1}, nowhere[3] = {0, 0, 0};
    double t, n[3];
    assert_false(cipc_capsule_enter(&ball, origin, nowhere, &t, n));
    assert_true(cipc_capsule_enter(&ball, origin, ahead, &t, n));
    assert_true(!cipc_capsule_enter(&c, origin, ahead, &t, n) || t == 0.5); /* at most as the ball that it has */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_lines),
        cmocka_unit_test(test_along_the_axis),
        cmocka_unit_test(test_not_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
