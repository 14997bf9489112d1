/* Campaign "derivatives": every energy against central differences of itself, its symmetries, and the projection of its Hessian (SPEC V.6). */
#include <math.h>
#include <string.h>

#include "implicit/psd_projection.h"
#include "verify/derivative_check.h"
#include "verify/energies.h"
#include "verify/projection_check.h"

enum { N = VERIFY_COORDINATES };

static void describe(int index, verify_row *row)
{
    verify_describe_branches(row, cipc_energy_entry((cipc_energy_id)index));
    verify_row_forbid(row, "differences, symmetry or invariance broken");
    verify_row_forbid(row, "Hessian not projected");
    verify_row_maximum(row, "gradient, relative error against differences", INFINITY);
    verify_row_maximum(row, "Hessian, relative error against differences", INFINITY);
    verify_row_maximum(row, "projection, error over tolerance", 1);
}

/* The Hessian and what assembly makes of it: is that the nearest positive semi-definite matrix? */
static void check_projection(const cipc_energy *energy, const double *x, const void *params, long number, verify_row *row, const cipc_query *query)
{
    int n = 3 * energy->nodes;
    double H[N * N], P[N * N];
    energy->hessian(x, params, H);
    memcpy(P, H, (size_t)(n * n) * sizeof *H);
    if (!cipc_psd_project(energy->nodes, P, (energy->invariances & CIPC_INVARIANT_TRANSLATION) != 0)) verify_count(row, energy->branch_count + 1, number, query);
    verify_measure(row, 2, verify_projection_error(n, H, P), number, query);
}

static void sample(int index, gsl_rng *rng, long number, verify_row *row, const void *context)
{
    const verify_energy_subject *subject = context;
    const cipc_energy *energy = subject->entry((cipc_energy_id)index);
    double x[N];
    verify_params params;
    cipc_query query;
    verify_derivative_report report;
    memset(&report, 0, sizeof report);
    verify_draw_energy(energy, rng, number, row, x, &params, &query);
    if (!verify_derivatives_at(energy, x, &params, &report)) verify_count(row, energy->branch_count, number, &query);
    verify_measure(row, 0, report.gradient_error, number, &query);
    verify_measure(row, 1, report.hessian_error, number, &query);
    check_projection(energy, x, &params, number, row, &query);
}

static const verify_energy_subject subject = {cipc_energy_entry};
const verify_campaign verify_derivatives = {"derivatives", CIPC_ENERGY_COUNT, describe, sample, &subject, 0.02};
