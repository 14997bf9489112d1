/* Tetrahedra in unions of capsules. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/scene.h"
#include "scene/capsules.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double degree = 3.14159265358979323846 / 180;
static const double least_dihedral = 10.7; /* degrees: Labelle and Shewchuk's bound */

/* A body of four limbs and a head. */
static const cipc_capsule figure[6] = {
    {{0, 0, 0}, {0, 0.15, 0}, {0.08, 0.07}},         {{0, 0.26, 0}, {0, 0.26, 0}, {0.06, 0.06}},
    {{0.05, 0.15, 0}, {0.2, 0.18, 0.02}, {0.04, 0.03}}, {{-0.05, 0.15, 0}, {-0.2, 0.18, 0.02}, {0.04, 0.03}},
    {{0.05, -0.03, 0}, {0.08, -0.2, 0}, {0.045, 0.04}}, {{-0.05, -0.03, 0}, {-0.08, -0.2, 0}, {0.045, 0.04}},
};

static void test_figures(void **state)
{
    (void)state;
    const double cells[4] = {0.04, 0.03, 0.02, 0.013}, blend = 0.02;
    const scene_capsules shape = {6, figure, blend};
    double volume[4];
    for (int k = 0; k < 4; k++) {
        cipc_mesh mesh;
        cipc_error error;
        if (cipc_mesh_capsules(&mesh, 6, figure, blend, cells[k], &error) != CIPC_OK) fail_msg("%g: %s", cells[k], error.what);
        volume_properties p = measure_volume(&mesh);
        assert_true(p.smallest > 0 && p.smallest_dihedral > least_dihedral * degree);
        assert_int_equal(p.nodes_unused + count_duplicate_nodes(&mesh), 0);
        assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
        assert_int_equal(p.surface.euler, 2);
        int on = 0;
        for (int i = 0; i < mesh.node_count; i++) {
            double depth = scene_capsules_depth(&shape, mesh.nodes + 3 * i);
            on += fabs(depth) < 1e-14;
            assert_true(depth > -1e-14);
        }
        assert_int_equal(on, p.surface_triangles / 2 + 2); /* all nodes of a closed surface of Euler number 2 */
        volume[k] = p.volume;
        cipc_mesh_free(&mesh);
    }
    for (int k = 0; k < 3; k++) assert_true(volume[k] < volume[k + 1]); /* chords below a round surface */
}

static void refuse(int count, const cipc_capsule *parts, double blend, double cell, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_capsules(&mesh, count, parts, blend, cell, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "capsules");
    if (strstr(error.what, what) == NULL) fail_msg("%s", error.what);
    assert_null(mesh.nodes);
}

static void test_rejections(void **state)
{
    (void)state;
    cipc_capsule bad = figure[0];
    refuse(0, figure, 0, 0.05, "no parts");
    refuse(6, figure, 0, 0, "cells of 0 m");
    refuse(6, figure, 0, (double)NAN, "cells");
    refuse(6, figure, -1, 0.05, "blend");
    refuse(6, figure, 0, 1e-5, "points");
    refuse(1, figure + 1, 0, 2, "too large");
    bad.radius[1] = 0;
    refuse(1, &bad, 0, 0.05, "radius of 0 m");
    bad = figure[0];
    bad.end[2] = (double)INFINITY;
    refuse(1, &bad, 0, 0.05, "not finite");
    const cipc_capsule apart[2] = {{{0, 0, 0}, {0, 0, 0}, {0.1, 0.1}}, {{0.5, 0, 0}, {0.5, 0, 0}, {0.1, 0.1}}};
    refuse(2, apart, 0, 0.05, "2 separate pieces");
}

/* Limbs of 0.06 to 0.09 m in cells that hardly resolve them: refused, for pieces or pinched edges, or a closed surface without any; each of the three happens. */
static void test_coarse_cells(void **state)
{
    (void)state;
    int pieces = 0, pinches = 0, made = 0;
    for (int i = 0; i < 60; i++) {
        cipc_mesh mesh;
        cipc_error error = {.what = ""};
        if (cipc_mesh_capsules(&mesh, 6, figure, 0.02, 0.05 + 0.001 * i, &error) != CIPC_OK) {
            pieces += strstr(error.what, "separate pieces") != NULL;
            pinches += strstr(error.what, "single edges") != NULL;
            continue;
        }
        volume_properties p = measure_volume(&mesh);
        assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
        assert_true(p.smallest > 0 && p.smallest_dihedral > least_dihedral * degree);
        made++;
        cipc_mesh_free(&mesh);
    }
    if (pieces == 0 || pinches == 0 || made < 20) fail_msg("%d in pieces, %d pinched, %d made", pieces, pinches, made);
    assert_int_equal(pieces + pinches + made, 60);
}

static void test_no_memory(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        cipc_mesh mesh;
        fail_allocation(n);
        cipc_status status = cipc_mesh_capsules(&mesh, 6, figure, 0, 0.05, NULL);
        if (!allocation_failed()) {
            assert_int_equal(status, CIPC_OK);
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_figures),
        cmocka_unit_test(test_rejections),
        cmocka_unit_test(test_coarse_cells),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
