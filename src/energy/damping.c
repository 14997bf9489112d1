/* Damping of one element as a potential: c/2 (x - start)^T K (x - start), K lagged (Rayleigh; docs/theory/energies.md (R13)-(R15)). */
#include "base/vector.h"
#include "cipc/energy.h"

enum { N = 12 };

void cipc_damping_init(cipc_damping *params, double factor, int nodes, const double *start, const double *hessian)
{
    int n = 3 * nodes;
    double *entry = params->stiffness;
    params->factor = factor;
    for (int i = 0; i < N; i++) {
        params->start[i] = i < n ? start[i] : 0;
        for (int j = i; j < N; j++) *entry++ = i < n && j < n ? hessian[n * i + j] : 0;
    }
}

/* K in full, and R: its sums over the second node, K times the three translations. */
typedef struct lagged {
    double K[N][N], R[N][3];
} lagged;

static void unpack(const cipc_damping *params, lagged *m)
{
    const double *entry = params->stiffness;
    for (int i = 0; i < N; i++) {
        for (int j = i; j < N; j++) m->K[i][j] = m->K[j][i] = *entry++;
    }
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < 3; k++) m->R[i][k] = (m->K[i][k] + m->K[i][3 + k]) + (m->K[i][6 + k] + m->K[i][9 + k]);
    }
}

/* (R14): the way of node 0, and what every node moved against it. Free flight is many times longer than the deformation that damping is about; apart from it,
 * the latter keeps its digits, and what rounding makes of R m is one fixed change of K, which no difference of two values can mistake for a force. */
static void split(const double x[12], const cipc_damping *params, double way[3], double d[12])
{
    v3_sub(way, x, params->start);
    for (int i = 0; i < N; i++) d[i] = (x[i] - x[i % 3]) - (params->start[i] - params->start[i % 3]);
}

/* Row i of K d. */
static double times(const lagged *m, int i, const double d[12])
{
    double sum = 0;
    for (int j = 0; j < N; j++) sum += m->K[i][j] * d[j];
    return sum;
}

double cipc_damping_value(const double x[12], const cipc_damping *params)
{
    lagged m;
    double way[3], d[N], total[3] = {0, 0, 0}, sum = 0;
    unpack(params, &m);
    split(x, params, way, d);
    for (int i = 0; i < N; i++) {
        double on_way = v3_dot(m.R[i], way);
        sum += d[i] * (times(&m, i, d) + 2 * on_way);
        total[i % 3] += on_way;
    }
    return 0.5 * params->factor * (sum + v3_dot(way, total));
}

void cipc_damping_gradient(const double x[12], const cipc_damping *params, double g[12])
{
    lagged m;
    double way[3], d[N];
    unpack(params, &m);
    split(x, params, way, d);
    for (int i = 0; i < N; i++) g[i] = params->factor * (times(&m, i, d) + v3_dot(m.R[i], way));
}

void cipc_damping_hessian(const double x[12], const cipc_damping *params, double H[144])
{
    const double *entry = params->stiffness;
    (void)x;
    for (int i = 0; i < N; i++) {
        for (int j = i; j < N; j++) H[N * i + j] = H[N * j + i] = params->factor * *entry++;
    }
}
