/* Orthotropic membranes: fabric, factor, numbers, directions. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/orthotropic.h"
#include "support/scene_trial.h"

#define MODEL "\"model\": \"orthotropic\""
#define NUMBERS "\"moduli\": [4, 1, 3, 2], \"limits\": [0.1, 0.2, 0.3]"

static cipc_orthotropic_material accept(const char *text)
{
    cipc_orthotropic_material m, again;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    assert_true(scene_is_orthotropic(&root));
    scene_read_orthotropic(&r, &root, scene_read_fabric(&r, &root), &m);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    assert_null(scene_read_fabric(&r, &root)); /* the tree has numbers now, which mean the same */
    scene_read_orthotropic(&r, &root, NULL, &again);
    assert_int_equal(r.status, CIPC_OK);
    assert_memory_equal(&m, &again, sizeof m);
    scene_reader_free(&r);
    return m;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_orthotropic_material m;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_orthotropic(&r, &root, scene_read_fabric(&r, &root), &m);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_numbers(void **state)
{
    (void)state;
    cipc_orthotropic_material m = accept("{" MODEL ", " NUMBERS "}");
    assert_true(m.moduli[0] == 4 && m.moduli[1] == 1 && m.moduli[2] == 3 && m.moduli[3] == 2);
    assert_true(m.limits[0] == 0.1 && m.limits[1] == 0.2 && m.limits[2] == 0.3);
    assert_true(m.warp[0] == 1 && m.warp[1] == 0 && m.warp[2] == 0);
    assert_true(m.weft[0] == 0 && m.weft[1] == 0 && m.weft[2] == 0); /* across the warp */
}

static void test_a_fabric_times_its_factor(void **state)
{
    (void)state;
    cipc_orthotropic_material m = accept("{" MODEL ", \"fabric\": \"canvas\", \"factor\": 0.01}");
    assert_true(m.moduli[0] == 0.01 * 5.366e6 && m.moduli[1] == 0.01 * 2.683e6 && m.moduli[2] == 0.01 * 19.804e6);
    assert_true(m.moduli[3] == 0.01 * 2.009e6);
    assert_true(m.limits[0] == 0.11 && m.limits[1] == 0.067 && m.limits[2] == 0.059);
    m = accept("{" MODEL ", \"fabric\": \"canvas\", \"limits\": [1, 2, 3]}");
    assert_true(m.moduli[0] == 5.366e6 && m.limits[2] == 3);
}

static void test_directions(void **state)
{
    (void)state;
    cipc_orthotropic_material m = accept("{" MODEL ", " NUMBERS ", \"warp\": [0, 0, 2], \"weft\": [3, 0, 3]}");
    assert_true(m.warp[0] == 0 && m.warp[2] == 1);
    assert_true(m.weft[0] == m.weft[2] && fabs(m.weft[0] - sqrt(0.5)) < 1e-15);
}

static void test_other_models(void **state)
{
    (void)state;
    static const char *const others[] = {"{}", "{\"model\": \"stvk\"}", "{\"model\": 3}", "[]"};
    for (int i = 0; i < 4; i++) {
        scene_reader r = reader_of(others[i]);
        scene_cursor root = scene_root(r.root);
        assert_false(scene_is_orthotropic(&root));
        scene_reader_free(&r);
    }
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{\"fabric\": \"velvet\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 fabric", "unknown fabric 'velvet'");
    refuse("{}", CIPC_E_MISSING_KEY, "t.json:1:1 moduli", "an array of 4 numbers");
    refuse("{\"moduli\": [4, 1, 3, 2]}", CIPC_E_MISSING_KEY, "t.json:1:1 limits", "an array of 3 numbers");
    refuse("{\"moduli\": [4, 1, 3, 0]}", CIPC_E_OUT_OF_RANGE, "t.json:1:22 moduli.3", "greater than 0");
    refuse("{\"moduli\": [4, 4, 4, 1]}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 moduli", "must be less than a11 a22 = 16");
    refuse("{\"moduli\": [4, 1, 3, 2], \"limits\": [0.1, 0, 0.1]}", CIPC_E_OUT_OF_RANGE, "t.json:1:42 limits.1", "greater than 0");
    refuse("{\"factor\": 2, " NUMBERS "}", CIPC_E_MISSING_KEY, "t.json:1:2 factor", "no 'fabric'");
    refuse("{\"factor\": 2, \"fabric\": \"silk\", " NUMBERS "}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 factor", "cannot stand beside membrane.moduli");
    refuse("{\"factor\": 0, \"fabric\": \"silk\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 factor", "greater than 0");
    refuse("{\"warp\": [0, 0, 0], " NUMBERS "}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 warp", "not a direction");
    refuse("{\"warp\": [0, 2, 0], \"weft\": [0, -1, 0], " NUMBERS "}", CIPC_E_OUT_OF_RANGE, "t.json:1:21 weft", "is along the warp");
    refuse("{\"wrap\": [0, 2, 0], " NUMBERS "}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 wrap", "'warp'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),    cmocka_unit_test(test_a_fabric_times_its_factor),
        cmocka_unit_test(test_directions), cmocka_unit_test(test_other_models),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
