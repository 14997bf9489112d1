/* The frame of two directions a, b that span a plane: what point-plane and line-line distances have in common.
 * docs/theory/distance.md, section 3; equation numbers refer to that page. */
#ifndef CIPC_GEOMETRY_PLANE_FRAME_H
#define CIPC_GEOMETRY_PLANE_FRAME_H

#include <stdbool.h>

#include "base/vector.h"

/* u = beta a + gamma b + lambda n, with n = a x b and the dual directions g1, g2 in the plane (g1.a = 1, g1.b = 0, ...). */
typedef struct plane_frame {
    double n[3];
    double n2; /* |n|^2 */
    double g1[3], g2[3];
    double beta, gamma, lambda;
} plane_frame;

/* cot^2 of the angle between a and b up to which the cross product is good enough as it is: sin >= 1/4 (section 5). */
#define PLANE_CLEAR_COT2 15.0

static inline bool plane_is_clear(double n2, const double a[3], const double b[3])
{
    double ab = v3_dot(a, b);
    return ab * ab <= PLANE_CLEAR_COT2 * n2;
}

/* Normal n = a x b with, at small angles, its rounding error along a taken out (eq. 9). What is left of the error points across a, where a
 * near-flat stencil has next to no extent, so that distances along n keep an error of a few ulp of the stencil's size at any angle.
 * Returns |n|^2. */
static inline double plane_normal(double n[3], const double a[3], const double b[3])
{
    v3_cross(n, a, b);
    double n2 = v3_norm2(n);
    if (plane_is_clear(n2, a, b)) return n2;
    v3_axpy(n, -v3_dot(n, a) / v3_norm2(a), a);
    return v3_norm2(n);
}

/* Squared distance along the normal (eq. 4): (u.n)^2 / |n|^2. */
static inline double plane_distance2(const double u[3], const double a[3], const double b[3])
{
    double n[3], n2 = plane_normal(n, a, b), height = v3_dot(u, n);
    return height * height / n2;
}

/* Normal and dual directions (eq. 5). */
static inline void plane_frame_directions(plane_frame *f, const double a[3], const double b[3])
{
    f->n2 = plane_normal(f->n, a, b);
    double inverse = 1.0 / f->n2;
    v3_cross(f->g1, b, f->n);
    v3_cross(f->g2, f->n, a);
    v3_scale(f->g1, inverse, f->g1);
    v3_scale(f->g2, inverse, f->g2);
}

/* What is left of u off the foot: rest = u - beta a - gamma b. */
static inline void plane_frame_rest(const plane_frame *f, double rest[3], const double u[3], const double a[3], const double b[3])
{
    v3_copy(rest, u);
    v3_axpy(rest, -f->beta, a);
    v3_axpy(rest, -f->gamma, b);
}

/* One step of iterative refinement of beta and gamma (eq. 10): cuts their error by about u / sin(a, b). */
static inline void plane_frame_refine(plane_frame *f, const double u[3], const double a[3], const double b[3])
{
    double rest[3];
    plane_frame_rest(f, rest, u, a, b);
    f->beta += v3_dot(rest, f->g1);
    f->gamma += v3_dot(rest, f->g2);
}

/* Coordinates of u (eq. 5). */
static inline void plane_frame_coordinates(plane_frame *f, const double u[3])
{
    f->lambda = v3_dot(u, f->n) / f->n2;
    f->beta = v3_dot(u, f->g1);
    f->gamma = v3_dot(u, f->g2);
}

/* The foot itself, for a and b at a small angle: refine twice, then slide along a to the least distance, because the error that is left
 * points along a and b (section 6.3). Returns |u - beta a - gamma b|^2. */
static inline double plane_frame_settle(plane_frame *f, const double u[3], const double a[3], const double b[3])
{
    double rest[3];
    plane_frame_refine(f, u, a, b);
    plane_frame_refine(f, u, a, b);
    plane_frame_rest(f, rest, u, a, b);
    f->beta += v3_dot(rest, a) / v3_norm2(a);
    plane_frame_rest(f, rest, u, a, b);
    return v3_norm2(rest);
}

/* Point against plane, x = p, t0, t1, t2: the foot is t0 + beta a + gamma b, so (1 - beta - gamma, beta, gamma) are its barycentric
 * coordinates. */
static inline void plane_frame_of_point_plane(const double x[12], plane_frame *f, double w[4])
{
    double u[3], a[3], b[3];
    v3_sub(u, x, x + 3);
    v3_sub(a, x + 6, x + 3);
    v3_sub(b, x + 9, x + 3);
    plane_frame_directions(f, a, b);
    plane_frame_coordinates(f, u);
    w[0] = 1.0;
    w[1] = f->beta + f->gamma - 1.0;
    w[2] = -f->beta;
    w[3] = -f->gamma;
}

/* Line against line, x = a0, a1, b0, b1: the closest points are a0 - beta a and b0 + gamma b. */
static inline void plane_frame_of_line_line(const double x[12], plane_frame *f, double w[4])
{
    double u[3], a[3], b[3];
    v3_sub(u, x, x + 6);
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 9, x + 6);
    plane_frame_directions(f, a, b);
    plane_frame_coordinates(f, u);
    w[0] = 1.0 + f->beta;
    w[1] = -f->beta;
    w[2] = f->gamma - 1.0;
    w[3] = -f->gamma;
}

/* Gradient (eq. 2): 2 w_i lambda n for the four nodes. */
static inline void plane_frame_gradient(const plane_frame *f, const double w[4], double g[12])
{
    double twice_d[3];
    v3_scale(twice_d, 2.0 * f->lambda, f->n);
    for (int i = 0; i < 4; i++) v3_scale(g + 3 * i, w[i], twice_d);
}

/* Block (i, j) and its transpose: n y^T + z n^T. Writing both sides of each entry makes H symmetric to the last bit. */
static inline void plane_frame_block(double *H, int i, int j, const double n[3], const double y[3], const double z[3])
{
    for (int r = 0; r < 3; r++) {
        double *row = H + 12 * (3 * i + r) + 3 * j, *column = H + 36 * j + 3 * i + r;
        column[0] = row[0] = n[r] * y[0] + z[r] * n[0];
        column[12] = row[1] = n[r] * y[1] + z[r] * n[1];
        column[24] = row[2] = n[r] * y[2] + z[r] * n[2];
    }
}

/* Hessian (eq. 6) from the weights w_i and their plane gradients q_i:
 *   H_ij = 2 [ (w_i w_j / |n|^2 - lambda^2 q_i.q_j) n n^T - lambda w_j n q_i^T - lambda w_i q_j n^T ]. */
static inline void plane_frame_hessian(const plane_frame *f, const double w[4], double q[4][3], double H[144])
{
    double twice_inverse = 2.0 / f->n2, twice_lambda = 2.0 * f->lambda, twice_lambda2 = twice_lambda * f->lambda;
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double along = twice_inverse * w[i] * w[j] - twice_lambda2 * v3_dot(q[i], q[j]);
            double y[3], z[3];
            v3_scale(y, along, f->n);
            v3_axpy(y, -twice_lambda * w[j], q[i]);
            v3_scale(z, -twice_lambda * w[i], q[j]);
            plane_frame_block(H, i, j, f->n, y, z);
        }
    }
}

#endif
