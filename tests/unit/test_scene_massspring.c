/* The block "mass_spring", read and checked whatever the method. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>

#include "support/scene_trial.h"

static void test_defaults(void **state)
{
    (void)state;
    const cipc_massspring_options want = cipc_massspring_options_default();
    static const char text[] = "{\"method\": \"mass-spring\", \"time_step\": 0.01, \"steps\": 1, \"bodies\": [{\"name\": \"cloth\", \"material\": \"wool\", \"membrane\": "
                               "{\"model\": \"springs\"}, \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}}]}";
    cipc_scene *s = accept_scene(text, NULL);
    const cipc_massspring_options *o = &s->massspring;
    assert_int_equal(s->method, CIPC_METHOD_MASS_SPRING);
    assert_true(o->frame == 0.01 && o->step == 0 && !o->refuse && s->collider_count == 0 && s->monitor_reach == want.threshold);
    assert_true(o->structural == want.structural && o->bending_form == want.bending_form && o->bending_stiffness == 0 && o->buckling == 0);
    assert_true(o->deformation == want.deformation && o->reading == want.reading && o->sweeps == want.sweeps && o->wind_pressure == 0 && o->wind[0] == 0);
    assert_true(o->bisection == want.bisection && o->threshold == want.threshold && o->repulsion == 0 && o->self_distance == 0 && o->self_friction == 0);
    assert_true(o->law == want.law && o->presliding == want.presliding && o->breakaway == want.breakaway && o->damping_ratio == want.damping_ratio && o->band == want.band);
    cipc_scene_destroy(s);
}

#define EVERYTHING                                                                                                                                          \
    "\"mass_spring\": {\"step\": 1e-4, \"too_long\": \"refuse\", \"structural\": \"tension\", \"bending\": {\"form\": \"buckling\", \"stiffness\": 2, \"buckling\": 3},"  \
    "\"deformation\": {\"bound\": 0.2, \"reading\": \"rest-length\", \"sweeps\": 7}, \"wind\": {\"velocity\": [1, 2, 3], \"pressure\": 4}, \"bisection\": \"plain\","      \
    "\"threshold\": 2e-3, \"repulsion\": 5, \"friction\": {\"law\": \"clamped\", \"presliding\": 2e-4, \"breakaway\": 1.5, \"damping_ratio\": 0.25, \"band\": 2e-3},"      \
    "\"self\": {\"distance\": 0.125, \"friction\": 0.75}},"

static void assert_everything(const cipc_scene *s)
{
    const cipc_massspring_options *o = &s->massspring;
    assert_true(o->frame == 0.01 && o->step == 1e-4 && o->refuse && o->structural == CIPC_SPRING_TENSION && o->bending_form == CIPC_SPRING_BUCKLING);
    assert_true(o->bending_stiffness == 2 && o->buckling == 3 && o->deformation == 0.2 && o->reading == CIPC_DEFORMATION_REST_LENGTH && o->sweeps == 7);
    assert_true(o->wind[0] == 1 && o->wind[1] == 2 && o->wind[2] == 3 && o->wind_pressure == 4 && o->bisection == CIPC_BISECTION_PLAIN);
    assert_true(o->threshold == 2e-3 && o->repulsion == 5 && o->law == CIPC_LAW_CLAMPED && o->presliding == 2e-4 && o->breakaway == 1.5);
    assert_true(o->damping_ratio == 0.25 && o->band == 2e-3 && o->self_distance == 0.125 && o->self_friction == 0.75);
}

/* One file serves all methods; what is resolved is the same scene. */
static void test_everything_can_be_set(void **state)
{
    (void)state;
    char *text = scene_around(EVERYTHING "\"contact\": {\"dhat\": 3e-3},", "");
    cipc_scene *other = accept_scene(text, NULL), *again = accept_scene(other->resolved, NULL);
    assert_everything(other);
    assert_everything(again);
    assert_true(other->monitor_reach == 3e-3);
    assert_string_equal(other->resolved, again->resolved);
    cipc_scene_destroy(other);
    cipc_scene_destroy(again);
    free(text);
}

static void test_every_law(void **state)
{
    (void)state;
    char *text = scene_around("", ""), override[96];
    for (int l = 0; l < CIPC_LAW_COUNT; l++) {
        snprintf(override, sizeof override, "mass_spring.friction.law=%s", cipc_friction_law_name((cipc_friction_law)l));
        cipc_scene *s = accept_scene(text, override);
        assert_int_equal(s->massspring.law, l);
        cipc_scene_destroy(s);
    }
    free(text);
}

#define BLOCK(text) "\"mass_spring\": {" text "},"

static void test_refused(void **state)
{
    (void)state;
    const struct { const char *root, *path, *what; cipc_status status; } cases[] = {
        {"@\"mass_spring\": [],", "mass_spring", "an object", CIPC_E_WRONG_TYPE},
        {BLOCK("@\"steps\": 1"), "mass_spring.steps", "'step'", CIPC_E_UNKNOWN_KEY},
        {BLOCK("@\"step\": -1"), "mass_spring.step", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("@\"too_long\": \"refused\""), "mass_spring.too_long", "'refuse'", CIPC_E_OUT_OF_RANGE},
        {BLOCK("@\"structural\": \"buckling\""), "mass_spring.structural", "unknown form of springs", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"bending\": {@\"form\": \"tension\"}"), "mass_spring.bending.form", "unknown form of springs", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"bending\": {@\"stiffness\": -1}"), "mass_spring.bending.stiffness", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"bending\": {@\"buckling\": -1}"), "mass_spring.bending.buckling", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"deformation\": {@\"bound\": 1}"), "mass_spring.deformation.bound", "less than 1", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"deformation\": {@\"bound\": -0.1}"), "mass_spring.deformation.bound", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"deformation\": {@\"reading\": \"projekt\"}"), "mass_spring.deformation.reading", "'project'", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"deformation\": {@\"sweeps\": 0}"), "mass_spring.deformation.sweeps", "at least 1", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"wind\": {@\"velocity\": 1}"), "mass_spring.wind.velocity", "an array of 3 numbers", CIPC_E_WRONG_TYPE},
        {BLOCK("\"wind\": {@\"pressure\": -1}"), "mass_spring.wind.pressure", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("@\"bisection\": \"plane\""), "mass_spring.bisection", "'plain'", CIPC_E_OUT_OF_RANGE},
        {BLOCK("@\"threshold\": 0"), "mass_spring.threshold", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("@\"repulsion\": -1"), "mass_spring.repulsion", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"friction\": {@\"law\": \"dal\"}"), "mass_spring.friction.law", "'dahl'", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"friction\": {@\"presliding\": 0}"), "mass_spring.friction.presliding", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"friction\": {@\"breakaway\": 0.9}"), "mass_spring.friction.breakaway", "at least 1", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"friction\": {@\"damping_ratio\": -1}"), "mass_spring.friction.damping_ratio", "at least 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"friction\": {@\"band\": 0}"), "mass_spring.friction.band", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"self\": {@\"distance\": 0.01}"), "mass_spring.self.distance", "kept apart from itself by repulsion", CIPC_E_OUT_OF_RANGE},
        {BLOCK("\"self\": {@\"friction\": -1}"), "mass_spring.self.friction", "at least 0", CIPC_E_OUT_OF_RANGE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) reject_around(cases[i].root, "", cases[i].status, cases[i].path, cases[i].what);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_everything_can_be_set),
        cmocka_unit_test(test_every_law),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
