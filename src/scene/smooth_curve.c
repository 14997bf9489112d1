/* Splines from GSL. Lengths by Gauss-Legendre quadrature of the speed, piece by piece, as the speed is smooth within a piece only. */
#include "scene/smooth_curve.h"

#include <gsl/gsl_errno.h>

#include "base/vector.h"

/* Nodes and weights on [-1, 1] of the quadrature with 8 points, exact for polynomials of degree 15; the positive half (Abramowitz & Stegun, table 25.4). */
enum { HALF_POINTS = 4, INVERSE_STEPS = 60 };
static const double quadrature_node[HALF_POINTS] = {0.183434642495649805, 0.525532409916328986, 0.796666477413626740, 0.960289856497536232};
static const double quadrature_weight[HALF_POINTS] = {0.362683783378361983, 0.313706645877887287, 0.222381034453374471, 0.101228536290376259};
static const double length_tolerance = 1e-14; /* of the whole length: rounding of its sum */

static gsl_spline *spline_of(int count, const double *knots, const double (*values)[3], int component, double *column)
{
    /* GSL aborts the program when it has no memory, unless its error handler is off. */
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    gsl_spline *spline = gsl_spline_alloc(count > 2 ? gsl_interp_cspline : gsl_interp_linear, (size_t)count);
    for (int i = 0; i < count; i++) column[i] = values[i][component];
    if (spline != NULL && gsl_spline_init(spline, knots, column, (size_t)count) != GSL_SUCCESS) {
        gsl_spline_free(spline);
        spline = NULL;
    }
    gsl_set_error_handler(handler);
    return spline;
}

bool scene_spline3_init(gsl_spline *spline[3], int count, const double *knots, const double (*values)[3])
{
    spline[0] = spline[1] = spline[2] = NULL;
    double *column = cipc_alloc((size_t)count, sizeof *column);
    for (int a = 0; a < 3 && column != NULL; a++) spline[a] = spline_of(count, knots, values, a, column);
    cipc_free(column);
    return spline[0] != NULL && spline[1] != NULL && spline[2] != NULL;
}

void scene_spline3_free(gsl_spline *spline[3])
{
    for (int a = 0; a < 3; a++) {
        gsl_spline_free(spline[a]);
        spline[a] = NULL;
    }
}

void scene_spline3_at(gsl_spline *const spline[3], double parameter, double value[3])
{
    for (int a = 0; a < 3; a++) value[a] = gsl_spline_eval(spline[a], parameter, NULL);
}

static double speed(const scene_curve *curve, double parameter)
{
    double derivative[3];
    for (int a = 0; a < 3; a++) derivative[a] = gsl_spline_eval_deriv(curve->place[a], parameter, NULL);
    return v3_norm(derivative);
}

/* Length between two parameters of one piece. */
static double length_between(const scene_curve *curve, double from, double to)
{
    double middle = 0.5 * (from + to), half = 0.5 * (to - from), sum = 0;
    for (int k = 0; k < HALF_POINTS; k++) {
        double step = half * quadrature_node[k];
        sum += quadrature_weight[k] * (speed(curve, middle - step) + speed(curve, middle + step));
    }
    return half * sum;
}

static cipc_status check(int count, const double (*points)[3], const char *place, cipc_error *error)
{
    if (count < 2) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d points; 2 are needed", count);
    for (int i = 0; i < count; i++) {
        const double *x = points[i];
        if (!(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d is (%g, %g, %g)", i, x[0], x[1], x[2]);
        }
        if (i > 0 && x[0] == x[-3] && x[1] == x[-2] && x[2] == x[-1]) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "points %d and %d are the same", i - 1, i);
        }
    }
    return CIPC_OK;
}

/* Knots: the lengths of the chords, summed. Too short a chord beside a long way before it would be lost in rounding. */
static cipc_status place_knots(scene_curve *curve, const double (*points)[3], const char *place, cipc_error *error)
{
    for (int i = 0; i < curve->pieces; i++) {
        double chord[3];
        v3_sub(chord, points[i + 1], points[i]);
        curve->knots[i + 1] = curve->knots[i] + v3_norm(chord);
        if (curve->knots[i + 1] > curve->knots[i]) continue;
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "points %d and %d are too close to each other", i, i + 1);
    }
    return CIPC_OK;
}

cipc_status scene_curve_init(scene_curve *curve, int count, const double (*points)[3], const char *place, cipc_error *error)
{
    *curve = (scene_curve){0};
    cipc_status status = check(count, points, place, error);
    if (status != CIPC_OK) return status;
    curve->pieces = count - 1;
    curve->knots = cipc_alloc((size_t)count, sizeof *curve->knots);
    curve->lengths = cipc_alloc((size_t)count, sizeof *curve->lengths);
    if (curve->knots == NULL || curve->lengths == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d points", count);
    status = place_knots(curve, points, place, error);
    if (status != CIPC_OK) return status;
    if (!scene_spline3_init(curve->place, count, curve->knots, points)) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the spline through %d points", count);
    }
    for (int i = 0; i < curve->pieces; i++) {
        curve->lengths[i + 1] = curve->lengths[i] + length_between(curve, curve->knots[i], curve->knots[i + 1]);
    }
    return CIPC_OK;
}

void scene_curve_free(scene_curve *curve)
{
    cipc_free(curve->knots);
    cipc_free(curve->lengths);
    scene_spline3_free(curve->place);
    *curve = (scene_curve){0};
}

double scene_curve_length(const scene_curve *curve)
{
    return curve->lengths[curve->pieces];
}

/* Newton's method on the length within the piece, which grows with the parameter; a step that leaves the bracket is a bisection instead. */
double scene_curve_parameter(const scene_curve *curve, double s)
{
    int piece = 0;
    while (piece + 1 < curve->pieces && s > curve->lengths[piece + 1]) piece++;
    const double begin = curve->knots[piece], want = s - curve->lengths[piece], close = length_tolerance * scene_curve_length(curve);
    double low = begin, high = curve->knots[piece + 1];
    double at = low + (high - low) * (want / (curve->lengths[piece + 1] - curve->lengths[piece]));
    for (int step = 0; step < INVERSE_STEPS; step++) {
        at = min2(max2(at, low), high);
        double excess = length_between(curve, begin, at) - want;
        if (fabs(excess) <= close) break;
        if (excess > 0)
            high = at;
        else
            low = at;
        double next = at - excess / speed(curve, at);
        at = next > low && next < high ? next : 0.5 * (low + high);
    }
    return at;
}

void scene_curve_at(const scene_curve *curve, double parameter, double x[3], double derivative[3])
{
    for (int a = 0; a < 3; a++) {
        x[a] = gsl_spline_eval(curve->place[a], parameter, NULL);
        derivative[a] = gsl_spline_eval_deriv(curve->place[a], parameter, NULL);
    }
}
