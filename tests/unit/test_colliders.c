/* "colliders": every shape, their names, and what may not start inside of them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/scene_trial.h"

#define SCENE(colliders)                                                                                                                                   \
    "{\"method\": \"mass-spring\", \"time_step\": 0.01, \"steps\": 1, \"colliders\": [" colliders "], \"bodies\": [{\"name\": \"post\", \"fixed\": true, \"shell\": "    \
    "{\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"material\": \"wool\"}, {\"name\": \"cloth\", \"shell\": {\"equilateral\": {\"edge\": 0.1, \"cells\": [2, 2"      \
    "]}}, \"material\": \"wool\", \"membrane\": {\"model\": \"springs\"}, \"transform\": {\"translate\": [0, 1, 0]}}]}"

static void test_every_shape(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE("{\"name\": \"floor\", \"friction\": 0.3, \"plane\": {\"point\": [0, -1, 0], \"normal\": [0, 1e200, 0]}},"
                                       "{\"name\": \"ball\", \"sphere\": {\"center\": [1, 2, 9], \"radius\": 0.5}},"
                                       "{\"name\": \"table\", \"box\": {\"center\": [9, 2, 3], \"half\": [0.1, 0.2, 0.3]}},"
                                       "{\"name\": \"round\", \"disc\": {\"center\": [9, 2, 4], \"axis\": [3, 4, 0], \"radius\": 0.5, \"half_height\": 0.25}},"
                                       "{\"name\": \"arm\", \"capsule\": {\"begin\": [9, 0, 0], \"end\": [9, 1, 0], \"radii\": [0.1, 0.2]}}"),
                                 NULL);
    const cipc_collider *c = s->colliders;
    assert_int_equal(s->collider_count, 5);
    assert_true(c[0].kind == CIPC_COLLIDER_PLANE && c[0].friction == 0.3 && c[0].center[1] == -1 && c[0].axis[1] == 1 && c[0].axis[0] == 0);
    assert_true(c[1].kind == CIPC_COLLIDER_SPHERE && c[1].friction == 0 && c[1].center[2] == 9 && c[1].half[0] == 0.5);
    assert_true(c[2].kind == CIPC_COLLIDER_BOX && c[2].center[0] == 9 && c[2].half[0] == 0.1 && c[2].half[2] == 0.3);
    assert_true(c[3].kind == CIPC_COLLIDER_DISC && fabs(c[3].axis[0] - 0.6) < 1e-15 && fabs(c[3].axis[1] - 0.8) < 1e-15 && c[3].half[0] == 0.5 && c[3].half[1] == 0.25);
    assert_true(c[4].kind == CIPC_COLLIDER_CAPSULE && c[4].center[0] == 9 && c[4].axis[1] == 1 && c[4].half[0] == 0.1 && c[4].half[1] == 0.2);
    cipc_scene *again = accept_scene(s->resolved, "colliders.ball.sphere.radius=0.25"); /* found by its name */
    assert_true(again->colliders[1].half[0] == 0.25);
    cipc_scene_destroy(again);
    cipc_scene_destroy(s);
}

#define BALL(name) "{\"name\": \"" name "\", \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"
#define NAMED(shape) "{\"name\": \"c\", " shape "}"

static void test_refused(void **state)
{
    (void)state;
    const struct { const char *text, *path, *what; cipc_status status; } cases[] = {
        {SCENE("{@\"name\": \"a.b\", \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"), "colliders.a.b.name", "is not a name", CIPC_E_OUT_OF_RANGE},
        {SCENE("{@\"name\": \"12\", \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"), "colliders.12.name", "is not a name", CIPC_E_OUT_OF_RANGE},
        {SCENE("{@\"name\": \"\", \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"), "colliders..name", "is not a name", CIPC_E_OUT_OF_RANGE},
        {SCENE(BALL("b") ", {@\"name\": \"b\", \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"), "colliders.b.name", "collider 0 already", CIPC_E_OUT_OF_RANGE},
        {SCENE("@{\"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}}"), "colliders.0.name", "missing", CIPC_E_MISSING_KEY},
        {SCENE("@{\"name\": \"c\"}"), "colliders.c", "one of plane, sphere, box, disc, capsule", CIPC_E_MISSING_KEY},
        {SCENE("@" NAMED("\"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}, \"box\": {}")), "colliders.c", "must have one", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("@\"friction\": -1, \"sphere\": {\"center\": [9, 9, 9], \"radius\": 1}")), "colliders.c.friction", "at least 0", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("@\"sfere\": {}")), "colliders.c.sfere", "'sphere'", CIPC_E_UNKNOWN_KEY},
        {SCENE(NAMED("\"sphere\": {\"center\": [9, 9, 9], @\"radius\": 0}")), "colliders.c.sphere.radius", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("@\"sphere\": {\"radius\": 1}")), "colliders.c.sphere.center", "missing", CIPC_E_MISSING_KEY},
        {SCENE(NAMED("\"plane\": {\"point\": [0, 0, 0], @\"normal\": [0, 0, 0]}")), "colliders.c.plane.normal", "no direction", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("\"box\": {\"center\": [9, 9, 9], \"half\": [1, @0, 1]}")), "colliders.c.box.half.1", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("\"disc\": {\"center\": [9, 9, 9], \"axis\": [0, 1, 0], \"radius\": 1, @\"half_height\": 0}")), "colliders.c.disc.half_height", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {SCENE(NAMED("\"capsule\": {\"begin\": [9, 9, 9], \"end\": [9, 9, 8], \"radii\": [1, @-1]}")), "colliders.c.capsule.radii.1", "greater than 0", CIPC_E_OUT_OF_RANGE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) reject_scene(cases[i].text, NULL, cases[i].status, cases[i].path, cases[i].what);
}

/* The cloth is at height 1; a fixed body, here at height 0, may stand inside: it may be the picture of the collider. */
static void test_nodes_inside(void **state)
{
    (void)state;
    reject_scene(SCENE(BALL("first") ", @{\"name\": \"ball\", \"sphere\": {\"center\": [0, 0, 0], \"radius\": 1.05}}"), NULL, CIPC_E_OUT_OF_RANGE, "colliders.ball",
                 "of 'cloth' starts inside of 'ball', 0.0");
    reject_scene(SCENE("@{\"name\": \"floor\", \"plane\": {\"point\": [0, 1.25, 0], \"normal\": [0, 1, 0]}}"), NULL, CIPC_E_OUT_OF_RANGE, "colliders.floor",
                 "node 0 of 'cloth' starts inside of 'floor', 0.25 m deep");
    cipc_scene *s = accept_scene(SCENE("{\"name\": \"ball\", \"sphere\": {\"center\": [0, 0, 0], \"radius\": 0.99}}"), NULL);
    cipc_scene_destroy(s);
    s = accept_scene(SCENE("{\"name\": \"floor\", \"plane\": {\"point\": [0, 1, 0], \"normal\": [0, 1, 0]}}"), NULL); /* on it is not in it */
    cipc_scene_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_shape),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_nodes_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
