/* Edge-edge mollifier e(c). SPEC D.3; docs/theory/distance.md section 7. */
#include <string.h>

#include "cipc/geometry.h"
#include "base/vector.h"

/* Gradient of c by the two edge vectors (eq. 16), and c itself. */
typedef struct cross_gradient {
    double a[3], b[3];   /* the edges a = a1 - a0, b = b1 - b0 */
    double ca[3], cb[3]; /* dc/da, dc/db */
    double c;
} cross_gradient;

static inline double edges_cross2(const double x[12], double a[3], double b[3], double n[3])
{
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 9, x + 6);
    v3_cross(n, a, b);
    return v3_norm2(n);
}

static inline void differentiate(const double x[12], cross_gradient *f)
{
    double n[3];
    f->c = edges_cross2(x, f->a, f->b, n);
    v3_scale(n, 2.0, n);
    v3_cross(f->ca, f->b, n);
    v3_cross(f->cb, n, f->a);
}

double cipc_edge_edge_cross2(const double x[12])
{
    double a[3], b[3], n[3];
    return edges_cross2(x, a, b, n);
}

/* e(c), eq. 14. */
double cipc_edge_edge_mollifier_value(const double x[12], double eps)
{
    double c = cipc_edge_edge_cross2(x);
    return c < eps ? c / eps * (2.0 - c / eps) : 1.0;
}

/* e'(c) and e''(c) below the threshold, eq. 15. */
static double first_derivative(double c, double eps)
{
    double inverse = 1.0 / eps;
    return 2.0 * inverse * (1.0 - c * inverse);
}

static double second_derivative(double eps)
{
    return -2.0 / eps / eps;
}

void cipc_edge_edge_mollifier_gradient(const double x[12], double eps, double g[12])
{
    cross_gradient f;
    differentiate(x, &f);
    if (!(f.c < eps)) {
        memset(g, 0, 12 * sizeof g[0]);
        return;
    }
    double e1 = first_derivative(f.c, eps);
    for (int k = 0; k < 3; k++) {
        g[3 + k] = e1 * f.ca[k];
        g[9 + k] = e1 * f.cb[k];
        g[k] = -g[3 + k];
        g[6 + k] = -g[9 + k];
    }
}

/* The 3 x 3 blocks of the Hessian of e(c) by the edge vectors a and b (eq. 17). */
typedef struct edge_blocks {
    double aa[9], ab[9], bb[9];
} edge_blocks;

static void fill_blocks(const cross_gradient *f, double eps, edge_blocks *m)
{
    double e1 = first_derivative(f->c, eps), e2 = second_derivative(eps);
    double a2 = v3_norm2(f->a), b2 = v3_norm2(f->b), ab = v3_dot(f->a, f->b);
    for (int r = 0; r < 3; r++) {
        for (int s = 0; s < 3; s++) {
            double unit = r == s ? 1.0 : 0.0;
            m->aa[3 * r + s] = 2.0 * e1 * (b2 * unit - f->b[r] * f->b[s]) + e2 * (f->ca[r] * f->ca[s]);
            m->bb[3 * r + s] = 2.0 * e1 * (a2 * unit - f->a[r] * f->a[s]) + e2 * (f->cb[r] * f->cb[s]);
            m->ab[3 * r + s] =
                2.0 * e1 * (2.0 * f->a[r] * f->b[s] - f->b[r] * f->a[s] - ab * unit) + e2 * (f->ca[r] * f->cb[s]);
        }
    }
}

/* A block enters four times with the signs of da/da1 = +1, da/da0 = -1. */
static void write_block(double H[144], int row, int column, int r, int s, double entry)
{
    double *corner = H + 12 * (3 * row + r) + 3 * column + s;
    corner[0] = corner[36 + 3] = entry;
    corner[3] = corner[36] = -entry;
}

void cipc_edge_edge_mollifier_hessian(const double x[12], double eps, double H[144])
{
    cross_gradient f;
    differentiate(x, &f);
    if (!(f.c < eps)) {
        memset(H, 0, 144 * sizeof H[0]);
        return;
    }
    edge_blocks m;
    fill_blocks(&f, eps, &m);
    for (int r = 0; r < 3; r++) {
        for (int s = 0; s < 3; s++) {
            write_block(H, 0, 0, r, s, m.aa[3 * r + s]);
            write_block(H, 0, 2, r, s, m.ab[3 * r + s]);
            write_block(H, 2, 0, r, s, m.ab[3 * s + r]);
            write_block(H, 2, 2, r, s, m.bb[3 * r + s]);
        }
    }
}
