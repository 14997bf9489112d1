/* Energies with a planted fault, among them the real bugs of this field (SPEC V.7): every checker of derivatives has to reject them. */
#ifndef CIPC_SUPPORT_WRONG_ENERGIES_H
#define CIPC_SUPPORT_WRONG_ENERGIES_H

#include "cipc/energy.h"

typedef struct wrong_energy {
    const char *what, *energy;
    const char *differences; /* part of what the checker by differences has to say; NULL: it cannot see the fault */
    const char *mpfr;        /* part of what the campaign against MPFR has to say */
    double (*value)(const double *x, const void *params); /* NULL: the right one */
    void (*gradient)(const double *x, const void *params, double *g);
    void (*hessian)(const double *x, const void *params, double *H);
} wrong_energy;

int wrong_energy_count(void);
const wrong_energy *wrong_energy_at(int index);
/* The registry's entry with the wrong functions in it. */
cipc_energy wrong_energy_entry(const wrong_energy *wrong);

#endif
