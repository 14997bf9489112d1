/* What is said to be clear of a body without looking at it is so. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include <gsl/gsl_rng.h>

#include "massspring/stepper.h"

static const cipc_collider colliders[] = {
    {.kind = CIPC_COLLIDER_PLANE, .center = {0, -1, 0}, .axis = {0, 1, 0}},
    {.kind = CIPC_COLLIDER_SPHERE, .center = {1, 0, 0}, .half = {0.5}},
    {.kind = CIPC_COLLIDER_BOX, .center = {-1, 0, 0}, .half = {0.3, 0.2, 0.4}},
    {.kind = CIPC_COLLIDER_DISC, .center = {0, 0, 1}, .axis = {0, 1, 0}, .half = {0.4, 0.1}},
    {.kind = CIPC_COLLIDER_CAPSULE, .center = {0, 0, -1}, .axis = {0.3, 0.2, -1.2}, .half = {0.2, 0.1}},
};
enum { COUNT = sizeof colliders / sizeof *colliders, NODES = 4, MOVES = 200000 };

/* Nodes wander, by steps of all lengths; some are looked at now and then. The answers of a clear node are held against the distance, and none is ever wrong; but most of what is far is known. */
static void test_what_is_clear_is_far(void **state)
{
    (void)state;
    massspring_clearance clearances[NODES * COUNT];
    cipc_massspring s = {.colliders = (cipc_collider *)colliders, .collider_count = COUNT, .clearances = clearances};
    double x[NODES][3] = {{0}};
    long clear = 0, far = 0;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 7);
    for (int k = 0; k < NODES * COUNT; k++) clearances[k] = (massspring_clearance){.distance = -INFINITY};
    for (int c = 0; c < COUNT; c++) assert_false(massspring_is_clear(&s, 0, c, x[0], 0)); /* nothing is known yet */
    for (int move = 0; move < MOVES; move++) {
        const int node = move % NODES, c = (int)gsl_rng_uniform_int(rng, COUNT);
        const double step = pow(10, -17 + 16 * gsl_rng_uniform(rng)), reach = gsl_rng_uniform(rng) < 0.5 ? 0 : pow(10, -6 + 6 * gsl_rng_uniform(rng));
        for (int k = 0; k < 3; k++) x[node][k] = fmax(-3, fmin(3, x[node][k] + step * (2 * gsl_rng_uniform(rng) - 1)));
        const double distance = cipc_collider_distance(&colliders[c], x[node], NULL);
        if (massspring_is_clear(&s, node, c, x[node], reach)) {
            assert_true(distance > reach);
            clear++;
        } else {
            double normal[3];
            assert_true(massspring_look(&s, node, c, x[node], normal) == distance);
            assert_true(massspring_is_clear(&s, node, c, x[node], reach) == (distance * (1 - 1e-9) > reach + 1e-10) || fabs(distance - reach) < 1e-8);
        }
        far += distance > 2 * reach;
    }
    gsl_rng_free(rng);
    assert_true(10 * clear > 9 * far && far > MOVES / 4);
}

/* At the very reach: the least step nearer than what was measured is not clear, even where rounding could hide it. */
static void test_no_slack_is_assumed(void **state)
{
    (void)state;
    massspring_clearance clearance = {.distance = -INFINITY};
    cipc_massspring s = {.colliders = (cipc_collider *)colliders, .collider_count = 1, .clearances = &clearance};
    double x[3] = {1, 0, 2}, normal[3];
    assert_true(massspring_look(&s, 0, 0, x, normal) == 1);
    assert_false(massspring_is_clear(&s, 0, 0, x, 1));
    assert_true(massspring_is_clear(&s, 0, 0, x, 1 - 1e-11));
    x[1] = -0.5;
    assert_false(massspring_is_clear(&s, 0, 0, x, 0.5));
    assert_true(massspring_is_clear(&s, 0, 0, x, 0.5 - 1e-11));
}

/* Nor where the nearest number decides: moved by next to nothing, no node is clear of what its distance then is. */
static void test_last_digits(void **state)
{
    (void)state;
    massspring_clearance clearances[COUNT];
    cipc_massspring s = {.colliders = (cipc_collider *)colliders, .collider_count = COUNT, .clearances = clearances};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 8);
    for (int k = 0; k < 100000; k++) {
        double x[3], normal[3];
        const int c = k % COUNT;
        for (int i = 0; i < 3; i++) x[i] = 4 * gsl_rng_uniform(rng) - 2;
        massspring_look(&s, 0, c, x, normal);
        for (int i = 0; i < 3; i++) x[i] += 1e-16 * (2 * gsl_rng_uniform(rng) - 1);
        const double distance = cipc_collider_distance(&colliders[c], x, NULL);
        assert_false(distance >= 0 && massspring_is_clear(&s, 0, c, x, distance));
    }
    gsl_rng_free(rng);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_is_clear_is_far), cmocka_unit_test(test_no_slack_is_assumed), cmocka_unit_test(test_last_digits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
