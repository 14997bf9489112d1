/* Points, cuts, and points moved onto cuts. */
#include "scene/cut_lattice.h"

#include <math.h>

#include "base/vector.h"

/* Cuts nearer to a point than these shares of a long and a short edge pull it onto the surface: Labelle and Shewchuk's, chosen for the best bound on the dihedral angles (10.7
 * degrees, on a smooth surface and with fine cells). */
static const double near_on_long = 0.24999, near_on_short = 0.41189;

enum { BISECTIONS = 100 };

void scene_lattice_free(scene_lattice *l)
{
    cipc_free(l->place);
    cipc_free(l->side);
    cipc_free(l->cut);
}

long long scene_lattice_point(const scene_lattice *l, bool middle, const int at[3])
{
    return (middle ? l->points / 2 : 0) + at[0] + (long long)l->count[0] * (at[2] + (long long)l->count[2] * at[1]);
}

long long scene_lattice_other_end(const scene_lattice *l, long long point, int slot)
{
    const long long stride[3] = {1, (long long)l->count[0] * l->count[2], l->count[0]};
    if (slot < SCENE_LONG_EDGES) return point + stride[slot];
    long long corner = point - l->points / 2;
    for (int a = 0; a < 3; a++) corner += ((slot - SCENE_LONG_EDGES) >> a & 1) * stride[a];
    return corner;
}

bool scene_lattice_has_edge(const scene_lattice *l, bool middle, const int at[3], int slot)
{
    for (int a = 0; a < 3; a++) {
        if (middle && at[a] + 1 >= l->count[a]) return false;
    }
    if (slot >= SCENE_LONG_EDGES) return middle;
    return at[slot] + (middle ? 2 : 1) < l->count[slot];
}

static cipc_status make_lattice(scene_lattice *l, const double low[3], const double high[3], double cell, const char *place, cipc_error *error)
{
    *l = (scene_lattice){.points = 2, .cell = cell};
    for (int a = 0; a < 3; a++) {
        /* A cell more at each side: all of its outermost points are outside, and the box does not touch what lies within. */
        double cells = ceil((high[a] - low[a]) / cell) + 2;
        if (!(cells < SCENE_NODES_MAX)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "cells of %g m in a box of %g m", cell, high[a] - low[a]);
        l->count[a] = (int)cells + 1;
        l->low[a] = 0.5 * (low[a] + high[a]) - 0.5 * cells * cell;
        l->points = scene_mesh_product(l->points, l->count[a]);
    }
    if (l->points > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "cells of %g m make a lattice of %lld points; at most %d are allowed", cell, l->points, SCENE_NODES_MAX);
    }
    size_t points = (size_t)l->points;
    l->place = cipc_alloc(3 * points, sizeof *l->place);
    l->side = cipc_alloc(points, sizeof *l->side);
    l->cut = cipc_alloc(SCENE_LATTICE_EDGES * points, sizeof *l->cut);
    if (l->place == NULL || l->side == NULL || l->cut == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a lattice of %lld points", l->points);
    }
    for (size_t i = 0; i < SCENE_LATTICE_EDGES * points; i++) l->cut[i] = -1;
    return CIPC_OK;
}

void scene_lattice_between(const scene_lattice *l, long long a, long long b, double share, double x[3])
{
    const double *p = l->place + 3 * a, *q = l->place + 3 * b;
    for (int k = 0; k < 3; k++) x[k] = p[k] + share * (q[k] - p[k]);
}

/* Where the edge passes the surface, from its first point on; its ends lie on different sides. */
static double find_cut(const scene_lattice *l, long long a, long long b, scene_depth depth, const void *shape)
{
    double low = 0, high = 1;
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (low + high), x[3];
        if (middle <= low || middle >= high) break;
        scene_lattice_between(l, a, b, middle, x);
        if ((depth(shape, x) > 0) == (l->side[a] > 0))
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Walk the points of the lattice, `visit` each that lies in the box. */
typedef void (*visitor)(scene_lattice *l, bool middle, const int at[3], scene_depth depth, const void *shape);
static void visit_points(scene_lattice *l, visitor visit, scene_depth depth, const void *shape)
{
    int at[3];
    for (int middle = 0; middle < 2; middle++) {
        for (at[1] = 0; at[1] + middle < l->count[1]; at[1]++) {
            for (at[2] = 0; at[2] + middle < l->count[2]; at[2]++) {
                for (at[0] = 0; at[0] + middle < l->count[0]; at[0]++) visit(l, middle, at, depth, shape);
            }
        }
    }
}

static void place_point(scene_lattice *l, bool middle, const int at[3], scene_depth depth, const void *shape)
{
    long long point = scene_lattice_point(l, middle, at);
    for (int a = 0; a < 3; a++) l->place[3 * point + a] = l->low[a] + (at[a] + (middle ? 0.5 : 0)) * l->cell;
    double d = depth(shape, l->place + 3 * point);
    l->side[point] = (signed char)((d > 0) - (d < 0));
}

static void cut_edges(scene_lattice *l, bool middle, const int at[3], scene_depth depth, const void *shape)
{
    long long point = scene_lattice_point(l, middle, at);
    for (int slot = 0; slot < SCENE_LATTICE_EDGES; slot++) {
        if (!scene_lattice_has_edge(l, middle, at, slot)) continue;
        long long other = scene_lattice_other_end(l, point, slot);
        if (l->side[point] * l->side[other] < 0) l->cut[SCENE_LATTICE_EDGES * point + slot] = find_cut(l, point, other, depth, shape);
    }
}

/* The edges that meet at a point, by their place in `cut` and the share of the cut from this end. */
typedef struct end {
    long long edge, other;
    bool first; /* this point owns the edge */
} end;
static int ends_at(const scene_lattice *l, bool middle, const int at[3], end ends[2 * SCENE_LONG_EDGES + SCENE_SHORT_EDGES])
{
    int count = 0;
    long long point = scene_lattice_point(l, middle, at);
    for (int slot = 0; slot < SCENE_LATTICE_EDGES; slot++) {
        if (scene_lattice_has_edge(l, middle, at, slot)) ends[count++] = (end){SCENE_LATTICE_EDGES * point + slot, scene_lattice_other_end(l, point, slot), true};
    }
    for (int a = 0; a < SCENE_LONG_EDGES; a++) {
        int before[3] = {at[0] - (a == 0), at[1] - (a == 1), at[2] - (a == 2)};
        if (before[a] < 0) continue;
        long long owner = scene_lattice_point(l, middle, before);
        ends[count++] = (end){SCENE_LATTICE_EDGES * owner + a, owner, false};
    }
    for (int bits = 0; bits < SCENE_SHORT_EDGES && !middle; bits++) {
        const int owner[3] = {at[0] - (bits & 1), at[1] - (bits >> 1 & 1), at[2] - (bits >> 2 & 1)};
        if (owner[0] < 0 || owner[1] < 0 || owner[2] < 0 || !scene_lattice_has_edge(l, true, owner, SCENE_LONG_EDGES + bits)) continue;
        long long center = scene_lattice_point(l, true, owner);
        ends[count++] = (end){SCENE_LATTICE_EDGES * center + SCENE_LONG_EDGES + bits, center, false};
    }
    return count;
}

/* Move the point onto the nearest of the cuts that are too near to it. */
static void snap(scene_lattice *l, bool middle, const int at[3], scene_depth depth, const void *shape)
{
    end ends[2 * SCENE_LONG_EDGES + SCENE_SHORT_EDGES];
    const end *nearest = NULL;
    double least = INFINITY;
    long long point = scene_lattice_point(l, middle, at);
    (void)depth;
    (void)shape;
    if (l->side[point] == 0) return;
    int count = ends_at(l, middle, at, ends);
    for (int e = 0; e < count; e++) {
        double share = l->cut[ends[e].edge];
        if (share < 0) continue;
        bool is_long = ends[e].edge % SCENE_LATTICE_EDGES < SCENE_LONG_EDGES;
        share = ends[e].first ? share : 1 - share;
        double distance = share * (is_long ? 1 : sqrt(0.75));
        if (share > (is_long ? near_on_long : near_on_short) || distance >= least) continue;
        nearest = &ends[e];
        least = distance;
    }
    if (nearest == NULL) return;
    double x[3], share = l->cut[nearest->edge];
    if (nearest->first)
        scene_lattice_between(l, point, nearest->other, share, x);
    else
        scene_lattice_between(l, nearest->other, point, share, x);
    v3_copy(l->place + 3 * point, x);
    l->side[point] = 0;
    for (int e = 0; e < count; e++) l->cut[ends[e].edge] = -1;
}

cipc_status scene_lattice_init(scene_lattice *l, scene_depth depth, const void *shape, const double low[3], const double high[3], double cell, const char *place,
                               cipc_error *error)
{
    cipc_status status = make_lattice(l, low, high, cell, place, error);
    if (status != CIPC_OK) return status;
    visit_points(l, place_point, depth, shape);
    visit_points(l, cut_edges, depth, shape);
    visit_points(l, snap, depth, shape);
    return CIPC_OK;
}
