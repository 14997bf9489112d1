/* Friction in the plane: on a line it is the law itself, it knows no direction, z is carried along with its length, two halves are the step. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "cipc/massspring.h"
#include "support/exact_geometry.h"

static cipc_friction_force of_law(int law)
{
    return (cipc_friction_force){.law = (cipc_friction_law)law, .sigma0 = 50, .sigma1 = 2, .coulomb = 1, .breakaway = 1.5, .band = 0.01};
}

static double random_speed(uint64_t *seed) { return pow(10, random_uniform(seed, -4, 1)); }

/* Bit for bit, but that the clamped law scales z down where the 1-D form sets it. */
static void test_on_a_line(void **state)
{
    (void)state;
    const double normal[3] = {0, 1, 0};
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law(law);
        uint64_t seed = 11;
        double z = 0, plane[3] = {0, 0, 0}, f[3];
        for (int i = 0; i < 2000; i++) {
            double v = random_speed(&seed) * (random_below(&seed, 2) ? 1 : -1), dt = pow(10, random_uniform(&seed, -5, 0));
            if (i % 100 == 0) v = 0;
            const double velocity[3] = {0, 3, v};
            double F = cipc_friction_step(&force, v, dt, &z);
            cipc_friction_step_plane(&force, normal, velocity, dt, plane, f);
            double off = law == CIPC_LAW_CLAMPED ? 8 * UNIT_ROUNDOFF * (1.5 + 2 * 0.06 / dt) : 0;
            if (!(fabs(f[2] - F) <= off)) fail_msg("%s: v %g dt %g: %.17g in the plane, %.17g on a line", cipc_friction_law_name((cipc_friction_law)law), v, dt, f[2], F);
            assert_true(f[0] == 0 && f[1] == 0 && plane[0] == 0 && plane[1] == 0);
            plane[2] = z;
        }
    }
}

/* A rotation by a random quaternion. */
static void random_rotation(uint64_t *seed, double R[3][3])
{
    double q[4], n = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = random_uniform(seed, -1, 1);
        n += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) q[k] /= sqrt(n);
    for (int r = 0; r < 3; r++) {
        int s = (r + 1) % 3, t = (r + 2) % 3;
        R[r][r] = 1 - 2 * (q[s + 1] * q[s + 1] + q[t + 1] * q[t + 1]);
        R[r][s] = 2 * (q[r + 1] * q[s + 1] - q[0] * q[t + 1]);
        R[r][t] = 2 * (q[r + 1] * q[t + 1] + q[0] * q[s + 1]);
    }
}

static void turn(double R[3][3], const double a[3], double b[3]) { for (int k = 0; k < 3; k++) b[k] = v3_dot(R[k], a); }

static void test_no_direction_is_special(void **state)
{
    (void)state;
    uint64_t seed = 12;
    for (int i = 0; i < 5000; i++) {
        cipc_friction_force force = of_law(i % CIPC_LAW_COUNT);
        double R[3][3], v[3], z[3] = {random_uniform(&seed, -0.02, 0.02), random_uniform(&seed, -0.02, 0.02), 0}, f[3], vr[3], zr[3], fr[3], nr[3], want[3];
        const double normal[3] = {0, 0, 1}, dt = 0.01;
        double speed = random_speed(&seed);
        for (int k = 0; k < 3; k++) v[k] = speed * random_uniform(&seed, -1, 1);
        random_rotation(&seed, R);
        turn(R, normal, nr);
        turn(R, v, vr);
        turn(R, z, zr);
        cipc_friction_step_plane(&force, normal, v, dt, z, f);
        cipc_friction_step_plane(&force, nr, vr, dt, zr, fr);
        turn(R, f, want);
        assert_true(f[2] == 0);
        /* v rounded, then n (n.v) taken off: a few roundings of |v| over its part in the plane. Next to the edge of the band the level itself may differ. */
        double in_plane = hypot(v[0], v[1]), off = 64 * UNIT_ROUNDOFF * (v3_norm(v) / in_plane) * 20;
        if (fabs(in_plane - force.band) < 1e-12) continue;
        for (int k = 0; k < 3; k++)
            if (!(fabs(fr[k] - want[k]) <= off)) fail_msg("law %d: %.17g, turned %.17g, allowed %g", force.law, fr[k], want[k], off);
    }
}

static void test_state_is_carried_along(void **state)
{
    (void)state;
    const double still[3] = {0, 0, 0}, before[3] = {0, 0, 1}, only_normal[3] = {0, 0, 7};
    cipc_friction_force force = of_law(CIPC_LAW_DAHL);
    double z[3] = {0.012, 0.016, 0}, f[3];
    cipc_friction_step_plane(&force, before, only_normal, 0.1, z, f); /* pressing is not sliding */
    assert_true(z[0] == 0.012 && z[1] == 0.016 && z[2] == 0 && f[0] == 50 * 0.012 && f[1] == 50 * 0.016);
    for (int i = 1; i <= 90; i++) { /* the plane turns over, a degree at a time, about the y axis */
        double a = i * 0.017453292519943295;
        const double normal[3] = {sin(a), 0, cos(a)};
        cipc_friction_step_plane(&force, normal, still, 0.1, z, f);
        assert_true(fabs(v3_norm(z) - 0.02) <= i * 8 * UNIT_ROUNDOFF * 0.02 && fabs(v3_dot(normal, z)) <= 8 * UNIT_ROUNDOFF * 0.02);
    }
    assert_true(z[2] < -0.005 && z[1] > 0.016); /* the part across the axis has gone round; keeping the length lets a little pass to the other */
    double upright[3] = {0, 0, 0.02};
    cipc_friction_step_plane(&force, before, still, 0.1, upright, f);
    for (int k = 0; k < 3; k++) assert_true(upright[k] == 0 && f[k] == 0);
}

/* At rest at first, then in one direction, then across it. */
static void test_two_halves_are_the_step(void **state)
{
    (void)state;
    const double normal[3] = {0, 0, 1};
    uint64_t seed = 13;
    for (int law = CIPC_LAW_DAHL; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law(law);
        double whole[3] = {0, 0, 0}, halves[3] = {0, 0, 0}, f[3];
        for (int i = 0; i < 1000; i++) {
            double speed = random_speed(&seed), a = random_uniform(&seed, 0, 6.28), dt = 0.02 / speed * random_uniform(&seed, 0, 2);
            const double v[3] = {speed * cos(a), speed * sin(a), 0};
            v3_copy(halves, whole);
            cipc_friction_step_plane(&force, normal, v, dt, whole, f);
            for (int k = 0; k < 2; k++) cipc_friction_step_plane(&force, normal, v, 0.5 * dt, halves, f);
            for (int k = 0; k < 3; k++) assert_true(fabs(whole[k] - halves[k]) <= 100 * UNIT_ROUNDOFF * 0.03);
            assert_true(v3_norm(whole) <= (law == CIPC_LAW_DAHL ? 1 : 1.5) / 50 * (1 + 16 * UNIT_ROUNDOFF));
        }
    }
}

/* Work less growth of sigma0 |z|^2/2, step by step on a random way, Fs = 1.5 Fc and sigma1 far beyond its bound at the greatest speeds. */
static void test_no_step_gives_energy(void **state)
{
    (void)state;
    const double normal[3] = {0, 0, 1};
    uint64_t seed = 14;
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law(law);
        double z[3] = {0, 0, 0}, f[3], least = 1e9;
        for (int i = 0; i < 20000; i++) {
            double speed = random_speed(&seed), a = random_uniform(&seed, 0, 6.28), dt = 0.02 / speed * pow(10, random_uniform(&seed, -2, 1)), before = v3_norm2(z);
            const double v[3] = {speed * cos(a), speed * sin(a), 0};
            cipc_friction_step_plane(&force, normal, v, dt, z, f);
            least = fmin(least, v3_dot(f, v) * dt - 0.5 * force.sigma0 * (v3_norm2(z) - before));
        }
        if (!(least >= -1e-14 / 50)) fail_msg("%s: a step gives %g J", cipc_friction_law_name((cipc_friction_law)law), -least);
    }
}

static void test_steady_motion(void **state)
{
    (void)state;
    const double normal[3] = {0, 0, 1}, v[3] = {0.6, 0.8, 5};
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law(law);
        double z[3] = {-0.01, 0.01, 0}, f[3];
        for (int i = 0; i < 2; i++) cipc_friction_step_plane(&force, normal, v, 10, z, f);
        assert_true(fabs(f[0] - 0.6) <= 16 * UNIT_ROUNDOFF && fabs(f[1] - 0.8) <= 16 * UNIT_ROUNDOFF && f[2] == 0); /* Fc, against the motion in the plane */
        const double broken[3] = {NAN, 0, 0};
        cipc_friction_step_plane(&force, normal, broken, 10, z, f);
        assert_true(isnan(f[0]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_on_a_line),
        cmocka_unit_test(test_no_direction_is_special),
        cmocka_unit_test(test_state_is_carried_along),
        cmocka_unit_test(test_two_halves_are_the_step),
        cmocka_unit_test(test_no_step_gives_energy),
        cmocka_unit_test(test_steady_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
