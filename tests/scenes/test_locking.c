/* Membrane locking (paper 7.1; SPEC E20): cloth on a ball, its membrane 1, 0.1 and 0.01 times that of cotton, bending left alone. A stiff membrane on a coarse mesh keeps the cloth from
 * bending; a soft one bends, and stretches more than cotton can; a soft one with a strain limit bends and keeps the limit, down to 0.1 %. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "support/claim.h"
#include "support/scene_run.h"
#include "support/validation.h"

static const char file[] = "tests/scenes/drape.json", nodes[] = "bodies.cloth.shell.irregular.nodes=200";

typedef struct drape {
    double stretch;     /* largest at any accepted point */
    double limit_used;  /* (stretch - 1) / (limit - 1); 0: none */
    double bend_radius; /* m: one over the root of the mean square of the curvature over the hinges, 3 theta / (h1 + h2) */
} drape;

/* Height of the triangle (a, b, tip) over its side a b. */
static double height_over(const double *a, const double *b, const double *tip)
{
    double e[3], d[3], n[3];
    v3_sub(e, b, a);
    v3_sub(d, tip, a);
    v3_cross(n, e, d);
    return sqrt(v3_dot(n, n) / v3_dot(e, e));
}

static double bend_radius(const cipc_model *m, const double *x)
{
    double sum = 0;
    int count = 0;
    for (int h = 0; h < m->hinge_count; h++) {
        double y[12];
        if (m->bodies[m->node_body[m->hinges[h][0]]].fixed) continue;
        for (int k = 0; k < 4; k++) memcpy(y + 3 * k, x + 3 * m->hinges[h][k], 3 * sizeof *y);
        double curvature = 3 * cipc_hinge_angle(y) / (height_over(y, y + 3, y + 6) + height_over(y, y + 3, y + 9));
        sum += curvature * curvature;
        count++;
    }
    return 1 / sqrt(sum / count);
}

static drape run(const char *membrane, const char *limit)
{
    const scene_request request = {.file = file, .overrides = {nodes, membrane, limit}, .threads = 1};
    scene_outcome outcome;
    cipc_scene *scene;
    cipc_error error;
    if (scene_run(&request, &outcome, &error)) fail_msg("%s, %s: %s: %s", membrane, limit, error.place, error.what);
    assert_int_equal(cipc_scene_load(&scene, file, 3, request.overrides, &error), CIPC_OK);
    drape d = {outcome.max_stretch, outcome.max_stretch_ratio, bend_radius(scene->model, outcome.position)};
    printf("  %s, %s: largest stretch %.5f, bend radius %.4f m\n", membrane, limit, d.stretch, d.bend_radius);
    cipc_scene_destroy(scene);
    scene_outcome_free(&outcome);
    return d;
}

static void test_membrane_locking(void **state)
{
    (void)state;
    static const char scene[] = "cloth on a ball, 200 nodes (E20)";
    static const char *const membranes[3] = {"bodies.cloth.membrane_factor=1", "bodies.cloth.membrane_factor=0.1", "bodies.cloth.membrane_factor=0.01"};
    static const char *const limits[3] = {"bodies.cloth.strain_limit.limit=1.0608", "bodies.cloth.strain_limit.limit=1.01", "bodies.cloth.strain_limit.limit=1.001"};
    static const double strain[3] = {0.0608, 0.01, 0.001};
    drape d[3], kept[3];
    char quantity[96];
    for (int k = 0; k < 3; k++) {
        d[k] = run(membranes[k], "bodies.cloth.strain_limit=false");
        validation_point("locking", "largest stretch - 1", pow(10, -k), d[k].stretch - 1);
        validation_point("locking", "bend radius, m", pow(10, -k), d[k].bend_radius);
    }
    /* Without a limit: the softer the membrane, the more it stretches; at first it bends more, too, until it stretches over the ball without a fold. */
    validation_range(scene, "bend radius, membrane 0.1 over 1", 0, 0.95, d[1].bend_radius / d[0].bend_radius);
    for (int k = 1; k < 3; k++) {
        (void)snprintf(quantity, sizeof quantity, "largest strain, membrane %g over %g", pow(10, -k), pow(10, 1 - k));
        validation_range(scene, quantity, 2, 100, (d[k].stretch - 1) / (d[k - 1].stretch - 1));
    }
    validation_range(scene, "largest strain, membrane 0.01 (cotton: 0.0608)", 0.0608, 10, d[2].stretch - 1);
    for (int k = 0; k < 3; k++) {
        kept[k] = run(membranes[2], limits[k]);
        (void)snprintf(quantity, sizeof quantity, "largest strain over a limit of %g, membrane 0.01", strain[k]);
        validation_range(scene, quantity, 0.5, 1, kept[k].limit_used);
        assert_true(kept[k].stretch - 1 < strain[k]);
    }
    validation_range(scene, "bend radius, membrane 0.01 with cotton's limit over membrane 1", 0, 0.95, kept[0].bend_radius / d[0].bend_radius);
    claim_figure("C13", "locking: bend radius, membrane 0.1 over 1", d[1].bend_radius / d[0].bend_radius, "1", CLAIM_LESS, 0.95);
    claim_figure("C13", "a soft membrane alone: largest strain, membrane 0.01 (cotton: 0.0608)", d[2].stretch - 1, "1", CLAIM_MORE, 0.0608);
    claim_figure("C13", "the cure: bend radius, membrane 0.01 with the limit 1.0608 over membrane 1", kept[0].bend_radius / d[0].bend_radius, "1", CLAIM_LESS, 0.95);
    claim_figure("C13", "the cure: largest strain, membrane 0.01 with the limit 1.0608", kept[0].stretch - 1, "1", CLAIM_LESS, 0.0608);
    claim_figure("C13", "the same with the limit 1.001", kept[2].stretch - 1, "1", CLAIM_LESS, 0.001);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_membrane_locking)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
