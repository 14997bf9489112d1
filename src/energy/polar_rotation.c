/* Polar decomposition by Newton's iteration with scaling (Higham; docs/theory/energies.md (V10)). It never forms F^T F, which would square the condition. */
#include "energy/polar_rotation.h"

#include <math.h>

#include "energy/inverse3.h"

/* A step of this length ends the iteration: X is then within it of R and the scale within it of 1, so that what the step has left, half the square of
 * their sum, is 2^-55. */
static const double LAST_STEP = 0x1p-28;
/* Scaled iterations halve the exponent of the condition number: 2^1000 is down to 2^1 after ten of them, and five square away the rest. */
enum { MOST_STEPS = 20 };

static double frobenius(const double A[9])
{
    double sum = 0;
    for (int i = 0; i < 9; i++) sum += A[i] * A[i];
    return sqrt(sum);
}

bool energy_polar_rotation(const double F[9], double R[9])
{
    double inverse[9];
    for (int i = 0; i < 9; i++) R[i] = F[i];
    for (int step = 0; step < MOST_STEPS; step++) {
        if (!(energy_inverse3(R, inverse) > 0)) return false;
        double scale = sqrt(frobenius(inverse) / frobenius(R)), moved = 0;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                double next = 0.5 * (scale * R[3 * i + j] + inverse[3 * j + i] / scale);
                moved = fmax(moved, fabs(next - R[3 * i + j]));
                R[3 * i + j] = next;
            }
        }
        if (moved <= LAST_STEP) return true;
    }
    return false;
}
