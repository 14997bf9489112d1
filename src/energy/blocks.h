/* 3x3 blocks of a Hessian: node i against node j of a stencil, row-major with n = 3 * nodes columns. */
#ifndef CIPC_ENERGY_BLOCKS_H
#define CIPC_ENERGY_BLOCKS_H

/* Write the symmetric pair: K at (i, j) and its transpose at (j, i). For i == j, K must be symmetric itself. */
static inline void put_block_pair(double *H, int n, int i, int j, double K[3][3])
{
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            H[(3 * i + r) * n + 3 * j + c] = K[r][c];
            H[(3 * j + c) * n + 3 * i + r] = K[r][c];
        }
    }
}

static inline void put_zeros(double *values, int count)
{
    for (int i = 0; i < count; i++) values[i] = 0;
}

#endif
