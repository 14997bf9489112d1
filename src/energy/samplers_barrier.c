/* Samplers of the contact barriers: from inactive to a gap of 1e-9 of the thickness, every closest-feature case, mollifier on and off. */
#include "base/vector.h"
#include "energy/samplers.h"

/* --- how far: common to all kinds --- */

const char *const energy_contact_branch_names[ENERGY_CONTACT_BRANCHES] = {"inactive",      "onset", "thin",
                                                                          "thin_tiny_gap", "thick", "thick_tiny_gap"};
const char *const energy_point_edge_branch_names[ENERGY_POINT_EDGE_BRANCHES] = {
    "inactive", "onset", "thin", "thin_tiny_gap", "thick", "thick_tiny_gap", "short_edge",
};
const char *const energy_point_triangle_branch_names[ENERGY_POINT_TRIANGLE_BRANCHES] = {
    "inactive", "onset", "thin", "thin_tiny_gap", "thick", "thick_tiny_gap", "sliver",
};
enum { INACTIVE = 0, ONSET, THIN, THIN_TINY, THICK, THICK_TINY, ODD_SHAPE };
/* D > (1 - ONSET_SHARE) Dhat is onset; a tiny gap is below TINY_THIN dhat without thickness, below TINY_THICK xi with it. */
static const double ONSET_SHARE = 2e-3, TINY_THIN = 2e-4, TINY_THICK = 2e-6;

/* Parameters for a regime; returns the distance d. */
static double draw_regime(gsl_rng *rng, int regime, cipc_contact_barrier *p)
{
    bool thick = regime == THICK || regime == THICK_TINY || ((regime == INACTIVE || regime == ONSET) && energy_draw_index(rng, 2));
    *p = (cipc_contact_barrier){.stiffness = energy_draw_log(rng, 1, 1e6), .weight = energy_draw_uniform(rng, 0.5, 3)};
    p->offset = thick ? energy_draw_log(rng, regime == THICK_TINY ? 3e-3 : 1e-3, 1e-2) : 0;
    p->dhat = energy_draw_log(rng, 1e-4, 1e-2);
    double xi = p->offset, reach = xi + p->dhat, Dhat = p->dhat * (2 * xi + p->dhat);
    switch (regime) {
    case INACTIVE:
        return reach * energy_draw_uniform(rng, 1.001, 2);
    case ONSET:
        return sqrt(xi * xi + Dhat * (1 - energy_draw_log(rng, 1e-5, 0.9 * ONSET_SHARE)));
    case THIN_TINY:
        return p->dhat * energy_draw_log(rng, 1e-6, 0.9 * TINY_THIN);
    case THICK_TINY:
        return xi * (1 + energy_draw_log(rng, 1e-9, 0.9 * TINY_THICK));
    default:
        return xi + p->dhat * energy_draw_uniform(rng, 0.01, 0.95);
    }
}

static int regime_of(double distance2, const cipc_contact_barrier *p)
{
    double xi = p->offset, D = distance2 - xi * xi, Dhat = p->dhat * (2 * xi + p->dhat), gap = sqrt(distance2) - xi;
    if (D >= Dhat) return INACTIVE;
    if (D > (1 - ONSET_SHARE) * Dhat) return ONSET;
    if (xi > 0) return gap <= TINY_THICK * xi ? THICK_TINY : THICK;
    return gap <= TINY_THIN * p->dhat ? THIN_TINY : THIN;
}

static int draw_near_regime(gsl_rng *rng)
{
    return energy_draw_index(rng, 2) ? THIN : THICK;
}

/* Size of the stencil. A tiny gap is drawn on a small one: the rounding of coordinates is to stay small against the gap. */
static double draw_size(gsl_rng *rng, int regime)
{
    return energy_draw_log(rng, 0.01, regime == THIN_TINY || regime == THICK_TINY ? 0.05 : 0.3);
}

/* --- points --- */

void energy_sample_barrier_point_point(gsl_rng *rng, int branch, double *x, void *params)
{
    double local[6] = {draw_regime(rng, branch, params)};
    energy_draw_placement(rng, draw_size(rng, branch), 2, local, x);
}

int energy_branch_barrier_point_point(const double *x, const void *params)
{
    return regime_of(cipc_point_point_distance2_value(x), params);
}

static const double SHORT_EDGE = 0.2; /* of the distance */

void energy_sample_barrier_point_edge(gsl_rng *rng, int branch, double *x, void *params)
{
    double d = draw_regime(rng, branch == ODD_SHAPE ? THICK : branch, params), size = draw_size(rng, branch), length = size;
    if (branch == ODD_SHAPE) length = d * energy_draw_log(rng, 0.01, 0.9 * SHORT_EDGE);
    double foot = energy_draw_uniform(rng, 0, 1);
    double local[9] = {foot * length, d, 0, 0, 0, 0, length, 0, 0};
    energy_draw_placement(rng, branch == ODD_SHAPE ? d : size, 3, local, x);
}

int energy_branch_barrier_point_edge(const double *x, const void *params)
{
    double edge[3], distance2 = cipc_point_line_distance2_value(x);
    v3_sub(edge, x + 6, x + 3);
    int regime = regime_of(distance2, params);
    if (regime != INACTIVE && v3_norm2(edge) < SHORT_EDGE * SHORT_EDGE * distance2) return ODD_SHAPE;
    return regime;
}

static const double SLIVER_RATIO = 0.02; /* height over base */

void energy_sample_barrier_point_triangle(gsl_rng *rng, int branch, double *x, void *params)
{
    double d = draw_regime(rng, branch == ODD_SHAPE ? draw_near_regime(rng) : branch, params), size = draw_size(rng, branch);
    double triangle[9], local[12] = {0}, u = energy_draw_uniform(rng, 0, 1), v = energy_draw_uniform(rng, 0, 1 - u);
    energy_draw_triangle(rng, size, 0.2, triangle);
    if (branch == ODD_SHAPE) triangle[7] = size * energy_draw_log(rng, 1e-3, 0.9 * SLIVER_RATIO);
    for (int k = 0; k < 3; k++) local[k] = u * triangle[3 + k] + v * triangle[6 + k];
    local[2] = energy_draw_index(rng, 2) ? d : -d; /* either side */
    for (int i = 0; i < 9; i++) local[3 + i] = triangle[i];
    energy_draw_placement(rng, size, 4, local, x);
}

int energy_branch_barrier_point_triangle(const double *x, const void *params)
{
    double base[3], side[3], normal[3];
    v3_sub(base, x + 6, x + 3);
    v3_sub(side, x + 9, x + 3);
    v3_cross(normal, base, side);
    int regime = regime_of(cipc_point_plane_distance2_value(x), params);
    if (regime != INACTIVE && v3_norm(normal) < SLIVER_RATIO * v3_norm2(base)) return ODD_SHAPE;
    return regime;
}

/* --- edges --- */

const char *const energy_edge_edge_branch_names[ENERGY_EDGE_EDGE_BRANCHES] = {
    "inactive",
    "onset",
    "thin",
    "thin_tiny_gap",
    "thick",
    "thick_tiny_gap",
    "mollifier_idle",
    "plain_point_edge",
    "plain_point_point",
    "mollified_tiny_gap",
    "mollified_line_line",
    "mollified_a0_b",
    "mollified_a1_b",
    "mollified_b0_a",
    "mollified_b1_a",
    "mollified_a0_b0",
    "mollified_a0_b1",
    "mollified_a1_b0",
    "mollified_a1_b1",
};
enum { IDLE = 6, PLAIN_POINT_EDGE, PLAIN_POINT_POINT, MOLLIFIED_TINY, MOLLIFIED };
/* Subtypes of the closest features, in the order of the last nine branches. */
enum { LINE_LINE = 0, A0_B, A1_B, B0_A, B1_A, A0_B0, A0_B1, A1_B0, A1_B1, SUBTYPES };
static const cipc_feature features[SUBTYPES] = {
    {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}},   {CIPC_POINT_EDGE, 3, {0, 2, 3, 0}},  {CIPC_POINT_EDGE, 3, {1, 2, 3, 0}},
    {CIPC_POINT_EDGE, 3, {2, 0, 1, 0}},  {CIPC_POINT_EDGE, 3, {3, 0, 1, 0}},  {CIPC_POINT_POINT, 2, {0, 2, 0, 0}},
    {CIPC_POINT_POINT, 2, {0, 3, 0, 0}}, {CIPC_POINT_POINT, 2, {1, 2, 0, 0}}, {CIPC_POINT_POINT, 2, {1, 3, 0, 0}},
};
/* eps_x = MOLLIFIER_SHARE |a|^2 |b|^2 of the rest edges (SPEC D.3). */
static const double MOLLIFIER_SHARE = 1e-3;

static void swap_nodes(double *x, int i, int j)
{
    double kept[3];
    v3_copy(kept, x + 3 * i);
    v3_copy(x + 3 * i, x + 3 * j);
    v3_copy(x + 3 * j, kept);
}

/* Edges at distance d, crossing at the angle `turn`, whose closest features are of the given subtype: edge b lies on the first axis, edge a
 * passes over it (line-line), or starts over its inside (a0 - b) or beyond its end b0 (a0 - b0) and leads away. */
static void place_edges(gsl_rng *rng, int subtype, double turn, double d, double size, double local[12])
{
    double b_length = size, a_length = size * energy_draw_log(rng, 0.5, 2), foot = energy_draw_uniform(rng, 0.15, 0.85);
    double a_foot = energy_draw_uniform(rng, 0.15, 0.85), c = cos(turn), s = sin(turn);
    double b[6] = {-foot * b_length, 0, 0, (1 - foot) * b_length, 0, 0}, start[3] = {0, 0, d}, direction[3] = {c, s, 0};
    if (subtype == LINE_LINE) {
        start[0] = -a_foot * a_length * c;
        start[1] = -a_foot * a_length * s;
    } else {
        /* The second axis and the third share the turn, both away from b. */
        double share = energy_draw_uniform(rng, 0.2, 0.8);
        direction[1] = s * sqrt(share);
        direction[2] = s * sqrt(1 - share);
    }
    if (subtype >= A0_B0) { /* beyond b0, leading away from it backwards */
        start[0] = b[0] - 0.6 * d;
        start[2] = 0.8 * d;
        direction[0] = -c;
    }
    v3_copy(local, start);
    v3_copy(local + 3, start);
    v3_axpy(local + 3, a_length, direction);
    for (int i = 0; i < 6; i++) local[6 + i] = b[i];
    /* From the first subtype of its kind, a0 - b or a0 - b0, to the one wanted: turn an edge around, or exchange the two. */
    if (subtype == A1_B || subtype == B1_A || subtype == A1_B0 || subtype == A1_B1) swap_nodes(local, 0, 1);
    if (subtype == A0_B1 || subtype == A1_B1) swap_nodes(local, 2, 3);
    if (subtype == B0_A || subtype == B1_A) {
        swap_nodes(local, 0, 2);
        swap_nodes(local, 1, 3);
    }
}

static double length2(const double x[12], int edge)
{
    double e[3];
    v3_sub(e, x + 6 * edge + 3, x + 6 * edge);
    return v3_norm2(e);
}

/* The subtype, the distance regime and whether the mollifier acts, for each branch. */
static void plan(gsl_rng *rng, int branch, int *subtype, int *regime, bool *near_parallel)
{
    *subtype = LINE_LINE;
    *regime = branch <= THICK_TINY ? branch : draw_near_regime(rng);
    *near_parallel = branch >= MOLLIFIED_TINY;
    if (branch == PLAIN_POINT_EDGE) *subtype = A0_B + energy_draw_index(rng, 4);
    if (branch == PLAIN_POINT_POINT) *subtype = A0_B0 + energy_draw_index(rng, 4);
    if (branch >= MOLLIFIED) *subtype = branch - MOLLIFIED;
    if (branch == MOLLIFIED_TINY) {
        *subtype = energy_draw_index(rng, SUBTYPES);
        *regime = energy_draw_index(rng, 2) ? THIN_TINY : THICK_TINY;
    }
}

void energy_sample_barrier_edge_edge(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_contact_barrier *p = params;
    int subtype, regime;
    bool near_parallel;
    plan(rng, branch, &subtype, &regime, &near_parallel);
    double d = draw_regime(rng, regime, p), size = draw_size(rng, regime), local[12];
    /* sin^2(turn) against MOLLIFIER_SHARE decides whether the mollifier acts. */
    double turn = near_parallel ? energy_draw_log(rng, 2e-3, 0.028) : energy_draw_uniform(rng, 0.1, 1.5);
    place_edges(rng, subtype, turn, d, size, local);
    energy_draw_placement(rng, size, 4, local, x);
    p->feature = features[subtype];
    p->mollifier_eps = near_parallel || branch == IDLE ? MOLLIFIER_SHARE * length2(x, 0) * length2(x, 1) : 0;
}

static int subtype_of(const cipc_feature *feature)
{
    int subtype = 0;
    while (subtype < SUBTYPES - 1 && !(features[subtype].kind == feature->kind && features[subtype].local[0] == feature->local[0] &&
                                       features[subtype].local[1] == feature->local[1])) {
        subtype++;
    }
    return subtype;
}

int energy_branch_barrier_edge_edge(const double *x, const void *params)
{
    const cipc_contact_barrier *p = params;
    double part[12];
    for (int i = 0; i < 3 * p->feature.count; i++) part[i] = x[3 * p->feature.local[i / 3] + i % 3];
    int regime = regime_of(cipc_distance2_value(p->feature.kind, part), p);
    if (regime == INACTIVE) return INACTIVE;
    if (p->mollifier_eps > 0 && cipc_edge_edge_cross2(x) < p->mollifier_eps) {
        return regime == THIN_TINY || regime == THICK_TINY ? MOLLIFIED_TINY : MOLLIFIED + subtype_of(&p->feature);
    }
    if (p->feature.kind == CIPC_POINT_EDGE) return PLAIN_POINT_EDGE;
    if (p->feature.kind == CIPC_POINT_POINT) return PLAIN_POINT_POINT;
    return p->mollifier_eps > 0 ? IDLE : regime;
}
