/* Samplers of rods, stitches and damping. */
#include "base/vector.h"
#include "energy/samplers.h"

/* Round rods from hair (80 micrometres, 0.4 GPa) to noodles (1.5 mm, 1 kPa), in segments of 2 mm to 3 cm. */
static const double THINNEST = 8e-5, THICKEST = 1.5e-3, SOFTEST = 1e3, STIFFEST = 4e8, SHORTEST = 2e-3, LONGEST = 3e-2;

static double draw_length(gsl_rng *rng) { return energy_draw_log(rng, SHORTEST, LONGEST); }

/* --- stretching --- */

const char *const energy_rod_stretching_branch_names[ENERGY_ROD_STRETCHING_BRANCHES] = {"rest", "stretched", "compressed", "near_collapsed"};
enum { REST = 0, STRETCHED, COMPRESSED, NEAR_COLLAPSED };
static const double REST_STRAIN = 1e-6, COLLAPSED_STRETCH = 0.01;

static double draw_stretch(gsl_rng *rng, int branch)
{
    switch (branch) {
    case REST:
        return 1;
    case STRETCHED:
        return 1 + energy_draw_log(rng, 1.1 * REST_STRAIN, 1);
    case COMPRESSED:
        return 1 - energy_draw_log(rng, 1.1 * REST_STRAIN, 0.98);
    default:
        return energy_draw_log(rng, 1e-6, 0.99 * COLLAPSED_STRETCH);
    }
}

void energy_sample_rod_stretching(gsl_rng *rng, int branch, double *x, void *params)
{
    double length = draw_length(rng), diameter = energy_draw_log(rng, THINNEST, THICKEST), young = energy_draw_log(rng, SOFTEST, STIFFEST);
    const double rest[6] = {0, 0, 0, length, 0, 0}, local[6] = {0, 0, 0, length * draw_stretch(rng, branch), 0, 0};
    (void)cipc_rod_stretching_init(params, rest, diameter, young);
    energy_draw_placement(rng, length, 2, local, x);
}

int energy_branch_rod_stretching(const double *x, const void *params)
{
    double edge[3];
    v3_sub(edge, x + 3, x);
    double stretch = v3_norm(edge) / ((const cipc_rod_stretching *)params)->length;
    if (stretch < COLLAPSED_STRETCH) return NEAR_COLLAPSED;
    if (fabs(stretch - 1) < REST_STRAIN) return REST;
    return stretch > 1 ? STRETCHED : COMPRESSED;
}

/* --- bending: shapes of a straight rod, then of one that is curved at rest. Exactly straight, a curved rod has no derivatives: it is not aimed at --- */

const char *const energy_rod_bending_branch_names[ENERGY_ROD_BENDING_BRANCHES] = {
    "straight", "small", "large", "near_folded", "short_segment", "at_curved_rest", "small_curved_rest", "large_curved_rest", "near_folded_curved_rest", "short_segment_curved_rest",
};
enum { STRAIGHT = 0, SMALL, LARGE, NEAR_FOLDED, SHORT_SEGMENT, BENDING_SHAPES, AT_CURVED_REST = BENDING_SHAPES };
static const double STRAIGHT_ANGLE = 1e-8, SMALL_ANGLE = 0.01, FOLDED_ANGLE = 3, SHORT_RATIO = 0.02, AT_REST_SHARE = 1e-6;

static double draw_angle(gsl_rng *rng, int branch, double rest_curvature)
{
    if (branch == STRAIGHT) return 0;
    if (branch == AT_CURVED_REST) return 2 * atan(0.5 * rest_curvature);
    switch (branch % BENDING_SHAPES) {
    case SMALL:
        return energy_draw_log(rng, 1e-7, 0.99 * SMALL_ANGLE);
    case NEAR_FOLDED:
        return M_PI - energy_draw_log(rng, 1e-5, 0.99 * (M_PI - FOLDED_ANGLE));
    default:
        return energy_draw_uniform(rng, 1.01 * SMALL_ANGLE, 0.99 * FOLDED_ANGLE);
    }
}

void energy_sample_rod_bending(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_rod_bending *p = params;
    double a = draw_length(rng), b = draw_length(rng), diameter = energy_draw_log(rng, THINNEST, THICKEST), young = energy_draw_log(rng, SOFTEST, STIFFEST);
    const double rest[9] = {-a, 0, 0, 0, 0, 0, b, 0, 0};
    (void)cipc_rod_bending_init(p, rest, diameter, young, false);
    if (branch >= BENDING_SHAPES) p->rest_curvature = energy_draw_log(rng, 1e-3, 3);
    double angle = draw_angle(rng, branch, p->rest_curvature);
    a *= energy_draw_uniform(rng, 0.9, 1.1);
    b *= energy_draw_uniform(rng, 0.9, 1.1);
    if (branch % BENDING_SHAPES == SHORT_SEGMENT) *(energy_draw_index(rng, 2) ? &a : &b) = fmin(a, b) * energy_draw_log(rng, 1e-4, 0.99 * SHORT_RATIO);
    const double local[9] = {-a, 0, 0, 0, 0, 0, b * cos(angle), b * sin(angle), 0};
    energy_draw_placement(rng, a + b, 3, local, x);
}

int energy_branch_rod_bending(const double *x, const void *params)
{
    double rest = ((const cipc_rod_bending *)params)->rest_curvature, e0[3], e1[3], cross[3];
    int first = rest > 0 ? BENDING_SHAPES : 0;
    v3_sub(e0, x + 3, x);
    v3_sub(e1, x + 6, x + 3);
    v3_cross(cross, e0, e1);
    double a = v3_norm(e0), b = v3_norm(e1), angle = atan2(v3_norm(cross), v3_dot(e0, e1));
    if (fmin(a, b) < SHORT_RATIO * fmax(a, b)) return first + SHORT_SEGMENT;
    if (rest > 0 && fabs(2 * tan(0.5 * angle) - rest) < AT_REST_SHARE * rest) return AT_CURVED_REST;
    if (rest == 0 && angle < STRAIGHT_ANGLE) return STRAIGHT;
    if (angle < SMALL_ANGLE) return first + SMALL;
    return first + (angle < FOLDED_ANGLE ? LARGE : NEAR_FOLDED);
}

/* --- stitches --- */

const char *const energy_stitch_branch_names[ENERGY_STITCH_BRANCHES] = {"at_first", "at_second", "inside", "closed"};
enum { AT_FIRST = 0, AT_SECOND, INSIDE, CLOSED };
static const double CLOSED_SHARE = 1e-9; /* gap over the edge's length */

void energy_sample_stitch(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_stitch *p = params;
    double length = energy_draw_log(rng, 1e-3, 0.3), angle = energy_draw_uniform(rng, -M_PI, M_PI), gap = length * energy_draw_log(rng, 1e-6, 10);
    p->stiffness = energy_draw_log(rng, 1, 1e3);
    p->ratio = branch == AT_FIRST ? 0 : branch == AT_SECOND ? 1 : energy_draw_uniform(rng, 0.01, 0.99);
    if (branch == CLOSED) gap = 0;
    const double local[9] = {p->ratio * length + gap * cos(angle), gap * sin(angle), 0, 0, 0, 0, length, 0, 0};
    energy_draw_placement(rng, length, 3, local, x);
}

int energy_branch_stitch(const double *x, const void *params)
{
    double r = ((const cipc_stitch *)params)->ratio, edge[3], gap[3];
    v3_sub(edge, x + 6, x + 3);
    v3_sub(gap, x, x + 3);
    v3_axpy(gap, -r, edge);
    if (v3_norm(gap) < CLOSED_SHARE * v3_norm(edge)) return CLOSED;
    return r == 0 ? AT_FIRST : r == 1 ? AT_SECOND : INSIDE;
}

/* --- damping: elements of two, three, four nodes, whose stiffness knows no translation; one that is held to its place ("grounded"); one that moves by many
 * times its size while it hardly deforms ("in_flight") --- */

const char *const energy_damping_branch_names[ENERGY_DAMPING_BRANCHES] = {"two_nodes", "three_nodes", "four_nodes", "grounded", "at_start", "in_flight"};
enum { TWO_NODES = 0, THREE_NODES, FOUR_NODES, GROUNDED, AT_START, IN_FLIGHT };
static const double GROUNDED_SHARE = 1e-6; /* largest sum of a row over the largest entry */
static const double FLIGHT_SHARE = 0.05;   /* what nodes move against the first one, over what that one moves */

/* H := size times a sum of `rank` dyads a a^T of random vectors; free: without a common translation. */
static void draw_stiffness(gsl_rng *rng, int nodes, int rank, double size, bool free, double *H)
{
    int n = 3 * nodes;
    double a[12];
    for (int i = 0; i < n * n; i++) H[i] = 0;
    for (int r = 0; r < rank; r++) {
        for (int i = 0; i < n; i++) a[i] = energy_draw_uniform(rng, -1, 1);
        for (int k = 0; free && k < 3; k++) {
            double mean = 0;
            for (int i = k; i < n; i += 3) mean += a[i] / nodes;
            for (int i = k; i < n; i += 3) a[i] -= mean;
        }
        for (int i = 0; i < n * n; i++) H[i] += size * a[i / n] * a[i % n];
    }
}

/* A displacement that the stiffness resists: |H d| is this share of |H||d| at least (largest entries). In a direction that H hardly knows, value and gradient
 * are what the rounding of its entries makes of them, and no differences decide anything. */
static const double RESISTED_SHARE = 0.25;

static bool resisted(const double *H, int n, double moved, const double *d)
{
    double force = 0, largest = 0;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++) {
            sum += H[n * i + j] * d[j];
            largest = fmax(largest, fabs(H[n * i + j]));
        }
        force = fmax(force, fabs(sum));
    }
    return force >= RESISTED_SHARE * largest * moved;
}

/* What every node moves for itself, at most `moved` per coordinate. */
static void draw_deformation(gsl_rng *rng, const double *H, int n, double moved, double d[12])
{
    do {
        for (int i = 0; i < n; i++) d[i] = energy_draw_uniform(rng, -moved, moved);
    } while (!resisted(H, n, moved, d));
}

/* The common way of all nodes, and the bound of what each moves besides. */
static void draw_flight(gsl_rng *rng, double size, double flight[3], double *moved)
{
    double R[3][3], way = size * energy_draw_log(rng, 1, 30);
    energy_draw_rotation(rng, R);
    v3_scale(flight, way, R[0]);
    *moved = way * energy_draw_log(rng, 1e-4, 0.2 * FLIGHT_SHARE);
}

void energy_sample_damping(gsl_rng *rng, int branch, double *x, void *params)
{
    double size = energy_draw_log(rng, 1e-3, 0.1), moved = size * energy_draw_log(rng, 1e-6, 3), flight[3] = {0}, start[12], d[12], H[144];
    int nodes = branch <= FOUR_NODES ? 2 + branch : branch == GROUNDED ? 4 : 2 + energy_draw_index(rng, 3);
    int rank = 1 + energy_draw_index(rng, branch == GROUNDED ? 12 : 3 * nodes - 3);
    if (branch == IN_FLIGHT) draw_flight(rng, size, flight, &moved);
    draw_stiffness(rng, nodes, rank, energy_draw_log(rng, 1e-3, 1e4), branch != GROUNDED, H);
    draw_deformation(rng, H, 3 * nodes, moved, d);
    for (int i = 0; i < 12; i++) {
        start[i] = energy_draw_uniform(rng, -size, size);
        x[i] = i < 3 * nodes ? start[i] + (branch == AT_START ? 0 : flight[i % 3] + d[i]) : 0;
    }
    cipc_damping_init(params, energy_draw_log(rng, 1e-4, 10), nodes, start, H);
}

/* Sums of rows of K over nodes, that is K times the three translations: the largest, over the largest entry. */
static double resistance_to_translation(const double K[144])
{
    double most = 0, largest = 0;
    for (int i = 0; i < 12; i++) {
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int j = k; j < 12; j += 3) {
                sum += K[12 * i + j];
                largest = fmax(largest, fabs(K[12 * i + j]));
            }
            most = fmax(most, fabs(sum));
        }
    }
    return most / largest;
}

/* d of a node. */
static void displacement(const double *x, const cipc_damping *p, int node, double d[3]) { v3_sub(d, x + 3 * node, p->start + 3 * node); }

int energy_branch_damping(const double *x, const void *params)
{
    const cipc_damping *p = params;
    double K[144];
    double first[3], most = 0, apart = 0;
    int nodes = 4;
    cipc_damping_hessian(x, p, K);
    while (nodes > 2 && K[13 * (3 * nodes - 1)] == 0) nodes--; /* an absent node has a zero diagonal */
    displacement(x, p, 0, first);
    for (int i = 0; i < nodes; i++) {
        double d[3];
        displacement(x, p, i, d);
        most = fmax(most, v3_norm(d));
        v3_sub(d, d, first);
        apart = fmax(apart, v3_norm(d));
    }
    if (most == 0) return AT_START;
    if (apart < FLIGHT_SHARE * v3_norm(first)) return IN_FLIGHT;
    return resistance_to_translation(K) > GROUNDED_SHARE ? GROUNDED : TWO_NODES + nodes - 2;
}
