/* Volumes: density, moduli and which energy. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/volume_material.h"
#include "support/scene_trial.h"

static cipc_material accept(const char *text, scene_material_defaults defaults)
{
    cipc_material m = {0};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_volume_material(&r, &root, &defaults, &m);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    scene_reader_free(&r);
    return m;
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    cipc_material m = {0};
    const scene_material_defaults plain = {.density = 1000};
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_volume_material(&r, &root, &plain, &m);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

#define NUMBERS "\"density\": 1000, \"young\": 1e4, \"poisson\": 0.4"

static void test_numbers(void **state)
{
    (void)state;
    cipc_material m = accept("{" NUMBERS "}", (scene_material_defaults){0});
    assert_true(m.density == 1000 && m.young == 1e4 && m.poisson == 0.4);
    assert_int_equal(m.volume, CIPC_VOLUME_COROTATIONAL);
    assert_int_equal(accept("{" NUMBERS ", \"model\": \"neo-hookean\"}", (scene_material_defaults){0}).volume, CIPC_VOLUME_NEO_HOOKEAN);
}

static void test_released_volumes(void **state)
{
    (void)state;
    const scene_material_defaults released = {.released = true};
    assert_int_equal(accept("{" NUMBERS "}", released).volume, CIPC_VOLUME_NEO_HOOKEAN);
    assert_int_equal(accept("{" NUMBERS ", \"model\": \"fixed-corotational\"}", released).volume, CIPC_VOLUME_COROTATIONAL);
}

static void test_obstacles_need_nothing(void **state)
{
    (void)state;
    cipc_material m = accept("{}", (scene_material_defaults){.optional = true, .density = 8, .thickness = 9});
    assert_true(m.density == 8 && m.young == 0 && m.poisson == 0);
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{\"young\": 1e4, \"poisson\": 0.4}", CIPC_E_MISSING_KEY, "t.json:1:1 density", "missing");
    refuse("{\"density\": 1, \"poisson\": 0.4}", CIPC_E_MISSING_KEY, "t.json:1:1 young", "missing");
    refuse("{\"density\": 1, \"young\": 1}", CIPC_E_MISSING_KEY, "t.json:1:1 poisson", "missing");
    refuse("{\"density\": 1, \"young\": 0}", CIPC_E_OUT_OF_RANGE, "t.json:1:16 young", "greater than 0");
    refuse("{\"density\": 1, \"young\": 1, \"poisson\": 0.5}", CIPC_E_OUT_OF_RANGE, "t.json:1:28 poisson", "less than 0.5");
    refuse("{" NUMBERS ", \"model\": \"corotational\"}", CIPC_E_OUT_OF_RANGE, "t.json:1:49 model", "'fixed-corotational'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_released_volumes),
        cmocka_unit_test(test_obstacles_need_nothing),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
