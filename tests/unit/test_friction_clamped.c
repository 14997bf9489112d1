/* R2, the clamped integrator: exactly elastic, its bound, what happens when the bound falls, sliding on the circle in the plane. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "massspring/friction.h"
#include "support/exact_geometry.h"

static const cipc_friction_force clamped = {.law = CIPC_LAW_CLAMPED, .sigma0 = 64, .sigma1 = 0.5, .coulomb = 1, .breakaway = 2, .band = 0x1p-10};

/* Powers of two throughout: no rounding. */
static void test_a_spring_up_to_its_bound(void **state)
{
    (void)state;
    double z = 0;
    assert_true(cipc_friction_step(&clamped, 0.5, 0x1p-8, &z) == 64 * 0x1p-9 + 0.5 * 0.5 && z == 0x1p-9);
    assert_true(cipc_friction_step(&clamped, -0.5, 0x1p-8, &z) == -0.25 && z == 0);
    assert_true(cipc_friction_step(&clamped, 0, 1, &z) == 0 && z == 0);
    assert_true(cipc_friction_step(&clamped, 1, 1, &z) == 1 + 0.5 * 0x1p-6 && z == 0x1p-6);  /* a sixty-fourth in a second */
    assert_true(cipc_friction_step(&clamped, 1, 1, &z) == 1 && z == 0x1p-6);                 /* steady: no rate */
    assert_true(cipc_friction_step(&clamped, -1, 0x1p-7, &z) == 0.5 - 0.5 && z == 0x1p-7);   /* back at once, elastic */
    assert_true(cipc_friction_step(&clamped, 0x1p-10, 1024, &z) == 2 + 0.5 * (0x1p-5 - 0x1p-7) / 1024 && z == 0x1p-5);
}

/* dz/dt = 0 where |z| >= h/sigma0 and z v > 0, and nothing else: a state that was built up slowly then stays at Fs at any speed, against "steady sliding F = Fc for |v| > dv" (SPEC B.4). So the bound
 * takes z along, at once and without a rate. */
static double literal_step(double v, double dt, double *z)
{
    double bound = cipc_friction_level(&clamped, fabs(v)) / clamped.sigma0;
    if (!(fabs(*z) >= bound && *z * v > 0)) *z = fmax(-bound, fmin(bound, *z + v * dt));
    return clamped.sigma0 * *z;
}

static void test_the_bound_takes_z_along(void **state)
{
    (void)state;
    double z = 0x1p-5, literal = z;
    assert_true(cipc_friction_step(&clamped, 1, 1e-6, &z) == 1 && z == 0x1p-6);
    for (int i = 0; i < 1000; i++) assert_true(literal_step(1, 1, &literal) == 2);
    z = 0x1p-5; /* and when it turns round */
    assert_true(fabs(cipc_friction_step(&clamped, -1, 0x1p-20, &z) - (1 - 0x1p-14 - 0.5)) <= 1e-15);
}

/* The circle's law in small steps: a step straight on, then back to the circle along its normal (Moreau). First order in the step. */
static void small_steps(double bound, double travel, const double along[3], int steps, double z[3])
{
    for (int i = 0; i < steps; i++) {
        double length = 0;
        for (int k = 0; k < 3; k++) {
            z[k] += along[k] * travel / steps;
            length += z[k] * z[k];
        }
        if (length > bound * bound) for (int k = 0; k < 3; k++) z[k] *= bound / sqrt(length);
    }
}

static double apart(const double a[3], const double b[3]) { return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2])); }

static void test_sliding_on_the_circle(void **state)
{
    (void)state;
    enum { STEPS = 20000 };
    uint64_t seed = 7;
    int free = 0, turning = 0;
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        double a = random_uniform(&seed, 0, 6.28), b = random_uniform(&seed, 0, 6.28), r = i % 3 ? 1 : random_uniform(&seed, 0, 1), travel = random_uniform(&seed, 0, 3), bound = 2;
        const double along[3] = {cos(a), 0, sin(a)};
        double start[3] = {r * bound * cos(b), 0, r * bound * sin(b)}, z[3], slow[3], half[3];
        for (int k = 0; k < 3; k++) z[k] = slow[k] = half[k] = start[k];
        massspring_clamped_slide(bound, travel, along, z);
        massspring_clamped_slide(bound, 0.5 * travel, along, half);
        massspring_clamped_slide(bound, 0.5 * travel, along, half);
        small_steps(bound, travel, along, STEPS, slow);
        double length = sqrt(z[0] * z[0] + z[2] * z[2]), off = apart(z, slow) / (travel / STEPS);
        assert_true(length <= bound * (1 + 8 * UNIT_ROUNDOFF) && z[1] == 0);
        if (!(apart(z, half) <= 1e-14)) fail_msg("two halves are off by %g", apart(z, half)); /* at most sqrt of a rounding where z just touches the circle: not met here */
        if (!(off <= 1)) fail_msg("off the small steps by %g of one of them", off);
        worst = fmax(worst, off);
        free += length < bound * (1 - 1e-12);
        turning += length >= bound * (1 - 1e-12) && fabs(z[0] * along[2] - z[2] * along[0]) > 1e-3;
    }
    print_message("off by %.2g small steps; %d ended inside, %d on the circle and still turning\n", worst, free, turning);
    assert_true(free > 10 && turning > 50);
}

/* Straight against the motion and on the circle, across and out at the other side; no load. */
static void test_ends_of_the_circle(void **state)
{
    (void)state;
    const double along[3] = {1, 0, 0};
    double z[3] = {-2, 0, 0}, none[3] = {0, 0, 0};
    massspring_clamped_slide(2, 1, along, z);
    assert_true(z[0] == -1 && z[1] == 0);
    massspring_clamped_slide(2, 50, along, z);
    assert_true(z[0] == 2 && z[1] == 0);
    massspring_clamped_slide(0, 1, along, none);
    assert_true(none[0] == 0 && none[1] == 0 && none[2] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_spring_up_to_its_bound),
        cmocka_unit_test(test_the_bound_takes_z_along),
        cmocka_unit_test(test_sliding_on_the_circle),
        cmocka_unit_test(test_ends_of_the_circle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
