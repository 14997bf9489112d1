/* Monitor M4: every tetrahedron keeps positive orientation, det[x1 - x0, x2 - x0, x3 - x0] > 0, by the exact predicate (SPEC V.5). */
#include "cipc/invariant.h"

#include "cipc/geometry.h"
#include "invariant/monitor.h"

static int orientation(const cipc_model *model, int tetrahedron, const double *x)
{
    const int *n = model->tetrahedra[tetrahedron];
    return cipc_orient3d(&x[3 * (size_t)n[0]], &x[3 * (size_t)n[1]], &x[3 * (size_t)n[2]], &x[3 * (size_t)n[3]]);
}

cipc_status cipc_monitor_inversion(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    (void)report;
    const cipc_model *m = monitor->model;
    cipc_status status = cipc_monitor_finite(m, x, error);
    if (status != CIPC_OK) { return status; }
    int first = m->tetrahedron_count;
#pragma omp parallel for schedule(static) reduction(min : first) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int t = 0; t < m->tetrahedron_count; t++) {
        if (orientation(m, t, x) <= 0 && t < first) { first = t; }
    }
    if (first == m->tetrahedron_count) { return CIPC_OK; }
    const int *n = m->tetrahedra[first];
    return cipc_fail(error, CIPC_E_VIOLATED_INVERSION, "monitor inversion",
                     "tetrahedron %d (nodes %d %d %d %d, body \"%s\") is %s: the sign of its volume must be +1", first, n[0], n[1], n[2],
                     n[3], cipc_monitor_body(m, n[0]), orientation(m, first, x) < 0 ? "inverted (sign -1)" : "flat (sign 0)");
}
