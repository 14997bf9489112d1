/* Lagged friction data of contacts of all four kinds: tangents, weights and normal force; where there is none; and what it is
 * indifferent to. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/contact.h"
#include "support/exact_geometry.h"

static const int node_count[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4};

/* A cross product, a division by a length and a dot product of vectors of unit length; the closest vector is at least a tenth of the
 * stencil's size, so that its own direction is good to ten times as much as its parts. */
static const double DIRECTION_ROUNDING = 1000 * UNIT_ROUNDOFF;

#define MU  0.3
#define EPS 1e-4

/* A contact on nodes 5, 6, ... of a model, whose stencil is x[15 ..]. */
typedef struct example {
    cipc_contact contact;
    double x[27], start[27];
} example;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A random stencil of a kind, with the foot anywhere in the primitives, at a distance well inside the support. */
static example draw(uint64_t *seed, cipc_pair_kind kind)
{
    example e;
    int n = node_count[kind];
    double *y = e.x + 15, d;
    do {
        random_fill(seed, e.x, 27, 1);
        d = sqrt(cipc_distance2_value(kind, y));
    } while (d < 0.3 || d > 1 || (n == 4 && shape_of(kind, y).sine < 0.3));
    random_fill(seed, e.start, 27, 1);
    cipc_contact contact = {
        .energy = (cipc_energy_id)(CIPC_ENERGY_BARRIER_POINT_POINT + kind),
        .count = n,
        .nodes = {5, 6, n > 2 ? 7 : -1, n > 3 ? 8 : -1},
        .barrier = {.stiffness = random_uniform(seed, 1, 9),
                    .weight = random_uniform(seed, 0.5, 3),
                    .offset = random_uniform(seed, 0, 0.9) * d,
                    .dhat = 1.2,
                    .feature = {kind, n, {0, 1, 2, 3}}},
        .multiplicity = 1,
    };
    e.contact = contact;
    return e;
}

static cipc_friction friction_of(const example *e)
{
    cipc_friction f;
    assert_true(cipc_friction_from_contact(&f, &e->contact, e->x, e->start, MU, EPS));
    return f;
}

/* The two tangents are of unit length and perpendicular to one another and to the vector between the closest points. */
static void test_basis(void **state)
{
    (void)state;
    uint64_t seed = 501;
    for (int i = 0; i < 4000; i++) {
        cipc_pair_kind kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT);
        example e = draw(&seed, kind);
        cipc_friction f = friction_of(&e);
        const double *p = f.basis, *q = f.basis + 3;
        double closest[3] = {0, 0, 0}, sum = 0;
        for (int k = 0; k < 12; k++) closest[k % 3] += k / 3 < node_count[kind] ? f.weights[k / 3] * e.x[15 + k] : 0;
        for (int k = 0; k < 4; k++) sum += f.weights[k];
        double length = sqrt(dot(closest, closest));
        assert_true(fabs(sum) <= DIRECTION_ROUNDING);
        assert_true(fabs(length - sqrt(cipc_distance2_value(kind, e.x + 15))) <= DIRECTION_ROUNDING);
        assert_true(fabs(dot(p, p) - 1) <= DIRECTION_ROUNDING && fabs(dot(q, q) - 1) <= DIRECTION_ROUNDING);
        assert_true(fabs(dot(p, q)) <= DIRECTION_ROUNDING);
        assert_true(fabs(dot(p, closest)) <= DIRECTION_ROUNDING * length && fabs(dot(q, closest)) <= DIRECTION_ROUNDING * length);
    }
}

/* The weights of nodes beyond the stencil are zero, as energy.h demands. */
static void test_unused_nodes_have_no_weight(void **state)
{
    (void)state;
    uint64_t seed = 502;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        example e = draw(&seed, (cipc_pair_kind)kind);
        cipc_friction f = friction_of(&e);
        for (int i = node_count[kind]; i < 4; i++) assert_true(f.weights[i] == 0);
        for (int i = 0; i < 3 * node_count[kind]; i++) assert_true(f.start[i] == e.start[15 + i]);
        assert_true(f.eps == EPS);
    }
}

/* kappa w b as a function of d, in the C.4 form. */
static double barrier_energy(const cipc_contact_barrier *c, double d)
{
    double b[3];
    cipc_barrier(d * d - c->offset * c->offset, c->dhat * (2 * c->offset + c->dhat), b);
    return c->stiffness * c->weight * b[0];
}

/* The coefficient is mu times lambda = -kappa dB/dd: against a six-point central difference, whose error is (h/gap)^6 in relative size (gap
 * at least a tenth of d here) plus the rounding of B over h. */
static void test_normal_force(void **state)
{
    (void)state;
    static const double RELATIVE_STEP = 1e-3, TOLERANCE = 1e-8;
    uint64_t seed = 503;
    for (int i = 0; i < 400; i++) {
        cipc_pair_kind kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT);
        example e = draw(&seed, kind);
        double d = sqrt(cipc_distance2_value(kind, e.x + 15)), h = RELATIVE_STEP * (d - e.contact.barrier.offset), slope = 0;
        static const double weights[3] = {45, -9, 1};
        for (int k = 0; k < 3; k++)
            slope += weights[k] *
                     (barrier_energy(&e.contact.barrier, d + (k + 1) * h) - barrier_energy(&e.contact.barrier, d - (k + 1) * h)) / (60 * h);
        double lambda = friction_of(&e).coefficient / MU;
        assert_true(lambda > 0 && fabs(lambda + slope) <= TOLERANCE * lambda);
    }
}

/* The force that the barrier exerts on the first node's primitive has the size lambda too: its gradient along the contact direction. */
static void test_normal_force_is_the_barriers(void **state)
{
    (void)state;
    uint64_t seed = 504;
    for (int i = 0; i < 400; i++) {
        cipc_pair_kind kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT);
        example e = draw(&seed, kind);
        double g[12] = {0}, force[3] = {0, 0, 0};
        cipc_energy_entry(e.contact.energy)->gradient(e.x + 15, &e.contact.barrier, g);
        for (int k = 0; k < (kind == CIPC_EDGE_EDGE ? 6 : 3); k++) force[k % 3] += g[k];
        double lambda = friction_of(&e).coefficient / MU;
        assert_true(fabs(sqrt(dot(force, force)) - lambda) <= DIRECTION_ROUNDING * lambda);
    }
}

static void test_no_friction(void **state)
{
    (void)state;
    uint64_t seed = 505;
    cipc_friction f;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        example e = draw(&seed, (cipc_pair_kind)kind);
        assert_false(cipc_friction_from_contact(&f, &e.contact, e.x, e.start, 0, EPS));
        e.contact.barrier.dhat = 1e-3; /* out of the barrier's reach: no normal force */
        assert_false(cipc_friction_from_contact(&f, &e.contact, e.x, e.start, MU, EPS));
        e = draw(&seed, (cipc_pair_kind)kind);
        e.contact.barrier.offset = 2; /* in contact: the barrier has no slope there */
        assert_false(cipc_friction_from_contact(&f, &e.contact, e.x, e.start, MU, EPS));
    }
    example e = draw(&seed, CIPC_EDGE_EDGE);
    (void)friction_of(&e);
    e.contact.barrier.mollifier_eps = 1e-3;
    assert_false(cipc_friction_from_contact(&f, &e.contact, e.x, e.start, MU, EPS));
}

/* Places in the world: coordinates in steps of 2^-30 stay exact when 2^20 is added, and nothing changes but the start. */
static void test_translation(void **state)
{
    (void)state;
    uint64_t seed = 506;
    for (int i = 0; i < 400; i++) {
        example e = draw(&seed, (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT));
        for (int k = 0; k < 27; k++) e.x[k] = ldexp(rint(ldexp(e.x[k], 30)), -30), e.start[k] = ldexp(rint(ldexp(e.start[k], 30)), -30);
        example far = e;
        for (int k = 0; k < 27; k++) far.x[k] += 0x1p20 * (k % 3 - 1), far.start[k] += 0x1p20 * (k % 3 - 1);
        cipc_friction a = friction_of(&e), b = friction_of(&far);
        assert_true(a.coefficient == b.coefficient);
        assert_memory_equal(a.basis, b.basis, sizeof a.basis);
        assert_memory_equal(a.weights, b.weights, sizeof a.weights);
        /* sliding, and with it the energy, sees the difference of x and start only */
        double x[12] = {0}, y[12] = {0};
        memcpy(x, e.x + 15, 12 * sizeof *x);
        memcpy(y, far.x + 15, 12 * sizeof *y);
        assert_true(cipc_friction_value(x, &a) == cipc_friction_value(y, &b));
    }
}

/* Sliding measured from the start positions: none for x = start, and d along the first tangent for a first primitive that moved by it. */
static void test_sliding_from_start(void **state)
{
    (void)state;
    static const double WAY = 0.25;
    uint64_t seed = 507;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        example e = draw(&seed, (cipc_pair_kind)kind);
        memcpy(e.start, e.x, sizeof e.x);
        cipc_friction f = friction_of(&e);
        double x[12] = {0};
        memcpy(x, e.x + 15, 3 * (size_t)node_count[kind] * sizeof *x);
        assert_true(cipc_friction_value(x, &f) == f.coefficient * (EPS / 3));
        for (int k = 0; k < (kind == CIPC_EDGE_EDGE ? 6 : 3); k++) x[k] += WAY * f.basis[k % 3];
        assert_true(fabs(cipc_friction_value(x, &f) - f.coefficient * WAY) <= DIRECTION_ROUNDING * f.coefficient);
    }
}

/* The tangents of a point-point contact exist for every direction, the coordinate axes included. */
static void test_point_point_along_axes(void **state)
{
    (void)state;
    for (int axis = 0; axis < 6; axis++) {
        example e = {.contact = {.energy = CIPC_ENERGY_BARRIER_POINT_POINT,
                                 .count = 2,
                                 .nodes = {5, 6, -1, -1},
                                 .barrier = {.stiffness = 1, .weight = 1, .dhat = 2, .feature = {CIPC_POINT_POINT, 2, {0, 1}}},
                                 .multiplicity = 1}};
        e.x[15 + axis % 3] = axis < 3 ? 1 : -1;
        cipc_friction f = friction_of(&e);
        for (int t = 0; t < 2; t++) {
            assert_true(f.basis[3 * t + axis % 3] == 0);
            assert_true(dot(f.basis + 3 * t, f.basis + 3 * t) == 1);
        }
        assert_true(dot(f.basis, f.basis + 3) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_basis),
        cmocka_unit_test(test_unused_nodes_have_no_weight),
        cmocka_unit_test(test_normal_force),
        cmocka_unit_test(test_normal_force_is_the_barriers),
        cmocka_unit_test(test_no_friction),
        cmocka_unit_test(test_translation),
        cmocka_unit_test(test_sliding_from_start),
        cmocka_unit_test(test_point_point_along_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
