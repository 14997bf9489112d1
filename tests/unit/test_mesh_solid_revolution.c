/* Solids of revolution. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double full = 2 * 3.14159265358979323846;
static const double sum_tolerance = 1e-12; /* sums of some thousand terms */

typedef struct solid {
    int rows, columns, sectors, nodes, euler;
    double moment; /* of the section about the axis, m^3: the integral of r */
    const double (*points)[2];
} solid;

/* n sectors of the section turned by 2 pi / n each: the volume is the section's moment times n sin(2 pi / n), because each r dr dphi sector is a triangle. */
static void check_solid(const solid *s)
{
    cipc_mesh mesh;
    cipc_error error;
    if (cipc_mesh_solid_revolution(&mesh, s->rows, s->columns, s->points, s->sectors, &error) != CIPC_OK) fail_msg("%s", error.what);
    volume_properties p = measure_volume(&mesh);
    assert_int_equal(mesh.node_count, s->nodes);
    assert_true(p.smallest > 0);
    assert_true(fabs(p.volume / (s->moment * s->sectors * sin(full / s->sectors)) - 1) < sum_tolerance);
    assert_true(fabs(p.surface.volume / p.volume - 1) < sum_tolerance);
    assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
    assert_int_equal(p.surface.euler, s->euler);
    assert_int_equal(p.nodes_unused, 0);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    cipc_mesh_free(&mesh);
}

static const double disc[4][2] = {{0, 0}, {2, 0}, {0, 1}, {2, 1}};
static const double disc_other_way[4][2] = {{0, 1}, {2, 1}, {0, 0}, {2, 0}};
static const double ring[6][2] = {{1, 0}, {1.5, 0}, {2, 0}, {1, 1}, {1.5, 1}, {2, 1}};
/* The wall of a cup: floor and side; inside first. */
static const double cup[6][2] = {{0, 0.2}, {0.8, 0.2}, {0.8, 1}, {0, 0}, {1, 0}, {1, 1}};

static void test_solids(void **state)
{
    (void)state;
    for (int sectors = 3; sectors <= 48; sectors *= 2) {
        check_solid(&(solid){2, 2, sectors, 2 + 2 * sectors, 2, 2, disc});
        check_solid(&(solid){2, 2, sectors, 2 + 2 * sectors, 2, 2, disc_other_way});
        check_solid(&(solid){2, 3, sectors, 6 * sectors, 0, 1.5, ring}); /* a torus */
        /* outer cylinder less inner: 1/2 (1 * 1 - 0.64 * 0.8) */
        check_solid(&(solid){2, 3, sectors, 2 + 4 * sectors, 2, 0.5 * (1 - 0.64 * 0.8), cup});
    }
}

/* Where sectors are as wide as the wall is thick, no tetrahedron is flat. */
static void test_shapes(void **state)
{
    (void)state;
    static const double square[4][2] = {{1, 0}, {1.5, 0}, {1, 0.5}, {1.5, 0.5}};
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_solid_revolution(&mesh, 2, 2, square, 16, NULL), CIPC_OK);
    assert_true(measure_volume(&mesh).smallest_dihedral > full / 12); /* a cube's, cut in six: 45 degrees */
    cipc_mesh_free(&mesh);
}

static void reject(int rows, int columns, const double (*points)[2], int sectors, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_solid_revolution(&mesh, rows, columns, points, sectors, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    static const double negative[4][2] = {{-1, 0}, {2, 0}, {0, 1}, {2, 1}}, infinite[4][2] = {{0, 0}, {2, 0}, {0, (double)INFINITY}, {2, 1}};
    static const double crossed[4][2] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, flat[4][2] = {{0, 0}, {2, 0}, {0, 0}, {2, 1}};
    static const double folded[6][2] = {{0, 0}, {1, 0}, {0.5, 0}, {0, 1}, {1, 1}, {0.5, 1}};
    reject(1, 4, disc, 8, "1 by 4 points");
    reject(2, 2, disc, 2, "2 sectors");
    reject(2, 2, negative, 8, "radius of 0 or more");
    reject(2, 2, infinite, 8, "radius of 0 or more");
    reject(2, 2, crossed, 8, "not convex");
    reject(2, 2, flat, 8, "not convex");
    reject(2, 3, folded, 8, "row 0, column 1");
    reject(2, 2, disc, 2147483647, "at most");
    cipc_mesh mesh;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_solid_revolution(&mesh, 2, 2, disc, 4, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solids),
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
