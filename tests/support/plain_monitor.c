#include "support/plain_monitor.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "cipc/geometry.h"
#include "cipc/oracle.h"

bool plain_is_exempt(const cipc_model *m, const int *a, int na, const int *b, int nb, bool skip_fixed)
{
    bool fixed = skip_fixed;
    for (int i = 0; i < na; i++) {
        fixed = fixed && m->bodies[m->node_body[a[i]]].fixed;
        for (int j = 0; j < nb; j++) {
            if (a[i] == b[j]) { return true; }
        }
    }
    for (int j = 0; j < nb; j++) { fixed = fixed && m->bodies[m->node_body[b[j]]].fixed; }
    return fixed;
}

static void gather(double *to, const double *x, const int *nodes, int n)
{
    for (int i = 0; i < n; i++) { memcpy(&to[3 * i], &x[3 * (size_t)nodes[i]], 3 * sizeof *x); }
}

static void look_at_gap(plain_report *r, const cipc_model *m, const double *x, bool edge_edge, const int *a, int na, const int *b, int nb,
                        double reach)
{
    double stencil[12];
    gather(stencil, x, a, na);
    gather(&stencil[3 * na], x, b, nb);
    double xi = 0.5 * (m->bodies[m->node_body[a[0]]].offset + m->bodies[m->node_body[b[0]]].offset);
    double gap = cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), stencil, xi);
    r->min_gap = fmin(r->min_gap, gap);
    r->within += gap <= reach ? 1 : 0;
    r->gap_violated = r->gap_violated || cipc_exact_distance_sign(cipc_mesh_pair(edge_edge), stencil, xi) <= 0;
}

static void look_at_edge(plain_report *r, const cipc_model *m, const double *x, int edge, double reach, bool skip_fixed)
{
    const int *e = m->edges[edge];
    for (int t = 0; t < m->triangle_count; t++) {
        double a[6], b[9];
        gather(a, x, e, 2);
        gather(b, x, m->triangles[t], 3);
        bool exempt = plain_is_exempt(m, e, 2, m->triangles[t], 3, skip_fixed);
        r->crossing = r->crossing || (!exempt && cipc_edge_triangle_intersect(a, b));
    }
    for (int f = edge + 1; f < m->edge_count; f++) {
        if (!plain_is_exempt(m, e, 2, m->edges[f], 2, skip_fixed)) { look_at_gap(r, m, x, true, e, 2, m->edges[f], 2, reach); }
    }
}

static void look_at_point(plain_report *r, const cipc_model *m, const double *x, int node, double reach, bool skip_fixed)
{
    for (int t = 0; t < m->triangle_count; t++) {
        if (!plain_is_exempt(m, &node, 1, m->triangles[t], 3, skip_fixed)) {
            look_at_gap(r, m, x, false, &node, 1, m->triangles[t], 3, reach);
        }
    }
}

static void look_at_strain(plain_report *r, const cipc_model *m, const double *x, int triangle)
{
    double limit = m->bodies[m->triangle_body[triangle]].material.strain_limit, rest[9], now[9];
    gather(rest, m->rest, m->triangles[triangle], 3);
    gather(now, x, m->triangles[triangle], 3);
    r->strain_violated = r->strain_violated || (limit > 0 && cipc_exact_compare_stretch(rest, now, limit) <= 0);
}

plain_report plain_monitor(const cipc_model *m, const double *x, double reach, bool skip_fixed)
{
    plain_report r = {.min_gap = INFINITY};
    for (int e = 0; e < m->edge_count; e++) { look_at_edge(&r, m, x, e, reach, skip_fixed); }
    for (int i = 0; i < m->node_count; i++) { look_at_point(&r, m, x, i, reach, skip_fixed); }
    for (int t = 0; t < m->triangle_count; t++) { look_at_strain(&r, m, x, t); }
    return r;
}
