/* Rod bending: curvature of a turn, circles, the cantilever of beam theory, rest curvature with and without its cone, what is infeasible. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/energy.h"

enum { SIZE = 9 };
static const double PI = 3.14159265358979323846;

/* Some twenty operations on numbers of size one. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static const double straight[SIZE] = {-1, 0, 0, 0, 0, 0, 2, 0, 0};

/* Segments of lengths 1 and 2 that turn by the angle phi to the left. */
static void turn(double phi, double x[SIZE])
{
    memcpy(x, straight, sizeof straight);
    x[6] = 2 * cos(phi);
    x[7] = 2 * sin(phi);
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* k (2 tan(phi/2) - kbar)^2, to all digits of small turns; of turns near pi what the rounding of x leaves, u/(pi - phi). */
static void test_value_of_a_turn(void **state)
{
    (void)state;
    const double angles[] = {1e-12, 1e-4, 0.5, 1.5, 1.6, 3, 3.1415};
    const cipc_rod_bending soft = {.stiffness = 3}, curved = {.stiffness = 3, .rest_curvature = 5};
    double x[SIZE];
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        double kappa = 2 * tan(angles[i] / 2), tolerance = ROUNDINGS * (1 + 1 / (PI - angles[i]));
        turn(angles[i], x);
        assert_relative(cipc_rod_bending_value(x, &soft), 3 * kappa * kappa, tolerance);
        assert_relative(cipc_rod_bending_value(x, &curved), 3 * (kappa - 5) * (kappa - 5), tolerance * (1 + kappa / fabs(kappa - 5)));
        turn(-angles[i], x);
        assert_relative(cipc_rod_bending_value(x, &soft), 3 * kappa * kappa, tolerance);
    }
    assert_true(cipc_rod_bending_value(straight, &soft) == 0);
}

static void test_initial_constants(void **state)
{
    (void)state;
    double rest[SIZE], d = 1.5e-3, young = 1e3;
    cipc_rod_bending soft, curved;
    turn(0.25, rest);
    assert_true(cipc_rod_bending_init(&soft, rest, d, young, false));
    assert_true(cipc_rod_bending_init(&curved, rest, d, young, true));
    assert_relative(soft.stiffness, young * PI * d * d * d * d / 64 / 3, ROUNDINGS);
    assert_true(curved.stiffness == soft.stiffness && soft.rest_curvature == 0);
    assert_relative(curved.rest_curvature, 2 * tan(0.125), ROUNDINGS);
    /* At rest neither energy nor force. */
    double g[SIZE];
    assert_true(cipc_rod_bending_value(rest, &curved) == 0);
    cipc_rod_bending_gradient(rest, &curved, g);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    const double none[SIZE] = {0, 0, 0, 0, 0, 0, 2, 0, 0}, folded[SIZE] = {1, 0, 0, 0, 0, 0, 2, 0, 0};
    assert_false(cipc_rod_bending_init(&curved, none, d, young, false));
    assert_false(cipc_rod_bending_init(&curved, folded, d, young, true));
}

/* A regular polygon of n corners around a circle of radius R: E I/(2 R^2) per length, 2 tan(pi/n) standing for the angle 2 pi/n: relative error (pi/n)^2 2/3
 * by the tangent, and as much by chords instead of arcs. */
static void test_circle(void **state)
{
    (void)state;
    enum { CORNERS = 1000 };
    static const double RADIUS = 0.5, MESH_ERROR = 2 * 2 * 9.87 / 3 / CORNERS / CORNERS;
    double sum = 0, young = 2e6, d = 1e-3, turning = 2 * PI / CORNERS, edge = 2 * RADIUS * sin(turning / 2);
    const double rest[SIZE] = {0, 0, 0, edge, 0, 0, 2 * edge, 0, 0};
    cipc_rod_bending p;
    assert_true(cipc_rod_bending_init(&p, rest, d, young, false));
    for (int c = 0; c < CORNERS; c++) {
        double x[SIZE];
        for (int i = 0; i < 3; i++) {
            x[3 * i] = 1;
            x[3 * i + 1] = RADIUS * cos((c + i) * turning);
            x[3 * i + 2] = RADIUS * sin((c + i) * turning);
        }
        sum += cipc_rod_bending_value(x, &p);
    }
    assert_relative(sum, young * PI * pow(d, 4) / 64 / (2 * RADIUS * RADIUS) * 2 * PI * RADIUS, MESH_ERROR);
}

/* The energy of a joint is E I kappa^2/2 over half of both segments, kappa = 2 |kb|/(l0 + l1), whatever their lengths (SPEC C.6). */
static void test_uneven_segments(void **state)
{
    (void)state;
    double x[SIZE], EI = 1e6 * PI * pow(0.01, 4) / 64, curvature = 2 * (2 * tan(0.2)) / 3;
    cipc_rod_bending p;
    assert_true(cipc_rod_bending_init(&p, straight, 0.01, 1e6, false));
    turn(0.4, x);
    assert_relative(cipc_rod_bending_value(x, &p), EI * curvature * curvature / 2 * 3 / 2, ROUNDINGS);
}

/* A cantilever of n segments of length l under the force F at its tip, by the Hessian of the straight rod: each joint turns by M l/(E I), M = F (L - x), so
 * the shape is known in closed form, and its tip sinks by F L^3/(3 E I) (1 - 3/(2n) + 1/(2n^2)): beam theory, without any further factor, as n grows. */
static void test_cantilever(void **state)
{
    (void)state;
    enum { SEGMENTS = 200, NODES = SEGMENTS + 1 };
    double l = 1.0 / SEGMENTS, EI = 1e9 * PI * pow(0.01, 4) / 64, F = 1e-3, slope = 0, u[NODES] = {0}, force[NODES] = {0}, H[SIZE * SIZE];
    const double rest[SIZE] = {0, 0, 0, l, 0, 0, 2 * l, 0, 0};
    cipc_rod_bending p;
    assert_true(cipc_rod_bending_init(&p, rest, 0.01, 1e9, false));
    cipc_rod_bending_hessian(rest, &p, H);
    for (int i = 1; i < SEGMENTS; i++) { /* nodes 0 and 1 are clamped */
        slope += F * (SEGMENTS - i) * l * l / EI;
        u[i + 1] = u[i] + slope * l;
    }
    for (int i = 1; i < SEGMENTS; i++) {
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) force[i - 1 + a] += H[SIZE * (3 * a + 2) + 3 * b + 2] * u[i - 1 + b];
        }
    }
    /* Forces are third differences of u: digits of u / l^3. */
    double noise = 64 * DBL_EPSILON * EI * u[SEGMENTS] / (l * l * l);
    assert_true(noise < 1e-3 * F);
    for (int i = 2; i < SEGMENTS; i++) assert_true(fabs(force[i]) <= noise);
    assert_true(fabs(force[SEGMENTS] - F) <= noise);
    assert_relative(u[SEGMENTS], F / (3 * EI) * (1 - 1.5 / SEGMENTS + 0.5 / SEGMENTS / SEGMENTS), 1e4 * ROUNDINGS); /* sums of 200 terms, twice */
    /* The deflections were made of theory; this one alone is beam theory's. */
    assert_relative(u[SEGMENTS], F / (3 * EI), 1.5 / SEGMENTS);
}

/* dE/dphi = 2 k (kappa - kbar) (1 + kappa^2/4), over the lever of each end. */
static void test_force_of_a_turn(void **state)
{
    (void)state;
    const cipc_rod_bending params = {.stiffness = 3, .rest_curvature = 0.5};
    double x[SIZE], g[SIZE], phi = 1.25, kappa = 2 * tan(phi / 2), torque = 2 * 3 * (kappa - 0.5) * (1 + kappa * kappa / 4);
    turn(phi, x);
    cipc_rod_bending_gradient(x, &params, g);
    assert_true(fabs(g[0]) <= ROUNDINGS * torque);
    assert_relative(g[1], torque, ROUNDINGS);
    assert_relative(g[6], -torque / 2 * sin(phi), ROUNDINGS);
    assert_relative(g[7], torque / 2 * cos(phi), ROUNDINGS);
    assert_true(g[2] == 0 && g[5] == 0 && g[8] == 0);
}

/* The straight rod is soft alike in both directions across: 2 k d d^T, d = (1/a, -1/a - 1/b, 1/b). */
static void test_hessian_of_the_straight_rod(void **state)
{
    (void)state;
    const cipc_rod_bending params = {.stiffness = 1};
    const double d[3] = {1, -1.5, 0.5};
    double H[SIZE * SIZE];
    cipc_rod_bending_hessian(straight, &params, H);
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) assert_true(H[SIZE * i + j] == (i % 3 == j % 3 && i % 3 != 0 ? 2 * d[i / 3] * d[j / 3] : 0));
    }
}

/* Which way a straight rod with a curved rest shape would turn nobody knows: no force, and the Hessian of the rod that is straight at rest. Beside it a
 * force of 2 k kbar pushes away from straight. */
static void test_cone_of_the_rest_curvature(void **state)
{
    (void)state;
    const cipc_rod_bending soft = {.stiffness = 1}, curved = {.stiffness = 1, .rest_curvature = 0.5};
    double g[SIZE], H[SIZE * SIZE], want[SIZE * SIZE], x[SIZE];
    assert_true(cipc_rod_bending_value(straight, &curved) == 0.25);
    cipc_rod_bending_gradient(straight, &curved, g);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    cipc_rod_bending_hessian(straight, &curved, H);
    cipc_rod_bending_hessian(straight, &soft, want);
    assert_memory_equal(H, want, sizeof H);
    for (int side = -1; side <= 1; side += 2) {
        turn(side * 1e-9, x);
        cipc_rod_bending_gradient(x, &curved, g);
        assert_relative(g[7], -side * 0.5, 1e-8); /* 2 k kbar / 2, but for kappa / kbar = 2e-9 */
    }
}

/* The rest curvature has no plane: turned about the first segment, the joint is as bent as before. */
static void test_any_plane_will_do(void **state)
{
    (void)state;
    const cipc_rod_bending curved = {.stiffness = 2, .rest_curvature = 0.5};
    for (int k = 0; k < 8; k++) {
        const double x[SIZE] = {-1, 0, 0, 0, 0, 0, cos(1), sin(1) * cos(k), sin(1) * sin(k)};
        double bend = 2 * tan(0.5) - 0.5;
        assert_relative(cipc_rod_bending_value(x, &curved), 2 * bend * bend, ROUNDINGS);
    }
}

static void test_infeasible(void **state)
{
    (void)state;
    const cipc_rod_bending params = {.stiffness = 1, .rest_curvature = 0.5};
    const double folded[SIZE] = {1, 0, 0, 0, 0, 0, 2, 0, 0}, no_first[SIZE] = {0, 0, 0, 0, 0, 0, 2, 0, 0}, no_second[SIZE] = {1, 0, 0, 0, 0, 0, 0, 0, 0};
    assert_true(cipc_rod_bending_value(folded, &params) == INFINITY);
    assert_true(cipc_rod_bending_value(no_first, &params) == INFINITY);
    assert_true(cipc_rod_bending_value(no_second, &params) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value_of_a_turn),
        cmocka_unit_test(test_initial_constants),
        cmocka_unit_test(test_circle),
        cmocka_unit_test(test_uneven_segments),
        cmocka_unit_test(test_cantilever),
        cmocka_unit_test(test_force_of_a_turn),
        cmocka_unit_test(test_hessian_of_the_straight_rod),
        cmocka_unit_test(test_cone_of_the_rest_curvature),
        cmocka_unit_test(test_any_plane_will_do),
        cmocka_unit_test(test_infeasible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
