/* Volumes: boxes of cells, and balls and cylinders of layers. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "scene/mesh.h"

static const double two_pi = 6.28318530717958647692;

static bool is_positive(double v) { return v > 0 && isfinite(v); }

/* The six ways from one corner of a cell to the opposite one along its edges, a tetrahedron each: all cells alike, so neighbours fit. Bits are axes. */
static void split_cell(cipc_mesh *mesh, int *made, const int corner[8])
{
    static const int ways[6][2] = {{1, 2}, {2, 4}, {4, 1}, {2, 1}, {4, 2}, {1, 4}};
    for (int w = 0; w < 6; w++) {
        int a = ways[w][0], b = a + ways[w][1];
        bool even = w < 3;
        const int nodes[4] = {corner[0], corner[even ? a : b], corner[even ? b : a], corner[7]};
        memcpy(mesh->tetrahedra[(*made)++], nodes, sizeof nodes);
    }
}

cipc_status cipc_mesh_box(cipc_mesh *mesh, const double size[3], const int cells[3], cipc_error *error)
{
    static const char place[] = "box";
    *mesh = (cipc_mesh){0};
    double nodes = 1, elements = 6;
    bool good = true;
    for (int k = 0; k < 3; k++) {
        good = good && is_positive(size[k]) && cells[k] >= 1;
        nodes *= cells[k] + 1.0;
        elements *= cells[k];
    }
    if (!good || nodes > SCENE_NODES_MAX || elements > SCENE_TRIANGLES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a box of %g by %g by %g m with %d by %d by %d cells", size[0], size[1], size[2], cells[0], cells[1], cells[2]);
    }
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_TETRAHEDRA, (long long)nodes, (long long)elements, place, error);
    if (status != CIPC_OK) return status;
    const int row = cells[0] + 1, sheet = row * (cells[1] + 1);
    for (int i = 0; i < mesh->node_count; i++) {
        const int at[3] = {i % row, i / row % (cells[1] + 1), i / sheet};
        for (int k = 0; k < 3; k++) mesh->nodes[3 * (size_t)i + (size_t)k] = size[k] * ((double)at[k] / cells[k] - 0.5);
    }
    for (int z = 0, made = 0; z < cells[2]; z++) {
        for (int y = 0; y < cells[1]; y++) {
            for (int x = 0; x < cells[0]; x++) {
                int corner[8], first = x + row * y + sheet * z;
                for (int c = 0; c < 8; c++) corner[c] = first + (c & 1) + row * (c >> 1 & 1) + sheet * (c >> 2 & 1);
                split_cell(mesh, &made, corner);
            }
        }
    }
    return CIPC_OK;
}

/* Subdivisions of the icosphere whose triangles are about as wide as a layer is thick. */
static int subdivisions_for(int layers)
{
    int s = 1;
    while ((1 << s) < layers) s++;
    return s;
}

/* Layers of one icosphere around the centre, which is node 0. */
static void fill_ball(cipc_mesh *mesh, const cipc_mesh *surface, int layers)
{
    int n = surface->node_count, t = surface->triangle_count;
    for (int layer = 1; layer <= layers; layer++) {
        double scale = (double)layer / layers, *x = mesh->nodes + 3 * (1 + (size_t)(layer - 1) * (size_t)n);
        for (int i = 0; i < 3 * n; i++) x[i] = scale * surface->nodes[i];
    }
    for (int i = 0; i < t; i++) {
        mesh->tetrahedra[i][0] = 0;
        for (int k = 0; k < 3; k++) mesh->tetrahedra[i][1 + k] = 1 + surface->triangles[i][k];
    }
    for (int layer = 1; layer < layers; layer++)
        scene_mesh_add_prisms(mesh, t + 3 * t * (layer - 1), (const int(*)[3])surface->triangles, t, 1 + (layer - 1) * n, 1 + layer * n);
    scene_mesh_orient(mesh);
}

cipc_status cipc_mesh_ball(cipc_mesh *mesh, double radius, int cells, cipc_error *error)
{
    static const char place[] = "ball";
    *mesh = (cipc_mesh){0};
    cipc_mesh surface;
    if (!is_positive(radius) || cells < 1 || cells > 256) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a ball of radius %g m in %d layers; 1 to 256 are allowed", radius, cells);
    cipc_status status = cipc_mesh_icosphere(&surface, radius, subdivisions_for(cells), error);
    if (status != CIPC_OK) return status;
    status = scene_mesh_allocate_kind(mesh, CIPC_MESH_TETRAHEDRA, 1 + (long long)cells * surface.node_count, (3LL * cells - 2) * surface.triangle_count, place, error);
    if (status == CIPC_OK) fill_ball(mesh, &surface, cells);
    cipc_mesh_free(&surface);
    return status;
}

/* Number of the k-th node of ring r of a disc of rings of 6 r nodes around a centre. */
static int disc_node(int r, int k) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + k % (6 * r); }

/* Each sextant of the strip between two rings: r + 1 triangles on the outer ring, r on the inner one. */
static cipc_status make_disc(cipc_mesh *disc, double radius, int rings, cipc_error *error)
{
    cipc_status status = scene_mesh_allocate(disc, 1 + 3LL * rings * (rings + 1), 6LL * rings * rings, "cylinder", error);
    if (status != CIPC_OK) return status;
    for (int r = 1; r <= rings; r++) {
        for (int k = 0; k < 6 * r; k++) {
            double *x = disc->nodes + 3 * (size_t)disc_node(r, k), angle = two_pi * k / (6 * r);
            x[0] = radius * r / rings * cos(angle);
            x[2] = radius * r / rings * sin(angle);
        }
    }
    for (int r = 0, made = 0; r < rings; r++) {
        for (int s = 0; s < 6; s++) {
            for (int k = 0; k <= r; k++) {
                const int outer[3] = {disc_node(r, s * r + k), disc_node(r + 1, s * (r + 1) + k), disc_node(r + 1, s * (r + 1) + k + 1)};
                memcpy(disc->triangles[made++], outer, sizeof outer);
                if (k == r) continue;
                const int inner[3] = {disc_node(r, s * r + k), disc_node(r + 1, s * (r + 1) + k + 1), disc_node(r, s * r + k + 1)};
                memcpy(disc->triangles[made++], inner, sizeof inner);
            }
        }
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_solid_cylinder(cipc_mesh *mesh, double radius, double length, int across, int along, cipc_error *error)
{
    static const char place[] = "cylinder";
    *mesh = (cipc_mesh){0};
    cipc_mesh disc = {0};
    if (!is_positive(radius) || !is_positive(length) || across < 1 || across > 1000 || along < 1 || along > SCENE_NODES_MAX)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a cylinder of radius %g m and length %g m with %d cells from the axis and %d along it", radius, length, across, along);
    cipc_status status = make_disc(&disc, radius, across, error);
    if (status == CIPC_OK) status = scene_mesh_allocate_kind(mesh, CIPC_MESH_TETRAHEDRA, (along + 1LL) * disc.node_count, 3LL * along * disc.triangle_count, place, error);
    for (int layer = 0; status == CIPC_OK && layer <= along; layer++) {
        double *x = mesh->nodes + 3 * (size_t)layer * (size_t)disc.node_count;
        memcpy(x, disc.nodes, 3 * (size_t)disc.node_count * sizeof *x);
        for (int i = 0; i < disc.node_count; i++) x[3 * i + 1] = length * ((double)layer / along - 0.5);
        if (layer < along)
            scene_mesh_add_prisms(mesh, 3 * layer * disc.triangle_count, (const int(*)[3])disc.triangles, disc.triangle_count, layer * disc.node_count, (layer + 1) * disc.node_count);
    }
    if (status == CIPC_OK) scene_mesh_orient(mesh);
    cipc_mesh_free(&disc);
    return status;
}
