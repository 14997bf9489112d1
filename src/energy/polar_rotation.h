/* The rotation nearest to a deformation gradient. */
#ifndef CIPC_ENERGY_POLAR_ROTATION_H
#define CIPC_ENERGY_POLAR_ROTATION_H

/* F = R S, R a rotation and S symmetric positive definite, for det F > 0; matrices by their columns. Scaled Newton iteration (Higham): R and S are good to some u, as are those
 * of a matrix next to F. */
void energy_polar_rotation(double f[3][3], double r[3][3]);

#endif
