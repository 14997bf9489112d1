/* Claims D5, D6: a block that is pulled through a spring sticks and slips, a block on a slope rests or slides. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "cipc/massspring.h"
#include "support/claim.h"
#include "support/exact_friction.h"

/* ---- D5: m = 1 kg, k = 2 N/m, V = 0.1 m/s, Fc = 1 N -------------------------------------------------------------------------------------- */

static const double mass = 1, spring = 2, pull = 0.1, Fc = 1, PI = 3.14159265358979323846;

static cipc_friction_force pulled_force(cipc_friction_law law, double breakaway)
{
    return (cipc_friction_force){.law = law, .sigma0 = 1e5, .sigma1 = 316, .coulomb = Fc, .breakaway = breakaway, .band = 1e-3};
}

typedef struct swing {
    double peak, trough, period; /* of the spring's force, between two moments at which the block begins to run */
    double slowest;
    int count;
} swing;

/* From 20 s on, for 40 s; a run begins where v rises through V/2. `moving`: it starts in steady motion, a little slower than the pull. */
static swing pulled(const cipc_friction_force *force, bool moving, double dt)
{
    friction_block block = {.mass = mass, .spring = spring, .pull = pull};
    if (moving) block = (friction_block){.mass = mass, .spring = spring, .pull = pull, .v = 0.9 * pull, .x = -Fc / spring, .z = Fc / force->sigma0, .friction = Fc};
    swing s = {-1e9, 1e9, 0, 1e9, 0};
    double first = 0, before = 0;
    for (int i = 0; i * dt < 60; i++) {
        block.time = i * dt;
        friction_block_step(&block, force, dt);
        if (block.time > 20) {
            double tension = friction_block_spring(&block);
            s.peak = fmax(s.peak, tension);
            s.trough = fmin(s.trough, tension);
            s.slowest = fmin(s.slowest, block.v);
            if (before < pull / 2 && block.v >= pull / 2) {
                if (s.count++ == 0) first = block.time;
                else s.period = (block.time - first) / (s.count - 1);
            }
        }
        before = block.v;
    }
    return s;
}

static void test_stick_slip(void **state)
{
    (void)state;
    const double Fs = 1.5, root = sqrt(spring * mass), swing_out = sqrt((Fs - Fc) * (Fs - Fc) + root * root * pull * pull), omega = sqrt(spring / mass);
    const double ideal = 2 * (Fs - Fc) / (spring * pull) + 2 / omega * (PI - atan((Fs - Fc) / (pull * root)));
    const cipc_friction_force force = pulled_force(CIPC_LAW_BIDIRECTIONAL, Fs), nearer = {.law = CIPC_LAW_BIDIRECTIONAL, .sigma0 = 1e6, .sigma1 = 1000, .coulomb = Fc, .breakaway = Fs, .band = 1e-4};
    swing s = pulled(&force, false, 2e-5), half = pulled(&force, false, 1e-5), stiff = pulled(&nearer, false, 1e-5);
    print_message("stick-slip: peak %.6f N, trough %.6f N, period %.6f s (half the step: %.6f, %.6f, %.6f); stiffer, narrower: %.4f, %.4f, %.4f; ideal %.4f, %.4f, %.4f\n", s.peak, s.trough, s.period,
                  half.peak, half.trough, half.period, stiff.peak, stiff.trough, stiff.period, Fc + swing_out, Fc - swing_out, ideal);
    assert_true(fabs(s.peak - half.peak) <= 1e-5 && fabs(s.trough - half.trough) <= 1e-5 && fabs(s.period - half.period) <= 1e-4); /* the step is not what is measured */
    claim_within("D5", "bidirectional: peak of the spring's force (1.533)", s.peak, "N", 1.5325, 1.5335);
    claim_within("D5", "the same: trough (0.467)", s.trough, "N", 0.4665, 0.4675);
    claim_within("D5", "the same: period (7.744)", s.period, "s", 7.7435, 7.7445);
    claim_figure("D5", "the same: period off that of the ideal law, relative", s.period / ideal - 1, "1", CLAIM_LESS, 0.02);
    claim_figure("D5", "ten times stiffer, a tenth of the band: the same", stiff.period / ideal - 1, "1", CLAIM_LESS, 0.003);
    assert_true(fabs(Fc + swing_out - 1.520) <= 5e-4 && fabs(Fc - swing_out - 0.480) <= 5e-4 && fabs(ideal - 7.611) <= 5e-4);
}

/* Fs = Fc: what has begun to slide never stands again. From rest that is no steady sliding (SPEC B.5) but a swing about it with the amplitude V sqrt(k m) and the period 2 pi sqrt(m/k), which nothing
 * damps, for the friction is constant; from a state near steady sliding the swing stays as small as it was. */
static void test_dahl_does_not_stick(void **state)
{
    (void)state;
    const cipc_friction_force dahl = pulled_force(CIPC_LAW_DAHL, Fc);
    swing rest = pulled(&dahl, false, 2e-5), moving = pulled(&dahl, true, 2e-5);
    const double free_swing = pull * sqrt(spring * mass);
    print_message("Dahl: from rest %.6f to %.6f N, slowest %.3g m/s, period %.6f s; near steady sliding %.6f to %.6f N\n", rest.trough, rest.peak, rest.slowest, rest.period, moving.trough, moving.peak);
    claim_figure("D5", "Dahl, from rest: slowest after 20 s", rest.slowest, "m/s", CLAIM_MORE, 0);
    claim_within("D5", "the same: period, of a swing without friction 4.44288", rest.period, "s", 4.4424, 4.4434);
    claim_figure("D5", "the same: half the swing of the spring's force over V sqrt(k m)", 0.5 * (rest.peak - rest.trough) / free_swing, "1", CLAIM_AT_MOST, 1);
    claim_figure("D5", "Dahl, from 0.9 V: half the swing of the spring's force over 0.1 V sqrt(k m), less 1", fabs(0.5 * (moving.peak - moving.trough) / (0.1 * free_swing) - 1), "1", CLAIM_AT_MOST, 1e-3);
}

/* ---- D6: a block of 1 kg on a slope, mu = 0.5 --------------------------------------------------------------------------------------------- */

static const double g = 9.81, mu = 0.5;

static cipc_friction_force slope_force(cipc_friction_law law, double tangent, double ratio)
{
    double load = mu * mass * g / sqrt(1 + tangent * tangent);
    return (cipc_friction_force){.law = law, .sigma0 = load / 1e-4, .sigma1 = 50, .coulomb = load, .breakaway = ratio * load, .band = 1e-3};
}

/* The slope is tilted within 2 s, so gently that three derivatives are 0 at both ends; where the block is after another 2 s. */
static friction_block tilted(const cipc_friction_force *force, double tangent, double drag)
{
    const double dt = 1e-5, load = mass * g * tangent / sqrt(1 + tangent * tangent);
    friction_block block = {.mass = mass, .drag = drag};
    for (int i = 0; i < 400000; i++) {
        double s = fmin(1, i * dt / 2), rise = s * s * s * s * (35 + s * (-84 + s * (70 - 20 * s)));
        block.load = load * rise;
        friction_block_step(&block, force, dt);
    }
    return block;
}

/* With a drag of 450 N s/m (2 sqrt(sigma0 m) is at most 443) the block comes to its place from one side, as D2 has it, within exp(-2 s * sigma0 (1 - 0.9)/drag). Without, what swing is left makes it creep on (D7): always downhill. */
static void test_rest_below(void **state)
{
    (void)state;
    double worst = 0, speed = 0, ahead = 1;
    for (int i = 0; i < 4; i++) {
        const double parts[] = {0.1, 0.5, 0.8, 0.9}, tangent = parts[i] * mu, wanted = exact_log_ratio(1e-4, 1, 1 - parts[i]);
        const cipc_friction_force dahl = slope_force(CIPC_LAW_DAHL, tangent, 1);
        friction_block block = tilted(&dahl, tangent, 450), free = tilted(&dahl, tangent, 0);
        print_message("slope %g mu: rests at %.9g m, closed form %.9g, speed %.2g; without drag %.9g, speed %.2g\n", parts[i], block.x, wanted, block.v, free.x, free.v);
        worst = fmax(worst, fabs(block.x / wanted - 1));
        speed = fmax(speed, fabs(block.v));
        ahead = free.x / wanted - 1;
    }
    claim_figure("D6", "tan a from 0.1 to 0.9 mu: place of rest off -(Fc/sigma0) ln(1 - F0/Fc), relative, largest", worst, "1", CLAIM_AT_MOST, 1e-9);
    claim_figure("D6", "the same: speed after 2 s at the full slope, largest", speed, "m/s", CLAIM_AT_MOST, 1e-12);
    claim_within("D7", "slope of 0.9 mu, tilted gently within 2 s and held for 2 s, no drag: way crept beyond the place of rest, relative", ahead, "1", 1e-5, 1e-2);
}

/* Acceleration between 0.3 s and 0.5 s, when the state has long forgotten how it began. */
static double acceleration(const cipc_friction_force *force, double tangent, double speed)
{
    const double dt = 1e-5;
    friction_block block = {.mass = mass, .v = speed, .load = mass * g * tangent / sqrt(1 + tangent * tangent)};
    double before = 0;
    for (int i = 0; i < 50000; i++) {
        if (i == 30000) before = block.v;
        friction_block_step(&block, force, dt);
    }
    return (block.v - before) / (20000 * dt);
}

static void test_sliding_above(void **state)
{
    (void)state;
    double worst = 0;
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        for (int i = 0; i < 3; i++) {
            const double parts[] = {1.05, 1.5, 4}, tangent = parts[i] * mu, cosine = 1 / sqrt(1 + tangent * tangent);
            const cipc_friction_force force = slope_force((cipc_friction_law)law, tangent, 1);
            worst = fmax(worst, fabs(acceleration(&force, tangent, 0) / (g * (tangent - mu) * cosine) - 1));
        }
    }
    claim_figure("D6", "every law, tan a from 1.05 to 4 mu: acceleration off g (sin a - mu cos a), relative, largest", worst, "1", CLAIM_AT_MOST, 1e-6);
}

/* Fs = 1.2 Fc, between: what rests stays, what slides goes on. */
static void test_static_friction(void **state)
{
    (void)state;
    const double tangent = 1.1 * mu, wanted = g * (tangent - mu) / sqrt(1 + tangent * tangent);
    const cipc_friction_law laws[] = {CIPC_LAW_BIDIRECTIONAL, CIPC_LAW_CLAMPED};
    double rest = 0, slide = 0;
    for (int i = 0; i < 2; i++) {
        const cipc_friction_force force = slope_force(laws[i], tangent, 1.2);
        rest = fmax(rest, fabs(tilted(&force, tangent, 0).v));
        slide = fmax(slide, fabs(acceleration(&force, tangent, 0.1) / wanted - 1));
    }
    claim_figure("D6", "Fs = 1.2 Fc, tan a = 1.1 mu, from rest: speed after 2 s at the full slope, largest", rest, "m/s", CLAIM_AT_MOST, 1e-6);
    claim_figure("D6", "the same, pushed to 0.1 m/s: acceleration off g (sin a - mu cos a), relative, largest", slide, "1", CLAIM_AT_MOST, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stick_slip),
        cmocka_unit_test(test_dahl_does_not_stick),
        cmocka_unit_test(test_rest_below),
        cmocka_unit_test(test_sliding_above),
        cmocka_unit_test(test_static_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
