/* Depths in unions of capsules. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/capsules.h"
#include "scene/random.h"

static const cipc_capsule parts[3] = {
    {{0, 0, 0}, {0, 1, 0}, {0.25, 0.25}},
    {{0, 0.5, 0}, {1, 0.5, 0}, {0.25, 0.125}},
    {{0, 1.25, 0}, {0, 1.25, 0}, {0.5, 0.5}}, /* a ball */
};

static double depth(int first, int count, double blend, double x, double y, double z)
{
    const scene_capsules shape = {count, parts + first, blend};
    return scene_capsules_depth(&shape, (const double[3]){x, y, z});
}

static void test_one_part(void **state)
{
    (void)state;
    assert_true(depth(0, 1, 0, 0, 0.5, 0) == 0.25);    /* on the axis */
    assert_true(depth(0, 1, 0, 0.25, 0.5, 0) == 0);    /* on the side */
    assert_true(depth(0, 1, 0, 0, 0.5, -1) == -0.75);  /* beside it */
    assert_true(depth(0, 1, 0, 0, -0.75, 0) == -0.5);  /* below its end */
    assert_true(fabs(depth(0, 1, 0, 0.3, 1.4, 0) - (0.25 - 0.5)) < 1e-15);
    assert_true(depth(1, 1, 0, 0.5, 0.5, 0.1875) == 0); /* tapered, half way */
    assert_true(fabs(depth(2, 1, 0, 0.3, 1.65, 0)) < 1e-15);
}

static void test_the_larger_counts(void **state)
{
    (void)state;
    assert_true(depth(0, 3, 0, 0, 1.25, 0) == 0.5);
    assert_true(depth(0, 3, 0, 1, 0.5, 0) == 0.125);
    assert_true(depth(0, 3, 0, 0, 0, 0) == 0.25);
}

/* A quarter of the blend more where two are alike, nothing where they are a blend apart, and in between neither less than the larger nor more than that. */
static void test_blend(void **state)
{
    (void)state;
    const double blend = 0.125;
    double a = depth(0, 1, 0, 0.25, 0.75, 0), b = depth(1, 1, 0, 0.25, 0.5 + 0.25 - 0.03125, 0); /* a = 0; b is near it */
    assert_true(a == 0 && fabs(b) < blend);
    uint64_t seed = 7;
    int inside = 0;
    for (int i = 0; i < 10000; i++) {
        double x[3];
        for (int k = 0; k < 3; k++) x[k] = 2 * scene_random(&seed) - 0.5;
        double sharp = depth(0, 2, 0, x[0], x[1], x[2]), smooth = depth(0, 2, blend, x[0], x[1], x[2]);
        double apart = fabs(depth(0, 1, 0, x[0], x[1], x[2]) - depth(1, 1, 0, x[0], x[1], x[2]));
        assert_true(smooth >= sharp && smooth <= sharp + 0.25 * blend);
        assert_true(apart < blend || smooth == sharp);
        inside += smooth > sharp;
    }
    assert_true(inside > 100);
    /* Where the two are equal: at the same distance from both axes. */
    double same = depth(0, 1, 0, 0, 0.5, 0.1);
    assert_true(depth(1, 1, 0, 0, 0.5, 0.1) == same && depth(0, 2, blend, 0, 0.5, 0.1) == same + 0.25 * blend);
}

static void test_bounds(void **state)
{
    (void)state;
    double low[3], high[3];
    scene_capsules shape = {3, parts, 0};
    scene_capsules_bounds(&shape, low, high);
    assert_true(low[0] == -0.5 && high[0] == 1.125 && low[1] == -0.25 && high[1] == 1.75 && low[2] == -0.5 && high[2] == 0.5);
    shape.blend = 0.2; /* nothing inside lies beyond the bounds with a blend either */
    scene_capsules_bounds(&shape, low, high);
    uint64_t seed = 3;
    int inside = 0;
    for (int i = 0; i < 100000; i++) {
        double x[3];
        bool beyond = false;
        for (int k = 0; k < 3; k++) {
            x[k] = low[k] - 0.1 + (high[k] - low[k] + 0.2) * scene_random(&seed);
            beyond = beyond || x[k] < low[k] || x[k] > high[k];
        }
        double d = scene_capsules_depth(&shape, x);
        assert_true(!beyond || d < 0);
        inside += d > 0;
    }
    assert_true(inside > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_part),
        cmocka_unit_test(test_the_larger_counts),
        cmocka_unit_test(test_blend),
        cmocka_unit_test(test_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
