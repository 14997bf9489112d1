/* Central differences with a step ladder, and invariances. See derivative_check.h. */
#include "verify/derivative_check.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MAX_N = 12, MAX_PARAMS = 1024, RUNGS = 23 };

/* Unit roundoff of double. */
#define ROUNDING (DBL_EPSILON / 2)

/* Six-point central difference: sum_m STENCIL[m] (f(x + m h) - f(x - m h)) / (2 m h), truncation error O(h^6). */
static const double STENCIL[3] = {1.5, -0.6, 0.1};

/* Error of one estimate from rounding. The terms of the stencil weigh 1.5 + 0.6/2 + 0.1/3 < 2 together. A term f is off by some roundings
 * of itself, and by what rounding the positions makes of it, u |x| |f'|; four of each. */
static const double VALUE_ROUNDINGS = 8;

/* Three neighbouring rungs of the ladder estimate one number; their spread is the observed uncertainty of the middle one. The true error is
 * of the size of the spread; ten times that leaves room for three unlucky draws that lie close together. */
static const double SPREAD_FACTOR = 10;

/* VALUE_ROUNDINGS does not count the roundings inside an energy whose terms cancel; a smaller step contradicts a larger one only beyond
 * this many times its bound. */
static const double CONTRADICTION = 10;

/* Rounding the positions by one unit changes a gradient by |H| |x| u, and the formulas use some ten operations on differences of positions.
 * */
static const double CONDITION_ROUNDINGS = 64;

/* The analytic Hessians carry the condition of their stencil (sliver triangles 1e3, near-parallel edges 1e3, squared in second
 * derivatives): 1e6 u relative to the largest entry. */
static const double HESSIAN_FLOOR = 1e-10;

/* A comparison whose tolerance is above this share of the largest entry could not see a wrong factor in a small term: it fails. The worst
 * legal case is a gap of 1e-9 of the thickness, where d^2 - xi^2 has lost nine digits (energies.md, "Rounding"). */
static const double DECISIVE = 1e-2;

/* Where the gradient is nothing but the rounding of positions, as at rest, the tolerance need not be below ten times that rounding. */
static const double SHARP = 10;

/* Sums of a dozen products of one size, in the worst-conditioned stencils (needle triangles, edges near parallel: factor 1e3). */
static const double SUM_ROUNDINGS = 1e5;

typedef struct subject {
    const cipc_energy *energy;
    const double *x;
    const void *params;
    verify_derivative_report *report;
    int n;
    double g[MAX_N], H[MAX_N * MAX_N];
    double g_max, H_max, x_max, extent; /* largest entries; size of the stencil */
} subject;

static bool fail(const subject *s, const char *format, ...)
{
    if (s->report->failure[0] == '\0') {
        va_list arguments;
        int branch = s->energy->branch(s->x, s->params);
        const char *name = branch >= 0 && branch < s->energy->branch_count ? s->energy->branch_names[branch] : "?";
        int used = snprintf(s->report->failure, sizeof s->report->failure, "%s, branch %s: ", s->energy->name, name);
        va_start(arguments, format);
        (void)vsnprintf(s->report->failure + used, sizeof s->report->failure - (size_t)used, format, arguments);
        va_end(arguments);
    }
    return false;
}

static double largest(const double *values, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(values[i]));
    return most;
}

static bool all_finite(const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) return false;
    }
    return true;
}

/* Value (width 1) or gradient (width n) at a displaced configuration; false where the energy is infeasible. */
static bool evaluate(const subject *s, const double *x, int width, double *f)
{
    double value = s->energy->value(x, s->params);
    if (!isfinite(value)) return false;
    if (width == 1)
        f[0] = value;
    else
        s->energy->gradient(x, s->params, f);
    return all_finite(f, width);
}

/* One rung: derivative of f by coordinate j with step h, and a bound of the part of its error that comes from rounding. */
static bool difference(const subject *s, int j, double h, int width, double *derivative, double *rounding)
{
    double most = 0;
    memset(derivative, 0, sizeof(double) * (size_t)width);
    for (int m = 1; m <= 3; m++) {
        double ahead[MAX_N], behind[MAX_N], f[MAX_N], b[MAX_N];
        memcpy(ahead, s->x, sizeof(double) * (size_t)s->n);
        memcpy(behind, s->x, sizeof(double) * (size_t)s->n);
        ahead[j] += m * h;
        behind[j] -= m * h;
        if (!evaluate(s, ahead, width, f) || !evaluate(s, behind, width, b)) return false;
        for (int i = 0; i < width; i++) derivative[i] += STENCIL[m - 1] * (f[i] - b[i]) / (ahead[j] - behind[j]);
        most = fmax(most, fmax(largest(f, width), largest(b, width)));
    }
    double slope = width == 1 ? s->g_max : s->H_max;
    *rounding = VALUE_ROUNDINGS * ROUNDING * (most + slope * s->x_max) / h;
    return true;
}

/* One coordinate's ladder of estimates, from large steps to small. */
typedef struct ladder {
    int width;
    bool feasible[RUNGS];
    double derivative[RUNGS][MAX_N], rounding[RUNGS];
} ladder;

static void climb(const subject *s, int j, int width, ladder *l)
{
    double h = 0.25 * s->extent;
    l->width = width;
    for (int k = 0; k < RUNGS; k++, h *= 0.25) l->feasible[k] = difference(s, j, h, width, l->derivative[k], &l->rounding[k]);
}

/* Largest difference among the estimates of a rung and its two neighbours. */
static double spread(const ladder *l, int k)
{
    double most = 0;
    for (int i = 0; i < l->width; i++) {
        double a = l->derivative[k - 1][i], b = l->derivative[k][i], c = l->derivative[k + 1][i];
        most = fmax(most, fmax(a, fmax(b, c)) - fmin(a, fmin(b, c)));
    }
    return most;
}

/* Does a smaller step disagree with rung k by far more than its own rounding? Then rung k sits on the plateau of another branch: a barrier
 * whose steps all end outside its support has the perfect plateau 0. */
static bool contradicted(const ladder *l, int k, double tolerance)
{
    for (int m = k + 1; m < RUNGS; m++) {
        for (int i = 0; i < l->width; i++) {
            if (l->feasible[m] && fabs(l->derivative[m][i] - l->derivative[k][i]) > tolerance + CONTRADICTION * l->rounding[m]) return true;
        }
    }
    return false;
}

/* The estimate that agrees best with its neighbours, counting rounding against small steps; *tolerance is what it is good for. False if
 * three neighbouring steps are nowhere feasible. */
static bool plateau(const subject *s, int j, int width, double *derivative, double *tolerance)
{
    ladder l;
    climb(s, j, width, &l);
    *tolerance = INFINITY;
    for (int k = 1; k < RUNGS - 1; k++) {
        if (!l.feasible[k - 1] || !l.feasible[k] || !l.feasible[k + 1]) continue;
        double good_for = SPREAD_FACTOR * spread(&l, k) + l.rounding[k];
        if (good_for >= *tolerance || contradicted(&l, k, good_for)) continue;
        *tolerance = good_for;
        memcpy(derivative, l.derivative[k], sizeof(double) * (size_t)width);
    }
    return *tolerance < INFINITY;
}

/* Record relative figures of a comparison that passed or failed. */
static void record(double error, double tolerance, double reference, double *worst_error, double *worst_tolerance)
{
    if (!(reference > 0)) return;
    *worst_error = fmax(*worst_error, error / reference);
    *worst_tolerance = fmax(*worst_tolerance, tolerance / reference);
}

static bool check_gradient(subject *s)
{
    /* What the gradient itself is good for. */
    double condition = CONDITION_ROUNDINGS * ROUNDING * (s->H_max * s->x_max + s->g_max);
    for (int j = 0; j < s->n; j++) {
        double derivative, tolerance;
        if (!plateau(s, j, 1, &derivative, &tolerance)) return fail(s, "no feasible differences of the value along coordinate %d", j);
        double error = fabs(s->g[j] - derivative);
        tolerance += condition;
        if (condition < DECISIVE * s->g_max) record(error, tolerance, s->g_max, &s->report->gradient_error, &s->report->gradient_tolerance);
        if (!(error <= tolerance))
            return fail(s, "gradient[%d] = %.17g, differences give %.17g +- %.3g", j, s->g[j], derivative, tolerance);
        if (!(tolerance <= fmax(DECISIVE * s->g_max, SHARP * condition))) {
            return fail(s, "gradient[%d]: differences not decisive, %.3g of %.3g", j, tolerance, s->g_max);
        }
    }
    return true;
}

static bool check_hessian(subject *s)
{
    double reference = fmax(s->H_max, s->g_max / s->extent);
    for (int j = 0; j < s->n; j++) {
        double column[MAX_N], tolerance;
        if (!plateau(s, j, s->n, column, &tolerance)) return fail(s, "no feasible differences of the gradient along coordinate %d", j);
        tolerance += HESSIAN_FLOOR * s->H_max;
        if (!(tolerance <= DECISIVE * reference))
            return fail(s, "Hessian column %d: differences not decisive, %.3g of %.3g", j, tolerance, reference);
        for (int i = 0; i < s->n; i++) {
            double entry = s->H[i * s->n + j], error = fabs(entry - column[i]);
            record(error, tolerance, reference, &s->report->hessian_error, &s->report->hessian_tolerance);
            if (!(error <= tolerance))
                return fail(s, "Hessian[%d][%d] = %.17g, differences give %.17g +- %.3g", i, j, entry, column[i], tolerance);
        }
    }
    return true;
}

static bool check_symmetry(const subject *s)
{
    for (int i = 0; i < s->n; i++) {
        for (int j = 0; j < i; j++) {
            double a = s->H[i * s->n + j], b = s->H[j * s->n + i];
            if (!(fabs(a - b) <= CONDITION_ROUNDINGS * ROUNDING * s->H_max))
                return fail(s, "Hessian[%d][%d] = %.17g is not [%d][%d] = %.17g", i, j, a, j, i, b);
        }
    }
    return true;
}

/* No net force; H times a common translation is zero. */
static bool check_translation(const subject *s)
{
    double scale = SUM_ROUNDINGS * ROUNDING * s->g_max + CONDITION_ROUNDINGS * ROUNDING * s->H_max * s->extent;
    for (int k = 0; k < 3; k++) {
        double force = 0;
        for (int i = k; i < s->n; i += 3) force += s->g[i];
        if (!(fabs(force) <= scale)) return fail(s, "net force %.3g, largest gradient %.3g", force, s->g_max);
        for (int i = 0; i < s->n; i++) {
            double row = 0;
            for (int j = k; j < s->n; j += 3) row += s->H[i * s->n + j];
            if (!(fabs(row) <= SUM_ROUNDINGS * ROUNDING * s->H_max))
                return fail(s, "Hessian row %d: translation gives %.3g, largest entry %.3g", i, row, s->H_max);
        }
    }
    return true;
}

/* v -> axis x v for the coordinate axis `axis`. */
static void turn(int axis, const double *v, double *turned)
{
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    turned[axis] = 0;
    turned[a] = -v[b];
    turned[b] = v[a];
}

/* No net torque, and the gradient turns with the stencil: H (axis x x) = axis x g. */
static bool check_rotation(const subject *s)
{
    double moment = s->H_max * s->x_max + s->g_max;
    double force = SUM_ROUNDINGS * ROUNDING * s->g_max + CONDITION_ROUNDINGS * ROUNDING * s->H_max * s->extent;
    for (int axis = 0; axis < 3; axis++) {
        double velocity[MAX_N], turned[MAX_N], torque = 0;
        for (int i = 0; i < s->n; i += 3) {
            turn(axis, s->x + i, velocity + i);
            turn(axis, s->g + i, turned + i);
        }
        for (int i = 0; i < s->n; i++) torque += velocity[i] * s->g[i];
        if (!(fabs(torque) <= force * s->x_max)) return fail(s, "net torque %.3g, gradient %.3g", torque, s->g_max);
        for (int i = 0; i < s->n; i++) {
            double row = -turned[i];
            for (int j = 0; j < s->n; j++) row += s->H[i * s->n + j] * velocity[j];
            if (!(fabs(row) <= SUM_ROUNDINGS * ROUNDING * moment))
                return fail(s, "Hessian row %d: rotation gives %.3g, scale %.3g", i, row, moment);
        }
    }
    return true;
}

bool verify_derivatives_at(const cipc_energy *energy, const double *x, const void *params, verify_derivative_report *report)
{
    subject s = {.energy = energy, .x = x, .params = params, .report = report, .n = 3 * energy->nodes};
    double low[3] = {x[0], x[1], x[2]}, high[3] = {x[0], x[1], x[2]};
    double value = energy->value(x, params);
    energy->gradient(x, params, s.g);
    energy->hessian(x, params, s.H);
    s.g_max = largest(s.g, s.n);
    s.H_max = largest(s.H, s.n * s.n);
    s.x_max = largest(x, s.n);
    for (int i = 0; i < s.n; i++) {
        low[i % 3] = fmin(low[i % 3], x[i]);
        high[i % 3] = fmax(high[i % 3], x[i]);
        s.extent = fmax(s.extent, high[i % 3] - low[i % 3]);
    }
    if (energy->nodes == 1) s.extent = s.x_max;
    report->samples++;
    if (!isfinite(value) || !all_finite(s.g, s.n) || !all_finite(s.H, s.n * s.n))
        return fail(&s, "value, gradient or Hessian is not finite");
    bool good = check_gradient(&s) && check_hessian(&s) && check_symmetry(&s);
    if (good && (energy->invariances & CIPC_INVARIANT_TRANSLATION)) good = check_translation(&s);
    if (good && (energy->invariances & CIPC_INVARIANT_ROTATION)) good = check_rotation(&s);
    return good;
}

static bool check_samples(const cipc_energy *energy, gsl_rng *rng, int samples, verify_derivative_report *report)
{
    union {
        double align;
        unsigned char bytes[MAX_PARAMS];
    } params;
    double x[MAX_N];
    for (int branch = 0; branch < energy->branch_count; branch++) {
        for (int k = 0; k < samples; k++) {
            memset(&params, 0, sizeof params);
            energy->sample(rng, branch, x, &params);
            int reached = energy->branch(x, &params);
            if (reached < 0 || reached >= energy->branch_count) {
                (void)snprintf(report->failure, sizeof report->failure, "%s: branch %d does not exist", energy->name, reached);
                return false;
            }
            report->branch_counts[reached]++;
            if (!verify_derivatives_at(energy, x, &params, report)) return false;
        }
    }
    return true;
}

bool verify_derivatives_of(const cipc_energy *energy, unsigned long seed, int samples, int minimum, verify_derivative_report *report)
{
    memset(report, 0, sizeof *report);
    gsl_rng *rng =
        energy->branch_count <= VERIFY_DERIVATIVE_BRANCHES && energy->params_size <= MAX_PARAMS ? gsl_rng_alloc(gsl_rng_mt19937) : NULL;
    if (rng == NULL) {
        (void)snprintf(report->failure, sizeof report->failure, "%s: no random numbers, or too many branches or parameters", energy->name);
        return false;
    }
    gsl_rng_set(rng, seed);
    bool good = check_samples(energy, rng, samples, report);
    gsl_rng_free(rng);
    for (int branch = 0; good && branch < energy->branch_count; branch++) {
        if (report->branch_counts[branch] >= minimum) continue;
        (void)snprintf(report->failure, sizeof report->failure, "%s: branch %s reached %d times, wanted %d", energy->name,
                       energy->branch_names[branch], report->branch_counts[branch], minimum);
        good = false;
    }
    return good;
}
