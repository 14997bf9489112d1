/* The strain limit on the iterate: feasible points, the largest feasible step (closed form), stiffness doubling. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "implicit/stepper.h"
#include "support/exact_geometry.h"
#include "support/sheet_scene.h"

static const double limit = 1.1, activation = 1.02, stiffness = 1e3;

/* `count` right triangles of legs 1, far from one another, limited. */
static void make(sheet_scene *scene, int count, bool released)
{
    sheet_scene_init(scene);
    scene->options.released = released;
    for (int i = 0; i < count; i++) {
        const double a[3] = {10 * i, 0, 0}, b[3] = {10 * i + 1, 0, 0}, c[3] = {10 * i, 0, 1};
        cipc_body_description *body = sheet_add_triangle(scene, "triangle", a, b, c);
        body->material.strain_limit = limit;
        body->material.strain_activation = activation;
        body->material.strain_stiffness = stiffness;
    }
    sheet_scene_build(scene);
    sheet_begin(scene);
}

/* Feasible means strictly below the limit, with 2^-46 to spare, and so does the exact stretch say. */
static void test_feasible(void **state)
{
    (void)state;
    sheet_scene scene;
    make(&scene, 2, false);
    cipc_stepper *s = scene.stepper;
    assert_true(cipc_strain_feasible(s, s->x));
    s->x[3] = limit * (1 - 0x1p-40);
    assert_true(cipc_strain_feasible(s, s->x));
    assert_int_equal(cipc_exact_compare_stretch(scene.model->rest, s->x, limit), 1);
    s->x[3] = limit * (1 - 0x1p-50); /* too close to tell in doubles */
    assert_false(cipc_strain_feasible(s, s->x));
    s->x[3] = limit * (1 + 0x1p-40);
    assert_false(cipc_strain_feasible(s, s->x));
    s->x[3] = NAN;
    assert_false(cipc_strain_feasible(s, s->x));
    s->x[3] = 0.5; /* compression is not limited */
    assert_true(cipc_strain_feasible(s, s->x));
    sheet_scene_free(&scene);
}

/* The exact stretch is below the limit wherever the solver says so: random shapes, bisected to the last feasible point. */
static void test_feasible_is_exact(void **state)
{
    (void)state;
    uint64_t seed = 81;
    sheet_scene scene;
    make(&scene, 1, false);
    cipc_stepper *s = scene.stepper;
    for (int trial = 0; trial < 300; trial++) {
        double p[9], x[9], low = 0, high = 1;
        random_fill(&seed, p, 9, 2);
        for (int k = 0; k < 70; k++) {
            double t = 0.5 * (low + high);
            for (int i = 0; i < 9; i++) x[i] = scene.model->rest[i] + t * p[i];
            if (cipc_strain_feasible(s, x))
                low = t;
            else
                high = t;
        }
        for (int i = 0; i < 9; i++) x[i] = scene.model->rest[i] + low * p[i];
        assert_true(cipc_strain_feasible(s, x));
        assert_int_equal(cipc_exact_compare_stretch(scene.model->rest, x, limit), 1);
    }
    sheet_scene_free(&scene);
}

/* Node 1 drawn along its edge by L: sigma_1 = 1 + t L, so the limit is met at t = (limit - 1) / L, and the step is 0.9 of that, to 2^-20 of
 * bisection. */
static void test_closed_form(void **state)
{
    (void)state;
    static const double lengths[] = {0.11, 0.2, 1, 30};
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        for (int which = 0; which < 3; which++) {
            sheet_scene scene;
            double p[27] = {0};
            make(&scene, 3, false);
            p[9 * which + 3] = lengths[k];
            p[9 * ((which + 1) % 3) + 3] = 0.5 * lengths[k]; /* another one, less limiting */
            double step = cipc_strain_step(scene.stepper, scene.stepper->x, p), want = 0.9 * (limit - 1) / lengths[k];
            assert_true(fabs(step - want) <= 0x1p-19 * 0.9);
            assert_string_equal(scene.stepper->limit.what, "strain limit");
            const int nodes[4] = {3 * which, 3 * which + 1, 3 * which + 2, -1};
            assert_memory_equal(scene.stepper->limit.nodes, nodes, sizeof nodes);
            sheet_scene_free(&scene);
        }
}

/* Steps that stay below the limit are not touched, and nothing is said about a limit. */
static void test_free_steps(void **state)
{
    (void)state;
    sheet_scene scene;
    make(&scene, 1, false);
    double p[9] = {0, 0, 0, 0.09, 0, 0, 0, 0, -3};
    scene.stepper->limit.what = NULL;
    p[8] = -0.5;
    assert_true(cipc_strain_step(scene.stepper, scene.stepper->x, p) == 1);
    assert_null(scene.stepper->limit.what);
    sheet_scene_free(&scene);
}

/* As released: halved from 1 until feasible (SPEC R.2). */
static void test_released_step(void **state)
{
    (void)state;
    static const double lengths[] = {0.11, 0.19, 0.21, 1, 30};
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) {
        sheet_scene scene;
        make(&scene, 1, true);
        double p[9] = {0, 0, 0, lengths[k], 0, 0, 0, 0, 0}, want = 1;
        while (1 + want * lengths[k] >= limit) want *= 0.5;
        double step = cipc_strain_step(scene.stepper, scene.stepper->x, p);
        assert_true(fabs(step - want) <= 4 * UNIT_ROUNDOFF * want);
        sheet_scene_free(&scene);
    }
}

/* Doubling when the same triangle is within 1e-4 (s - shat) of the limit twice in a row, up to 1e5 Pa (SPEC C.2). */
static void test_adapt(void **state)
{
    (void)state;
    sheet_scene scene;
    make(&scene, 2, false);
    cipc_stepper *s = scene.stepper;
    double slack = 1e-4 * (limit - activation);
    assert_false(cipc_strain_adapt(s)); /* far */
    s->x[3] = limit - 0.5 * slack;
    assert_false(cipc_strain_adapt(s)); /* near, once */
    s->x[3] = 1;
    s->x[12] = 10 + limit - 0.5 * slack;
    assert_false(cipc_strain_adapt(s)); /* another one is near now */
    assert_true(cipc_strain_adapt(s));  /* the same twice */
    assert_true(s->strain_factor == 2);
    assert_true(cipc_strain_adapt(s)); /* and thrice */
    s->x[12] = 10 + limit - 2 * slack;
    assert_false(cipc_strain_adapt(s)); /* no longer near */
    assert_true(s->strain_factor == 4);
    s->x[12] = 10 + limit - 0.5 * slack;
    assert_false(cipc_strain_adapt(s));
    double before = 0;
    for (int k = 0; k < 20; k++) {
        before = s->strain_factor;
        if (!cipc_strain_adapt(s)) break;
        assert_true(s->strain_factor > before && s->strain_factor <= 2 * before);
    }
    assert_true(s->strain_factor * stiffness == 1e5); /* the cap, exactly */
    assert_false(cipc_strain_adapt(s));
    sheet_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_feasible),   cmocka_unit_test(test_feasible_is_exact), cmocka_unit_test(test_closed_form),
        cmocka_unit_test(test_free_steps), cmocka_unit_test(test_released_step),     cmocka_unit_test(test_adapt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
