/* Claims D3, D7: the loop of a cyclic displacement, and the creep of a cyclic load. */
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

static const double Fc = 2, sigma0 = 5;

typedef struct loop {
    double end;  /* force at +A */
    double area; /* exactly, from the states at the ends of the steps */
    double work; /* of the mean of the forces at both ends of each step */
} loop;

/* x = A sin(w t), each step of the same time at constant velocity; `cycles` of `steps` each (a multiple of 4), and the last one of them measured. While v > 0, dz = (1 - z/b) dx gives
 * sigma0 z dx = Fc (dx - dz) exactly; with the other direction, Fc (|dx| - sgn(v) dz). */
static loop cycle(const cipc_friction_force *force, double A, double omega, int cycles, int steps)
{
    const double full = 6.283185307179586, dt = full / omega / steps;
    loop l = {0, 0, 0};
    double z = 0, before = 0;
    for (int i = 0; i < cycles * steps; i++) {
        double x = A * sin(full * (i % steps) / steps), next = A * sin(full * ((i + 1) % steps) / steps), begin = z, F = cipc_friction_step(force, (next - x) / dt, dt, &z);
        if (i >= (cycles - 1) * steps) {
            l.area += force->coulomb * (fabs(next - x) - copysign(1, next - x) * (z - begin));
            l.work += 0.5 * (before + F) * (next - x);
            if (i % steps == steps / 4 - 1) l.end = F;
        }
        before = F;
    }
    return l;
}

static cipc_friction_force dahl(void) { return (cipc_friction_force){.law = CIPC_LAW_DAHL, .sigma0 = sigma0, .coulomb = Fc, .breakaway = Fc}; }

/* What is left of the start after n cycles is exp(-4 a n) of it. */
static void test_loop(void **state)
{
    (void)state;
    const cipc_friction_force force = dahl();
    double end_off = 0, area_off = 0, published = 0;
    for (int i = 0; i < 6; i++) {
        const double amplitudes[] = {0.01, 0.1, 1, 2, 10, 100}, A = amplitudes[i], a = sigma0 * A / Fc;
        loop l = cycle(&force, A, 1, 2 + (int)(10 / a), 64);
        double end = Fc * exact_tanh(a), area = 4 * Fc * Fc / sigma0 * exact_tanh_defect(a);
        end_off = fmax(end_off, fabs(l.end / end - 1));
        area_off = fmax(area_off, fabs(l.area / area - 1));
        if (A == 1) published = fmax(fabs(area - 4.8428342), fabs(end - 1.9732286));
        if (A == 10) assert_true(fabs(area - 76.8) <= 1e-9);
    }
    claim_figure("D3", "A from 0.01 to 100 m: force at the end off Fc tanh a, relative, largest", end_off, "1", CLAIM_AT_MOST, 1e-10);
    claim_figure("D3", "the same: area of the loop off 4 (Fc^2/sigma0) (a - tanh a), relative, largest", area_off, "1", CLAIM_AT_MOST, 1e-10);
    claim_figure("D3", "A = 1 m: closed forms off 4.8428342 J and 1.9732286 N", published, "1", CLAIM_AT_MOST, 5e-8);
}

/* The area that needs no closed form: trapezoids of the force that the steps return. Each is off by |dx|^3 |F''|/12, |F''| = sigma0 (sigma0/Fc) (1 -+ F/Fc) <= 2 sigma0^2/Fc, so their sum by at most
 * 4 A max|dx|^2 sigma0^2/(6 Fc), max|dx| = 2 pi A/N. */
static void test_area_without_closed_form(void **state)
{
    (void)state;
    const cipc_friction_force force = dahl();
    const double A = 1, area = 4 * Fc * Fc / sigma0 * exact_tanh_defect(2.5);
    for (int steps = 400; steps <= 40000; steps *= 10) {
        double dx = 6.2832 * A / steps, off = fabs(cycle(&force, A, 1, 6, steps).work - area), allowed = 4 * A * dx * dx * sigma0 * sigma0 / (6 * Fc);
        print_message("%d steps: trapezoids off by %.3g J, allowed %.3g\n", steps, off, allowed);
        assert_true(off <= allowed && off >= 0.01 * allowed);
    }
}

/* Dahl's loop is the same at any frequency; sigma1 makes that of R1 grow with it. */
static void test_frequency(void **state)
{
    (void)state;
    const cipc_friction_force plain = dahl(), damped = {.law = CIPC_LAW_BIDIRECTIONAL, .sigma0 = sigma0, .sigma1 = 0.5, .coulomb = Fc, .breakaway = Fc};
    double dahl_spread = 0, slow = cycle(&plain, 1, 1, 6, 4000).work;
    for (double omega = 1e-3; omega < 2e3; omega *= 10) dahl_spread = fmax(dahl_spread, fabs(cycle(&plain, 1, omega, 6, 4000).work / slow - 1));
    double growth = cycle(&damped, 1, 4, 6, 4000).work / cycle(&damped, 1, 1e-3, 6, 4000).work;
    claim_figure("D3", "frequency times 1e-3 to 1e3: area of Dahl's loop changes by, relative, largest", dahl_spread, "1", CLAIM_AT_MOST, 1e-12);
    claim_figure("D3", "bidirectional, sigma1 = 0.5 N s/m: area at 4 rad/s over that at 0.001 rad/s", growth, "1", CLAIM_MORE, 1.05);
}

/* How far the contact moves until the force is `load`, from the state z: bisection over one exact step either way. */
static double follow(const cipc_friction_force *force, double load, double *z)
{
    double sign = force->sigma0 * *z < load ? 1 : -1, low = 0, high = 10;
    for (int i = 0; i < 200; i++) {
        double trial = *z, middle = 0.5 * (low + high), F = cipc_friction_step(force, sign * middle, 1, &trial);
        *(sign * F < sign * load ? &low : &high) = middle;
    }
    (void)cipc_friction_step(force, sign * high, 1, z);
    return sign * high;
}

/* A load that goes to and fro between f1 Fc and f2 Fc: there b ln((1 - f1)/(1 - f2)), back b ln((1 + f2)/(1 + f1)), in sum b ln((1 - f1^2)/(1 - f2^2)), b = Fc/sigma0, which is not 0. */
static double creep(cipc_friction_law law, double f1, double f2, int cycles)
{
    const cipc_friction_force force = {.law = law, .sigma0 = sigma0, .coulomb = Fc, .breakaway = Fc, .band = 0};
    double z = 0, x = 0;
    (void)follow(&force, f1 * Fc, &z);
    for (int i = 0; i < cycles; i++) {
        x += follow(&force, f2 * Fc, &z);
        x += follow(&force, f1 * Fc, &z);
    }
    return x / cycles / (Fc / sigma0);
}

static void test_creep_under_a_bias(void **state)
{
    (void)state;
    const double each = creep(CIPC_LAW_DAHL, 0.4, 0.6, 100), wanted = exact_log_ratio(1, 1 - 0.4 * 0.4, 1 - 0.6 * 0.6), clamped = creep(CIPC_LAW_CLAMPED, 0.4, 0.6, 100);
    print_message("load 0.4 to 0.6 Fc: Dahl creeps %.9g Fc/sigma0 a cycle, the clamped law %.3g\n", each, clamped);
    claim_figure("D7", "load between 0.4 and 0.6 Fc: Dahl's creep a cycle off (Fc/sigma0) ln((1 - 0.16)/(1 - 0.36)), relative", fabs(each / wanted - 1), "1", CLAIM_AT_MOST, 1e-12);
    claim_within("D7", "the same: creep a cycle in units of Fc/sigma0", each, "1", 0.2719, 0.2720);
    claim_figure("D7", "the same: creep a cycle of the clamped law, same units", fabs(clamped), "1", CLAIM_AT_MOST, 1e-14);
    assert_true(fabs(creep(CIPC_LAW_DAHL, -0.5, 0.5, 100)) <= 1e-13); /* without a bias there is none */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_loop),
        cmocka_unit_test(test_area_without_closed_form),
        cmocka_unit_test(test_frequency),
        cmocka_unit_test(test_creep_under_a_bias),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
