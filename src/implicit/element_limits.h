/* What an element may not do: how much is left of its limit, and how fast that can shrink along a path (docs/theory/time_step.md, section 7a). */
#ifndef CIPC_IMPLICIT_ELEMENT_LIMITS_H
#define CIPC_IMPLICIT_ELEMENT_LIMITS_H

/* The limits of one energy. */
typedef struct element_limit {
    /* What is left at positions y, less a margin for rounding: > 0 means that the exact element keeps its limit. */
    double (*slack)(const void *params, const double *y);
    /* A bound on the change of the slack per t while the nodes move on y + t d, 0 <= t <= 1. NULL: the slack is a concave function of the positions, so that what holds at both ends of a
     * straight path holds all along it. */
    double (*speed)(const void *params, const double *y, const double *d);
} element_limit;

extern const element_limit implicit_limit_upper;   /* largest principal stretch, cipc_strain_limit */
extern const element_limit implicit_limit_lower;   /* least principal stretch, cipc_strain_limit */
extern const element_limit implicit_limit_strains; /* Green strains, cipc_orthotropic */
extern const element_limit implicit_limit_volume;  /* positive volume, cipc_volume */

/* The largest part of [0, step] over which the limit is certain to be kept, or one at whose end a tenth of the slack is left; 0 if it is not kept at the start. */
double implicit_limit_step(const element_limit *limit, const void *params, int nodes, const double *y, const double *d, double step);

#endif
