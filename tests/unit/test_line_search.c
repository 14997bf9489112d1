/* The line search: full steps, overshooting ones, steps cut by contact and strain limit, directions that lead nowhere. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/stepper.h"
#include "support/failing_memory.h"
#include "support/sheet_scene.h"

/* One triangle of side 1 at rest; `towards` is where its inertia pulls it, the same for all nodes. With `wall`, another triangle 0.1 under
 * it, fixed. */
static void make(sheet_scene *scene, double towards, bool wall, bool bare)
{
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 0, 1}, d[3] = {-1, -0.1, -1}, e[3] = {3, -0.1, -1}, f[3] = {-1, -0.1, 3};
    cipc_body_description *body = sheet_add_triangle(scene, "triangle", a, b, c);
    if (bare) body->material.membrane = CIPC_MEMBRANE_NONE;
    if (wall) sheet_add_triangle(scene, "wall", d, e, f)->fixed = true;
    sheet_scene_build(scene);
    sheet_begin(scene);
    for (int i = 0; i < 3; i++) scene->stepper->x_hat[3 * i + 1] += towards;
}

static double energy_at(sheet_scene *scene, const double *x, const cipc_contact_set *contacts)
{
    cipc_energy_terms terms;
    assert_int_equal(cipc_potential_value(scene->stepper, x, contacts, &terms, NULL), CIPC_OK);
    return terms.total;
}

typedef struct search {
    double before, after, slope, alpha;
    double start[9];
    cipc_status status;
} search;

/* Along p, the same for the three nodes of the triangle; noise > 0: in place of the rounding bound. */
static search try_noisy_search(sheet_scene *scene, const double p[3], double noise)
{
    cipc_stepper *s = scene->stepper;
    search r = {.alpha = NAN};
    memset(s->direction, 0, 3 * (size_t)scene->model->node_count * sizeof(double));
    for (int i = 0; i < 3; i++) v3_copy(s->direction + 3 * i, p);
    assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
    for (int i = 0; i < 9; i++) r.slope += s->gradient[i] * s->direction[i];
    memcpy(r.start, s->x, sizeof r.start);
    r.before = r.after = energy_at(scene, s->x, &s->contacts);
    if (noise > 0) s->noise = noise;
    r.status = cipc_line_search(s, 4, r.slope, &r.after, &r.alpha, &scene->error);
    return r;
}

static search try_search(sheet_scene *scene, const double p[3])
{
    return try_noisy_search(scene, p, 0);
}

static const double down[3] = {0, -1, 0};

/* The minimum at the end of the full step: taken at once; the energy is that of the new point. */
static void test_full_step(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    make(&scene, -1, false, false);
    search r = try_search(&scene, down);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(r.alpha == 1);
    assert_int_equal(scene.report.line_search_halvings, 0);
    for (int i = 0; i < 9; i++) assert_true(scene.stepper->x[i] == r.start[i] + scene.stepper->direction[i]);
    assert_true(r.after == energy_at(&scene, scene.stepper->x, &scene.stepper->contacts) && r.after < r.before);
    assert_null(scene.stepper->limit.what);
    sheet_scene_free(&scene);
}

/* E = (1 - 4 alpha)^2 E_0 along the way: 9 E_0 at 1, E_0 at 1/2, none at 1/4. Sufficient decrease wants the last; the released rule, E <=
 * E_0, takes the second. */
static void test_overshoot(void **state)
{
    (void)state;
    for (int released = 0; released < 2; released++) {
        sheet_scene scene;
        const double p[3] = {0, -4, 0};
        sheet_scene_init(&scene);
        scene.options.released = released;
        make(&scene, -1, false, true);
        search r = try_search(&scene, p);
        assert_int_equal(r.status, CIPC_OK);
        assert_true(r.alpha == (released ? 0.5 : 0.25));
        assert_int_equal(scene.report.line_search_halvings, released ? 1 : 2);
        assert_true(fabs(r.after - (released ? r.before : 0)) <= 1e-15 * r.before);
        sheet_scene_free(&scene);
    }
}

/* The same way, -8 E_0 steep at the start, with noise of 7 E_0: the point at 1/2 passes by its value, but it goes up there as steeply; so 1/4 again. With noise larger than the slope
 * there is nothing that could decide, and the first point is taken. */
static void test_overshoot_within_the_noise(void **state)
{
    (void)state;
    static const struct {
        double noise; /* E_0 */
        bool released;
        double alpha;
    } cases[] = {{7, false, 0.25}, {7, true, 0.5}, {8.5, false, 1}, {8.5, true, 1}};
    for (int i = 0; i < 4; i++) {
        sheet_scene scene;
        const double p[3] = {0, -4, 0};
        sheet_scene_init(&scene);
        scene.options.released = cases[i].released;
        make(&scene, -1, false, true);
        const double start = energy_at(&scene, scene.stepper->x, &scene.stepper->contacts), there = 1 - 4 * cases[i].alpha;
        search r = try_noisy_search(&scene, p, cases[i].noise * start);
        assert_int_equal(r.status, CIPC_OK);
        assert_true(r.alpha == cases[i].alpha);
        assert_true(scene.stepper->noise == cases[i].noise * start && fabs(r.after - there * there * start) <= 1e-14 * start);
        sheet_scene_free(&scene);
    }
}

/* Uphill: no step, nothing moves, and the reason is kept for the report. */
static void test_uphill(void **state)
{
    (void)state;
    sheet_scene scene;
    const double up[3] = {0, 1, 0};
    sheet_scene_init(&scene);
    scene.options.line_search_halvings = 12; /* 2^-12 uphill is still well above the noise */
    make(&scene, -1, false, true);
    search r = try_search(&scene, up);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(r.alpha == 0 && r.after == r.before);
    assert_int_equal(scene.report.line_search_halvings, 12);
    assert_true(sheet_same_bits(scene.stepper->x, r.start, 9));
    assert_string_equal(scene.stepper->limit.what, "energy decrease");
    assert_int_equal(scene.stepper->limit.nodes[0], -1);
    sheet_scene_free(&scene);
}

/* A wall at 0.1 of a way of 0.3: the step is what CCD certifies, 0.9 / 3 for parallel plates, and the pair is named. */
static void test_contact(void **state)
{
    (void)state;
    sheet_scene scene;
    const double p[3] = {0, -0.3, 0};
    sheet_scene_init(&scene);
    make(&scene, -0.3, true, false);
    search r = try_search(&scene, p);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(r.alpha < 0.1 / 0.3 && r.alpha > 0.2 / 0.3 * 0.1);
    assert_string_equal(scene.stepper->limit.what, "contact");
    bool across = false;
    for (int k = 1; k < 4; k++) across = across || (scene.stepper->limit.nodes[k] < 3) != (scene.stepper->limit.nodes[0] < 3);
    assert_true(across);
    assert_true(scene.stepper->x[1] > -0.1);
    sheet_scene_free(&scene);
}

/* The active contacts after a step are those of the new point. */
static void test_contacts_follow(void **state)
{
    (void)state;
    sheet_scene scene;
    const double p[3] = {0, -0.0995, 0};
    sheet_scene_init(&scene);
    scene.options.contact.dhat = 0.01;
    scene.options.barrier_stiffness = 1e-3;
    make(&scene, -0.3, true, false);
    assert_int_equal(scene.stepper->contacts.count, 0);
    search r = try_search(&scene, p);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(r.alpha > 0.9);
    assert_true(scene.stepper->contacts.count >= 3);
    assert_true(fabs(scene.stepper->contacts.min_gap - (0.1 - 0.0995 * r.alpha)) < 1e-12);
    assert_true(r.after == energy_at(&scene, scene.stepper->x, &scene.stepper->contacts));
    sheet_scene_free(&scene);
}

/* A triangle that loses its area has an infinite energy: the step is halved until it has not. */
static void test_infinite_energy(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    make(&scene, 0, false, false);
    cipc_stepper *s = scene.stepper;
    double alpha, energy;
    memset(s->direction, 0, 9 * sizeof(double));
    s->direction[3] = -1; /* node 1 onto node 0 at alpha = 1 */
    s->x_hat[3] = 0.25;
    assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
    energy = energy_at(&scene, s->x, &s->contacts);
    assert_int_equal(cipc_line_search(s, 0, s->gradient[3] * -1, &energy, &alpha, NULL), CIPC_OK);
    assert_true(alpha > 0 && alpha < 1 && isfinite(energy));
    sheet_scene_free(&scene);
}

/* The strain limit cuts the step before anything else. */
static void test_strain_limit(void **state)
{
    (void)state;
    sheet_scene scene;
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 0, 1};
    sheet_scene_init(&scene);
    cipc_body_description *body = sheet_add_triangle(&scene, "triangle", a, b, c);
    body->material.strain_limit = 1.1;
    body->material.strain_activation = 1.01;
    body->material.strain_stiffness = 1e-3;
    sheet_scene_build(&scene);
    sheet_begin(&scene);
    cipc_stepper *s = scene.stepper;
    memset(s->direction, 0, 9 * sizeof(double));
    s->direction[3] = 1;
    s->x_hat[3] = 2;
    assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
    double alpha, energy = energy_at(&scene, s->x, &s->contacts);
    assert_int_equal(cipc_line_search(s, 0, s->gradient[3], &energy, &alpha, NULL), CIPC_OK);
    assert_true(alpha > 0.045 && alpha < 0.1); /* 0.9 of the way to the limit, perhaps halved */
    assert_string_equal(s->limit.what, "strain limit");
    assert_true(cipc_strain_feasible(s, s->x));
    sheet_scene_free(&scene);
}

static cipc_status refuse(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    const search *want = context;
    assert_int_equal(point->iteration, 4);
    assert_true(point->energy_valid && point->energy_after < point->energy_before && point->energy_before == want->before);
    assert_true(point->energy_noise >= 0);
    return cipc_fail(error, CIPC_E_VIOLATED_GAP, "monitor", "no");
}

/* What the monitor returns is returned. */
static void test_monitor(void **state)
{
    (void)state;
    sheet_scene scene;
    search want;
    sheet_scene_init(&scene);
    make(&scene, -1, false, false);
    want.before = energy_at(&scene, scene.stepper->x, &scene.stepper->contacts);
    cipc_stepper_set_monitor(scene.stepper, refuse, &want);
    search r = try_search(&scene, down);
    assert_int_equal(r.status, CIPC_E_VIOLATED_GAP);
    sheet_scene_free(&scene);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1;
    for (bool failed = true; failed; n++) {
        sheet_scene scene;
        const double p[3] = {0, -0.0995, 0};
        sheet_scene_init(&scene);
        scene.options.contact.dhat = 0.01;
        scene.options.barrier_stiffness = 1e-3;
        make(&scene, -0.3, true, false);
        cipc_stepper *s = scene.stepper;
        double alpha, energy = energy_at(&scene, s->x, &s->contacts);
        assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
        for (int i = 0; i < 3; i++) v3_copy(s->direction + 3 * i, p);
        cipc_candidates_free(&s->cache.candidates);
        s->cache.slack = 0;
        fail_allocation(n);
        cipc_status status = cipc_line_search(s, 0, -1, &energy, &alpha, &scene.error);
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        sheet_scene_free(&scene);
    }
    assert_true(n > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_overshoot_within_the_noise),
        cmocka_unit_test(test_full_step),    cmocka_unit_test(test_overshoot),       cmocka_unit_test(test_uphill),
        cmocka_unit_test(test_contact),      cmocka_unit_test(test_contacts_follow), cmocka_unit_test(test_infinite_energy),
        cmocka_unit_test(test_strain_limit), cmocka_unit_test(test_monitor),         cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
