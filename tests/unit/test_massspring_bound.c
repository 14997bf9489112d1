/* The bound as the integrator keeps it: bit for bit the plain sweeps; together with somebody who moves nodes too, both get what they ask for. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_rng.h>

#include "massspring/bound.h"
#include "support/failing_memory.h"
#include "support/spring_sheet.h"

static const double DT = 1e-2, TOLERANCE = 1e-3;

/* A crumpled sheet, every tenth node held; two nodes at one place, with a spring between them. */
static void crumple(spring_sheet *s, unsigned long seed, double by)
{
    spring_sheet_crumple(s, seed, by);
    for (int i = (int)(seed % 10); i < s->node_count; i += 10) s->inverse_mass[i] = 0;
    memcpy(s->x + 3 * s->topology.ends[5][1], s->x + 3 * s->topology.ends[5][0], 3 * sizeof *s->x);
}

static massspring_sheet sheet_of(const spring_sheet *s, double *x, double *v)
{
    return (massspring_sheet){s->springs, (const int(*)[2])s->topology.ends, s->topology.structural_count, s->node_count, s->inverse_mass, DT, x, v};
}

static massspring_bound *bound_of(const spring_sheet *s)
{
    massspring_bound *b = massspring_bound_create((const int(*)[2])s->topology.ends, s->topology.structural_count, s->node_count);
    assert_non_null(b);
    return b;
}

static double *copy(const double *from, int n)
{
    double *to = malloc((size_t)n * sizeof *to);
    assert_non_null(to);
    return memcpy(to, from, (size_t)n * sizeof *to);
}

/* After any number of sweeps, and at the end: the same nodes, velocities and sweeps as of cipc_deformation_project. One list serves many times. */
static void test_the_bits_of_the_plain_form(void **state)
{
    (void)state;
    const cipc_spring spring = {.stiffness = 1};
    static const int sweeps[] = {0, 1, 2, 3, 4, 7, 20, 2000};
    int ended = 0;
    for (unsigned long seed = 1; seed <= 20; seed++) {
        spring_sheet s;
        spring_sheet_init(&s, 1, 8 + (int)seed % 3, 9, 1, &spring, 0);
        crumple(&s, seed, seed % 4 == 0 ? 0.06 : 0.3);
        massspring_bound *b = bound_of(&s);
        const int n = 3 * s.node_count;
        const double bound = seed % 2 == 0 ? 0.1 : 0.03;
        for (size_t k = 0; k < sizeof sweeps / sizeof *sweeps; k++) {
            double *x = copy(s.x, n), *v = copy(s.v, n), *plain_x = copy(s.x, n), *plain_v = copy(s.v, n), greatest;
            const massspring_sheet sheet = sheet_of(&s, x, v);
            bool kept;
            const int plain = cipc_deformation_project(s.springs, sheet.ends, sheet.count, bound, TOLERANCE, sweeps[k], s.inverse_mass, DT, plain_x, plain_v, &greatest);
            assert_int_equal(massspring_bound_sweep(b, &sheet, bound, TOLERANCE, sweeps[k], NULL, NULL, &kept), plain);
            assert_memory_equal(x, plain_x, (size_t)n * sizeof *x);
            assert_memory_equal(v, plain_v, (size_t)n * sizeof *v);
            assert_true(kept == (greatest <= bound * (1 + TOLERANCE)));
            ended += kept && plain > 3;
            free(x), free(v), free(plain_x), free(plain_v);
        }
        massspring_bound_destroy(b);
        spring_sheet_free(&s);
    }
    assert_true(ended > 5); /* they are not all the same case */
}

/* Keeps nodes at or above y = 0; counts calls, and those for nodes that it found below. */
typedef struct floor_of {
    long calls, moved;
    const double *inverse_mass;
} floor_of;

static bool out_of_the_floor(void *context, int node, double x[3], double v[3])
{
    floor_of *f = context;
    f->calls++;
    assert_true(f->inverse_mass[node] > 0);
    if (x[1] >= 0) return false;
    x[1] = 0;
    v[1] = fmax(v[1], 0);
    f->moved++;
    return true;
}

/* A sheet pressed together on a floor: afterwards nothing is below it, and the bound holds as well. What the floor moves is looked at again: that alone breaks the bound here. */
static void test_both_get_what_they_ask_for(void **state)
{
    (void)state;
    const cipc_spring spring = {.stiffness = 1};
    for (unsigned long seed = 1; seed <= 10; seed++) {
        spring_sheet s;
        spring_sheet_init(&s, 1, 8, 9, 1, &spring, 0);
        gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
        gsl_rng_set(rng, seed);
        for (int i = 0; i < s.node_count; i++) {
            s.x[3 * i] *= 0.85; /* too short: they push their lower ends down */
            s.x[3 * i + 1] = 0.2 * gsl_rng_uniform(rng);
            s.inverse_mass[i] = 1 / s.mass[i];
        }
        gsl_rng_free(rng);
        massspring_bound *b = bound_of(&s);
        const massspring_sheet sheet = sheet_of(&s, s.x, s.v);
        floor_of f = {.inverse_mass = s.inverse_mass};
        bool kept;
        const int sweeps = massspring_bound_sweep(b, &sheet, 0.05, TOLERANCE, 5000, out_of_the_floor, &f, &kept);
        assert_true(kept && sweeps > 1 && sweeps < 5000 && f.moved > 0 && f.calls > f.moved);
        assert_true(f.calls < (long)sweeps * s.node_count); /* of what has moved alone */
        assert_true(cipc_deformation_greatest(s.springs, sheet.ends, sheet.count, s.x) <= 0.05 * (1 + TOLERANCE));
        for (int i = 0; i < s.node_count; i++) assert_true(s.x[3 * i + 1] >= 0);
        massspring_bound_destroy(b);
        spring_sheet_free(&s);
    }
}

/* What cannot be had is said, and the floor has the last word; what is within the bound is left alone, and nobody called. */
static void test_what_is_said(void **state)
{
    (void)state;
    static const int ends[1][2] = {{0, 1}};
    const cipc_spring spring = {.length = 1};
    const double inverse_mass[2] = {0, 1};
    massspring_bound *b = massspring_bound_create(ends, 1, 2);
    assert_non_null(b);
    double x[6] = {0, -1.5, 0, 0, 0.5, 0}, v[6] = {0};
    massspring_sheet sheet = {&spring, ends, 1, 2, inverse_mass, DT, x, v};
    floor_of f = {.inverse_mass = inverse_mass};
    bool kept = true;
    assert_int_equal(massspring_bound_sweep(b, &sheet, 0.1, TOLERANCE, 9, out_of_the_floor, &f, &kept), 9); /* the held end is too far below the floor */
    assert_true(!kept && x[4] == 0 && x[1] == -1.5 && f.calls == 9);
    x[1] = -1;
    assert_int_equal(massspring_bound_sweep(b, &sheet, 0.1, TOLERANCE, 9, out_of_the_floor, &f, &kept), 0);
    assert_true(kept && f.calls == 9);
    massspring_bound_destroy(b);
    massspring_bound_destroy(NULL);
}

/* What was moved is looked at again, also a spring that was done with in the same sweep. The first spring pulls node 0 down, after which the second one is within the bound; the floor lifts the node,
 * by which the first one hardly changes, and the second is beyond the bound. */
static void test_what_was_moved_is_looked_at_again(void **state)
{
    (void)state;
    static const int ends[2][2] = {{0, 1}, {0, 2}};
    const cipc_spring springs[2] = {{.length = 1}, {.length = 1}};
    const double inverse_mass[3] = {1, 0, 0};
    double x[9] = {0, 0, 0, 1.06, -0.02, 0, 0.010187, -1.05012, 0}, v[9] = {0};
    massspring_bound *b = massspring_bound_create(ends, 2, 3);
    assert_non_null(b);
    const massspring_sheet sheet = {springs, ends, 2, 3, inverse_mass, DT, x, v};
    floor_of f = {.inverse_mass = inverse_mass};
    bool kept = true;
    assert_int_equal(massspring_bound_sweep(b, &sheet, 0.05, TOLERANCE, 1, out_of_the_floor, &f, &kept), 1);
    assert_true(!kept && f.moved == 1);
    assert_true(massspring_bound_sweep(b, &sheet, 0.05, TOLERANCE, 50, out_of_the_floor, &f, &kept) == 50 && !kept); /* both cannot be had */
    massspring_bound_destroy(b);
}

static void test_no_memory(void **state)
{
    (void)state;
    static const int ends[1][2] = {{0, 1}};
    for (int k = 1; k <= 5; k++) {
        fail_allocation(k);
        assert_null(massspring_bound_create(ends, 1, 2));
        fail_allocation(0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_bits_of_the_plain_form),
        cmocka_unit_test(test_both_get_what_they_ask_for),
        cmocka_unit_test(test_what_is_said),
        cmocka_unit_test(test_what_was_moved_is_looked_at_again),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
