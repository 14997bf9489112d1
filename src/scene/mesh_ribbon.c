/* A ribbon along a smooth curve: cross-sections at equal lengths of the curve, each a straight line across it and across the ribbon's normal. */
#include <math.h>

#include "base/vector.h"
#include "scene/mesh.h"
#include "scene/smooth_curve.h"

static const char place[] = "ribbon";
/* A triangle whose area, seen along the ribbon's normal, is a smaller share than this of half a flat cell has no size, or is turned over. A ribbon that turns in its own
 * plane with radius R has cells of 1 - w/(2 R) of their length at the inner edge. */
static const double least_share = 1e-3;
static const double least_across = 1e-6; /* sine of the angle between curve and normal: below it the width has no direction */

static cipc_status check(const cipc_ribbon *ribbon, cipc_error *error)
{
    if (!(ribbon->width > 0 && isfinite(ribbon->width))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a width of %g m", ribbon->width);
    if (ribbon->along < 1 || ribbon->across < 1) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d cells", ribbon->along, ribbon->across);
    }
    return CIPC_OK;
}

/* The normal made perpendicular to the tangent, both of length 1 after it. */
static bool make_frame(double tangent[3], double normal[3])
{
    double length = v3_norm(normal), speed = v3_norm(tangent);
    if (!(length > 0 && isfinite(length) && speed > 0)) return false;
    v3_scale(normal, 1 / length, normal);
    v3_scale(tangent, 1 / speed, tangent);
    v3_axpy(normal, -v3_dot(normal, tangent), tangent);
    double left = v3_norm(normal);
    if (!(left > least_across)) return false;
    v3_scale(normal, 1 / left, normal);
    return true;
}

/* Reflect v in the plane across `axis`. */
static void reflect(double v[3], const double axis[3])
{
    v3_axpy(v, -2 * v3_dot(axis, v) / v3_norm2(axis), axis);
}

/* The normal of the last cross-section carried to the next one with the least rotation: two reflections, the first carries the one point to the other, the second the tangent
 * (Wang, Juettler, Zheng, Liu: Computation of rotation minimizing frames, 2008). */
static void carry(double normal[3], const double from[3], const double from_tangent[3], const double to[3], const double to_tangent[3])
{
    double step[3], tangent[3], turn[3];
    v3_sub(step, to, from);
    if (!(v3_norm2(step) > 0)) return;
    v3_copy(tangent, from_tangent);
    reflect(normal, step);
    reflect(tangent, step);
    v3_sub(turn, to_tangent, tangent);
    if (v3_norm2(turn) > 0) reflect(normal, turn);
}

typedef struct section {
    double x[3], tangent[3], normal[3];
} section;

static cipc_status make_section(const cipc_ribbon *ribbon, const scene_curve *curve, gsl_spline *const normals[3], double s, section *now, cipc_error *error)
{
    const section before = *now;
    double parameter = scene_curve_parameter(curve, s);
    scene_curve_at(curve, parameter, now->x, now->tangent);
    double speed = v3_norm(now->tangent);
    if (speed > 0) v3_scale(now->tangent, 1 / speed, now->tangent);
    if (ribbon->normals != NULL)
        scene_spline3_at(normals, parameter, now->normal);
    else if (s > 0)
        carry(now->normal, before.x, before.tangent, now->x, now->tangent);
    else
        v3_copy(now->normal, ribbon->normal);
    if (make_frame(now->tangent, now->normal)) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%g m from its begin the curve has no direction across its normal (%g, %g, %g): it runs along it or has a cusp there", s,
                     now->normal[0], now->normal[1], now->normal[2]);
}

/* Nodes of one section, from -w/2 to w/2 along tangent x normal. */
static void place_section(cipc_mesh *mesh, const cipc_ribbon *ribbon, int i, const section *at)
{
    double across[3];
    v3_cross(across, at->tangent, at->normal);
    for (int j = 0; j <= ribbon->across; j++) {
        int node = i * (ribbon->across + 1) + j;
        double w = ribbon->width * ((double)j / ribbon->across - 0.5);
        for (int a = 0; a < 3; a++) mesh->nodes[3 * node + a] = at->x[a] + w * across[a];
    }
}

/* The same nodes on a rectangle in the x-z plane, `s` from the middle of its length. Chords, not arcs: where the ribbon bends across its width only, the pattern is its unfolding. */
static void place_pattern(cipc_mesh *mesh, const cipc_ribbon *ribbon, int i, double s)
{
    for (int j = 0; j <= ribbon->across; j++) {
        double *x = mesh->pattern + 3 * (i * (ribbon->across + 1) + j);
        x[0] = s;
        x[1] = 0;
        x[2] = ribbon->width * ((double)j / ribbon->across - 0.5);
    }
}

static void middle_pattern(cipc_mesh *mesh)
{
    double middle = 0.5 * mesh->pattern[3 * (mesh->node_count - 1)];
    for (int i = 0; i < mesh->node_count; i++) mesh->pattern[3 * i] -= middle;
}

/* Seen along the normal of a section: is it turned up, with some of the size of half a flat cell? */
static bool has_size(const cipc_mesh *mesh, const int triangle[3], const double normal[3], double half_cell)
{
    double u[3], v[3], area[3];
    v3_sub(u, mesh->nodes + 3 * triangle[1], mesh->nodes + 3 * triangle[0]);
    v3_sub(v, mesh->nodes + 3 * triangle[2], mesh->nodes + 3 * triangle[0]);
    v3_cross(area, u, v);
    return 0.5 * v3_dot(area, normal) > least_share * half_cell;
}

/* The cells between section i and the next, cut along alternating diagonals. With a along the curve and b across it, (00, 01, 10) is turned up, as b x a is the normal. */
static void cut_cells(cipc_mesh *mesh, int across, int i)
{
    int(*triangle)[3] = mesh->triangles + 2 * i * across;
    for (int j = 0; j < across; j++, triangle += 2) {
        int n00 = i * (across + 1) + j, n01 = n00 + 1, n10 = n00 + across + 1, n11 = n10 + 1;
        const int one[2][2][3] = {{{n00, n11, n10}, {n00, n01, n11}}, {{n00, n01, n10}, {n10, n01, n11}}};
        for (int t = 0; t < 2; t++) {
            for (int k = 0; k < 3; k++) triangle[t][k] = one[(i + j) % 2][t][k];
        }
    }
}

static cipc_status make_ribbon(cipc_mesh *mesh, const cipc_ribbon *ribbon, const scene_curve *curve, gsl_spline *const normals[3], cipc_error *error)
{
    const double length = scene_curve_length(curve), half_cell = 0.5 * (length / ribbon->along) * (ribbon->width / ribbon->across);
    section at = {{0}, {0}, {0}};
    double chords = 0, step[3];
    for (int i = 0; i <= ribbon->along; i++) {
        double s = length * ((double)i / ribbon->along);
        const section before = at;
        cipc_status status = make_section(ribbon, curve, normals, s, &at, error);
        if (status != CIPC_OK) return status;
        place_section(mesh, ribbon, i, &at);
        v3_sub(step, at.x, before.x);
        if (i > 0) chords += v3_norm(step);
        place_pattern(mesh, ribbon, i, chords);
        if (i == 0) continue;
        cut_cells(mesh, ribbon->across, i - 1);
        for (int t = 2 * (i - 1) * ribbon->across; t < 2 * i * ribbon->across; t++) {
            if (has_size(mesh, mesh->triangles[t], at.normal, half_cell)) continue;
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%g m from its begin the curve bends too sharply for a ribbon of %g m: elements have no size there", s, ribbon->width);
        }
    }
    middle_pattern(mesh);
    return CIPC_OK;
}

static cipc_status follow(cipc_mesh *mesh, const cipc_ribbon *ribbon, const scene_curve *curve, cipc_error *error)
{
    gsl_spline *normals[3] = {NULL, NULL, NULL};
    if (ribbon->normals != NULL && !scene_spline3_init(normals, ribbon->count, curve->knots, ribbon->normals)) {
        scene_spline3_free(normals);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d normals", ribbon->count);
    }
    cipc_status status = make_ribbon(mesh, ribbon, curve, normals, error);
    scene_spline3_free(normals);
    return status;
}

cipc_status cipc_mesh_ribbon(cipc_mesh *mesh, const cipc_ribbon *ribbon, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    scene_curve curve = {0};
    cipc_status status = check(ribbon, error);
    if (status != CIPC_OK) return status;
    status = scene_curve_init(&curve, ribbon->count, ribbon->points, place, error);
    if (status == CIPC_OK) {
        long long cells = scene_mesh_product(ribbon->along, ribbon->across);
        status = scene_mesh_allocate(mesh, scene_mesh_product(ribbon->along + 1LL, ribbon->across + 1LL), 2 * cells, place, error);
    }
    if (status == CIPC_OK) {
        mesh->pattern = cipc_alloc(3 * (size_t)mesh->node_count, sizeof *mesh->pattern);
        if (mesh->pattern == NULL) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the pattern of %d nodes", mesh->node_count);
    }
    if (status == CIPC_OK) status = follow(mesh, ribbon, &curve, error);
    if (status != CIPC_OK) cipc_mesh_free(mesh);
    scene_curve_free(&curve);
    return status;
}
