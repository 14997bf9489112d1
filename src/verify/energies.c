/* Campaign "energies": value, gradient and Hessian of every energy of the registry against MPFR (SPEC V.6; docs/theory/tolerances.md). */
#include "verify/energies.h"

#include <math.h>
#include <string.h>

#include "verify/condition.h"

enum { N = VERIFY_COORDINATES };
static void describe(int index, verify_row *row)
{
    verify_describe_branches(row, cipc_energy_entry((cipc_energy_id)index));
    verify_row_forbid(row, "not finite where MPFR is");
    verify_row_forbid(row, "undecided by the oracle");
    verify_row_counter(row, "Hessian not determined by doubles");
    verify_row_maximum(row, "value, error over tolerance", 1);
    verify_row_maximum(row, "gradient, error over tolerance", 1);
    verify_row_maximum(row, "Hessian, error over tolerance", 1);
    verify_row_maximum(row, "value, ULP", INFINITY);
    verify_row_maximum(row, "gradient, ULP of its largest entry", INFINITY);
    verify_row_maximum(row, "Hessian, ULP of its largest entry", INFINITY);
}

/* Value and derivatives of one configuration by the oracle, and how much the Hessian changes over the stencil's size: |dH| S. */
typedef struct reference {
    const cipc_oracle_function *function;
    int n;
    double size, value, g[N], H[N * N], change;
} reference;

/* Size of the stencil: the largest difference of coordinates; of a single node, the largest coordinate, from which targets are subtracted. */
static double size_of(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, n > 3 ? fabs(x[i] - x[i % 3]) : fabs(x[i]));
    return most;
}

static bool look_up(const cipc_oracle_function *f, gsl_rng *rng, const double *x, const double *fields, reference *r)
{
    r->function = f;
    r->n = 3 * f->nodes;
    r->size = size_of(x, r->n);
    if (cipc_oracle_evaluate(f, x, fields, &r->value, r->g, r->H) != CIPC_YES) return false;
    r->change = verify_hessian_change(f, x, fields, r->g, r->H, r->size, gsl_rng_uniform_int(rng, 1UL << 24));
    return true;
}

static double ulp(double error, double scale) { return scale > 0 ? error / (2 * VERIFY_UNIT * scale) : error > 0 ? INFINITY : 0; }

static void compare(const reference *r, const double *got_value, const double *g, const double *H, long sample, verify_row *row, const cipc_query *query)
{
    double value_error = verify_largest_error(got_value, &r->value, 1), g_error = verify_largest_error(g, r->g, r->n), H_error = verify_largest_error(H, r->H, r->n * r->n);
    verify_tolerances tolerance = verify_tolerances_of(r->value, r->g, r->H, r->n, r->size, r->change);
    verify_add_matrix_rounding(&tolerance, r->function, query->x, query->params, r->H);
    verify_measure(row, 0, verify_over(value_error, tolerance.value), sample, query);
    verify_measure(row, 1, verify_over(g_error, tolerance.gradient), sample, query);
    verify_measure(row, 2, verify_over(H_error, tolerance.hessian), sample, query);
    verify_measure(row, 3, ulp(value_error, fabs(r->value)), sample, query);
    verify_measure(row, 4, ulp(g_error, verify_largest(r->g, r->n)), sample, query);
    verify_measure(row, 5, ulp(H_error, verify_largest(r->H, r->n * r->n)), sample, query);
}

static void sample(int index, gsl_rng *rng, long number, verify_row *row, const void *context)
{
    const verify_energy_subject *subject = context;
    const cipc_energy *energy = subject->entry((cipc_energy_id)index);
    double x[N], value, g[N], H[N * N];
    verify_params params;
    cipc_query query;
    reference r;
    verify_draw_energy(energy, rng, number, row, x, &params, &query);
    const cipc_oracle_function *f = cipc_oracle_function_find(energy->name);
    if (f == NULL || !look_up(f, rng, x, query.params, &r)) {
        verify_count(row, energy->branch_count + 1, number, &query);
        return;
    }
    value = energy->value(x, &params);
    energy->gradient(x, &params, g);
    energy->hessian(x, &params, H);
    if (!isfinite(value) || !isfinite(verify_largest_error(g, r.g, r.n)) || !isfinite(verify_largest_error(H, r.H, r.n * r.n)))
        verify_count(row, energy->branch_count, number, &query);
    if (r.change == INFINITY) verify_count(row, energy->branch_count + 2, number, NULL);
    compare(&r, &value, g, H, number, row, &query);
}

static const verify_energy_subject subject = {cipc_energy_entry};
const verify_campaign verify_energies = {"energies", CIPC_ENERGY_COUNT, describe, sample, &subject, 0.01};
