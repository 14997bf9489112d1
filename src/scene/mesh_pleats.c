/* Knife pleats: cloth that goes forward around the body, back under itself, and forward again.
 *
 * With the way around the body to the right and the radius up, one pleat of pitch p and depth u is
 *
 *            ..--''|                 forward by p + u and outward by 2 a (p + u) / p,
 *      ..--'' ..--'|  <- fold        inward by a: the outer fold,
 *    |''..--''                       back by u, parallel to the way forward,
 *    | <- fold                       inward by a: the inner fold, where the next pleat begins.
 *
 * All layers are parallel and the gap a apart, however deep the pleats. */
#include <math.h>

#include "scene/mesh.h"
#include "scene/mesh_panels.h"

static const char place[] = "pleats";
static const double two_pi = 6.28318530717958647693;

/* Angles and radii of a pleat. */
typedef struct fold {
    double pitch, depth; /* rad */
    double gap, rise;    /* m; rise: of the way forward */
    double inner;        /* m */
} fold;

static fold measure(const cipc_panel_ring *ring, const cipc_pleating *pleats)
{
    fold f = {.pitch = two_pi / pleats->count, .depth = pleats->depth / ring->top, .gap = pleats->gap};
    f.rise = 2 * f.gap * (f.pitch + f.depth) / f.pitch;
    f.inner = ring->top - f.rise / 2;
    return f;
}

/* Columns are chords, which leave their arc by r (1 - cos(half an angle)). That must leave half the gap between one layer and the next. */
static double largest_sagitta(const cipc_panel_ring *ring, const cipc_pleating *pleats, const fold *f)
{
    double column = fmax((f->pitch + f->depth) / pleats->forward, f->depth / pleats->back);
    return (ring->top + f->rise / 2) * (1 - cos(column / 2));
}

static cipc_status check_counts(const cipc_panel_ring *ring, const cipc_pleating *pleats, cipc_error *error)
{
    if (pleats->count < 3 || pleats->count > SCENE_NODES_MAX || pleats->count % ring->panels != 0)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d pleats in %d panels; 3 pleats or more are needed, as many in each panel",
                         pleats->count, ring->panels);
    if (pleats->forward < 1 || pleats->back < 1 || pleats->forward > SCENE_NODES_MAX || pleats->back > SCENE_NODES_MAX)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place,
                         "pleats of %d cells forward and %d back; 1 of each is needed, at most %d allowed", pleats->forward, pleats->back,
                         SCENE_NODES_MAX);
    return CIPC_OK;
}

static cipc_status check(const cipc_panel_ring *ring, const cipc_pleating *pleats, cipc_error *error)
{
    cipc_status status = scene_check_panel_ring(ring, place, error);
    if (status == CIPC_OK) status = check_counts(ring, pleats, error);
    if (status != CIPC_OK) return status;
    if (!(pleats->depth > 0 && pleats->gap > 0 && isfinite(pleats->depth) && isfinite(pleats->gap)))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "pleats %g m deep, their layers %g m apart", pleats->depth, pleats->gap);
    fold f = measure(ring, pleats);
    if (!(f.inner > 0 && f.pitch + f.depth < two_pi / 2))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d pleats %g m deep, of layers %g m apart, have no room around radius %g m",
                         pleats->count, pleats->depth, pleats->gap, ring->top);
    double sagitta = largest_sagitta(ring, pleats, &f);
    if (sagitta > f.gap / 2)
        return cipc_fail(
            error, CIPC_E_OUT_OF_RANGE, place,
            "layers %g m apart, but columns so wide that they leave the circle by %.3g m: more cells forward and back, or a larger gap",
            f.gap, sagitta);
    return CIPC_OK;
}

static void add_point(double (*curve)[2], int *count, double angle, double radius)
{
    curve[*count][0] = radius * cos(angle);
    curve[*count][1] = -radius * sin(angle);
    ++*count;
}

/* The points of one pleat that begins at an angle, but the last, which is the next one's first. */
static void add_pleat(double (*curve)[2], int *count, const cipc_pleating *pleats, const fold *f, double begin)
{
    double outer = f->inner + f->rise - f->gap;
    for (int i = 0; i <= pleats->forward; i++) {
        double part = (double)i / pleats->forward;
        add_point(curve, count, begin + part * (f->pitch + f->depth), f->inner + part * f->rise);
    }
    for (int i = 0; i <= pleats->back; i++) {
        double part = (double)i / pleats->back;
        add_point(curve, count, begin + f->pitch + (1 - part) * f->depth, outer + part * (f->inner + f->gap - outer));
    }
}

cipc_status cipc_mesh_pleats(cipc_mesh *mesh, const cipc_panel_ring *ring, const cipc_pleating *pleats, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(ring, pleats, error);
    if (status != CIPC_OK) return status;
    long long columns = scene_mesh_product(pleats->count, (long long)pleats->forward + pleats->back + 2);
    if (columns > SCENE_NODES_MAX)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%lld columns; at most %d are allowed", columns, SCENE_NODES_MAX);
    double(*curve)[2] = cipc_alloc((size_t)columns + 1, sizeof *curve);
    if (curve == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %lld columns", columns);
    fold f = measure(ring, pleats);
    int count = 0;
    for (int k = 0; k < pleats->count; k++) add_pleat(curve, &count, pleats, &f, k * f.pitch);
    for (int k = 0; k < 2; k++) curve[columns][k] = curve[0][k];
    status = scene_mesh_panels(mesh, ring, (int)columns / ring->panels, (const double(*)[2])curve, place, error);
    cipc_free(curve);
    return status;
}
