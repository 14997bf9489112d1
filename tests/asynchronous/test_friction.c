/* Friction, a reconstruction [R] (SPEC A.8): sliding brakes by mu times the normal impulse to the last bit; there is no true sticking, but a creep that is proportional to the step of gravity. On a
 * plane on which gravity is turned instead of the plane. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "support/exact_geometry.h"
#include "support/impact_scene.h"
#include "support/validation.h"

static const double g = 9.81, frame = 0.04, mu = 0.5, stiffness = 1000;

/* A particle in layer 1 where it bears the weight, on a slope of tan a, that begins with a speed along it; h(1) = gravity_step / ratio. */
static void slope_scene(asynchronous_scene *s, double tangent, double speed, double restitution, double gravity_step, double ratio)
{
    const double a = atan(tangent), gamma = gravity_step / ratio * sqrt(stiffness / impact_mass) / 2, gap = impact_thickness - impact_mass * g * cos(a) / stiffness;
    impact_scene_init(s, 1, &gap, 0, gamma);
    ((double *)(uintptr_t)s->sheet.bodies[0].velocity)[0] = speed;
    s->sheet.gravity[0] = g * sin(a);
    s->sheet.gravity[1] = -g * cos(a);
    s->options.frame = frame;
    s->options.gravity_step = gravity_step;
    s->options.stiffness = stiffness;
    s->options.restitution = restitution;
    for (int b = 0; b < 2; b++) s->sheet.bodies[b].friction = mu;
    asynchronous_scene_build(s);
}

static double along(const asynchronous_scene *s) { return s->sheet.state->velocity[0]; }

/* While it slides one way all impulses of friction are mu times the normal ones, whose sum is what the normal velocity has changed by and gravity has not. To rounding: each kick rounds the velocity
 * by half a unit in its last place. */
static void test_sliding(void **state)
{
    (void)state;
    const double gravity_step = frame / 16, slopes[3] = {0, 1.1 * mu, 1.5 * mu};
    for (int i = 0; i < 6; i++) {
        const double a = atan(slopes[i % 3]), start = 3, restitution = i / 3 == 0;
        asynchronous_scene s;
        double off = 0;
        slope_scene(&s, slopes[i % 3], start, restitution, gravity_step, 4.15);
        for (int n = 0; n < 12; n++) {
            asynchronous_steps(&s, 1);
            const double t = s.sheet.state->time, expected = start + g * sin(a) * t - mu * (impact_speed(&s, 0) + g * cos(a) * t);
            off = fmax(off, fabs(along(&s) - expected));
        }
        const double kicks = (double)(s.events[CIPC_EVENT_PENALTY] + s.events[CIPC_EVENT_GRAVITY]), fastest = fmax(start, along(&s)) + g * 12 * frame;
        print_message("tan a = %.2f mu, e = %g: %.4g m/s after %.2f s, off by %.2g\n", slopes[i % 3] / mu, restitution, along(&s), s.sheet.state->time, off);
        assert_true(along(&s) > 0.1 && off <= 2 * kicks * UNIT_ROUNDOFF * fastest);
        asynchronous_scene_free(&s);
    }
}

/* On the level it slides to a stop, v^2/(2 mu g) away but for what a step of each clock adds, and then stands to the last bit: friction stops and never turns round. */
static void test_stopping(void **state)
{
    (void)state;
    const double gravity_step = frame / 16, ratio = 4.15, speed = 3;
    asynchronous_scene s;
    slope_scene(&s, 0, speed, 1, gravity_step, ratio);
    const double begin = s.sheet.state->position[0];
    for (int n = 0; n < 20; n++) {
        asynchronous_steps(&s, 1);
        assert_true(along(&s) >= 0);
    }
    const double stopped = s.sheet.state->position[0], distance = stopped - begin, expected = speed * speed / (2 * mu * g);
    assert_true(along(&s) == 0);
    asynchronous_steps(&s, 20);
    assert_true(along(&s) == 0 && s.sheet.state->position[0] == stopped);
    /* Plus the swing of the normal force, which carries an impulse of m g (h_g + h)/2 (test_resting) and so a change of speed of mu times that for as long as it slides. */
    const double clocks = gravity_step * (1 + 1 / ratio), swing = mu * g * clocks / 2 * speed / (mu * g);
    validation_row("asynchronous: sliding to a stop from 3 m/s", "distance v^2/(2 mu g), m", expected, distance, (speed * clocks + swing) / expected);
    asynchronous_scene_free(&s);
}

/* tan a < mu. Each tick of gravity gives a speed g sin(a) h_g, which the layers, ticking often, brake within t = h_g tan(a)/mu: a creep of g sin(a) h_g t/2 every h_g. The speed falls in stairs of
 * a layer's step, half a stair above the line in the mean: more by h(1)/t, relatively, at most. */
static void test_creep(void **state)
{
    (void)state;
    static const double ratio = 66.4;
    const double parts[4] = {0.1, 0.3, 0.5, 0.9};
    for (int i = 0; i < 8; i++) {
        const double part = parts[i % 4], gravity_step = frame / (i / 4 == 0 ? 16 : 64), a = atan(part * mu), seconds = 1;
        asynchronous_scene s;
        slope_scene(&s, part * mu, 0, 1, gravity_step, ratio);
        const double begin = s.sheet.state->position[0];
        asynchronous_steps(&s, (int)(seconds / frame));
        const double creep = (s.sheet.state->position[0] - begin) / seconds, expected = 0.5 * g * sin(a) * gravity_step * part;
        char scene[128];
        (void)snprintf(scene, sizeof scene, "asynchronous: slope, tan a = %g mu, gravity every %g ms", part, 1e3 * gravity_step);
        validation_row(scene, "creep, m/s", expected, creep, 1 / (ratio * part));
        asynchronous_scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sliding),
        cmocka_unit_test(test_stopping),
        cmocka_unit_test(test_creep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
