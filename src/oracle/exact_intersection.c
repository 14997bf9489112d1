/* Exact intersection of edge and triangle, and of two triangles, as closed sets, in integers (SPEC V.5 M1). Degenerate ones are the sets they are.
 *
 * Edge and triangle meet if their distance is 0; and their distance is attained either between the edge and a side of the triangle, or between an end of the edge
 * and the triangle, or the edge passes through the inside of the triangle. The last is decided by signs of volumes. */
#include "cipc/oracle.h"

#include "oracle/exact_search.h"

/* One search serves: five nodes in one unit. */
typedef struct meeting {
    cipc_integer3 node[6];
    oracle_search search;
    mpz_t volume, part;
} meeting;

static void meeting_init(meeting *m, const double *a, int a_nodes, const double *b, int b_nodes)
{
    int exponent = cipc_common_exponent(b, 3 * b_nodes, cipc_common_exponent(a, 3 * a_nodes, 0));
    oracle_search_init(&m->search);
    mpz_inits(m->volume, m->part, NULL);
    for (int i = 0; i < 6; i++) cipc_integer3_init(&m->node[i]);
    for (int i = 0; i < a_nodes; i++) cipc_integer3_from_doubles(&m->node[i], &a[3 * i], exponent);
    for (int i = 0; i < b_nodes; i++) cipc_integer3_from_doubles(&m->node[a_nodes + i], &b[3 * i], exponent);
}

static void meeting_clear(meeting *m)
{
    for (int i = 0; i < 6; i++) cipc_integer3_clear(&m->node[i]);
    mpz_clears(m->volume, m->part, NULL);
    oracle_search_clear(&m->search);
}

static bool at_distance_zero(meeting *m, cipc_pair_kind kind, int i, int j, int k, int l)
{
    const int nodes[4] = {i, j, k, l};
    for (int n = 0; n < 4; n++)
        for (int c = 0; c < 3; c++) mpz_set(m->search.node[n].c[c], m->node[nodes[n]].c[c]);
    oracle_search_run(&m->search, kind);
    return mpz_sgn(m->search.least_numerator) == 0;
}

/* Sign of det[b - a, c - a, d - a]. */
static int volume_sign(meeting *m, int a, int b, int c, int d)
{
    oracle_search *f = &m->search;
    cipc_integer3_sub(&f->u, &m->node[b], &m->node[a]);
    cipc_integer3_sub(&f->v, &m->node[c], &m->node[a]);
    cipc_integer3_sub(&f->w, &m->node[d], &m->node[a]);
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(m->volume, &f->n, &f->w);
    return mpz_sgn(m->volume);
}

/* Does the edge e0 e1 pass through the inside of the triangle, its ends strictly on different sides? */
static bool pierces(meeting *m, int e0, int e1, int t0, int t1, int t2)
{
    if (volume_sign(m, t0, t1, t2, e0) * volume_sign(m, t0, t1, t2, e1) != -1) return false;
    int first = volume_sign(m, e0, e1, t0, t1);
    return first != 0 && volume_sign(m, e0, e1, t1, t2) == first && volume_sign(m, e0, e1, t2, t0) == first;
}

static bool edge_meets_triangle(meeting *m, int e0, int e1, int t0, int t1, int t2)
{
    return at_distance_zero(m, CIPC_POINT_TRIANGLE, e0, t0, t1, t2) || at_distance_zero(m, CIPC_POINT_TRIANGLE, e1, t0, t1, t2) ||
           at_distance_zero(m, CIPC_EDGE_EDGE, e0, e1, t0, t1) || at_distance_zero(m, CIPC_EDGE_EDGE, e0, e1, t1, t2) ||
           at_distance_zero(m, CIPC_EDGE_EDGE, e0, e1, t2, t0) || pierces(m, e0, e1, t0, t1, t2);
}

cipc_verdict cipc_exact_edge_triangle(const double edge[6], const double triangle[9])
{
    if (!cipc_all_finite(edge, 6) || !cipc_all_finite(triangle, 9)) return CIPC_INDETERMINATE;
    meeting m;
    meeting_init(&m, edge, 2, triangle, 3);
    bool meet = edge_meets_triangle(&m, 0, 1, 2, 3, 4);
    meeting_clear(&m);
    return meet ? CIPC_YES : CIPC_NO;
}

/* Two triangles meet if an edge of one meets the other: two convex sets that meet, neither inside the other's relative interior alone, share a point of a
 * boundary; in one plane a corner of the inner one lies in the outer one. */
cipc_verdict cipc_exact_triangle_triangle(const double a[9], const double b[9])
{
    if (!cipc_all_finite(a, 9) || !cipc_all_finite(b, 9)) return CIPC_INDETERMINATE;
    meeting m;
    meeting_init(&m, a, 3, b, 3);
    bool meet = false;
    for (int i = 0; i < 3 && !meet; i++) {
        meet = edge_meets_triangle(&m, i, (i + 1) % 3, 3, 4, 5) || edge_meets_triangle(&m, 3 + i, 3 + (i + 1) % 3, 0, 1, 2);
    }
    meeting_clear(&m);
    return meet ? CIPC_YES : CIPC_NO;
}

int cipc_exact_orientation(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double points[12];
    const double *const corner[4] = {a, b, c, d};
    for (int i = 0; i < 12; i++) points[i] = corner[i / 3][i % 3];
    if (!cipc_all_finite(points, 12)) return 0;
    meeting m;
    meeting_init(&m, points, 2, points + 6, 2);
    int sign = volume_sign(&m, 0, 1, 2, 3);
    meeting_clear(&m);
    return sign;
}
