/* Squared distance of a point to the line through an edge. SPEC D.1; docs/theory/distance.md section 4. */
#include "cipc/geometry.h"
#include "base/vector.h"
#include "geometry/nearest.h"

/* With u = p - e0 and e = e1 - e0: the foot e0 + t e and the perpendicular d = p - foot (eq. 11). */
typedef struct perpendicular {
    double t, d[3], g[3]; /* g = e / |e|^2, the gradient of t by p */
} perpendicular;

static perpendicular drop(const double x[9])
{
    perpendicular f;
    double u[3], e[3], m[3];
    v3_sub(u, x, x + 3);
    v3_sub(e, x + 6, x + 3);
    double inverse = 1.0 / v3_norm2(e);
    v3_cross(m, u, e);
    v3_cross(f.d, e, m); /* e x (u x e) = |e|^2 d: at right angles to e to an ulp of d, not of u */
    f.t = v3_dot(u, e) * inverse;
    v3_scale(f.d, inverse, f.d);
    v3_scale(f.g, inverse, e);
    return f;
}

double cipc_point_line_distance2_value(const double x[9])
{
    double u[3], e[3];
    v3_sub(u, x, x + 3);
    v3_sub(e, x + 6, x + 3);
    return line_distance2(u, e);
}

void cipc_point_line_distance2_gradient(const double x[9], double g[9])
{
    perpendicular f = drop(x);
    v3_scale(g, 2.0, f.d);
    v3_scale(g + 3, f.t - 1.0, g);
    v3_scale(g + 6, -f.t, g);
}

/* The four 3 x 3 matrices that every block is made of (eq. 12), each with its factor 2. */
typedef struct line_blocks {
    double P[9], A[9], B[9]; /* projector across the edge; d g^T; |g|^2 d d^T */
} line_blocks;

static void fill_blocks(const perpendicular *f, line_blocks *m)
{
    double g2 = v3_norm2(f->g), inverse = 1.0 / g2; /* 1/|g|^2 = |e|^2 */
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            m->P[3 * r + c] = 2.0 * ((r == c ? 1.0 : 0.0) - f->g[r] * f->g[c] * inverse);
            m->A[3 * r + c] = 2.0 * f->d[r] * f->g[c];
            m->B[3 * r + c] = 2.0 * g2 * (f->d[r] * f->d[c]);
        }
    }
}

/* Block (i, j) and its transpose. Writing both sides of each entry makes H symmetric to the last bit. */
static void write_block(double H[81], int i, int j, const line_blocks *m, const double w[3], const double c[3])
{
    double ww = w[i] * w[j], cw = c[i] * w[j], wc = w[i] * c[j], cc = c[i] * c[j];
    for (int r = 0; r < 3; r++) {
        for (int s = 0; s < 3; s++) {
            double entry = ww * m->P[3 * r + s] - cw * m->A[3 * r + s] - wc * m->A[3 * s + r] - cc * m->B[3 * r + s];
            H[9 * (3 * i + r) + 3 * j + s] = entry;
            H[9 * (3 * j + s) + 3 * i + r] = entry;
        }
    }
}

/* Eq. 12: H_ij = 2 [ w_i w_j P - c_i w_j d g^T - w_i c_j g d^T - c_i c_j |g|^2 d d^T ]. */
void cipc_point_line_distance2_hessian(const double x[9], double H[81])
{
    perpendicular f = drop(x);
    line_blocks m;
    fill_blocks(&f, &m);
    const double w[3] = {1.0, f.t - 1.0, -f.t}, c[3] = {0.0, -1.0, 1.0};
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) write_block(H, i, j, &m, w, c);
}
