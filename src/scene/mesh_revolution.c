/* A shell of revolution: rings of nodes, each turned by half a step against the one below it, so that the strip between two rings is a zigzag of isosceles triangles. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "revolution";
static const double two_pi = 6.28318530717958647693;

static bool is_point(const double profile[2])
{
    return profile[0] == 0;
}

static cipc_status check_point(int count, const double (*profile)[2], int k, cipc_error *error)
{
    double radius = profile[k][0], height = profile[k][1];
    if (!(radius >= 0 && isfinite(radius) && isfinite(height))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d of the profile: radius %g, height %g m", k, radius, height);
    }
    if (is_point(profile[k]) && k > 0 && k < count - 1) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d of the profile lies on the axis; only the first and the last may", k);
    }
    if (k == 0) return CIPC_OK;
    if (radius == profile[k - 1][0] && (height == profile[k - 1][1] || radius == 0)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "points %d and %d of the profile have no surface between them", k - 1, k);
    }
    return CIPC_OK;
}

static cipc_status check(int count, const double (*profile)[2], int sectors, cipc_error *error)
{
    if (count < 2) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a profile of %d points; 2 are needed", count);
    if (sectors < 3) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d sectors; 3 are needed", sectors);
    for (int k = 0; k < count; k++) {
        cipc_status status = check_point(count, profile, k, error);
        if (status != CIPC_OK) return status;
    }
    if (profile[0][0] == profile[count - 1][0] && profile[0][1] == profile[count - 1][1]) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "the profile ends where it begins: two rings would coincide");
    }
    return CIPC_OK;
}

/* Angles run from x towards -z, anticlockwise seen from above. */
static void place_nodes(cipc_mesh *mesh, int count, const double (*profile)[2], int sectors)
{
    double *x = mesh->nodes;
    for (int k = 0; k < count; k++) {
        int nodes = is_point(profile[k]) ? 1 : sectors;
        for (int i = 0; i < nodes; i++, x += 3) {
            double angle = two_pi * ((i + 0.5 * (k % 2)) / sectors);
            x[0] = profile[k][0] * cos(angle);
            x[1] = profile[k][1];
            x[2] = -profile[k][0] * sin(angle);
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

/* Between ring k, whose nodes start at `low`, and the next. The node above the gap after node i of an even ring is i of the next, that of an odd ring is i + 1. */
static void join(cipc_mesh *mesh, int *count, const double (*profile)[2], int k, int low, int sectors)
{
    int high = low + (is_point(profile[k]) ? 1 : sectors);
    for (int i = 0; i < sectors; i++) {
        int next = (i + 1) % sectors;
        if (is_point(profile[k])) {
            add_triangle(mesh, count, low, high + next, high + i);
        } else if (is_point(profile[k + 1])) {
            add_triangle(mesh, count, low + i, low + next, high);
        } else if (k % 2 == 0) {
            add_triangle(mesh, count, low + i, low + next, high + i);
            add_triangle(mesh, count, low + next, high + next, high + i);
        } else {
            add_triangle(mesh, count, low + i, low + next, high + next);
            add_triangle(mesh, count, low + i, high + next, high + i);
        }
    }
}

cipc_status cipc_mesh_revolution(cipc_mesh *mesh, int count, const double (*profile)[2], int sectors, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(count, profile, sectors, error);
    if (status != CIPC_OK) return status;
    int points = is_point(profile[0]) + is_point(profile[count - 1]);
    long long nodes = (long long)(count - points) * sectors + points;
    status = scene_mesh_allocate(mesh, nodes, (2LL * (count - 1) - points) * sectors, place, error);
    if (status != CIPC_OK) return status;
    place_nodes(mesh, count, profile, sectors);
    for (int k = 0, low = 0, made = 0; k + 1 < count; low += is_point(profile[k]) ? 1 : sectors, k++) {
        join(mesh, &made, profile, k, low, sectors);
    }
    return CIPC_OK;
}
