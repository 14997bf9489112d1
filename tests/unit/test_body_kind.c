/* The kind of a body and the keys it may have. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/body_kind.h"
#include "support/scene_trial.h"

static cipc_body_kind kind_of(const char *text)
{
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    assert_true(scene_is_body(&r, &root));
    cipc_body_kind kind = scene_read_kind(&r, &root);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return kind;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    if (scene_is_body(&r, &root)) scene_read_kind(&r, &root);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_kinds(void **state)
{
    (void)state;
    static const char *const keys[] = {"shell", "rods", "particles", "volume"};
    assert_int_equal(kind_of("{\"shell\": {}, \"material\": \"wool\", \"membrane_factor\": 1, \"bending_factor\": 1, \"density\": 1, "
                             "\"thickness\": 1, \"membrane\": {}, \"bending\": {}, \"strain_limit\": false}"),
                     CIPC_BODY_SHELL);
    assert_int_equal(kind_of("{\"rods\": {}, \"density\": 1, \"diameter\": 1, \"young\": 1, \"bending\": {}, \"bending_factor\": 1, "
                             "\"rest_curvature\": \"rest\"}"),
                     CIPC_BODY_RODS);
    assert_int_equal(kind_of("{\"particles\": {}, \"density\": 1, \"diameter\": 1, \"damping\": {}, \"offset\": 1, \"fixed\": true}"),
                     CIPC_BODY_PARTICLES);
    assert_int_equal(kind_of("{\"volume\": {}, \"density\": 1, \"young\": 1, \"poisson\": 0, \"model\": \"neo-hookean\"}"), CIPC_BODY_VOLUME);
    for (int k = 0; k < 4; k++) assert_string_equal(scene_kind_key((cipc_body_kind)k), keys[k]);
    assert_int_equal(scene_kind_mesh(CIPC_BODY_SHELL), CIPC_MESH_TRIANGLES);
    assert_int_equal(scene_kind_mesh(CIPC_BODY_RODS), CIPC_MESH_SEGMENTS);
    assert_int_equal(scene_kind_mesh(CIPC_BODY_PARTICLES), CIPC_MESH_NODES);
    assert_int_equal(scene_kind_mesh(CIPC_BODY_VOLUME), CIPC_MESH_TETRAHEDRA);
}

static void test_keys_of_other_kinds(void **state)
{
    (void)state;
    refuse("{\"rods\": {}, \"membrane\": {}}", CIPC_E_UNKNOWN_KEY, "t.json:1:14 membrane",
           "'membrane' is a key of shell, but this body is of rods, with the keys density, diameter, young, bending");
    refuse("{\"shell\": {}, \"diameter\": 1}", CIPC_E_UNKNOWN_KEY, "t.json:1:15 diameter", "'diameter' is a key of rods");
    refuse("{\"particles\": {}, \"young\": 1}", CIPC_E_UNKNOWN_KEY, "t.json:1:19 young", "this body is of particles");
    refuse("{\"volume\": {}, \"thickness\": 1}", CIPC_E_UNKNOWN_KEY, "t.json:1:16 thickness", "this body is of volume");
    refuse("{\"shell\": {}, \"thicknes\": 1}", CIPC_E_UNKNOWN_KEY, "t.json:1:15 thicknes", "'thickness'");
    refuse("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of shell, rods, particles, volume");
    refuse("{\"shell\": {}, \"rods\": {}}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "has 2 of");
}

static void test_meshes(void **state)
{
    (void)state;
    cipc_mesh mesh;
    scene_reader r = reader_of("{\"particles\": {\"points\": [[1, 2, 3]]}, \"rods\": {\"line\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"segments\": 2}}}");
    scene_cursor root = scene_root(r.root);
    scene_read_kind_mesh(&r, &root, CIPC_BODY_PARTICLES, 1, &mesh);
    assert_int_equal(mesh.node_count, 1);
    cipc_mesh_free(&mesh);
    scene_read_kind_mesh(&r, &root, CIPC_BODY_RODS, 1, &mesh);
    assert_int_equal(mesh.segment_count, 2);
    cipc_mesh_free(&mesh);
    assert_int_equal(r.status, CIPC_OK);
    scene_read_kind_mesh(&r, &root, CIPC_BODY_SHELL, 1, &mesh);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 shell", "an object");
    scene_read_kind_mesh(&r, &root, CIPC_BODY_VOLUME, 1, &mesh);
    assert_rejection(&r, CIPC_E_MISSING_KEY, "t.json:1:1 volume", "an object");
    scene_reader_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_keys_of_other_kinds),
        cmocka_unit_test(test_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
