/* BLAS and threads: ours are outside, so BLAS is to use one; and not every BLAS may be called from two threads at a time. */
#ifndef CIPC_IMPLICIT_BLAS_THREADS_H
#define CIPC_IMPLICIT_BLAS_THREADS_H

#include <stdbool.h>

/* Asks the BLAS at hand to use one thread a call (its results would otherwise depend on their number). Returns whether calls from several threads at a time are
 * safe and reproducible. OpenBLAS's serial build now and then hands one work buffer to two callers, and the factors are wrong; its OpenMP build takes other
 * paths, and gives other last bits, inside parallel regions. Its pthread build, with one thread of its own, and the reference BLAS are good. */
bool cipc_blas_one_thread(void);

#endif
