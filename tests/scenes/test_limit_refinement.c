/* The strain limit's energy is an integral over the cloth, not a sum over elements: of one smooth deformation it tends to the same value on ever finer meshes, regular and irregular ones (the claim
 * behind C-IPC eq. 7). The value comes from a quadrature of the barrier along the two principal directions, which are those of the axes:
 *     x(X, Z) = (f(X), 0, g(Z)), stretches f'(X) and g'(Z), E = kappa_s t (int b(f') dX + int b(g') dZ). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include <gsl/gsl_integration.h>

#include "cipc/energy.h"
#include "cipc/scene.h"
#include "support/claim.h"

static const double pi = 3.14159265358979323846;
static const double limit = 1.0608, activation = 1, stiffness = 1e3, thickness = 3.18e-4;

/* f'(u) = 1 + mean + swing sin(2 pi u): between 1.001 and 1.05, below the limit, above where it begins to act. */
static const double mean = 0.0255, swing = 0.0245;

static double stretch(double u)
{
    return 1 + mean + swing * sin(2 * pi * u);
}

static double place(double u)
{
    return (1 + mean) * u - swing * cos(2 * pi * u) / (2 * pi);
}

static double barrier_at(double u, void *unused)
{
    double b[3];
    (void)unused;
    cipc_strain_limit_barrier(stretch(u), limit, activation, b);
    return b[0];
}

static double exact_energy(void)
{
    enum { INTERVALS = 100 };
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(INTERVALS);
    gsl_function integrand = {barrier_at, NULL};
    double integral, error;
    assert_int_equal(gsl_integration_qag(&integrand, -0.5, 0.5, 0, 1e-12, INTERVALS, GSL_INTEG_GAUSS21, work, &integral, &error), 0);
    gsl_integration_workspace_free(work);
    return 2 * stiffness * thickness * integral;
}

static double mesh_energy(cipc_mesh *mesh)
{
    double sum = 0;
    for (int t = 0; t < mesh->triangle_count; t++) {
        double rest[9], x[9];
        cipc_strain_limit params;
        for (int k = 0; k < 3; k++) {
            const double *X = mesh->nodes + 3 * mesh->triangles[t][k];
            memcpy(rest + 3 * k, X, 3 * sizeof *X);
            x[3 * k] = place(X[0]);
            x[3 * k + 1] = X[1];
            x[3 * k + 2] = place(X[2]);
        }
        assert_true(cipc_strain_limit_init(&params, rest, thickness, limit, activation, stiffness));
        sum += cipc_strain_limit_value(x, &params);
    }
    cipc_mesh_free(mesh);
    return sum;
}

/* A triangle's stretch is that at its middle but for h^2, so the energy's error falls as h^2. */
static void test_regular_meshes(void **state)
{
    (void)state;
    enum { MESHES = 4 };
    const double exact = exact_energy();
    double error[MESHES];
    for (int i = 0; i < MESHES; i++) {
        cipc_mesh mesh;
        const int cells = 16 << i;
        assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, cells, cells, false, NULL), CIPC_OK);
        error[i] = fabs(mesh_energy(&mesh) / exact - 1);
        print_message("%d x %d cells: relative error %.3g\n", cells, cells, error[i]);
    }
    claim_figure("C6", "relative error of the limit's energy, 128 x 128 cells", error[MESHES - 1], "1", CLAIM_LESS, 1e-3);
    claim_within("C6", "order in which that error falls, from 64 to 128 cells", log2(error[MESHES - 2] / error[MESHES - 1]), "1", 1.9, 2.1);
}

/* Without a pattern too: triangles of different shape and size. */
static void test_irregular_meshes(void **state)
{
    (void)state;
    enum { MESHES = 4 };
    const double exact = exact_energy();
    double error[MESHES];
    for (int i = 0; i < MESHES; i++) {
        cipc_mesh mesh;
        const int nodes = 300 << (2 * i);
        assert_int_equal(cipc_mesh_irregular(&mesh, 1, 1, nodes, 1, NULL), CIPC_OK);
        error[i] = fabs(mesh_energy(&mesh) / exact - 1);
        print_message("%d nodes: relative error %.3g\n", nodes, error[i]);
        assert_true(i == 0 || error[i] < error[i - 1]);
    }
    claim_within("C6", "order on irregular meshes of 300 to 19,200 nodes", log2(error[0] / error[MESHES - 1]) / (MESHES - 1), "1", 1.7, 2.3);
}

/* A sum over elements that forgets their size is far from it, and gets worse: the comparison would see it. */
static void test_a_sum_without_areas_is_no_integral(void **state)
{
    (void)state;
    const double exact = exact_energy();
    double off[2];
    for (int i = 0; i < 2; i++) {
        cipc_mesh mesh;
        const int cells = 16 << i;
        assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, cells, cells, false, NULL), CIPC_OK);
        const double area = 0.5 / (cells * cells);
        off[i] = mesh_energy(&mesh) / area / exact - 1;
    }
    assert_true(off[0] > 1 && off[1] > 3 * off[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_regular_meshes),
        cmocka_unit_test(test_irregular_meshes),
        cmocka_unit_test(test_a_sum_without_areas_is_no_integral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
