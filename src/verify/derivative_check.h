/* The checker of gradients, Hessians and invariances of one energy, shared by the derivative tests and by the self-test that feeds it wrong
 * energies. Method: docs/theory/energies.md, "How the derivatives are checked". */
#ifndef CIPC_VERIFY_DERIVATIVE_CHECK_H
#define CIPC_VERIFY_DERIVATIVE_CHECK_H

#include <stdbool.h>
#include "cipc/energy.h"

enum { VERIFY_DERIVATIVE_BRANCHES = 32 };

typedef struct verify_derivative_report {
    long samples;
    int branch_counts[VERIFY_DERIVATIVE_BRANCHES];
    /* Largest errors and tolerances seen, relative to the largest entry: error and tolerance belong to different samples. */
    double gradient_error, gradient_tolerance, hessian_error, hessian_tolerance;
    char failure[512]; /* the first failure; empty if there is none */
} verify_derivative_report;

/* Every component of gradient and Hessian at one configuration against central differences; symmetry; the invariances of the entry.
 * Returns whether all hold; otherwise report->failure says what does not. */
bool verify_derivatives_at(const cipc_energy *energy, const double *x, const void *params, verify_derivative_report *report);

/* The same at `samples` configurations aimed at each branch, and every branch must be reached at least `minimum` times. */
bool verify_derivatives_of(const cipc_energy *energy, unsigned long seed, int samples, int minimum, verify_derivative_report *report);

#endif
