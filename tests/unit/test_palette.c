/* Colours: distinct, stable, and through linear light and back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>

#include "output/palette.h"

static bool differ(cipc_colour a, cipc_colour b)
{
    const double visible = 0.08; /* of the range of a component */
    return fabs(a.r - b.r) > visible || fabs(a.g - b.g) > visible || fabs(a.b - b.b) > visible;
}

static void test_bodies_of_a_scene_differ(void **state)
{
    (void)state;
    enum { BODIES = 10, MOVING = 7 };
    cipc_body bodies[BODIES] = {0};
    for (int b = 0; b < BODIES; b++) {
        bodies[b].fixed = b >= MOVING;
    }
    const cipc_model model = {.body_count = BODIES, .bodies = bodies};
    for (int a = 0; a < BODIES; a++) {
        const cipc_colour c = cipc_body_colour(&model, a);
        assert_true(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1);
        for (int b = 0; b < a; b++) {
            assert_true(differ(c, cipc_body_colour(&model, b)));
        }
    }
}

/* A fixed body before it does not change a moving body's colour. */
static void test_sorts_are_counted_apart(void **state)
{
    (void)state;
    cipc_body bodies[3] = {{.fixed = true}, {.fixed = false}, {.fixed = true}};
    const cipc_model all = {.body_count = 3, .bodies = bodies}, last = {.body_count = 2, .bodies = bodies + 1};
    assert_false(differ(cipc_body_colour(&all, 1), cipc_body_colour(&last, 0)));
    assert_false(differ(cipc_body_colour(&all, 0), cipc_body_colour(&last, 1)));
    assert_true(differ(cipc_body_colour(&all, 0), cipc_body_colour(&all, 2)));
}

static void test_transfer_function(void **state)
{
    (void)state;
    const double tolerance = 1e-7; /* the published constants of the two pieces join to within this */
    for (int i = 0; i <= 255; i++) {
        const double encoded = i / 255.0;
        assert_true(fabs(cipc_linear_to_srgb(cipc_srgb_to_linear(encoded)) - encoded) < tolerance);
    }
    assert_true(fabs(cipc_srgb_to_linear(1) - 1) < tolerance && cipc_srgb_to_linear(0) == 0);
    assert_true(fabs(cipc_srgb_to_linear(0.5) - 0.2140411) < tolerance); /* ((0.5 + 0.055)/1.055)^2.4 */
    const cipc_colour linear = cipc_colour_to_linear((cipc_colour){0, 0.5, 1});
    assert_true(linear.r == 0 && linear.g == cipc_srgb_to_linear(0.5) && linear.b == cipc_srgb_to_linear(1));
}

static void test_curves_differ(void **state)
{
    (void)state;
    for (int a = 0; a < 4; a++) {
        for (int b = 0; b < a; b++) {
            assert_true(differ(cipc_curve_colour(a), cipc_curve_colour(b)));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies_of_a_scene_differ),
        cmocka_unit_test(test_sorts_are_counted_apart),
        cmocka_unit_test(test_transfer_function),
        cmocka_unit_test(test_curves_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
