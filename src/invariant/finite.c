/* Monitor M8: no NaN and no infinity among the positions (SPEC V.5). */
#include "cipc/invariant.h"

#include <math.h>

#include "invariant/monitor.h"

cipc_status cipc_monitor_finite(const cipc_model *model, const double *x, cipc_error *error)
{
    for (int i = 0; i < 3 * model->node_count; i++) {
        if (!isfinite(x[i])) {
            return cipc_fail(error, CIPC_E_VIOLATED_FINITE, "monitor finite", "coordinate %c of node %d of body \"%s\" is %g", "xyz"[i % 3],
                             i / 3, cipc_monitor_body(model, i / 3), x[i]);
        }
    }
    return CIPC_OK;
}
