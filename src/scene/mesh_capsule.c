/* A capsule about y: two balls and the cone that touches both, as a surface of revolution. Limbs of a mannequin are such. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "capsule";
static const double half_pi = 1.57079632679489661923;

static cipc_status check(const double radii[2], double length, int around, int along, cipc_error *error)
{
    if (!(radii[0] > 0 && radii[1] > 0 && isfinite(radii[0]) && isfinite(radii[1]) && length > 0 && isfinite(length)))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a capsule of radii %g and %g, its balls %g m apart", radii[0], radii[1],
                         length);
    if (!(fabs(radii[0] - radii[1]) < length))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "balls of radii %g and %g m, %g m apart: one holds the other", radii[0],
                         radii[1], length);
    if (around < 3 || along < 2 || along > SCENE_NODES_MAX)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place,
                         "%d nodes around and %d strips along; 3 and 2 are needed, at most %d strips allowed", around, along,
                         SCENE_NODES_MAX);
    return CIPC_OK;
}

/* The point at a distance along the outline from the lower pole: on the lower ball up to the latitude `touch`, on the cone, on the upper ball. */
static void outline(const double radii[2], double length, double touch, double way, double point[2])
{
    double low = radii[0] * (half_pi + touch), cone = length * cos(touch), latitude = touch, beyond = 0;
    int ball = way < low + cone ? 0 : 1;
    if (way < low)
        latitude = way / radii[0] - half_pi;
    else if (ball == 0)
        beyond = way - low;
    else
        latitude = touch + (way - low - cone) / radii[1];
    point[0] = radii[ball] * cos(latitude) - beyond * sin(touch);
    point[1] = (ball == 0 ? -0.5 : 0.5) * length + radii[ball] * sin(latitude) + beyond * cos(touch);
}

cipc_status cipc_mesh_capsule(cipc_mesh *mesh, const double radii[2], double length, int around, int along, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(radii, length, around, along, error);
    if (status != CIPC_OK) return status;
    double(*profile)[2] = cipc_alloc((size_t)along + 1, sizeof *profile);
    if (profile == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d rings", along + 1);
    double touch = asin((radii[0] - radii[1]) / length);
    double whole = radii[0] * (half_pi + touch) + length * cos(touch) + radii[1] * (half_pi - touch);
    for (int k = 1; k < along; k++) outline(radii, length, touch, whole * ((double)k / along), profile[k]);
    profile[0][0] = profile[along][0] = 0; /* exactly on the axis */
    profile[0][1] = -0.5 * length - radii[0];
    profile[along][1] = 0.5 * length + radii[1];
    status = cipc_mesh_revolution(mesh, along + 1, (const double(*)[2])profile, around, error);
    cipc_free(profile);
    return status;
}
