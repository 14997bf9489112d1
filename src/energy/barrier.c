/* The scalar barrier of C-IPC (SPEC C.4, D.2; docs/theory/energies.md (27)). */
#include "cipc/energy.h"

#include <math.h>

void cipc_barrier(double D, double Dhat, double b[3])
{
    b[0] = b[1] = b[2] = 0;
    if (D >= Dhat) return;
    if (!(D > 0)) {
        b[0] = INFINITY;
        return;
    }
    /* Beyond Dhat/2 the difference is exact, and log1p of it keeps the logarithm's digits as it goes to 0. */
    double past = D - Dhat, ratio = past / D;
    double logarithm = D > 0.5 * Dhat ? log1p(past / Dhat) : log(D / Dhat);
    b[0] = -past * past * logarithm;
    b[1] = -2 * past * logarithm - past * ratio;       /* both terms negative */
    b[2] = -2 * logarithm - 4 * ratio + ratio * ratio; /* all terms positive */
}
