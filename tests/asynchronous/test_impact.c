/* A particle flies straight at a fixed plane (SPEC T-A1): how many layers it takes to turn it round, and where it turns, follow from its energy alone. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "support/claim.h"
#include "support/impact_scene.h"
#include "support/layer_potential.h"
#include "support/validation.h"

static const layer_law law = {0.1, 1000};

/* The table of SPEC T-A1: m = 1 kg, eta(1) = 0.1 m, r(1) = 1000 N/m; gaps as simulated there, to four digits. */
static const struct { double speed; int layers; double gap; } published[] = {{1, 2, .0766}, {3, 5, .0655}, {10, 10, .0551}, {30, 20, .0471}, {100, 40, .0397}, {300, 75, .0339}};
enum { SPEEDS = sizeof published / sizeof *published };
static const double published_digit = 1e-4; /* 3 m/s: 0.06545 m in closed form */

/* gamma as F2 counts it. */
static const double gamma_impact = 0.005;

static double prediction(double speed, double *force)
{
    const double d = layer_law_gap_at_energy(law, 0.5 * impact_mass * speed * speed);
    *force = layer_law_force(law, d);
    return d;
}

static void test_prediction_is_the_published_one(void **state)
{
    (void)state;
    for (int i = 0; i < SPEEDS; i++) {
        double force;
        const double d = prediction(published[i].speed, &force);
        assert_int_equal(layer_law_count(law, d), published[i].layers);
        assert_true(fabs(d - published[i].gap) < published_digit);
    }
}

/* What finite steps make of the turning gap.
 *
 * Energy on the way in. A kick of layer l at its tick k changes the kinetic energy by h F(x_k) (v before + v after)/2 exactly. As long as the layer is in reach its potential is a parabola, of which
 * the trapezoidal rule between two ticks is exact, so that nothing is lost but in the one interval in which the layer comes into reach: the tick at its end finds a depth of theta v h,
 * 0 <= theta <= 1, and the rule has 1/2 r theta (v h)^2 for the parabola's 1/2 r (theta v h)^2. The difference is at most r (v h)^2/8 = gamma^2 m v^2/2 for h^2 r = 4 gamma^2 m: gamma^2 of the
 * kinetic energy then, and n gamma^2 of all of it for n layers with the worst of phases. (That clocks of different layers tick between one another has an effect of random sign, smaller by
 * a factor of 5 and more up to 20 layers: test_energy.) On the force F it shifts the turning point by n gamma^2 K/F.
 *
 * The ticks that the gap is measured at. The deepest layer ticks within h(n)/2 of the turning, where the particle is not more than 1/2 (F/m) (h(n)/2)^2 from where it turned. */
static double step_explains(double speed, int layers, double force)
{
    const double energy = 0.5 * impact_mass * speed * speed, h = layer_law_step(law, impact_mass, gamma_impact, layers);
    return layers * gamma_impact * gamma_impact * energy / force + force / impact_mass * h * h / 8;
}

static void test_layers_and_gaps(void **state)
{
    (void)state;
    double layers_off = 0, gap_off = 0, asymptote_off = 0;
    for (int i = 0; i < SPEEDS; i++) {
        const double speed = published[i].speed, start = 1.5 * impact_thickness;
        double force;
        const double d = prediction(speed, &force), asymptote = pow(840 * 0.5 * impact_mass * speed * speed / (impact_stiffness * impact_thickness * impact_thickness), 2.0 / 7);
        asynchronous_scene s;
        impact_scene_init(&s, 1, &start, speed, gamma_impact);
        s.options.frame = 2 * start / speed + acos(-1) * sqrt(impact_mass / impact_stiffness); /* there, half a period of the softest layer, back */
        asynchronous_scene_build(&s);
        asynchronous_steps(&s, 1);
        assert_true(impact_speed(&s, 0) > 0 && impact_gap(&s, 0) > impact_thickness);
        const double explained = step_explains(speed, published[i].layers, force), off = fabs(s.min_gap - d) / explained;
        char scene[128];
        (void)snprintf(scene, sizeof scene, "asynchronous: head-on impact at %g m/s through %d layers (T-A1)", speed, s.layers);
        validation_row(scene, "least gap, m", d, s.min_gap, explained / d);
        gap_off = fmax(gap_off, off);
        layers_off = fmax(layers_off, fabs((double)(s.layers - published[i].layers)));
        asymptote_off = fmax(asymptote_off, fabs(asymptote / pow(impact_thickness / s.min_gap, 4) - 1));
        asynchronous_scene_free(&s);
    }
    claim_figure("A6", "head-on impact at 1 to 300 m/s: layers used, off the closed form, largest", layers_off, "1", CLAIM_EQUAL, 0);
    claim_figure("A6", "the same: least gap off its closed form, part of what the finite step explains, largest", gap_off, "1", CLAIM_AT_MOST, 1);
    claim_figure("A6", "the same: (eta(1)/gap)^4 off (840 K/(r(1) eta(1)^2))^(2/7), relative, largest", asymptote_off, "1", CLAIM_LESS, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_prediction_is_the_published_one),
        cmocka_unit_test(test_layers_and_gaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
