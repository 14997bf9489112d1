/* The segments of rods as the scene describes them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "scene/rods.h"
#include "support/mesh_trial.h"
#include "support/scene_trial.h"

static cipc_mesh accept(const char *text)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_rods(&r, &root, 1, &mesh);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return mesh;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_rods(&r, &root, 1, &mesh);
    assert_rejection(&r, status, place, what);
    assert_null(mesh.nodes);
    scene_reader_free(&r);
}

static void test_lines(void **state)
{
    (void)state;
    static const double points[3][3] = {{1, 2, 3}, {4, 5, 7}, {8, 0, 9}};
    cipc_mesh want, got = accept("{\"line\": {\"points\": [[1, 2, 3], [4, 5, 7]], \"segments\": 3}}");
    assert_same_mesh(&got, &want, cipc_mesh_polyline(&want, 2, points, 3, false, NULL));
    got = accept("{\"polyline\": {\"points\": [[1, 2, 3], [4, 5, 7], [8, 0, 9]], \"segments\": 2}}");
    assert_same_mesh(&got, &want, cipc_mesh_polyline(&want, 3, points, 2, false, NULL));
    got = accept("{\"polyline\": {\"points\": [[1, 2, 3], [4, 5, 7], [8, 0, 9]], \"segments\": 2, \"closed\": true}}");
    assert_same_mesh(&got, &want, cipc_mesh_polyline(&want, 3, points, 2, true, NULL));
}

static void test_arcs_grids_and_nets(void **state)
{
    (void)state;
    cipc_mesh want, got = accept("{\"arc\": {\"radius\": 2, \"angle\": 1.5, \"segments\": 6}}");
    assert_same_mesh(&got, &want, cipc_mesh_arc(&want, 2, 1.5, 6, NULL));
    got = accept("{\"grid\": {\"count\": [3, 1, 4], \"spacing\": [0.5, 1, 0.25], \"length\": 0.7, \"segments\": 2}}");
    assert_same_mesh(&got, &want, cipc_mesh_rods(&want, (int[]){3, 1, 4}, (double[]){0.5, 1, 0.25}, 0.7, 2, false, NULL));
    got = accept("{\"grid\": {\"count\": [3, 1, 4], \"spacing\": [0.5, 1, 0.25], \"length\": 0.7, \"segments\": 2, \"round\": true}}");
    assert_same_mesh(&got, &want, cipc_mesh_rods(&want, (int[]){3, 1, 4}, (double[]){0.5, 1, 0.25}, 0.7, 2, true, NULL));
    got = accept("{\"grid\": {\"count\": [3, 1, 4], \"spacing\": [0.5, 1, 0.25], \"length\": 0.7, \"segments\": 2, \"shorten\": 0.2, \"seed\": 5}}");
    cipc_mesh_rods(&want, (int[]){3, 1, 4}, (double[]){0.5, 1, 0.25}, 0.7, 2, false, NULL);
    assert_same_mesh(&got, &want, cipc_mesh_shorten_rods(&want, 0.7, 2, 0.2, 5, NULL));
    got = accept("{\"net\": {\"size\": 1, \"rods\": 3, \"segments\": 8, \"lift\": 0.01}}");
    assert_same_mesh(&got, &want, cipc_mesh_net(&want, 1, 3, 8, 0.01, NULL));
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of line, polyline, arc, grid, net, mesh");
    refuse("{\"lin\": {}}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 lin", "'line'");
    refuse("{\"line\": {\"points\": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], \"segments\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:11 line.points",
           "must have 2");
    refuse("{\"line\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"segments\": 0}}", CIPC_E_OUT_OF_RANGE, "t.json:1:45 line.segments",
           "at least 1");
    refuse("{\"line\": {\"points\": [[0, 0, 0], [1, 0]], \"segments\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:33 line.points.1", "must have 3");
    refuse("{\"line\": {\"segments\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 line.points", "missing");
    refuse("{\"line\": {\"segments\": 1, \"closed\": true}}", CIPC_E_UNKNOWN_KEY, "t.json:1:26 line.closed", "nearest known key");
    refuse("{\"polyline\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"segments\": 1, \"closed\": true}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:15 polyline.points", "at least 3");
    refuse("{\"arc\": {\"radius\": 0, \"angle\": 1, \"segments\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:10 arc.radius", "greater than 0");
    refuse("{\"arc\": {\"radius\": 1, \"segments\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 arc.angle", "missing");
    refuse("{\"grid\": {\"count\": [1, 1], \"spacing\": [1, 1, 1], \"length\": 1, \"segments\": 1}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:11 grid.count", "must have 3");
    refuse("{\"grid\": {\"count\": [1, 1, 1], \"spacing\": [1, 0, 1], \"length\": 1, \"segments\": 1}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:46 grid.spacing.1", "greater than 0");
    refuse("{\"grid\": {\"count\": [1, 1, 1], \"spacing\": [1, 1, 1], \"segments\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 grid.length",
           "missing");
    refuse("{\"grid\": {\"count\": [1, 1, 1], \"spacing\": [1, 1, 1], \"length\": 1, \"segments\": 1, \"shorten\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 grid",
           "rods of 1 m that lose up to 1 m");
    refuse("{\"net\": {\"size\": 1, \"rods\": 0, \"segments\": 8, \"lift\": 0.01}}", CIPC_E_OUT_OF_RANGE, "t.json:1:21 net.rods",
           "at least 1");
    refuse("{\"net\": {\"size\": 1, \"rods\": 2, \"segments\": 8, \"lift\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:47 net.lift", "at least 0");
    refuse("{\"mesh\": \"/nowhere/at/all.obj\"}", CIPC_E_MISSING_FILE, "t.json:1:2 mesh", "'/nowhere/at/all.obj'");
    refuse("[]", CIPC_E_WRONG_TYPE, "t.json:1:1", "an object");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_arcs_grids_and_nets),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
