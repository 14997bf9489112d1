/* The mesh of a body as the scene describes it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/shell.h"
#include "support/mesh_trial.h"
#include "support/scene_trial.h"

static void assert_shell(const char *text, int nodes, int triangles)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_shell(&r, &root, 1, &mesh);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    assert_int_equal(mesh.node_count, nodes);
    assert_int_equal(mesh.triangle_count, triangles);
    cipc_mesh_free(&mesh);
    scene_reader_free(&r);
}

static void assert_refused(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_shell(&r, &root, 1, &mesh);
    assert_rejection(&r, status, place, what);
    assert_null(mesh.nodes);
    scene_reader_free(&r);
}

static void test_generators(void **state)
{
    (void)state;
    assert_shell("{\"grid\": {\"size\": [1, 2.5], \"cells\": [2, 3]}}", 12, 12);
    assert_shell("{\"grid\": {\"size\": [1, 2], \"cells\": [2, 2], \"alternate\": true}}", 9, 8);
    assert_shell("{\"equilateral\": {\"edge\": 0.1, \"cells\": [4, 3]}}", 20, 24);
    assert_shell("{\"irregular\": {\"size\": [1, 1], \"nodes\": 5}}", 5, 4);
    assert_shell("{\"icosphere\": {\"radius\": 1, \"subdivisions\": 1}}", 42, 80);
}

static cipc_mesh read_mesh(const char *text)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_shell(&r, &root, 1, &mesh);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return mesh;
}

static void test_round_shells(void **state)
{
    (void)state;
    static const double profile[3][2] = {{0.2, 0}, {0.3, 0.5}, {0.1, 1}};
    cipc_mesh want, got = read_mesh("{\"revolution\": {\"profile\": [[0.2, 0], [0.3, 0.5], [0.1, 1]], \"sectors\": 12}}");
    assert_same_mesh(&got, &want, cipc_mesh_revolution(&want, 3, profile, 12, NULL));
    got = read_mesh("{\"cylinder\": {\"radius\": 0.25, \"length\": 1, \"around\": 8, \"along\": 5}}");
    assert_same_mesh(&got, &want, cipc_mesh_cylinder(&want, 0.25, 1, 8, 5, NULL));
    got = read_mesh("{\"nails\": {\"count\": [3, 2], \"spacing\": [0.1, 0.2], \"width\": 0.01, \"height\": 0.06}}");
    assert_same_mesh(&got, &want, cipc_mesh_nails(&want, &(cipc_nails){{3, 2}, {0.1, 0.2}, 0.01, 0.06}, NULL));
    got = read_mesh("{\"capsule\": {\"radii\": [0.1, 0.2], \"length\": 0.5, \"around\": 8, \"along\": 5}}");
    assert_same_mesh(&got, &want, cipc_mesh_capsule(&want, (const double[2]){0.1, 0.2}, 0.5, 8, 5, NULL));
}

/* Panels default to one; pattern and size of the panels come along. */
static void test_garments(void **state)
{
    (void)state;
    const cipc_panel_ring skirt = {.panels = 3, .down = 5, .top = 0.1, .bottom = 0.3, .height = 0.5},
                          tube = {.panels = 1, .down = 2, .top = 0.2, .bottom = 0.25, .height = 0.4};
    const cipc_pleating pleating = {.count = 8, .forward = 9, .back = 4, .depth = 0.1, .gap = 0.01};
    cipc_mesh want, got = read_mesh("{\"gores\": {\"panels\": 3, \"top\": 0.1, \"bottom\": 0.3, \"height\": 0.5, \"cells\": [4, 5]}}");
    assert_true(got.pattern != NULL && got.panel_count == 3 && got.panel_columns == 5 && got.panel_rows == 6);
    assert_same_mesh(&got, &want, cipc_mesh_gores(&want, &skirt, 4, NULL));
    got = read_mesh("{\"pleats\": {\"top\": 0.2, \"bottom\": 0.25, \"height\": 0.4, \"count\": 8, \"depth\": 0.1, \"gap\": 0.01, "
                    "\"cells\": [9, 4, 2]}}");
    assert_true(got.pattern != NULL && got.panel_count == 1 && got.panel_columns == 8 * 15 + 1 && got.panel_rows == 3);
    assert_same_mesh(&got, &want, cipc_mesh_pleats(&want, &tube, &pleating, NULL));
}

static void test_rejections_of_garments(void **state)
{
    (void)state;
    assert_refused("{\"nails\": {\"count\": [2, 1], \"spacing\": [0.1, 0.1], \"width\": 0.1, \"height\": 1}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:2 nails", "would meet");
    assert_refused("{\"capsule\": {\"radii\": [1], \"length\": 1, \"around\": 8, \"along\": 5}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:14 capsule.radii", "must have 2");
    assert_refused("{\"capsule\": {\"radii\": [1, 1], \"length\": 1, \"around\": 8, \"along\": 1}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:57 capsule.along", "at least 2");
    assert_refused("{\"capsule\": {\"radii\": [3, 1], \"length\": 1, \"around\": 8, \"along\": 5}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:2 capsule", "one holds the other");
    assert_refused("{\"capsule\": {\"radius\": 1}}", CIPC_E_UNKNOWN_KEY, "t.json:1:14 capsule.radius", "'radii'");
    assert_refused("{\"gores\": {\"top\": 1, \"bottom\": 1, \"height\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 gores.cells", "2 integers");
    assert_refused("{\"gores\": {\"panels\": 0, \"top\": 1, \"bottom\": 1, \"height\": 1, \"cells\": [4, 1]}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:12 gores.panels", "at least 1");
    assert_refused("{\"gores\": {\"top\": 1, \"bottom\": 1, \"height\": 1, \"cells\": [2, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 gores",
                   "3 are needed");
    assert_refused("{\"gores\": {\"top\": 1, \"height\": 1, \"cells\": [4, 1]}}", CIPC_E_MISSING_KEY, "t.json:1:2 gores.bottom", "missing");
    assert_refused("{\"gores\": {\"depth\": 1}}", CIPC_E_UNKNOWN_KEY, "t.json:1:12 gores.depth", "nearest");
    assert_refused("{\"pleats\": {\"top\": 1, \"bottom\": 1, \"height\": 1, \"count\": 2}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:49 pleats.count", "at least 3");
    assert_refused(
        "{\"pleats\": {\"top\": 1, \"bottom\": 1, \"height\": 1, \"count\": 8, \"depth\": 0.1, \"gap\": 0, \"cells\": [9, 4, 2]}}",
        CIPC_E_OUT_OF_RANGE, "t.json:1:75 pleats.gap", "greater than 0");
    assert_refused(
        "{\"pleats\": {\"top\": 1, \"bottom\": 1, \"height\": 1, \"count\": 8, \"depth\": 0.1, \"gap\": 0.01, \"cells\": [9, 4]}}",
        CIPC_E_OUT_OF_RANGE, "t.json:1:88 pleats.cells", "must have 3");
    assert_refused(
        "{\"pleats\": {\"top\": 1, \"bottom\": 1, \"height\": 1, \"count\": 8, \"depth\": 0.1, \"gap\": 0.01, \"cells\": [1, 1, 2]}}",
        CIPC_E_OUT_OF_RANGE, "t.json:1:2 pleats", "more cells forward and back");
}

/* Faces up unless told otherwise. */
static void test_ribbons(void **state)
{
    (void)state;
    static const double points[3][3] = {{0, 0, 0}, {0.5, 0.25, 0}, {1, 0, 0}}, normals[3][3] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    cipc_ribbon ribbon = {.count = 3, .points = points, .normal = {0, 1, 0}, .width = 0.25, .along = 6, .across = 2};
    cipc_mesh want, got = read_mesh("{\"ribbon\": {\"points\": [[0, 0, 0], [0.5, 0.25, 0], [1, 0, 0]], \"width\": 0.25, \"along\": 6, \"across\": 2}}");
    assert_same_mesh(&got, &want, cipc_mesh_ribbon(&want, &ribbon, NULL));
    ribbon.normal[1] = 0;
    ribbon.normal[2] = 2;
    got = read_mesh("{\"ribbon\": {\"points\": [[0, 0, 0], [0.5, 0.25, 0], [1, 0, 0]], \"width\": 0.25, \"along\": 6, \"across\": 2, \"normal\": [0, 0, 2]}}");
    assert_same_mesh(&got, &want, cipc_mesh_ribbon(&want, &ribbon, NULL));
    ribbon.normals = normals;
    got = read_mesh("{\"ribbon\": {\"points\": [[0, 0, 0], [0.5, 0.25, 0], [1, 0, 0]], \"width\": 0.25, \"along\": 6, \"across\": 2,"
                    " \"normals\": [[0, 1, 0], [0, 0, 1], [0, -1, 0]]}}");
    assert_same_mesh(&got, &want, cipc_mesh_ribbon(&want, &ribbon, NULL));
}

/* Without a seed of its own a sheet takes the scene's, and the tree says so. */
static void test_the_seed_of_the_scene(void **state)
{
    (void)state;
    cipc_mesh a, b;
    scene_reader r = reader_of("{\"irregular\": {\"size\": [1, 1], \"nodes\": 50}}");
    scene_cursor root = scene_root(r.root);
    scene_read_shell(&r, &root, 9, &a);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(r.root, "irregular"), "seed")), 9);
    assert_int_equal(cipc_mesh_irregular(&b, 1, 1, 50, 9, NULL), CIPC_OK);
    assert_memory_equal(a.nodes, b.nodes, 150 * sizeof *a.nodes);
    cipc_mesh_free(&a);
    cipc_mesh_free(&b);
    scene_reader_free(&r);
}

static void test_rejections(void **state)
{
    (void)state;
    assert_refused("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of");
    assert_refused("{\"mesh\": \"a\", \"grid\": {}}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "has 2 of");
    assert_refused("{\"gird\": {}}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 gird", "'grid'");
    assert_refused("{\"grid\": {}}", CIPC_E_MISSING_KEY, "t.json:1:2 grid.size", "2 numbers");
    assert_refused("{\"grid\": {\"size\": [1, 1]}}", CIPC_E_MISSING_KEY, "t.json:1:2 grid.cells", "2 integers");
    assert_refused("{\"grid\": {\"size\": [1, 0], \"cells\": [1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:23 grid.size.1", "greater than 0");
    assert_refused("{\"grid\": {\"size\": [1, 1], \"cells\": [0, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:37 grid.cells.0", "at least 1");
    assert_refused("{\"grid\": {\"size\": [1, 1], \"cells\": [1.5, 1]}}", CIPC_E_WRONG_TYPE, "t.json:1:37 grid.cells.0", "an integer");
    assert_refused("{\"grid\": {\"size\": [1], \"cells\": [1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:11 grid.size", "must have 2");
    assert_refused("{\"grid\": {\"size\": [1, 1], \"cells\": [9000, 9000]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 grid", "at most 10000000");
    assert_refused("{\"equilateral\": {\"edge\": 0, \"cells\": [1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:18 equilateral.edge", "greater than 0");
    assert_refused("{\"equilateral\": {\"edge\": 1, \"cells\": [1, 0]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:42 equilateral.cells.1", "at least 1");
    assert_refused("{\"irregular\": {\"size\": [1, 1], \"nodes\": 3}}", CIPC_E_OUT_OF_RANGE, "t.json:1:32 irregular.nodes", "at least 4");
    assert_refused("{\"irregular\": {\"size\": [1, 1], \"nodes\": 9, \"seed\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:44 irregular.seed",
                   "at least 0");
    assert_refused("{\"icosphere\": {\"radius\": 1, \"subdivisions\": 9}}", CIPC_E_OUT_OF_RANGE, "t.json:1:29 icosphere.subdivisions",
                   "at most 8");
    assert_refused("{\"icosphere\": {\"radius\": -1, \"subdivisions\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:16 icosphere.radius",
                   "greater than 0");
    assert_refused("{\"icosphere\": {\"radius\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 icosphere.subdivisions", "missing");
    assert_refused("{\"revolution\": {\"profile\": [[1, 0]], \"sectors\": 3}}", CIPC_E_OUT_OF_RANGE, "t.json:1:17 revolution.profile",
                   "at least 2");
    assert_refused("{\"revolution\": {\"profile\": [[1, 0], [1, 1, 0]], \"sectors\": 3}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:37 revolution.profile.1", "must have 2");
    assert_refused("{\"revolution\": {\"profile\": [[1, 0], [1, 1]], \"sectors\": 2}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:46 revolution.sectors", "at least 3");
    assert_refused("{\"cylinder\": {\"radius\": 1, \"length\": 1, \"around\": 2, \"along\": 1}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:41 cylinder.around", "at least 3");
    assert_refused("{\"cylinder\": {\"radius\": 1, \"around\": 3, \"along\": 1}}", CIPC_E_MISSING_KEY, "t.json:1:2 cylinder.length",
                   "missing");
    assert_refused("{\"ribbon\": {\"points\": [[0, 0, 0]], \"width\": 1, \"along\": 1, \"across\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:13 ribbon.points", "at least 2");
    assert_refused("{\"ribbon\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"width\": 0, \"along\": 1, \"across\": 1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:47 ribbon.width", "greater than 0");
    assert_refused("{\"ribbon\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"width\": 1, \"along\": 1, \"across\": 1, \"normal\": [1, 0, 0]}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:2 ribbon", "no direction");
    assert_refused("{\"ribbon\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"width\": 1, \"along\": 1, \"across\": 1, \"normals\": [[0, 1, 0]]}}", CIPC_E_OUT_OF_RANGE,
                   "t.json:1:84 ribbon.normals", "must have 2");
    assert_refused("{\"ribbon\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"width\": 1, \"along\": 1, \"across\": 1, \"normal\": [0, 1, 0], \"normals\": [[0, 1, 0], [0, 1, 0]]}}",
                   CIPC_E_OUT_OF_RANGE, "t.json:1:84 ribbon.normal", "beside");
    assert_refused("{\"mesh\": 1}", CIPC_E_WRONG_TYPE, "t.json:1:2 mesh", "a string");
    assert_refused("{\"mesh\": \"/nowhere/at/all.obj\"}", CIPC_E_MISSING_FILE, "t.json:1:2 mesh", "'/nowhere/at/all.obj' cannot be opened");
    assert_refused("[]", CIPC_E_WRONG_TYPE, "t.json:1:1", "an object");
}

/* A path is relative to the scene file; the tree gets the absolute one; errors of the mesh keep their own file and line. */
static void test_files(void **state)
{
    (void)state;
    static const char good[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", bad[] = "v 0 0 0\nf 1 1 1\n";
    char *folder = make_folder(), *good_path = write_file(folder, "good.obj", good, strlen(good)),
         *bad_path = write_file(folder, "bad.obj", bad, strlen(bad));
    char scene_path[600], absolute[4096], place[4200];
    snprintf(scene_path, sizeof scene_path, "%s/t.json", folder);
    cipc_mesh mesh;
    scene_reader r = reader_of("{\"mesh\": \"good.obj\"}");
    r.path = scene_path;
    scene_cursor root = scene_root(r.root);
    scene_read_shell(&r, &root, 1, &mesh);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(mesh.node_count, 3);
    assert_non_null(realpath(good_path, absolute));
    assert_string_equal(json_string_value(json_object_get(r.root, "mesh")), absolute);
    cipc_mesh_free(&mesh);
    scene_reader_free(&r);

    r = reader_of("{\"mesh\": \"bad.obj\"}");
    r.path = scene_path;
    root = scene_root(r.root);
    scene_read_shell(&r, &root, 1, &mesh);
    snprintf(place, sizeof place, "%s:2", bad_path);
    assert_rejection(&r, CIPC_E_BAD_MESH, place, "names a vertex twice");
    scene_reader_free(&r);
    free(good_path);
    free(bad_path);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generators),
        cmocka_unit_test(test_round_shells),
        cmocka_unit_test(test_garments),
        cmocka_unit_test(test_rejections_of_garments),
        cmocka_unit_test(test_ribbons),
        cmocka_unit_test(test_the_seed_of_the_scene),
        cmocka_unit_test(test_rejections),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
