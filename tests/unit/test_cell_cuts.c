/* Cells cut into tetrahedra: what the boxes, balls and cylinders rely on. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/cell_cuts.h"
#include "support/mesh_properties.h"

static const char *const place = "here";

static cipc_mesh cut(int x, int y, int z, bool mirror_x, bool mirror_y, bool mirror_z)
{
    cipc_mesh mesh;
    const int cells[3] = {x, y, z};
    const bool mirrored[3] = {mirror_x, mirror_y, mirror_z};
    assert_int_equal(scene_cut_cells(&mesh, cells, mirrored, place, NULL), CIPC_OK);
    return mesh;
}

/* All eight ways to mirror: equal volumes, a closed surface and none inside. */
static void test_every_mirroring_conforms(void **state)
{
    (void)state;
    for (int way = 0; way < 8; way++) {
        cipc_mesh mesh = cut(4, 2, 6, (way & 1) != 0, (way & 2) != 0, (way & 4) != 0);
        volume_properties p = measure_volume(&mesh);
        double one = 8.0 / (6 * 48);
        assert_true(fabs(p.smallest / one - 1) < 1e-13 && fabs(p.largest / one - 1) < 1e-13);
        assert_true(fabs(p.surface.area - 24) < 1e-12);
        assert_true(fabs(p.surface.volume - 8) < 1e-12);
        assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
        assert_int_equal(p.surface.euler, 2);
        cipc_mesh_free(&mesh);
    }
}

static double largest(const double *x)
{
    return fmax(fmax(fabs(x[0]), fabs(x[1])), fabs(x[2]));
}

/* Nodes of the tetrahedra that lie on the surface of the cube: never all four if everything is mirrored, otherwise some do. */
static int count_tetrahedra_on_surface(const cipc_mesh *mesh)
{
    int count = 0;
    for (int t = 0; t < mesh->tetrahedron_count; t++) {
        int on = 0;
        for (int k = 0; k < 4; k++) on += largest(mesh->nodes + 3 * mesh->tetrahedra[t][k]) == 1;
        count += on == 4;
    }
    return count;
}

static void test_mirrored_tetrahedra_reach_inside(void **state)
{
    (void)state;
    cipc_mesh mirrored = cut(4, 4, 4, true, true, true), plain = cut(4, 4, 4, false, false, false);
    assert_int_equal(count_tetrahedra_on_surface(&mirrored), 0);
    assert_true(count_tetrahedra_on_surface(&plain) > 0);
    cipc_mesh_free(&mirrored);
    cipc_mesh_free(&plain);
}

static void test_odd_numbers_cannot_be_mirrored(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    const int cells[3] = {3, 4, 4};
    const bool x[3] = {true, false, false}, y[3] = {false, true, false};
    assert_int_equal(scene_cut_cells(&mesh, cells, x, place, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, place);
    assert_string_equal(error.what, "3 cells across; an even number is needed");
    assert_int_equal(scene_cut_cells(&mesh, cells, y, place, &error), CIPC_OK);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_mirroring_conforms),
        cmocka_unit_test(test_mirrored_tetrahedra_reach_inside),
        cmocka_unit_test(test_odd_numbers_cannot_be_mirrored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
