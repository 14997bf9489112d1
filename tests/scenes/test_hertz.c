/* Contact of round elastic bodies against Hertz (SPEC E13, E14): a ball and a disc between two rigid plates, on meshes that are graded towards the contacts. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/scene.h"
#include "scene/cell_cuts.h"
#include "scene/cube_to_ball.h"
#include "support/sheet_scene.h"
#include "support/validation.h"

static const double pi = 3.14159265358979323846;
static const double young = 1e5;
/* Light and slow: inertia is some 1e-4 of the forces, and keeps the solids, which nothing else holds, from turning. */
static const double density = 0.1, time_step = 1;
static const double grading = 2, dhat = 1e-3, travel = 0.02;

enum { LOADS = 2 };

/* What one load leaves. */
typedef struct squeeze {
    double approach; /* m, of the middle to each plate: radius less the height of the pole above the middle */
    double force;    /* N, on the upper plate */
    double size;     /* m: root of the mean of x^2 (and z^2), weighted by the nodes' forces */
} squeeze;

/* A lattice coordinate c of [-1, 1], drawn towards 0; and towards -1 and 1. Spacing there is 0.31 of the even one's. */
static double towards_middle(double c) { return copysign(expm1(grading * fabs(c)) / expm1(grading), c); }
static double towards_ends(double c) { return copysign(1 - expm1(grading * (1 - fabs(c))) / expm1(grading), c); }

/* Elastic forces of the upper half: the contacts' are their negative. */
static squeeze measure(const sheet_scene *scene, const cipc_mesh *mesh, double poisson)
{
    double *force = calloc(3 * (size_t)mesh->node_count, sizeof *force), sum = 0, moment = 0;
    const double *x = scene->state->position;
    assert_non_null(force);
    for (int t = 0; t < mesh->tetrahedron_count; t++) {
        double rest[12], now[12], g[12];
        cipc_volume params;
        for (int a = 0; a < 4; a++) {
            memcpy(rest + 3 * a, mesh->nodes + 3 * mesh->tetrahedra[t][a], 3 * sizeof *rest);
            memcpy(now + 3 * a, x + 3 * mesh->tetrahedra[t][a], 3 * sizeof *now);
        }
        assert_true(cipc_volume_init(&params, rest, young, poisson));
        cipc_volume_corotational_gradient(now, &params, g);
        for (int a = 0; a < 4; a++)
            for (int k = 0; k < 3; k++) force[3 * mesh->tetrahedra[t][a] + k] += g[3 * a + k];
    }
    int pole = 0;
    for (int i = 0; i < mesh->node_count; i++) {
        if (mesh->nodes[3 * i + 1] > mesh->nodes[3 * pole + 1]) pole = i;
        if (mesh->nodes[3 * i + 1] <= 1e-9) continue;
        sum -= force[3 * i + 1];
        moment -= force[3 * i + 1] * x[3 * i] * x[3 * i];
    }
    free(force);
    return (squeeze){1 - x[3 * pole + 1], sum, sqrt(moment / sum)};
}

static void add_plate(sheet_scene *scene, const char *name, double y)
{
    const double a[3] = {-20, y, -10.3}, b[3] = {20, y, -10.1}, c[3] = {0.7, y, 20};
    if (y > 0) sheet_add_triangle(scene, name, a, b, c)->fixed = true;
    else sheet_add_triangle(scene, name, a, c, b)->fixed = true;
}

/* Squeezes a solid of half height 1 between plates that come together by `travel` each, in equal parts. */
static void press(const cipc_mesh *mesh, double poisson, squeeze out[LOADS])
{
    sheet_scene scene;
    const cipc_body_description body = {.name = "solid", .kind = CIPC_BODY_VOLUME, .material = {.density = density, .young = young, .poisson = poisson}, .node_count = mesh->node_count,
                                        .rest = mesh->nodes, .position = mesh->nodes, .tetrahedron_count = mesh->tetrahedron_count, .tetrahedra = (const int(*)[4])mesh->tetrahedra};
    int axis[2], found = 0;
    sheet_scene_init(&scene);
    sheet_add(&scene, &body);
    add_plate(&scene, "upper", 1 + 0.5 * dhat);
    add_plate(&scene, "lower", -1 - 0.5 * dhat);
    scene.options.time_step = time_step;
    scene.options.newton_tolerance = 1e-7 / time_step;
    scene.options.contact.dhat = dhat;
    scene.options.contact.area_weights = false;
    scene.options.barrier_stiffness = 4e8 * time_step * time_step; /* the contacts end between 0.01 and 0.4 of dhat */
    sheet_scene_model(&scene);
    for (int side = 0; side < 2; side++) {
        int first = mesh->node_count + 3 * side;
        const int plate[3] = {first, first + 1, first + 2};
        const cipc_motion motion = {.begin = 0, .end = INFINITY, .velocity = {0, (side ? 1 : -1) * travel / LOADS / time_step, 0}, .axis = {0, 1, 0}};
        sheet_hold(&scene, plate, 3, &motion, INFINITY);
    }
    /* The disc would fall over: its axis is held, which by symmetry nothing pushes. (The ball has one such node.) */
    for (int i = 0; i < mesh->node_count && found < 2; i++)
        if (mesh->nodes[3 * i] == 0 && mesh->nodes[3 * i + 1] == 0 && fabs(mesh->nodes[3 * i + 2]) < 0.1) axis[found++] = i;
    sheet_hold(&scene, axis, found, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_watch(&scene);
    for (int load = 0; load < LOADS; load++) {
        sheet_step(&scene);
        out[load] = measure(&scene, mesh, poisson);
    }
    sheet_scene_free(&scene);
}

/* The finest mesh is held against what is allowed, and must be better than the middle one; the coarsest, with one or two elements in the contact, is only printed. */
static void report(const char *scene, const char *quantity, int level, double expected, double measured, double *previous, double allowed)
{
    double error = fabs(measured / expected - 1);
    printf("  %s, mesh %d: %s %.5g, expected %.5g: %.3f\n", scene, level, quantity, measured, expected, measured / expected);
    if (level == 2 && !(error < *previous)) fail_msg("%s, %s: the error was %.3g on the coarser mesh and is %.3g", scene, quantity, *previous, error);
    *previous = error;
    if (level == 2) validation_row(scene, quantity, expected, measured, allowed);
}

static void make_ball(cipc_mesh *mesh, int cells)
{
    const int lattice[3] = {cells, cells, cells};
    const bool mirrored[3] = {true, true, true};
    assert_int_equal(scene_cut_cells(mesh, lattice, mirrored, "ball", NULL), CIPC_OK);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i;
        x[0] = towards_middle(x[0]);
        x[1] = towards_ends(x[1]);
        x[2] = towards_middle(x[2]);
        scene_cube_to_ball(3, x);
    }
}

/* The force that Hertz has for an approach of two bodies, less what the opposite load does to the middle of the ball: the half-space solution of a point load at a distance of 2 R,
 * radius of contact a (Tatara 1991; at this load 5 % of the approach). */
static double ball_force(double approach, double poisson)
{
    double modulus = young / (1 - poisson * poisson), force = 4.0 / 3 * modulus * pow(approach, 1.5);
    for (int k = 0; k < 50; k++) {
        double a = cbrt(3 * force / (4 * modulus)), s = a * a + 4;
        double far = force / (pi * young) * (2 * (1 + poisson) / pow(s, 1.5) + (1 - poisson * poisson) / sqrt(s));
        force = 4.0 / 3 * modulus * pow(approach + far, 1.5);
    }
    return force;
}

/* E13. Pressure sqrt(1 - r^2/a^2) has <x^2> = a^2/5; a = (3 F R/4 E*)^(1/3) whatever is far away. */
static void test_ball(void **state)
{
    (void)state;
    static const int cells[3] = {8, 12, 16};
    static const char scene[] = "ball between plates, 16 cells across (E13, Hertz)";
    const double poisson = 0.3, modulus = young / (1 - poisson * poisson);
    double force_error = 0, radius_error = 0;
    for (int level = 0; level < 3; level++) {
        cipc_mesh mesh;
        squeeze s[LOADS];
        char curve[32];
        make_ball(&mesh, cells[level]);
        press(&mesh, poisson, s);
        (void)snprintf(curve, sizeof curve, "%d cells across", cells[level]);
        for (int k = 0; k < LOADS; k++) validation_point("hertz-ball", curve, s[k].approach, s[k].force / young);
        report(scene, "force at an approach of 2 %, N", level, ball_force(s[LOADS - 1].approach, poisson), s[LOADS - 1].force, &force_error, 0.06);
        report(scene, "radius of contact under that force, m", level, cbrt(3 * s[LOADS - 1].force / (4 * modulus)), sqrt(5) * s[LOADS - 1].size, &radius_error, 0.06);
        cipc_mesh_free(&mesh);
    }
    for (double approach = 0.005; approach < 0.0225; approach += 0.001) {
        validation_point("hertz-ball", "Hertz", approach, 4.0 / 3 * modulus * pow(approach, 1.5) / young);
        validation_point("hertz-ball", "Hertz, opposite load counted", approach, ball_force(approach, poisson) / young);
    }
}

static const double disc_thickness = 0.1;

static void make_disc(cipc_mesh *mesh, int cells)
{
    const int lattice[3] = {cells, cells, 1};
    const bool mirrored[3] = {true, true, false};
    assert_int_equal(scene_cut_cells(mesh, lattice, mirrored, "disc", NULL), CIPC_OK);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i;
        x[0] = towards_middle(x[0]);
        x[1] = towards_ends(x[1]);
        x[2] *= 0.5 * disc_thickness;
        scene_cube_to_ball(2, x);
    }
}

/* E14, plane stress, with Poisson's ratio 0 the same as plane strain: E* = E. Pressure sqrt(1 - x^2/b^2) along x alone has <x^2> = b^2/4. The approach of a disc between two plates:
 * F' / (pi E*) (2 ln(4 R/b) - 1) (Johnson 1985, 5.57). */
static void test_disc(void **state)
{
    (void)state;
    static const int cells[3] = {8, 16, 32};
    static const char scene[] = "disc between plates, 32 cells across (E14, line contact)";
    double width_error = 0, approach_error = 0;
    for (int level = 0; level < 3; level++) {
        cipc_mesh mesh;
        squeeze s[LOADS];
        make_disc(&mesh, cells[level]);
        press(&mesh, 0, s);
        double load = s[LOADS - 1].force / disc_thickness, half_width = sqrt(4 * load / (pi * young));
        report(scene, "half width of contact, m", level, half_width, 2 * s[LOADS - 1].size, &width_error, 0.04);
        report(scene, "approach under that force, m", level, load / (pi * young) * (2 * log(4 / half_width) - 1), s[LOADS - 1].approach, &approach_error, 0.01);
        cipc_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ball),
        cmocka_unit_test(test_disc),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
