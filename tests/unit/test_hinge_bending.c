/* Hinge: the signed angle, the two constants of SPEC F1 against the plate theory of a cylinder, forces of simple folds. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/energy.h"

enum { SIZE = 12 };
static const double PI = 3.14159265358979323846;

/* Some twenty operations on numbers of size one. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static const double flat[SIZE] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -2, 0};

/* The flat hinge with its second triangle folded by the angle theta, downwards for theta > 0. */
static void fold(double theta, double x[SIZE])
{
    memcpy(x, flat, sizeof flat);
    x[10] = -2 * cos(theta);
    x[11] = -2 * sin(theta);
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_angle_of_a_fold(void **state)
{
    (void)state;
    const double angles[] = {1e-12, 1e-4, 0.5, 1.5, 3, 3.1415};
    double x[SIZE];
    assert_true(cipc_hinge_angle(flat) == 0);
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        fold(angles[i], x);
        assert_relative(cipc_hinge_angle(x), angles[i], ROUNDINGS);
        fold(-angles[i], x);
        assert_relative(cipc_hinge_angle(x), -angles[i], ROUNDINGS);
    }
}

static void test_angle_agrees_with_its_definition(void **state)
{
    (void)state;
    /* theta = atan2(e.(n1 x n2)/|e|, n1.n2) with the cross product written out, on a general stencil. */
    const double x[SIZE] = {0.1, -0.2, 0.3, 1.2, 0.1, 0.2, 0.4, 1.1, 0.5, 0.7, -0.9, -0.6};
    double e[3], a[3], b[3], n1[3], n2[3], c[3];
    for (int k = 0; k < 3; k++) {
        e[k] = x[3 + k] - x[k];
        a[k] = x[6 + k] - x[k];
        b[k] = x[9 + k] - x[3 + k];
    }
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        n1[k] = e[l] * a[m] - e[m] * a[l];
        n2[k] = -(e[l] * b[m] - e[m] * b[l]);
    }
    for (int k = 0; k < 3; k++) c[k] = n1[(k + 1) % 3] * n2[(k + 2) % 3] - n1[(k + 2) % 3] * n2[(k + 1) % 3];
    double length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    double sine = (e[0] * c[0] + e[1] * c[1] + e[2] * c[2]) / length, cosine = n1[0] * n2[0] + n1[1] * n2[1] + n1[2] * n2[2];
    assert_relative(cipc_hinge_angle(x), atan2(sine, cosine), ROUNDINGS);
}

static void test_initial_constants(void **state)
{
    (void)state;
    cipc_hinge_bending plate, cipc;
    double rest[SIZE], t = 0.01, young = 1e6, poisson = 0.5;
    fold(0.25, rest);
    cipc_hinge_bending_init(&plate, rest, t, young, poisson, false);
    cipc_hinge_bending_init(&cipc, rest, t, young, poisson, true);
    /* A1 = 1/2, A2 = 1, ebar = 1: w = 3 * 1/(3/2) = 2 */
    double D = young * t * t * t / (12 * 0.75);
    assert_relative(plate.stiffness, D / 6 * 2, ROUNDINGS);
    assert_relative(cipc.stiffness, D / 2 * 2, ROUNDINGS);
    assert_relative(plate.rest_angle, 0.25, ROUNDINGS);
    /* At rest neither energy nor force. */
    double g[SIZE];
    assert_true(cipc_hinge_bending_value(rest, &plate) == 0);
    cipc_hinge_bending_gradient(rest, &plate, g);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
}

/* w = 3 ebar^2/(A1 + A2) has no unit: the same shape at any size has the same constant. (A lost length of the edge is a known bug of the field.) */
static void test_the_constant_knows_no_size(void **state)
{
    (void)state;
    double rest[SIZE], scaled[SIZE];
    fold(0.25, rest);
    for (int i = 0; i < SIZE; i++) scaled[i] = 0.125 * rest[i];
    cipc_hinge_bending large, small;
    cipc_hinge_bending_init(&large, rest, 0.01, 1e6, 0.5, true);
    cipc_hinge_bending_init(&small, scaled, 0.01, 1e6, 0.5, true);
    assert_relative(small.stiffness, large.stiffness, ROUNDINGS);
}

static void test_value_of_a_fold(void **state)
{
    (void)state;
    const cipc_hinge_bending params = {.stiffness = 3, .rest_angle = -0.5};
    double x[SIZE];
    fold(1, x);
    assert_relative(cipc_hinge_bending_value(x, &params), 3 * 1.5 * 1.5, ROUNDINGS);
}

static void test_angle_difference_is_not_wrapped(void **state)
{
    (void)state;
    /* A rest angle of -3 and an angle of 3 are 6 apart, not 2 pi - 6: the way through a full fold is closed. */
    const cipc_hinge_bending params = {.stiffness = 1, .rest_angle = -3};
    double x[SIZE];
    fold(3, x);
    assert_relative(cipc_hinge_bending_value(x, &params), 36, ROUNDINGS);
}

static void test_force_of_a_fold(void **state)
{
    (void)state;
    /* dE/dtheta = 2 k (theta - thetabar); the wing tip's arm is its height: |dE/dx3| = 2 k theta / 2, upwards for a fold downwards. */
    const cipc_hinge_bending params = {.stiffness = 3, .rest_angle = 0};
    double x[SIZE], g[SIZE], theta = 0.5;
    fold(theta, x);
    cipc_hinge_bending_gradient(x, &params, g);
    double size = 2 * 3 * theta / 2;
    assert_true(fabs(g[9]) <= ROUNDINGS);
    assert_relative(g[10], size * sin(theta), ROUNDINGS);
    assert_relative(g[11], -size * cos(theta), ROUNDINGS);
    assert_relative(g[8], -2 * 3 * theta / 1, ROUNDINGS); /* the other tip, height 1 */
}

static void test_flat_hinge_with_curved_rest_shape_feels_its_moment(void **state)
{
    (void)state;
    /* Where acos has no derivative. */
    const cipc_hinge_bending params = {.stiffness = 1, .rest_angle = 0.5};
    double g[SIZE];
    cipc_hinge_bending_gradient(flat, &params, g);
    assert_relative(g[8], 1, ROUNDINGS);    /* -2 k (0 - 0.5) / height 1 */
    assert_relative(g[11], 0.5, ROUNDINGS); /* height 2 */
}

/* dV = 2 k w (theta - thetabar) dtheta, component by component; and along the fold, which turns at one radian a radian, the angle gains one. */
static void test_gradient_of_the_angle(void **state)
{
    (void)state;
    const cipc_hinge_bending params = {.stiffness = 0.7, .rest_angle = 0.2};
    double x[SIZE], angle[SIZE], force[SIZE];
    fold(1.1, x);
    cipc_hinge_angle_gradient(x, angle);
    cipc_hinge_bending_gradient(x, &params, force);
    for (int i = 0; i < SIZE; i++) assert_true(fabs(force[i] - 2 * 0.7 * (1.1 - 0.2) * angle[i]) <= ROUNDINGS);
    assert_relative(angle[10] * 2 * sin(1.1) - angle[11] * 2 * cos(1.1), 1, ROUNDINGS);
}

static void test_hessian_of_the_flat_hinge(void **state)
{
    (void)state;
    /* At theta = thetabar only 2 k g g^T is left: the tips' entries are 2 k / (height height'). */
    const cipc_hinge_bending params = {.stiffness = 1, .rest_angle = 0};
    double H[SIZE * SIZE];
    cipc_hinge_bending_hessian(flat, &params, H);
    assert_relative(H[8 * SIZE + 8], 2, ROUNDINGS);
    assert_relative(H[11 * SIZE + 11], 0.5, ROUNDINGS);
    assert_relative(H[8 * SIZE + 11], 1, ROUNDINGS);
    assert_true(H[7 * SIZE + 7] == 0 && H[10 * SIZE + 10] == 0);
}

static void test_collapsed_triangles_are_infeasible(void **state)
{
    (void)state;
    const cipc_hinge_bending params = {.stiffness = 1, .rest_angle = 0};
    double x[SIZE];
    memcpy(x, flat, sizeof flat);
    x[7] = 0; /* node 2 on the edge */
    assert_true(cipc_hinge_bending_value(x, &params) == INFINITY);
    memcpy(x, flat, sizeof flat);
    x[10] = 0; /* node 3 on the edge */
    assert_true(cipc_hinge_bending_value(x, &params) == INFINITY);
    memcpy(x, flat, sizeof flat);
    x[3] = 0; /* no edge */
    assert_true(cipc_hinge_bending_value(x, &params) == INFINITY);
}

/* --- the plate: an equilateral mesh on a cylinder --- */

/* The point (u, v) of the plane rolled onto a cylinder of the given radius whose axis stands at the angle `axis` in the plane. */
static void roll(double u, double v, double axis, double radius, double x[3])
{
    double along = u * cos(axis) + v * sin(axis), across = -u * sin(axis) + v * cos(axis);
    x[0] = along;
    x[1] = radius * sin(across / radius);
    x[2] = -2 * radius * sin(across / (2 * radius)) * sin(across / (2 * radius));
}

/* Bending energy per area of the equilateral mesh of unit edges. A node owns three hinges and the area sqrt(3)/2. */
static double energy_density(double axis, double radius, bool cipc_constant)
{
    double sum = 0;
    for (int h = 0; h < 3; h++) {
        double rest[SIZE] = {0}, x[SIZE], turn = PI / 3;
        const double corner[4][2] = {
            {0, 0}, {cos(h * turn), sin(h * turn)}, {cos((h + 1) * turn), sin((h + 1) * turn)}, {cos((h - 1) * turn), sin((h - 1) * turn)}};
        cipc_hinge_bending params;
        for (int i = 0; i < 4; i++) {
            rest[3 * i] = corner[i][0];
            rest[3 * i + 1] = corner[i][1];
            roll(corner[i][0], corner[i][1], axis, radius, x + 3 * i);
        }
        cipc_hinge_bending_init(&params, rest, 0.1, 12000 * 0.91, 0.3, cipc_constant); /* D = 1 */
        sum += cipc_hinge_bending_value(x, &params);
    }
    return sum / (sqrt(3) / 2);
}

static void test_cylinder_on_an_equilateral_mesh(void **state)
{
    (void)state;
    /* Plate theory: D/2 per area and squared curvature, D = 1. The mesh's error is of order (edge/radius)^2 = 1e-6. */
    static const double RADIUS = 1000, MESH_ERROR = 1e-5;
    for (int i = 0; i < 8; i++) {
        double axis = i * PI / 8, plate = 0.5 / (RADIUS * RADIUS);
        assert_relative(energy_density(axis, RADIUS, false), plate, MESH_ERROR);
        assert_relative(energy_density(axis, RADIUS, true), 3 * plate, MESH_ERROR);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_angle_of_a_fold),
        cmocka_unit_test(test_angle_agrees_with_its_definition),
        cmocka_unit_test(test_initial_constants),
        cmocka_unit_test(test_the_constant_knows_no_size),
        cmocka_unit_test(test_value_of_a_fold),
        cmocka_unit_test(test_angle_difference_is_not_wrapped),
        cmocka_unit_test(test_force_of_a_fold),
        cmocka_unit_test(test_flat_hinge_with_curved_rest_shape_feels_its_moment),
        cmocka_unit_test(test_gradient_of_the_angle),
        cmocka_unit_test(test_hessian_of_the_flat_hinge),
        cmocka_unit_test(test_collapsed_triangles_are_infeasible),
        cmocka_unit_test(test_cylinder_on_an_equilateral_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
