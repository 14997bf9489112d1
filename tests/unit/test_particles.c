/* The nodes of particles as the scene describes them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/particles.h"
#include "support/mesh_trial.h"
#include "support/scene_trial.h"

static cipc_mesh accept(const char *text)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_particles(&r, &root, 9, &mesh);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return mesh;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_mesh mesh;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_particles(&r, &root, 9, &mesh);
    assert_rejection(&r, status, place, what);
    assert_null(mesh.nodes);
    scene_reader_free(&r);
}

/* Without a seed of its own a lattice takes the scene's. */
static void test_lattices(void **state)
{
    (void)state;
    cipc_mesh want, got = accept("{\"lattice\": {\"count\": [2, 3, 4], \"spacing\": [1, 0.5, 2], \"jitter\": 0.1}}");
    assert_same_mesh(&got, &want, cipc_mesh_lattice(&want, (int[]){2, 3, 4}, (double[]){1, 0.5, 2}, 0.1, 9, NULL));
    got = accept("{\"lattice\": {\"count\": [2, 3, 4], \"spacing\": [1, 0.5, 2], \"jitter\": 0.1, \"seed\": 5}}");
    assert_same_mesh(&got, &want, cipc_mesh_lattice(&want, (int[]){2, 3, 4}, (double[]){1, 0.5, 2}, 0.1, 5, NULL));
    got = accept("{\"lattice\": {\"count\": [2, 1, 1], \"spacing\": [1, 0.5, 2]}}");
    assert_same_mesh(&got, &want, cipc_mesh_lattice(&want, (int[]){2, 1, 1}, (double[]){1, 0.5, 2}, 0, 9, NULL));
}

static void test_points(void **state)
{
    (void)state;
    cipc_mesh got = accept("{\"points\": [[1, 2, 3], [4, 5, 6]]}");
    assert_int_equal(got.node_count, 2);
    assert_true(got.nodes[0] == 1 && got.nodes[2] == 3 && got.nodes[5] == 6);
    assert_int_equal(got.triangle_count + got.segment_count + got.tetrahedron_count, 0);
    cipc_mesh_free(&got);
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of lattice, points, mesh");
    refuse("{\"points\": []}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 points", "at least 1");
    refuse("{\"points\": [[1, 2]]}", CIPC_E_OUT_OF_RANGE, "t.json:1:13 points.0", "must have 3");
    refuse("{\"point\": []}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 point", "'points'");
    refuse("{\"lattice\": {\"count\": [0, 1, 1], \"spacing\": [1, 1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:24 lattice.count.0", "at least 1");
    refuse("{\"lattice\": {\"count\": [1, 1, 1]}}", CIPC_E_MISSING_KEY, "t.json:1:2 lattice.spacing", "3 numbers");
    refuse("{\"lattice\": {\"count\": [1, 1, 1], \"spacing\": [1, 1, 1], \"jitter\": -1}}", CIPC_E_OUT_OF_RANGE,
           "t.json:1:56 lattice.jitter", "at least 0");
    refuse("{\"lattice\": {\"count\": [1, 1, 1], \"spacing\": [1, 1, 1], \"seed\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:56 lattice.seed",
           "at least 0");
    refuse("{\"mesh\": \"/nowhere/at/all.obj\"}", CIPC_E_MISSING_FILE, "t.json:1:2 mesh", "'/nowhere/at/all.obj'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lattices),
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
