/* Steps of the forces inside bodies: within the stability limit of the assembled body, by its largest eigenvalue, and with damping; nested and own clocks. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_eigen.h>

#include "support/element_crowd.h"

/* M^(-1/2) H M^(-1/2) of all elements whose ticks are of one kind, at rest. */
static double largest_eigenvalue(const cipc_asynchronous *a, cipc_event_kind kind)
{
    const cipc_model *m = a->model;
    const size_t n = 3 * (size_t)m->node_count;
    gsl_matrix *K = gsl_matrix_calloc(n, n);
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) {
        const asynchronous_set *set = &a->sets[s];
        for (int e = 0; set->kind == kind && e < set->count; e++) {
            const int count = 3 * set->energy->nodes, *nodes = nodes_of(set, e);
            double x[12], H[144];
            gather_from(m->rest, set, e, x);
            set->energy->hessian(x, params_of(set, e), H);
            for (int i = 0; i < count * count; i++) {
                const int p = i / count, q = i % count, node_p = nodes[p / 3], node_q = nodes[q / 3];
                *gsl_matrix_ptr(K, (size_t)(3 * node_p + p % 3), (size_t)(3 * node_q + q % 3)) += H[i] / sqrt(m->mass[node_p] * m->mass[node_q]);
            }
        }
    }
    gsl_vector *values = gsl_vector_alloc(n);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(n);
    gsl_eigen_symm(K, values, work);
    const double largest = gsl_vector_max(values);
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
    gsl_matrix_free(K);
    return largest;
}

/* Clocks of a kind tick at h = gamma 2/omega with an omega that the whole body does not exceed: so that it is stable however the ticks fall; and is not far above. */
static void test_steps_are_stable(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 4; seed++) {
        asynchronous_scene s;
        int kinds = 0;
        element_crowd(&s, seed, CIPC_CLOCKS_OWN, 0);
        const cipc_asynchronous *a = s.integrator;
        for (int kind = CIPC_EVENT_STRETCHING; kind <= CIPC_EVENT_VOLUME; kind++) {
            double shortest = INFINITY;
            for (int c = 0; c < a->clock_count; c++)
                if (a->sets[a->clocks[c].set].kind == (cipc_event_kind)kind) shortest = fmin(shortest, a->clocks[c].h);
            const double limit = 2 * ELEMENT_FACTOR / shortest, omega2 = largest_eigenvalue(a, (cipc_event_kind)kind);
            assert_true(omega2 <= limit * limit * (1 + 1e-9));
            assert_true(omega2 >= 0.2 * limit * limit);
            kinds++;
        }
        assert_int_equal(kinds, 3);
        asynchronous_scene_free(&s);
    }
}

/* With damping by the stiffness a tick maps (x, v) to (x + h v', v') with v' = v - h omega^2 x - h beta omega^2 v. Its eigenvalues are within the unit circle
 * while h^2 omega^2 + 2 h beta omega^2 < 4: the limit that steps keep a fraction of. */
static double damped_limit(double omega, double beta) { return (sqrt(beta * beta * omega * omega + 4) - beta * omega) / omega; }

static void test_steps_under_damping(void **state)
{
    (void)state;
    const double beta = 2e-3;
    asynchronous_scene s, damped;
    int overdamped = 0, faint = 0;
    element_crowd(&s, 1, CIPC_CLOCKS_OWN, 0);
    element_crowd(&damped, 1, CIPC_CLOCKS_OWN, beta);
    for (int k = 0; k < ASYNCHRONOUS_SETS; k++)
        for (int e = 0; e < s.integrator->sets[k].count; e++) {
            const double h = s.integrator->sets[k].step[e], omega = 2 * ELEMENT_FACTOR / h, got = damped.integrator->sets[k].step[e];
            assert_true(fabs(got - ELEMENT_FACTOR * damped_limit(omega, beta)) <= 1e-12 * h);
            beta * omega > 1 ? overdamped++ : faint++;
        }
    assert_true(overdamped > 20 && faint > 20);
    asynchronous_scene_free(&s);
    asynchronous_scene_free(&damped);
}

/* A segment that swings along itself, at almost the longest steps, from no damping to far too much: it comes to rest, or swings on as it did. */
static void test_damped_steps_are_stable(void **state)
{
    (void)state;
    static const double rest[6] = {0, 0, 0, 1, 0, 0}, start_at[6] = {-0.05, 0, 0, 1.05, 0, 0};
    static const int segment[1][2] = {{0, 1}};
    for (double damping = 1e-3; damping < 100; damping *= 1.7) { /* beta omega */
        asynchronous_scene s;
        cipc_body_description body = {.name = "spring", .kind = CIPC_BODY_RODS, .node_count = 2, .rest = rest, .position = start_at, .segment_count = 1, .segments = segment};
        body.material = (cipc_material){.density = 1000, .thickness = 0.01, .young = 1e5};
        body.material.damping_stiffness = damping / sqrt(4 * 1e5 / 1000); /* omega^2 = 2 k/m with k = E A/l and m = rho A l/2 */
        asynchronous_scene_init(&s);
        sheet_add(&s.sheet, &body);
        s.options.element_factor = 0.98;
        s.options.clocks = CIPC_CLOCKS_OWN;
        s.options.frame = 1;
        asynchronous_scene_build(&s);
        asynchronous_steps(&s, 200);
        assert_true(fabs(s.sheet.state->position[3] - s.sheet.state->position[0] - 1) < 0.11);
        assert_true(s.events[CIPC_EVENT_STRETCHING] > 1000);
        asynchronous_scene_free(&s);
    }
}

/* Nested: the longest of frame, frame/2, frame/4 ... that is not longer than the own one. */
static void test_nested_steps(void **state)
{
    (void)state;
    asynchronous_scene own, nested;
    int finest = 0;
    element_crowd(&own, 2, CIPC_CLOCKS_OWN, 0);
    element_crowd(&nested, 2, CIPC_CLOCKS_NESTED, 0);
    for (int k = 0; k < ASYNCHRONOUS_SETS; k++)
        for (int e = 0; e < own.integrator->sets[k].count; e++) {
            const double h = own.integrator->sets[k].step[e], got = nested.integrator->sets[k].step[e];
            int exponent;
            assert_true(frexp(got / nested.options.frame, &exponent) == 0.5); /* a power of two */
            assert_true(got <= h && (2 * got > h || got == nested.options.frame));
            finest = exponent < finest ? exponent : finest;
        }
    assert_true(finest <= -2);
    asynchronous_scene_free(&own);
    asynchronous_scene_free(&nested);
}

/* Every element is in one clock, of its own step; like steps of a set are one clock, slowest first. */
static void test_clocks_hold_all_elements(void **state)
{
    (void)state;
    for (int clocks = 0; clocks < 2; clocks++) {
        asynchronous_scene s;
        element_crowd(&s, 3, clocks ? CIPC_CLOCKS_OWN : CIPC_CLOCKS_NESTED, 0);
        const cipc_asynchronous *a = s.integrator;
        int *times[ASYNCHRONOUS_SETS], total = 0;
        for (int k = 0; k < ASYNCHRONOUS_SETS; k++) times[k] = cipc_alloc((size_t)a->sets[k].count, sizeof(int));
        for (int c = 0; c < a->clock_count; c++) {
            const asynchronous_clock *clock = &a->clocks[c];
            const asynchronous_event *event = &a->queue.events[clock->event];
            if (c > 0 && clock[-1].set == clock->set) assert_true(clock[-1].h > clock->h);
            assert_int_equal(event->rank, ASYNCHRONOUS_RANK_ELEMENTS + clock->set);
            assert_int_equal(event->owner, c);
            for (int i = 0; i < clock->count; i++, total++) {
                const int element = a->elements[clock->first + i];
                times[clock->set][element]++;
                assert_true(a->sets[clock->set].step[element] == clock->h);
            }
        }
        for (int k = 0; k < ASYNCHRONOUS_SETS; k++) {
            for (int e = 0; e < a->sets[k].count; e++) assert_int_equal(times[k][e], 1);
            total -= a->sets[k].count;
            cipc_free(times[k]);
        }
        assert_int_equal(total, 0);
        assert_true(clocks ? a->clock_count > 100 : a->clock_count < 40);
        asynchronous_scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_are_stable),
        cmocka_unit_test(test_steps_under_damping),
        cmocka_unit_test(test_damped_steps_are_stable),
        cmocka_unit_test(test_nested_steps),
        cmocka_unit_test(test_clocks_hold_all_elements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
