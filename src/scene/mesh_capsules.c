/* Tetrahedra in a union of capsules. */
#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "model/mesh_topology.h"
#include "scene/capsules.h"
#include "scene/stuffing.h"

static const char place[] = "capsules";

static cipc_status check(int count, const cipc_capsule *parts, double blend, double cell, cipc_error *error)
{
    if (count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "no parts; 1 is needed");
    if (!(cell > 0 && isfinite(cell))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "cells of %g m", cell);
    if (!(blend >= 0 && isfinite(blend))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a blend of %g m", blend);
    for (int p = 0; p < count; p++) {
        const cipc_capsule *part = &parts[p];
        for (int k = 0; k < 2; k++) {
            if (part->radius[k] > 0 && isfinite(part->radius[k])) continue;
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "part %d has a radius of %g m", p, part->radius[k]);
        }
        double size = v3_norm(part->begin) + v3_norm(part->end);
        if (!isfinite(size)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "part %d has an end that is not finite", p);
    }
    return CIPC_OK;
}

typedef struct side {
    int low, high;
} side;

static int compare_sides(const void *a, const void *b)
{
    const side *p = a, *q = b;
    return p->low != q->low ? (p->low > q->low) - (p->low < q->low) : (p->high > q->high) - (p->high < q->high);
}

/* Edges of the surface that more than two of its triangles share: there the solid meets itself in a line. */
static int count_pinches(const int (*faces)[3], int face_count, side *sides)
{
    int count = 3 * face_count, pinches = 0;
    for (int i = 0; i < count; i++) {
        int a = faces[i / 3][i % 3], b = faces[i / 3][(i + 1) % 3];
        sides[i] = (side){a < b ? a : b, a < b ? b : a};
    }
    qsort(sides, (size_t)count, sizeof *sides, compare_sides);
    for (int i = 2; i < count; i++) pinches += compare_sides(&sides[i - 2], &sides[i]) == 0;
    return pinches;
}

static cipc_status check_surface(const cipc_mesh *mesh, double cell, cipc_error *error)
{
    int(*faces)[3], face_count;
    cipc_status status = cipc_volume_surface((const int(*)[4])mesh->tetrahedra, mesh->tetrahedron_count, place, &faces, &face_count, error);
    if (status != CIPC_OK) return status;
    side *sides = cipc_alloc(3 * (size_t)face_count, sizeof *sides);
    if (sides == NULL)
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a surface of %d triangles", face_count);
    else if (count_pinches((const int(*)[3])faces, face_count, sides) > 0)
        status = cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "parts meet along single edges: they are too thin for cells of %g m", cell);
    cipc_free(sides);
    cipc_free(faces);
    return status;
}

static int root_of(int *parent, int i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static cipc_status check_pieces(const cipc_mesh *mesh, double cell, cipc_error *error)
{
    int pieces = mesh->node_count, *parent = cipc_alloc((size_t)mesh->node_count, sizeof *parent);
    if (parent == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d nodes", mesh->node_count);
    for (int i = 0; i < mesh->node_count; i++) parent[i] = i;
    for (int t = 0; t < mesh->tetrahedron_count; t++) {
        for (int k = 1; k < 4; k++) {
            int a = root_of(parent, mesh->tetrahedra[t][0]), b = root_of(parent, mesh->tetrahedra[t][k]);
            pieces -= a != b;
            parent[b] = a;
        }
    }
    cipc_free(parent);
    if (pieces == 1) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d separate pieces: parts do not meet, or are too thin for cells of %g m", pieces, cell);
}

static double depth_of(const void *shape, const double x[3])
{
    return scene_capsules_depth(shape, x);
}

cipc_status cipc_mesh_capsules(cipc_mesh *mesh, int count, const cipc_capsule *parts, double blend, double cell, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(count, parts, blend, cell, error);
    if (status != CIPC_OK) return status;
    const scene_capsules shape = {count, parts, blend};
    double low[3], high[3];
    scene_capsules_bounds(&shape, low, high);
    status = scene_stuff(mesh, depth_of, &shape, low, high, cell, place, error);
    if (status != CIPC_OK) return status;
    status = check_pieces(mesh, cell, error);
    if (status == CIPC_OK) status = check_surface(mesh, cell, error);
    if (status != CIPC_OK) cipc_mesh_free(mesh);
    return status;
}
