/* The nearest positive semi-definite matrix: against LAPACK's eigenvectors, and by the optimality conditions that need no reference. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "cipc/energy.h"
#include "implicit/psd_projection.h"
#include "support/exact_geometry.h"

enum { N = 12 };

/* Errors of both decompositions, 40 n^2 u |H| each (test_symmetric_eigen.c), and as much again for putting the matrix together. */
static double tolerance(int n, double size)
{
    return 120.0 * n * n * UNIT_ROUNDOFF * size;
}

static double frobenius(int n, const double *A)
{
    double sum = 0;
    for (int i = 0; i < n * n; i++) sum += A[i] * A[i];
    return sqrt(sum);
}

static double least_eigenvalue(int n, const double *A)
{
    double copy[N * N], w[N];
    memcpy(copy, A, (size_t)(n * n) * sizeof *A);
    assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', n, copy, n, w), 0);
    return w[0];
}

/* sum over k of f(w_k) v_k v_k^T from LAPACK's decomposition. */
typedef double spectrum_function(double w, int k, int n);
static void rebuild(int n, const double *H, spectrum_function *f, double *P)
{
    double V[N * N], w[N];
    memcpy(V, H, (size_t)(n * n) * sizeof *H);
    assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'L', n, V, n, w), 0);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            P[i * n + j] = 0;
            for (int k = 0; k < n; k++) P[i * n + j] += f(w[k], k, n) * V[i * n + k] * V[j * n + k];
        }
}

static double clamped(double w, int k, int n)
{
    (void)k, (void)n;
    return fmax(w, 0);
}

/* Is P the nearest positive semi-definite matrix to H? Twice over: equal to the reference; and P >= 0, P - H >= 0, <P, P - H> = 0, which
 * are necessary and sufficient for the projection on the cone. */
static bool is_nearest(int n, const double *H, const double *P)
{
    double size = frobenius(n, H), limit = tolerance(n, size), reference[N * N], difference[N * N], inner = 0;
    rebuild(n, H, clamped, reference);
    for (int i = 0; i < n * n; i++) {
        if (!(fabs(P[i] - reference[i]) <= limit)) return false;
        difference[i] = P[i] - H[i];
        inner += P[i] * difference[i];
    }
    return least_eigenvalue(n, P) >= -limit && least_eigenvalue(n, difference) >= -limit && fabs(inner) <= limit * size;
}

static void draw_symmetric(uint64_t *seed, int n, double *A)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) A[i * n + j] = A[j * n + i] = random_uniform(seed, -1, 1);
}

/* H = D^T S D with D the differences to node 0 and S of size 3 (nodes - 1): invariant under translation. shift adds to S's diagonal. */
static void draw_invariant(uint64_t *seed, int nodes, double shift, double *H)
{
    int m = 3 * (nodes - 1), n = 3 * nodes;
    double S[N * N];
    draw_symmetric(seed, m, S);
    for (int i = 0; i < m; i++) S[i * m + i] += shift;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int a = 0; a < m; a++)
                for (int b = 0; b < m; b++) {
                    double di = i == a + 3 ? 1 : i == a % 3 ? -1 : 0, dj = j == b + 3 ? 1 : j == b % 3 ? -1 : 0;
                    sum += di * dj * S[a * m + b];
                }
            H[i * n + j] = sum;
        }
}

static void assert_projects(int nodes, const double *H, bool invariant)
{
    int n = 3 * nodes;
    double P[N * N], plain[N * N];
    memcpy(P, H, sizeof P);
    memcpy(plain, H, sizeof plain);
    assert_true(cipc_psd_project(nodes, P, invariant));
    assert_true(cipc_psd_project_plain(n, plain));
    if (!is_nearest(n, H, P)) fail_msg("%d nodes, invariant %d: not the nearest", nodes, invariant);
    if (!is_nearest(n, H, plain)) fail_msg("%d nodes: the plain form is not the nearest", nodes);
}

static void test_random(void **state)
{
    (void)state;
    uint64_t seed = 21;
    for (int nodes = 1; nodes <= 4; nodes++)
        for (int trial = 0; trial < 400; trial++) {
            double H[N * N], shift = random_uniform(&seed, -3, 3);
            draw_symmetric(&seed, 3 * nodes, H);
            for (int i = 0; i < 3 * nodes; i++) H[i * 3 * nodes + i] += shift;
            assert_projects(nodes, H, false);
            if (nodes == 1) continue;
            draw_invariant(&seed, nodes, shift, H);
            assert_projects(nodes, H, true);
            assert_projects(nodes, H, false);
        }
}

/* What is positive definite (for invariant matrices: but for translations) stays as it is, bit for bit. */
static void test_definite_is_unchanged(void **state)
{
    (void)state;
    uint64_t seed = 22;
    for (int nodes = 1; nodes <= 4; nodes++)
        for (int trial = 0; trial < 200; trial++) {
            double H[N * N] = {0}, P[N * N], shift = 3.0 * nodes + random_uniform(&seed, 0.01, 1); /* rows of S sum to less */
            bool invariant = nodes > 1 && trial % 2;
            if (invariant)
                draw_invariant(&seed, nodes, shift, H);
            else
                draw_symmetric(&seed, 3 * nodes, H);
            for (int i = 0; i < 3 * nodes && !invariant; i++) H[i * 3 * nodes + i] += shift;
            memcpy(P, H, sizeof P);
            assert_true(cipc_psd_project(nodes, P, invariant));
            assert_memory_equal(P, H, sizeof P);
        }
}

/* Zero, negative definite, rank one (both signs). */
static void test_special(void **state)
{
    (void)state;
    uint64_t seed = 23;
    for (int nodes = 1; nodes <= 4; nodes++) {
        int n = 3 * nodes;
        double H[N * N] = {0}, v[N];
        assert_projects(nodes, H, false);
        assert_projects(nodes, H, true);
        for (int i = 0; i < n; i++) H[i * n + i] = -1 - i;
        assert_projects(nodes, H, false);
        for (int trial = 0; trial < 50; trial++) {
            double sum[3] = {0, 0, 0};
            random_fill(&seed, v, n, 1);
            for (int i = 0; i < n - 3; i++) sum[i % 3] += v[i];
            for (int k = 0; k < 3 && nodes > 1; k++) v[n - 3 + k] = -sum[k];
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) H[i * n + j] = (trial % 2 ? 1 : -1) * v[i] * v[j];
            assert_projects(nodes, H, nodes > 1);
        }
    }
}

/* The Hessians of all energies that assembly projects: the reduced problem gives the plain one's answer. */
static void test_energies(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    long projected = 0;
    for (int id = 0; id < CIPC_ENERGY_COUNT; id++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)id);
        if (!(energy->invariances & CIPC_INVARIANT_TRANSLATION)) continue;
        for (int branch = 0; branch < energy->branch_count; branch++)
            for (int trial = 0; trial < 40; trial++) {
                double x[N], params[64], H[N * N] = {0};
                assert_true(energy->params_size <= sizeof params);
                energy->sample(rng, branch, x, params);
                if (!isfinite(energy->value(x, params))) continue;
                energy->hessian(x, params, H);
                double size = frobenius(3 * energy->nodes, H);
                if (!(size > 1e-100 && size < 1e100)) continue; /* the check squares */
                for (int i = 0; i < N * N; i++) H[i] /= size;
                assert_projects(energy->nodes, H, true);
                projected++;
            }
    }
    gsl_rng_free(rng);
    assert_true(projected > 1000);
}

static void test_not_finite(void **state)
{
    (void)state;
    uint64_t seed = 24;
    for (int nodes = 1; nodes <= 4; nodes++)
        for (int trial = 0; trial < 50; trial++) {
            int n = 3 * nodes, i = random_below(&seed, n), j = random_below(&seed, n);
            double H[N * N], P[N * N];
            draw_invariant(&seed, nodes > 1 ? nodes : 2, -0.5, H);
            H[i * n + j] = H[j * n + i] = trial % 2 ? NAN : INFINITY;
            memcpy(P, H, sizeof P);
            assert_false(cipc_psd_project(nodes, P, false));
            assert_false(cipc_psd_project_plain(n, P));
            if (nodes > 1) assert_false(cipc_psd_project(nodes, P, true));
            assert_memory_equal(P, H, sizeof P); /* a failure leaves it as it is: the factorisation will see it */
        }
}

static double kept(double w, int k, int n)
{
    (void)k, (void)n;
    return w;
}
static double absolute(double w, int k, int n)
{
    (void)k, (void)n;
    return fabs(w);
}
static double without_largest(double w, int k, int n)
{
    return k == n - 1 ? 0 : fmax(w, 0);
}
static double nothing(double w, int k, int n)
{
    (void)w, (void)k, (void)n;
    return 0;
}
static double lifted(double w, int k, int n)
{
    (void)k, (void)n;
    return fmax(w, 1e-9);
}

/* The check must notice every one of these wrong projections of a matrix with eigenvalues on both sides. */
static void test_check_rejects(void **state)
{
    (void)state;
    spectrum_function *const mutants[] = {kept, absolute, without_largest, nothing, lifted};
    for (int nodes = 1; nodes <= 4; nodes++) {
        int n = 3 * nodes;
        double H[N * N] = {0}, P[N * N];
        for (int i = 0; i < n; i++) H[i * n + i] = i % 2 ? 0.2 + 0.3 * i : -0.7 * (i + 1);
        for (int i = 0; i + 1 < n; i++) H[i * n + i + 1] = H[(i + 1) * n + i] = 0.01;
        rebuild(n, H, clamped, P);
        assert_true(is_nearest(n, H, P));
        for (size_t k = 0; k < sizeof mutants / sizeof *mutants; k++) {
            rebuild(n, H, mutants[k], P);
            if (is_nearest(n, H, P)) fail_msg("mutant %zu of %d nodes passes", k, nodes);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random),     cmocka_unit_test(test_definite_is_unchanged),
        cmocka_unit_test(test_special),    cmocka_unit_test(test_energies),
        cmocka_unit_test(test_not_finite), cmocka_unit_test(test_check_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
