/* The tetrahedra of volumes as the scene describes them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/volume.h"
#include "support/mesh_trial.h"
#include "support/scene_trial.h"

static cipc_mesh accept(const char *text)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_volume(&r, &root, &mesh);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return mesh;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_volume(&r, &root, &mesh);
    assert_rejection(&r, status, place, what);
    assert_null(mesh.nodes);
    scene_reader_free(&r);
}

static void test_generators(void **state)
{
    (void)state;
    cipc_mesh want, got = accept("{\"box\": {\"size\": [1, 2, 3], \"cells\": [2, 1, 3]}}");
    assert_same_mesh(&got, &want, cipc_mesh_box(&want, (double[]){1, 2, 3}, (int[]){2, 1, 3}, NULL));
    got = accept("{\"ball\": {\"radius\": 0.5, \"cells\": 4}}");
    assert_same_mesh(&got, &want, cipc_mesh_ball(&want, 0.5, 4, NULL));
    got = accept("{\"cylinder\": {\"radius\": 0.5, \"length\": 2, \"cells_across\": 4, \"cells_along\": 3}}");
    assert_same_mesh(&got, &want, cipc_mesh_solid_cylinder(&want, 0.5, 2, 4, 3, NULL));
    got = accept("{\"revolution\": {\"section\": [[[0, 0], [1, 0]], [[0, 2], [1, 1]]], \"sectors\": 5}}");
    assert_same_mesh(&got, &want, cipc_mesh_solid_revolution(&want, 2, 2, (const double[][2]){{0, 0}, {1, 0}, {0, 2}, {1, 1}}, 5, NULL));
    got = accept("{\"revolution\": {\"section\": [[[0, 0], [1, 0]], [[0, 2], [1, 1]]], \"divide\": [2, 1], \"sectors\": 5}}");
    assert_same_mesh(&got, &want, cipc_mesh_solid_revolution(&want, 3, 2, (const double[][2]){{0, 0}, {1, 0}, {0, 1}, {1, 0.5}, {0, 2}, {1, 1}}, 5, NULL));
    static const cipc_capsule parts[2] = {{{0, 0, 0}, {1, 0.5, 0}, {0.5, 0.25}}, {{0, 0, 0.25}, {0, 0, 0.25}, {0.5, 0.5}}};
    got = accept("{\"capsules\": {\"cell\": 0.25, \"blend\": 0.125, \"parts\": [{\"begin\": [0, 0, 0], \"end\": [1, 0.5, 0], \"radius\": 0.5, \"end_radius\": 0.25},"
                 " {\"begin\": [0, 0, 0.25], \"radius\": 0.5}]}}");
    assert_same_mesh(&got, &want, cipc_mesh_capsules(&want, 2, parts, 0.125, 0.25, NULL));
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of box, ball, cylinder, revolution, capsules, mesh");
    refuse("{\"boxx\": {}}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 boxx", "'box'");
    refuse("{\"box\": {\"size\": [1, 2], \"cells\": [1, 1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:10 box.size", "must have 3");
    refuse("{\"box\": {\"size\": [1, 2, 0], \"cells\": [1, 1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:25 box.size.2", "greater than 0");
    refuse("{\"box\": {\"size\": [1, 2, 3], \"cells\": [1, 1, 0]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:45 box.cells.2", "at least 1");
    refuse("{\"ball\": {\"radius\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 ball.cells", "missing");
    refuse("{\"ball\": {\"radius\": -1, \"cells\": 2}}", CIPC_E_OUT_OF_RANGE, "t.json:1:11 ball.radius", "greater than 0");
    refuse("{\"cylinder\": {\"radius\": 1, \"length\": 0, \"cells_across\": 2, \"cells_along\": 1}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:28 cylinder.length", "greater than 0");
    refuse("{\"cylinder\": {\"radius\": 1, \"length\": 1, \"cells_along\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 cylinder.cells_across",
           "missing");
    refuse("{\"revolution\": {\"sectors\": 3}}", CIPC_E_MISSING_KEY, "t.json:1:2 revolution.section", "missing");
    refuse("{\"revolution\": {\"sectors\": 2, \"section\": []}}", CIPC_E_OUT_OF_RANGE, "t.json:1:17 revolution.sectors", "at least 3");
    refuse("{\"revolution\": {\"sectors\": 3, \"section\": [[[0, 0], [1, 0]]]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:31 revolution.section", "at least 2");
    refuse("{\"revolution\": {\"sectors\": 3, \"section\": [[[0, 0], [1, 0]], [[0, 1], [1, 1], [2, 1]]]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:61 revolution.section.1",
           "has 3 points, but the first row has 2");
    refuse("{\"revolution\": {\"sectors\": 3, \"section\": [[[0, 0], [1, 0]], [[0, 1], [1, -1]]]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 revolution", "not convex");
    refuse("{\"capsules\": {\"cell\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 capsules.parts", "missing");
    refuse("{\"capsules\": {\"cell\": 1, \"parts\": []}}", CIPC_E_OUT_OF_RANGE, "t.json:1:26 capsules.parts", "at least 1");
    refuse("{\"capsules\": {\"cell\": 1, \"parts\": [{\"begin\": [0, 0, 0]}]}}", CIPC_E_MISSING_KEY, "t.json:1:36 capsules.parts.0.radius", "missing");
    refuse("{\"capsules\": {\"cell\": 1, \"parts\": [{\"radius\": 1}]}}", CIPC_E_MISSING_KEY, "t.json:1:36 capsules.parts.0.begin", "missing");
    refuse("{\"capsules\": {\"cell\": 9, \"parts\": [{\"begin\": [0, 0, 0], \"radius\": 1}]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 capsules", "too large");
    refuse("{\"mesh\": \"/nowhere/at/all.msh\"}", CIPC_E_MISSING_FILE, "t.json:1:2 mesh", "'/nowhere/at/all.msh'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generators),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
