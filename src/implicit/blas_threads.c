/* OpenBLAS tells how it was built; other BLAS (the reference one, BLIS) lack these functions, use one thread and share nothing. */
#include "implicit/blas_threads.h"

#include <stddef.h>

extern void openblas_set_num_threads(int threads) __attribute__((weak));
extern int openblas_get_parallel(void) __attribute__((weak));

/* What openblas_get_parallel says: 0 serial, 1 pthreads, 2 OpenMP. */
enum { PTHREAD_BUILD = 1 };

bool cipc_blas_one_thread(void)
{
    if (openblas_set_num_threads != NULL) openblas_set_num_threads(1);
    return openblas_get_parallel == NULL || openblas_get_parallel() == PTHREAD_BUILD;
}
