/* A surface ruled by straight lines through one point (or parallel ones), over a polygon in plan, is made of flat trapezoids: it unfolds into the
 * plane without stretch. So the shape around the body and the flat pattern have the same sides and angles in every triangle, to rounding, whatever
 * the number of columns. */
#include "scene/mesh_panels.h"

#include <math.h>

#include "base/vector.h"
#include "scene/mesh.h"

cipc_status scene_check_panel_ring(const cipc_panel_ring *ring, const char *place, cipc_error *error)
{
    if (!(ring->top > 0 && ring->bottom > 0 && ring->height > 0 && isfinite(ring->top) && isfinite(ring->bottom) && isfinite(ring->height)))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "panels from radius %g to %g m, %g m high", ring->top, ring->bottom,
                         ring->height);
    if (ring->panels < 1 || ring->down < 1)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d panels of %d rows; 1 of each is needed", ring->panels, ring->down);
    return CIPC_OK;
}

/* The point of the ruling over a point of the curve, `down` of the way from the top. */
static void place_point(const cipc_panel_ring *ring, const double curve[2], double down, double x[3])
{
    double scale = 1 + down * (ring->bottom / ring->top - 1);
    x[0] = scale * curve[0];
    x[1] = -ring->height * down;
    x[2] = scale * curve[1];
}

/* The ends of a ruling in the plane of the pattern, (x, z). */
typedef struct ruling {
    double top[2], bottom[2];
} ruling;

/* Lay the trapezoid between two rulings into the plane beside the left one, which is there already: a point at `along` the left ruling and `across`
 * from it keeps both. */
static void unfold_point(const ruling *left, const double top[3], const double unit[3], const double point[3], double flat[2])
{
    double from[3], rest[3], ux = left->bottom[0] - left->top[0], uz = left->bottom[1] - left->top[1], length = hypot(ux, uz);
    v3_sub(from, point, top);
    double along = v3_dot(from, unit);
    for (int k = 0; k < 3; k++) rest[k] = from[k] - along * unit[k];
    double across = v3_norm(rest);
    flat[0] = left->top[0] + (along * ux + across * uz) / length;
    flat[1] = left->top[1] + (along * uz - across * ux) / length;
}

static void unfold(const cipc_panel_ring *ring, const double (*curve)[2], const ruling *left, ruling *right)
{
    double top[3], bottom[3], unit[3], next[3];
    place_point(ring, curve[0], 0, top);
    place_point(ring, curve[0], 1, bottom);
    v3_sub(unit, bottom, top);
    v3_scale(unit, 1 / v3_norm(unit), unit);
    place_point(ring, curve[1], 0, next);
    unfold_point(left, top, unit, next, right->top);
    place_point(ring, curve[1], 1, next);
    unfold_point(left, top, unit, next, right->bottom);
}

static void rotate(double x[2], double cosine, double sine)
{
    double first = x[0];
    x[0] = cosine * first + sine * x[1];
    x[1] = cosine * x[1] - sine * first;
}

/* The first ruling down along z from the origin, the others to its right; then the whole turned so that the upper corners lie on a line along x: a
 * symmetric panel has a symmetric pattern, and its grain (the z axis) runs down its middle. */
static void unfold_panel(const cipc_panel_ring *ring, int columns, const double (*curve)[2], ruling *rulings)
{
    double top[3], bottom[3];
    place_point(ring, curve[0], 0, top);
    place_point(ring, curve[0], 1, bottom);
    v3_sub(bottom, bottom, top);
    rulings[0] = (ruling){{0, 0}, {0, v3_norm(bottom)}};
    for (int c = 0; c < columns; c++) unfold(ring, curve + c, &rulings[c], &rulings[c + 1]);
    const double *corner = rulings[columns].top;
    double length = hypot(corner[0], corner[1]), cosine = length > 0 ? corner[0] / length : 1, sine = length > 0 ? corner[1] / length : 0;
    for (int c = 0; c <= columns; c++) {
        rotate(rulings[c].top, cosine, sine);
        rotate(rulings[c].bottom, cosine, sine);
    }
}

static void place_panel(const cipc_panel_ring *ring, int columns, const double (*curve)[2], const ruling *rulings, double *x, double *flat)
{
    for (int j = 0; j <= ring->down; j++) {
        double down = (double)j / ring->down;
        for (int c = 0; c <= columns; c++, x += 3, flat += 3) {
            place_point(ring, curve[c], down, x);
            flat[0] = rulings[c].top[0] + down * (rulings[c].bottom[0] - rulings[c].top[0]);
            flat[1] = 0;
            flat[2] = rulings[c].top[1] + down * (rulings[c].bottom[1] - rulings[c].top[1]);
        }
    }
}

static void add_triangle(cipc_mesh *mesh, int *count, int a, int b, int c)
{
    int *triangle = mesh->triangles[(*count)++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Alternating diagonals, so that no direction is favoured. */
static void split_panel(cipc_mesh *mesh, int *count, int first, int columns, int down)
{
    for (int j = 0; j < down; j++) {
        for (int c = 0; c < columns; c++) {
            int a = first + j * (columns + 1) + c, b = a + 1, below_a = a + columns + 1, below_b = below_a + 1;
            if ((j + c) % 2 != 0) {
                add_triangle(mesh, count, a, below_a, b);
                add_triangle(mesh, count, b, below_a, below_b);
            } else {
                add_triangle(mesh, count, a, below_b, b);
                add_triangle(mesh, count, a, below_a, below_b);
            }
        }
    }
}

static void fill(cipc_mesh *mesh, const cipc_panel_ring *ring, int columns, const double (*curve)[2], ruling *rulings)
{
    int nodes = (columns + 1) * (ring->down + 1);
    for (int p = 0, made = 0; p < ring->panels; p++) {
        size_t at = 3 * (size_t)p * (size_t)nodes;
        const double(*part)[2] = curve + (size_t)p * (size_t)columns;
        unfold_panel(ring, columns, part, rulings);
        place_panel(ring, columns, part, rulings, mesh->nodes + at, mesh->pattern + at);
        split_panel(mesh, &made, p * nodes, columns, ring->down);
    }
}

cipc_status scene_mesh_panels(cipc_mesh *mesh, const cipc_panel_ring *ring, int columns, const double (*curve)[2], const char *place,
                              cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    long long rows = ring->down + 1LL, nodes = scene_mesh_product(scene_mesh_product(ring->panels, columns + 1LL), rows);
    long long cells = scene_mesh_product(scene_mesh_product(ring->panels, columns), ring->down);
    cipc_status status = scene_mesh_allocate(mesh, nodes, 2 * cells, place, error);
    if (status != CIPC_OK) return status;
    ruling *rulings = cipc_alloc((size_t)columns + 1, sizeof *rulings);
    mesh->pattern = cipc_alloc(3 * (size_t)nodes, sizeof *mesh->pattern);
    if (rulings == NULL || mesh->pattern == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the flat pattern of %lld nodes", nodes);
        cipc_mesh_free(mesh);
    } else {
        mesh->panel_count = ring->panels;
        mesh->panel_columns = columns + 1;
        mesh->panel_rows = ring->down + 1;
        fill(mesh, ring, columns, curve, rulings);
    }
    cipc_free(rulings);
    return status;
}
