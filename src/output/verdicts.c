/* What may be claimed of a run: the verdict on each invariant. */
#include "cipc/output.h"

#include <string.h>

enum { INVARIANT_COUNT = 8 };

/* At a point the monitors look in this order and stop at the first violation; M7 looks at whole steps, when all is over. */
static const int turn[INVARIANT_COUNT + 1] = {[6] = 1, [8] = 2, [1] = 3, [2] = 4, [3] = 5, [4] = 6, [5] = 7, [7] = 8};

static int violated_invariant(cipc_status status)
{
    switch (status) {
    case CIPC_E_VIOLATED_INTERSECTION: return 1;
    case CIPC_E_VIOLATED_GAP: return 2;
    case CIPC_E_VIOLATED_STRAIN: return 3;
    case CIPC_E_VIOLATED_INVERSION: return 4;
    case CIPC_E_VIOLATED_SWEPT: return 5;
    case CIPC_E_VIOLATED_ENERGY: return 6;
    case CIPC_E_VIOLATED_MOMENTUM: return 7;
    case CIPC_E_VIOLATED_FINITE: return 8;
    default: return 0;
    }
}

/* Number of points, or steps, that the monitor has looked at and let pass. */
static long points_passed(const cipc_run_summary *summary, int invariant)
{
    const int violated = violated_invariant(summary->status);
    /* Of the last point, the monitors whose turn comes after the violated one know nothing. */
    const long unseen = turn[violated] != 0 && turn[invariant] > turn[violated] ? 1 : 0;
    if (invariant == 6) {
        return summary->energy_checks - unseen;
    }
    if (invariant == 7) {
        return summary->momentum_checks;
    }
    if ((invariant == 3 && summary->limited_triangles == 0) || (invariant == 4 && summary->tetrahedra == 0) || (invariant == 5 && !summary->swept)) {
        return 0;
    }
    if (summary->method == CIPC_METHOD_ASYNCHRONOUS) { /* M5 looks at the windows of paths, the others at the frames after them */
        return invariant == 5 ? summary->windows_checked : summary->points_checked - summary->windows_checked - unseen;
    }
    return summary->points_checked - unseen;
}

const char *cipc_run_summary_verdict(const cipc_run_summary *summary, int invariant)
{
    if (invariant < 1 || invariant > INVARIANT_COUNT) {
        return "not checked";
    }
    if (violated_invariant(summary->status) == invariant) {
        return "violated";
    }
    const bool counted = summary->method == CIPC_METHOD_MASS_SPRING && invariant <= 2 && summary->massspring.frames > 0;
    if (counted) {
        return summary->monitored ? "counted" : "not checked";
    }
    const bool undecided = summary->status == CIPC_E_INDETERMINATE && invariant < 6;
    return summary->monitored && !undecided && points_passed(summary, invariant) > 0 ? "holds" : "not checked";
}
