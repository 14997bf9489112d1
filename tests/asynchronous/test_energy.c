/* Energy (SPEC A.2, F2, T-A9): exactly constant under gravity alone; how far an impact through the layers misses it, against the step; and what that comes to over many bounces.
 * CIPC_IMPACTS=N in the environment takes N times as many phases. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/claim.h"
#include "support/exact_geometry.h"
#include "support/impact_scene.h"
#include "support/layer_potential.h"
#include "support/validation.h"

static const layer_law law = {0.1, 1000};
static const double g = 9.81;

/* ---- Gravity alone ---------------------------------------------------------------------------------------------------------------------- */

/* Kicks of g h: with the velocity in the middle of a kick v_k = -g h (k - 1/2) and y_k = y_0 - g h^2 k (k - 1)/2 at t = k h, so that E = m g y_0 + m g^2 h^2/8 at every tick. What rounding does:
 * each of the n kicks rounds v by u |v| and each drift y by u |y|, which E takes up m |v| and m g times. */
static void test_gravity_alone(void **state)
{
    (void)state;
    const double height = 5, step = 0x1p-9;
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    asynchronous_add_particles(&s, "stone", 1, (double[3]){0.3, height, -0.2}, (double[3]){0, 0, 0}, 2);
    s.sheet.gravity[1] = -g;
    s.options.frame = 0x1p-5;
    s.options.gravity_step = step;
    asynchronous_scene_build(&s);
    const double m = s.sheet.model->mass[0], expected = m * g * height + m * g * g * step * step / 8, seconds = 10;
    double off = 0;
    while (s.sheet.state->time < seconds) {
        asynchronous_steps(&s, 1);
        off = fmax(off, fabs(s.report.kinetic + s.report.gravitational - expected));
    }
    const double fastest = g * seconds, furthest = 0.5 * g * seconds * seconds, roundings = UNIT_ROUNDOFF * (seconds / step) * (m * fastest * fastest + m * g * furthest);
    print_message("gravity alone: %ld ticks, energy off by %.2g J of %.4g J, rounding explains %.2g J\n", s.events[CIPC_EVENT_GRAVITY], off, expected, roundings);
    assert_true(s.events[CIPC_EVENT_GRAVITY] >= (long)(seconds / step));
    assert_true(off <= roundings && roundings < 1e-9 * expected);
    asynchronous_scene_free(&s);
}

/* ---- One impact ------------------------------------------------------------------------------------------------------------------------- */

enum { GAMMAS = 5, DEPTHS = 3, PHASES = IMPACT_MOST };
static const double gammas[GAMMAS] = {0.2, 0.1, 0.05, 0.025, 0.0125};
static const struct { double speed; int layers; double published[GAMMAS]; } depths[DEPTHS] = { /* F2: of 400 phases each, two digits */
    {0.4, 1, {1.5e-2, 5.0e-3, 1.4e-3, 2.2e-4, 8.3e-5}},
    {4.43, 6, {1.1e-1, 2.3e-2, 1.8e-3, 4.5e-4, 9.8e-5}},
    {30, 20, {2.0e-1, 4.3e-2, 9.3e-3, 2.2e-3, 5.1e-4}},
};
enum { PUBLISHED_PHASES = 400 };

/* Relative errors of `count` impacts; of the last PHASES of them one by one. */
typedef struct impacts { double rms, mean, kurtosis, count; double gaps[PHASES], error[PHASES]; } impacts;

/* Impacts that begin at random times of 50 ticks of the slowest layer: sums of their errors, errors^2, errors^4. */
static void fly(impacts *r, double speed, double gamma, uint64_t random, double sums[3])
{
    const double spread = 50 * layer_law_step(law, impact_mass, gamma, 1);
    asynchronous_scene s;
    for (int i = 0; i < PHASES; i++) r->gaps[i] = law.thickness + speed * random_uniform(&random, 0, spread);
    impact_scene_init(&s, PHASES, r->gaps, speed, gamma);
    s.options.frame = 1.1 * spread + 2 * acos(-1) * sqrt(impact_mass / impact_stiffness);
    asynchronous_scene_build(&s);
    asynchronous_steps(&s, 1);
    for (int i = 0; i < PHASES; i++) {
        const double ratio = impact_speed(&s, i) / speed, e = r->error[i] = (ratio - 1) * (ratio + 1);
        assert_true(impact_speed(&s, i) > 0 && impact_gap(&s, i) > law.thickness);
        sums[0] += e;
        sums[1] += e * e;
        sums[2] += e * e * e * e;
    }
    asynchronous_scene_free(&s);
}

static void measure(impacts *r, double speed, double gamma)
{
    const char *asked = getenv("CIPC_IMPACTS");
    const int runs = asked ? atoi(asked) : 1;
    double sums[3] = {0};
    assert_true(runs > 0);
    for (int n = 0; n < runs; n++) fly(r, speed, gamma, 11 + (uint64_t)n, sums);
    r->count = (double)runs * PHASES;
    r->mean = sums[0] / r->count;
    r->rms = sqrt(sums[1] / r->count);
    r->kurtosis = sums[2] / r->count / (r->rms * r->rms * r->rms * r->rms);
}

static const impacts *measured(int depth, int gamma)
{
    static impacts all[DEPTHS][GAMMAS];
    impacts *r = &all[depth][gamma];
    if (!(r->rms > 0)) measure(r, depths[depth].speed, gammas[gamma]);
    return r;
}

/* In layer 1 alone leapfrog can be solved. The first tick inside finds a depth D_1 = theta v h; as if there had been a force before, D_0 = D_1 - v h; from there D_k turns by the angle phi,
 * cos phi = 1 - 2 gamma^2, until the first D <= 0, from where on the particle flies with the velocity it has. */
static double error_in_one_layer(double gap, double speed, double gamma)
{
    const double h = layer_law_step(law, impact_mass, gamma, 1), phi = acos(1 - 2 * gamma * gamma), arrival = (gap - law.thickness) / speed;
    const double D1 = speed * (h * ceil(arrival / h) - arrival), D0 = D1 - speed * h;
    double before = D1, now = D1;
    for (int k = 2; now > 0; k++) {
        before = now;
        now = (D1 * sin(k * phi) - D0 * sin((k - 1) * phi)) / sin(phi);
    }
    const double ratio = (before - now) / h / speed;
    return (ratio - 1) * (ratio + 1);
}

/* In any number of layers: all of them ticking at all times, nothing culled, on a line. */
static double error_of_plain_simulation(double gap, double speed, double gamma, int layers)
{
    enum { MOST = 32 };
    double step[MOST], y = gap, v = -speed, t = 0;
    long tick[MOST];
    assert_true(layers < MOST);
    for (int l = 1; l <= layers; l++) step[l] = layer_law_step(law, impact_mass, gamma, l), tick[l] = 1;
    while (v < 0 || y < law.thickness) {
        int next = 1;
        for (int l = 2; l <= layers; l++)
            if ((double)tick[l] * step[l] < (double)tick[next] * step[next]) next = l;
        const double now = (double)tick[next] * step[next], eta = law.thickness * pow(next, -0.25);
        y += v * (now - t);
        t = now;
        tick[next]++;
        if (y < eta) v += step[next] * law.stiffness * pow(next, 3) * (eta - y) / impact_mass;
    }
    const double ratio = v / speed;
    return (ratio - 1) * (ratio + 1);
}

/* The integrator finds gaps from coordinates of 20 m, to some units in their last place, 1e-14 m: the force at the turning, which goes like d^(-15), is off by 15 times as much of the gap of 0.05 m
 * and more, 3e-12, in a tick. Some hundred ticks do the work, and what they are off by is of random sign. */
static const double rounding_of_an_impact = 1e-10;

static void test_against_plain_simulation(void **state)
{
    (void)state;
    enum { COMPARED = 12 };
    double off = 0, off_solved = 0;
    for (int d = 0; d < DEPTHS; d++)
        for (int k = 0; k < GAMMAS; k++) {
            const impacts *r = measured(d, k);
            for (int i = 0; i < COMPARED; i++) off = fmax(off, fabs(r->error[i] - error_of_plain_simulation(r->gaps[i], depths[d].speed, gammas[k], depths[d].layers + 4)));
            for (int i = 0; i < PHASES && depths[d].layers == 1; i++) off_solved = fmax(off_solved, fabs(r->error[i] - error_in_one_layer(r->gaps[i], depths[d].speed, gammas[k])));
        }
    print_message("errors of the energy off a plain simulation by %.2g, off the solution for one layer by %.2g\n", off, off_solved);
    assert_true(off < rounding_of_an_impact);
    assert_true(off_solved < rounding_of_an_impact);
}

/* Half a unit of the second of two digits, relative. */
static double half_digit(double x) { return 0.5 * pow(10, floor(log10(x)) - 1) / x; }

/* Two samples of the same distribution have an rms that differs by (kappa - 1)/4 (1/N + 1/M) in relative variance; 15 figures are compared, so that four standard errors are seldom passed. */
static double sampling_tolerance(const impacts *r, double published)
{
    return 4 * sqrt((r->kurtosis - 1) / 4 * (1.0 / PUBLISHED_PHASES + 1 / r->count)) + half_digit(published);
}

static void test_error_of_an_impact(void **state)
{
    (void)state;
    double least_slope = INFINITY, largest_mean = 0, at_default = 0;
    for (int d = 0; d < DEPTHS; d++) {
        double rms[GAMMAS];
        for (int k = 0; k < GAMMAS; k++) {
            char scene[128], curve[32];
            const impacts *r = measured(d, k);
            rms[k] = r->rms;
            print_message("%2d layers, gamma = %.4g: rms %.3g (F2: %.2g), mean %.2g = %.1f standard errors, kurtosis %.2g\n", depths[d].layers, gammas[k], r->rms, depths[d].published[k], r->mean,
                          r->mean / r->rms * sqrt(r->count), r->kurtosis);
            (void)snprintf(scene, sizeof scene, "asynchronous: impact through %d layer%s, gamma = %g (F2, T-A9)", depths[d].layers, depths[d].layers > 1 ? "s" : "", gammas[k]);
            (void)snprintf(curve, sizeof curve, "%d layer%s", depths[d].layers, depths[d].layers > 1 ? "s" : "");
            validation_row(scene, "rms error of the energy, of it", depths[d].published[k], r->rms, sampling_tolerance(r, depths[d].published[k]));
            validation_point("asynchronous-energy", curve, gammas[k], r->rms);
            if (gammas[k] <= 0.05) largest_mean = fmax(largest_mean, fabs(r->mean) / r->rms);
            /* Long steps gain energy, beyond chance (F2: 3.5 standard errors). */
            if (gammas[k] == 0.2 && depths[d].layers > 1) assert_true(r->mean > 3.5 * r->rms / sqrt(r->count));
        }
        least_slope = fmin(least_slope, log(rms[1] / rms[4]) / log(gammas[1] / gammas[4]));
        at_default = fmax(at_default, rms[3]);
    }
    claim_figure("A3", "impacts through 1, 6, 20 layers: rms error of the energy ~ gamma^p, gamma from 0.1 to 0.0125: p, least", least_slope, "1", CLAIM_AT_LEAST, 1.8);
    claim_figure("A3", "gamma <= 0.05: mean error over rms, largest", largest_mean, "1", CLAIM_LESS, 0.2);
    claim_figure("A3", "gamma = 0.025: rms error of the energy of an impact, largest", at_default, "1", CLAIM_AT_MOST, 3e-3);
}

/* ---- Many bounces ----------------------------------------------------------------------------------------------------------------------- */

/* Particles fall from 1 m, 4.43 m/s and six layers deep, and bounce for `seconds`: mean and rms of the relative change of their energies, of all that are not in contact at the end. */
static void bounce(double gamma, double seconds, double *mean, double *rms)
{
    enum { COUNT = 25 };
    const double gravity_step = 0x1p-10, frame = 0x1p-6;
    double heights[COUNT], sum = 0, sum2 = 0;
    int count = 0;
    asynchronous_scene s;
    for (int i = 0; i < COUNT; i++) heights[i] = 1 + law.thickness + 0.0137 * i;
    impact_scene_init(&s, COUNT, heights, 0, gamma);
    s.sheet.gravity[1] = -g;
    s.options.frame = frame;
    s.options.gravity_step = gravity_step;
    asynchronous_scene_build(&s);
    asynchronous_steps(&s, (int)(seconds / frame));
    for (int i = 0; i < COUNT; i++) {
        if (impact_gap(&s, i) < law.thickness) continue;
        const double v = impact_speed(&s, i) + 0.5 * g * gravity_step; /* a tick of gravity is just over: in the middle of its kick */
        const double change = (0.5 * v * v + g * impact_gap(&s, i)) / (g * heights[i]) - 1;
        sum += change;
        sum2 += change * change;
        count++;
    }
    assert_true(count > COUNT / 2);
    *mean = sum / count;
    *rms = sqrt(sum2 / count);
    print_message("bouncing for %g s, gamma = %g: energy changed by %.3g in the mean, rms %.3g\n", seconds, gamma, *mean, *rms);
    asynchronous_scene_free(&s);
}

/* A random walk (F2): after N bounces the rms is that of one bounce times the square root of N. A bounce takes 2 v/g = 0.9 s and some 0.03 s in the layers. */
static void test_many_bounces(void **state)
{
    (void)state;
    double mean, rms;
    const double seconds = 64, bounces = seconds / (2 * 4.43 / g + 0.03), walk = measured(1, 3)->rms * sqrt(bounces);
    bounce(0.025, seconds, &mean, &rms);
    print_message("random walk of %.0f bounces: %.3g\n", bounces, walk);
    claim_within("A3", "64 s of bouncing at gamma = 0.025: rms change of energy over that of a random walk", rms / walk, "1", 0.5, 2);
    const double near = rms;
    bounce(0.2, seconds / 4, &mean, &rms);
    assert_true(rms > 10 * near); /* long steps are no such walk */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gravity_alone),
        cmocka_unit_test(test_against_plain_simulation),
        cmocka_unit_test(test_error_of_an_impact),
        cmocka_unit_test(test_many_bounces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
