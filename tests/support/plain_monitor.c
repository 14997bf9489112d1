#include "support/plain_monitor.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "cipc/geometry.h"
#include "cipc/oracle.h"

static bool is_sewn(const cipc_model *m, int a, int b)
{
    for (int i = 0; i < m->stitch_count; i++) {
        const int *n = m->stitches[i].nodes;
        for (int end = 1; end < 3; end++) {
            if ((n[0] == a && n[end] == b) || (n[0] == b && n[end] == a)) { return true; }
        }
    }
    return false;
}

bool plain_is_exempt(const cipc_model *m, const int *a, int na, const int *b, int nb, bool skip_fixed)
{
    bool fixed = skip_fixed;
    if (m->pair_apart != NULL && m->pair_apart[m->node_body[a[0]] * m->body_count + m->node_body[b[0]]]) { return true; }
    for (int i = 0; i < na; i++) {
        fixed = fixed && m->bodies[m->node_body[a[i]]].fixed;
        for (int j = 0; j < nb; j++) {
            if (a[i] == b[j] || is_sewn(m, a[i], b[j])) { return true; }
        }
    }
    for (int j = 0; j < nb; j++) { fixed = fixed && m->bodies[m->node_body[b[j]]].fixed; }
    return fixed;
}

int plain_side_count(const cipc_model *m, cipc_pair_kind kind, int side)
{
    int n = side == 0 ? cipc_pair_first_nodes(kind) : cipc_pair_nodes(kind) - cipc_pair_first_nodes(kind);
    return n == 1 ? m->node_count : n == 2 ? m->edge_count : m->triangle_count;
}

double plain_pair_nodes(const cipc_model *m, cipc_pair_kind kind, int a, int b, int nodes[4])
{
    nodes[0] = a;
    switch (kind) {
    case CIPC_POINT_POINT: nodes[1] = b; break;
    case CIPC_POINT_EDGE: memcpy(&nodes[1], m->edges[b], 2 * sizeof(int)); break;
    case CIPC_POINT_TRIANGLE: memcpy(&nodes[1], m->triangles[b], 3 * sizeof(int)); break;
    default: memcpy(nodes, m->edges[a], 2 * sizeof(int)); memcpy(&nodes[2], m->edges[b], 2 * sizeof(int));
    }
    return 0.5 * (m->bodies[m->node_body[nodes[0]]].offset + m->bodies[m->node_body[nodes[cipc_pair_first_nodes(kind)]]].offset);
}

/* By the kinds of the bodies: who meets whom. */
static bool is_of_kind(const cipc_model *m, cipc_pair_kind kind, int a, int b)
{
    cipc_body_kind first = m->bodies[m->node_body[kind == CIPC_EDGE_EDGE ? m->edges[a][0] : a]].kind;
    switch (kind) {
    case CIPC_POINT_POINT: return a < b && first == CIPC_BODY_PARTICLES && m->bodies[m->node_body[b]].kind == CIPC_BODY_PARTICLES;
    case CIPC_POINT_EDGE: return (first == CIPC_BODY_PARTICLES || first == CIPC_BODY_RODS) && m->bodies[m->node_body[m->edges[b][0]]].kind == CIPC_BODY_RODS;
    case CIPC_POINT_TRIANGLE: return m->interior == NULL || !m->interior[a];
    default: return a < b;
    }
}

bool plain_is_pair(const cipc_model *m, cipc_pair_kind kind, int a, int b, bool skip_fixed)
{
    int nodes[4], first = cipc_pair_first_nodes(kind);
    plain_pair_nodes(m, kind, a, b, nodes);
    return is_of_kind(m, kind, a, b) && !plain_is_exempt(m, nodes, first, &nodes[first], cipc_pair_nodes(kind) - first, skip_fixed);
}

static void gather(double *to, const double *x, const int *nodes, int n)
{
    for (int i = 0; i < n; i++) { memcpy(&to[3 * i], &x[3 * (size_t)nodes[i]], 3 * sizeof *x); }
}

void plain_stencil(cipc_pair_kind kind, const double *x, const int nodes[4], double stencil[12])
{
    gather(stencil, x, nodes, cipc_pair_nodes(kind));
}

/* What is done with a pair. */
typedef void pair_visitor(void *context, cipc_pair_kind kind, const int nodes[4], double xi);

static void visit_pairs(const cipc_model *m, bool skip_fixed, pair_visitor *visit, void *context)
{
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) {
        cipc_pair_kind kind = (cipc_pair_kind)k;
        int first = plain_side_count(m, kind, 0), second = plain_side_count(m, kind, 1), nodes[4];
        for (int a = 0; a < first; a++) {
            for (int b = 0; b < second; b++) {
                if (!plain_is_pair(m, kind, a, b, skip_fixed)) { continue; }
                double xi = plain_pair_nodes(m, kind, a, b, nodes);
                visit(context, kind, nodes, xi);
            }
        }
    }
}

typedef struct gap_look {
    plain_report *report;
    const double *x;
    double reach;
} gap_look;

static void look_at_gap(void *context, cipc_pair_kind kind, const int nodes[4], double xi)
{
    gap_look *look = context;
    double stencil[12];
    plain_stencil(kind, look->x, nodes, stencil);
    double gap = cipc_exact_distance_gap(kind, stencil, xi);
    look->report->min_gap = fmin(look->report->min_gap, gap);
    look->report->within += gap <= look->reach ? 1 : 0;
    look->report->gap_violated = look->report->gap_violated || cipc_exact_distance_sign(kind, stencil, xi) <= 0;
}

typedef struct path_look {
    const double *from, *to;
    bool clear;
} path_look;

static void look_at_path(void *context, cipc_pair_kind kind, const int nodes[4], double xi)
{
    path_look *look = context;
    cipc_stencil_path path = {.kind = kind, .to_end = true};
    plain_stencil(kind, look->from, nodes, path.x);
    plain_stencil(kind, look->to, nodes, path.p);
    look->clear = look->clear && cipc_exact_path_clear(&path, xi, 1) == CIPC_YES;
}

bool plain_path_clear(const cipc_model *m, const double *from, const double *to, bool skip_fixed)
{
    path_look look = {from, to, true};
    visit_pairs(m, skip_fixed, look_at_path, &look);
    return look.clear;
}

static void look_at_edge(plain_report *r, const cipc_model *m, const double *x, int edge, bool skip_fixed)
{
    const int *e = m->edges[edge];
    for (int t = 0; t < m->triangle_count; t++) {
        double a[6], b[9];
        gather(a, x, e, 2);
        gather(b, x, m->triangles[t], 3);
        bool exempt = plain_is_exempt(m, e, 2, m->triangles[t], 3, skip_fixed);
        r->crossing = r->crossing || (!exempt && cipc_edge_triangle_intersect(a, b));
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
    gap_look look = {&r, x, reach};
    visit_pairs(m, skip_fixed, look_at_gap, &look);
    for (int e = 0; e < m->edge_count; e++) { look_at_edge(&r, m, x, e, skip_fixed); }
    for (int t = 0; t < m->triangle_count; t++) { look_at_strain(&r, m, x, t); }
    return r;
}
