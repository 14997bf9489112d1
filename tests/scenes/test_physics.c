/* Scenes with known answers (SPEC E): free fall, momentum, the hung strip with its strain limit, symmetry. What rests and slides on a plane is in test_plane.c. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "support/exact_geometry.h"
#include "support/claim.h"
#include "support/sheet_scene.h"

static const double g = 9.81;
static const double origin[3] = {0, 0, 0};

static double fall_of(const sheet_scene *scene, int node, int k, const double *start)
{
    return scene->state->position[3 * node + k] - start[3 * node + k];
}

/* --- E1: free fall ------------------------------------------------------------------------------------------------------------------ */

/* Positions and velocities are sums of n rounded steps on numbers of size 1: n u, and the solver's residual, some 10 u a step. */
static const double free_fall_tolerance = 1e-12;

static void free_fall(bool midpoint)
{
    enum { STEPS = 100, NODES = 9 };
    sheet_scene scene;
    const double u[3] = {1, 0, 0}, v[3] = {0, 0.3, 1}, velocity[3] = {0.3, 2, -0.1};
    double start[3 * NODES], mass = 0, energy = 0;
    sheet_scene_init(&scene);
    scene.options.time_step = 1e-3;
    if (midpoint) scene.options.integrator = (cipc_integrator){1, 0.5, 0.5};
    sheet_set_velocity(sheet_add_grid(&scene, "sheet", origin, u, v, 2, 2), velocity);
    scene.gravity[1] = -g;
    sheet_scene_build(&scene);
    memcpy(start, scene.state->position, sizeof start);
    for (int i = 0; i < NODES; i++) {
        mass += scene.model->mass[i];
        energy += scene.model->mass[i] * (0.5 * (0.3 * 0.3 + 2 * 2 + 0.1 * 0.1) + g * start[3 * i + 1]);
    }
    for (int n = 1; n <= STEPS; n++) {
        sheet_step(&scene);
        double h = scene.options.time_step, t = n * h;
        /* Euler: x_n = x_0 + v_0 t - g h^2 n (n + 1) / 2; midpoint: the parabola itself */
        double drop = midpoint ? g * t * t / 2 : g * h * h * n * (n + 1) / 2;
        for (int i = 0; i < NODES; i++)
            for (int k = 0; k < 3; k++) {
                double want = velocity[k] * t - (k == 1 ? drop : 0), speed = velocity[k] - (k == 1 ? g * t : 0);
                assert_true(fabs(fall_of(&scene, i, k, start) - want) <= free_fall_tolerance);
                assert_true(fabs(scene.state->velocity[3 * i + k] - speed) <= free_fall_tolerance / h);
            }
        /* Euler loses m g^2 h^2 / 2 a step, the midpoint rule nothing */
        double lost = energy - (scene.report.kinetic + scene.report.gravitational + scene.report.elastic);
        assert_true(fabs(lost - (midpoint ? 0 : mass * n * g * g * h * h / 2)) <= free_fall_tolerance * energy * 1e2);
    }
    sheet_scene_free(&scene);
}

static void test_free_fall_euler(void **state)
{
    (void)state;
    free_fall(false);
}
static void test_free_fall_midpoint(void **state)
{
    (void)state;
    free_fall(true);
}

/* --- E2: momentum ------------------------------------------------------------------------------------------------------------------- */

/* A full Newton step makes the sum of the gradient zero whatever the iterate: elastic, barrier and projected Hessian terms sum to zero over
 * the nodes, so after it sum g(x + p) = sum g(x) + sum m p = -sum (H p) + sum m p = 0, up to the residual of the linear solution and the
 * rounding of the forces. Both are some 10 u of what they are made of: forces h^2 f ~ m v h in a collision, so 1e-14 of sum m |v| a step,
 * and 1e-12 with the factor by which stiff parts exceed that. */
static const double momentum_tolerance = 1e-12;

static void momentum_of(const sheet_scene *scene, double sum[3], double *size)
{
    sum[0] = sum[1] = sum[2] = *size = 0;
    for (int i = 0; i < scene->model->node_count; i++) {
        double speed2 = 0;
        for (int k = 0; k < 3; k++) {
            sum[k] += scene->model->mass[i] * scene->state->velocity[3 * i + k];
            speed2 += scene->state->velocity[3 * i + k] * scene->state->velocity[3 * i + k];
        }
        *size += scene->model->mass[i] * sqrt(speed2);
    }
}

static void test_momentum(void **state)
{
    (void)state;
    sheet_scene scene;
    const double u[3] = {0.2, 0, 0}, v[3] = {0, 0.02, 0.2}, above[3] = {0.03, 0.02, 0.05}, down[3] = {0.2, -1, 0}, up[3] = {0, 1, 0.1};
    double before[3], after[3], size, first[3], first_size;
    int contacts = 0;
    sheet_scene_init(&scene);
    sheet_set_velocity(sheet_add_grid(&scene, "lower", origin, u, v, 3, 3), up);
    cipc_body_description *upper = sheet_add_grid(&scene, "upper", above, v, u, 2, 2);
    sheet_set_velocity(upper, down);
    upper->material.density = 900;
    upper->offset = 1e-3;
    sheet_scene_build(&scene);
    sheet_watch(&scene);
    momentum_of(&scene, first, &first_size);
    for (int n = 1; n <= 40; n++) {
        momentum_of(&scene, before, &size);
        sheet_step(&scene);
        contacts += scene.report.contacts > 0;
        momentum_of(&scene, after, &size);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(after[k] - before[k]) <= momentum_tolerance * first_size);
            assert_true(fabs(after[k] - first[k]) <= n * momentum_tolerance * first_size);
        }
    }
    assert_true(contacts >= 2);                            /* they did collide, */
    assert_true(scene.state->velocity[3 * 16 + 1] > -0.5); /* and the upper one was turned back */
    assert_int_equal(scene.energy_rises, 0);
    sheet_scene_free(&scene);
}

/* Angular momentum of a free spinning sheet decays under implicit Euler (SPEC E2: check the decay only) and is kept far better by the
 * midpoint rule. */
static void test_angular_momentum(void **state)
{
    (void)state;
    double left[2];
    for (int midpoint = 0; midpoint < 2; midpoint++) {
        sheet_scene scene;
        const double corner[3] = {-0.1, 0, -0.1}, u[3] = {0.2, 0, 0}, v[3] = {0, 0, 0.2};
        sheet_scene_init(&scene);
        scene.options.newton_tolerance = 1e-9;
        scene.options.time_step = 1e-3;
        if (midpoint) scene.options.integrator = (cipc_integrator){1, 0.5, 0.5};
        sheet_add_grid(&scene, "sheet", corner, u, v, 2, 2);
        sheet_scene_build(&scene);
        for (int i = 0; i < 9; i++) {
            scene.state->velocity[3 * i] = 10 * scene.state->position[3 * i + 2];
            scene.state->velocity[3 * i + 2] = -10 * scene.state->position[3 * i];
        }
        double first = 0, last = INFINITY;
        for (int n = 0; n <= 60; n++) {
            double L = 0;
            if (n > 0) sheet_step(&scene);
            for (int i = 0; i < 9; i++)
                L += scene.model->mass[i] * (scene.state->position[3 * i + 2] * scene.state->velocity[3 * i] -
                                             scene.state->position[3 * i] * scene.state->velocity[3 * i + 2]);
            if (n == 0) first = L;
            if (!midpoint) assert_true(L < last && L > 0);
            last = L;
        }
        left[midpoint] = 1 - last / first;
        sheet_scene_free(&scene);
    }
    assert_true(left[0] > 1e-3 && left[0] < 0.2);
    assert_true(fabs(left[1]) < 1e-3 * left[0]);
}

/* --- E7: the hung strip -------------------------------------------------------------------------------------------------------------- */

static const double strip_width = 0.1, strip_thickness = 1e-3, strip_young = 1e4, strip_limit = 1.06, strip_activation = 1,
                    strip_stiffness = 1e3;

/* Force of the uniformly stretched strip (StVK, nu = 0): w t [E (s^2 - 1)/2 s + kappa_s b'(s)] (SPEC E7, C.2). */
static double strip_force(double s, double kappa)
{
    double range = strip_limit - strip_activation, y = strip_activation - s;
    double slope = s > strip_activation ? (2 * y * log((strip_limit - s) / range) + y * y / (strip_limit - s)) / (range * range) : 0;
    return strip_width * strip_thickness * (strip_young * (s * s - 1) / 2 * s + kappa * slope);
}

static double strip_stretch(double weight, double kappa)
{
    double low = 1, high = strip_limit;
    for (int k = 0; k < 200; k++) {
        double middle = 0.5 * (low + high);
        if (strip_force(middle, kappa) < weight)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* For any weight the strip holds below its limit, at every accepted point, and comes to rest where the forces balance. At rest an error e
 * of the stretch means an unbalanced force; Newton's tolerance, 1e-10 m/s * h over a length of 0.2 m, is 5e-12 of stretch: but the balance
 * is compared through the stretch's distance from the limit, which for the heaviest weight is 1e-5 of the limit, known to the 20 bits of
 * the solver's step and some settling: 1e-4 of that distance is asked. */
static void test_hung_strip(void **state)
{
    (void)state;
    double most = 0;
    for (double weight = 1e-2; weight < 2e4; weight *= 10) {
        sheet_scene scene;
        const double u[3] = {strip_width, 0, 0}, v[3] = {0, -0.2, 0};
        static const int top[2] = {0, 1};
        sheet_scene_init(&scene);
        scene.options.time_step = 0.05;
        scene.options.newton_tolerance = 1e-10;
        scene.gravity[1] = -g;
        cipc_material *m = &sheet_add_grid(&scene, "strip", origin, u, v, 1, 1)->material;
        m->membrane = CIPC_MEMBRANE_STVK;
        m->membrane_young = strip_young;
        m->membrane_poisson = 0;
        m->thickness = strip_thickness;
        m->strain_limit = strip_limit;
        m->strain_activation = strip_activation;
        m->strain_stiffness = strip_stiffness;
        sheet_scene_model(&scene);
        sheet_hold(&scene, top, 2, NULL, INFINITY);
        sheet_scene_stepper(&scene);
        scene.model->mass[2] = scene.model->mass[3] = weight / 2 / g; /* the weight hangs on the two lower nodes */
        sheet_watch(&scene);
        for (int n = 0; n < 120; n++) {
            if (sheet_try_step(&scene)) fail_msg("W = %g, step %d: %s", weight, n, scene.error.what);
        }
        double s = -scene.state->position[3 * 2 + 1] / 0.2,
               want = strip_stretch(weight, strip_stiffness * scene.report.strain_stiffness_factor);
        assert_true(scene.max_stretch_ratio < 1);
        assert_true(s < strip_limit && s > 1);
        if (!(fabs(s - want) <= 1e-4 * (strip_limit - want)))
            fail_msg("W = %g: stretch %.12g, balance at %.12g, factor %g", weight, s, want, scene.report.strain_stiffness_factor);
        assert_true(fabs(scene.state->position[3 * 3 + 1] - scene.state->position[3 * 2 + 1]) < 1e-9); /* uniform */
        most = fmax(most, scene.max_stretch_ratio);
        sheet_scene_free(&scene);
    }
    claim_figure("C4 any load", "strip with limit 1.06, weights of 0.01 to 10,000 N: part of the limit used at any accepted point", most, "1", CLAIM_LESS, 1);
}

/* --- E28: symmetry -------------------------------------------------------------------------------------------------------------------- */

/* Images under which doubles are mapped exactly: y is the vertical. */
typedef enum image { SAME = 0, MIRRORED, TURNED } image;

static void map(image which, double p[3])
{
    double x = p[0], z = p[2];
    if (which == MIRRORED) p[0] = -x;
    if (which == TURNED) p[0] = z, p[2] = -x;
}

/* A crumpled cloth falls obliquely on a tilted wall and on another cloth, with friction. */
static void fall_on_wall(image which, int steps, double *positions)
{
    uint64_t seed = 111;
    sheet_scene scene;
    double wall[3] = {-0.3, -0.05, -0.3}, wide[3] = {0.8, 0.1, 0.05}, deep[3] = {0.02, 0, 0.8}, first[3] = {0, 0.012, 0},
           second[3] = {0.03, 0.02, 0.01}, u[3] = {0.2, 0.02, 0}, v[3] = {0, 0, 0.2}, slide[3] = {0.4, -1, 0.1};
    double *const all[] = {wall, wide, deep, first, second, u, v, slide};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) map(which, all[i]);
    sheet_scene_init(&scene);
    scene.options.newton_tolerance = 1e-7;
    sheet_add_grid(&scene, "wall", wall, wide, deep, 1, 1)->fixed = true;
    sheet_set_velocity(sheet_add_grid(&scene, "first", first, u, v, 3, 3), slide);
    sheet_set_velocity(sheet_add_grid(&scene, "second", second, u, v, 2, 2), slide);
    for (int b = 0; b < 3; b++) scene.bodies[b].friction = 0.3;
    scene.gravity[1] = -g;
    sheet_scene_build(&scene);
    for (int i = 4; i < scene.model->node_count; i++) {
        double jolt[3];
        random_fill(&seed, jolt, 3, 1e-3);
        map(which, jolt);
        for (int k = 0; k < 3; k++) scene.state->position[3 * i + k] += jolt[k];
    }
    sheet_steps(&scene, steps);
    assert_true(scene.report.contacts > 10);
    memcpy(positions, scene.state->position, 3 * (size_t)scene.model->node_count * sizeof(double));
    sheet_scene_free(&scene);
}

/* The image of the result is the result of the image, to the Newton tolerance times the number of steps and a factor of growth in
 * collisions: 1e-7 m/s * h * steps is 1e-8 m; the last Newton steps, quadratic, leave far less. */
static void test_symmetry(void **state)
{
    (void)state;
    enum { STEPS = 8, NODES = 4 + 16 + 9 };
    double plain[3 * NODES], mapped[3 * NODES];
    fall_on_wall(SAME, STEPS, plain);
    for (image which = MIRRORED; which <= TURNED; which++) {
        double moved = 0;
        fall_on_wall(which, STEPS, mapped);
        for (int i = 0; i < NODES; i++) {
            double p[3] = {plain[3 * i], plain[3 * i + 1], plain[3 * i + 2]};
            map(which, p);
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(mapped[3 * i + k] - p[k]) <= 1e-8);
                moved = fmax(moved, fabs(mapped[3 * i + k] - plain[3 * i + k]));
            }
        }
        assert_true(moved > 0.1); /* the image is another scene */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_fall_euler),  cmocka_unit_test(test_free_fall_midpoint), cmocka_unit_test(test_momentum),
        cmocka_unit_test(test_angular_momentum), cmocka_unit_test(test_hung_strip),         cmocka_unit_test(test_symmetry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
