/* What every sampler of the registry must do, and how its classifier names a configuration. */
#ifndef SUPPORT_SAMPLER_TRIAL_H
#define SUPPORT_SAMPLER_TRIAL_H

/* Every draw is feasible, and at least nine in ten land on the branch that they are aimed at (rounding moves some at the edges of the narrow branches). */
void sampler_check(const char *energy);
/* The classifier of the energy calls x, params by this branch's name. */
void sampler_assert_branch(const char *energy, const double *x, const void *params, const char *branch);

#endif
