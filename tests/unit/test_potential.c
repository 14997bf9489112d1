/* The incremental potential: every term, its gradient and the bound on its rounding error against a twin in long double. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>

#include "support/crowded_scene.h"
#include "support/failing_memory.h"

static void widen(const double *x, int n, real *wide)
{
    for (int i = 0; i < n; i++) wide[i] = x[i];
}

static cipc_energy_terms value_at(sheet_scene *scene, const double *x)
{
    cipc_energy_terms terms;
    assert_int_equal(cipc_potential_value(scene->stepper, x, &scene->stepper->contacts, &terms, &scene->error), CIPC_OK);
    return terms;
}

typedef struct variant {
    cipc_integrator integrator;
    double penalty;
    bool released;
} variant;
static const variant variants[] = {
    {{1, 1, 0}, 0, false}, {{1, 0.5, 0.5}, 0, false}, {{1, 1, 0}, 1e6, false}, {{1, 0.5, 0.5}, 1e8, false}, {{1, 1, 0}, 0, true}};
enum { VARIANTS = 5, SEEDS = 20, MOST_NODES = 64 };

static void make(sheet_scene *scene, uint64_t seed, const variant *v)
{
    crowded_scene(scene, seed, v->integrator, v->penalty, 1);
    scene->stepper->options.released = v->released;
    assert_true(scene->model->node_count <= MOST_NODES);
}

/* What is to be tested is there: all four kinds of contact stencil, mollified ones, short friction stencils. */
static void test_scene_is_crowded(void **state)
{
    (void)state;
    int kinds[4] = {0}, mollified = 0, short_friction = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        sheet_scene scene;
        make(&scene, seed, &variants[0]);
        const cipc_stepper *s = scene.stepper;
        for (int i = 0; i < s->contacts.count; i++) {
            kinds[s->contacts.contacts[i].energy - CIPC_ENERGY_BARRIER_POINT_POINT]++;
            mollified += s->contacts.contacts[i].barrier.mollifier_eps > 0;
        }
        for (int i = 0; i < s->friction.count; i++) short_friction += s->friction.nodes[i][3] == s->friction.nodes[i][0];
        sheet_scene_free(&scene);
    }
    for (int k = CIPC_POINT_EDGE; k <= CIPC_EDGE_EDGE; k++) assert_true(kinds[k] > 0);
    assert_true(mollified > 0 && short_friction > 0);
}

/* Every term to a few parts in 1e12 of itself, and none is zero where it should not be; the total within the noise that the stepper claims.
 */
static void test_value_and_noise(void **state)
{
    (void)state;
    double tightest = INFINITY;
    for (int v = 0; v < VARIANTS; v++)
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            sheet_scene scene;
            real x[3 * MOST_NODES], want[REAL_TERMS];
            make(&scene, seed, &variants[v]);
            cipc_stepper *s = scene.stepper;
            assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
            cipc_energy_terms got = value_at(&scene, s->x);
            widen(s->x, 3 * scene.model->node_count, x);
            real_potential(s, x, want);
            const double terms[REAL_TERMS] = {got.inertia, got.membrane, got.bending, got.strain_limit,
                                              got.barrier, got.friction, got.penalty, got.total};
            for (int t = 0; t < REAL_TERMS; t++) {
                /* relative errors of a term: 32 u by the head of potential.c, times the cancellation in the membrane's strain, 1e-3 here,
                 * twice */
                if (!(fabsl(terms[t] - want[t]) <= 1e-11L * fabsl(want[t])))
                    fail_msg("variant %d, seed %d, term %d: %.17g, not %.17Lg", v, (int)seed, t, terms[t], want[t]);
                assert_true((want[t] != 0) == (t != REAL_PENALTY || variants[v].penalty > 0));
            }
            assert_true(got.noise > 0 && got.noise == s->noise);
            double error = (double)fabsl(got.total - want[REAL_TOTAL]);
            if (!(error <= got.noise)) fail_msg("variant %d, seed %d: rounding error %g, bound %g", v, (int)seed, error, got.noise);
            tightest = fmin(tightest, got.noise / error);
            assert_true(got.noise < 1e-9 * got.total); /* a bound that says something */
            sheet_scene_free(&scene);
        }
    assert_true(tightest < 1e4); /* ... and is not far from what happens */
}

/* The bound holds, too, where one kind of term is alone: inertia (nothing else has noise there), and friction of sheets that fly along
 * together, where the displacements of the nodes cancel. */
static void test_noise_of_single_terms(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++)
        for (int slide = 0; slide < 2; slide++) {
            sheet_scene scene;
            real x[3 * MOST_NODES], want[REAL_TERMS];
            make(&scene, seed, &variants[0]);
            cipc_stepper *s = scene.stepper;
            for (int g = 0; g < CIPC_GROUP_COUNT; g++) s->groups[g].count = 0;
            s->contacts.count = 0;
            if (!slide) s->friction.count = 0;
            for (int i = 0; i < 3 * scene.model->node_count; i++) s->x_hat[i] = s->x[i] + (slide ? 0 : random_uniform(&seed, -1, 1));
            for (int i = 0; slide && i < s->friction.count; i++)
                for (int k = 0; k < 12; k += 3) s->friction.params[i].start[k] -= 1e3 / 3;
            assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
            widen(s->x, 3 * scene.model->node_count, x);
            real_potential(s, x, want);
            double error = (double)fabsl(value_at(&scene, s->x).total - want[REAL_TOTAL]);
            if (!(error <= s->noise)) fail_msg("slide %d, seed %d: rounding error %g, bound %g", slide, (int)seed, error, s->noise);
            assert_true(s->noise > 0);
            sheet_scene_free(&scene);
        }
}

/* Central differences of the twin with step d: truncation (d / gap)^2 of the stiffest term, 1e-9 here; rounding 2^-64 E / d. Relative to
 * the largest entry. */
static const real step_of_differences = 1e-7L;
static const double gradient_tolerance = 1e-7;

static double potential_gradient_error(sheet_scene *scene)
{
    cipc_stepper *s = scene->stepper;
    real x[3 * MOST_NODES], forward[REAL_TERMS], backward[REAL_TERMS];
    double worst = 0, size = 0;
    widen(s->x, 3 * scene->model->node_count, x);
    for (int i = 0; i < 3 * scene->model->node_count; i++) {
        if (s->is_dirichlet[i / 3]) {
            assert_true(s->gradient[i] == 0);
            continue;
        }
        x[i] += step_of_differences;
        real_potential(s, x, forward);
        x[i] -= 2 * step_of_differences;
        real_potential(s, x, backward);
        x[i] += step_of_differences;
        double want = (double)((forward[REAL_TOTAL] - backward[REAL_TOTAL]) / (2 * step_of_differences));
        worst = fmax(worst, fabs(want - s->gradient[i]));
        size = fmax(size, fabs(want));
    }
    return worst / size;
}

static void test_gradient(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++)
        for (uint64_t seed = 1; seed <= 4; seed++) {
            sheet_scene scene;
            make(&scene, seed, &variants[v]);
            assert_int_equal(cipc_potential_gradient(scene.stepper, NULL), CIPC_OK);
            double error = potential_gradient_error(&scene);
            if (!(error < gradient_tolerance)) fail_msg("variant %d, seed %d: error %g", v, (int)seed, error);
            for (int i = 0; i < 3 * scene.model->node_count; i++) scene.stepper->gradient[i] *= 1 + 1e-5; /* the check can fail */
            assert_false(potential_gradient_error(&scene) < gradient_tolerance);
            sheet_scene_free(&scene);
        }
}

/* Value and gradient do not depend on the number of threads. */
static void test_threads(void **state)
{
    (void)state;
    double gradient[4][3 * MOST_NODES], total[4], noise[4];
    for (int threads = 1; threads <= 4; threads++) {
        sheet_scene scene;
        crowded_scene(&scene, 7, crowded_midpoint, 1e6, threads);
        assert_int_equal(cipc_potential_gradient(scene.stepper, NULL), CIPC_OK);
        memcpy(gradient[threads - 1], scene.stepper->gradient, 3 * (size_t)scene.model->node_count * sizeof(double));
        total[threads - 1] = value_at(&scene, scene.stepper->x).total;
        noise[threads - 1] = scene.stepper->noise;
        assert_memory_equal(gradient[0], gradient[threads - 1], 3 * (size_t)scene.model->node_count * sizeof(double));
        assert_true(total[0] == total[threads - 1] && noise[0] == noise[threads - 1]);
        sheet_scene_free(&scene);
    }
}

/* Infeasible points have infinite potential, whatever the term. */
static void test_infeasible(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 3, crowded_euler, 0, 1);
    cipc_stepper *s = scene.stepper;
    double x[3 * MOST_NODES];
    memcpy(x, s->x, 3 * (size_t)scene.model->node_count * sizeof(double));
    int limited = s->groups[CIPC_GROUP_STRAIN_LIMIT].nodes[0];
    x[3 * limited] -= 1; /* far beyond the limit */
    assert_true(value_at(&scene, x).strain_limit == INFINITY);
    assert_true(value_at(&scene, x).total == INFINITY);
    memcpy(x, s->x, 3 * (size_t)scene.model->node_count * sizeof(double));
    const int *nodes = s->groups[CIPC_GROUP_NEO_HOOKEAN].nodes;
    v3_copy(x + 3 * nodes[0], x + 3 * nodes[1]); /* collapsed */
    assert_true(value_at(&scene, x).membrane == INFINITY);
    sheet_scene_free(&scene);
}

/* kappa that balances the barrier against the rest of E in the least-squares sense: afterwards the residual is orthogonal to the barrier's
 * gradient. */
static void test_fit_stiffness(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        sheet_scene scene;
        double kappa, barrier[3 * MOST_NODES], across = 0, size = 0;
        crowded_scene(&scene, seed, crowded_euler, 0, 1);
        cipc_stepper *s = scene.stepper;
        int n = 3 * scene.model->node_count;
        s->friction.count = 0; /* the fit is without friction */
        assert_int_equal(cipc_fit_stiffness(s, &kappa, NULL), CIPC_OK);
        assert_true(kappa != 0 && isfinite(kappa));
        double old = s->kappa, gradients[2][3 * MOST_NODES];
        for (int k = 0; k < 2; k++) { /* the gradient is affine in kappa: two of them give the barrier's */
            for (int i = 0; i < s->contacts.count; i++) s->contacts.contacts[i].barrier.stiffness = k ? kappa : old;
            assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
            memcpy(gradients[k], s->gradient, (size_t)n * sizeof(double));
        }
        for (int i = 0; i < n; i++) {
            barrier[i] = (gradients[1][i] - gradients[0][i]) / (kappa - old);
            across += barrier[i] * gradients[1][i];
            size += fabs(barrier[i] * gradients[1][i]);
        }
        assert_true(fabs(across) <= 1e-9 * size); /* differences of gradients lose a few digits */
        s->contacts.count = 0;
        assert_int_equal(cipc_fit_stiffness(s, &kappa, NULL), CIPC_OK);
        assert_true(kappa == 0); /* no contact, nothing to fit */
        sheet_scene_free(&scene);
    }
}

/* Both buffers may be refused. */
static void test_out_of_memory(void **state)
{
    (void)state;
    for (int which = 0; which < 3; which++)
        for (long n = 1;; n++) {
            sheet_scene scene;
            cipc_energy_terms terms;
            cipc_status status;
            double kappa;
            crowded_scene(&scene, 1, crowded_euler, 0, 1);
            cipc_stepper *s = scene.stepper;
            fail_allocation(n);
            if (which == 0)
                status = cipc_potential_value(s, s->x, &s->contacts, &terms, &scene.error);
            else if (which == 1)
                status = cipc_potential_gradient(s, &scene.error);
            else
                status = cipc_fit_stiffness(s, &kappa, &scene.error);
            bool failed = allocation_failed();
            fail_allocation(0);
            assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
            sheet_scene_free(&scene);
            if (failed) continue;
            assert_true(n > 1);
            break;
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scene_is_crowded), cmocka_unit_test(test_value_and_noise), cmocka_unit_test(test_noise_of_single_terms),
        cmocka_unit_test(test_gradient),         cmocka_unit_test(test_threads),         cmocka_unit_test(test_infeasible),
        cmocka_unit_test(test_fit_stiffness),    cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
