/* Knife pleats. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/flat_pattern.h"
#include "support/mesh_properties.h"

static const double two_pi = 6.28318530717958647693;
/* As of gores (test_mesh_gores.c), but sides are as short as the 2 mm of a fold, and a pattern is 5 m long: 20 * 1.1e-16 * 5 / 2e-3. */
static const double isometry_tolerance = 5.5e-12;

typedef struct skirt {
    cipc_panel_ring ring;
    cipc_pleating pleats;
} skirt;

static const skirt skirts[] = {
    {{2, 20, 0.165, 0.2, 0.42}, {24, 4, 1, 0.02, 0.004}},
    {{2, 3, 0.165, 0.2, 0.42}, {10, 3, 1, 0.04, 0.004}},
    {{1, 1, 0.165, 0.165, 0.4}, {12, 20, 10, 0.1, 0.002}}, /* deeper than the pitch: five layers and more */
    {{4, 2, 0.3, 0.2, 0.4}, {40, 5, 2, 0.02, 0.002}},
};

static cipc_mesh fold(const skirt *s)
{
    cipc_mesh mesh;
    cipc_error error;
    if (cipc_mesh_pleats(&mesh, &s->ring, &s->pleats, &error) != CIPC_OK) fail_msg("%s", error.what);
    return mesh;
}

static void test_pleats_unfold_without_stretch(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof skirts / sizeof *skirts; i++) {
        const skirt *s = &skirts[i];
        cipc_mesh mesh = fold(s), flat = mesh;
        flat.nodes = mesh.pattern;
        mesh_properties p = measure_mesh(&mesh), q = measure_mesh(&flat);
        int columns = s->pleats.count * (s->pleats.forward + s->pleats.back + 2), panels = s->ring.panels;
        assert_int_equal(mesh.node_count, (columns + panels) * (s->ring.down + 1));
        assert_int_equal(mesh.triangle_count, 2 * columns * s->ring.down);
        assert_int_equal(p.euler, panels);
        assert_int_equal(p.bad_edges + p.unused_nodes, 0);
        assert_true(pattern_strain(&mesh) < isometry_tolerance);
        assert_true(q.smallest_up > 1 - 1e-12 && fabs(p.area / q.area - 1) < 1e-11);
        cipc_mesh_free(&mesh);
    }
}

/* No layer comes nearer to another than half the gap (the generator's promise); and none is further than the gap, which is what a fold is. */
static void test_layers_keep_their_gap(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof skirts / sizeof *skirts; i++) {
        cipc_mesh mesh = fold(&skirts[i]);
        double least = plan_clearance(&mesh), gap = skirts[i].pleats.gap;
        if (!(least > gap / 2 && least < gap * (1 + 1e-9))) fail_msg("layers %g m apart instead of %g", least, gap);
        cipc_mesh_free(&mesh);
    }
}

/* The check above can fail: two layers that cross, and one that comes too near. */
static void test_layers_that_touch_are_seen(void **state)
{
    (void)state;
    const skirt *s = &skirts[0];
    cipc_mesh mesh = fold(s);
    double *x = mesh.nodes + 3 * 3, scale = 1 - 0.7 * s->pleats.gap / hypot(x[0], x[2]);
    x[0] *= scale;
    x[2] *= scale;
    double nearer = plan_clearance(&mesh);
    assert_true(nearer < s->pleats.gap * 0.5);
    for (int k = 0; k < 3; k++) x[k] = 0;
    assert_true(plan_clearance(&mesh) == 0);
    cipc_mesh_free(&mesh);
}

/* In polar coordinates the corners of a pleat are where the formulas of docs/scene.md put them. */
static void test_corners_of_a_pleat(void **state)
{
    (void)state;
    const skirt *s = &skirts[0];
    cipc_mesh mesh = fold(s);
    double pitch = two_pi / 24, depth = 0.02 / 0.165, rise = 2 * 0.004 * (pitch + depth) / pitch, inner = 0.165 - rise / 2;
    const double want[5][2] = {
        {0, inner}, {pitch + depth, inner + rise}, {pitch + depth, inner + rise - 0.004}, {pitch, inner + 0.004}, {pitch, inner}};
    const int corner[5] = {0, 4, 5, 6, 7};
    for (int i = 0; i < 5; i++) {
        const double *x = mesh.nodes + 3 * corner[i];
        assert_true(fabs(atan2(-x[2], x[0]) - want[i][0]) < 1e-14 && fabs(hypot(x[0], x[2]) - want[i][1]) < 1e-15);
    }
    cipc_mesh_free(&mesh);
}

static void test_seams_close(void **state)
{
    (void)state;
    const skirt *s = &skirts[0];
    cipc_mesh mesh = fold(s);
    int columns = mesh.panel_columns, half = mesh.node_count / 2;
    for (int j = 0; j <= s->ring.down; j++) {
        assert_memory_equal(mesh.nodes + 3 * (j * columns + columns - 1), mesh.nodes + 3 * (half + j * columns), 3 * sizeof *mesh.nodes);
        assert_memory_equal(mesh.nodes + 3 * (half + j * columns + columns - 1), mesh.nodes + 3 * j * columns, 3 * sizeof *mesh.nodes);
    }
    cipc_mesh_free(&mesh);
}

static void reject(cipc_panel_ring ring, cipc_pleating pleats, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_pleats(&mesh, &ring, &pleats, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    const cipc_panel_ring ring = {2, 20, 0.165, 0.2, 0.42};
    reject((cipc_panel_ring){2, 20, 0.165, 0.2, 0}, skirts[0].pleats, "0 m high");
    reject(ring, (cipc_pleating){2, 4, 1, 0.02, 0.004}, "2 pleats in 2 panels");
    reject(ring, (cipc_pleating){25, 4, 1, 0.02, 0.004}, "as many in each panel");
    reject(ring, (cipc_pleating){24, 0, 1, 0.02, 0.004}, "0 cells forward");
    reject(ring, (cipc_pleating){24, 4, 0, 0.02, 0.004}, "0 back");
    reject(ring, (cipc_pleating){24, 4, 1, 0, 0.004}, "pleats 0 m deep");
    reject(ring, (cipc_pleating){24, 4, 1, 0.02, (double)NAN}, "layers nan m apart");
    reject(ring, (cipc_pleating){24, 4, 1, 0.02, 0.2}, "no room around radius 0.165");
    reject(ring, (cipc_pleating){24, 400, 400, 0.5, 0.0001}, "no room around radius 0.165");
    reject(ring, (cipc_pleating){24, 1, 1, 0.02, 0.004}, "more cells forward and back, or a larger gap");
    reject(ring, (cipc_pleating){4, 40, 1, 0.04, 0.002}, "more cells forward and back");
    reject(ring, (cipc_pleating){24, 10000000, 1, 0.02, 0.004}, "at most 10000000 are allowed");
    reject((cipc_panel_ring){2, 2147483647, 0.165, 0.2, 0.42}, skirts[0].pleats, "at most 10000000 are allowed");
}

static void test_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_pleats(&mesh, &skirts[1].ring, &skirts[1].pleats, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    assert_int_equal(n, 6);
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pleats_unfold_without_stretch),
        cmocka_unit_test(test_layers_keep_their_gap),
        cmocka_unit_test(test_layers_that_touch_are_seen),
        cmocka_unit_test(test_corners_of_a_pleat),
        cmocka_unit_test(test_seams_close),
        cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
