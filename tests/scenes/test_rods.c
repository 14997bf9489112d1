/* Rods against closed forms (SPEC E8, E9, E12): the cantilever under its own weight at small and at large deflection, the ring, the catenary; each with its order of convergence. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/elastica.h"
#include "support/sheet_scene.h"
#include "support/validation.h"

static const double pi = 3.14159265358979323846, young = 1e7, diameter = 5e-3;

static double rigidity(void) { return young * pi * diameter * diameter * diameter * diameter / 64; }
static double section(void) { return pi * diameter * diameter / 4; }

/* A rod through n + 1 points, with or without bending; nothing is held yet. */
static void make(sheet_scene *scene, int n, const double *x, bool bends, double density)
{
    int(*segments)[2] = malloc((size_t)n * sizeof *segments);
    assert_non_null(segments);
    for (int i = 0; i < n; i++) {
        segments[i][0] = i;
        segments[i][1] = i + 1;
    }
    sheet_scene_init(scene);
    const cipc_body_description body = {.name = "rod", .kind = CIPC_BODY_RODS, .node_count = n + 1, .rest = x, .position = x, .segment_count = n, .segments = (const int(*)[2])segments,
                                        .material = {.density = density, .thickness = diameter, .young = young, .bending_young = bends ? young : 0}};
    sheet_add(scene, &body);
    free(segments);
    scene->options.quasistatic = true;
    scene->options.newton_tolerance = 1e-7;
    scene->options.newton_iterations = 5000;
}

/* Deflection of the tip, over the length 1, of a cantilever whose weight is gamma EI/L^3. The clamp is the middle of the first segment, whose two nodes are held: the first joint
 * then stands for the curvature of the first full segment's length, as all others do. */
static double cantilever(int n, double gamma)
{
    sheet_scene scene;
    double h = 1 / (n - 0.5), *x = calloc(3 * (size_t)(n + 1), sizeof *x);
    const int held[2] = {0, 1};
    assert_non_null(x);
    for (int i = 0; i <= n; i++) x[3 * i] = (i - 0.5) * h;
    make(&scene, n, x, true, 1000);
    scene.gravity[1] = -gamma * rigidity() / (1000 * section());
    sheet_scene_model(&scene);
    sheet_hold(&scene, held, 2, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_step(&scene);
    double tip = -scene.state->position[3 * n + 1];
    sheet_scene_free(&scene);
    free(x);
    return tip;
}

/* Errors at n, 2n, 4n: the last is reported, the ratio of the last two tells the order. */
static void assert_second_order(const char *name, double (*measure)(int, double), double load, double expected, double tolerance)
{
    double error[3], measured = 0;
    for (int k = 0; k < 3; k++) {
        measured = measure(8 << k, load);
        error[k] = fabs(measured - expected);
        validation_point("rod-convergence", name, 8 << k, error[k] / expected);
    }
    double order = log2(error[1] / error[2]);
    validation_row(name, "tip deflection / length", expected, measured, tolerance);
    validation_row(name, "order of convergence", 2, order, 0.15);
}

/* The same chain in linear theory, exactly: joint j, at node j = 1..n-1, turns by M h/EI under the moment M of the nodes beyond it, node i weighing w h, the last one half of that. */
static double linear_chain(int n, double gamma)
{
    double h = 1 / (n - 0.5), tip = 0;
    for (int j = 1; j < n; j++) {
        double moment = 0;
        for (int i = j + 1; i <= n; i++) moment += gamma * h * (i == n ? 0.5 : 1) * (i - j) * h;
        tip += moment * h * (n - j) * h;
    }
    return tip;
}

static void test_small_deflection(void **state)
{
    (void)state;
    const double gamma = 0.01;
    /* What linear theory leaves out is of the square of the slope, gamma/6, and the rod's stretch, (d/4)^2 of its bending: 3e-6 and 2e-6. */
    validation_row("rod cantilever, small load, 32 segments (E9)", "tip deflection, of the chain in linear theory", linear_chain(32, gamma), cantilever(32, gamma), 1e-5);
    assert_second_order("rod cantilever, small load (E9)", cantilever, gamma, gamma / 8, 3e-3);
}

static void test_large_deflection(void **state)
{
    (void)state;
    double depth = elastica_tip(20);
    for (double load = 0.5; load < 25; load += 0.5) validation_point("elastica", "elastica", load, elastica_tip(load));
    for (double load = 2; load < 25; load += 4) validation_point("elastica", "rod of 16 segments", load, cantilever(16, load));
    assert_true(depth > 0.6 && depth < 1); /* far from linear: 2.5 */
    assert_second_order("rod cantilever, heavy elastica, w L^3/EI = 20 (E9)", cantilever, 20, depth, 5e-3);
}

/* A straight rod bent to a closed polygon of n sides: energy 2 pi^2 EI/L in the limit, and equilibrium by symmetry. */
static double ring_energy(int n, double unused)
{
    (void)unused;
    cipc_rod_bending joint;
    double h = 1.0 / n, turn = 2 * pi / n;
    const double rest[9] = {-h, 0, 0, 0, 0, 0, h, 0, 0}, bent[9] = {-h, 0, 0, 0, 0, 0, h * cos(turn), h * sin(turn), 0};
    assert_true(cipc_rod_bending_init(&joint, rest, diameter, young, false));
    return n * cipc_rod_bending_value(bent, &joint) / rigidity();
}

static void test_ring(void **state)
{
    (void)state;
    double error[2];
    for (int k = 0; k < 2; k++) error[k] = ring_energy(64 << k, 0) - 2 * pi * pi;
    validation_row("rod bent to a ring (E12)", "energy L/EI", 2 * pi * pi, ring_energy(128, 0), 1e-3);
    validation_row("rod bent to a ring (E12)", "order of convergence", 2, log2(error[0] / error[1]), 0.02);
}

/* a of the catenary y = a cosh(x/a): half the span over it is u with sinh(u)/u = L/D, by bisection. */
static double catenary_parameter(double length, double span)
{
    double low = 1e-9, high = 20;
    for (int k = 0; k < 100; k++) {
        double u = 0.5 * (low + high);
        if (sinh(u) / u < length / span) low = u;
        else high = u;
    }
    return span / (2 * low);
}

typedef struct chain {
    double sag;                      /* m, of the middle node */
    double horizontal, end;          /* N: horizontal part of the tension of the first segment, and that tension, at its middle */
    double weight;                   /* N/m */
} chain;

/* A chain of n segments, length 1, between points 0.8 apart; it starts as two straight halves. */
static chain hang_chain(int n, double span)
{
    sheet_scene scene;
    double depth = sqrt(0.25 - 0.25 * span * span), *x = calloc(3 * (size_t)(n + 1), sizeof *x);
    const int held[2] = {0, n};
    assert_non_null(x);
    for (int i = 0; i <= n; i++) {
        double t = (double)i / n;
        x[3 * i] = span * (t - 0.5);
        x[3 * i + 1] = -depth * (1 - fabs(2 * t - 1));
    }
    make(&scene, n, x, false, 1000);
    scene.gravity[1] = -9.81;
    sheet_scene_model(&scene);
    sheet_hold(&scene, held, 2, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_step(&scene);
    const double *y = scene.state->position, along = y[3] - y[0], length = hypot(along, y[4] - y[1]);
    double tension = young * section() * (length * n - 1);
    chain c = {-y[3 * (n / 2) + 1], tension * along / length, tension, 1000 * section() * 9.81};
    sheet_scene_free(&scene);
    free(x);
    return c;
}

/* The chain is as good as inextensible: it stretches by some rho g L/E = 1e-3. The tension at the middle of the first segment is less than that of the end by w times half its drop. */
static void test_catenary(void **state)
{
    (void)state;
    enum { SEGMENTS = 64 };
    double a = catenary_parameter(1, 0.8), sag = a * (cosh(0.8 / (2 * a)) - 1);
    chain c = hang_chain(SEGMENTS, 0.8);
    double half_drop = 0.5 / SEGMENTS * sqrt(1 - c.horizontal * c.horizontal / (c.end * c.end));
    validation_row("hanging chain (E8)", "sag / length", sag, c.sag, 2e-3);
    validation_row("hanging chain (E8)", "horizontal tension / w a", 1, c.horizontal / (c.weight * a), 4e-3);
    validation_row("hanging chain (E8)", "tension at the end / w (a + sag)", 1, (c.end / c.weight + half_drop) / (a + sag), 4e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_deflection),
        cmocka_unit_test(test_large_deflection),
        cmocka_unit_test(test_ring),
        cmocka_unit_test(test_catenary),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
