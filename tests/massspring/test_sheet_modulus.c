/* A sheet of springs on equilateral triangles is an isotropic membrane: Young's modulus E and Poisson's ratio 1/3, pulled along its edges and across them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "support/spring_sheet.h"

static const double EDGE = 0.01, YOUNG = 4e5, THICKNESS = 3e-4, STRAIN = 1e-4;

/* Square 2 by 2 matrices of the plane (x, z): mean stress and displacement gradient of the triangles in the middle. */
typedef struct middle {
    double stress[2][2], gradient[2][2], area;
} middle;

static const int AXIS[2] = {0, 2};

/* Displacement gradient of one triangle at rest at r, by its edges from corner 0: G A = U. */
static void gradient_of(const double *r[3], const double *x[3], double G[2][2])
{
    double A[2][2], U[2][2];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++) {
            A[i][k] = r[k + 1][AXIS[i]] - r[0][AXIS[i]];
            U[i][k] = x[k + 1][AXIS[i]] - x[0][AXIS[i]] - A[i][k];
        }
    }
    const double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
    for (int i = 0; i < 2; i++) {
        G[i][0] = (U[i][0] * A[1][1] - U[i][1] * A[1][0]) / det;
        G[i][1] = (U[i][1] * A[0][0] - U[i][0] * A[0][1]) / det;
    }
}

/* An inner edge belongs to two triangles, half to each: stress times area times thickness = sum of T r e e / 2. */
static void add_triangle(middle *m, const spring_sheet *s, const int v[3])
{
    const double *r[3], *x[3], area = sqrt(3.0) / 4 * EDGE * EDGE;
    double G[2][2];
    for (int k = 0; k < 3; k++) {
        r[k] = s->mesh.nodes + 3 * v[k];
        x[k] = s->x + 3 * v[k];
    }
    gradient_of(r, x, G);
    for (int i = 0; i < 4; i++) m->gradient[i / 2][i % 2] += area * G[i / 2][i % 2];
    for (int k = 0; k < 3; k++) {
        const double e[2] = {x[(k + 1) % 3][0] - x[k][0], x[(k + 1) % 3][2] - x[k][2]}, length = hypot(e[0], e[1]);
        cipc_spring spring = s->springs[0];
        spring.length = EDGE;
        const double tension = cipc_spring_tension(&spring, length);
        for (int i = 0; i < 4; i++) m->stress[i / 2][i % 2] += 0.5 * tension / length * e[i / 2] * e[i % 2] / THICKNESS;
    }
    m->area += area;
}

/* Means over triangles at most `reach` from the middle in x and z. */
static middle measure(const spring_sheet *s, const double reach[2])
{
    middle m = {0};
    for (int i = 0; i < s->mesh.triangle_count; i++) {
        const int *v = s->mesh.triangles[i];
        double at[2] = {0, 0};
        for (int k = 0; k < 6; k++) at[k % 2] += s->mesh.nodes[3 * v[k / 2] + AXIS[k % 2]] / 3;
        if (fabs(at[0]) < reach[0] && fabs(at[1]) < reach[1]) add_triangle(&m, s, v);
    }
    for (int i = 0; i < 4; i++) {
        m.stress[i / 2][i % 2] /= m.area;
        m.gradient[i / 2][i % 2] /= m.area;
    }
    return m;
}

/* All is stretched as a whole, then the ends in the direction `along` are held and the rest settles. Without bending springs: it stays in its plane. */
static spring_sheet pull(int columns, int rows, int along)
{
    const cipc_spring spring = {.stiffness = cipc_spring_stiffness_of_sheet(YOUNG, THICKNESS)};
    spring_sheet s;
    spring_sheet_init(&s, EDGE, columns, rows, 0.1, &spring, 0);
    for (int i = 0; i < s.node_count; i++) {
        const int column = i % (columns + 1), row = i / (columns + 1);
        s.x[3 * i + AXIS[along]] *= 1 + STRAIN;
        s.mass[i] = s.model->mass[s.node_count / 2]; /* rest does not depend on masses: equal ones get there fastest */
        const bool end = along == 0 ? column == 0 || column == columns : row == 0 || row == rows;
        s.inverse_mass[i] = end ? 0 : 1 / s.mass[i];
    }
    s.step = 0.9 * cipc_spring_stable_step(s.springs, (const int(*)[2])s.topology.ends, s.topology.count, 0, 0, s.inverse_mass, s.node_count);
    s.drag = 2 * M_PI / (along == 0 ? columns * EDGE : rows * 0.5 * sqrt(3.0) * EDGE) * sqrt(YOUNG * THICKNESS / 0.1); /* critical for the slowest wave along the strip */
    spring_sheet_settle(&s, 1e-6 * spring.stiffness * STRAIN * EDGE, 100000);
    return s;
}

/* Held ends disturb what is near them; that dies out as exp(-4.2 distance/width) (Saint-Venant), so that of the Poisson contraction they hold back there is left less than 1e-3 at 1.5
 * widths. The springs of the sides belong to one triangle only and are too stiff there by half of theirs: along x that adds a force along the sides and changes nothing inside. Across, the
 * zigzag of the sides pushes in and out from node to node, which dies out within a few rows. Strains are right to STRAIN. In all below 2e-3; 1 % is asked for. */
static void assert_isotropic(const middle *m, int along, const char *name)
{
    const double young = m->stress[along][along] / m->gradient[along][along], poisson = -m->gradient[1 - along][1 - along] / m->gradient[along][along];
    printf("%s: E/E0 - 1 = %.3g, 3 nu - 1 = %.3g, stress across/along %.3g, strain/asked - 1 = %.3g\n", name, young / YOUNG - 1, 3 * poisson - 1,
           m->stress[1 - along][1 - along] / m->stress[along][along], m->gradient[along][along] / STRAIN - 1);
    assert_true(fabs(young / YOUNG - 1) < 2e-3);
    assert_true(fabs(3 * poisson - 1) < 2e-3);
    assert_true(fabs(m->stress[1 - along][1 - along] / m->stress[along][along]) < 2e-3);
    assert_true(fabs(m->gradient[0][1] + m->gradient[1][0]) < 2e-3 * STRAIN);
}

static void test_along_the_edges(void **state)
{
    (void)state;
    enum { COLUMNS = 48, ROWS = 12 };
    spring_sheet s = pull(COLUMNS, ROWS, 0);
    const double width = ROWS * 0.5 * sqrt(3.0) * EDGE, reach[2] = {0.5 * width, 0.5 * width};
    const middle m = measure(&s, reach);
    assert_isotropic(&m, 0, "along");
    /* And the force on the left end: that of the membrane, and of half a spring along either side. */
    double force = 0;
    for (int j = 0; j <= ROWS; j++) force += s.force[3 * j * (COLUMNS + 1)];
    const double want = m.gradient[0][0] * (YOUNG * THICKNESS * width + s.springs[0].stiffness * EDGE);
    printf("force/expected - 1 = %.3g\n", force / want - 1);
    assert_true(fabs(force / want - 1) < 2e-3);
    spring_sheet_free(&s);
}

static void test_across_the_edges(void **state)
{
    (void)state;
    enum { COLUMNS = 16, ROWS = 74 };
    spring_sheet s = pull(COLUMNS, ROWS, 1);
    const double width = COLUMNS * EDGE, reach[2] = {0.25 * width, 0.5 * width};
    const middle m = measure(&s, reach);
    assert_isotropic(&m, 1, "across");
    spring_sheet_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_along_the_edges),
        cmocka_unit_test(test_across_the_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
