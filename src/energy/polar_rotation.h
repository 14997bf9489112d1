/* The rotation R of the polar decomposition F = R S, S symmetric and positive definite, of a 3x3 matrix, row-major. */
#ifndef CIPC_ENERGY_POLAR_ROTATION_H
#define CIPC_ENERGY_POLAR_ROTATION_H

#include <stdbool.h>

/* False if det F > 0 does not hold, or F is so near to singular that doubles do not determine R. */
bool energy_polar_rotation(const double F[9], double R[9]);

#endif
