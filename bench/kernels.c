/* Distance kernels, barrier and mollifier: nanoseconds per call, beside what IPC Toolkit's took on the day its figures were taken.
 *   build/bench/kernels [YARDSTICK_SECONDS]   with it, the peer's times are scaled from that day (0.38 s) to this one */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "cipc/energy.h"

enum { INPUTS = 1 << 15, PASSES = 8, REPETITIONS = 7 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* One pass over the inputs, each kernel in a loop of its own: called as a caller would, not through a pointer. */
typedef double pass(const double *x);
#define PASS(name, call)                          \
    static double name(const double *x)           \
    {                                             \
        double out[144] = {0}, sum = 0;           \
        for (int i = 0; i < INPUTS; i++, x += 12) { \
            call;                                 \
            sum += out[0];                        \
        }                                         \
        return sum;                               \
    }
PASS(point_triangle_value, out[0] = cipc_point_triangle_distance2(x))
PASS(point_triangle_gradient, cipc_point_triangle_distance2_gradient(x, out))
PASS(point_triangle_hessian, cipc_point_triangle_distance2_hessian(x, out))
PASS(point_plane_value, out[0] = cipc_point_plane_distance2_value(x))
PASS(point_plane_gradient, cipc_point_plane_distance2_gradient(x, out))
PASS(point_plane_hessian, cipc_point_plane_distance2_hessian(x, out))
PASS(edge_edge_value, out[0] = cipc_edge_edge_distance2(x))
PASS(edge_edge_gradient, cipc_edge_edge_distance2_gradient(x, out))
PASS(edge_edge_hessian, cipc_edge_edge_distance2_hessian(x, out))
PASS(line_line_value, out[0] = cipc_line_line_distance2_value(x))
PASS(line_line_gradient, cipc_line_line_distance2_gradient(x, out))
PASS(line_line_hessian, cipc_line_line_distance2_hessian(x, out))
PASS(barrier, cipc_barrier(x[0] * x[0], 1.0, out))
PASS(mollifier_value, out[0] = cipc_edge_edge_mollifier_value(x, 100.0))
PASS(mollifier_gradient, cipc_edge_edge_mollifier_gradient(x, 100.0, out))
PASS(mollifier_hessian, cipc_edge_edge_mollifier_hessian(x, 100.0, out))

static const struct {
    const char *name;
    pass *run;
    double peer_ns;
} kernels[] = {
    {"point-triangle, feature found, value", point_triangle_value, 115},
    {"point-triangle, feature found, gradient", point_triangle_gradient, 131},
    {"point-triangle, feature found, Hessian", point_triangle_hessian, 224},
    {"point-triangle, face given, value", point_plane_value, 7.2},
    {"point-triangle, face given, gradient", point_plane_gradient, 20.7},
    {"point-triangle, face given, Hessian", point_plane_hessian, 191},
    {"edge-edge, feature found, value", edge_edge_value, 22.6},
    {"edge-edge, feature found, gradient", edge_edge_gradient, 36.5},
    {"edge-edge, feature found, Hessian", edge_edge_hessian, 162},
    {"edge-edge, line-line given, value", line_line_value, 4.1},
    {"edge-edge, line-line given, gradient", line_line_gradient, 17.8},
    {"edge-edge, line-line given, Hessian", line_line_hessian, 179},
    {"barrier b, b', b''", barrier, 4.7 + 5.0 + 5.0},
    {"mollifier, value", mollifier_value, 3.6},
    {"mollifier, gradient", mollifier_gradient, 14.2},
    {"mollifier, Hessian", mollifier_hessian, 63.7},
};

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    double *x = malloc((size_t)INPUTS * 12 * sizeof *x), sink = 0, scale = argc > 1 ? atof(argv[1]) / 0.38 : 0;
    unsigned long long state = 88172645463325252ULL;
    if (x == NULL) return 1;
    for (int i = 0; i < INPUTS * 12; i++) {
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        x[i] = (double)(state >> 11) * 0x1p-52 - 1;
    }
    printf("%-42s %8s %8s %8s\n", "kernel, random inputs in [-1, 1)", "ns", "peer", "ratio");
    for (size_t k = 0; k < sizeof kernels / sizeof kernels[0]; k++) {
        double ns[REPETITIONS];
        for (int r = 0; r < REPETITIONS; r++) {
            double begin = now();
            for (int p = 0; p < PASSES; p++) sink += kernels[k].run(x);
            ns[r] = 1e9 * (now() - begin) / ((double)PASSES * INPUTS);
        }
        qsort(ns, REPETITIONS, sizeof *ns, ascending);
        printf("%-42s %8.1f", kernels[k].name, ns[REPETITIONS / 2]);
        if (scale > 0) printf(" %8.1f %8.2f", kernels[k].peer_ns * scale, ns[REPETITIONS / 2] / (kernels[k].peer_ns * scale));
        printf("\n");
    }
    printf("(sum of the results, so that none is left out: %g)\n", sink);
    free(x);
    return 0;
}
