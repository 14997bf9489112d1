#include "support/elastica.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

/* theta(s), downwards, theta'(s) and depth(s) of the heavy elastica of length 1: EI theta'' = -w (1 - s) cos theta. */
static int elastica(double s, const double y[], double f[], void *gamma)
{
    f[0] = y[1];
    f[1] = -*(double *)gamma * (1 - s) * cos(y[0]);
    f[2] = sin(y[0]);
    return GSL_SUCCESS;
}

/* Bending moment left at the tip if the clamp's curvature is c; and how deep the tip is. */
static double shoot(double c, double gamma, double *depth)
{
    gsl_odeiv2_system system = {elastica, NULL, 3, &gamma};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-4, 1e-13, 1e-13);
    double y[3] = {0, c, 0}, s = 0;
    assert_non_null(driver);
    assert_int_equal(gsl_odeiv2_driver_apply(driver, &s, 1, y), GSL_SUCCESS);
    gsl_odeiv2_driver_free(driver);
    *depth = y[2];
    return y[1];
}

/* By bisection on the clamp's curvature. */
double elastica_tip(double gamma)
{
    double low = 0, high = gamma / 2 + 1, depth = 0;
    for (int k = 0; k < 60; k++) {
        double middle = 0.5 * (low + high);
        if (shoot(middle, gamma, &depth) > 0) high = middle;
        else low = middle;
    }
    return depth;
}
