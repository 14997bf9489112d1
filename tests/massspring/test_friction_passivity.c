/* Claim D8: friction takes energy. Every step of every law on random closed paths; what the bound of sigma1 is for, and what it is not enough for; a free oscillator. */
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
#include "support/exact_geometry.h"

/* Fc = 1 N, sigma0 = 100 N/m: energies count in Fc^2/sigma0 = 0.01 J. */
static cipc_friction_force of_law(int law, double ratio, double sigma1)
{
    return (cipc_friction_force){.law = (cipc_friction_law)law, .sigma0 = 100, .sigma1 = sigma1, .coulomb = 1, .breakaway = ratio, .band = 1e-3};
}

typedef struct balance {
    double work, size; /* sum of F v dt and of its magnitudes */
    double least;      /* work less growth of sigma0 z^2/2 in a step, least */
} balance;

/* unlimited: the force as it would be without the bound on sigma1. */
static void account(balance *b, const cipc_friction_force *force, bool unlimited, double v, double dt, double *z)
{
    double begin = *z, F = cipc_friction_step(force, v, dt, z);
    if (unlimited) F = force->sigma0 * *z + force->sigma1 * ((*z - begin) / dt);
    double work = F * v * dt, stored = 0.5 * force->sigma0 * (*z - begin) * (*z + begin);
    b->work += work;
    b->size += fabs(work);
    b->least = fmin(b->least, work - stored);
}

enum { PIECES = 12 };

/* A closed path of pieces at random speeds, from a tenth of the band to 1000 times it, and with random lengths about Fc/sigma0; run through until z comes back to where it was. */
static balance closed_path(const cipc_friction_force *force, bool unlimited, uint64_t *seed)
{
    double v[PIECES], dt[PIECES], way = 0, z = 0;
    for (int i = 0; i < PIECES; i++) {
        double travel = 0.01 * pow(10, random_uniform(seed, -2, 0.7)) * (random_below(seed, 2) ? 1 : -1);
        if (i == PIECES - 1) travel = -way;
        v[i] = copysign(force->band * pow(10, random_uniform(seed, -1, 3)), travel);
        dt[i] = travel / v[i];
        way += travel;
    }
    for (int round = 0; round < 1000; round++) {
        balance b = {0, 0, 1e9};
        double begin = z;
        for (int i = 0; i < PIECES; i++) account(&b, force, unlimited, v[i], dt[i], &z);
        if (force->law == CIPC_LAW_COULOMB || fabs(z - begin) <= 1e-15) return b;
    }
    fail_msg("the state does not become periodic");
    return (balance){0, 0, 0};
}

typedef struct campaign { double least_cycle, least_step; int paths, negative; } campaign;

static campaign random_paths(int law, double ratio, double sigma1, bool unlimited)
{
    campaign c = {1e9, 1e9, 2000, 0};
    uint64_t seed = 21;
    for (int i = 0; i < c.paths; i++) {
        const cipc_friction_force force = of_law(law, ratio, sigma1);
        balance b = closed_path(&force, unlimited, &seed);
        c.least_cycle = fmin(c.least_cycle, b.work / b.size);
        c.least_step = fmin(c.least_step, b.least / 0.01);
        c.negative += b.work < 0;
    }
    return c;
}

/* sigma1 is 25 times what is allowed at the greatest speed. */
static void test_random_paths(void **state)
{
    (void)state;
    double cycle = 1e9, step = 1e9;
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        for (int i = 0; i < 4; i++) {
            campaign c = random_paths(law, i % 2 ? 1.79 : 1.2, i / 2 ? 100 : 0.1, false);
            cycle = fmin(cycle, c.least_cycle);
            if (law != CIPC_LAW_COULOMB) step = fmin(step, c.least_step); /* which stores nothing */
        }
    }
    claim_figure("D8", "every law, closed random paths: work over the sum of its magnitudes, least", cycle, "1", CLAIM_AT_LEAST, 0);
    claim_figure("D8", "the same: work less growth of sigma0 z^2/2 in a step, in Fc^2/sigma0, least", step, "1", CLAIM_AT_LEAST, -1e-14);
}

/* Without the bound R1 gives energy away. But only where z is beyond its own bound h/sigma0, so never with Fs = Fc, whatever sigma1: w = sigma0 z sgn(v)/h <= 1 makes the power h |v| w^2 + sigma1 v^2
 * (1 - w) positive. SPEC B.4 has sigma1 <= 4 h/|v| as necessary too, which it is for w >= 2 alone. */
static void test_what_the_bound_is_for(void **state)
{
    (void)state;
    campaign wild = random_paths(CIPC_LAW_BIDIRECTIONAL, 1.79, 100, true), flat = random_paths(CIPC_LAW_BIDIRECTIONAL, 1, 100, true);
    print_message("without the bound: Fs = 1.79 Fc: %d of %d paths give energy, least %.3g; Fs = Fc: %d, least %.3g\n", wild.negative, wild.paths, wild.least_cycle, flat.negative, flat.least_cycle);
    claim_figure("D8", "bidirectional without the bound of sigma1, Fs = 1.79 Fc: paths of 2000 that give energy", wild.negative, "1", CLAIM_AT_LEAST, 1);
    claim_figure("D8", "the same with Fs = Fc", flat.negative, "1", CLAIM_EQUAL, 0);
    assert_true(flat.least_step >= -1e-14);
}

/* Least work less growth of the store of a single fast step, from z = ratio Fc/sigma0 or less, at the bound of sigma1, in Fc^2/sigma0. */
static double least_fast_step(double ratio, double sigma1, bool unlimited)
{
    balance b = {0, 0, 1e9};
    for (int i = 0; i <= 200; i++) {
        for (double travel = 1e-5; travel < 10; travel *= 1.05) {
            const cipc_friction_force force = of_law(CIPC_LAW_BIDIRECTIONAL, ratio, sigma1);
            double z = 0.01 * (1 + (ratio - 1) * i / 200);
            account(&b, &force, unlimited, 1, 0.01 * travel, &z);
        }
    }
    return b.least / 0.01;
}

/* With the force of the end of the step, which is what is applied, 4 h/|v| is enough up to Fs = 1.79 Fc; beyond that a step as long as Fc/sigma0 can give energy, and even a cycle can. The bound for
 * steps of any length and any Fs would be 3.59 h/|v|. */
static void test_what_the_bound_is_not_enough_for(void **state)
{
    (void)state;
    double within = least_fast_step(1.79, 1e6, false), beyond = least_fast_step(1.85, 1e6, false), far = least_fast_step(4, 1e6, false), narrower = least_fast_step(4, 3.59, true);
    print_message("a fast step: least %.3g (Fs = 1.79 Fc), %.3g (1.85), %.3g (4); with 3.59 h/|v| %.3g (4)\n", within, beyond, far, narrower);
    assert_true(within >= 0 && beyond < 0 && far < -0.3 && narrower >= 0);
    const cipc_friction_force force = of_law(CIPC_LAW_BIDIRECTIONAL, 100, 4); /* 4 h/|v| when fast */
    const double slow = 1e-6, slow_way = 0.0447;
    double z = 0, cycle[2];
    for (int fine = 0; fine < 2; fine++) { /* slowly to z = 2.8 Fc/sigma0, on from there fast by Fc/sigma0 in one step or in a thousand, and the same backwards */
        balance b = {0, 0, 0};
        int steps = fine ? 1000 : 1;
        for (int i = 0; i < 200; i++) {
            double sign = i % 2 ? -1 : 1;
            if (i == 198) b = (balance){0, 0, 0};
            for (int k = 0; k < 100; k++) account(&b, &force, false, sign * slow, slow_way / slow / 100, &z);
            for (int k = 0; k < steps; k++) account(&b, &force, false, sign, 0.01 / steps, &z);
        }
        cycle[fine] = b.work / 0.01;
    }
    print_message("Fs = 100 Fc: work of a cycle %.3g with one fast step, %.3g with a thousand\n", cycle[0], cycle[1]);
    assert_true(cycle[0] < -0.1 && cycle[1] > 0);
}

/* On a spring without load, from 1 m: energy with what z stores, each time the block turns. That of the spring alone falls until the block only bends z, and then goes to and fro with it. */
static void test_free_oscillator(void **state)
{
    (void)state;
    const cipc_friction_force dahl = {.law = CIPC_LAW_DAHL, .sigma0 = 10, .coulomb = 0.05, .breakaway = 0.05};
    friction_block block = {.mass = 1, .spring = 1, .x = 1};
    double before = 0.5, growth = -1e9, way_before = 1;
    for (int turns = 0; turns < 60;) {
        double v = block.v;
        friction_block_step(&block, &dahl, 1e-4);
        if (v == 0 || (v < 0) == (block.v < 0)) continue;
        double energy = 0.5 * block.x * block.x + 0.5 * block.v * block.v + 0.5 * dahl.sigma0 * block.z * block.z;
        growth = fmax(growth, energy / before - 1);
        if (turns < 8) assert_true(fabs(fabs(block.x) - (way_before - 2 * 0.05)) <= 0.02); /* Coulomb: 2 Fc/k less from turn to turn; what bends first takes less */
        way_before = fabs(block.x);
        before = energy;
        turns++;
    }
    print_message("after 60 turns: energy %.3g of 0.5 J\n", before);
    claim_figure("D8", "free oscillator with Dahl's friction, 60 turning points: growth of energy from one to the next, relative, largest", growth, "1", CLAIM_LESS, 0);
    assert_true(before < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_paths),
        cmocka_unit_test(test_what_the_bound_is_for),
        cmocka_unit_test(test_what_the_bound_is_not_enough_for),
        cmocka_unit_test(test_free_oscillator),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
