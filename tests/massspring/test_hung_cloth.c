/* Cloth hung by two corners (fig. 4 of the paper): without the bound on deformation the springs at the pins are drawn out far beyond the others; with it none is, after any step. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/claim.h"
#include "support/spring_sheet.h"

/* A square metre, 0.2 kg/m^2, of springs soft enough for the pins to show; the bound that the specification suggests. */
enum { COLUMNS = 16, ROWS = 18, SWEEPS = 2000 };
static const double EDGE = 1.0 / 16.5, DENSITY = 0.2, STIFFNESS = 20, BOUND = 0.1, TOLERANCE = 1e-3;

static const int (*ends_of(const spring_sheet *s))[2] { return (const int(*)[2])s->topology.ends; }
static double greatest_of(const spring_sheet *s) { return cipc_deformation_greatest(s->springs, ends_of(s), s->topology.structural_count, s->x); }

/* Let go lying flat; held at both corners of one straight side. */
static spring_sheet hang_up(void)
{
    const cipc_spring spring = {.stiffness = STIFFNESS, .damping = 0.01};
    spring_sheet s;
    spring_sheet_init(&s, EDGE, COLUMNS, ROWS, DENSITY, &spring, 0.05);
    s.inverse_mass[0] = s.inverse_mass[COLUMNS] = 0;
    s.gravity[1] = -9.81;
    s.drag = 2;
    s.step = 0.9 * cipc_spring_stable_step(s.springs, ends_of(&s), s.topology.count, 0, 0, s.inverse_mass, s.node_count);
    return s;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median over the structural springs: what the cloth is like away from the pins. */
static double median_of(const spring_sheet *s)
{
    const int count = s->topology.structural_count;
    double *each = calloc((size_t)count, sizeof *each);
    assert_non_null(each);
    for (int i = 0; i < count; i++) each[i] = cipc_deformation_greatest(s->springs + i, ends_of(s) + i, 1, s->x);
    qsort(each, (size_t)count, sizeof *each, compare);
    const double median = each[count / 2];
    free(each);
    return median;
}

/* Is an end of the longest spring, by its own length, held? */
static bool worst_is_at_a_pin(const spring_sheet *s)
{
    const double greatest = greatest_of(s);
    for (int i = 0; i < s->topology.structural_count; i++) {
        if (cipc_deformation_greatest(s->springs + i, ends_of(s) + i, 1, s->x) < greatest) continue;
        return s->inverse_mass[ends_of(s)[i][0]] == 0 || s->inverse_mass[ends_of(s)[i][1]] == 0;
    }
    return false;
}

typedef struct history {
    double greatest, at_end; /* B after any step, and after the last */
    int steps, used_up;      /* of these, with sweeps used up */
    double momentum;         /* largest change of linear momentum by a projection over sweeps * 2^-52 of the sum of m |v| */
} history;

static void linear_momentum(const spring_sheet *s, double p[3], double *size)
{
    for (int k = 0; k < 3; k++) p[k] = 0;
    for (int i = 0; i < 3 * s->node_count; i++) {
        p[i % 3] += s->mass[i / 3] * s->v[i];
        *size += s->mass[i / 3] * fabs(s->v[i]);
    }
}

static void bound(spring_sheet *s, history *h)
{
    double greatest, before[3], after[3], size = 0;
    linear_momentum(s, before, &size);
    const int sweeps =
        cipc_deformation_project(s->springs, ends_of(s), s->topology.structural_count, BOUND, TOLERANCE, SWEEPS, s->inverse_mass, s->step, s->x, s->v, &greatest);
    linear_momentum(s, after, &size);
    for (int k = 0; k < 3; k++) h->momentum = fmax(h->momentum, fabs(after[k] - before[k]) / (fmax(sweeps, 1) * DBL_EPSILON * size));
    h->used_up += !(greatest <= BOUND * (1 + TOLERANCE));
}

static history run(spring_sheet *s, double seconds, bool bounded)
{
    history h = {0};
    for (; h.steps * s->step < seconds; h.steps++) {
        spring_sheet_step(s);
        if (bounded) bound(s, &h);
        h.at_end = greatest_of(s);
        h.greatest = fmax(h.greatest, h.at_end);
    }
    return h;
}

static void test_hung_by_two_corners(void **state)
{
    (void)state;
    spring_sheet s = hang_up(), t = hang_up();
    const history loose = run(&s, 4, false), bounded = run(&t, 4, true);
    printf("median B %g without the bound, %g with it\n", median_of(&s), median_of(&t));
    claim_figure("B1", "hung by two corners, without the bound: largest B after 4 s", loose.at_end, "1", CLAIM_MORE, 0.4);
    claim_figure("B1", "without the bound: largest B over its median", loose.at_end / median_of(&s), "1", CLAIM_MORE, 10);
    claim_figure("B1", "with Bmax = 0.1: largest B after any step", bounded.greatest, "1", CLAIM_AT_MOST, 0.1001);
    claim_figure("B1", "with Bmax: steps in which 2000 sweeps did not do", bounded.used_up, "1", CLAIM_EQUAL, 0);
    claim_figure("B1", "with Bmax: steps", bounded.steps, "1", CLAIM_MORE, 2000);
    assert_true(worst_is_at_a_pin(&s));
    assert_true(median_of(&t) < BOUND / 5); /* the rest of the cloth is not drawn to the bound instead */
    spring_sheet_free(&s);
    spring_sheet_free(&t);
}

/* A free sheet thrown so that it spins, which draws it out beyond the bound: the projection moves nothing as a whole. */
static void test_thrown_and_spinning(void **state)
{
    (void)state;
    const cipc_spring spring = {.stiffness = STIFFNESS, .damping = 0.01};
    spring_sheet s;
    spring_sheet_init(&s, EDGE, COLUMNS, ROWS, DENSITY, &spring, 0.05);
    s.step = 0.9 * cipc_spring_stable_step(s.springs, ends_of(&s), s.topology.count, 0, 0, s.inverse_mass, s.node_count);
    for (int i = 0; i < s.node_count; i++) {
        s.v[3 * i] = 1 - 12 * s.x[3 * i + 2];
        s.v[3 * i + 1] = 2;
        s.v[3 * i + 2] = 12 * s.x[3 * i];
    }
    const history h = run(&s, 1, true);
    claim_figure("B1", "thrown, spinning, with Bmax: largest B after any step", h.greatest, "1", CLAIM_AT_MOST, 0.1001);
    claim_figure("B1", "thrown: change of linear momentum by a projection over sweeps * 2^-52 of the sum of m |v|, largest", h.momentum, "1", CLAIM_AT_MOST, 1);
    assert_int_equal(h.used_up, 0);
    assert_true(h.momentum > 0); /* it was at work */
    spring_sheet_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hung_by_two_corners),
        cmocka_unit_test(test_thrown_and_spinning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
