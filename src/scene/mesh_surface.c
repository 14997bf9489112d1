/* Surfaces of revolution and cylinders, of staggered rings. */
#include <math.h>

#include "scene/mesh.h"

static const double two_pi = 6.28318530717958647692;

/* One ring of nodes, or a single one on the axis. */
typedef struct ring {
    int first, count;
    bool staggered;
} ring;

static void add_triangle(cipc_mesh *mesh, int *count, int a, int b, int c)
{
    int *triangle = mesh->triangles[(*count)++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* The strip between a ring and the next. Seen from outside, angles grow to the left if the axis of the next ring is up. */
static void join(cipc_mesh *mesh, int *count, const ring *a, const ring *b)
{
    int n = a->count > b->count ? a->count : b->count;
    for (int i = 0; i < n; i++) {
        int next = (i + 1) % n;
        if (a->count == 1) {
            add_triangle(mesh, count, a->first, b->first + i, b->first + next);
        } else if (b->count == 1) {
            add_triangle(mesh, count, a->first + i, b->first, a->first + next);
        } else if (a->staggered) {
            add_triangle(mesh, count, a->first + i, b->first + i, b->first + next);
            add_triangle(mesh, count, a->first + i, b->first + next, a->first + next);
        } else {
            add_triangle(mesh, count, a->first + i, b->first + i, a->first + next);
            add_triangle(mesh, count, a->first + next, b->first + i, b->first + next);
        }
    }
}

/* Angle of the i-th node of a ring: every other ring is turned by half a step. */
static double angle_of(int i, int sectors, bool staggered) { return two_pi * ((i + (staggered ? 0.5 : 0)) / sectors); }

static cipc_status check_profile(int count, const double (*profile)[2], int sectors, cipc_error *error)
{
    static const char place[] = "revolution";
    if (count < 2 || sectors < 3) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a profile of %d points with %d sectors; at least 2 and 3 are needed", count, sectors);
    for (int i = 0; i < count; i++) {
        bool end = i == 0 || i == count - 1;
        if (!isfinite(profile[i][0]) || !isfinite(profile[i][1]) || profile[i][0] < 0 || (profile[i][0] == 0 && !end)) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d of the profile: radius %g m, height %g m; only its ends may be on the axis", i, profile[i][0], profile[i][1]);
        }
    }
    if (profile[0][0] == 0 && profile[1][0] == 0) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "the profile lies on the axis");
    return CIPC_OK;
}

cipc_status cipc_mesh_revolution(cipc_mesh *mesh, int count, const double (*profile)[2], int sectors, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check_profile(count, profile, sectors, error);
    if (status != CIPC_OK) return status;
    int poles = (profile[0][0] == 0) + (profile[count - 1][0] == 0);
    long long nodes = (long long)(count - poles) * sectors + poles, triangles = (2LL * (count - 1) - poles) * sectors;
    status = scene_mesh_allocate(mesh, nodes, triangles, "revolution", error);
    if (status != CIPC_OK) return status;
    ring last = {0};
    for (int i = 0, node = 0, made = 0; i < count; i++) {
        ring now = {node, profile[i][0] == 0 ? 1 : sectors, i % 2 == 1};
        for (int k = 0; k < now.count; k++, node++) {
            double angle = angle_of(k, sectors, now.staggered), *x = mesh->nodes + 3 * (size_t)node;
            x[0] = profile[i][0] * cos(angle);
            x[1] = profile[i][1];
            x[2] = profile[i][0] * sin(angle);
        }
        if (i > 0) join(mesh, &made, &last, &now);
        last = now;
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_cylinder(cipc_mesh *mesh, double radius, double length, int around, int along, cipc_error *error)
{
    static const char place[] = "cylinder";
    *mesh = (cipc_mesh){0};
    if (!(radius > 0 && length > 0 && isfinite(radius) && isfinite(length)) || around < 3 || along < 1) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a cylinder of radius %g m and length %g m with %d nodes around and %d strips; at least 3 and 1 are needed", radius, length, around, along);
    }
    cipc_status status = scene_mesh_allocate(mesh, (along + 1LL) * around, 2LL * along * around, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0, made = 0; i <= along; i++) {
        ring now = {i * around, around, i % 2 == 1}, last = {(i - 1) * around, around, i % 2 == 0};
        for (int k = 0; k < around; k++) {
            double angle = angle_of(k, around, now.staggered), *x = mesh->nodes + 3 * (size_t)(now.first + k);
            x[0] = length * ((double)i / along - 0.5);
            x[1] = radius * sin(angle); /* from z to y: seen from outside, angles run like those of a revolution about +x */
            x[2] = radius * cos(angle);
        }
        if (i > 0) join(mesh, &made, &last, &now);
    }
    return CIPC_OK;
}
