/* Limits of elements, and steps that keep them all along (docs/theory/time_step.md, section 7a). */
#include "implicit/element_limits.h"

#include <math.h>
#include <stddef.h>

#include "base/vector.h"
#include "cipc/energy.h"

/* A stretch is computed with a relative error below 2^-46 (a dozen operations on well-scaled 2x2 and 3x2 products): staying below the limit by that
 * much keeps the exact stretch below it, which is what the monitor asserts. */
static const double margin = 0x1p-46;
/* Bounds of speed are sums and products of some ten roundings, and leave out how the margin itself changes, 2^-45 of them: this much more covers both. */
static const double speed_reserve = 1 + 0x1p-40;
/* A path is followed until this much of the slack at its start is left, each time by this much of what the speed allows. */
static const double slack_left = 0.1, part_of_bound = 0.9;
/* Halvings of the interval for a concave slack: the step is then known to 2^-20 of itself. Advances of the others: each leaves a tenth of what was left before unless the bound is loose. */
enum { BISECTIONS = 20, ADVANCES = 200 };

static double upper_slack(const void *params, const double *y)
{
    const cipc_strain_limit *p = params;
    double sigma[2];
    cipc_principal_stretches(y, p->inverse_rest, sigma);
    return p->limit * (1 - margin) - sigma[0];
}

static double lower_slack(const void *params, const double *y)
{
    const cipc_strain_limit *p = params;
    double sigma[2];
    cipc_principal_stretches(y, p->inverse_rest, sigma);
    return sigma[1] - p->limit * (1 + margin);
}

/* A singular value changes by no more than the matrix does: by |dF|, dF = [d1 - d0, d2 - d0] B^-1. */
static double lower_speed(const void *params, const double *y, const double *d)
{
    const double *b = ((const cipc_strain_limit *)params)->inverse_rest;
    double sum = 0;
    (void)y;
    for (int k = 0; k < 3; k++) {
        double e1 = d[3 + k] - d[k], e2 = d[6 + k] - d[k], f1 = b[0] * e1, f2 = b[1] * e1 + b[2] * e2;
        sum += f1 * f1 + f2 * f2;
    }
    return sqrt(sum);
}

/* Present images of warp and weft. */
static void directions(const cipc_orthotropic *p, const double *y, double f[2][3])
{
    for (int k = 0; k < 3; k++) {
        double a = y[3 + k] - y[k], b = y[6 + k] - y[k];
        f[0][k] = p->warp[0] * a + p->warp[1] * b;
        f[1][k] = p->weft[0] * a + p->weft[1] * b;
    }
}

/* A Green strain has an error of some u of what it is a difference of, 1 + 2 |E|, not of itself. */
static double strain_slack(double strain, double limit) { return limit - fabs(strain) - margin * (1 + 2 * fabs(strain)); }

static double strains_slack(const void *params, const double *y)
{
    const cipc_orthotropic *p = params;
    double f[2][3];
    directions(p, y, f);
    double warp = strain_slack(0.5 * (v3_norm2(f[0]) - 1), p->limit11), weft = strain_slack(0.5 * (v3_norm2(f[1]) - 1), p->limit22);
    return fmin(fmin(warp, weft), strain_slack(0.5 * (v3_dot(f[0], f[1]) - p->rest_cosine), p->limit12));
}

/* dE11 = f1.df1 and so on; |f| is largest at an end of the path. */
static double strains_speed(const void *params, const double *y, const double *d)
{
    double f[2][3], df[2][3], size[2], change[2];
    directions(params, y, f);
    directions(params, d, df);
    for (int i = 0; i < 2; i++) {
        double end[3];
        v3_add(end, f[i], df[i]);
        size[i] = fmax(v3_norm(f[i]), v3_norm(end));
        change[i] = v3_norm(df[i]);
    }
    double shear = 0.5 * (size[0] * change[1] + size[1] * change[0]);
    return fmax(fmax(size[0] * change[0], size[1] * change[1]), shear);
}

static void edges_of(const double *y, double e[3][3])
{
    for (int i = 0; i < 3; i++) v3_sub(e[i], y + 3 + 3 * i, y);
}

/* Six times the volume, less what rounding may hide: the product of the edges' lengths. */
static double volume_slack(const void *params, const double *y)
{
    double e[3][3], n[3];
    (void)params;
    edges_of(y, e);
    v3_cross(n, e[0], e[1]);
    return v3_dot(n, e[2]) - margin * v3_norm(e[0]) * v3_norm(e[1]) * v3_norm(e[2]);
}

/* A determinant changes by at most |de0||e1||e2| + ...; an edge is longest at an end of the path. */
static double volume_speed(const void *params, const double *y, const double *d)
{
    double e[3][3], de[3][3], size[3], change[3];
    (void)params;
    edges_of(y, e);
    edges_of(d, de);
    for (int i = 0; i < 3; i++) {
        double end[3];
        v3_add(end, e[i], de[i]);
        size[i] = fmax(v3_norm(e[i]), v3_norm(end));
        change[i] = v3_norm(de[i]);
    }
    return change[0] * size[1] * size[2] + size[0] * change[1] * size[2] + size[0] * size[1] * change[2];
}

/* sigma_1 is a norm of F: convex. */
const element_limit implicit_limit_upper = {upper_slack, NULL};
const element_limit implicit_limit_lower = {lower_slack, lower_speed};
const element_limit implicit_limit_strains = {strains_slack, strains_speed};
const element_limit implicit_limit_volume = {volume_slack, volume_speed};

static double slack_at(const element_limit *limit, const void *params, int nodes, const double *y, const double *d, double t)
{
    double z[12];
    for (int i = 0; i < 3 * nodes; i++) z[i] = y[i] + t * d[i];
    return limit->slack(params, z);
}

static double bisect(const element_limit *limit, const void *params, int nodes, const double *y, const double *d, double step)
{
    double low = 0, high = step;
    if (slack_at(limit, params, nodes, y, d, step) > 0) return step;
    for (int k = 0; k < BISECTIONS; k++) {
        double middle = 0.5 * (low + high);
        if (slack_at(limit, params, nodes, y, d, middle) > 0) low = middle;
        else high = middle;
    }
    return low;
}

/* Conservative advancement: nothing can happen before t + slack/speed. */
static double advance(const element_limit *limit, const void *params, int nodes, const double *y, const double *d, double step)
{
    double first = limit->slack(params, y), slack = first, speed = limit->speed(params, y, d) * speed_reserve, t = 0;
    if (!(first > 0)) return 0;
    for (int k = 0; k < ADVANCES && slack > slack_left * first; k++) {
        if (speed * (step - t) < slack) return step;
        t += part_of_bound * slack / speed;
        slack = slack_at(limit, params, nodes, y, d, t);
    }
    return t;
}

double implicit_limit_step(const element_limit *limit, const void *params, int nodes, const double *y, const double *d, double step)
{
    return limit->speed ? advance(limit, params, nodes, y, d, step) : bisect(limit, params, nodes, y, d, step);
}
