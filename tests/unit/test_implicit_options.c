/* Default options of the implicit integrator, the names of its phases, and the options that a stepper refuses. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "support/sheet_scene.h"

static void make_scene(sheet_scene *scene)
{
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0};
    sheet_scene_init(scene);
    sheet_add_triangle(scene, "sheet", a, b, c);
    sheet_scene_model(scene);
}

/* Implicit Euler, the paper's stopping norm, one friction pass, the contact room's own defaults: and a stepper takes them as they are. */
static void test_defaults(void **state)
{
    (void)state;
    cipc_implicit_options o = cipc_implicit_options_default();
    cipc_contact_options contact = cipc_contact_options_default();
    assert_true(o.integrator.alpha == 1 && o.integrator.beta == 1 && o.integrator.gamma == 0);
    assert_int_equal(o.newton_norm, CIPC_NORM_MAX);
    assert_int_equal(o.friction_iterations, 1);
    assert_true(o.contact.dhat == contact.dhat && o.contact.area_weights == contact.area_weights);
    assert_true(o.ccd.slackness == cipc_ccd_options_default().slackness);
    assert_true(o.barrier_stiffness == 0);
    assert_false(o.released);
    assert_int_equal(o.threads, 1);
    sheet_scene scene;
    make_scene(&scene);
    sheet_scene_stepper(&scene);
    sheet_scene_free(&scene);
}

static void test_phase_names(void **state)
{
    (void)state;
    for (int p = 0; p < CIPC_PHASE_COUNT; p++)
        for (int q = 0; q < p; q++) assert_string_not_equal(cipc_phase_name((cipc_phase)p), cipc_phase_name((cipc_phase)q));
    assert_string_equal(cipc_phase_name(CIPC_PHASE_BROAD_PHASE), "broad_phase");
    assert_string_equal(cipc_phase_name(CIPC_PHASE_OTHER), "other");
    assert_string_equal(cipc_phase_name(CIPC_PHASE_COUNT), "unknown");
    assert_string_equal(cipc_phase_name((cipc_phase)-1), "unknown");
}

/* Each wrong number is refused by name; NULL errors are allowed. */
static void test_refused(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    cipc_implicit_options good = cipc_implicit_options_default(), o;
    cipc_stepper *stepper;
#define REFUSE(field, value, name)                                                                                                         \
    do {                                                                                                                                   \
        cipc_error error = {.status = CIPC_OK};                                                                                            \
        o = good;                                                                                                                          \
        o.field = (value);                                                                                                                 \
        assert_int_equal(cipc_stepper_create(&stepper, scene.model, &o, &error), CIPC_E_OUT_OF_RANGE);                                     \
        assert_null(stepper);                                                                                                              \
        assert_non_null(strstr(error.what, name));                                                                                         \
        assert_int_equal(cipc_stepper_create(&stepper, scene.model, &o, NULL), CIPC_E_OUT_OF_RANGE);                                       \
    } while (0)
    REFUSE(time_step, 0, "time_step");
    REFUSE(time_step, -1, "time_step");
    REFUSE(time_step, NAN, "time_step");
    REFUSE(time_step, INFINITY, "time_step");
    REFUSE(integrator.alpha, 0, "integrator.alpha");
    REFUSE(integrator.beta, 0, "integrator.beta");
    REFUSE(integrator.beta, 1.5, "integrator.beta");
    REFUSE(integrator.gamma, 1, "integrator.gamma");
    REFUSE(integrator.gamma, -0.5, "integrator.gamma");
    REFUSE(newton_tolerance, 0, "newton.tolerance");
    REFUSE(newton_iterations, 0, "newton.iterations");
    REFUSE(line_search_halvings, 0, "line_search_halvings");
    REFUSE(friction_iterations, -1, "friction_iterations");
    REFUSE(friction_velocity, 0, "friction_velocity");
    REFUSE(contact.dhat, 0, "dhat");
    REFUSE(contact.dhat, NAN, "dhat");
    REFUSE(ccd.slackness, 0, "slackness");
    REFUSE(ccd.slackness, 1, "slackness");
    REFUSE(barrier_stiffness, -1, "barrier_stiffness");
    REFUSE(barrier_stiffness, INFINITY, "barrier_stiffness");
    REFUSE(threads, 0, "threads");
#undef REFUSE
    sheet_scene_free(&scene);
}

/* What the method does not know is not left out silently. */
static void test_models_of_other_methods(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    const cipc_implicit_options options = cipc_implicit_options_default();
    cipc_stepper *stepper;
    cipc_error error;
    scene.model->bodies[0].material.membrane = CIPC_MEMBRANE_SPRINGS;
    assert_int_equal(cipc_stepper_create(&stepper, scene.model, &options, &error), CIPC_E_WRONG_TYPE);
    assert_non_null(strstr(error.what, "springs"));
    scene.model->bodies[0].material.membrane = CIPC_MEMBRANE_NONE;
    int node = 0;
    const cipc_load load = {.node_count = 1, .nodes = &node, .force = {1, 0, 0}, .end = 1};
    assert_int_equal(cipc_model_add_load(scene.model, &load, NULL), CIPC_OK);
    assert_int_equal(cipc_stepper_create(&stepper, scene.model, &options, &error), CIPC_E_WRONG_TYPE);
    assert_non_null(strstr(error.what, "loads"));
    assert_null(stepper);
    sheet_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_phase_names),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_models_of_other_methods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
