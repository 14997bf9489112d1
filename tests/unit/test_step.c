/* One time step as a whole: what it reports, the integrators, friction lagging, threads, monitors, lack of memory. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/stepper.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"
#include "support/sheet_scene.h"

static const double corner[3] = {0, 0, 0}, side_x[3] = {0.2, 0, 0}, side_z[3] = {0, 0, 0.2};

/* Two crumpled cloths that fall obliquely on a slab, one on the other, with friction and thickness; the upper's last corner is led
 * sideways. */
static void pile(sheet_scene *scene)
{
    const double slab[3] = {-0.3, 0, -0.3}, wide[3] = {0.8, 0, 0}, deep[3] = {0, 0, 0.8}, first[3] = {0, 0.004, 0},
                 second[3] = {0.03, 0.009, 0.02}, slide[3] = {0.5, -0.8, 0.2};
    uint64_t seed = 101;
    static const int led[1] = {4 + 16 + 15};
    const cipc_motion motion = {.begin = 0.01, .end = 0.03, .velocity = {0.2, 0, 0.1}};
    sheet_add_grid(scene, "slab", slab, wide, deep, 1, 1)->fixed = true;
    for (int b = 0; b < 2; b++) {
        cipc_body_description *cloth = sheet_add_grid(scene, b ? "upper" : "lower", b ? second : first, side_x, side_z, 3, 3);
        sheet_set_velocity(cloth, slide);
        cloth->offset = b ? 5e-4 : 0;
        cloth->material.strain_limit = 1.1;
        cloth->material.strain_activation = 1;
        cloth->material.strain_stiffness = 1e3;
    }
    for (int b = 0; b < 3; b++) scene->bodies[b].friction = 0.3;
    scene->gravity[1] = -9.81;
    scene->options.newton_tolerance = 1e-3;
    sheet_scene_model(scene);
    sheet_hold(scene, led, 1, &motion, 0.04);
    sheet_scene_stepper(scene);
    for (int i = 12; i < 3 * scene->model->node_count; i++) scene->state->position[i] += random_uniform(&seed, -5e-4, 5e-4);
}

enum { PILE_NODES = 4 + 16 + 16 };

/* --- the report and the new state ------------------------------------------------------------------------------------------------ */

static void test_report(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    pile(&scene);
    for (int step = 1; step <= 6; step++) {
        double before[3 * PILE_NODES], kinetic = 0, gravitational = 0, sum = 0;
        memcpy(before, scene.state->position, sizeof before);
        sheet_step(&scene);
        const cipc_step_report *r = &scene.report;
        assert_int_equal(scene.state->step, step);
        assert_true(scene.state->time == step * scene.options.time_step);
        for (int i = 0; i < 3 * PILE_NODES; i++) {
            assert_true(scene.state->velocity[i] == (scene.state->position[i] - before[i]) / scene.options.time_step);
            if (scene.stepper->is_dirichlet[i / 3]) continue;
            kinetic += 0.5 * scene.model->mass[i / 3] * scene.state->velocity[i] * scene.state->velocity[i];
            gravitational -= scene.model->mass[i / 3] * scene.model->gravity[i % 3] * scene.state->position[i];
        }
        assert_true(fabs(r->kinetic - kinetic) <= 1e-13 * kinetic);
        assert_true(fabs(r->gravitational - gravitational) <= 1e-13 * fabs(gravitational) + 1e-18);
        const cipc_energy_terms *e = &r->incremental;
        double total = e->inertia + e->membrane + e->bending + e->strain_limit + e->barrier + e->friction + e->penalty;
        assert_true(fabs(e->total - total) <= 1e-14 * total);
        double h2 = scene.options.time_step * scene.options.time_step;
        assert_true(fabs(r->elastic - (e->membrane + e->bending + e->strain_limit) / h2) <= 1e-14 * r->elastic);
        assert_true(r->contacts <= r->max_contacts && r->contacts == scene.stepper->contacts.count);
        assert_true(r->contacts == 0 ? r->min_gap == INFINITY : r->min_gap > 0 && r->min_gap < scene.options.contact.dhat);
        assert_true(r->barrier_stiffness > 0 && r->barrier_stiffness == scene.state->barrier_stiffness);
        assert_true(r->strain_stiffness_factor >= 1 && r->strain_stiffness_factor == scene.state->strain_stiffness_factor);
        assert_true(r->factorizations >= r->newton_iterations && r->newton_iterations > 0);
        assert_int_equal(r->friction_passes, 1);
        for (int p = 0; p < CIPC_PHASE_COUNT; p++) {
            sum += r->seconds[p];
            assert_true(p == CIPC_PHASE_OTHER || r->seconds[p] >= -1e-9);
        }
        assert_true(sum > 0); /* the parts add up to the whole by their definition */
    }
    assert_true(scene.report.contacts > 0);
    sheet_scene_free(&scene);
}

/* kappa: chosen once in the released way, or as asked, then kept; fitted within its range for every step otherwise. */
static void test_stiffness_choice(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.released = k == 1;
        scene.options.barrier_stiffness = k == 2 ? 12.5 : 0;
        pile(&scene);
        cipc_stiffness_range range =
            k == 1 ? cipc_barrier_stiffness_range_released(scene.stepper->mean_mass, 1e-3)
                   : cipc_barrier_stiffness_range(scene.stepper->bounding_box_diagonal, scene.stepper->mean_mass, 5e-4, 1e-3);
        double want = k == 1 ? range.minimum : 12.5;
        for (int step = 0; step < 4; step++) {
            sheet_step(&scene);
            if (k > 0)
                assert_true(scene.report.barrier_stiffness == want);
            else
                assert_true(scene.report.barrier_stiffness >= range.minimum && scene.report.barrier_stiffness <= range.maximum);
        }
        sheet_scene_free(&scene);
    }
}

/* Bounding box of the rest shapes; mean mass of the nodes that may move, or of all as released. */
static void test_measures(void **state)
{
    (void)state;
    for (int released = 0; released < 2; released++) {
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.released = released;
        pile(&scene);
        double sum = 0;
        int count = 0;
        for (int i = released ? 0 : 4; i < PILE_NODES; i++, count++) sum += scene.model->mass[i];
        assert_true(fabs(scene.stepper->mean_mass - sum / count) <= 1e-15 * scene.stepper->mean_mass * count);
        assert_true(fabs(scene.stepper->bounding_box_diagonal - sqrt(0.8 * 0.8 * 2 + 0.009 * 0.009)) < 1e-15);
        sheet_scene_free(&scene);
    }
    sheet_scene scene; /* nothing but fixed bodies: any mass will do, as long as it is one */
    sheet_scene_init(&scene);
    sheet_add_grid(&scene, "wall", corner, side_x, side_z, 1, 1)->fixed = true;
    sheet_scene_build(&scene);
    assert_true(scene.stepper->mean_mass == scene.model->mass[0]);
    sheet_scene_free(&scene);
}

/* --- integrators ------------------------------------------------------------------------------------------------------------------- */

/* A stretched free sheet swings: total energy of the midpoint rule stays, implicit Euler's decays; both keep momentum. h is a 150th of the
 * period. */
static void test_midpoint_energy(void **state)
{
    (void)state;
    double worst[2] = {0, 0};
    for (int midpoint = 0; midpoint < 2; midpoint++) {
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.time_step = 2e-4;
        scene.options.newton_tolerance = 1e-9;
        if (midpoint) scene.options.integrator = (cipc_integrator){1, 0.5, 0.5};
        sheet_add_grid(&scene, "sheet", corner, side_x, side_z, 3, 3);
        sheet_scene_build(&scene);
        for (int i = 0; i < 16; i++) scene.state->position[3 * i] *= 1.05;
        /* Psi at the start: the first step of a very short time */
        double first = 0;
        for (int step = 0; step < 250; step++) {
            sheet_step(&scene);
            double energy = scene.report.kinetic + scene.report.elastic;
            if (step == 0) first = energy;
            worst[midpoint] = fmax(worst[midpoint], fabs(energy - first) / first);
        }
        sheet_scene_free(&scene);
    }
    assert_true(worst[0] > 0.2);             /* Euler loses its part */
    assert_true(worst[1] < 1e-3 * worst[0]); /* the midpoint rule errs by O((omega h)^2) times the nonlinearity */
}

/* The strain limit acts at the end of the step whatever the integrator: a free fall onto two held corners with the midpoint rule. */
static void test_midpoint_strain_limit(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.integrator = (cipc_integrator){1, 0.5, 0.5};
    cipc_body_description *body = sheet_add_grid(&scene, "sheet", corner, side_x, side_z, 3, 3);
    body->material.membrane_young = 1e3;
    body->material.strain_limit = 1.05;
    body->material.strain_activation = 1;
    body->material.strain_stiffness = 1e3;
    scene.gravity[1] = -9.81;
    sheet_scene_model(&scene);
    static const int held[2] = {0, 3};
    sheet_hold(&scene, held, 2, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_watch(&scene);
    sheet_steps(&scene, 30);
    assert_true(scene.max_stretch_ratio > 0.5 && scene.max_stretch_ratio < 1);
    assert_int_equal(scene.energy_rises, 0);
    sheet_scene_free(&scene);
}

/* --- friction lagging ---------------------------------------------------------------------------------------------------------------- */

/* friction_iterations = 0: until one more Newton step with new data changes nothing. */
static void test_friction_converges(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.friction_iterations = 0;
    pile(&scene);
    int most = 0;
    for (int step = 0; step < 12; step++) {
        sheet_step(&scene);
        most = scene.report.friction_passes > most ? scene.report.friction_passes : most;
        cipc_stepper *s = scene.stepper;
        if (s->friction.count == 0) continue;
        /* once more by hand: with data from the solution a single step is within the tolerance */
        scene.report.newton_iterations = 0;
        s->report = &scene.report;
        assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
        assert_int_equal(cipc_newton(s, NULL), CIPC_OK);
        assert_true(scene.report.newton_iterations <= 2);
        s->report = NULL;
    }
    assert_true(most >= 2);
    sheet_scene_free(&scene);
}

/* Two passes asked for, two made; and a cap on "until it converges" that is too small is an error with its own remedy. */
static void test_friction_passes(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.friction_iterations = 2;
    pile(&scene);
    sheet_steps(&scene, 4);
    assert_true(scene.stepper->friction.count > 0);
    assert_int_equal(scene.report.friction_passes, 2);
    scene.options.friction_iterations = 0;
    scene.options.friction_cap = 1;
    sheet_scene_stepper(&scene);
    assert_int_equal(sheet_try_step(&scene), CIPC_E_NOT_CONVERGED);
    assert_string_equal(scene.error.place, "step 4");
    assert_non_null(strstr(scene.error.what, "lagging"));
    assert_non_null(strstr(scene.error.remedy, "friction_iterations"));
    assert_false(scene.report.converged);
    sheet_scene_free(&scene);
}

/* --- threads ------------------------------------------------------------------------------------------------------------------------- */

static void run_with_threads(int threads, int variant, int steps, double *positions)
{
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.threads = threads;
    scene.options.friction_iterations = variant == 1 ? 0 : 1;
    scene.options.released = variant == 2;
    scene.options.newton_norm = variant == 2 ? CIPC_NORM_RMS : CIPC_NORM_MAX;
    if (variant == 3) scene.options.integrator = (cipc_integrator){1, 0.5, 0.5};
    pile(&scene);
    for (int step = 0; step < steps; step++) {
        sheet_step(&scene);
        memcpy(positions + 3 * PILE_NODES * step, scene.state->position, 3 * PILE_NODES * sizeof(double));
    }
    assert_true(scene.report.contacts > 0);
    sheet_scene_free(&scene);
}

/* Whole trajectories with contact, friction, strain limit and led nodes: the same bits for one, two and three threads. */
static void test_threads(void **state)
{
    (void)state;
    enum { STEPS = 6 };
    static double positions[3][STEPS * 3 * PILE_NODES];
    for (int variant = 0; variant < 4; variant++)
        for (int threads = 1; threads <= 3; threads++) {
            run_with_threads(threads, variant, STEPS, positions[threads - 1]);
            if (!sheet_same_bits(positions[0], positions[threads - 1], STEPS * 3 * PILE_NODES))
                fail_msg("variant %d: %d threads differ", variant, threads);
        }
}

/* --- as released --------------------------------------------------------------------------------------------------------------------- */

/* RMS rule, at least three iterations; nothing touches, no limit is broken, E (without sufficient decrease) does not rise. */
static void test_released(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    scene.options.released = true;
    scene.options.newton_norm = CIPC_NORM_RMS;
    pile(&scene);
    sheet_watch(&scene);
    for (int step = 0; step < 10; step++) {
        sheet_step(&scene);
        assert_true(scene.report.newton_iterations >= 3);
    }
    assert_true(scene.stepper->options.contact.merge_directed && scene.stepper->options.ccd.gap_first);
    assert_true(scene.min_gap > 0 && scene.min_gap < 1e-3 && scene.max_stretch_ratio < 1);
    assert_int_equal(scene.energy_rises, 0);
    sheet_scene_free(&scene);
}

/* --- monitors ------------------------------------------------------------------------------------------------------------------------- */

typedef struct seen {
    const sheet_scene *scene;
    int calls, last_iteration, led, stop_at;
} seen;

static cipc_status count_points(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    seen *s = context;
    s->calls++;
    assert_int_equal(point->step, s->scene->state->step);
    if (point->iteration == -1) {
        assert_false(point->energy_valid);
        s->led++;
    } else {
        assert_int_equal(point->iteration, s->last_iteration + 1);
    }
    s->last_iteration = point->iteration;
    return s->calls == s->stop_at ? cipc_fail(error, CIPC_E_VIOLATED_STRAIN, "test", "stop") : CIPC_OK;
}

/* Every accepted point once, in order: the Dirichlet motion first, then the iterations. What the monitor returns ends the step, at that
 * point. */
static void test_monitor(void **state)
{
    (void)state;
    sheet_scene scene;
    seen s = {.scene = &scene, .stop_at = -1};
    sheet_scene_init(&scene);
    pile(&scene);
    cipc_stepper_set_monitor(scene.stepper, count_points, &s);
    int iterations = 0;
    for (int step = 0; step < 4; step++) {
        s.last_iteration = -1;
        sheet_step(&scene);
        iterations += scene.report.newton_iterations;
        assert_int_equal(s.last_iteration, scene.report.newton_iterations - 1);
    }
    assert_int_equal(s.led, 2); /* the window is open for two steps */
    assert_int_equal(s.calls, iterations + s.led);
    s.calls = 0;
    s.last_iteration = -1;
    s.stop_at = 1;
    double before[3 * PILE_NODES];
    memcpy(before, scene.state->position, sizeof before);
    assert_int_equal(sheet_try_step(&scene), CIPC_E_VIOLATED_STRAIN);
    assert_string_equal(scene.error.what, "stop");
    assert_false(scene.report.converged);
    assert_int_equal(scene.state->step, 4);
    assert_int_equal(s.calls, 1);
    assert_false(sheet_same_bits(before, scene.state->position, 3 * PILE_NODES)); /* the point that was objected to */
    sheet_scene_free(&scene);
}

/* --- lack of memory ---------------------------------------------------------------------------------------------------------------------
 */

/* The n-th allocation of making a stepper and taking three steps fails: the status says so, nothing is converged, and the stepper goes on
 * afterwards. */
static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1, failures = 0;
    for (bool failed = true; failed; n += 1 + n / 12) { /* all of the first, then fewer: the later steps repeat the earlier */
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.friction_iterations = 2;
        pile(&scene);
        cipc_stepper_destroy(scene.stepper);
        fail_allocation(n);
        cipc_status status = cipc_stepper_create(&scene.stepper, scene.model, &scene.options, &scene.error);
        for (int step = 0; step < 3 && !status; step++) {
            status = sheet_try_step(&scene);
            assert_int_equal(scene.report.converged, status == CIPC_OK);
        }
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (failed) {
            assert_int_equal(scene.error.status, CIPC_E_OUT_OF_MEMORY);
            failures++;
            if (scene.stepper) sheet_step(&scene);
        }
        sheet_scene_free(&scene);
    }
    assert_true(failures > 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_report),
        cmocka_unit_test(test_stiffness_choice),
        cmocka_unit_test(test_measures),
        cmocka_unit_test(test_midpoint_energy),
        cmocka_unit_test(test_midpoint_strain_limit),
        cmocka_unit_test(test_friction_converges),
        cmocka_unit_test(test_friction_passes),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_released),
        cmocka_unit_test(test_monitor),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
