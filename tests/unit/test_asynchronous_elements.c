/* Forces inside bodies: steps within the stability limit of the assembled body, by its largest eigenvalue; nested and own clocks; springs that make a membrane of the modulus asked for
 * (SPEC A.8); ticks that keep momenta; damping that dissipates, keeps momenta and is proportional to stiffness. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_eigen.h>
#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"

static const double FACTOR = 0.3;

/* A crowd with rest shapes out of the regular, so that every element has its own step. */
static void start(asynchronous_scene *s, uint64_t seed, cipc_clocks clocks, double damping)
{
    crowd_shape shape = crowd_shape_default();
    shape.cells = 3;
    shape.damping = damping;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    s->options.element_factor = FACTOR;
    s->options.frame = 1; /* longer than the step of any element */
    s->options.clocks = clocks;
    for (int b = 1; b < s->sheet.body_count; b++) {
        double *rest = (double *)(uintptr_t)s->sheet.bodies[b].rest;
        for (int i = 0; i < 3 * s->sheet.bodies[b].node_count; i++) rest[i] += random_uniform(&seed, -2e-3, 2e-3);
    }
    if (seed % 2) s->sheet.bodies[6].material.membrane = CIPC_MEMBRANE_STVK;
    if (seed % 2) s->sheet.bodies[5].material.volume = CIPC_VOLUME_COROTATIONAL;
    crowd_build(s, &shape);
}

static const int *nodes_of(const asynchronous_set *set, int element) { return set->nodes + element * set->energy->nodes; }
static const void *params_of(const asynchronous_set *set, int element) { return (const char *)set->params + (size_t)element * set->energy->params_size; }

static void gather(const double *from, const asynchronous_set *set, int element, double *x)
{
    for (int i = 0; i < set->energy->nodes; i++) v3_copy(x + 3 * i, from + 3 * nodes_of(set, element)[i]);
}

/* ---- Steps ---- */

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
            gather(m->rest, set, e, x);
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
        start(&s, seed, CIPC_CLOCKS_OWN, 0);
        const cipc_asynchronous *a = s.integrator;
        for (int kind = CIPC_EVENT_STRETCHING; kind <= CIPC_EVENT_VOLUME; kind++) {
            double shortest = INFINITY;
            for (int c = 0; c < a->clock_count; c++)
                if (a->sets[a->clocks[c].set].kind == (cipc_event_kind)kind) shortest = fmin(shortest, a->clocks[c].h);
            const double limit = 2 * FACTOR / shortest, omega2 = largest_eigenvalue(a, (cipc_event_kind)kind);
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
    start(&s, 1, CIPC_CLOCKS_OWN, 0);
    start(&damped, 1, CIPC_CLOCKS_OWN, beta);
    for (int k = 0; k < ASYNCHRONOUS_SETS; k++)
        for (int e = 0; e < s.integrator->sets[k].count; e++) {
            const double h = s.integrator->sets[k].step[e], omega = 2 * FACTOR / h, got = damped.integrator->sets[k].step[e];
            assert_true(fabs(got - FACTOR * damped_limit(omega, beta)) <= 1e-12 * h);
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
    start(&own, 2, CIPC_CLOCKS_OWN, 0);
    start(&nested, 2, CIPC_CLOCKS_NESTED, 0);
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
        start(&s, 3, clocks ? CIPC_CLOCKS_OWN : CIPC_CLOCKS_NESTED, 0);
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

/* ---- Which elements there are ---- */

static void test_sets(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 4, CIPC_CLOCKS_NESTED, 0);
    const asynchronous_set *sets = s.integrator->sets;
    assert_int_equal(sets[ASYNCHRONOUS_NEO_HOOKEAN].count, 18);
    assert_int_equal(sets[ASYNCHRONOUS_STVK].count, 0);
    assert_int_equal(sets[ASYNCHRONOUS_SPRINGS].count, 33); /* every edge of the sheet of springs */
    assert_int_equal(sets[ASYNCHRONOUS_HINGES].count, 2 * 21); /* those of the two sheets, not the floor's */
    assert_int_equal(sets[ASYNCHRONOUS_RODS].count, 3);
    assert_int_equal(sets[ASYNCHRONOUS_JOINTS].count, 2);
    assert_int_equal(sets[ASYNCHRONOUS_STITCHES].count, 1);
    assert_int_equal(sets[ASYNCHRONOUS_COROTATIONAL].count, 0);
    assert_int_equal(sets[ASYNCHRONOUS_VOLUME_NEO_HOOKEAN].count, 5);
    asynchronous_scene_free(&s);
}

/* ---- Springs ---- */

/* A patch of equilateral triangles, stretched and sheared evenly by a little: energy per area as of plane stress with E t and nu = 1/3, in every direction. */
static void test_springs_make_a_membrane(void **state)
{
    (void)state;
    enum { N = 5 };
    const double young = 3e5, thickness = 2e-3, poisson = 1.0 / 3, small = 1e-5, L = 0.1;
    double rest[3 * (N + 1) * (N + 1)];
    int triangle[2 * N * N][3], count = 0;
    for (int i = 0; i < (N + 1) * (N + 1); i++) {
        const int row = i / (N + 1), column = i % (N + 1);
        const double p[3] = {L * (column + 0.5 * row), 0, L * sqrt(0.75) * row};
        v3_copy(rest + 3 * i, p);
    }
    for (int i = 0; i < N * N; i++) {
        const int at = i / N * (N + 1) + i % N;
        const int two[2][3] = {{at, at + 1, at + N + 1}, {at + 1, at + N + 2, at + N + 1}};
        memcpy(triangle[count], two, sizeof two);
        count += 2;
    }
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    cipc_material *m = &sheet_add_body(&s.sheet, "patch", (N + 1) * (N + 1), rest, count, (const int(*)[3])triangle)->material;
    m->membrane = CIPC_MEMBRANE_SPRINGS;
    m->membrane_young = young;
    m->membrane_poisson = 0.1; /* not heard: springs have 1/3 */
    m->thickness = thickness;
    m->bending_young = 0;
    asynchronous_scene_build(&s);
    static const double strains[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {0.3, -0.7, 0.9}}; /* e11, e22, e12 */
    for (size_t i = 0; i < sizeof strains / sizeof *strains; i++) {
        const double e11 = strains[i][0] * small, e22 = strains[i][1] * small, e12 = strains[i][2] * small, area = count * sqrt(3) / 4 * L * L;
        double x[3 * (N + 1) * (N + 1)];
        for (int n = 0; n < (N + 1) * (N + 1); n++) {
            const double *p = rest + 3 * n, q[3] = {(1 + e11) * p[0] + e12 * p[2], 0, e12 * p[0] + (1 + e22) * p[2]};
            v3_copy(x + 3 * n, q);
        }
        const double density = young * thickness / (2 * (1 - poisson * poisson)) * (e11 * e11 + e22 * e22 + 2 * poisson * e11 * e22 + 2 * (1 - poisson) * e12 * e12);
        assert_true(fabs(asynchronous_elements_energy(s.integrator, x) / (area * density) - 1) < 10 * small);
    }
    asynchronous_scene_free(&s);
}

/* ---- Ticks ---- */

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
            start(&s, variant, CIPC_CLOCKS_OWN, damped * 1e-3);
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
                    gather(x, set, e, y);
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
    start(&s, 5, CIPC_CLOCKS_NESTED, 0);
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
    start(&s, 6, CIPC_CLOCKS_NESTED, 1e-3);
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
        start(&with, variant, CIPC_CLOCKS_OWN, 1e-4);
        start(&without, variant, CIPC_CLOCKS_OWN, 0);
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
    start(&s, 7, CIPC_CLOCKS_OWN, beta);
    cipc_asynchronous *a = s.integrator;
    for (int i = 0; i < 3; i++) {
        const asynchronous_set *set = &a->sets[sets[i]];
        deform(&seed, a->model, 0, 1, x, v);
        for (int c = 0; c < a->clock_count; c++) {
            if (a->clocks[c].set != sets[i]) continue;
            assert_int_equal(a->clocks[c].count, 1);
            const int e = a->elements[a->clocks[c].first], count = 3 * set->energy->nodes, *nodes = nodes_of(set, e);
            double y[12], H[144], size = 0;
            gather(x, set, e, y);
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
    start(&s, 8, CIPC_CLOCKS_NESTED, 0);
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
        cmocka_unit_test(test_steps_are_stable),
        cmocka_unit_test(test_steps_under_damping),
        cmocka_unit_test(test_damped_steps_are_stable),
        cmocka_unit_test(test_nested_steps),
        cmocka_unit_test(test_clocks_hold_all_elements),
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_springs_make_a_membrane),
        cmocka_unit_test(test_ticks),
        cmocka_unit_test(test_clocks_go_on),
        cmocka_unit_test(test_prescribed_nodes),
        cmocka_unit_test(test_damping_dissipates),
        cmocka_unit_test(test_damping_is_proportional_to_stiffness),
        cmocka_unit_test(test_no_finite_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
