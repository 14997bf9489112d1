/* Bodies of every codimension on a plane (SPEC E3, E4, E5): the gap at which they rest, the creep of sticking friction, sliding, and the distance to a stop. A stack of sheets. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/claim.h"
#include "support/sheet_scene.h"
#include "support/validation.h"

static const double g = 9.81;

enum { KINDS = 4, PLANE_NODES = 3 };
static const char *const kind_name[KINDS] = {"shell", "rods", "particles", "volume"};

/* --- E4: resting gaps --------------------------------------------------------------------------------------------------------------- */

/* Force h^2 W of one point-plane contact at the gap `gap`: kappa (-b_D) 2 d (SPEC C.4). */
static double contact_force(double kappa, double xi, double dhat, double gap)
{
    double d = xi + gap, D = gap * (gap + 2 * xi), Dhat = dhat * (2 * xi + dhat);
    double b_D = -2 * (D - Dhat) * log(D / Dhat) - (D - Dhat) * (D - Dhat) / D;
    return -kappa * b_D * 2 * d;
}

/* The gap at which a contact carries h^2 W. */
static double resting_gap(double kappa, double xi, double dhat, double load)
{
    double low = 0, high = dhat;
    for (int k = 0; k < 200; k++) {
        double middle = 0.5 * (low + high);
        if (contact_force(kappa, xi, dhat, middle) > load)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* An equilateral triangle of circumradius r at height y around the axis, turned so that nested ones touch nowhere but from node to inside.
 */
static cipc_body_description *add_equilateral(sheet_scene *scene, const char *name, double r, double y)
{
    const double s = 0.5 * sqrt(3) * r, a[3] = {r, y, 0}, b[3] = {-0.5 * r, y, -s}, c[3] = {-0.5 * r, y, s};
    return sheet_add_triangle(scene, name, a, b, c);
}

/* A contact of stiffness k in a step of implicit Euler relaxes like an overdamped oscillator: with h^2 k >> m the distance from rest
 * shrinks by m / (h^2 k) a step and more; after 200 steps nothing is left but the Newton tolerance, 1e-9 m/s * h, and rounding. */
enum { SETTLING_STEPS = 200 };
static const double gap_tolerance = 1e-10;

/* On three nodes, the corners of an equilateral triangle at height y: the triangle, its three sides as rods, the corners as particles, or a tetrahedron with a fourth node above. */
static cipc_body_description *add_three_legged(sheet_scene *scene, cipc_body_kind kind, double y)
{
    const double r = 0.1, s = 0.5 * sqrt(3) * r, corners[12] = {r, y, 0, -0.5 * r, y, -s, -0.5 * r, y, s, 0, y + r, 0};
    static const int triangle[1][3] = {{0, 1, 2}}, segments[3][2] = {{0, 1}, {1, 2}, {2, 0}}, tetrahedron[1][4] = {{0, 1, 2, 3}};
    cipc_body_description body = {.name = "legs", .kind = kind, .rest = corners, .position = corners, .node_count = kind == CIPC_BODY_VOLUME ? 4 : 3,
                                  .material = {.density = 500, .thickness = 1e-3, .membrane = CIPC_MEMBRANE_NEO_HOOKEAN, .membrane_young = 1e5, .membrane_poisson = 0.3, .young = 1e6, .poisson = 0.3}};
    if (kind == CIPC_BODY_SHELL) body.triangle_count = 1, body.triangles = triangle;
    if (kind == CIPC_BODY_RODS) body.segment_count = 3, body.segments = segments;
    if (kind == CIPC_BODY_VOLUME) body.tetrahedron_count = 1, body.tetrahedra = tetrahedron;
    return sheet_add(scene, &body);
}

/* The plane, and on it a body of which each foot bears `load` kg, whatever its kind. */
static void stand(sheet_scene *scene, cipc_body_kind kind, double mu, double xi, double y, double load)
{
    scene->options.contact.area_weights = false;
    add_equilateral(scene, "plane", -5, 0)->fixed = true;
    add_three_legged(scene, kind, y);
    for (int b = 0; b < 2; b++) {
        scene->bodies[b].offset = xi;
        scene->bodies[b].friction = mu;
    }
    sheet_scene_model(scene);
    int nodes = scene->bodies[1].node_count;
    for (int i = 0; i < nodes; i++) scene->model->mass[PLANE_NODES + i] = 3 * load / nodes;
    sheet_scene_stepper(scene);
}

/* SPEC E4: m = 1e-5 kg a foot, kappa = 25, dhat = 1 mm, h = 0.04 s. */
static void test_resting_gap(void **state)
{
    (void)state;
    static const double offsets[3] = {0, 1e-4, 1e-3}, printed[3] = {3.847221e-4, 4.315394e-4, 6.854509e-4};
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 3; k++) {
            sheet_scene scene;
            char title[64];
            sheet_scene_init(&scene);
            scene.options.time_step = 0.04;
            scene.options.newton_tolerance = 1e-9;
            scene.options.barrier_stiffness = 25;
            scene.gravity[1] = -g;
            stand(&scene, (cipc_body_kind)kind, 0, offsets[k], offsets[k] + 5e-4, 1e-5);
            sheet_steps(&scene, SETTLING_STEPS);
            double want = resting_gap(25, offsets[k], 1e-3, 1e-5 * g * 0.04 * 0.04);
            assert_true(fabs(want - printed[k]) < 0.6e-10);
            assert_int_equal(scene.report.contacts, 3);
            for (int i = 3; i < 6; i++) assert_true(fabs(scene.state->position[3 * i + 1] - offsets[k] - want) <= gap_tolerance);
            (void)snprintf(title, sizeof title, "%s at rest on a plane, xi = %g m (E4)", kind_name[kind], offsets[k]);
            validation_row(title, "gap less xi, m", want, scene.report.min_gap, gap_tolerance / want);
            sheet_scene_free(&scene);
        }
}

/* With weights a node's contact is as stiff as its area is large, compared with the mean. */
static void rest_weighted(double xi)
{
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.time_step = 0.04;
    scene.options.newton_tolerance = 1e-9;
    scene.options.barrier_stiffness = 25;
    scene.gravity[1] = -g;
    add_equilateral(&scene, "wall", -2, 0)->fixed = true;
    cipc_body_description *plate = add_equilateral(&scene, "plate", 0.1, xi + 5e-4);
    for (int b = 0; b < 2; b++) scene.bodies[b].offset = xi;
    plate->material.density = 3e-5 / (0.75 * sqrt(3) * 0.1 * 0.1 * plate->material.thickness);
    sheet_scene_build(&scene);
    sheet_steps(&scene, SETTLING_STEPS);
    double weight = scene.model->node_area[3] / ((scene.model->node_area[0] + scene.model->node_area[3]) / 2);
    assert_true(fabs(scene.report.min_gap - resting_gap(25 * weight, xi, 1e-3, 1e-5 * g * 0.04 * 0.04)) <= gap_tolerance);
    assert_int_equal(scene.report.contacts, 3);
    sheet_scene_free(&scene);
}

static void test_weighted_resting_gap(void **state)
{
    (void)state;
    rest_weighted(0);
    rest_weighted(1e-4);
    rest_weighted(1e-3);
}

/* Nested triangles on one another: interface j carries what is above it, a third of it at each node; each gap is in closed form, and they
 * grow upwards. */
static void test_stack(void **state)
{
    (void)state;
    enum { SHEETS = 4 };
    const double xi = 1.2e-3, h = 0.01, kappa = 100; /* xi > dhat: next neighbours only */
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.time_step = h;
    scene.options.newton_tolerance = 1e-9;
    scene.options.barrier_stiffness = kappa;
    scene.options.contact.area_weights = false;
    scene.gravity[1] = -g;
    add_equilateral(&scene, "wall", -5, 0)->fixed = true;
    for (int j = 1; j <= SHEETS; j++) {
        char name[8] = {(char)('a' + j), 0};
        add_equilateral(&scene, name, (j % 2 ? 1 : -1) * 0.8 / pow(2.5, j), j * (xi + 5e-4)); /* turned by half a turn each time */
    }
    for (int b = 0; b <= SHEETS; b++) scene.bodies[b].offset = xi;
    sheet_scene_build(&scene);
    sheet_watch(&scene);
    sheet_steps(&scene, 3 * SETTLING_STEPS);
    double load = 0, gaps[SHEETS + 1], below;
    for (int j = SHEETS; j >= 1; j--) {
        load += scene.model->mass[3 * j] * g * h * h;
        gaps[j] = resting_gap(kappa, xi, 1e-3, load);
    }
    below = 0;
    double off = 0;
    for (int j = 1; j <= SHEETS; j++) {
        double y = scene.state->position[9 * j + 1];
        off = fmax(off, fabs(y - below - xi - gaps[j]));
        assert_true(fabs(y - below - xi - gaps[j]) <= gap_tolerance * 10);
        assert_true(j == 1 || y - below > xi + gaps[j - 1]);
        below = y;
    }
    assert_true(scene.min_gap > 0);
    claim_figure("C9 stacks", "four sheets: gaps off their closed form, largest", off, "m", CLAIM_AT_MOST, gap_tolerance * 10);
    sheet_scene_free(&scene);
}

/* --- E3, E5: friction ---------------------------------------------------------------------------------------------------------------- */

/* A body at rest on the plane at its resting gap, in a gravity that is tilted by the angle of the incline. */
static void incline(sheet_scene *scene, cipc_body_kind kind, double mu, double angle, double speed)
{
    const double kappa = 1, xi = 1e-4, h = 0.01, load = 2e-3, velocity[3] = {speed, 0, 0};
    double gap = resting_gap(kappa, xi, 1e-3, load * g * cos(angle) * h * h);
    sheet_scene_init(scene);
    scene->options.time_step = h;
    scene->options.newton_tolerance = 1e-10;
    scene->options.barrier_stiffness = kappa;
    scene->gravity[0] = g * sin(angle);
    scene->gravity[1] = -g * cos(angle);
    stand(scene, kind, mu, xi, xi + gap, load);
    for (int i = PLANE_NODES; i < scene->model->node_count; i++) memcpy(scene->state->velocity + 3 * i, velocity, sizeof velocity);
}

static double mean_along(const sheet_scene *scene, const double *vectors)
{
    double sum = 0;
    for (int i = PLANE_NODES; i < scene->model->node_count; i++) sum += vectors[3 * i];
    return sum / (scene->model->node_count - PLANE_NODES);
}

static double mean_speed(const sheet_scene *scene) { return mean_along(scene, scene->state->velocity); }

/* Below the threshold: never faster than the creep of SPEC D.6, eps_v (1 - sqrt(1 - F_t / (mu lambda))), and that in the end. The lagged
 * normal force is the exact one to the Newton tolerance 1e-10 m/s * h relative to the gap (1e-8), which moves the creep by 1e-8 / (1 -
 * ratio) of eps_v: 1e-9 m/s is generous. The tetrahedron, whose weight is above its feet, leans forward at first and is only asked for the end. */
static const double creep_tolerance = 1e-9;

static void test_incline_sticks(void **state)
{
    (void)state;
    static const double ratios[] = {0.1, 0.5, 0.9, 0.99}, printed[] = {.05132, .29289, .68377, .9};
    double off = 0;
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 4; k++) {
            const double mu = 0.5, eps_v = 1e-3;
            sheet_scene scene;
            char title[64];
            incline(&scene, (cipc_body_kind)kind, mu, atan(ratios[k] * mu), 0);
            double creep = eps_v * (1 - sqrt(1 - ratios[k]));
            assert_true(fabs(creep / eps_v - printed[k]) < 1e-5);
            for (int n = 0; n < 150; n++) {
                sheet_step(&scene);
                if (kind != CIPC_BODY_VOLUME) assert_true(mean_speed(&scene) <= creep + creep_tolerance && mean_speed(&scene) > 0);
            }
            (void)snprintf(title, sizeof title, "%s on a slope, tan a = %g mu (E3)", kind_name[kind], ratios[k]);
            validation_row(title, "creep, m/s", creep, mean_speed(&scene), creep_tolerance / creep);
            off = fmax(off, fabs(mean_speed(&scene) - creep));
            sheet_scene_free(&scene);
        }
    claim_figure("C11 threshold", "every codimension at tan a = 0.1 to 0.99 mu: creep off its closed form, largest", off, "m/s", CLAIM_AT_MOST, creep_tolerance);
}

/* Above it: once faster than eps_v, each step adds h g (sin a - mu cos a). Relative error of friction 1e-8 as above, of an increment of 1 %
 * of it: 1e-6; in the last ten steps, when the tetrahedron has come to rest on its feet. */
static void test_incline_slides(void **state)
{
    (void)state;
    const double mu = 0.5, angle = atan(1.01 * mu), acceleration = g * (sin(angle) - mu * cos(angle));
    double off = 0;
    for (int kind = 0; kind < KINDS; kind++) {
        sheet_scene scene;
        char title[64];
        incline(&scene, (cipc_body_kind)kind, mu, angle, 0);
        double before = 0, late = 0;
        int sliding = 0;
        for (int n = 0; n < 160; n++) {
            sheet_step(&scene);
            double speed = mean_speed(&scene);
            if (kind != CIPC_BODY_VOLUME) {
                assert_true(speed > before);
                if (before > scene.options.friction_velocity) {
                    assert_true(fabs((speed - before) / (scene.options.time_step * acceleration) - 1) <= 1e-6);
                    sliding++;
                }
            }
            if (n == 149) late = speed;
            before = speed;
        }
        assert_true(sliding > 130 || kind == CIPC_BODY_VOLUME);
        (void)snprintf(title, sizeof title, "%s on a slope, tan a = 1.01 mu (E3)", kind_name[kind]);
        validation_row(title, "acceleration, m/s^2", acceleration, (before - late) / (10 * scene.options.time_step), 1e-6);
        off = fmax(off, fabs((before - late) / (10 * scene.options.time_step * acceleration) - 1));
        sheet_scene_free(&scene);
    }
    claim_figure("C11 threshold", "every codimension at tan a = 1.01 mu: acceleration off its closed form, largest, relative", off, "1", CLAIM_AT_MOST, 1e-6);
}

/* E5: from v_0 to rest on v_0^2 / (2 mu g), to h v_0 and what the last, creeping part adds: eps_v times the time. */
static void test_stopping_distance(void **state)
{
    (void)state;
    const double mu = 0.4, v0 = 0.8;
    for (int kind = 0; kind < KINDS; kind++) {
        sheet_scene scene;
        char title[64];
        incline(&scene, (cipc_body_kind)kind, mu, 0, v0);
        double start = mean_along(&scene, scene.state->position);
        sheet_steps(&scene, 60);
        double distance = mean_along(&scene, scene.state->position) - start, h = scene.options.time_step;
        assert_true(fabs(distance - v0 * v0 / (2 * mu * g)) <= h * v0 + 60 * h * scene.options.friction_velocity);
        /* implicit Euler's own sum: v_n = v_0 - n h mu g as long as it is positive, h sum v_n */
        double sum = 0;
        for (double v = v0 - h * mu * g; v > 0; v -= h * mu * g) sum += h * v;
        assert_true(fabs(mean_speed(&scene)) < scene.options.friction_velocity);
        (void)snprintf(title, sizeof title, "%s sliding to a stop from %g m/s (E5)", kind_name[kind], v0);
        validation_row(title, "distance of implicit Euler, m", sum, distance, 60 * h * scene.options.friction_velocity / sum);
        sheet_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_resting_gap),    cmocka_unit_test(test_weighted_resting_gap), cmocka_unit_test(test_stack),
        cmocka_unit_test(test_incline_sticks), cmocka_unit_test(test_incline_slides),       cmocka_unit_test(test_stopping_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
