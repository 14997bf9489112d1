/* Repulsion: its size at round and at flat bodies, its reach, its direction, and that it lets go of what leaves. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "support/colliders.h"
#include "support/exact_geometry.h"

static const double k = 300, m = 0x1p-6;

/* Above the top of a body whose highest point is the origin. */
static double force_above(const cipc_collider *c, double height, double speed_up)
{
    double f[3];
    cipc_collider_repulsion(c, k, m, (double[3]){0, height, 0}, (double[3]){5, speed_up, 0}, f);
    assert_true(fabs(f[0]) <= 0 && fabs(f[2]) <= 0);
    return f[1];
}

static void test_round_and_flat(void **state)
{
    (void)state;
    const cipc_collider bodies[COLLIDER_KINDS] = {
        {.kind = CIPC_COLLIDER_PLANE, .axis = {0, 1, 0}},
        {.kind = CIPC_COLLIDER_SPHERE, .center = {0, -0.5, 0}, .half = {0.5, 0, 0}},
        {.kind = CIPC_COLLIDER_BOX, .center = {0, -0.5, 0}, .half = {2, 0.5, 2}},
        {.kind = CIPC_COLLIDER_DISC, .center = {0, -0.5, 0}, .axis = {0, 1, 0}, .half = {2, 0.5, 0}},
        {.kind = CIPC_COLLIDER_CAPSULE, .center = {0, -0.5, 0}, .axis = {0, -2, 0}, .half = {0.5, 0.25, 0}},
    };
    for (int kind = 0; kind < COLLIDER_KINDS; kind++) {
        const bool is_round = kind == CIPC_COLLIDER_SPHERE || kind == CIPC_COLLIDER_CAPSULE;
        const cipc_collider *c = &bodies[kind];
        assert_true(force_above(c, 0, -1) == k * m);
        assert_true(force_above(c, m / 4, -1) == k * (is_round ? 0.75 * m : m));
        assert_true(force_above(c, -m / 4, -1) == k * (is_round ? 1.25 * m : m)); /* inside: outwards all the same */
        assert_true(force_above(c, m - 0x1p-30, -1) == k * (is_round ? 0x1p-30 : m));
        assert_true(force_above(c, m, -1) <= 0 && force_above(c, 2 * m, -1) <= 0);
        assert_true(force_above(c, m / 4, 0) == force_above(c, m / 4, -1)); /* at rest, or sliding */
        assert_true(force_above(c, m / 4, 1e-9) <= 0 && force_above(c, m / 4, 1e-9) >= 0);
    }
}

/* Along the normal, never with the velocity: it takes energy and gives none. */
static void test_opposes_the_velocity(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int acts = 0, lets_go = 0;
    for (int trial = 0; trial < 5000; trial++) {
        const cipc_collider c = random_collider(&seed, (cipc_collider_kind)random_below(&seed, COLLIDER_KINDS), 0.05);
        double x[3], v[3], n[3], f[3], across[3];
        random_fill(&seed, x, 3, 2);
        random_direction(&seed, n);
        v3_axpy(x, 0.9 * m - cipc_collider_distance(&c, x, n), n);
        const double distance = cipc_collider_distance(&c, x, n);
        if (distance < 0 || distance >= m) continue; /* inside, the surface is not where the normal of another point says */
        random_fill(&seed, v, 3, 1);
        cipc_collider_repulsion(&c, k, m, x, v, f);
        v3_cross(across, f, n);
        assert_true(v3_norm(across) <= 8 * DBL_EPSILON * k * m && v3_dot(f, n) >= 0 && v3_dot(f, v) <= 0);
        v3_norm(f) > 0 ? acts++ : lets_go++;
        assert_true((v3_norm(f) > 0) == !(v3_dot(v, n) > 0));
    }
    assert_true(acts > 1000 && lets_go > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_and_flat),
        cmocka_unit_test(test_opposes_the_velocity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
