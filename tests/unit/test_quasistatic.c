/* Steps without inertia: equilibrium in closed form, rest afterwards, scripted motion; and drag by mass-proportional damping. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "support/sheet_scene.h"

static const double young = 1e4, thickness = 1e-3, density = 300, g = 9.81;

/* A triangle whose upper side is held; its third node hangs 1 m below. Poisson's ratio 0: it stretches straight down. */
static cipc_body_description *hang(sheet_scene *scene)
{
    const double a[3] = {-0.5, 0, 0}, b[3] = {0.5, 0, 0}, c[3] = {0, -1, 0};
    sheet_scene_init(scene);
    scene->gravity[1] = -g;
    cipc_body_description *body = sheet_add_triangle(scene, "triangle", a, b, c);
    body->material.membrane = CIPC_MEMBRANE_STVK;
    body->material.membrane_young = young;
    body->material.membrane_poisson = 0;
    body->material.thickness = thickness;
    body->material.density = density;
    return body;
}

static void start(sheet_scene *scene)
{
    const int held[] = {0, 1};
    sheet_scene_model(scene);
    sheet_hold(scene, held, 2, NULL, INFINITY);
    sheet_scene_stepper(scene);
}

/* V E (s^2 - 1)/2 s = m g, the root by bisection: V the volume, m a third of the mass, length 1. */
static double expected_stretch(void)
{
    double volume = 0.5 * thickness, weight = volume * density / 3 * g, low = 1, high = 2;
    for (int k = 0; k < 100; k++) {
        double s = 0.5 * (low + high);
        if (volume * young * (s * s - 1) / 2 * s < weight)
            low = s;
        else
            high = s;
    }
    return low;
}

/* The last Newton step was shorter than tolerance * h, and convergence is quadratic. */
static void test_equilibrium(void **state)
{
    (void)state;
    sheet_scene scene;
    hang(&scene);
    scene.options.quasistatic = true;
    scene.options.newton_tolerance = 1e-7;
    start(&scene);
    sheet_step(&scene);
    double error = fabs(-scene.state->position[7] - expected_stretch());
    if (!(error <= 1e-9)) fail_msg("stretch %.15g, wanted %.15g", -scene.state->position[7], expected_stretch());
    assert_true(fabs(expected_stretch() - 1) > 0.05);
    for (int i = 0; i < 9; i++) assert_true(scene.state->velocity[i] == 0);
    double before = scene.state->position[7];
    sheet_step(&scene);
    assert_true(fabs(scene.state->position[7] - before) <= 1e-9 && scene.report.newton_iterations <= 2);
    assert_true(scene.report.kinetic == 0);
    sheet_scene_free(&scene);
}

/* Euler's step of the same triangle is on its way, not there. */
static void test_inertia_makes_a_difference(void **state)
{
    (void)state;
    sheet_scene scene;
    hang(&scene);
    start(&scene);
    sheet_step(&scene);
    assert_true(-scene.state->position[7] < 1 + 0.1 * (expected_stretch() - 1));
    sheet_scene_free(&scene);
}

/* A free triangle under gravity with drag a: m (v' - v)/h = m g - a m v', so v' = (v + h g)/(1 + a h). */
static void test_mass_damping(void **state)
{
    (void)state;
    sheet_scene scene;
    const double rate = 3;
    cipc_body_description *body = hang(&scene);
    body->material.damping_mass = rate;
    scene.options.newton_tolerance = 1e-8;
    sheet_scene_build(&scene);
    double v = 0, h = scene.options.time_step;
    for (int n = 0; n < 20; n++) {
        sheet_step(&scene);
        v = (v - h * g) / (1 + rate * h);
        for (int i = 0; i < 3; i++) assert_true(fabs(scene.state->velocity[3 * i + 1] - v) <= 1e-7 * (n + 1));
    }
    assert_true(v > -0.8 * 20 * h * g);
    sheet_scene_free(&scene);
}

/* A triangle that nothing holds falls for ever: there is no equilibrium, and none may be reported. It is so stiff that its Newton matrix, which has no mass in it, is positive definite only
 * with more mass added than there is: the Newton steps are short then, and mean nothing. */
static void test_no_equilibrium(void **state)
{
    (void)state;
    for (int stiff = 0; stiff < 2; stiff++) {
        sheet_scene scene;
        cipc_body_description *body = hang(&scene);
        body->material.membrane_young = stiff ? 1e23 : young;
        scene.options.quasistatic = true;
        scene.options.newton_iterations = 30;
        sheet_scene_build(&scene);
        cipc_status status = sheet_try_step(&scene);
        if (status == CIPC_OK) fail_msg("stiff %d: an equilibrium %g m below", stiff, -1 - scene.state->position[7]);
        sheet_scene_free(&scene);
    }
}

/* A stretched triangle let go: one step of implicit Euler of a damped oscillator, (1 + b h k/m + h^2 k/m) x' = x (1 + b h k/m) for small x at rest before. */
static void test_stiffness_damping(void **state)
{
    (void)state;
    const double rate = 0.05, stretch = 1e-6;
    for (int damped = 0; damped < 2; damped++) {
        sheet_scene scene;
        cipc_body_description *body = hang(&scene);
        scene.gravity[1] = 0;
        body->material.damping_stiffness = damped ? rate : 0;
        scene.options.newton_tolerance = 1e-12;
        start(&scene);
        scene.state->position[7] -= stretch;
        sheet_step(&scene);
        double h = scene.options.time_step, k = young * thickness * 0.5, m = scene.model->mass[2], drag = damped ? rate * h * k / m : 0;
        double expected = (1 + drag) / (1 + drag + h * h * k / m), measured = (-1 - scene.state->position[7]) / stretch;
        /* E's second derivative changes by 3/2 of the strain, 1e-6 */
        if (!(fabs(measured - expected) <= 1e-5 * expected)) fail_msg("damped %d: %.9g of the stretch is left, wanted %.9g", damped, measured, expected);
        assert_true(damped ? scene.report.incremental.damping > 0 : scene.report.incremental.damping == 0);
        sheet_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equilibrium),
        cmocka_unit_test(test_inertia_makes_a_difference),
        cmocka_unit_test(test_mass_damping),
        cmocka_unit_test(test_no_equilibrium),
        cmocka_unit_test(test_stiffness_damping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
