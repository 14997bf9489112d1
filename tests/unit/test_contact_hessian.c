/* The closed form of projected contact Hessians: equal to the plain projection of the exact Hessian, for every kind, near and far, thin and
 * thick. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/contact_hessian.h"
#include "implicit/psd_projection.h"
#include "support/exact_geometry.h"

enum { N = 12 };

/* The two ways differ by rounding: the unit normal is known to some 8 u S/(d) (S the stencil's size: r is a difference of numbers of that
 * size), or 8 u / sine for the cross product; the distance relatively to as much, and the dual basis of the parameters to 8 u / sine^2.
 * Each enters the matrix twice (it is quadratic), in the exact Hessian as well as in the closed form; with the two eigenproblems this makes
 * a few dozen times u (1 + sine S/d) / sine^2. 256 is ten times what is seen. */
static const double rounding_factor = 256;

static double largest(int n, const double *A)
{
    double most = 0;
    for (int i = 0; i < n * n; i++) most = fmax(most, fabs(A[i]));
    return most;
}

/* Sine between the two directions that span the feature's plane; 1 where there is none. */
static double sine_of(cipc_pair_kind kind, const double *x)
{
    double a[3], b[3], c[3];
    if (kind < CIPC_POINT_TRIANGLE) return 1;
    bool plane = kind == CIPC_POINT_TRIANGLE;
    v3_sub(a, x + (plane ? 6 : 3), x + (plane ? 3 : 0));
    v3_sub(b, x + 9, x + (plane ? 3 : 6));
    v3_cross(c, a, b);
    return v3_norm(c) / (v3_norm(a) * v3_norm(b));
}

/* Largest allowed difference from the projection of H. */
static double tolerance(cipc_pair_kind kind, int n, const double *x, const double *H)
{
    double sine = sine_of(kind, x), d = sqrt(cipc_distance2_value(kind, x));
    return rounding_factor * UNIT_ROUNDOFF * (1 + sine * stencil_size(x, n) / d) / (sine * sine) * largest(n, H);
}

static bool agrees(int n, const double *A, const double *B, double limit)
{
    for (int i = 0; i < n * n; i++)
        if (!(fabs(A[i] - B[i]) <= limit)) return false;
    return true;
}

typedef enum verdict { REFUSED, RIGHT, WRONG, NOTHING_TO_DO } verdict;

static verdict try_closed_form(cipc_energy_id id, const double *x, const cipc_contact_barrier *barrier)
{
    const cipc_energy *energy = cipc_energy_entry(id);
    cipc_pair_kind kind = (cipc_pair_kind)(id - CIPC_ENERGY_BARRIER_POINT_POINT);
    int n = 3 * energy->nodes;
    double H[N * N], P[N * N];
    for (int i = 0; i < N * N; i++) P[i] = 77;
    if (!cipc_contact_hessian_projected(id, x, barrier, P)) {
        for (int i = 0; i < N * N; i++) assert_true(P[i] == 77); /* untouched */
        return REFUSED;
    }
    energy->hessian(x, barrier, H);
    double limit = tolerance(kind, n, x, H);
    if (largest(n, H) == 0) return agrees(n, P, H, 0) ? NOTHING_TO_DO : WRONG;
    assert_true(cipc_psd_project_plain(n, H));
    return agrees(n, P, H, limit) ? RIGHT : WRONG;
}

/* Every legal configuration of the energies' samplers: all regimes of gap and thickness, short edges, slivers. */
static void test_samplers(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int id = CIPC_ENERGY_BARRIER_POINT_POINT; id <= CIPC_ENERGY_BARRIER_EDGE_EDGE; id++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)id);
        int right = 0;
        for (int branch = 0; branch < energy->branch_count; branch++)
            for (int trial = 0; trial < 1000; trial++) {
                double x[N];
                cipc_contact_barrier barrier;
                energy->sample(rng, branch, x, &barrier);
                if (!isfinite(energy->value(x, &barrier))) continue;
                verdict v = try_closed_form((cipc_energy_id)id, x, &barrier);
                if (v == WRONG) fail_msg("%s, %s, trial %d", energy->name, energy->branch_names[branch], trial);
                bool plain = barrier.mollifier_eps == 0 && (id != CIPC_ENERGY_BARRIER_EDGE_EDGE || barrier.feature.kind == CIPC_EDGE_EDGE);
                assert_true(plain || v == REFUSED);
                right += v == RIGHT;
            }
        assert_true(right >= 4000); /* the five active branches or more, but for a few infeasible draws */
    }
    gsl_rng_free(rng);
}

/* A stencil with its closest points anywhere (also outside of the primitives: the formulas do not mind), at distance d, with a given sine.
 */
static void draw(uint64_t *seed, cipc_pair_kind kind, double d, double sine, double x[N])
{
    double cosine = sqrt(1 - sine * sine), s = random_uniform(seed, -0.5, 1.5), t = random_uniform(seed, -0.5, 1.5), local[N] = {0};
    double lengths[2] = {random_uniform(seed, 0.05, 2), random_uniform(seed, 0.05, 2)};
    double E0[3] = {lengths[0], 0, 0}, E1[3] = {lengths[1] * cosine, lengths[1] * sine, 0};
    if (kind == CIPC_POINT_POINT) {
        local[2] = d;
    } else if (kind == CIPC_POINT_EDGE) {
        local[0] = s * lengths[0];
        local[2] = d;
        v3_copy(local + 6, E0);
    } else if (kind == CIPC_POINT_TRIANGLE) {
        for (int k = 0; k < 3; k++) local[k] = s * E0[k] + t * E1[k];
        local[2] = s < 0.5 ? d : -d;
        v3_copy(local + 6, E0);
        v3_copy(local + 9, E1);
    } else {
        for (int k = 0; k < 3; k++) {
            local[k] = -s * E0[k];
            local[3 + k] = (1 - s) * E0[k];
            local[6 + k] = -t * E1[k];
            local[9 + k] = (1 - t) * E1[k];
        }
        local[8] = local[11] = t < 0.5 ? d : -d;
    }
    /* a random rotation (of an unnormalised quaternion) and place */
    double q[4], u[3] = {random_uniform(seed, -1, 1), random_uniform(seed, -1, 1), random_uniform(seed, -1, 1)}, size = 0;
    random_fill(seed, q, 4, 1);
    for (int i = 0; i < 4; i++) size += q[i] * q[i];
    for (int i = 0; i < 4; i++) {
        double c1[3], c2[3], *p = local + 3 * i;
        v3_cross(c1, q + 1, p);
        v3_cross(c2, q + 1, c1);
        for (int k = 0; k < 3; k++) x[3 * i + k] = u[k] + p[k] + 2 * (q[0] * c1[k] + c2[k]) / size;
    }
}

static void test_all_shapes(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++)
        for (int trial = 0; trial < 20000; trial++) {
            double x[N], sine = pow(10, -3 * random_uniform(&seed, 0, 1)), xi = trial % 2 ? 0.01 : 0, dhat = 0.01;
            draw(&seed, (cipc_pair_kind)kind, xi + dhat * pow(10, -5 * random_uniform(&seed, 0, 1)), sine, x);
            cipc_contact_barrier barrier = {
                .stiffness = 1e3, .weight = 2, .offset = xi, .dhat = dhat, .feature = {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}}};
            verdict v = try_closed_form((cipc_energy_id)(CIPC_ENERGY_BARRIER_POINT_POINT + kind), x, &barrier);
            if (v == WRONG) fail_msg("kind %d, trial %d, sine %g", kind, trial, sine);
        }
}

/* Where there is no closed form, or it would lose half of the digits, the answer is no. */
static void test_refuses(void **state)
{
    (void)state;
    cipc_contact_barrier barrier = {.stiffness = 1, .weight = 1, .dhat = 0.01, .feature = {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}}}, other;
    const double crossing[N] = {-1, 0, 0.005, 1, 0, 0.005, 0, -1, 0, 0, 1, 0},
                 parallel[N] = {-1, 0, 0.005, 1, 0, 0.005, -1, 0, 0, 1, 1e-5, 0}, touching[N] = {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0},
                 short_edge[9] = {0, 0, 0.005, 0, 0, 0, 0, 0, 0}, same[6] = {1, 2, 3, 1, 2, 3},
                 sliver[N] = {0.5, 0, 0.005, 0, 0, 0, 1, 0, 0, 2, 1e-5, 0};
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_EDGE_EDGE, crossing, &barrier), RIGHT);
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_EDGE_EDGE, parallel, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_EDGE_EDGE, touching, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_POINT_TRIANGLE, sliver, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_POINT_EDGE, short_edge, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_POINT_POINT, same, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_HINGE_BENDING, crossing, &barrier), REFUSED);
    assert_int_equal(try_closed_form(CIPC_ENERGY_FRICTION, crossing, &barrier), REFUSED);
    other = barrier;
    other.mollifier_eps = 1e-3;
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_EDGE_EDGE, crossing, &other), REFUSED);
    other = barrier;
    other.feature = (cipc_feature){CIPC_POINT_EDGE, 3, {0, 2, 3, 0}};
    assert_int_equal(try_closed_form(CIPC_ENERGY_BARRIER_EDGE_EDGE, crossing, &other), REFUSED);
}

/* The comparison must notice: no projection at all; a lost largest eigenvalue; a lost rotation term, the least of the positive eigenvalues.
 */
static void test_check_rejects(void **state)
{
    (void)state;
    uint64_t seed = 32;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)(CIPC_ENERGY_BARRIER_POINT_POINT + kind));
        int n = 3 * energy->nodes;
        double x[N], H[N * N], P[N * N], V[N * N], w[N], mutant[N * N];
        cipc_contact_barrier barrier = {
            .stiffness = 1e3, .weight = 2, .offset = 0.01, .dhat = 0.01, .feature = {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}}};
        draw(&seed, (cipc_pair_kind)kind, 0.013, 0.7, x);
        energy->hessian(x, &barrier, H);
        double limit = tolerance((cipc_pair_kind)kind, n, x, H);
        assert_true(cipc_contact_hessian_projected((cipc_energy_id)(CIPC_ENERGY_BARRIER_POINT_POINT + kind), x, &barrier, P));
        assert_false(agrees(n, H, P, limit));
        memcpy(V, H, sizeof V);
        assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'L', n, V, n, w), 0);
        for (int k = 0; k < n; k++) {
            if (!(w[k] > 1e-9 * w[n - 1])) continue;
            for (int i = 0; i < n * n; i++) mutant[i] = P[i] - w[k] * V[i / n * n + k] * V[i % n * n + k];
            assert_false(agrees(n, mutant, P, limit));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers),
        cmocka_unit_test(test_all_shapes),
        cmocka_unit_test(test_refuses),
        cmocka_unit_test(test_check_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
