/* The five measured fabrics (paper, eqs 8-10; SPEC C4), their moduli times 1, 0.1 and 0.01, hung by two corners and draped: every step converges and every limit holds at every accepted
 * point, the softest cloth near its limits. Smaller than the scenes' size ci. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/claim.h"
#include "support/scene_run.h"

static const char *const fabrics[] = {"cotton", "wool", "canvas", "silk", "denim"};
static const double factors[] = {1, 0.1, 0.01};

/* Largest used part of a limit in one run. */
static double run(const char *scene, const char *fabric, double factor, const char *nodes, const char *steps)
{
    char file[64], of[64], by[64];
    (void)snprintf(file, sizeof file, "tests/scenes/%s.json", scene);
    (void)snprintf(of, sizeof of, "bodies.cloth.membrane.fabric=%s", fabric);
    (void)snprintf(by, sizeof by, "bodies.cloth.membrane.factor=%g", factor);
    const scene_request request = {.file = file, .overrides = {of, by, nodes, steps}, .threads = 1};
    scene_outcome outcome;
    cipc_error error;
    if (scene_run(&request, &outcome, &error)) fail_msg("%s of %s, factor %g: %s: %s", scene, fabric, factor, error.place, error.what);
    double used = outcome.max_stretch_ratio;
    scene_outcome_free(&outcome);
    return used;
}

/* The largest used part of a limit in all runs. */
static double assert_limits(const char *scene, const char *nodes, const char *steps, double most_used_at_least)
{
    double most = 0;
    for (size_t f = 0; f < sizeof fabrics / sizeof *fabrics; f++) {
        double before = 0;
        for (size_t k = 0; k < sizeof factors / sizeof *factors; k++) {
            double used = run(scene, fabrics[f], factors[k], nodes, steps);
            printf("  %s, %s, moduli times %g: limits used up to %.4f\n", scene, fabrics[f], factors[k], used);
            if (!(used < 1 && used > before)) fail_msg("%s: limits used up to %g, and %g with stiffer cloth", fabrics[f], used, before);
            before = used;
        }
        assert_true(before > most_used_at_least);
        most = fmax(most, before);
    }
    return most;
}

static void test_hang(void **state)
{
    (void)state;
    double used = assert_limits("orthotropic-hang", "bodies.cloth.shell.irregular.nodes=80", "steps=16", 0.9);
    claim_figure("C4 fabrics", "hung, moduli times 1, 0.1, 0.01: part of a limit used at any accepted point", used, "1", CLAIM_LESS, 1);
}

static void test_drape(void **state)
{
    (void)state;
    double used = assert_limits("orthotropic-drape", "bodies.cloth.shell.irregular.nodes=80", "steps=12", 0.5);
    claim_figure("C4 fabrics", "draped, moduli times 1, 0.1, 0.01: part of a limit used at any accepted point", used, "1", CLAIM_LESS, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hang), cmocka_unit_test(test_drape)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
