/* Gores: panels of a cone, flat and around the body. */
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

static const double pi = 3.14159265358979323846;
/* Lengths below come from coordinates of up to a metre with some 20 roundings of 2^-53 each, over sides of 5 mm and more: 20 * 1.1e-16 / 5e-3. */
static const double isometry_tolerance = 5e-13;

static cipc_mesh gores(int panels, double top, double bottom, double height, int across, int down)
{
    cipc_mesh mesh;
    const cipc_panel_ring ring = {.panels = panels, .down = down, .top = top, .bottom = bottom, .height = height};
    assert_int_equal(cipc_mesh_gores(&mesh, &ring, across, NULL), CIPC_OK);
    return mesh;
}

static mesh_properties measure_pattern(const cipc_mesh *mesh)
{
    cipc_mesh flat = *mesh;
    flat.nodes = mesh->pattern;
    return measure_mesh(&flat);
}

/* The area is that of the frustum of a pyramid; each panel is a disc; flat, it has the same area and lies face up. */
static void check_ring(int panels, double top, double bottom, double height, int across, int down)
{
    cipc_mesh mesh = gores(panels, top, bottom, height, across, down);
    int around = panels * across;
    double slant = hypot(height, (bottom - top) * cos(pi / around)), area = around * (top + bottom) * sin(pi / around) * slant;
    mesh_properties p = measure_mesh(&mesh), flat = measure_pattern(&mesh);
    assert_int_equal(mesh.node_count, panels * (across + 1) * (down + 1));
    assert_int_equal(mesh.triangle_count, 2 * around * down);
    assert_true(mesh.panel_count == panels && mesh.panel_columns == across + 1 && mesh.panel_rows == down + 1);
    assert_true(fabs(p.area / area - 1) < 1e-12 && fabs(flat.area / area - 1) < 1e-12);
    assert_int_equal(p.euler, panels);
    assert_int_equal(p.bad_edges + p.unused_nodes, 0);
    assert_int_equal(p.boundary_edges, 2 * panels * (across + down));
    assert_true(flat.smallest_up > 1 - 1e-12);
    assert_true(pattern_strain(&mesh) < isometry_tolerance);
    cipc_mesh_free(&mesh);
}

static void test_rings_unfold_without_stretch(void **state)
{
    (void)state;
    check_ring(4, 0.12, 0.3, 0.5, 4, 4);
    check_ring(8, 0.12, 0.3, 0.5, 27, 55);
    check_ring(1, 0.2, 0.2, 0.3, 12, 3);             /* a cylinder: a rectangle */
    check_ring(3, 0.2, 0.2 * (1 + 1e-9), 0.3, 5, 3); /* nearly one: the apex is 3e8 m away */
    check_ring(3, 0.3, 0.1, 0.2, 1, 1);
}

/* The checks above can fail: a node of the pattern moved by 10 nm. */
static void test_a_stretched_pattern_is_seen(void **state)
{
    (void)state;
    cipc_mesh mesh = gores(4, 0.12, 0.3, 0.5, 4, 4);
    mesh.pattern[3 * 7] += 1e-8;
    assert_true(pattern_strain(&mesh) > 1e-8);
    cipc_mesh_free(&mesh);
}

/* Angles from +x towards -z, outward normals, the top at y = 0; rows from left to right as seen from outside. */
static void test_where_it_lies(void **state)
{
    (void)state;
    cipc_mesh mesh = gores(2, 0.1, 0.2, 0.4, 3, 2);
    const double *x = mesh.nodes, *right = mesh.nodes + 3 * 3, *low = mesh.nodes + 3 * 8;
    assert_true(x[0] == 0.1 && x[1] == 0 && x[2] == 0);
    assert_true(fabs(right[0] + 0.1) < 1e-15 && fabs(right[2]) < 1e-15 && mesh.nodes[3 * 1 + 2] < 0);
    assert_true(fabs(low[0] - 0.2) < 1e-15 && low[1] == -0.4);
    assert_true(measure_mesh(&mesh).volume > 0); /* of cones from the origin */
    cipc_mesh_free(&mesh);
}

/* Each panel's right side is, to the bit, where the next one's left side is; the last one's is the first one's. */
static void test_seams_close(void **state)
{
    (void)state;
    enum { PANELS = 5, ACROSS = 3, DOWN = 4 };
    cipc_mesh mesh = gores(PANELS, 0.12, 0.3, 0.5, ACROSS, DOWN);
    for (int p = 0; p < PANELS; p++) {
        for (int j = 0; j <= DOWN; j++) {
            int right = (p * (DOWN + 1) + j) * (ACROSS + 1) + ACROSS, left = ((p + 1) % PANELS * (DOWN + 1) + j) * (ACROSS + 1);
            assert_memory_equal(mesh.nodes + 3 * right, mesh.nodes + 3 * left, 3 * sizeof *mesh.nodes);
        }
    }
    cipc_mesh_free(&mesh);
}

/* The pattern is its own mirror image, the upper corners on a line along x. */
static void test_patterns_are_symmetric(void **state)
{
    (void)state;
    enum { ACROSS = 6, DOWN = 3 };
    cipc_mesh mesh = gores(4, 0.12, 0.3, 0.5, ACROSS, DOWN);
    double middle = mesh.pattern[3 * ACROSS] / 2;
    for (int j = 0; j <= DOWN; j++) {
        for (int c = 0; c <= ACROSS; c++) {
            const double *a = mesh.pattern + 3 * (j * (ACROSS + 1) + c), *b = mesh.pattern + 3 * (j * (ACROSS + 1) + ACROSS - c);
            assert_true(fabs(a[0] + b[0] - 2 * middle) < 1e-14 && fabs(a[2] - b[2]) < 1e-14 && a[1] == 0);
        }
    }
    assert_true(mesh.pattern[3 * ACROSS * 0] == 0 && fabs(mesh.pattern[3 * ACROSS + 2]) < 1e-15);
    cipc_mesh_free(&mesh);
}

static void reject(cipc_panel_ring ring, int across, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_gores(&mesh, &ring, across, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
    assert_null(mesh.pattern);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    reject((cipc_panel_ring){2, 1, 0, 1, 1}, 3, "from radius 0 to 1");
    reject((cipc_panel_ring){2, 1, 1, -1, 1}, 3, "to -1");
    reject((cipc_panel_ring){2, 1, 1, 1, (double)NAN}, 3, "nan m high");
    reject((cipc_panel_ring){2, 1, (double)INFINITY, 1, 1}, 3, "radius inf");
    reject((cipc_panel_ring){0, 1, 1, 1, 1}, 3, "0 panels");
    reject((cipc_panel_ring){2, 0, 1, 1, 1}, 3, "of 0 rows");
    reject((cipc_panel_ring){2, 1, 1, 1, 1}, 1, "3 are needed");
    reject((cipc_panel_ring){2, 1, 1, 1, 1}, 0, "3 are needed");
    reject((cipc_panel_ring){2147483647, 1, 1, 1, 1}, 2147483647, "at most 10000000 allowed");
    reject((cipc_panel_ring){2, 2147483647, 1, 1, 1}, 3, "at most 10000000 are allowed");
}

static void test_no_memory(void **state)
{
    (void)state;
    const cipc_panel_ring ring = {.panels = 2, .down = 2, .top = 1, .bottom = 2, .height = 1};
    cipc_mesh mesh;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_gores(&mesh, &ring, 2, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
        assert_null(mesh.pattern);
    }
    assert_int_equal(n, 6); /* curve, nodes, triangles, rulings and pattern have failed in turn */
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rings_unfold_without_stretch),
        cmocka_unit_test(test_a_stretched_pattern_is_seen),
        cmocka_unit_test(test_where_it_lies),
        cmocka_unit_test(test_seams_close),
        cmocka_unit_test(test_patterns_are_symmetric),
        cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
