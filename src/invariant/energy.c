/* Monitor M6: the energy decreases between accepted points, and the residual is below its tolerance at convergence (SPEC V.5). */
#include "cipc/invariant.h"

#include <math.h>

static const char place[] = "monitor energy";

/* Exact: is a - b > c? a - b = high + low without error (Knuth's two-sum), and low is at most half an ulp of high, so it only matters at
 * a tie. */
static bool difference_exceeds(double a, double b, double c)
{
    double high = a - b;
    double b_part = a - high, a_part = high + b_part;
    double low = (a - a_part) + (b_part - b);
    return high > c || (high == c && low > 0);
}

cipc_status cipc_monitor_energy(double before, double after, double noise, cipc_error *error)
{
    if (!isfinite(before) || !isfinite(after)) {
        return cipc_fail(error, CIPC_E_VIOLATED_ENERGY, place, "an energy is not finite: %.17g (%a) before, %.17g (%a) after", before,
                         before, after, after);
    }
    if (!(noise >= 0) || !isfinite(noise)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place,
                         "the bound on the rounding of energies is %g; it must be finite and not negative", noise);
    }
    if (difference_exceeds(after, before, noise)) {
        return cipc_fail(error, CIPC_E_VIOLATED_ENERGY, place,
                         "the energy rose from %.17g (%a) to %.17g (%a), by more than the rounding bound %.17g (%a)", before, before, after,
                         after, noise, noise);
    }
    return CIPC_OK;
}

cipc_status cipc_monitor_residual(double residual, double tolerance, cipc_error *error)
{
    if (residual >= 0 && residual <= tolerance && isfinite(tolerance)) { return CIPC_OK; }
    return cipc_fail(error, CIPC_E_VIOLATED_ENERGY, "monitor residual",
                     "the residual at convergence is %.17g (%a), the tolerance %.17g (%a)", residual, residual, tolerance, tolerance);
}
