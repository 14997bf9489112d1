/* Options: their defaults, what is refused and where, the rule for the stiffness; models that the method does not know; names of events and phases. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_scene.h"

static void test_defaults(void **state)
{
    (void)state;
    const cipc_asynchronous_options o = cipc_asynchronous_options_default();
    assert_true(o.frame == 0.04 && o.thickness == 1e-3 && o.stiffness == 0 && o.layer_factor == 0.025 && o.element_factor == 0.5);
    assert_true(o.gravity_step == 0 && o.script_step == 0 && o.restitution == 0 && o.mirror == 0);
    assert_int_equal(o.clocks, CIPC_CLOCKS_NESTED);
    assert_int_equal(o.event_limit, 200000000);
    assert_int_equal(o.always_layers, 0);
}

static void one_particle(asynchronous_scene *s)
{
    const double x[3] = {0, 1, 0}, v[3] = {0};
    asynchronous_scene_init(s);
    asynchronous_add_particles(s, "stone", 1, x, v, 2);
    asynchronous_scene_model(s);
}

static void assert_refused(const asynchronous_scene *s, const cipc_asynchronous_options *options, const char *name)
{
    cipc_asynchronous *integrator = s->integrator; /* not NULL */
    cipc_error error;
    assert_int_equal(cipc_asynchronous_create(&integrator, s->sheet.model, options, &error), CIPC_E_OUT_OF_RANGE);
    assert_null(integrator);
    assert_non_null(strstr(error.what, name));
    assert_int_equal(cipc_asynchronous_create(&integrator, s->sheet.model, options, NULL), CIPC_E_OUT_OF_RANGE);
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct { const char *name; size_t place; double good[2], bad[3]; } numbers[] = {
#define PLACE(member) #member, offsetof(cipc_asynchronous_options, member)
        {PLACE(frame), {1e-6, 9}, {0, -1, INFINITY}},
        {PLACE(thickness), {1e-9, 1}, {0, -1, INFINITY}},
        {PLACE(stiffness), {0, 1e9}, {-1, -1e-9, INFINITY}},
        {PLACE(layer_factor), {1e-3, 1}, {0, -0.1, 1.001}},
        {PLACE(element_factor), {1e-3, 1}, {0, -0.1, 1.001}},
        {PLACE(gravity_step), {0, 1}, {-1, -1e-9, INFINITY}},
        {PLACE(script_step), {0, 1}, {-1, -1e-9, INFINITY}},
        {PLACE(restitution), {0, 1}, {-0.1, 1.001, INFINITY}},
        {PLACE(mirror), {0, 10}, {-1, -1e-9, INFINITY}},
#undef PLACE
    };
    asynchronous_scene s;
    one_particle(&s);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        for (int k = 0; k < 2; k++) {
            s.options = cipc_asynchronous_options_default();
            memcpy((char *)&s.options + numbers[i].place, &numbers[i].good[k], sizeof(double));
            asynchronous_scene_start(&s);
        }
        for (int k = 0; k < 4; k++) {
            const double bad = k < 3 ? numbers[i].bad[k] : NAN;
            cipc_asynchronous_options options = cipc_asynchronous_options_default();
            memcpy((char *)&options + numbers[i].place, &bad, sizeof(double));
            assert_refused(&s, &options, numbers[i].name);
        }
    }
    cipc_asynchronous_options options = cipc_asynchronous_options_default();
    options.event_limit = 0;
    assert_refused(&s, &options, "event_limit");
    options = cipc_asynchronous_options_default();
    options.always_layers = -1;
    assert_refused(&s, &options, "always_layers");
    options.always_layers = ASYNCHRONOUS_MOST_LAYERS;
    assert_refused(&s, &options, "always_layers");
    asynchronous_scene_free(&s);
}

/* What the method does not know is refused by the body's name; of a fixed body nothing is asked. */
static void test_models_that_are_refused(void **state)
{
    (void)state;
    for (int what = 0; what < 4; what++)
        for (int fixed = 0; fixed < 2; fixed++) {
            asynchronous_scene s;
            asynchronous_scene_init(&s);
            asynchronous_add_floor(&s, 0, 1);
            s.sheet.bodies[0].fixed = fixed;
            asynchronous_scene_model(&s);
            cipc_material *m = &s.sheet.model->bodies[0].material;
            if (what == 0) m->strain_limit = 1.1;
            if (what == 1) m->strain_lower_limit = 0.9;
            if (what == 2) m->membrane = CIPC_MEMBRANE_ORTHOTROPIC;
            if (what == 3) m->damping_mass = 0.1;
            const cipc_status status = cipc_asynchronous_create(&s.integrator, s.sheet.model, &s.options, &s.error);
            assert_int_equal(status, fixed ? CIPC_OK : CIPC_E_WRONG_TYPE);
            if (!fixed) assert_string_equal(s.error.place, "floor");
            if (!fixed) assert_null(s.integrator);
            asynchronous_scene_free(&s);
        }
}

/* r(1) so that the mean free node is at rest a twentieth of eta(1) deep; where there is no gravity, as on earth; as given, if it is given. */
static void test_stiffness_by_rule(void **state)
{
    (void)state;
    static const double gravity[] = {-9.81, -1.62, 0}, weight[] = {9.81, 1.62, 9.81};
    for (int i = 0; i < 3; i++) {
        asynchronous_scene s;
        const double x[6] = {0, 1, 0, 1, 1, 0}, v[3] = {0};
        asynchronous_scene_init(&s);
        s.sheet.gravity[1] = gravity[i];
        s.options.thickness = 0.02;
        asynchronous_add_floor(&s, 0, 1);
        asynchronous_add_particles(&s, "two", 2, x, v, 3);
        asynchronous_scene_model(&s);
        s.sheet.model->mass[4] = 1; /* and the other 3: 2 in the mean; the floor does not count */
        asynchronous_scene_start(&s);
        assert_true(fabs(s.integrator->options.stiffness / (2 * weight[i] / (0.05 * 0.02)) - 1) < 1e-6);
        s.options.stiffness = 17;
        asynchronous_scene_start(&s);
        assert_true(s.integrator->options.stiffness == 17);
        asynchronous_scene_free(&s);
    }
}

static void test_names(void **state)
{
    (void)state;
    static const char *const events[] = {"script", "gravity", "stretching", "bending", "volume", "penalty", "idle_penalty", "slab", "cell"};
    static const char *const phases[] = {"integration", "penalty", "slab_processing", "slab_rescheduling", "kdop_processing", "kdop_rescheduling", "monitor", "other"};
    assert_int_equal(CIPC_EVENT_COUNT, sizeof events / sizeof *events);
    assert_int_equal(CIPC_ASYNCHRONOUS_PHASE_COUNT, sizeof phases / sizeof *phases);
    for (int i = 0; i < CIPC_EVENT_COUNT; i++) assert_string_equal(cipc_event_name((cipc_event_kind)i), events[i]);
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) assert_string_equal(cipc_asynchronous_phase_name((cipc_asynchronous_phase)i), phases[i]);
    assert_string_equal(cipc_event_name(CIPC_EVENT_COUNT), "unknown");
    assert_string_equal(cipc_asynchronous_phase_name(CIPC_ASYNCHRONOUS_PHASE_COUNT), "unknown");
}

/* Clocks that tick so often that nobody would wait for a frame, and that would overflow their count in a run taken up later. */
static void test_endless_frames_are_refused(void **state)
{
    (void)state;
    asynchronous_scene s;
    one_particle(&s);
    cipc_asynchronous_options o = s.options;
    o.gravity_step = 1e-25;
    assert_refused(&s, &o, "gravity_step");
    o = s.options;
    o.script_step = 1e-300;
    assert_refused(&s, &o, "script_step");
    asynchronous_scene_free(&s);
    asynchronous_scene_init(&s);
    const double a[3] = {0, 1, 0}, b[3] = {1, 1, 0}, c[3] = {0, 1, 1};
    cipc_body_description *sheet = sheet_add_triangle(&s.sheet, "sheet", a, b, c);
    sheet->material.membrane = CIPC_MEMBRANE_STVK;
    sheet->material.membrane_young = 1e40;
    asynchronous_scene_model(&s);
    assert_refused(&s, &s.options, "membrane_stvk needs steps of");
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults), cmocka_unit_test(test_refusals), cmocka_unit_test(test_models_that_are_refused), cmocka_unit_test(test_stiffness_by_rule), cmocka_unit_test(test_names), cmocka_unit_test(test_endless_frames_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
