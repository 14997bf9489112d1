/* Shells against closed forms (SPEC E9, F1): a plate of equilateral triangles clamped at one side, with both hinge constants, at small load and under refinement; E7: a strip with a
 * strain limit under any weight. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/elastica.h"
#include "support/sheet_scene.h"
#include "support/validation.h"

static const double young = 1e6, thickness = 1e-2, density = 100;

typedef struct strip {
    int nodes, triangles, held_count;
    double *x;
    int (*triangle)[3];
    int *held;
} strip;

/* `rows` + 1 columns of nodes a row height apart along x, every other one shifted by half an edge along z: equilateral triangles, width 1. x starts in the middle of the first row, which is
 * held: the clamp. */
static strip make_strip(int rows, int across)
{
    strip s = {0};
    double height = 1 / (rows - 0.5), edge = height / (0.5 * sqrt(3));
    s.x = malloc(3 * (size_t)(rows + 1) * (size_t)(across + 2) * sizeof *s.x);
    s.triangle = malloc(2 * (size_t)rows * (size_t)(across + 1) * sizeof *s.triangle);
    s.held = malloc(2 * (size_t)(across + 2) * sizeof *s.held);
    assert_true(s.x && s.triangle && s.held);
    int previous = 0;
    for (int i = 0; i <= rows; i++) {
        int count = across + 1, first = s.nodes;
        for (int j = 0; j < count; j++) {
            const double p[3] = {(i - 0.5) * height, 0, (j + (i % 2 ? 0.5 : 0)) * edge};
            if (i < 2) s.held[s.held_count++] = s.nodes;
            memcpy(s.x + 3 * s.nodes++, p, sizeof p);
        }
        for (int j = 0; i > 0 && j < across; j++) {
            int a = previous + j, b = first + j;
            const int odd[2][3] = {{a, b, a + 1}, {a + 1, b, b + 1}}, even[2][3] = {{a, b, b + 1}, {a, b + 1, a + 1}};
            memcpy(s.triangle[s.triangles], i % 2 ? odd : even, sizeof odd);
            s.triangles += 2;
        }
        previous = first;
    }
    return s;
}

/* Mean deflection of the free side, over the length, under a weight of gamma D/L^3 an area. */
static double deflection(int rows, cipc_hinge_constant constant, double gamma)
{
    sheet_scene scene;
    double rigidity = young * thickness * thickness * thickness / 12, sum = 0;
    int across = (int)lround(2 * rows * 0.5 * sqrt(3));
    strip s = make_strip(rows, across);
    sheet_scene_init(&scene);
    cipc_body_description *body = sheet_add_body(&scene, "plate", s.nodes, s.x, s.triangles, (const int(*)[3])s.triangle);
    body->material = (cipc_material){.density = density, .thickness = thickness, .membrane = CIPC_MEMBRANE_STVK, .membrane_young = young, .bending_young = young, .hinge_constant = constant};
    scene.gravity[1] = -gamma * rigidity / (density * thickness);
    scene.options.quasistatic = true;
    scene.options.newton_tolerance = 1e-7;
    sheet_scene_model(&scene);
    sheet_hold(&scene, s.held, s.held_count, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_step(&scene);
    for (int j = 0; j <= across; j++) sum -= scene.state->position[3 * (s.nodes - 1 - j) + 1];
    sheet_scene_free(&scene);
    free(s.x);
    free(s.triangle);
    free(s.held);
    return sum / (across + 1);
}

/* F1: bent to a cylinder, "plate" has the rigidity of the plate and "cipc" three times as much. The free sides let the sheet relax a little from the cylinder: the hinges of
 * equilateral triangles resist like a material of Poisson's ratio 1/3, whatever nu says, so that a narrow strip would deflect like one of 1 - 1/9 of the rigidity. This one is twice as wide as
 * long. The limit of refinement is between the two; meshes of 8, 16 and 32 rows approach it with their own order, from the differences of neighbours. */
static void assert_cantilever(const char *load, double gamma, double (*tip)(double), double most_change)
{
    static const char *const constants[2] = {"plate", "cipc"};
    for (int c = 0; c < 2; c++) {
        char name[96];
        double found[3], rigidity = c ? 3 : 1, cylinder = tip(gamma), narrow = tip(gamma * 9 / 8);
        (void)snprintf(name, sizeof name, "plate of equilateral triangles, %s (E9), constant \"%s\"", load, constants[c]);
        for (int k = 0; k < 3; k++) found[k] = deflection(8 << k, (cipc_hinge_constant)c, rigidity * gamma);
        validation_row(name, "tip deflection / length, bent to a cylinder", cylinder, found[2], 0.03);
        validation_range(name, "the same, between cylinder and narrow strip", cylinder, narrow, found[2]);
        validation_range(name, "change from 8 to 16 rows / deflection", 0, most_change, fabs(found[1] - found[0]) / cylinder);
        validation_range(name, "order of convergence, from the changes under refinement", 1.5, 3, log2(fabs(found[0] - found[1]) / fabs(found[1] - found[2])));
    }
}

static double linear_tip(double gamma) { return gamma / 8; }

static void test_small_deflection(void **state)
{
    (void)state;
    assert_cantilever("small load", 1e-3, linear_tip, 0.005);
}

static void test_large_deflection(void **state)
{
    (void)state;
    assert_cantilever("w L^3/D = 10", 10, elastica_tip, 0.01);
}

/* At the same load: three times the rigidity, a third of the deflection. */
static void test_two_constants(void **state)
{
    (void)state;
    validation_row("plate of equilateral triangles, small load (E9)", "ratio of the two constants' deflections", 3, deflection(16, CIPC_HINGE_PLATE, 1e-3) / deflection(16, CIPC_HINGE_CIPC, 1e-3), 1e-3);
}

/* w t [E (s^2 - 1)/2 s] + kappa w t b'(s) = W for a triangle that hangs from one side and stretches straight down (nu = 0): s < limit for any W. */
static double expected_stretch(double stress, double limit, double stiffness)
{
    double low = 1, high = limit;
    for (int k = 0; k < 200; k++) {
        double s = 0.5 * (low + high), b[3];
        if (!(s > low && s < high)) break;
        cipc_strain_limit_barrier(s, limit, 1, b);
        if (young * (s * s - 1) / 2 * s + stiffness * b[1] < stress) low = s;
        else high = s;
    }
    return low;
}

static void test_limited_strip(void **state)
{
    (void)state;
    const double limit = 1.05, stiffness = 1e3, a[3] = {-0.5, 0, 0}, b[3] = {0.5, 0, 0}, c[3] = {0, -1, 0};
    const int held[2] = {0, 1};
    for (int decade = 0; decade <= 6; decade += 2) {
        sheet_scene scene;
        char quantity[64];
        double weight = pow(10, decade);
        sheet_scene_init(&scene);
        cipc_body_description *body = sheet_add_triangle(&scene, "strip", a, b, c);
        body->material = (cipc_material){.density = density, .thickness = thickness, .membrane = CIPC_MEMBRANE_STVK, .membrane_young = young, .strain_limit = limit, .strain_activation = 1, .strain_stiffness = stiffness};
        scene.gravity[1] = -9.81 * weight;
        scene.options.quasistatic = true;
        scene.options.newton_tolerance = 1e-9;
        sheet_scene_model(&scene);
        sheet_hold(&scene, held, 2, NULL, INFINITY);
        sheet_scene_stepper(&scene);
        sheet_watch(&scene);
        sheet_step(&scene);
        double s = -scene.state->position[7], wanted = expected_stretch(density * 9.81 * weight / 3, limit, stiffness * scene.state->strain_stiffness_factor);
        assert_true(s < limit && scene.max_stretch_ratio < 1);
        (void)snprintf(quantity, sizeof quantity, "s - 1 at a load of 1e%d", decade);
        validation_row("strip with strain limit 1.05 (E7)", quantity, wanted - 1, s - 1, 1e-5);
        validation_point("strip", "balance of forces", density * 9.81 * weight / 3, wanted - 1);
        validation_point("strip", "strip", density * 9.81 * weight / 3, s - 1);
        sheet_scene_free(&scene);
    }
}

/* Pushed instead of pulled: w t E (1 - s^2)/2 s + kappa w t |b'(s)| = W with a lower limit, from which s stays away under any weight. */
static double expected_compression(double stress, double limit, double stiffness)
{
    double low = limit, high = 1;
    for (int k = 0; k < 200; k++) {
        double s = 0.5 * (low + high), b[3];
        if (!(s > low && s < high)) break;
        cipc_strain_limit_barrier(s, limit, 1, b);
        if (young * (1 - s * s) / 2 * s - stiffness * b[1] < stress) high = s;
        else low = s;
    }
    return high;
}

static void test_limited_compression(void **state)
{
    (void)state;
    const double limit = 0.95, stiffness = 1e3, a[3] = {-0.5, 0, 0}, b[3] = {0.5, 0, 0}, c[3] = {0, -1, 0};
    const int held[2] = {0, 1};
    for (int decade = 0; decade <= 4; decade += 2) {
        sheet_scene scene;
        char quantity[64];
        double weight = pow(10, decade);
        sheet_scene_init(&scene);
        cipc_body_description *body = sheet_add_triangle(&scene, "strip", a, b, c);
        body->material = (cipc_material){.density = density, .thickness = thickness, .membrane = CIPC_MEMBRANE_STVK, .membrane_young = young, .strain_lower_limit = limit, .strain_lower_activation = 1, .strain_stiffness = stiffness};
        scene.gravity[1] = 9.81 * weight;
        scene.options.quasistatic = true;
        scene.options.newton_tolerance = 1e-9;
        sheet_scene_model(&scene);
        sheet_hold(&scene, held, 2, NULL, INFINITY);
        sheet_scene_stepper(&scene);
        sheet_watch(&scene);
        sheet_step(&scene);
        double s = -scene.state->position[7], wanted = expected_compression(density * 9.81 * weight / 3, limit, stiffness * scene.state->strain_stiffness_factor);
        if (!(s > limit && scene.max_stretch_ratio < 1)) fail_msg("load 1e%d: s %.17g, limit used %.17g, node at %g %g %g", decade, s, scene.max_stretch_ratio, scene.state->position[6], scene.state->position[7], scene.state->position[8]);
        (void)snprintf(quantity, sizeof quantity, "1 - s at a load of 1e%d", decade);
        validation_row("strip with lower strain limit 0.95", quantity, 1 - wanted, 1 - s, 1e-5);
        sheet_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_deflection),
        cmocka_unit_test(test_large_deflection),
        cmocka_unit_test(test_two_constants),
        cmocka_unit_test(test_limited_strip),
        cmocka_unit_test(test_limited_compression),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
