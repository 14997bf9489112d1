/* The baseline with thickness (docs/theory/minimum_separation_ccd.md): the first time at which the two primitives are a minimum separation apart, as a root of the
 * polynomials of their features found in floating point, inside the conservative strategy of the IPC codes. No certificate: it is here to be compared with. */
#include "cipc/contact.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "contact/real_roots.h"
#include "contact/stencil.h"

/* Slack of a feature's own parameters at a root: what implementations of this kind use. */
static const double INSIDE = 1e-6;
/* A step below this share of the path makes the strategy ask again without a separation beyond the thickness. */
static const double SMALL_STEP = 1e-6;

/* --- polynomials in time, c[0] + c[1] t + ...; vectors of them, c[k] a vector --- */

static void multiply(const double *a, int da, const double *b, int db, double *product)
{
    memset(product, 0, (size_t)(da + db + 1) * sizeof *product);
    for (int i = 0; i <= da; i++)
        for (int j = 0; j <= db; j++) product[i + j] += a[i] * b[j];
}

typedef struct moving_vector {
    int degree;
    double c[3][3]; /* c[axis][power] */
} moving_vector;

/* z_b - z_a of two nodes in straight motion. */
static moving_vector difference(const double *x, const double *p, int a, int b)
{
    moving_vector v = {.degree = 1};
    for (int k = 0; k < 3; k++) {
        v.c[k][0] = x[3 * b + k] - x[3 * a + k];
        v.c[k][1] = p[3 * b + k] - p[3 * a + k];
    }
    return v;
}

/* (1) of two linear vectors: quadratic. */
static moving_vector cross(const moving_vector *a, const moving_vector *b)
{
    moving_vector v = {.degree = 2};
    for (int k = 0; k < 3; k++) {
        double plus[3], minus[3];
        multiply(a->c[(k + 1) % 3], 1, b->c[(k + 2) % 3], 1, plus);
        multiply(a->c[(k + 2) % 3], 1, b->c[(k + 1) % 3], 1, minus);
        for (int i = 0; i <= 2; i++) v.c[k][i] = plus[i] - minus[i];
    }
    return v;
}

/* a.b, of degree a->degree + b->degree. */
static void dot(const moving_vector *a, const moving_vector *b, double *sum)
{
    int degree = a->degree + b->degree;
    memset(sum, 0, (size_t)(degree + 1) * sizeof *sum);
    for (int k = 0; k < 3; k++) {
        double part[5];
        multiply(a->c[k], a->degree, b->c[k], b->degree, part);
        for (int i = 0; i <= degree; i++) sum[i] += part[i];
    }
}

/* --- (2): zero where the flats of a feature are a distance m apart --- */

/* f - m^2 g */
static void less_scaled(double *f, double m, const double *g, int degree)
{
    for (int i = 0; i <= degree; i++) f[i] -= m * m * g[i];
}

static int point_line(const double *x, const double *p, const int *n, double m, double c[7])
{
    moving_vector u = difference(x, p, n[1], n[0]), e = difference(x, p, n[1], n[2]), area = cross(&u, &e);
    double length2[3];
    dot(&area, &area, c);
    dot(&e, &e, length2);
    less_scaled(c, m, length2, 2);
    return 4;
}

/* Point and plane, or two lines: u.n against m |n|; without separation the cubic u.n itself, because a square does not change its sign. */
static int across_normal(const moving_vector *u, const moving_vector *a, const moving_vector *b, double m, double c[7])
{
    moving_vector n = cross(a, b);
    double height[4], normal2[5];
    dot(u, &n, height);
    if (m == 0) {
        memcpy(c, height, sizeof height);
        return 3;
    }
    multiply(height, 3, height, 3, c);
    dot(&n, &n, normal2);
    less_scaled(c, m, normal2, 4);
    return 6;
}

static int feature_polynomial(const cipc_feature *f, const double *x, const double *p, double m, double c[7])
{
    const int *n = f->local;
    moving_vector u = difference(x, p, n[f->kind == CIPC_EDGE_EDGE ? 2 : 1], n[0]), a, b;
    switch (f->kind) {
    case CIPC_POINT_POINT:
        dot(&u, &u, c);
        c[0] -= m * m;
        return 2;
    case CIPC_POINT_EDGE: return point_line(x, p, n, m, c);
    case CIPC_POINT_TRIANGLE:
        a = difference(x, p, n[1], n[2]);
        b = difference(x, p, n[1], n[3]);
        return across_normal(&u, &a, &b, m, c);
    default:
        a = difference(x, p, n[0], n[1]);
        b = difference(x, p, n[2], n[3]);
        return across_normal(&u, &a, &b, m, c);
    }
}

/* (3) At time t, do the closest points of the feature's flats lie in the feature? NaN, of parallel edges or a flat triangle, is no. */
static bool lies_inside(const cipc_feature *f, const double *x, const double *p, double t)
{
    double z[12], w[4];
    int first = cipc_pair_first_nodes(f->kind);
    for (int i = 0; i < f->count; i++)
        for (int k = 0; k < 3; k++) z[3 * i + k] = x[3 * f->local[i] + k] + t * p[3 * f->local[i] + k];
    cipc_closest_weights(f->kind, z, w);
    bool inside = true;
    for (int i = 0; i < f->count; i++) inside = inside && (i < first ? w[i] : -w[i]) >= -INSIDE;
    return inside;
}

/* The first time in (0, t_max] at which some feature pair is m apart; INFINITY: none is found. */
static double first_separation(cipc_pair_kind kind, const double *x, const double *p, double m, double t_max)
{
    double first = INFINITY;
    for (int i = 0; i < cipc_feature_count(kind); i++) {
        cipc_feature f = cipc_feature_at(kind, i);
        double c[7], roots[CONTACT_POLYNOMIAL_DEGREE];
        int degree = feature_polynomial(&f, x, p, m, c);
        int count = contact_real_roots(c, degree, min2(t_max, first), roots);
        for (int r = 0; r < count; r++) {
            if (roots[r] >= first || !lies_inside(&f, x, p, roots[r])) continue;
            first = roots[r];
            break;
        }
    }
    return first;
}

static cipc_ccd_result stop_at(double toi, cipc_ccd_outcome outcome, int passes)
{
    return (cipc_ccd_result){.toi = toi, .hit = outcome != CIPC_CCD_FREE, .outcome = outcome, .iterations = passes, .precision = 53};
}

cipc_ccd_result cipc_minimum_separation_ccd(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    double x[12] = {0}, p[12] = {0}, s = options->slackness;
    for (int i = 0; i < 3 * cipc_pair_nodes(path->kind); i++) {
        x[i] = path->x[i];
        p[i] = path->to_end ? path->p[i] - path->x[i] : path->p[i];
    }
    double gap = sqrt(cipc_stencil_distance2(path->kind, x)) - xi;
    if (!(gap > 0)) return stop_at(0, CIPC_CCD_INITIALLY_CLOSE, 0);
    double t = first_separation(path->kind, x, p, xi + s * gap, t_max); /* (4) */
    if (t == INFINITY) return stop_at(t_max, CIPC_CCD_FREE, 1);
    if (t >= SMALL_STEP) return stop_at(t, CIPC_CCD_HIT, 1);
    t = first_separation(path->kind, x, p, xi, t_max); /* (5) */
    return t == INFINITY ? stop_at(t_max, CIPC_CCD_FREE, 2) : stop_at((1 - s) * t, CIPC_CCD_HIT, 2);
}
