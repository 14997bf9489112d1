/* The bound on deformation: what it reaches, what it leaves alone, what it keeps; the literal reading. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/massspring.h"
#include "support/spring_sheet.h"

static const double BOUND = 0.1, TOLERANCE = 1e-3;
static const int ENDS[1][2] = {{0, 1}};

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_greatest(void **state)
{
    (void)state;
    static const int ends[2][2] = {{0, 1}, {1, 2}};
    const cipc_spring springs[2] = {{.length = 2}, {.length = 4}};
    const double x[9] = {0, 0, 0, 3, 0, 0, 3, 1, 0};
    assert_true(cipc_deformation_greatest(springs, ends, 1, x) == 0.5);
    assert_true(cipc_deformation_greatest(springs, ends, 2, x) == 0.75);
    assert_true(cipc_deformation_greatest(springs, ends, 0, x) == 0);
}

/* One spring, one sweep: both ways, by inverse masses, velocity by displacement / dt. */
static void test_one_spring(void **state)
{
    (void)state;
    const cipc_spring s = {.length = 1};
    const double inverse_mass[2] = {1, 3};
    for (int stretched = 0; stretched < 2; stretched++) {
        double x[6] = {1, 1, 1, 1, stretched ? 2.5 : 1.5, 1}, v[6] = {7, 0, 0, 0, 0, 0}, greatest;
        const double excess = stretched ? 0.4 : -0.4;
        assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 9, inverse_mass, 0.5, x, v, &greatest), 1);
        assert_relative(x[1], 1 + excess / 4, 4 * DBL_EPSILON);
        assert_relative(x[4], (stretched ? 2.5 : 1.5) - excess * 3 / 4, 4 * DBL_EPSILON);
        assert_relative(v[1], excess / 4 / 0.5, 8 * DBL_EPSILON);
        assert_relative(v[4], -excess * 3 / 4 / 0.5, 8 * DBL_EPSILON);
        assert_true(v[0] == 7 && x[0] == 1 && x[5] == 1);
        assert_relative(greatest, BOUND, 32 * DBL_EPSILON);
    }
}

/* Within the bound, both ends held, no length, no sweeps: not a bit changes. */
static void test_left_alone(void **state)
{
    (void)state;
    const cipc_spring s = {.length = 1};
    const double free[2] = {1, 1}, held[2] = {0, 0};
    double x[6] = {0, 0, 0, 0, 1.0625, 0}, v[6] = {1, 2, 3, 4, 5, 6}, greatest = -1;
    const double x_before[6] = {0, 0, 0, 0, 1.0625, 0}, v_before[6] = {1, 2, 3, 4, 5, 6};
    assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 9, free, 0.5, x, v, &greatest), 0);
    assert_true(greatest == 0.0625);
    assert_memory_equal(x, x_before, sizeof x);
    x[4] = 3;
    assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 9, held, 0.5, x, v, &greatest), 9);
    assert_true(x[4] == 3 && greatest == 2);
    assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 0, free, 0.5, x, v, &greatest), 0);
    assert_true(x[4] == 3 && greatest == 2);
    x[4] = 0;
    assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 9, free, 0.5, x, v, NULL), 9);
    assert_true(x[4] == 0);
    assert_memory_equal(v, v_before, sizeof v);
    x[4] = 3; /* without dt velocities are not looked at */
    assert_int_equal(cipc_deformation_project(&s, ENDS, 1, BOUND, TOLERANCE, 9, free, 0, x, NULL, NULL), 1);
    assert_relative(x[4] - x[1], 1.1, 8 * DBL_EPSILON);
}

typedef struct total {
    double p[3], center[3], scale, size;
} total;

static total total_of(const spring_sheet *s)
{
    total t = {{0}, {0}, 0, 0};
    for (int i = 0; i < 3 * s->node_count; i++) {
        t.p[i % 3] += s->mass[i / 3] * s->v[i];
        t.center[i % 3] += s->mass[i / 3] * s->x[i];
        t.scale += s->mass[i / 3] * fabs(s->v[i]);
        t.size += s->mass[i / 3] * fabs(s->x[i]);
    }
    return t;
}

/* Free sheets with every edge out by up to a half: bounded afterwards, momentum and centre of mass as before. Roundings: some per spring and sweep, of the sums' size. */
static void test_crumpled_sheets(void **state)
{
    (void)state;
    const cipc_spring spring = {.stiffness = 1};
    for (unsigned long seed = 1; seed <= 5; seed++) {
        enum { SWEEPS = 5000 };
        spring_sheet s;
        spring_sheet_init(&s, 1, 8, 9, 1, &spring, 0);
        spring_sheet_crumple(&s, seed, 0.3);
        const int count = s.topology.structural_count;
        assert_true(cipc_deformation_greatest(s.springs, (const int(*)[2])s.topology.ends, count, s.x) > 3 * BOUND);
        const total before = total_of(&s);
        double greatest;
        const int sweeps = cipc_deformation_project(s.springs, (const int(*)[2])s.topology.ends, count, BOUND, TOLERANCE, SWEEPS, s.inverse_mass, 1e-2, s.x, s.v, &greatest);
        const total after = total_of(&s);
        assert_true(sweeps > 1 && sweeps < SWEEPS);
        assert_true(greatest <= BOUND * (1 + TOLERANCE));
        assert_true(greatest == cipc_deformation_greatest(s.springs, (const int(*)[2])s.topology.ends, count, s.x));
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(after.p[k] - before.p[k]) <= sweeps * DBL_EPSILON * (before.scale + after.scale));
            assert_true(fabs(after.center[k] - before.center[k]) <= sweeps * DBL_EPSILON * (before.size + after.size));
        }
        spring_sheet_free(&s);
    }
}

/* Held corners stay to the bit, and so do their velocities. */
static void test_held_nodes(void **state)
{
    (void)state;
    const cipc_spring spring = {.stiffness = 1};
    static const int corner[2] = {0, 8};
    spring_sheet s;
    spring_sheet_init(&s, 1, 8, 9, 1, &spring, 0);
    spring_sheet_crumple(&s, 6, 0.3);
    double x[6], v[6], greatest;
    for (int i = 0; i < 2; i++) {
        s.inverse_mass[corner[i]] = 0;
        memcpy(x + 3 * i, s.x + 3 * corner[i], 3 * sizeof *x);
        memcpy(v + 3 * i, s.v + 3 * corner[i], 3 * sizeof *v);
    }
    cipc_deformation_project(s.springs, (const int(*)[2])s.topology.ends, s.topology.structural_count, BOUND, TOLERANCE, 5000, s.inverse_mass, 1e-2, s.x, s.v, &greatest);
    assert_true(greatest <= BOUND * (1 + TOLERANCE));
    for (int i = 0; i < 2; i++) {
        assert_memory_equal(x + 3 * i, s.x + 3 * corner[i], 3 * sizeof *x);
        assert_memory_equal(v + 3 * i, s.v + 3 * corner[i], 3 * sizeof *v);
    }
    spring_sheet_free(&s);
}

/* The other reading: lengths change, nodes do not; afterwards B = Bmax and the force is k Bmax d. */
static void test_adjust(void **state)
{
    (void)state;
    static const int ends[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
    cipc_spring springs[4] = {{.length = 1, .stiffness = 5}, {.length = 1, .stiffness = 5}, {.length = 1, .stiffness = 5}, {.length = 1, .stiffness = 5}};
    const double x[15] = {0, 0, 0, 2.2, 0, 0, 2.2, 0.45, 0, 2.2, 0.45, 1.05, 2.2, 0.45, 1.05};
    assert_int_equal(cipc_deformation_adjust(springs, ends, 4, BOUND, x), 2);
    assert_relative(springs[0].length, 2, 4 * DBL_EPSILON);
    assert_relative(springs[1].length, 0.5, 4 * DBL_EPSILON);
    assert_true(springs[2].length == 1); /* within the bound */
    assert_true(springs[3].length == 1); /* of no length */
    assert_relative(cipc_spring_tension(&springs[0], 2.2), 5 * BOUND * 2, 32 * DBL_EPSILON);
    assert_relative(cipc_spring_tension(&springs[1], 0.45), -5 * BOUND * 0.5, 32 * DBL_EPSILON);
    assert_relative(cipc_deformation_greatest(springs, ends, 3, x), BOUND, 32 * DBL_EPSILON);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_greatest),
        cmocka_unit_test(test_one_spring),
        cmocka_unit_test(test_left_alone),
        cmocka_unit_test(test_crumpled_sheets),
        cmocka_unit_test(test_held_nodes),
        cmocka_unit_test(test_adjust),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
