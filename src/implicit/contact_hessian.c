/* Projected barrier Hessians by their structure (docs/theory/assembly.md, eqs. 2-6).
 *
 * The squared distance of a feature pair is the minimum over the parameters s of |r|^2, r = sum_i w_i(s) x_i. With u = sum_i w_i dx_i, unit direction
 * n = r/d, an orthonormal basis tau_k of the directions that the parameters span, and the rotation phi_k of the feature towards n along tau_k,
 *     d^2(d^2) = 2 [ (n.u)^2 + sum_{free tangents} (t.u)^2 - sum_k (2 d (tau_k.u) phi_k + d^2 phi_k^2) ]                                       (2)
 * where the "free tangents" t are those that no parameter spans (two for point-point, one for point-edge, none else). With b' < 0, c = -2 kappa w b':
 *     H = (4 d^2 kappa w b'' - c) (n.u)^2 - c sum_t (t.u)^2 + c sum_k (2 d (tau_k.u) phi_k + d^2 phi_k^2)                                       (3)
 * The t-terms are negative and orthogonal to all others: the projection drops them. The rest lives in the span of the functionals n.u, tau_k.u, phi_k. */
#include "implicit/contact_hessian.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/symmetric_eigen.h"

/* A feature pair at the point: nodes, weights of the closest vector, tangents with the node weights of their phi. */
typedef struct frame {
    int nodes, tangents;
    double w[4];
    double n[3], d;
    double tau[2][3];
    double m[2][4]; /* phi_k = n . sum_i m[k][i] dx_i */
} frame;

/* Below this sine between two edges (or two sides of a triangle) the closed form would lose half of its digits to the division by sine^2. */
static const double smallest_sine2 = 1e-8;

/* Orthonormal basis of two spanning vectors E0, E1 and phi's weights: phi = sum_k E^k nu_k, nu_k = n . dE_k, E^k the dual basis. edge[k] are the
 * node weights of E_k. False if nearly parallel. */
static bool tangent_frame(frame *f, const double E0[3], const double E1[3], const double edge[2][4])
{
    double g00 = v3_norm2(E0), g01 = v3_dot(E0, E1), g11 = v3_norm2(E1), det = g00 * g11 - g01 * g01;
    if (!(det > smallest_sine2 * g00 * g11)) return false;
    double length = sqrt(g00), height = sqrt(det / g00);
    for (int k = 0; k < 3; k++) {
        f->tau[0][k] = E0[k] / length;
        f->tau[1][k] = (E1[k] - g01 / g00 * E0[k]) / height;
    }
    /* tau_0 . E^0 = 1/length, tau_0 . E^1 = 0; tau_1 . E^0 = -g01/(g00 height), tau_1 . E^1 = 1/height */
    for (int i = 0; i < 4; i++) {
        f->m[0][i] = edge[0][i] / length;
        f->m[1][i] = (edge[1][i] - g01 / g00 * edge[0][i]) / height;
    }
    return true;
}

static bool build_frame(frame *f, cipc_pair_kind kind, const double *y)
{
    static const double triangle_edges[2][4] = {{0, -1, 1, 0}, {0, -1, 0, 1}}, edge_edges[2][4] = {{-1, 1, 0, 0}, {0, 0, -1, 1}};
    double r[3] = {0, 0, 0}, E0[3], E1[3];
    static const int counts[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4}, tangents[CIPC_PAIR_KIND_COUNT] = {0, 1, 2, 2};
    f->nodes = counts[kind];
    f->tangents = tangents[kind];
    cipc_closest_weights(kind, y, f->w);
    for (int i = 1; i < f->nodes; i++) /* sum of w is 0: differences only */
        for (int k = 0; k < 3; k++) r[k] += f->w[i] * (y[3 * i + k] - y[k]);
    if (kind == CIPC_POINT_EDGE) {
        v3_sub(E0, y + 6, y + 3);
        double length = v3_norm(E0);
        if (!(length > 0)) return false;
        v3_scale(f->tau[0], 1 / length, E0);
        double m[4] = {0, -1 / length, 1 / length, 0};
        memcpy(f->m[0], m, sizeof m);
    } else if (kind == CIPC_POINT_TRIANGLE) {
        v3_sub(E0, y + 6, y + 3);
        v3_sub(E1, y + 9, y + 3);
        if (!tangent_frame(f, E0, E1, triangle_edges)) return false;
    } else if (kind == CIPC_EDGE_EDGE) {
        v3_sub(E0, y + 3, y);
        v3_sub(E1, y + 9, y + 6);
        if (!tangent_frame(f, E0, E1, edge_edges)) return false;
    }
    if (f->tangents == 2) { /* the exact normal: r itself is inaccurate where d is small */
        v3_cross(f->n, f->tau[0], f->tau[1]);
        f->d = v3_dot(f->n, r);
        if (f->d < 0) {
            v3_scale(f->n, -1, f->n);
            f->d = -f->d;
        }
    } else {
        if (f->tangents == 1) v3_axpy(r, -v3_dot(r, f->tau[0]), f->tau[0]);
        f->d = v3_norm(r);
        if (f->d > 0) v3_scale(f->n, 1 / f->d, r);
    }
    return f->d > 0;
}

/* phi's sign: the parameters' tangents E_k enter r with the sign of their share of w. For a point against an edge or triangle r = p - q(s), so the
 * spanned direction is -E; between edges r = a(s) - b(t): +E_0, -E_1. The product (tau.u) phi in (2) is invariant under E -> -E. */

/* Orthonormal basis a[0..count) of node-weight vectors spanning w and the m's, w first; coefficient of each in `of`. */
static int orthonormalize(int nodes, int count, const double *vectors[3], double basis[3][4], double of[3][3])
{
    int rank = 0;
    for (int v = 0; v < count; v++) {
        double rest[4] = {0}, size = 0, left = 0;
        for (int i = 0; i < nodes; i++) {
            rest[i] = vectors[v][i];
            size += rest[i] * rest[i];
        }
        for (int k = 0; k < 3; k++) of[v][k] = 0;
        for (int pass = 0; pass < 2; pass++) /* twice is enough (Kahan, Parlett) */
            for (int b = 0; b < rank; b++) {
                double along = 0;
                for (int i = 0; i < nodes; i++) along += basis[b][i] * rest[i];
                for (int i = 0; i < nodes; i++) rest[i] -= along * basis[b][i];
                of[v][b] += along;
            }
        for (int i = 0; i < nodes; i++) left += rest[i] * rest[i];
        if (!(left > 1e-24 * size)) continue; /* dependent to rounding: adds no direction */
        left = sqrt(left);
        for (int i = 0; i < nodes; i++) basis[rank][i] = rest[i] / left;
        of[v][rank++] = left;
    }
    return rank;
}

/* H += sum over positive eigenvalues of w v v^T with v = sum_k V[k] axis_k, axis_k a node-weight vector times a direction. */
static void expand(const frame *f, int dimension, const double *w, const double *V, double axis_weights[5][4], const double *axis_direction[5],
                   double *H)
{
    int n = 3 * f->nodes;
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    for (int e = 0; e < dimension; e++) {
        if (!(w[e] > 0)) continue;
        double v[12] = {0};
        for (int k = 0; k < dimension; k++)
            for (int i = 0; i < f->nodes; i++) v3_axpy(v + 3 * i, V[e * dimension + k] * axis_weights[k][i], axis_direction[k]);
        for (int i = 0; i < n; i++) {
            double s = w[e] * v[i];
            for (int j = 0; j < n; j++) H[i * n + j] += s * v[j];
        }
    }
}

static void project(const frame *f, double normal, double c, double *H)
{
    const double *vectors[3] = {f->w, f->m[0], f->m[1]}, *direction[5];
    double basis[3][4], of[3][3], axis_weights[5][4], S[25] = {0}, w[5], V[25], length2 = 0;
    int along = orthonormalize(f->nodes, 1 + f->tangents, vectors, basis, of), dimension = along + f->tangents;
    for (int i = 0; i < f->nodes; i++) length2 += f->w[i] * f->w[i];
    double length = sqrt(length2);
    for (int k = 0; k < along; k++) {
        memcpy(axis_weights[k], basis[k], sizeof basis[k]);
        direction[k] = f->n;
    }
    for (int k = 0; k < f->tangents; k++) {
        for (int i = 0; i < f->nodes; i++) axis_weights[along + k][i] = f->w[i] / length;
        direction[along + k] = f->tau[k];
    }
    for (int i = 0; i < along; i++)
        for (int j = 0; j < along; j++) {
            double sum = normal * of[0][i] * of[0][j];
            for (int k = 0; k < f->tangents; k++) sum += c * f->d * f->d * of[1 + k][i] * of[1 + k][j];
            S[i * dimension + j] = sum;
        }
    for (int k = 0; k < f->tangents; k++)
        for (int i = 0; i < along; i++) S[i * dimension + along + k] = S[(along + k) * dimension + i] = c * f->d * length * of[1 + k][i];
    cipc_symmetric_eigen(dimension, S, w, V);
    expand(f, dimension, w, V, axis_weights, direction, H);
}

bool cipc_contact_hessian_projected(cipc_energy_id id, const double *y, const cipc_contact_barrier *barrier, double *H)
{
    if (barrier->mollifier_eps > 0 || id < CIPC_ENERGY_BARRIER_POINT_POINT || id > CIPC_ENERGY_BARRIER_EDGE_EDGE) return false;
    cipc_pair_kind kind = (cipc_pair_kind)(id - CIPC_ENERGY_BARRIER_POINT_POINT);
    frame f;
    if (id == CIPC_ENERGY_BARRIER_EDGE_EDGE && barrier->feature.kind != CIPC_EDGE_EDGE) return false;
    if (!build_frame(&f, kind, y)) return false;
    double xi = barrier->offset, b[3];
    cipc_barrier(cipc_distance2_value(kind, y) - xi * xi, barrier->dhat * (2 * xi + barrier->dhat), b);
    double scale = barrier->stiffness * barrier->weight, c = -2 * scale * b[1];
    project(&f, 4 * f.d * f.d * scale * b[2] - c, c, H);
    return true;
}
