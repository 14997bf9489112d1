/* Polar decomposition by Newton's iteration R <- (g R + R^-T/g)/2 with Frobenius scaling g (docs/theory/energies.md (46)). */
#include "energy/polar_rotation.h"

#include <float.h>
#include <string.h>

#include "base/vector.h"

/* Scaled, a matrix of condition 1e16 takes nine iterations; the last ones square the error. */
enum { ITERATIONS = 30 };
/* Scaling is left off once it would change less than this: then the iteration is Newton's, quadratic. */
static const double SCALING_ENDS = 1e-2;

static double frobenius2(double m[3][3]) { return v3_norm2(m[0]) + v3_norm2(m[1]) + v3_norm2(m[2]); }

void energy_polar_rotation(double f[3][3], double r[3][3])
{
    memcpy(r, f, 9 * sizeof(double));
    for (int iteration = 0; iteration < ITERATIONS; iteration++) {
        double inverse[3][3], change = 0; /* R^-T: the cofactors by the determinant */
        for (int c = 0; c < 3; c++) v3_cross(inverse[c], r[(c + 1) % 3], r[(c + 2) % 3]);
        double determinant = v3_dot(r[0], inverse[0]), g = sqrt(sqrt(frobenius2(inverse) / frobenius2(r)) / determinant);
        if (fabs(g - 1) < SCALING_ENDS) g = 1;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) {
                double next = 0.5 * (g * r[c][k] + inverse[c][k] / (g * determinant));
                change = fmax(change, fabs(next - r[c][k]));
                r[c][k] = next;
            }
        if (change <= 2 * DBL_EPSILON) return;
    }
}
