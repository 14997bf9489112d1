/* Lattices over a solid: sides, cuts, and points on the surface. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "scene/cut_lattice.h"

static const double on_surface = 1e-14; /* of a bisection to rounding, for coordinates below 1 */

static double in_ball(const void *radius, const double x[3])
{
    return *(const double *)radius - v3_norm(x);
}

typedef struct census {
    int moved, cut, inside;
    double nearest_long, nearest_short; /* shares of the edge, from the nearer end */
} census;

static void look(const scene_lattice *l, bool middle, const int at[3], double radius, census *found)
{
    long long point = scene_lattice_point(l, middle, at);
    const double *x = l->place + 3 * point;
    double depth = radius - v3_norm(x);
    found->inside += l->side[point] > 0;
    if (l->side[point] == 0) {
        found->moved++;
        assert_true(fabs(depth) < on_surface);
    } else {
        assert_true(depth * l->side[point] > 0);
    }
    for (int slot = 0; slot < SCENE_LATTICE_EDGES; slot++) {
        double share = l->cut[SCENE_LATTICE_EDGES * point + slot], on[3], edge[3];
        if (!scene_lattice_has_edge(l, middle, at, slot)) {
            assert_true(share < 0);
            continue;
        }
        long long other = scene_lattice_other_end(l, point, slot);
        assert_int_equal(share >= 0, l->side[point] * l->side[other] < 0); /* a cut wherever the sides are opposite, and only there */
        if (share < 0) continue;
        bool is_long = slot < SCENE_LONG_EDGES;
        scene_lattice_between(l, point, other, share, on);
        assert_true(fabs(radius - v3_norm(on)) < on_surface);
        v3_sub(edge, l->place + 3 * other, x); /* neither end has been moved */
        assert_true(fabs(v3_norm(edge) - l->cell * (is_long ? 1 : sqrt(0.75))) < 1e-14);
        double *nearest = is_long ? &found->nearest_long : &found->nearest_short;
        *nearest = fmin(*nearest, fmin(share, 1 - share));
        found->cut++;
    }
}

static void test_a_ball(void **state)
{
    (void)state;
    const double low[3] = {-0.3, -0.3, -0.3}, high[3] = {0.3, 0.3, 0.3}, radius = 0.3;
    scene_lattice l;
    census found = {.nearest_long = 1, .nearest_short = 1};
    int at[3], points = 0;
    assert_int_equal(scene_lattice_init(&l, in_ball, &radius, low, high, 0.047, "test", NULL), CIPC_OK);
    for (int middle = 0; middle < 2; middle++) {
        for (at[1] = 0; at[1] + middle < l.count[1]; at[1]++) {
            for (at[2] = 0; at[2] + middle < l.count[2]; at[2]++) {
                for (at[0] = 0; at[0] + middle < l.count[0]; at[0]++, points++) look(&l, middle, at, radius, &found);
            }
        }
    }
    scene_lattice_free(&l);
    assert_int_equal(points, 16 * 16 * 16 + 15 * 15 * 15); /* 13 cells across, and one more at each side */
    assert_true(found.moved > 400 && found.cut > 300 && found.inside > 1500);
    assert_true(found.nearest_long > 0.24999 && found.nearest_short > 0.41189);
}

static void test_too_many_points(void **state)
{
    (void)state;
    const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, radius = 1;
    scene_lattice l;
    assert_int_equal(scene_lattice_init(&l, in_ball, &radius, low, high, 1e-3, "test", NULL), CIPC_E_OUT_OF_RANGE);
    scene_lattice_free(&l);
    assert_int_equal(scene_lattice_init(&l, in_ball, &radius, low, high, 1e-300, "test", NULL), CIPC_E_OUT_OF_RANGE);
    scene_lattice_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_ball),
        cmocka_unit_test(test_too_many_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
