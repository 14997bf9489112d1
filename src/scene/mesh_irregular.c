/* Irregular triangulation of a rectangle: points spread evenly but without a pattern, then relaxed and triangulated by turns. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "scene/delaunay.h"
#include "scene/mesh.h"
#include "scene/random.h"

static const char place[] = "irregular";

/* Relaxations. Smallest angle over 400 to 8,000 nodes: 23 to 29 degrees after 5 of them, and no better after 12. */
enum { PASSES = 5 };
static const double margin = 0.55; /* of the spacing: free points start at least that far from the boundary */
static const double jitter = 0.25; /* of the spacing: largest random shift along each axis */

/* The sheet in its plane: point i is (x, z) = points[2i], points[2i+1]. */
typedef struct sheet {
    double size[2];
    double spacing;
    int divisions[2];    /* of the boundary */
    int boundary, count; /* the first `boundary` of `count` points stay where they are */
    double *points;
    double *sums; /* 3 * count: area-weighted centroid and area around each point */
    int (*triangles)[3];
    int triangle_count;
} sheet;

/* Spacing h of equilateral triangles: n points, B = 2 (size_x + size_z) / h of them on the boundary, make 2 n - 2 - B triangles (Euler) of
 * area sqrt(3)/4 h^2, which fill the rectangle: (n - 1) h^2 - (size_x + size_z) h = 2 size_x size_z / sqrt(3). */
static double spacing_of(double size_x, double size_z, int nodes)
{
    double a = nodes - 1, b = size_x + size_z, c = 2 * size_x * size_z / sqrt(3.0);
    return (b + sqrt(b * b + 4 * a * c)) / (2 * a);
}

static int divide(double length, double spacing)
{
    double count = round(length / spacing);
    return count < 1 ? 1 : (int)count;
}

static void plan(sheet *s, double size_x, double size_z, int nodes)
{
    s->size[0] = size_x;
    s->size[1] = size_z;
    s->spacing = spacing_of(size_x, size_z, nodes);
    for (int k = 0; k < 2; k++) s->divisions[k] = divide(s->size[k], s->spacing);
    s->boundary = 2 * (s->divisions[0] + s->divisions[1]);
    bool has_inside = size_x > 2 * margin * s->spacing && size_z > 2 * margin * s->spacing;
    s->count = has_inside && nodes > s->boundary ? nodes : s->boundary;
}

static void add_point(sheet *s, int *index, double x, double z)
{
    s->points[2 * *index] = x;
    s->points[2 * *index + 1] = z;
    (*index)++;
}

/* Evenly spaced along each side; the coordinates of the sides are exact. */
static void place_boundary(sheet *s)
{
    double half_x = 0.5 * s->size[0], half_z = 0.5 * s->size[1];
    int index = 0, nx = s->divisions[0], nz = s->divisions[1];
    for (int i = 0; i <= nx; i++) add_point(s, &index, -half_x + s->size[0] * ((double)i / nx), -half_z);
    for (int i = 0; i <= nx; i++) add_point(s, &index, -half_x + s->size[0] * ((double)i / nx), half_z);
    for (int j = 1; j < nz; j++) add_point(s, &index, -half_x, -half_z + s->size[1] * ((double)j / nz));
    for (int j = 1; j < nz; j++) add_point(s, &index, half_x, -half_z + s->size[1] * ((double)j / nz));
}

static double clamp(double value, double limit)
{
    return value < -limit ? -limit : value > limit ? limit : value;
}

/* Free points: the additive sequence of the plastic number in each of a row of nearly square tiles (dealt to in turn), shifted at
 * random. */
static void place_inside(sheet *s, uint64_t *random)
{
    const double step[2] = {0.75487766624669276, 0.56984029099805327}; /* 1/p, 1/p^2 with p^3 = p + 1 */
    double inner[2] = {s->size[0] - 2 * margin * s->spacing, s->size[1] - 2 * margin * s->spacing};
    int along = inner[0] >= inner[1] ? 0 : 1, free_points = s->count - s->boundary;
    double ratio = inner[along] / inner[1 - along];
    int tiles = ratio < 1.5 || free_points == 0 ? 1 : ratio < free_points ? (int)round(ratio) : free_points;
    double origin[2] = {scene_random(random), scene_random(random)};
    for (int i = 0; i < free_points; i++) {
        double *x = s->points + 2 * (s->boundary + i), turn = i / tiles + 1, tile = i % tiles;
        for (int k = 0; k < 2; k++) {
            double fraction = fmod(origin[k] + turn * step[k] + tile * step[1 - k], 1.0);
            if (k == along) fraction = (tile + fraction) / tiles;
            double shift = jitter * s->spacing * (2 * scene_random(random) - 1);
            x[k] = clamp((fraction - 0.5) * inner[k] + shift, 0.5 * inner[k]);
        }
    }
}

/* Each free point moves to the area-weighted mean of the centroids of the triangles around it. */
static void relax(sheet *s)
{
    for (int i = 0; i < 3 * s->count; i++) s->sums[i] = 0;
    for (int t = 0; t < s->triangle_count; t++) {
        const int *v = s->triangles[t];
        const double *a = s->points + 2 * v[0], *b = s->points + 2 * v[1], *c = s->points + 2 * v[2];
        double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        for (int k = 0; k < 3; k++) {
            double *sum = s->sums + 3 * v[k];
            sum[0] += area * (a[0] + b[0] + c[0]) / 3;
            sum[1] += area * (a[1] + b[1] + c[1]) / 3;
            sum[2] += area;
        }
    }
    for (int i = s->boundary; i < s->count; i++) {
        const double *sum = s->sums + 3 * i;
        if (sum[2] > 0) {
            s->points[2 * i] = sum[0] / sum[2];
            s->points[2 * i + 1] = sum[1] / sum[2];
        }
    }
}

/* Lloyd's relaxation with triangles in place of Voronoi cells. What qhull leaves must be a disc that uses every point. */
static cipc_status triangulate(sheet *s, cipc_error *error)
{
    double smallest_area = 1e-9 * s->size[0] * s->size[1] / s->count; /* a billionth of a point's share: flat triangles along the sides */
    for (int pass = 0;; pass++) {
        cipc_status status = scene_delaunay(s->points, s->count, smallest_area, s->triangles, &s->triangle_count, error);
        if (status != CIPC_OK) return status;
        if (pass == PASSES || s->count == s->boundary) break;
        relax(s);
    }
    int expected = 2 * s->count - 2 - s->boundary;
    if (s->triangle_count == expected) return CIPC_OK;
    return cipc_fail(error, CIPC_E_BAD_MESH, place, "%d triangles where %d fill the rectangle", s->triangle_count, expected);
}

/* Counter-clockwise in (x, z) is clockwise seen from +y: turned round for a normal of +y. */
static cipc_status fill_mesh(const sheet *s, cipc_mesh *mesh, cipc_error *error)
{
    cipc_status status = scene_mesh_allocate(mesh, s->count, s->triangle_count, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0; i < s->count; i++) {
        mesh->nodes[3 * i] = s->points[2 * i];
        mesh->nodes[3 * i + 1] = 0;
        mesh->nodes[3 * i + 2] = s->points[2 * i + 1];
    }
    for (int t = 0; t < s->triangle_count; t++) {
        mesh->triangles[t][0] = s->triangles[t][0];
        mesh->triangles[t][1] = s->triangles[t][2];
        mesh->triangles[t][2] = s->triangles[t][1];
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_irregular(cipc_mesh *mesh, double size_x, double size_z, int nodes, unsigned long seed, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (!(size_x > 0 && size_z > 0 && isfinite(size_x) && isfinite(size_z))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a sheet of %g by %g m", size_x, size_z);
    }
    if (nodes < 4 || nodes > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d nodes; 4 to %d are allowed", nodes, SCENE_NODES_MAX);
    }
    sheet s = {0};
    uint64_t random = seed;
    plan(&s, size_x, size_z, nodes);
    s.points = cipc_alloc(2 * (size_t)s.count, sizeof *s.points);
    s.sums = cipc_alloc(3 * (size_t)s.count, sizeof *s.sums);
    s.triangles = cipc_alloc(2 * (size_t)s.count, sizeof *s.triangles);
    cipc_status status = CIPC_OK;
    if (s.points == NULL || s.sums == NULL || s.triangles == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d nodes", s.count);
    } else {
        place_boundary(&s);
        place_inside(&s, &random);
        status = triangulate(&s, error);
    }
    if (status == CIPC_OK) status = fill_mesh(&s, mesh, error);
    cipc_free(s.points);
    cipc_free(s.sums);
    cipc_free(s.triangles);
    return status;
}
