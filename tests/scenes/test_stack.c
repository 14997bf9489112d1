/* Ten sheets come to rest on a floor (SPEC E4, E19): at dhat = 1, 5 and 10 mm, with and without thickness, the stack's height lies between N xi and N (xi + dhat), and every gap between sheets is smaller
 * than the one above it, because it carries more. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/implicit.h"
#include "cipc/invariant.h"
#include "support/claim.h"
#include "support/validation.h"

enum { SHEETS = 10, NODES = 9, TRIANGLES = 8 };

/* 3 x 3 nodes, 0.1 m wide, at a height. */
static void make_sheet(double height, double width, double x[3 * NODES])
{
    for (int i = 0; i < NODES; i++) {
        x[3 * i] = width * (i % 3 - 1) / 2;
        x[3 * i + 1] = height;
        x[3 * i + 2] = width * (i / 3 - 1) / 2;
    }
}

static const int triangles[TRIANGLES][3] = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}, {3, 6, 4}, {4, 6, 7}, {4, 7, 5}, {5, 7, 8}};

typedef struct stack {
    cipc_model *model;
    cipc_state *state;
    cipc_stepper *stepper;
    cipc_monitor *monitor;
} stack;

static cipc_status watch(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    return cipc_monitor_check(((stack *)context)->monitor, point->x, NULL, error);
}

/* The floor and SHEETS sheets, a little less than dhat + xi apart. */
static void make(stack *s, double dhat, double xi)
{
    static double x[SHEETS + 1][3 * NODES];
    cipc_body_description d[SHEETS + 1];
    cipc_error error;
    const double gravity[3] = {0, -9.81, 0};
    memset(d, 0, sizeof d);
    for (int b = 0; b <= SHEETS; b++) {
        make_sheet(0.95 * (dhat + xi) * b, b ? 0.1 : 0.2, x[b]);
        (void)snprintf(d[b].name, sizeof d[b].name, "sheet %d", b);
        d[b].material = (cipc_material){.density = 500, .thickness = 3e-4, .membrane = CIPC_MEMBRANE_NEO_HOOKEAN, .membrane_young = 1e5, .membrane_poisson = 0.3, .bending_young = 1e6, .bending_poisson = 0.3};
        d[b].offset = xi;
        d[b].friction = 0.3; /* without, the least asymmetry lets a sheet slide off */
        d[b].fixed = b == 0;
        d[b].node_count = NODES;
        d[b].rest = d[b].position = x[b];
        d[b].triangle_count = TRIANGLES;
        d[b].triangles = triangles;
    }
    cipc_implicit_options options = cipc_implicit_options_default();
    options.time_step = 0.02;
    options.newton_tolerance = 1e-5;
    options.contact.dhat = dhat;
    if (cipc_model_create(&s->model, d, SHEETS + 1, gravity, &error)) fail_msg("%s", error.what);
    assert_int_equal(cipc_state_create(&s->state, d, SHEETS + 1, &error), CIPC_OK);
    assert_int_equal(cipc_stepper_create(&s->stepper, s->model, &options, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_create(&s->monitor, s->model, NULL, &error), CIPC_OK);
    cipc_stepper_set_monitor(s->stepper, watch, s);
}

static void free_stack(stack *s)
{
    cipc_monitor_destroy(s->monitor);
    cipc_stepper_destroy(s->stepper);
    cipc_state_destroy(s->state);
    cipc_model_destroy(s->model);
}

/* Mean height of a sheet. */
static double height(const stack *s, int sheet)
{
    double sum = 0;
    for (int i = 0; i < NODES; i++) sum += s->state->position[3 * (NODES * sheet + i) + 1];
    return sum / NODES;
}

static void test_heights(void **state)
{
    (void)state;
    const double ranges[3] = {1e-3, 5e-3, 1e-2}, offsets[2] = {0, 2e-3};
    double lowest = INFINITY, highest = -INFINITY; /* height above N xi, over N dhat */
    for (int r = 0; r < 3; r++)
        for (int o = 0; o < 2; o++) {
            stack s;
            cipc_step_report report;
            cipc_error error;
            double dhat = ranges[r], xi = offsets[o], above = INFINITY;
            make(&s, dhat, xi);
            for (int step = 0; step < 150; step++)
                if (cipc_step(s.stepper, s.state, &report, &error)) fail_msg("%s: %s", error.place, error.what);
            double top = height(&s, SHEETS);
            char title[96];
            (void)snprintf(title, sizeof title, "ten sheets at rest, dhat = %g mm, xi = %g mm (E19)", 1e3 * dhat, 1e3 * xi);
            validation_range(title, "height, m", SHEETS * xi, SHEETS * (xi + dhat), top);
            lowest = fmin(lowest, (top - SHEETS * xi) / (SHEETS * dhat));
            highest = fmax(highest, (top - SHEETS * xi) / (SHEETS * dhat));
            for (int sheet = SHEETS; sheet >= 2; sheet--) { /* the floor has other triangles than the sheets, so the lowest gap compares with none */
                double gap = height(&s, sheet) - height(&s, sheet - 1) - xi;
                char curve[64];
                (void)snprintf(curve, sizeof curve, "dhat = %g mm, xi = %g mm", 1e3 * dhat, 1e3 * xi);
                validation_point("stack", curve, sheet, gap / dhat);
                if (!(gap > 0 && gap < above)) fail_msg("dhat %g, xi %g: below sheet %d the gap is %g, above it %g", dhat, xi, sheet, gap, above);
                above = gap;
            }
            assert_true(report.kinetic < 1e-9);
            free_stack(&s);
        }
    claim_figure("C9 stacks", "ten sheets, dhat = 1, 5, 10 mm, xi = 0, 2 mm: (height - N xi)/(N dhat), smallest", lowest, "1", CLAIM_MORE, 0);
    claim_figure("C9 stacks", "the same, largest", highest, "1", CLAIM_LESS, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_heights)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
