#include "support/flat_pattern.h"

#include <math.h>
#include <stdlib.h>

static double apart(const double *x, int a, int b)
{
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = x[3 * a + k] - x[3 * b + k];
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

double pattern_strain(const cipc_mesh *mesh)
{
    double largest = 0;
    for (int t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++) {
            int a = mesh->triangles[t][k], b = mesh->triangles[t][(k + 1) % 3];
            largest = fmax(largest, fabs(apart(mesh->nodes, a, b) / apart(mesh->pattern, a, b) - 1));
        }
    }
    return largest;
}

static double point_segment(const double p[2], const double a[2], const double b[2])
{
    double ux = b[0] - a[0], uy = b[1] - a[1], t = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy);
    t = fmin(fmax(t, 0), 1);
    return hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy);
}

static double side_of(const double p[2], const double a[2], const double b[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* 0 if they cross. */
static double segment_segment(const double a[2], const double b[2], const double c[2], const double d[2])
{
    if (side_of(a, c, d) * side_of(b, c, d) < 0 && side_of(c, a, b) * side_of(d, a, b) < 0) return 0;
    return fmin(fmin(point_segment(a, c, d), point_segment(b, c, d)), fmin(point_segment(c, a, b), point_segment(d, a, b)));
}

double plan_clearance(const cipc_mesh *mesh)
{
    int columns = mesh->panel_columns, count = 0, all = mesh->panel_count * columns;
    double(*p)[2] = calloc((size_t)all, sizeof *p), least = INFINITY;
    if (p == NULL) abort();
    for (int i = 0; i < all; i++) {
        const double *x = mesh->nodes + 3 * (size_t)(i / columns * columns * mesh->panel_rows + i % columns);
        if (count > 0 && p[count - 1][0] == x[0] && p[count - 1][1] == x[2]) continue;
        p[count][0] = x[0];
        p[count++][1] = x[2];
    }
    if (p[0][0] == p[count - 1][0] && p[0][1] == p[count - 1][1]) count--;
    for (int i = 0; i < count; i++) {
        for (int j = i + 2; j < count; j++) {
            if (i == 0 && j == count - 1) continue;
            least = fmin(least, segment_segment(p[i], p[i + 1], p[j], p[(j + 1) % count]));
        }
    }
    free(p);
    return least;
}
