/* Claims D1, D2, D4: the force of Dahl's law along a way, the place where a load rests, steady motion of every law. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "cipc/massspring.h"
#include "support/claim.h"
#include "support/exact_friction.h"
#include "support/exact_geometry.h"

static const double Fc = 2, sigma0 = 5;

static cipc_friction_force dahl(void) { return (cipc_friction_force){.law = CIPC_LAW_DAHL, .sigma0 = sigma0, .coulomb = Fc, .breakaway = Fc}; }

/* x at constant speed in so many steps, from z = 0. */
static double force_after(double x, double speed, int steps)
{
    cipc_friction_force force = dahl();
    double z = 0, F = 0;
    for (int i = 0; i < steps; i++) F = cipc_friction_step(&force, speed, x / speed / steps, &z);
    return F;
}

static void test_force_along_the_way(void **state)
{
    (void)state;
    double worst = 0, rates = 0, slope = 0;
    for (int i = -24; i <= 5; i++) {
        double x = ldexp(1, i), wanted = sigma0 * exact_friction_step(Fc, sigma0, 1, x, 0).z;
        for (int steps = 1; steps <= 1000; steps *= 10) worst = fmax(worst, fabs(force_after(x, 0.125, steps) / wanted - 1));
        for (double speed = 1e-6; speed < 1e7; speed *= 10) rates = fmax(rates, fabs(force_after(x, speed, 10) / force_after(x, 1, 10) - 1));
    }
    slope = fabs(force_after(1e-12, 1, 1) / 1e-12 / sigma0 - 1);
    claim_figure("D1", "x from 2^-24 to 2^5 m in 1 to 1000 steps: F off Fc (1 - exp(-sigma0 x/Fc)), relative, largest", worst, "1", CLAIM_AT_MOST, 1e-12);
    claim_figure("D1", "the same at speeds from 1e-6 to 1e6 m/s: F off that at 1 m/s, relative, largest", rates, "1", CLAIM_AT_MOST, 1e-13);
    claim_figure("D1", "slope of the first 1e-12 m off sigma0, relative", slope, "1", CLAIM_AT_MOST, 1e-11);
}

/* The way after which F is the load, by bisection to the last bit: one exact step each. */
static double way_to(const cipc_friction_force *force, double load)
{
    double low = 0, high = 1;
    for (;;) {
        double z = 0, middle = 0.5 * (low + high);
        if (middle == low || middle == high) return high;
        *(cipc_friction_step(force, middle, 1, &z) < load ? &low : &high) = middle;
    }
}

/* F rounds by some units in its last place; of x = -(Fc/sigma0) ln(1 - F0/Fc) that is F0/(Fc - F0) as much. */
static void test_load_held(void **state)
{
    (void)state;
    cipc_friction_force force = dahl();
    const double parts[] = {1e-9, 0.01, 0.25, 0.5, 0.75, 0.875};
    double worst = 0;
    for (int i = 0; i < 6; i++) {
        double load = parts[i] * Fc, wanted = exact_log_ratio(Fc / sigma0, Fc, Fc - load);
        if (i == 0) wanted = load / sigma0 * (1 + 0.5 * parts[0]); /* Fc - F0 has lost its digits */
        worst = fmax(worst, fabs(way_to(&force, load) / wanted - 1));
    }
    claim_figure("D2", "F0/Fc from 1e-9 to 0.875: way to F = F0 off -(Fc/sigma0) ln(1 - F0/Fc), relative, largest", worst, "1", CLAIM_AT_MOST, 1e-13);
}

/* Until nothing is left of what was before: from rest, from full deflection either way, and slow before fast. */
static double steady(const cipc_friction_force *force, double v, double begin)
{
    double z = begin * force->breakaway / force->sigma0, F = 0, dt = 50 * force->breakaway / force->sigma0 / fabs(v);
    (void)cipc_friction_step(force, copysign(1e-4 * force->band, v), 1e4 * dt * fabs(v) / force->band, &z);
    for (int i = 0; i < 3; i++) F = cipc_friction_step(force, v, dt, &z);
    return F;
}

static void test_steady_motion(void **state)
{
    (void)state;
    double beyond = 0, within = 0;
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = {.law = (cipc_friction_law)law, .sigma0 = 1e4, .sigma1 = 100, .coulomb = 2, .breakaway = 3, .band = 1e-3};
        for (int i = 0; i < 60; i++) {
            double v = (i % 2 ? -1 : 1) * force.band * pow(10, 0.1 * (i / 2)), begin = (double)(i % 3 - 1), sign = copysign(1, v);
            double excess = law == CIPC_LAW_BIDIRECTIONAL_SMOOTH ? exp(-pow(v / force.band, 2)) : 0; /* R1s comes down to Fc as it is given */
            if (i > 1) beyond = fmax(beyond, fabs(steady(&force, v, begin) - sign * (2 + excess)) / 2);
            if (law == CIPC_LAW_BIDIRECTIONAL || law == CIPC_LAW_CLAMPED) within = fmax(within, fabs(steady(&force, sign * force.band / (1 + i), begin) - sign * 3) / 3);
        }
    }
    claim_figure("D4", "every law, |v| from 1.26 to 800 dv: F off Fc sgn v (smooth law: h(|v|) sgn v), relative, largest", beyond, "1", CLAIM_AT_MOST, 1e-14);
    claim_figure("D4", "bidirectional and clamped, |v| <= dv: F off Fs sgn v, relative, largest", within, "1", CLAIM_AT_MOST, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_force_along_the_way),
        cmocka_unit_test(test_load_held),
        cmocka_unit_test(test_steady_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
