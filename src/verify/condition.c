/* Measured condition of a Hessian. */
#include "verify/condition.h"

#include <math.h>
#include <string.h>

enum { N = 12 };
/* Fractions of the size tried, from 2^-26 to 2^-50, the last that is some roundings of the coordinates. */
static const double FIRST_SHIFT = 0x1p-26, LAST_SHIFT = 0x1p-50, NARROWER = 0x1p-6;
/* A change of the Hessian up to this share of it is taken as proportional to the shift. */
static const double PROPORTIONAL = 0.125;

double verify_largest(const double *v, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

double verify_largest_error(const double *got, const double *want, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = isfinite(got[i]) ? fmax(most, fabs(got[i] - want[i])) : INFINITY;
    return most;
}

double verify_over(double error, double tolerance) { return error == 0 ? 0 : error / tolerance; }

/* Change for a shift to one side, or where that is infeasible to the other; INFINITY if both are. */
static double change_for(const cipc_oracle_function *f, const double *x, const double *fields, const double *H, double shift, unsigned long signs)
{
    double shifted[N], moved[N * N];
    int n = 3 * f->nodes;
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i < n; i++) shifted[i] = x[i] + (signs >> i & 1 ? side : -side) * shift;
        if (cipc_oracle_evaluate(f, shifted, fields, NULL, NULL, moved) == CIPC_YES) return verify_largest_error(moved, H, n * n);
    }
    return INFINITY;
}

static double change_along(const cipc_oracle_function *f, const double *x, const double *fields, const double *H, double size, unsigned long signs)
{
    double scale = verify_largest(H, 9 * f->nodes * f->nodes);
    for (double shift = FIRST_SHIFT; shift >= LAST_SHIFT; shift *= NARROWER) {
        double change = change_for(f, x, fields, H, shift * size, signs);
        if (change <= PROPORTIONAL * scale) return change / shift;
    }
    return INFINITY;
}

double verify_hessian_change(const cipc_oracle_function *f, const double *x, const double *fields, const double *g, const double *H, double size,
                             unsigned long random)
{
    unsigned long uphill = 0;
    for (int i = 0; i < 3 * f->nodes; i++) uphill |= (g[i] > 0 ? 1UL : 0UL) << i;
    double most = change_along(f, x, fields, H, size, uphill);
    most = fmax(most, change_along(f, x, fields, H, size, random));
    return fmax(most, change_along(f, x, fields, H, size, random >> N));
}

verify_tolerances verify_tolerances_of(double value, const double *g, const double *H, int n, double size, double change)
{
    double u = VERIFY_UNIT, slope = verify_largest(g, n), bend = verify_largest(H, n * n);
    return (verify_tolerances){
        .value = VERIFY_ROUNDINGS * u * (fabs(value) + slope * size + u * bend * size * size),
        .gradient = VERIFY_ROUNDINGS * u * (slope + bend * size),
        .hessian = VERIFY_ROUNDINGS * u * (bend + change),
    };
}

void verify_add_matrix_rounding(verify_tolerances *tolerances, const cipc_oracle_function *f, const double *x, const double *fields, const double *H)
{
    if (strcmp(f->name, "damping") != 0) return;
    double way = verify_largest_error(x, fields + 1, N), force = VERIFY_ROUNDINGS * VERIFY_UNIT * verify_largest(H, N * N) * way; /* fields: factor, start[12], ... */
    tolerances->value += force * way;
    tolerances->gradient += force;
}
