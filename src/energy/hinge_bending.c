/* Hinge bending: k w (theta - thetabar)^2 over the dihedral angle of two triangles (SPEC C.6, F1; docs/theory/energies.md (21)-(25)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

/* Normals n1 = (v1-v0)x(v2-v0) and n2 = (v0-v1)x(v3-v1), and the edge e = v1 - v0. Flat: n1 and n2 point the same way. */
typedef struct normals {
    double edge[3], n[2][3];
} normals;

static normals normals_of(const double x[12])
{
    normals s;
    double a[3], b[3];
    v3_sub(s.edge, x + 3, x);
    v3_sub(a, x + 6, x);
    v3_sub(b, x + 9, x + 3);
    v3_cross(s.n[0], s.edge, a);
    v3_cross(s.n[1], b, s.edge);
    return s;
}

/* (21). e.(n1 x n2)/|e| = -|e| n1.(v3 - v1), because n1 x n2 lies along e; the right-hand side does not cancel when the hinge is nearly
 * flat. */
static double angle_of(const normals *s, const double x[12])
{
    double b[3];
    v3_sub(b, x + 9, x + 3);
    return atan2(-v3_norm(s->edge) * v3_dot(s->n[0], b), v3_dot(s->n[0], s->n[1]));
}

double cipc_hinge_angle(const double x[12])
{
    normals s = normals_of(x);
    return angle_of(&s, x);
}

void cipc_hinge_bending_init(cipc_hinge_bending *params, const double rest[12], double thickness, double young, double poisson,
                             bool cipc_constant)
{
    normals s = normals_of(rest);
    double areas = 0.5 * (v3_norm(s.n[0]) + v3_norm(s.n[1]));
    double rigidity = young * thickness * thickness * thickness / (12 * (1 - poisson * poisson));
    double k = cipc_constant ? rigidity / 2 : rigidity / 6;
    params->stiffness = k * 3 * v3_norm2(s.edge) / areas; /* w = ebar/hbar, hbar = (A1 + A2)/(3 ebar) */
    params->rest_angle = angle_of(&s, rest);
}

double cipc_hinge_bending_value(const double x[12], const cipc_hinge_bending *params)
{
    normals s = normals_of(x);
    if (!(v3_norm2(s.n[0]) > 0) || !(v3_norm2(s.n[1]) > 0)) return INFINITY; /* a collapsed triangle has no normal */
    double bend = angle_of(&s, x) - params->rest_angle;
    return params->stiffness * bend * bend;
}

/* The two wings of a hinge: wing t is the triangle of the edge and node 2 + t. */
typedef struct wings {
    double length;  /* |e| */
    double e[3];    /* unit edge */
    double n[2][3]; /* unit normals */
    double inverse_height[2];
    double c[2][3]; /* weights of nodes 0, 1, 2 + t: -(1 - s), -s, 1; s: foot of node 2 + t on the edge, 0 at v0 and 1 at v1 */
    double theta;
} wings;

static wings wings_of(const double x[12])
{
    normals s = normals_of(x);
    wings h;
    h.length = v3_norm(s.edge);
    h.theta = angle_of(&s, x);
    v3_scale(h.e, 1 / h.length, s.edge);
    for (int t = 0; t < 2; t++) {
        double arm[3], twice_area = v3_norm(s.n[t]);
        v3_sub(arm, x + 6 + 3 * t, x);
        v3_scale(h.n[t], 1 / twice_area, s.n[t]);
        h.inverse_height[t] = h.length / twice_area;
        double foot = v3_dot(arm, h.e) / h.length;
        h.c[t][0] = -(1 - foot);
        h.c[t][1] = -foot;
        h.c[t][2] = 1;
    }
    return h;
}

/* (23): each wing adds c_i m with m = -n/height to its nodes. */
static void angle_gradient(const wings *h, double g[12])
{
    for (int k = 0; k < 3; k++) {
        double m0 = -h->n[0][k] * h->inverse_height[0], m1 = -h->n[1][k] * h->inverse_height[1];
        g[k] = h->c[0][0] * m0 + h->c[1][0] * m1;
        g[3 + k] = h->c[0][1] * m0 + h->c[1][1] * m1;
        g[6 + k] = m0;
        g[9 + k] = m1;
    }
}

void cipc_hinge_angle_gradient(const double x[12], double g[12])
{
    wings h = wings_of(x);
    angle_gradient(&h, g);
}

void cipc_hinge_bending_gradient(const double x[12], const cipc_hinge_bending *params, double g[12])
{
    wings h = wings_of(x);
    angle_gradient(&h, g);
    double torque = 2 * params->stiffness * (h.theta - params->rest_angle);
    for (int i = 0; i < 12; i++) g[i] *= torque;
}

/* Add `torque` times wing t's part (25) of the Hessian of theta, blocks on and above the diagonal only. */
static void add_wing_hessian(const wings *h, int t, double torque, double H[144])
{
    static const double d[3] = {-1, 1, 0};
    const double *n = h->n[t], *e = h->e, *c = h->c[t];
    double r[3], Q[3][3], S[3][3]; /* r: unit altitude, from the edge to node 2 + t */
    if (t == 0)
        v3_cross(r, n, e);
    else
        v3_cross(r, e, n);
    double inverse_height = h->inverse_height[t], inverse_length = 1 / h->length;
    double on_Q = torque * inverse_height * inverse_height, on_S = torque * inverse_height * inverse_length;
    double edge_share = 0.5 * inverse_length * inverse_length / (inverse_height * inverse_height);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            Q[a][b] = on_Q * (r[a] * n[b] + n[a] * r[b]);
            S[a][b] = on_S * e[a] * n[b];
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double q = c[i] * c[j] + edge_share * d[i] * d[j], s = c[i] * d[j], s_transposed = d[i] * c[j];
            double *block = H + 12 * 3 * (i < 2 ? i : 2 + t) + 3 * (j < 2 ? j : 2 + t);
            for (int a = 0; a < 3; a++) {
                for (int b = 0; b < 3; b++) block[12 * a + b] += q * Q[a][b] + (s * S[a][b] + s_transposed * S[b][a]);
            }
        }
    }
}

void cipc_hinge_bending_hessian(const double x[12], const cipc_hinge_bending *params, double H[144])
{
    wings h = wings_of(x);
    double g[12];
    angle_gradient(&h, g);
    double twice_k = 2 * params->stiffness, torque = twice_k * (h.theta - params->rest_angle);
    for (int i = 0; i < 12; i++) {
        double row = twice_k * g[i];
        for (int j = 0; j < 12; j++) H[12 * i + j] = row * g[j];
    }
    add_wing_hessian(&h, 0, torque, H);
    add_wing_hessian(&h, 1, torque, H);
    for (int i = 1; i < 12; i++) {
        for (int j = 0; j < i; j++) H[12 * i + j] = H[12 * j + i];
    }
}
