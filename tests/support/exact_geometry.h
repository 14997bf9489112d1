/* The slow twin of geometry/: distances as rationals (GMP), their exact minimum, and differences with steps of 2^-60.
 * Written from the definitions (SPEC D.1, V.2), sharing no arithmetic with the code under test. Header only. */
#ifndef SUPPORT_EXACT_GEOMETRY_H
#define SUPPORT_EXACT_GEOMETRY_H

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "cipc/geometry.h"

/* Unit roundoff, 2^-53. */
#define UNIT_ROUNDOFF (0.5 * DBL_EPSILON)

/* ---- Random numbers: splitmix64, seeded per test, the same everywhere. ---- */

static inline uint64_t random_bits(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* Uniform in [low, high). */
static inline double random_uniform(uint64_t *state, double low, double high)
{
    return low + (high - low) * (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* 0 .. count-1. */
static inline int random_below(uint64_t *state, int count)
{
    return (int)(random_bits(state) % (uint64_t)count);
}

static inline void random_fill(uint64_t *state, double *x, int n, double half_width)
{
    for (int i = 0; i < n; i++) x[i] = random_uniform(state, -half_width, half_width);
}

/* ---- Vectors of three rationals. ---- */

static inline void q_init(mpq_t *v, int n)
{
    for (int i = 0; i < n; i++) mpq_init(v[i]);
}

static inline void q_clear(mpq_t *v, int n)
{
    for (int i = 0; i < n; i++) mpq_clear(v[i]);
}

static inline void q_set(mpq_t *v, const double *x, int n)
{
    for (int i = 0; i < n; i++) mpq_set_d(v[i], x[i]);
}

static inline void q_sub(mpq_t *r, mpq_t *a, mpq_t *b)
{
    for (int i = 0; i < 3; i++) mpq_sub(r[i], a[i], b[i]);
}

/* r += s a. */
static inline void q_axpy(mpq_t *r, const mpq_t s, mpq_t *a)
{
    mpq_t term;
    mpq_init(term);
    for (int i = 0; i < 3; i++) {
        mpq_mul(term, s, a[i]);
        mpq_add(r[i], r[i], term);
    }
    mpq_clear(term);
}

static inline void q_dot(mpq_t r, mpq_t *a, mpq_t *b)
{
    mpq_t sum, term;
    mpq_inits(sum, term, NULL);
    for (int i = 0; i < 3; i++) {
        mpq_mul(term, a[i], b[i]);
        mpq_add(sum, sum, term);
    }
    mpq_set(r, sum);
    mpq_clears(sum, term, NULL);
}

/* r must not overlap a or b. */
static inline void q_cross(mpq_t *r, mpq_t *a, mpq_t *b)
{
    mpq_t term;
    mpq_init(term);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpq_mul(r[i], a[j], b[k]);
        mpq_mul(term, a[k], b[j]);
        mpq_sub(r[i], r[i], term);
    }
    mpq_clear(term);
}

static inline void q_keep_less(mpq_t best, const mpq_t candidate)
{
    if (mpq_cmp(candidate, best) < 0) mpq_set(best, candidate);
}

/* ---- Smooth squared distances of a kind (SPEC D.1). The stencil must not be degenerate. ---- */

static inline void exact_point_point(mpq_t out, mpq_t *p, mpq_t *q)
{
    mpq_t d[3];
    q_init(d, 3);
    q_sub(d, p, q);
    q_dot(out, d, d);
    q_clear(d, 3);
}

static inline void exact_point_line(mpq_t out, mpq_t *x)
{
    mpq_t u[3], e[3], m[3], e2;
    q_init(u, 3), q_init(e, 3), q_init(m, 3), mpq_init(e2);
    q_sub(u, x, x + 3);
    q_sub(e, x + 6, x + 3);
    q_cross(m, u, e);
    q_dot(out, m, m);
    q_dot(e2, e, e);
    mpq_div(out, out, e2);
    q_clear(u, 3), q_clear(e, 3), q_clear(m, 3), mpq_clear(e2);
}

/* ((u . n)^2 / |n|^2 with n = a x b. */
static inline void exact_along_normal(mpq_t out, mpq_t *u, mpq_t *a, mpq_t *b)
{
    mpq_t n[3], n2;
    q_init(n, 3), mpq_init(n2);
    q_cross(n, a, b);
    q_dot(n2, n, n);
    q_dot(out, u, n);
    mpq_mul(out, out, out);
    mpq_div(out, out, n2);
    q_clear(n, 3), mpq_clear(n2);
}

/* Point-plane (p; t1-t0, t2-t0) or line-line (a0-b0; a1-a0, b1-b0). */
static inline void exact_frame_edges(cipc_pair_kind kind, mpq_t *x, mpq_t *u, mpq_t *a, mpq_t *b)
{
    bool plane = kind == CIPC_POINT_TRIANGLE;
    q_sub(u, x, plane ? x + 3 : x + 6);
    q_sub(a, plane ? x + 6 : x + 3, plane ? x + 3 : x);
    q_sub(b, x + 9, plane ? x + 3 : x + 6);
}

static inline void exact_distance2(mpq_t out, mpq_t *x, const void *kind_pointer)
{
    cipc_pair_kind kind = *(const cipc_pair_kind *)kind_pointer;
    if (kind == CIPC_POINT_POINT) {
        exact_point_point(out, x, x + 3);
    } else if (kind == CIPC_POINT_EDGE) {
        exact_point_line(out, x);
    } else {
        mpq_t u[3], a[3], b[3];
        q_init(u, 3), q_init(a, 3), q_init(b, 3);
        exact_frame_edges(kind, x, u, a, b);
        exact_along_normal(out, u, a, b);
        q_clear(u, 3), q_clear(a, 3), q_clear(b, 3);
    }
}

/* ---- True minima over the primitives (SPEC V.2): every candidate is the distance to a point that lies on them. ---- */

static inline void exact_point_segment_minimum(mpq_t best, mpq_t *p, mpq_t *e0, mpq_t *e1)
{
    mpq_t u[3], e[3], t, e2;
    q_init(u, 3), q_init(e, 3), mpq_inits(t, e2, NULL);
    exact_point_point(best, p, e0);
    exact_point_point(t, p, e1);
    q_keep_less(best, t);
    q_sub(u, p, e0);
    q_sub(e, e1, e0);
    q_dot(t, u, e);
    q_dot(e2, e, e);
    if (mpq_sgn(t) > 0 && mpq_cmp(t, e2) < 0) {
        mpq_div(t, t, e2);
        mpq_neg(t, t);
        q_axpy(u, t, e);
        q_dot(t, u, u);
        q_keep_less(best, t);
    }
    q_clear(u, 3), q_clear(e, 3), mpq_clears(t, e2, NULL);
}

/* Coordinates of u in the frame a, b (the closest point of its plane): by Cramer on the normal equations. False if a x b = 0. */
static inline bool exact_plane_coordinates(mpq_t beta, mpq_t gamma, mpq_t *u, mpq_t *a, mpq_t *b)
{
    mpq_t aa, bb, ab, au, bu, determinant, term;
    mpq_inits(aa, bb, ab, au, bu, determinant, term, NULL);
    q_dot(aa, a, a), q_dot(bb, b, b), q_dot(ab, a, b), q_dot(au, a, u), q_dot(bu, b, u);
    mpq_mul(determinant, aa, bb);
    mpq_mul(term, ab, ab);
    mpq_sub(determinant, determinant, term);
    bool regular = mpq_sgn(determinant) != 0;
    if (regular) {
        mpq_mul(beta, au, bb), mpq_mul(term, bu, ab), mpq_sub(beta, beta, term), mpq_div(beta, beta, determinant);
        mpq_mul(gamma, bu, aa), mpq_mul(term, au, ab), mpq_sub(gamma, gamma, term), mpq_div(gamma, gamma, determinant);
    }
    mpq_clears(aa, bb, ab, au, bu, determinant, term, NULL);
    return regular;
}

static inline bool q_strictly_between_0_and_1(const mpq_t t)
{
    return mpq_sgn(t) > 0 && mpq_cmp_ui(t, 1, 1) < 0;
}

/* |u - beta a - gamma b|^2, if the foot is inside the primitives. */
static inline void exact_keep_interior(mpq_t best, cipc_pair_kind kind, mpq_t *x)
{
    mpq_t u[3], a[3], b[3], beta, gamma, third;
    q_init(u, 3), q_init(a, 3), q_init(b, 3), mpq_inits(beta, gamma, third, NULL);
    exact_frame_edges(kind, x, u, a, b);
    if (exact_plane_coordinates(beta, gamma, u, a, b)) {
        bool inside;
        mpq_neg(beta, beta), mpq_neg(gamma, gamma);
        q_axpy(u, beta, a), q_axpy(u, gamma, b);
        if (kind == CIPC_POINT_TRIANGLE) { /* barycentrics -beta, -gamma (after the change of sign) and 1 - those */
            mpq_add(third, beta, gamma);
            mpq_neg(third, third), mpq_neg(beta, beta), mpq_neg(gamma, gamma);
            inside = mpq_sgn(beta) > 0 && mpq_sgn(gamma) > 0 && mpq_cmp_ui(third, 1, 1) < 0;
        } else { /* parameters: s = -beta on the first edge, t = gamma on the second */
            mpq_neg(gamma, gamma);
            inside = q_strictly_between_0_and_1(beta) && q_strictly_between_0_and_1(gamma);
        }
        q_dot(third, u, u);
        if (inside) q_keep_less(best, third);
    }
    q_clear(u, 3), q_clear(a, 3), q_clear(b, 3), mpq_clears(beta, gamma, third, NULL);
}

/* Exact squared distance of the two primitives of a stencil. */
static inline void exact_minimum(mpq_t best, cipc_pair_kind kind, mpq_t *x)
{
    static const int plane_rows[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    static const int edge_rows[4][3] = {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
    if (kind == CIPC_POINT_POINT) {
        exact_point_point(best, x, x + 3);
        return;
    }
    if (kind == CIPC_POINT_EDGE) {
        exact_point_segment_minimum(best, x, x + 3, x + 6);
        return;
    }
    int count = kind == CIPC_POINT_TRIANGLE ? 3 : 4;
    mpq_t candidate;
    mpq_init(candidate);
    for (int i = 0; i < count; i++) {
        const int *row = kind == CIPC_POINT_TRIANGLE ? plane_rows[i] : edge_rows[i];
        exact_point_segment_minimum(candidate, x + 3 * row[0], x + 3 * row[1], x + 3 * row[2]);
        if (i == 0) mpq_set(best, candidate);
        q_keep_less(best, candidate);
    }
    mpq_clear(candidate);
    exact_keep_interior(best, kind, x);
}

/* The same as a double: sqrt of the exact squared distance, within two ulp. */
static inline double exact_true_distance(cipc_pair_kind kind, const double *x)
{
    static const int nodes[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4};
    mpq_t y[12], best;
    q_init(y, 12), mpq_init(best);
    q_set(y, x, 3 * nodes[kind]);
    exact_minimum(best, kind, y);
    double result = sqrt(mpq_get_d(best));
    q_clear(y, 12), mpq_clear(best);
    return result;
}

/* Distance that a reported feature stands for, exactly: its smooth formula. HUGE_VAL where that is undefined (a fault of the feature). */
static inline double exact_feature_distance(cipc_feature feature, const double *x)
{
    mpq_t y[12], value, zero_test[9];
    q_init(y, 12), q_init(zero_test, 9), mpq_init(value);
    for (int i = 0; i < feature.count; i++) q_set(y + 3 * i, x + 3 * feature.local[i], 3);
    double result = HUGE_VAL;
    bool defined = true;
    if (feature.kind == CIPC_POINT_EDGE) {
        exact_point_point(value, y + 3, y + 6);
        defined = mpq_sgn(value) != 0;
    } else if (feature.kind != CIPC_POINT_POINT) {
        exact_frame_edges(feature.kind, y, zero_test, zero_test + 3, zero_test + 6);
        q_cross(zero_test, zero_test + 3, zero_test + 6);
        q_dot(value, zero_test, zero_test);
        defined = mpq_sgn(value) != 0;
    }
    if (defined) {
        exact_distance2(value, y, &feature.kind);
        result = sqrt(mpq_get_d(value));
    }
    q_clear(y, 12), q_clear(zero_test, 9), mpq_clear(value);
    return result;
}

/* Largest coordinate difference of a stencil of n numbers: the length that rounding errors of distances are measured in. */
static inline double stencil_size(const double *x, int n)
{
    double size = 0.0;
    for (int i = 3; i < n; i++) size = fmax(size, fabs(x[i] - x[i % 3]));
    return size;
}

/* ---- Central differences in rational arithmetic: exact but for the truncation, a relative 2^-120 here. ---- */

typedef void (*exact_function)(mpq_t out, mpq_t *x, const void *context);

/* A power of two near size * 2^-60. */
static inline double difference_step(double size)
{
    int exponent;
    (void)frexp(size, &exponent);
    return ldexp(1.0, exponent - 60);
}

/* sum_k sign_k f(x + offset_k), over the corners +-i, +-j; for j < 0 the two points +-i. */
static inline void exact_difference(mpq_t sum, exact_function f, const void *context, mpq_t *x, int i, int j, double h)
{
    mpq_t step, two, value;
    mpq_inits(step, two, value, NULL);
    mpq_set_d(step, h);
    mpq_set_ui(sum, 0, 1);
    for (int corner = 0; corner < (j < 0 ? 2 : 4); corner++) {
        bool minus_i = corner & 1, minus_j = corner & 2;
        (minus_i ? mpq_sub : mpq_add)(x[i], x[i], step);
        if (j >= 0) (minus_j ? mpq_sub : mpq_add)(x[j], x[j], step);
        f(value, x, context);
        (minus_i != minus_j ? mpq_sub : mpq_add)(sum, sum, value);
        (minus_i ? mpq_add : mpq_sub)(x[i], x[i], step);
        if (j >= 0) (minus_j ? mpq_add : mpq_sub)(x[j], x[j], step);
    }
    mpq_clears(step, two, value, NULL);
}

/* Largest |g_i - exact_i| over all components. */
static inline double gradient_error(exact_function f, const void *context, const double *x, int n, const double *g)
{
    double h = difference_step(stencil_size(x, n)), worst = 0.0;
    mpq_t y[12], sum, scale;
    q_init(y, 12), mpq_inits(sum, scale, NULL);
    q_set(y, x, n);
    for (int i = 0; i < n; i++) {
        exact_difference(sum, f, context, y, i, -1, h);
        mpq_set_d(scale, 2.0 * h);
        mpq_div(sum, sum, scale);
        mpq_set_d(scale, g[i]);
        mpq_sub(sum, sum, scale);
        worst = fmax(worst, fabs(mpq_get_d(sum)));
    }
    q_clear(y, 12), mpq_clears(sum, scale, NULL);
    return worst;
}

/* Largest |H_ij - exact_ij| over all entries. */
static inline double hessian_error(exact_function f, const void *context, const double *x, int n, const double *H)
{
    double h = difference_step(stencil_size(x, n)), worst = 0.0;
    mpq_t y[12], sum, scale;
    q_init(y, 12), mpq_inits(sum, scale, NULL);
    q_set(y, x, n);
    for (int i = 0; i < n; i++) {
        for (int j = i; j < n; j++) {
            exact_difference(sum, f, context, y, i, j, h);
            mpq_set_d(scale, 2.0 * h);
            mpq_div(sum, sum, scale), mpq_div(sum, sum, scale);
            for (int side = 0; side < 2; side++) {
                mpq_set_d(scale, side ? H[n * j + i] : H[n * i + j]);
                mpq_sub(scale, sum, scale);
                worst = fmax(worst, fabs(mpq_get_d(scale)));
            }
        }
    }
    q_clear(y, 12), mpq_clears(sum, scale, NULL);
    return worst;
}

/* |f - exact| of a value. */
static inline double value_error(exact_function f, const void *context, const double *x, int n, double value)
{
    mpq_t y[12], exact, got;
    q_init(y, 12), mpq_inits(exact, got, NULL);
    q_set(y, x, n);
    f(exact, y, context);
    mpq_set_d(got, value);
    mpq_sub(exact, exact, got);
    double error = fabs(mpq_get_d(exact));
    q_clear(y, 12), mpq_clears(exact, got, NULL);
    return error;
}

/* ---- How well posed a stencil of the plane or line-line kind is, in plain double. ---- */

typedef struct stencil_shape {
    double size;    /* |u| + |a| + |b| */
    double sine;    /* of the angle between a and b */
    double weight;  /* largest |w_i| */
    double slope;   /* largest |q_i|, how fast a weight changes along the plane */
    double distance;
} stencil_shape;

static inline double norm3(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static inline stencil_shape shape_of(cipc_pair_kind kind, const double *x)
{
    bool plane = kind == CIPC_POINT_TRIANGLE;
    double u[3], a[3], b[3], w[4];
    for (int k = 0; k < 3; k++) {
        u[k] = x[k] - x[(plane ? 3 : 6) + k];
        a[k] = x[(plane ? 6 : 3) + k] - x[(plane ? 3 : 0) + k];
        b[k] = x[9 + k] - x[(plane ? 3 : 6) + k];
    }
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    stencil_shape s = {norm3(u) + norm3(a) + norm3(b), norm3(n) / (norm3(a) * norm3(b)), 0.0, 0.0, 0.0};
    cipc_closest_weights(kind, x, w);
    for (int i = 0; i < 4; i++) s.weight = fmax(s.weight, fabs(w[i]));
    s.slope = (norm3(a) + norm3(b)) / norm3(n);
    s.distance = fabs(u[0] * n[0] + u[1] * n[1] + u[2] * n[2]) / norm3(n);
    return s;
}

#endif
