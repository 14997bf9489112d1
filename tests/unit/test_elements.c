/* Elements of the model: which triangle and hinge becomes which element, with which constants. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "implicit/stepper.h"
#include "support/failing_memory.h"
#include "support/sheet_scene.h"

enum { PLAIN = 0, STVK, LIMITED, BARE, WALL, BODIES };

/* Five sheets of 2 x 1 cells (4 triangles, 3 hinges): Neo-Hookean; StVK; with a strain limit and the released hinge constant; without
 * membrane and bending but with a limit; fixed. */
static void make_scene(sheet_scene *scene)
{
    static const char *const names[BODIES] = {"plain", "stvk", "limited", "bare", "wall"};
    const double u[3] = {1, 0, 0}, v[3] = {0, 0, 0.7};
    sheet_scene_init(scene);
    for (int b = 0; b < BODIES; b++) {
        const double corner[3] = {0, b, 0};
        cipc_body_description *body = sheet_add_grid(scene, names[b], corner, u, v, 2, 1);
        cipc_material *m = &body->material;
        m->thickness = 1e-3 * (b + 1);
        m->membrane_young = 1e5 + b;
        if (b == STVK) m->membrane = CIPC_MEMBRANE_STVK;
        if (b == BARE) m->membrane = CIPC_MEMBRANE_NONE, m->bending_young = 0;
        if (b == LIMITED) m->hinge_constant = CIPC_HINGE_CIPC;
        if (b == LIMITED || b == BARE || b == WALL) m->strain_limit = 1.05, m->strain_activation = 1.01, m->strain_stiffness = 100 * b;
        body->fixed = b == WALL;
    }
}

static void rest_of(const cipc_model *m, const int *nodes, int count, double *rest)
{
    for (int i = 0; i < 3 * count; i++) rest[i] = m->rest[3 * nodes[i / 3] + i % 3];
}

static const cipc_material *material_of(const cipc_model *m, int body)
{
    return &m->bodies[body].material;
}

static void test_membranes(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    sheet_scene_build(&scene);
    const cipc_model *m = scene.model;
    static const int groups[3] = {CIPC_GROUP_NEO_HOOKEAN, CIPC_GROUP_STVK, CIPC_GROUP_NEO_HOOKEAN}, first[3] = {0, 0, 4};
    assert_int_equal(scene.stepper->groups[CIPC_GROUP_NEO_HOOKEAN].count, 8); /* plain and limited */
    assert_int_equal(scene.stepper->groups[CIPC_GROUP_STVK].count, 4);
    assert_ptr_equal(scene.stepper->groups[CIPC_GROUP_STVK].energy, cipc_energy_entry(CIPC_ENERGY_MEMBRANE_STVK));
    assert_ptr_equal(scene.stepper->groups[CIPC_GROUP_NEO_HOOKEAN].energy, cipc_energy_entry(CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN));
    for (int b = PLAIN; b <= LIMITED; b++)
        for (int k = 0; k < 4; k++) {
            const cipc_element_group *g = &scene.stepper->groups[groups[b]];
            const int *nodes = m->triangles[m->bodies[b].first_triangle + k];
            double rest[9];
            cipc_membrane want;
            memset(&want, 0, sizeof want);
            rest_of(m, nodes, 3, rest);
            assert_true(cipc_membrane_init(&want, rest, material_of(m, b)->thickness, material_of(m, b)->membrane_young,
                                           material_of(m, b)->membrane_poisson));
            assert_memory_equal((const cipc_membrane *)g->params + first[b] + k, &want, sizeof want);
            assert_memory_equal(g->nodes + 3 * (first[b] + k), nodes, 3 * sizeof(int));
        }
    sheet_scene_free(&scene);
}

static void test_strain_limits(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    sheet_scene_build(&scene);
    const cipc_model *m = scene.model;
    const cipc_element_group *g = &scene.stepper->groups[CIPC_GROUP_STRAIN_LIMIT];
    assert_int_equal(g->count, 8); /* limited and bare; not the wall */
    assert_true(scene.stepper->max_strain_stiffness == 100 * BARE);
    for (int k = 0; k < 8; k++) {
        int b = k < 4 ? LIMITED : BARE, t = m->bodies[b].first_triangle + k % 4;
        double rest[9];
        cipc_strain_limit want;
        memset(&want, 0, sizeof want);
        rest_of(m, m->triangles[t], 3, rest);
        assert_true(cipc_strain_limit_init(&want, rest, material_of(m, b)->thickness, 1.05, 1.01, 100 * b));
        assert_memory_equal((const cipc_strain_limit *)g->params + k, &want, sizeof want);
        assert_memory_equal(g->nodes + 3 * k, m->triangles[t], 3 * sizeof(int));
        assert_int_equal(g->triangles[k], t);
        assert_false(scene.stepper->near_limit[k]);
    }
    sheet_scene_free(&scene);
}

static void test_hinges(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    sheet_scene_build(&scene);
    const cipc_model *m = scene.model;
    const cipc_element_group *g = &scene.stepper->groups[CIPC_GROUP_HINGE];
    int seen = 0;
    for (int h = 0; h < m->hinge_count; h++) {
        int b = m->node_body[m->hinges[h][0]];
        if (b > LIMITED) continue; /* bare has no bending, the wall does not move */
        double rest[12];
        cipc_hinge_bending want;
        memset(&want, 0, sizeof want);
        rest_of(m, m->hinges[h], 4, rest);
        cipc_hinge_bending_init(&want, rest, material_of(m, b)->thickness, 1e5, 0.3, b == LIMITED);
        assert_memory_equal((const cipc_hinge_bending *)g->params + seen, &want, sizeof want);
        assert_memory_equal(g->nodes + 4 * seen, m->hinges[h], 4 * sizeof(int));
        seen++;
    }
    assert_int_equal(seen, 9);
    assert_int_equal(g->count, seen);
    sheet_scene_free(&scene);
}

/* The model's maker refuses flat triangles; should one come all the same, it is named. */
static void test_flat_triangle(void **state)
{
    (void)state;
    for (int b = PLAIN; b <= BARE; b++) {
        sheet_scene scene;
        make_scene(&scene);
        sheet_scene_model(&scene);
        const int *nodes = scene.model->triangles[scene.model->bodies[b].first_triangle];
        memcpy(scene.model->rest + 3 * nodes[0], scene.model->rest + 3 * nodes[1], 3 * sizeof(double));
        assert_int_equal(cipc_stepper_create(&scene.stepper, scene.model, &scene.options, &scene.error), CIPC_E_BAD_MESH);
        assert_string_equal(scene.error.place, scene.model->bodies[b].name);
        assert_null(scene.stepper);
        sheet_scene_free(&scene);
    }
}

/* Every allocation of a stepper's making may fail. */
static void test_out_of_memory(void **state)
{
    (void)state;
    sheet_scene scene;
    make_scene(&scene);
    sheet_scene_model(&scene);
    long n = 1;
    for (bool failed = true; failed; n++) {
        fail_allocation(n);
        cipc_status status = cipc_stepper_create(&scene.stepper, scene.model, &scene.options, &scene.error);
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_true(failed == (scene.stepper == NULL));
    }
    assert_true(n > 20);
    sheet_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_membranes),     cmocka_unit_test(test_strain_limits), cmocka_unit_test(test_hinges),
        cmocka_unit_test(test_flat_triangle), cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
