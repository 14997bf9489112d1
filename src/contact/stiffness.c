/* The range of the barrier stiffness kappa (SPEC D.4, C.7; docs/theory/contact.md (21)-(23)). */
#include "cipc/contact.h"

#include <math.h>

/* kappa_max / kappa_min of SPEC D.4. */
static const double stiffness_span = 100;
/* kappa_min puts this stiffness, per unit of mean mass, at a gap of gap_fraction times the bounding box (SPEC D.4). */
static const double stiffness_scale = 1e11;
static const double gap_fraction = 1e-8;

cipc_stiffness_range cipc_barrier_stiffness_range(double diagonal, double mean_mass, double xi, double dhat)
{
    double d = gap_fraction * diagonal + xi, b[3];
    double d0 = gap_fraction * diagonal * (gap_fraction * diagonal + 2 * xi); /* d^2 - xi^2 */
    double Dhat = dhat * (2 * xi + dhat);
    /* (22): a support shorter than the probing gap would see no barrier at all: probe at a hundredth of it then. */
    if (d0 > 0.01 * Dhat) {
        d0 = 0.01 * Dhat;
        d = sqrt(d0 + xi * xi);
    }
    cipc_barrier(d0, Dhat, b);
    cipc_stiffness_range range;
    range.minimum = stiffness_scale * mean_mass / (4 * d * d * b[2]);
    range.maximum = stiffness_span * range.minimum;
    return range;
}

cipc_stiffness_range cipc_barrier_stiffness_range_released(double mean_mass, double dhat)
{
    double b[3];
    cipc_barrier(1e-16, dhat * dhat, b);
    cipc_stiffness_range range;
    range.minimum = stiffness_scale * 3 * mean_mass / (4e-16 * b[2]);
    range.maximum = stiffness_span * range.minimum;
    return range;
}
