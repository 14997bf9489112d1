/* Masses, weights, joints and surfaces of bodies of every kind; what the checks of bodies refuse; which primitives meet. */
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

static const double pi = 3.14159265358979323846;
static const double gravity[3] = {0, -9.81, 0};
/* Some twenty operations a number. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static void assert_close(double got, double want)
{
    if (!(fabs(got - want) <= ROUNDINGS * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* A Y of three segments, 1, 2 and 3 m long, and a free segment of 2 m. */
static const double rod_nodes[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 5, 0, 0, 5, 2, 0};
static const int rod_segments[4][2] = {{0, 1}, {2, 0}, {0, 3}, {4, 5}};
static const double two_points[] = {9, 0, 0, 9, 1, 0};
/* Two tetrahedra on one face, and a node inside of neither: five nodes. */
static const double tetrahedron_nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
static const int tetrahedra[2][4] = {{0, 1, 2, 3}, {1, 2, 3, 4}};
static const double triangle_nodes[] = {0, 7, 0, 1, 7, 0, 0, 7, 1};
static const int triangle[1][3] = {{0, 2, 1}};

static void describe(cipc_body_description d[4])
{
    const cipc_material rod = {.density = 3, .thickness = 0.1, .young = 10, .bending_young = 10}, ball = {.density = 2, .thickness = 0.5}, solid = {.density = 6, .young = 10, .poisson = 0.25},
                        cloth = {.density = 4, .thickness = 0.01};
    d[0] = (cipc_body_description){.name = "rods", .kind = CIPC_BODY_RODS, .material = rod, .node_count = 6, .rest = rod_nodes, .position = rod_nodes, .segment_count = 4, .segments = rod_segments};
    d[1] = (cipc_body_description){.name = "particles", .kind = CIPC_BODY_PARTICLES, .material = ball, .node_count = 2, .rest = two_points, .position = two_points};
    d[2] = (cipc_body_description){.name = "volume", .kind = CIPC_BODY_VOLUME, .material = solid, .node_count = 5, .rest = tetrahedron_nodes, .position = tetrahedron_nodes, .tetrahedron_count = 2, .tetrahedra = tetrahedra};
    d[3] = (cipc_body_description){.name = "shell", .material = cloth, .node_count = 3, .rest = triangle_nodes, .position = triangle_nodes, .triangle_count = 1, .triangles = triangle};
}

static cipc_model *create(void)
{
    cipc_body_description d[4];
    cipc_model *m;
    cipc_error error;
    describe(d);
    if (cipc_model_create(&m, d, 4, gravity, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    return m;
}

static void test_masses(void **state)
{
    (void)state;
    cipc_model *m = create();
    const double half = 0.5 * 3 * pi * 0.01 / 4; /* of a meter of rod */
    const double rods[6] = {6 * half, 1 * half, 2 * half, 3 * half, 2 * half, 2 * half};
    for (int i = 0; i < 6; i++) assert_close(m->mass[i], rods[i]);
    for (int i = 6; i < 8; i++) assert_close(m->mass[i], 2 * pi * 0.125 / 6);
    const double first = 1.0 / 6, second = 2.0 / 6; /* volumes; a quarter of 6 V to each node */
    const double solid[5] = {first, first + second, first + second, first + second, second};
    for (int i = 0; i < 5; i++) assert_close(m->mass[8 + i], 1.5 * solid[i]);
    for (int i = 13; i < 16; i++) assert_close(m->mass[i], 4 * 0.01 * 0.5 / 3);
    cipc_model_destroy(m);
}

/* Segments behind the triangles' edges; three pairs at the Y's middle. */
static void test_topology(void **state)
{
    (void)state;
    cipc_model *m = create();
    assert_int_equal(m->segment_count, 4);
    assert_int_equal(m->edge_count, m->first_segment + 4);
    assert_memory_equal(m->edges[m->first_segment], rod_segments, sizeof rod_segments);
    const int joints[3][3] = {{1, 0, 2}, {1, 0, 3}, {2, 0, 3}};
    assert_int_equal(m->joint_count, 3);
    assert_memory_equal(m->joints, joints, sizeof joints);
    assert_int_equal(m->triangle_count, 6 + 1);
    assert_int_equal(m->hinge_count, 0); /* a volume's surface has none */
    assert_int_equal(m->first_segment, 9 + 3);
    assert_int_equal(m->bodies[2].triangle_count, 6);
    for (int i = 0; i < m->node_count; i++) assert_false(m->interior[i]);
    cipc_model_destroy(m);
}

/* Outward: the surface's volume by the divergence theorem is that of the tetrahedra. */
static void test_surface_is_outward(void **state)
{
    (void)state;
    cipc_model *m = create();
    double volume = 0;
    for (int t = m->bodies[2].first_triangle; t < m->bodies[2].first_triangle + 6; t++) {
        const double *a = m->rest + 3 * m->triangles[t][0], *b = m->rest + 3 * m->triangles[t][1], *c = m->rest + 3 * m->triangles[t][2];
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    }
    assert_close(volume, 0.5);
    cipc_model_destroy(m);
}

/* The mean weight of each class is 1. */
static void test_weights(void **state)
{
    (void)state;
    cipc_model *m = create();
    double rods = 0, segments = 0, surface = 0, edges = 0;
    for (int i = 0; i < 6; i++) rods += m->node_weight[i];
    for (int e = m->first_segment; e < m->edge_count; e++) segments += m->edge_weight[e];
    for (int i = 8; i < 16; i++) surface += m->node_weight[i];
    for (int e = 0; e < m->first_segment; e++) edges += m->edge_weight[e];
    assert_close(rods, 6);
    assert_close(segments, 4);
    assert_close(surface, 8);
    assert_close(edges, 12);
    assert_true(m->node_weight[6] == 1 && m->node_weight[7] == 1);
    assert_close(m->node_weight[0] / m->node_weight[1], 6);
    assert_close(m->edge_weight[m->first_segment + 2] / m->edge_weight[m->first_segment], 3);
    cipc_model_destroy(m);
}

static void test_inner_nodes(void **state)
{
    (void)state;
    /* Four tetrahedra around a node. */
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.25, 0.25, 0.25};
    const int around[4][4] = {{0, 1, 2, 4}, {0, 3, 1, 4}, {0, 2, 3, 4}, {1, 3, 2, 4}};
    cipc_body_description d[4];
    cipc_model *m;
    describe(d);
    d[2].rest = d[2].position = x;
    d[2].tetrahedra = around;
    d[2].tetrahedron_count = 4;
    assert_int_equal(cipc_model_create(&m, d + 2, 1, gravity, NULL), CIPC_OK);
    for (int i = 0; i < 5; i++) assert_int_equal(m->interior[i], i == 4);
    assert_int_equal(m->triangle_count, 4);
    cipc_model_destroy(m);
}

static void test_stitches_and_apart(void **state)
{
    (void)state;
    cipc_model *m = create();
    cipc_error error;
    const int node = 6, edge[2] = {13, 14}, other[2] = {4, 5}, far = 15;
    assert_true(cipc_model_meet(m, &node, 1, edge, 2) && cipc_model_meet(m, other, 2, edge, 2));
    const cipc_stitching good = {.nodes = {6, 13, 15}, .ratio = 0.5, .stiffness = 10};
    assert_int_equal(cipc_model_add_stitches(m, &good, 1, &error), CIPC_OK);
    assert_int_equal(m->stitch_count, 1);
    assert_false(cipc_model_meet(m, &node, 1, edge, 2));
    assert_false(cipc_model_meet(m, edge, 2, &node, 1));
    assert_false(cipc_model_meet(m, &node, 1, &far, 1));
    assert_true(cipc_model_meet(m, other, 2, edge, 2));
    cipc_model_set_apart(m, 0, 3);
    assert_false(cipc_model_meet(m, other, 2, edge, 2) || cipc_model_meet(m, edge, 2, other, 2));
    assert_false(cipc_model_meet(m, other, 2, other, 1)); /* a shared node */
    const cipc_stitching bad[] = {{.nodes = {6, 13, 99}, .stiffness = 1}, {.nodes = {6, 6, 13}, .stiffness = 1}, {.nodes = {6, 13, 14}, .ratio = 1.5, .stiffness = 1}, {.nodes = {6, 13, 14}}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) assert_int_equal(cipc_model_add_stitches(m, &bad[i], 1, &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(m->stitch_count, 1);
    cipc_model_destroy(m);
}

/* Each kind of bad body, and what the message names. */
static void test_bad_bodies(void **state)
{
    (void)state;
    static const int twice[5][2] = {{0, 1}, {2, 0}, {0, 3}, {4, 5}, {1, 0}}, loop[4][2] = {{0, 0}, {2, 0}, {0, 3}, {4, 5}}, beyond[4][2] = {{0, 1}, {2, 6}, {0, 3}, {4, 5}};
    static const int inverted[2][4] = {{0, 2, 1, 3}, {1, 2, 3, 4}}, thrice[3][4] = {{0, 1, 2, 3}, {1, 2, 3, 4}, {1, 2, 3, 4}};
    cipc_body_description d[4];
    cipc_model *m;
    cipc_error error;
    for (int i = 0; i < 8; i++) {
        static const char *const words[] = {"given twice", "repeats a node", "but the mesh has", "belongs to no", "volume", "more than two", "young", "poisson"};
        describe(d);
        if (i == 0) d[0].segments = twice, d[0].segment_count = 5;
        if (i == 1) d[0].segments = loop;
        if (i == 2) d[0].segments = beyond;
        if (i == 3) d[0].segment_count = 3;
        if (i == 4) d[2].tetrahedra = inverted;
        if (i == 5) d[2].tetrahedra = thrice, d[2].tetrahedron_count = 3;
        if (i == 6) d[2].material.young = 0;
        if (i == 7) d[2].material.poisson = 0.5;
        assert_int_equal(cipc_model_create(&m, d, 4, gravity, &error), i < 6 ? CIPC_E_BAD_MESH : CIPC_E_OUT_OF_RANGE);
        assert_null(m);
        if (strstr(error.what, words[i]) == NULL) fail_msg("'%s' does not say '%s'", error.what, words[i]);
        assert_string_equal(error.place, i < 4 ? "rods" : "volume");
    }
}

/* Warp or weft across a triangle: the triangle lies in the plane y = 7. */
static void test_yarns_across_the_cloth(void **state)
{
    (void)state;
    const double good[3] = {1, 5, 0}, across[3] = {0, 2, 0};
    for (int i = 0; i < 4; i++) {
        cipc_body_description d[4];
        cipc_model *m = NULL;
        cipc_error error;
        describe(d);
        cipc_material *material = &d[3].material;
        material->membrane = CIPC_MEMBRANE_ORTHOTROPIC;
        material->orthotropic = (cipc_orthotropic_material){.moduli = {2, 1, 2, 1}, .limits = {0.1, 0.1, 0.1}};
        memcpy(material->orthotropic.warp, i == 1 ? across : good, sizeof good);
        if (i > 1) memcpy(material->orthotropic.weft, i == 2 ? across : good, sizeof good);
        cipc_status status = cipc_model_create(&m, d + 3, 1, gravity, &error);
        assert_int_equal(status, i == 1 || i == 2 ? CIPC_E_OUT_OF_RANGE : CIPC_OK);
        if (status) assert_non_null(strstr(error.what, i == 1 ? "warp" : "weft"));
        cipc_model_destroy(m);
    }
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_body_description d[4];
    cipc_model *m;
    cipc_error error;
    describe(d);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_model_create(&m, d, 4, gravity, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        if (!failed) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(m);
        assert_true(n < 100);
    }
    cipc_model_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_masses),       cmocka_unit_test(test_topology),           cmocka_unit_test(test_surface_is_outward), cmocka_unit_test(test_weights),
        cmocka_unit_test(test_inner_nodes),  cmocka_unit_test(test_stitches_and_apart), cmocka_unit_test(test_bad_bodies),         cmocka_unit_test(test_yarns_across_the_cloth), cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
