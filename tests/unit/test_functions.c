/* MPFR values and derivatives: numbers of the specification, closed forms, and what is undecided. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/oracle.h"

static void assert_near(double got, double want, double digits)
{
    if (!(fabs(got - want) <= fabs(want) * pow(10, -digits))) fail_msg("%.17g, not %.17g", got, want);
}

/* SPEC C.2: b, b', b'' of the strain limit at s = 1.0608, shat = 1, given to nine digits. */
static void test_strain_limit_table(void **state)
{
    (void)state;
    static const double fields[2] = {1.0608, 1}, want[2][3] = {{.0431643555, 6.96855249, 811.248031}, {1.16865833, 109.365761, 11742.5761}};
    static const double sigma[2] = {1.02, 1.05};
    for (int i = 0; i < 2; i++) {
        double f[3];
        assert_int_equal(cipc_oracle_scalar("strain_limit_barrier", sigma[i], fields, f), CIPC_YES);
        for (int k = 0; k < 3; k++) assert_near(f[k], want[i][k], 8.3);
    }
}

/* b of SPEC C.4 at D = Dhat / e: ln(D / Dhat) = -1, so b = (D - Dhat)^2, b' = 2 (D - Dhat) - (D - Dhat)^2 / D, b'' = 2 - 4 (D - Dhat)/D + (D - Dhat)^2/D^2. */
static void test_barrier(void **state)
{
    (void)state;
    double Dhat = 1, D = exp(-1), f[3], gap = D - Dhat;
    assert_int_equal(cipc_oracle_scalar("barrier", D, &Dhat, f), CIPC_YES);
    assert_near(f[0], gap * gap, 15);
    assert_near(f[1], 2 * gap - gap * gap / D, 15);
    assert_near(f[2], 2 - 4 * gap / D + gap * gap / (D * D), 15);
    assert_int_equal(cipc_oracle_scalar("barrier", 2, &Dhat, f), CIPC_YES);
    assert_true(f[0] == 0 && f[1] == 0 && f[2] == 0);
    assert_int_equal(cipc_oracle_scalar("barrier", 0, &Dhat, f), CIPC_INDETERMINATE);
    assert_int_equal(cipc_oracle_scalar("no such", 1, &Dhat, f), CIPC_INDETERMINATE);
}

/* SPEC D.6: f0 = e/3 at y = 0, f1 = 2 y/e - y^2/e^2, f1' = 2/e - 2 y/e^2; y beyond e. */
static void test_friction_mollifier(void **state)
{
    (void)state;
    double e = 0.5, f[3];
    assert_int_equal(cipc_oracle_scalar("friction_mollifier", 0.125, &e, f), CIPC_YES);
    assert_near(f[0], 0.125 * 0.125 * (1 - 0.125 / 1.5) / 0.5 + 0.5 / 3, 15);
    assert_near(f[1], 0.5 - 0.0625, 15);
    assert_near(f[2], 4 - 1, 15);
    assert_int_equal(cipc_oracle_scalar("friction_mollifier", 2, &e, f), CIPC_YES);
    assert_true(f[0] == 2 && f[1] == 1 && f[2] == 0);
}

/* Distances with closed derivatives: a point at height h over the plane z = 0: h^2, gradient 2 h on the point. */
static void test_point_plane(void **state)
{
    (void)state;
    static const double x[12] = {0.25, 0.25, 0.5, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    double value, g[12], H[144];
    assert_int_equal(cipc_oracle_evaluate(cipc_oracle_function_find("distance2_point_plane"), x, NULL, &value, g, H), CIPC_YES);
    assert_true(value == 0.25 && g[0] == 0 && g[1] == 0 && g[2] == 1);
    assert_true(g[5] == -0.5 && g[8] == -0.25 && g[11] == -0.25); /* the point's force, by barycentric weights */
    assert_true(H[2 * 12 + 2] == 2);
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < i; j++) assert_true(H[12 * i + j] == H[12 * j + i]);
}

/* A quadratic: 1/2 m |x - t|^2, all of it exact. */
static void test_inertia(void **state)
{
    (void)state;
    static const double x[3] = {1, 2, 3}, fields[4] = {0.5, 0, 0, 1};
    double value, g[3], H[9];
    assert_int_equal(cipc_oracle_evaluate(cipc_oracle_function_find("inertia"), x, fields, &value, g, H), CIPC_YES);
    assert_true(value == 0.25 * 9 && g[0] == 0.5 && g[1] == 1 && g[2] == 1 && H[0] == 0.5 && H[1] == 0 && H[4] == 0.5);
}

/* Right angle of a hinge: theta = pi/2, and the energy k theta^2; the sign turns with the fold. */
static void test_hinge(void **state)
{
    (void)state;
    static const double up[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, fields[2] = {3, 0}, bent[2] = {3, 0.5};
    double value, other;
    double down[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1};
    const cipc_oracle_function *hinge = cipc_oracle_function_find("hinge_bending");
    assert_int_equal(cipc_oracle_evaluate(hinge, up, fields, &value, NULL, NULL), CIPC_YES);
    assert_near(value, 3 * 2.4674011002723395, 15);
    cipc_oracle_evaluate(hinge, up, bent, &value, NULL, NULL);
    cipc_oracle_evaluate(hinge, down, bent, &other, NULL, NULL);
    assert_true(fabs(value - other) > 1);
}

static void test_undecided(void **state)
{
    (void)state;
    const cipc_oracle_function *f = cipc_oracle_function_find("barrier_point_point");
    static const double inside[6] = {0, 0, 0, 0.5, 0, 0}, fields[4] = {1, 1, 1, 0.1};
    double x[6] = {0, 0, 0, 1.05, 0, 0}, g[6], H[36], value;
    assert_int_equal(cipc_oracle_evaluate(f, inside, fields, &value, g, H), CIPC_INDETERMINATE); /* nearer than the thickness */
    assert_int_equal(cipc_oracle_evaluate(f, x, fields, &value, g, H), CIPC_YES);
    x[0] = NAN;
    assert_int_equal(cipc_oracle_evaluate(f, x, fields, &value, g, H), CIPC_INDETERMINATE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_strain_limit_table), cmocka_unit_test(test_barrier), cmocka_unit_test(test_friction_mollifier), cmocka_unit_test(test_point_plane),
        cmocka_unit_test(test_inertia),            cmocka_unit_test(test_hinge),   cmocka_unit_test(test_undecided),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
