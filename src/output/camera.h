/* A perspective camera that looks at the middle of things. */
#ifndef OUTPUT_CAMERA_H
#define OUTPUT_CAMERA_H

#include <stdbool.h>

typedef struct cipc_camera {
    double target[3], eye[3];
    double right[3], up[3], back[3];   /* orthonormal; back points from the target to the eye */
    double distance;                   /* from eye to target, m */
    double slope_x, slope_y;           /* tangents of half the angle of view, across and up */
} cipc_camera;

/* Axis-aligned bounds of points; empty: lo > hi. */
typedef struct cipc_bounds { double lo[3], hi[3]; } cipc_bounds;
cipc_bounds cipc_bounds_empty(void);
/* Grow around a ball (radius 0: a point). What is not finite is left out. */
void cipc_bounds_add(cipc_bounds *bounds, const double center[3], double radius);
bool cipc_bounds_are_empty(const cipc_bounds *bounds);
double cipc_bounds_diagonal(const cipc_bounds *bounds);

/* Look at the centre of the bounds from azimuth and elevation (radians), for a picture of width : height = aspect. The distance is 0
 * until cipc_camera_fit() has moved the camera back. */
cipc_camera cipc_camera_look(const cipc_bounds *bounds, double azimuth, double elevation, double aspect);
/* Go back until the ball (radius 0: the point) is in the picture. */
void cipc_camera_fit(cipc_camera *camera, const double center[3], double radius);
/* End of fitting: a little air around, then `zoom` times nearer. */
void cipc_camera_settle(cipc_camera *camera, const cipc_bounds *bounds, double zoom);

/* Depth of the near plane: nothing nearer is drawn. */
double cipc_camera_nearest(const cipc_camera *camera);
/* Coordinates in the camera's frame: right, up, and depth in front of the eye. */
void cipc_camera_see(const cipc_camera *camera, const double point[3], double seen[3]);

#endif
