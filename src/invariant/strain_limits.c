/* The limits of a triangle's strain, one by one (SPEC C.2, C.3).
 *
 * With first fundamental forms Ibar (rest) and I (now):  sigma_1 < s  <=>  M = s^2 Ibar - I positive definite  <=>  M11 > 0 and det M > 0;
 * sigma_2 > s if -M is. A Green strain is 1/2 (f.g - d.k) for directions d, k of unit length that have become f, g. All are evaluated in
 * double with an error bound (docs/monitors.md, "The strain bounds"). */
#include "invariant/strain_limits.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/oracle.h"

#define UNIT (0.5 * DBL_EPSILON)
/* With Q = s^2 tr Ibar + tr I, every entry of M is off by at most 9 u Q, hence det M by at most 43 u Q^2; rounded up to cover the bounds'
 * own rounding. */
#define ENTRY_ERROR       (10 * UNIT)
#define DETERMINANT_ERROR (48 * UNIT)
/* Outside of these, underflow or overflow could spoil the bounds: nothing is proven then. */
#define SMALLEST_TRACE 0x1p-400
#define LARGEST_TRACE  0x1p400
/* A Green strain is off by at most 7 u (1 + sum of the products' magnitudes); rounded up for the comparison's own rounding. */
#define GREEN_ERROR (9 * UNIT)
/* An axis below this may have lost digits to underflow: then the triangle goes to exact arithmetic. */
#define SMALLEST_AXIS 0x1p-900

/* form = |e1|^2, e1.e2, |e2|^2. */
static void fundamental_form(double form[3], const cipc_strain_edges *e)
{
    form[0] = v3_norm2(e->e1);
    form[1] = v3_dot(e->e1, e->e2);
    form[2] = v3_norm2(e->e2);
}

cipc_strain_edges cipc_strain_edges_of(const double *x, const int nodes[3])
{
    cipc_strain_edges e;
    v3_sub(e.e1, &x[3 * (size_t)nodes[1]], &x[3 * (size_t)nodes[0]]);
    v3_sub(e.e2, &x[3 * (size_t)nodes[2]], &x[3 * (size_t)nodes[0]]);
    return e;
}

static void gather(double stencil[9], const double *x, const int nodes[3])
{
    for (int i = 0; i < 3; i++) { v3_copy(&stencil[3 * i], &x[3 * (size_t)nodes[i]]); }
}

/* --- at rest --- */

/* Inverse of [E1 E2] = [l a; 0 b] in the frame whose first axis is along E1; all zero for a triangle without area. */
static void invert_rest(double inverse[4], const cipc_strain_edges *e)
{
    double normal[3], l = v3_norm(e->e1);
    v3_cross(normal, e->e1, e->e2);
    double a = v3_dot(e->e1, e->e2) / l, b = v3_norm(normal) / l;
    bool has_area = l > 0 && b > 0;
    inverse[0] = has_area ? 1 / l : 0;
    inverse[1] = has_area ? -a / (l * b) : 0;
    inverse[2] = 0;
    inverse[3] = has_area ? 1 / b : 0;
}

/* Warp and weft in the edges at rest, or NaN: what is computed from that proves nothing. */
static void set_axes(cipc_strain_rest *rest, const cipc_orthotropic_material *fabric, const double stencil[9])
{
    bool good = cipc_exact_fabric_axes(stencil, fabric->warp, fabric->weft, rest->axes, &rest->cosine);
    for (int i = 0; i < 4; i++) { good = good && (rest->axes[i] == 0 || fabs(rest->axes[i]) > SMALLEST_AXIS); }
    for (int i = 0; i < 4 && !good; i++) { rest->axes[i] = NAN; }
}

void cipc_strain_rest_init(cipc_strain_rest *rest, const cipc_model *model, int triangle)
{
    const cipc_body *body = &model->bodies[model->triangle_body[triangle]];
    const cipc_material *material = &body->material;
    double stencil[9];
    memset(rest, 0, sizeof *rest);
    if (body->kind != CIPC_BODY_SHELL) { return; } /* the surface of a volume is no membrane */
    cipc_strain_edges e = cipc_strain_edges_of(model->rest, model->triangles[triangle]);
    fundamental_form(rest->form, &e);
    invert_rest(rest->inverse, &e);
    rest->limits[CIPC_STRAIN_LARGEST] = material->strain_limit;
    rest->limits[CIPC_STRAIN_LEAST] = material->strain_lower_limit;
    rest->measured = material->membrane != CIPC_MEMBRANE_NONE || material->strain_limit > 0 || material->strain_lower_limit > 0;
    if (material->membrane != CIPC_MEMBRANE_ORTHOTROPIC) { return; }
    for (int i = 0; i < 3; i++) { rest->limits[CIPC_STRAIN_WARP + i] = material->orthotropic.limits[i]; }
    gather(stencil, model->rest, model->triangles[triangle]);
    set_axes(rest, &material->orthotropic, stencil);
}

/* --- in double arithmetic --- */

/* The value of a principal stretch. F = [e1 e2] B, B the inverse at rest; sigma_1^2 is the larger eigenvalue of F^T F, and sigma_1 sigma_2
 * the area of the columns of F. */
static double principal_stretch(const cipc_strain_rest *rest, const cipc_strain_edges *e, bool least)
{
    double f1[3], f2[3], normal[3];
    v3_scale(f1, rest->inverse[0], e->e1);
    for (int k = 0; k < 3; k++) { f2[k] = rest->inverse[1] * e->e1[k] + rest->inverse[3] * e->e2[k]; }
    double c11 = v3_norm2(f1), c12 = v3_dot(f1, f2), c22 = v3_norm2(f2);
    double half = 0.5 * (c11 - c22);
    double largest = sqrt(0.5 * (c11 + c22) + sqrt(half * half + c12 * c12));
    if (!least) { return largest; }
    v3_cross(normal, f1, f2);
    return largest > 0 ? v3_norm(normal) / largest : 0;
}

/* A Green strain and the sum of the magnitudes that cancel in it. */
typedef struct green_strain {
    double value, size;
} green_strain;

static green_strain green_strain_of(const cipc_strain_rest *rest, cipc_strain_kind kind, const cipc_strain_edges *e)
{
    const double *c = kind == CIPC_STRAIN_WEFT ? &rest->axes[2] : rest->axes, *k = kind == CIPC_STRAIN_WARP ? rest->axes : &rest->axes[2];
    double product = 0, size = 1, at_rest = kind == CIPC_STRAIN_SHEAR ? rest->cosine : 1;
    for (int i = 0; i < 3; i++) {
        product += (c[0] * e->e1[i] + c[1] * e->e2[i]) * (k[0] * e->e1[i] + k[1] * e->e2[i]);
        size += (fabs(c[0] * e->e1[i]) + fabs(c[1] * e->e2[i])) * (fabs(k[0] * e->e1[i]) + fabs(k[1] * e->e2[i]));
    }
    return (green_strain){0.5 * (product - at_rest), size};
}

double cipc_strain_value(const cipc_strain_rest *rest, cipc_strain_kind kind, const cipc_strain_edges *edges)
{
    if (kind <= CIPC_STRAIN_LEAST) { return principal_stretch(rest, edges, kind == CIPC_STRAIN_LEAST); }
    return fabs(green_strain_of(rest, kind, edges).value);
}

/* Is M, or -M, proven to be positive definite? */
static bool is_definite(const cipc_strain_rest *rest, double limit, double sign, const cipc_strain_edges *edges)
{
    double form[3], s2 = limit * limit;
    fundamental_form(form, edges);
    double m11 = sign * (s2 * rest->form[0] - form[0]), m12 = s2 * rest->form[1] - form[1], m22 = sign * (s2 * rest->form[2] - form[2]);
    double trace = s2 * (rest->form[0] + rest->form[2]) + (form[0] + form[2]);
    bool in_range = trace > SMALLEST_TRACE && trace < LARGEST_TRACE;
    return in_range && m11 > ENTRY_ERROR * trace && m11 * m22 - m12 * m12 > DETERMINANT_ERROR * trace * trace;
}

bool cipc_strain_is_proven(const cipc_strain_rest *rest, cipc_strain_kind kind, const cipc_strain_edges *edges)
{
    double limit = rest->limits[kind];
    if (kind <= CIPC_STRAIN_LEAST) { return is_definite(rest, limit, kind == CIPC_STRAIN_LEAST ? -1 : 1, edges); }
    green_strain green = green_strain_of(rest, kind, edges);
    return fabs(green.value) + GREEN_ERROR * green.size < limit;
}

double cipc_strain_used(cipc_strain_kind kind, double value, double limit)
{
    if (kind == CIPC_STRAIN_LARGEST) { return (value - 1) / (limit - 1); }
    return kind == CIPC_STRAIN_LEAST ? (1 - value) / (1 - limit) : value / limit;
}

/* --- exactly --- */

int cipc_strain_compare(const cipc_model *m, int triangle, cipc_strain_kind kind, const double *x, double limit)
{
    const cipc_orthotropic_material *fabric = &m->bodies[m->triangle_body[triangle]].material.orthotropic;
    double rest[9], now[9];
    gather(rest, m->rest, m->triangles[triangle]);
    gather(now, x, m->triangles[triangle]);
    switch (kind) {
    case CIPC_STRAIN_LARGEST: return cipc_exact_compare_stretch(rest, now, limit);
    case CIPC_STRAIN_LEAST: return cipc_exact_compare_least_stretch(rest, now, limit);
    case CIPC_STRAIN_WARP: return cipc_exact_compare_green_strain(CIPC_GREEN_WARP, rest, now, fabric->warp, fabric->weft, limit);
    case CIPC_STRAIN_WEFT: return cipc_exact_compare_green_strain(CIPC_GREEN_WEFT, rest, now, fabric->warp, fabric->weft, limit);
    default: return cipc_exact_compare_green_strain(CIPC_GREEN_SHEAR, rest, now, fabric->warp, fabric->weft, limit);
    }
}

/* Positive doubles are in the order of their bits; for the least stretch, whose limits are kept downwards, in the opposite one. */
static uint64_t rank_of(cipc_strain_kind kind, double positive)
{
    static const double infinite = INFINITY;
    uint64_t rank, last;
    memcpy(&rank, &positive, sizeof rank);
    memcpy(&last, &infinite, sizeof last);
    return kind == CIPC_STRAIN_LEAST ? last - rank : rank;
}

static double of_rank(cipc_strain_kind kind, uint64_t rank)
{
    double value;
    uint64_t bits = kind == CIPC_STRAIN_LEAST ? rank_of(CIPC_STRAIN_LARGEST, INFINITY) - rank : rank;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Sought from the estimate in steps that double until the exact value lies between two doubles, then by halves. */
double cipc_strain_rounded(const cipc_model *m, int triangle, cipc_strain_kind kind, const double *x, double estimate)
{
    const uint64_t end = rank_of(CIPC_STRAIN_LARGEST, INFINITY);
    if (!(estimate > 0) || !isfinite(estimate)) { return estimate; }
    uint64_t above = rank_of(kind, estimate), below = above - 1, step = 1;
    for (; below > 0 && cipc_strain_compare(m, triangle, kind, x, of_rank(kind, below)) >= 0; step *= 2) {
        above = below;
        below = below > step ? below - step : 0;
    }
    for (; above < end && cipc_strain_compare(m, triangle, kind, x, of_rank(kind, above)) < 0; step *= 2) {
        below = above;
        above = end - above > step ? above + step : end;
    }
    if (above == end) { return kind == CIPC_STRAIN_LEAST ? 0 : estimate; }
    while (above - below > 1) {
        uint64_t middle = below + (above - below) / 2;
        if (cipc_strain_compare(m, triangle, kind, x, of_rank(kind, middle)) >= 0) {
            above = middle;
        } else {
            below = middle;
        }
    }
    return of_rank(kind, above);
}
