/* The lights: what faces the key light is brightest, and what turns away from it owes it nothing. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "output/lighting.h"

/* A handful of rounded products of numbers of order 1. */
static const double rounding = 1e-14;

static cipc_lighting some_lighting(void)
{
    const cipc_bounds bounds = {{0, 0, 0}, {1, 1, 1}};
    const cipc_camera camera = cipc_camera_look(&bounds, 0.6, 0.4, 1);
    return cipc_lighting_of(&camera);
}

static void test_directions(void **state)
{
    (void)state;
    const cipc_lighting l = some_lighting();
    assert_true(fabs(v3_norm(l.key) - 1) < rounding && fabs(v3_norm(l.fill) - 1) < rounding);
    assert_true(l.key[1] > 0.5);                /* from above */
    assert_true(v3_dot(l.key, l.fill) < 0.5);   /* from another side */
}

static void test_what_the_key_light_gives(void **state)
{
    (void)state;
    const cipc_lighting l = some_lighting();
    double away[3], across[3];
    v3_scale(away, -1, l.key);
    v3_cross(across, l.key, l.fill);
    v3_scale(across, 1 / v3_norm(across), across);
    const cipc_shade facing = cipc_shade_of(&l, l.key), turned = cipc_shade_of(&l, away), grazed = cipc_shade_of(&l, across);
    assert_true(facing.key > 0.5 * facing.brightness && facing.key < facing.brightness);
    assert_true(turned.key == 0 && turned.brightness > 0.1); /* the sky is everywhere */
    assert_true(grazed.key < rounding && grazed.brightness < facing.brightness);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_directions),
        cmocka_unit_test(test_what_the_key_light_gives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
