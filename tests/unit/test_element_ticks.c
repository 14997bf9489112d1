/* Ticks of the forces inside bodies: impulses that keep momenta; damping that dissipates, keeps momenta and is proportional to stiffness; prescribed nodes, forces that are not finite. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/element_crowd.h"

typedef struct momenta { double linear[3], angular[3], size; } momenta;

/* Of what a tick adds to the velocities. */
static momenta change_of(const cipc_asynchronous *a, const double *x, const double *before)
{
    momenta p = {.size = 0};
    for (int i = 0; i < a->model->node_count; i++) {
        double dv[3], turn[3];
        v3_sub(dv, a->nodes[i].v, before + 3 * i);
        v3_cross(turn, x + 3 * i, dv);
        v3_axpy(p.linear, a->model->mass[i], dv);
        v3_axpy(p.angular, a->model->mass[i], turn);
        p.size += a->model->mass[i] * v3_norm(dv);
    }
    return p;
}

/* Everybody at x with velocity v now, and free. */
static void place(cipc_asynchronous *a, const double *x, const double *v)
{
    for (int i = 0; i < a->model->node_count; i++) {
        v3_copy(a->nodes[i].q, x + 3 * i);
        v3_copy(a->nodes[i].v, v + 3 * i);
        a->nodes[i].t = a->now;
        a->nodes[i].inverse_mass = 1 / a->model->mass[i];
    }
}

static void tick_set(cipc_asynchronous *a, int set)
{
    for (int c = 0; c < a->clock_count; c++)
        if (a->clocks[c].set == set) asynchronous_elements_tick(a, c);
}

enum { MOST = 300 };

static void deform(uint64_t *seed, const cipc_model *m, double by, double speed, double *x, double *v)
{
    assert_true(3 * m->node_count <= MOST);
    for (int i = 0; i < 3 * m->node_count; i++) {
        x[i] = m->rest[i] + random_uniform(seed, -by, by);
        v[i] = random_uniform(seed, -speed, speed);
    }
}

/* -h grad V/m, element by element, for every set; linear and angular momentum to rounding, damped or not. */
static void test_ticks(void **state)
{
    (void)state;
    uint64_t seed = 1;
    double x[MOST], v[MOST], want[MOST];
    for (int damped = 0; damped < 2; damped++)
        for (uint64_t variant = 0; variant < 2; variant++) {
            asynchronous_scene s;
            element_crowd(&s, variant, CIPC_CLOCKS_OWN, damped * 1e-3);
            cipc_asynchronous *a = s.integrator;
            asynchronous_elements_start(a);
            for (int k = 0; k < ASYNCHRONOUS_SETS; k++) {
                const asynchronous_set *set = &a->sets[k];
                deform(&seed, a->model, 3e-3, 1, x, v);
                place(a, x, v);
                tick_set(a, k);
                const momenta change = change_of(a, x, v);
                assert_true(v3_norm(change.linear) <= 1e-13 * change.size && v3_norm(change.angular) <= 1e-13 * change.size);
                assert_int_equal(set->count == 0, change.size == 0);
                if (damped) continue;
                memcpy(want, v, sizeof want);
                for (int e = 0; e < set->count; e++) {
                    double y[12], g[12];
                    gather_from(x, set, e, y);
                    set->energy->gradient(y, params_of(set, e), g);
                    for (int i = 0; i < set->energy->nodes; i++) v3_axpy(want + 3 * nodes_of(set, e)[i], -set->step[e] / a->model->mass[nodes_of(set, e)[i]], g + 3 * i);
                }
                for (int i = 0; i < 3 * a->model->node_count; i++) assert_true(fabs(a->nodes[i / 3].v[i % 3] - want[i]) <= 1e-12 * (1 + fabs(want[i])));
            }
            asynchronous_scene_free(&s);
        }
}

/* Each tick schedules the next one, k h, and counts its elements. */
static void test_clocks_go_on(void **state)
{
    (void)state;
    asynchronous_scene s;
    element_crowd(&s, 5, CIPC_CLOCKS_NESTED, 0);
    cipc_asynchronous *a = s.integrator;
    a->now = 2.5 * a->options.frame;
    place(a, s.sheet.model->rest, s.sheet.model->rest);
    asynchronous_elements_start(a);
    for (int c = 0; c < a->clock_count; c++) {
        const asynchronous_clock *clock = &a->clocks[c];
        const cipc_event_kind kind = a->sets[clock->set].kind;
        const int64_t k = clock->k;
        const long events = a->report.events[kind];
        assert_true((double)k * clock->h > a->now && (double)(k - 1) * clock->h <= a->now);
        assert_true(asynchronous_queue_time(&a->queue, clock->event) == (double)k * clock->h);
        asynchronous_elements_tick(a, c);
        assert_int_equal(a->report.events[kind] - events, clock->count);
        assert_true(asynchronous_queue_time(&a->queue, clock->event) == (double)(k + 1) * clock->h);
    }
    asynchronous_scene_free(&s);
}

/* Fixed bodies have no elements, prescribed nodes get nothing. */
static void test_prescribed_nodes(void **state)
{
    (void)state;
    uint64_t seed = 2;
    double x[MOST], v[MOST];
    asynchronous_scene s;
    element_crowd(&s, 6, CIPC_CLOCKS_NESTED, 1e-3);
    cipc_asynchronous *a = s.integrator;
    deform(&seed, a->model, 3e-3, 1, x, v);
    place(a, x, v);
    for (int i = 0; i < a->model->node_count; i += 2) a->nodes[i].inverse_mass = 0;
    for (int k = 0; k < ASYNCHRONOUS_SETS; k++) tick_set(a, k);
    for (int i = 0; i < a->model->node_count; i++) {
        const bool moves = i % 2 == 1 && a->model->node_body[i] != 0 && a->model->bodies[a->model->node_body[i]].kind != CIPC_BODY_PARTICLES;
        assert_int_equal(memcmp(a->nodes[i].v, v + 3 * i, 3 * sizeof *v) != 0, moves);
    }
    asynchronous_scene_free(&s);
}

/* ---- Damping ---- */

/* What the damping of an element adds to its nodes' momenta in one tick does not add to the energy of the relative motion: sum v . impulse <= 0. */
static void test_damping_dissipates(void **state)
{
    (void)state;
    uint64_t seed = 3;
    double x[MOST], v[MOST];
    for (uint64_t variant = 0; variant < 2; variant++) {
        asynchronous_scene with, without;
        element_crowd(&with, variant, CIPC_CLOCKS_OWN, 1e-4);
        element_crowd(&without, variant, CIPC_CLOCKS_OWN, 0);
        for (int k = 0; k < ASYNCHRONOUS_SETS; k++) {
            double power = 0;
            if (k == ASYNCHRONOUS_STITCHES) continue; /* sewn, not damped */
            deform(&seed, with.sheet.model, 3e-3, 1, x, v);
            /* the same steps, so that the undamped part of the ticks is the same */
            memcpy(without.integrator->sets[k].step, with.integrator->sets[k].step, (size_t)with.integrator->sets[k].count * sizeof(double));
            for (int c = 0; c < with.integrator->clock_count; c++) {
                if (with.integrator->clocks[c].set != k || with.integrator->clocks[c].count != 1) continue;
                place(with.integrator, x, v);
                place(without.integrator, x, v);
                asynchronous_elements_tick(with.integrator, c);
                without.integrator->clocks[c] = with.integrator->clocks[c];
                without.integrator->elements[with.integrator->clocks[c].first] = with.integrator->elements[with.integrator->clocks[c].first];
                asynchronous_elements_tick(without.integrator, c);
                double one = 0;
                for (int i = 0; i < with.sheet.model->node_count; i++)
                    for (int d = 0; d < 3; d++) one += with.sheet.model->mass[i] * v[3 * i + d] * (with.integrator->nodes[i].v[d] - without.integrator->nodes[i].v[d]);
                assert_true(one <= 1e-15);
                power += one;
            }
            assert_int_equal(power < 0, with.integrator->sets[k].count > 0);
        }
        asynchronous_scene_free(&with);
        asynchronous_scene_free(&without);
    }
}

/* At rest the damping force of springs, hinges and rods is beta times the Hessian times the velocity. */
static void test_damping_is_proportional_to_stiffness(void **state)
{
    (void)state;
    static const int sets[] = {ASYNCHRONOUS_SPRINGS, ASYNCHRONOUS_HINGES, ASYNCHRONOUS_RODS};
    const double beta = 1e-4;
    uint64_t seed = 4;
    double x[MOST], v[MOST];
    asynchronous_scene s;
    element_crowd(&s, 7, CIPC_CLOCKS_OWN, beta);
    cipc_asynchronous *a = s.integrator;
    for (int i = 0; i < 3; i++) {
        const asynchronous_set *set = &a->sets[sets[i]];
        deform(&seed, a->model, 0, 1, x, v);
        for (int c = 0; c < a->clock_count; c++) {
            if (a->clocks[c].set != sets[i]) continue;
            assert_int_equal(a->clocks[c].count, 1);
            const int e = a->elements[a->clocks[c].first], count = 3 * set->energy->nodes, *nodes = nodes_of(set, e);
            double y[12], H[144], size = 0;
            gather_from(x, set, e, y);
            set->energy->hessian(y, params_of(set, e), H);
            place(a, x, v);
            asynchronous_elements_tick(a, c);
            for (int k = 0; k < count * count; k++) size = fmax(size, fabs(H[k]));
            for (int k = 0; k < count; k++) {
                double force = 0;
                for (int j = 0; j < count; j++) force -= beta * H[count * k + j] * v[3 * nodes[j / 3] + j % 3];
                const double got = (a->nodes[nodes[k / 3]].v[k % 3] - v[3 * nodes[k / 3] + k % 3]) * a->model->mass[nodes[k / 3]] / set->step[e];
                assert_true(fabs(got - force) <= 1e-6 * beta * size);
            }
        }
    }
    asynchronous_scene_free(&s);
}

/* ---- Failures ---- */

static void test_no_finite_force(void **state)
{
    (void)state;
    asynchronous_scene s;
    element_crowd(&s, 8, CIPC_CLOCKS_NESTED, 0);
    cipc_asynchronous *a = s.integrator;
    const int first = s.sheet.model->bodies[5].first_node;
    place(a, s.sheet.model->rest, s.sheet.model->rest);
    for (int i = first; i < first + 8; i++) a->nodes[i].q[0] *= -0.5; /* a block inside out */
    tick_set(a, ASYNCHRONOUS_VOLUME_NEO_HOOKEAN);
    assert_int_equal(a->status, CIPC_E_NO_PROGRESS);
    assert_non_null(strstr(a->error.what, "volume_neo_hookean"));
    assert_non_null(strstr(a->error.what, "\"body 5\""));
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ticks),
        cmocka_unit_test(test_clocks_go_on),
        cmocka_unit_test(test_prescribed_nodes),
        cmocka_unit_test(test_damping_dissipates),
        cmocka_unit_test(test_damping_is_proportional_to_stiffness),
        cmocka_unit_test(test_no_finite_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
