/* Scale, rotation, translation and rest shape of a body. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "scene/transform.h"
#include "support/scene_trial.h"

/* A rotation: sine, cosine and some ten operations on numbers up to 10, each within 2^-53. */
static const double tolerance = 1e-14;

static scene_transform read_body(const char *text)
{
    scene_transform t;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_transform(&r, &root, &t);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return t;
}

static void assert_point(const scene_transform *t, double x, double y, double z, const double want[3], const double want_rest[3])
{
    double node[3] = {x, y, z}, rest[3], position[3];
    scene_place_nodes(t, node, 1, position);
    scene_rest_nodes(t, node, 1, rest);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(position[k] - want[k]) < tolerance);
        assert_true(rest[k] == want_rest[k]);
    }
}

static void test_nothing_said_changes_nothing(void **state)
{
    (void)state;
    scene_transform t = read_body("{}");
    double nodes[6] = {0.1, -0.2, 1e-300, 3, 4, 5}, rest[6], position[6];
    scene_place_nodes(&t, nodes, 2, position);
    scene_rest_nodes(&t, nodes, 2, rest);
    assert_memory_equal(rest, nodes, sizeof nodes);
    assert_memory_equal(position, nodes, sizeof nodes);
}

static void test_scale_then_rotate_then_translate(void **state)
{
    (void)state;
    scene_transform t = read_body("{\"transform\": {\"scale\": [2, 3, 4], \"rotate\": {\"axis\": [0, 0, 2], \"angle\": "
                                  "1.5707963267948966}, \"translate\": [10, 0, 0]}}");
    assert_point(&t, 1, 1, 1, (double[]){10 - 3, 2, 4}, (double[]){2, 3, 4});
}

static void test_rotations_in_order(void **state)
{
    (void)state;
    scene_transform t =
        read_body("{\"transform\": {\"rotate\": [{\"axis\": [1, 0, 0], \"angle\": 1.5707963267948966}, {\"angle\": 1.5707963267948966}]}}");
    assert_point(&t, 0, 1, 0, (double[]){1, 0, 0}, (double[]){0, 1, 0}); /* y -> z about x, then z -> x about y */
}

static void test_scale_may_be_one_number(void **state)
{
    (void)state;
    scene_transform t = read_body("{\"transform\": {\"scale\": 0.5}}");
    assert_point(&t, 2, 4, 6, (double[]){1, 2, 3}, (double[]){1, 2, 3});
}

static void test_rest_shape_of_its_own(void **state)
{
    (void)state;
    scene_transform t = read_body("{\"transform\": {\"scale\": 1.1}, \"rest\": {\"scale\": [1, 1, 2]}}");
    assert_point(&t, 1, 1, 1, (double[]){1.1, 1.1, 1.1}, (double[]){1, 1, 2});
    t = read_body("{\"transform\": {\"scale\": 1.1}, \"rest\": \"initial\"}");
    assert_point(&t, 1, 1, 1, (double[]){1.1, 1.1, 1.1}, (double[]){1.1, 1.1, 1.1});
}

static void test_rejections(void **state)
{
    (void)state;
    reject_around("", "\"transform\": {@\"scale\": 0},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.transform.scale",
                  "is 0, but must be greater than 0");
    reject_around("", "\"transform\": {\"scale\": [1, @-1, 1]},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.transform.scale.1",
                  "must be greater than 0");
    reject_around("", "\"transform\": {@\"scale\": \"x\"},", CIPC_E_WRONG_TYPE, "bodies.cloth.transform.scale",
                  "must be an array of 3 numbers");
    reject_around("", "\"transform\": {@\"scael\": 1},", CIPC_E_UNKNOWN_KEY, "bodies.cloth.transform.scael", "'scale'");
    reject_around("", "\"transform\": {\"rotate\": {@\"axis\": [0, 0, 0], \"angle\": 1}},", CIPC_E_OUT_OF_RANGE,
                  "bodies.cloth.transform.rotate.axis", "not a direction");
    reject_around("", "\"transform\": {@\"rotate\": {\"axis\": [0, 0, 1]}},", CIPC_E_MISSING_KEY, "bodies.cloth.transform.rotate.angle",
                  "missing");
    reject_around("", "\"transform\": {\"rotate\": [{@\"angel\": 1}]},", CIPC_E_UNKNOWN_KEY, "bodies.cloth.transform.rotate.0.angel",
                  "'angle'");
    reject_around("", "\"transform\": {@\"rotate\": 1},", CIPC_E_WRONG_TYPE, "bodies.cloth.transform.rotate", "must be an array");
    reject_around("", "\"transform\": {@\"translate\": [0, 1]},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.transform.translate",
                  "has 2 elements");
    reject_around("", "@\"transform\": 3,", CIPC_E_WRONG_TYPE, "bodies.cloth.transform", "must be an object");
    reject_around("", "@\"rest\": \"mesh\",", CIPC_E_OUT_OF_RANGE, "bodies.cloth.rest", "unknown rest shape 'mesh'");
    reject_around("", "\"rest\": {@\"scale\": -1},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.rest.scale", "greater than 0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_said_changes_nothing), cmocka_unit_test(test_scale_then_rotate_then_translate),
        cmocka_unit_test(test_rotations_in_order),           cmocka_unit_test(test_scale_may_be_one_number),
        cmocka_unit_test(test_rest_shape_of_its_own),        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
