/* Models from bodies: numbering, lumped masses and areas, pair coefficients, and each kind of bad input with its status. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/model.h"
#include "support/failing_memory.h"

/* Some ten operations a number. */
static const double ROUNDINGS = 16 * DBL_EPSILON;

static const double gravity[3] = {0, -9.81, 0};

/* A rectangle of 4 x 3, cut along a diagonal, and a single right triangle with legs 1 and 2 in another plane. */
static const double rectangle[] = {0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 3, 0};
static const int rectangle_triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const double corner[] = {9, 0, 0, 9, 1, 0, 9, 0, 2};
static const int corner_triangle[1][3] = {{0, 1, 2}};

static cipc_body_description describe(const char *name, const double *nodes, int node_count, const int (*triangles)[3], int triangle_count)
{
    cipc_body_description d = {
        .material = {.density = 500,
                     .thickness = 0.002,
                     .membrane = CIPC_MEMBRANE_NEO_HOOKEAN,
                     .membrane_young = 1e5,
                     .membrane_poisson = 0.3,
                     .bending_young = 1e5,
                     .bending_poisson = 0.3,
                     .strain_limit = 1.1,
                     .strain_activation = 1,
                     .strain_stiffness = 1e3},
        .offset = 0.01,
        .friction = 0.4,
        .node_count = node_count,
        .rest = nodes,
        .position = nodes,
        .triangle_count = triangle_count,
        .triangles = triangles,
    };
    (void)snprintf(d.name, sizeof d.name, "%s", name);
    return d;
}

static void describe_two(cipc_body_description d[2])
{
    d[0] = describe("cloth", rectangle, 4, rectangle_triangles, 2);
    d[1] = describe("corner", corner, 3, corner_triangle, 1);
    d[1].offset = 0.03;
    d[1].friction = 0.2;
    d[1].material.density = 1000;
    d[1].fixed = true;
}

static cipc_model *create_two(void)
{
    cipc_body_description d[2];
    describe_two(d);
    cipc_model *m;
    assert_int_equal(cipc_model_create(&m, d, 2, gravity, NULL), CIPC_OK);
    return m;
}

static void assert_close(double got, double want)
{
    if (!(fabs(got - want) <= ROUNDINGS * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_numbering(void **state)
{
    (void)state;
    cipc_model *m = create_two();
    assert_int_equal(m->body_count, 2);
    assert_int_equal(m->node_count, 7);
    assert_int_equal(m->triangle_count, 3);
    assert_string_equal(m->bodies[1].name, "corner");
    assert_int_equal(m->bodies[0].first_node, 0);
    assert_int_equal(m->bodies[1].first_node, 4);
    assert_int_equal(m->bodies[1].node_count, 3);
    assert_int_equal(m->bodies[1].first_triangle, 2);
    assert_int_equal(m->bodies[1].triangle_count, 1);
    assert_true(m->bodies[1].fixed && !m->bodies[0].fixed);
    assert_true(m->bodies[1].material.density == 1000);
    const int want[3][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
    assert_memory_equal(m->triangles, want, sizeof want);
    for (int i = 0; i < 7; i++) assert_int_equal(m->node_body[i], i >= 4);
    for (int t = 0; t < 3; t++) assert_int_equal(m->triangle_body[t], t == 2);
    assert_memory_equal(m->rest, rectangle, sizeof rectangle);
    assert_memory_equal(m->rest + 12, corner, sizeof corner);
    assert_memory_equal(m->gravity, gravity, sizeof gravity);
    cipc_model_destroy(m);
}

/* A third of A t rho to each node of a triangle (SPEC C.1), a third of A as its area. */
static void test_masses_and_areas(void **state)
{
    (void)state;
    cipc_model *m = create_two();
    const double area[7] = {4, 2, 4, 2, 1.0 / 3, 1.0 / 3, 1.0 / 3};
    double mass = 0;
    for (int i = 0; i < 7; i++) {
        assert_close(m->node_area[i], area[i]);
        assert_close(m->mass[i], area[i] * 0.002 * (i < 4 ? 500 : 1000));
        mass += m->mass[i];
    }
    assert_close(mass, 12 * 0.002 * 500 + 1 * 0.002 * 1000);
    cipc_model_destroy(m);
}

static void test_pairs_of_bodies(void **state)
{
    (void)state;
    cipc_model *m = create_two();
    const double want[4] = {0.4, 0.2, 0.2, 0.2}; /* the smaller of the two */
    for (int i = 0; i < 4; i++) assert_true(m->pair_friction[i] == want[i]);
    cipc_model_set_friction(m, 1, 0, 0.7);
    assert_true(m->pair_friction[1] == 0.7 && m->pair_friction[2] == 0.7 && m->pair_friction[0] == 0.4);
    assert_close(cipc_model_pair_offset(m, 0, 3), 0.01);
    assert_close(cipc_model_pair_offset(m, 0, 6), 0.02);
    assert_true(cipc_model_pair_offset(m, 6, 0) == cipc_model_pair_offset(m, 0, 6));
    assert_int_equal(cipc_model_find_body(m, "corner"), 1);
    assert_int_equal(cipc_model_find_body(m, "corne"), -1);
    cipc_model_destroy(m);
}

static void test_fixed_body_is_dirichlet(void **state)
{
    (void)state;
    cipc_model *m = create_two();
    assert_int_equal(m->dirichlet_count, 1);
    assert_int_equal(m->dirichlet[0].node_count, 3);
    for (int i = 0; i < 3; i++) assert_int_equal(m->dirichlet[0].nodes[i], 4 + i);
    assert_true(m->dirichlet[0].release == INFINITY);
    assert_int_equal(m->dirichlet[0].motion_count, 0);
    cipc_model_destroy(m);
}

static void test_name_is_always_terminated(void **state)
{
    (void)state;
    cipc_body_description d = describe("", rectangle, 4, rectangle_triangles, 2);
    memset(d.name, 'n', sizeof d.name - 1);
    d.name[sizeof d.name - 1] = 0;
    cipc_model *m;
    assert_int_equal(cipc_model_create(&m, &d, 1, gravity, NULL), CIPC_OK);
    assert_int_equal(strlen(m->bodies[0].name), CIPC_NAME_SIZE - 1);
    cipc_model_destroy(m);
}

/* A description with one number replaced is refused with this status, by a message that names the body and the number. */
static void assert_refused(const cipc_body_description *d, cipc_status status, const char *what)
{
    cipc_model *m = (cipc_model *)&gravity;
    cipc_error error;
    assert_int_equal(cipc_model_create(&m, d, 1, gravity, &error), status);
    assert_null(m);
    assert_int_equal(error.status, status);
    assert_string_equal(error.place, "cloth");
    if (!strstr(error.what, what)) fail_msg("\"%s\" does not name \"%s\"", error.what, what);
}

static void test_numbers_out_of_range(void **state)
{
    (void)state;
    cipc_body_description d;
    const struct {
        double *number;
        double bad;
        const char *name;
    } cases[] = {
        {&d.material.density, 0, "density"},
        {&d.material.density, NAN, "density"},
        {&d.material.thickness, -1, "thickness"},
        {&d.material.thickness, INFINITY, "thickness"},
        {&d.offset, -1e-9, "offset"},
        {&d.friction, -0.1, "friction"},
        {&d.friction, INFINITY, "friction"},
        {&d.material.membrane_young, 0, "membrane.young"},
        {&d.material.membrane_poisson, 1, "membrane.poisson"},
        {&d.material.membrane_poisson, -1, "membrane.poisson"},
        {&d.material.bending_young, -1, "bending.young"},
        {&d.material.bending_poisson, 1, "bending.poisson"},
        {&d.material.bending_poisson, -1, "bending.poisson"},
        {&d.material.strain_limit, 1, "strain_limit.limit"},
        {&d.material.strain_limit, NAN, "strain_limit.limit"},
        {&d.material.strain_activation, 0.9, "strain_limit.activation"},
        {&d.material.strain_activation, 1.1, "strain_limit.activation"},
        {&d.material.strain_stiffness, 0, "strain_limit.stiffness"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        d = describe("cloth", rectangle, 4, rectangle_triangles, 2);
        *cases[i].number = cases[i].bad;
        assert_refused(&d, CIPC_E_OUT_OF_RANGE, cases[i].name);
    }
    d = describe("cloth", rectangle, 4, rectangle_triangles, 2);
    d.material.membrane = CIPC_MEMBRANE_SPRINGS; /* they too have a modulus */
    d.material.membrane_young = 0;
    assert_refused(&d, CIPC_E_OUT_OF_RANGE, "membrane.young");
}

/* Numbers that nothing uses need no sense: no membrane, no limit. */
static void test_unused_numbers(void **state)
{
    (void)state;
    cipc_body_description d = describe("cloth", rectangle, 4, rectangle_triangles, 2);
    d.material.membrane = CIPC_MEMBRANE_NONE;
    d.material.membrane_young = d.material.membrane_poisson = 0;
    d.material.strain_limit = d.material.strain_activation = d.material.strain_stiffness = 0;
    d.offset = d.friction = d.material.bending_young = 0;
    cipc_model *m;
    assert_int_equal(cipc_model_create(&m, &d, 1, gravity, NULL), CIPC_OK);
    cipc_model_destroy(m);
}

static void test_positions_must_be_finite(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    double broken[12];
    for (int which = 0; which < 3; which++)
        for (int i = 0; i < 12; i++) {
            cipc_body_description d = describe("cloth", rectangle, 4, rectangle_triangles, 2);
            memcpy(broken, rectangle, sizeof broken);
            broken[i] = bad[i % 3];
            *(which == 0 ? &d.rest : which == 1 ? &d.position : &d.velocity) = broken;
            assert_refused(&d, CIPC_E_OUT_OF_RANGE, "not finite");
        }
}

static void test_bad_meshes(void **state)
{
    (void)state;
    const double in_line[] = {0, 0, 0, 1, 1, 1, 3, 3, 3};
    const struct {
        const double *nodes;
        int node_count;
        int triangle[3];
        int triangle_count;
        const char *what;
    } cases[] = {
        {rectangle, 3, {0, 1, 2}, 0, "0 triangles"}, {rectangle, 0, {0, 1, 2}, 1, "0 nodes"}, {rectangle, 3, {0, 1, 3}, 1, "index 3"},
        {rectangle, 3, {0, -1, 2}, 1, "index -1"},   {rectangle, 3, {0, 1, 1}, 1, "repeats"}, {rectangle, 3, {0, 1, 0}, 1, "repeats"},
        {rectangle, 3, {2, 2, 1}, 1, "repeats"},     {in_line, 3, {0, 1, 2}, 1, "no area"},   {rectangle, 4, {0, 1, 2}, 1, "node 3"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_body_description d = describe("cloth", cases[i].nodes, cases[i].node_count, &cases[i].triangle, cases[i].triangle_count);
        assert_refused(&d, CIPC_E_BAD_MESH, cases[i].what);
    }
}

static void test_scene_wide_input(void **state)
{
    (void)state;
    cipc_body_description d = describe("cloth", rectangle, 4, rectangle_triangles, 2);
    const double no_gravity[3] = {0, NAN, 0};
    cipc_model *m;
    assert_int_equal(cipc_model_create(&m, &d, 0, gravity, NULL), CIPC_E_OUT_OF_RANGE);
    assert_null(m);
    assert_int_equal(cipc_model_create(&m, &d, 1, no_gravity, NULL), CIPC_E_OUT_OF_RANGE);
    assert_null(m);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_body_description d[2];
    describe_two(d);
    cipc_model *m;
    cipc_error error;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_model_create(&m, d, 2, gravity, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_null(m);
    }
    fail_allocation(0);
    assert_true(n > 15); /* two meshes, the model, its arrays, the fixed set */
    assert_non_null(m);
    cipc_model_destroy(m);
    cipc_model_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbering),
        cmocka_unit_test(test_masses_and_areas),
        cmocka_unit_test(test_pairs_of_bodies),
        cmocka_unit_test(test_fixed_body_is_dirichlet),
        cmocka_unit_test(test_name_is_always_terminated),
        cmocka_unit_test(test_numbers_out_of_range),
        cmocka_unit_test(test_unused_numbers),
        cmocka_unit_test(test_positions_must_be_finite),
        cmocka_unit_test(test_bad_meshes),
        cmocka_unit_test(test_scene_wide_input),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
