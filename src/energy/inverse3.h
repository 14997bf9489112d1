/* Inverse and determinant of a 3x3 matrix, row-major, good for matrices that are nearly singular in one direction or in two. */
#ifndef CIPC_ENERGY_INVERSE3_H
#define CIPC_ENERGY_INVERSE3_H

/* Returns det A; inverse is written if that is not 0. The determinant is that of a matrix some roundings of |A| away, which the expansion by
 * cofactors is not: of singular values 1, e, e it leaves an error of u instead of e u (docs/theory/energies.md, "Tetrahedra"). */
double energy_inverse3(const double A[9], double inverse[9]);

#endif
