/* A perspective camera that looks at the middle of things. */
#include "output/camera.h"

#include <math.h>
#include "base/vector.h"

static const double field_of_view = 0.56;  /* rad, up: that of a moderate telephoto lens, which keeps proportions */
static const double near_plane = 0.02;     /* of the distance */
static const double air = 1.06;            /* distance factor that leaves a margin */

cipc_bounds cipc_bounds_empty(void)
{
    return (cipc_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

void cipc_bounds_add(cipc_bounds *bounds, const double center[3], double radius)
{
    if (!isfinite(center[0]) || !isfinite(center[1]) || !isfinite(center[2])) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        bounds->lo[k] = fmin(bounds->lo[k], center[k] - radius);
        bounds->hi[k] = fmax(bounds->hi[k], center[k] + radius);
    }
}

bool cipc_bounds_are_empty(const cipc_bounds *bounds)
{
    return !(bounds->lo[0] <= bounds->hi[0]);
}

double cipc_bounds_diagonal(const cipc_bounds *bounds)
{
    double d[3];
    v3_sub(d, bounds->hi, bounds->lo);
    return cipc_bounds_are_empty(bounds) ? 0 : v3_norm(d);
}

cipc_camera cipc_camera_look(const cipc_bounds *bounds, double azimuth, double elevation, double aspect)
{
    cipc_camera camera = {0};
    const double sa = sin(azimuth), ca = cos(azimuth), se = sin(elevation), ce = cos(elevation);
    for (int k = 0; k < 3 && !cipc_bounds_are_empty(bounds); k++) {
        camera.target[k] = (bounds->lo[k] + bounds->hi[k]) / 2;
    }
    v3_copy(camera.back, (const double[3]){sa * ce, se, ca * ce});
    v3_copy(camera.right, (const double[3]){ca, 0, -sa});
    v3_cross(camera.up, camera.back, camera.right);
    camera.slope_y = tan(field_of_view / 2);
    camera.slope_x = camera.slope_y * aspect;
    return camera;
}

/* Distance in front of the target from which a ball at `offset` beside the axis touches the side of a view of this slope. */
static double distance_for(double offset, double radius, double slope)
{
    return (fabs(offset) + radius * sqrt(1 + slope * slope)) / slope;
}

void cipc_camera_fit(cipc_camera *camera, const double center[3], double radius)
{
    if (!isfinite(center[0]) || !isfinite(center[1]) || !isfinite(center[2])) {
        return;
    }
    double q[3];
    v3_sub(q, center, camera->target);
    const double across = distance_for(v3_dot(q, camera->right), radius, camera->slope_x);
    const double upward = distance_for(v3_dot(q, camera->up), radius, camera->slope_y);
    camera->distance = fmax(camera->distance, fmax(across, upward) + v3_dot(q, camera->back));
}

void cipc_camera_settle(cipc_camera *camera, const cipc_bounds *bounds, double zoom)
{
    const double least = cipc_bounds_diagonal(bounds) > 0 ? cipc_bounds_diagonal(bounds) / 2 : 1;
    camera->distance = fmax(camera->distance * air, least) / (zoom > 0 ? zoom : 1);
    v3_copy(camera->eye, camera->target);
    v3_axpy(camera->eye, camera->distance, camera->back);
}

double cipc_camera_nearest(const cipc_camera *camera)
{
    return near_plane * camera->distance;
}

void cipc_camera_see(const cipc_camera *camera, const double point[3], double seen[3])
{
    double q[3];
    v3_sub(q, point, camera->eye);
    seen[0] = v3_dot(q, camera->right);
    seen[1] = v3_dot(q, camera->up);
    seen[2] = -v3_dot(q, camera->back);
}
