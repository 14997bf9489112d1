/* Triangles as the camera sees them: smooth where the surface is smooth, lit from two sides, with mesh edges where the mesh is coarse. */
#include "output/surface_look.h"

#include <math.h>
#include <string.h>
#include "base/vector.h"

static const double crease_cosine = 0.64;       /* beyond 50 degrees between face and mean normal, an edge of the body is meant */
static const double ink_from = 9, ink_full = 24; /* pixels: mean edge length at which mesh edges begin to show, and show fully */
static const double ink_most = 0.38;

/* Area-weighted mean normals at the nodes, of unit length where there is one. */
static void node_normals(const cipc_model *model, const double *x, double *normals)
{
    memset(normals, 0, 3 * (size_t)model->node_count * sizeof normals[0]);
    for (int t = 0; t < model->triangle_count; t++) {
        const int *v = model->triangles[t];
        double a[3], b[3], n[3];
        v3_sub(a, x + 3 * v[1], x + 3 * v[0]);
        v3_sub(b, x + 3 * v[2], x + 3 * v[0]);
        v3_cross(n, a, b);
        for (int i = 0; i < 3; i++) {
            v3_add(normals + 3 * v[i], normals + 3 * v[i], n);
        }
    }
    for (int i = 0; i < model->node_count; i++) {
        const double length = v3_norm(normals + 3 * i);
        if (length > 0) {
            v3_scale(normals + 3 * i, 1 / length, normals + 3 * i);
        }
    }
}

/* Corner of a triangle in the camera's frame. */
typedef struct corner {
    double seen[3];
    cipc_shade shade;
} corner;

/* Normals are turned to the eye, so both sides of a sheet are lit. False for a triangle without area. */
static bool shade_corners(const double *x, const int v[3], const double *normals, const cipc_camera *camera, const cipc_lighting *lighting,
                          corner c[3])
{
    double a[3], b[3], face[3], to_eye[3];
    v3_sub(a, x + 3 * v[1], x + 3 * v[0]);
    v3_sub(b, x + 3 * v[2], x + 3 * v[0]);
    v3_cross(face, a, b);
    const double length = v3_norm(face);
    if (!(length > 0)) {
        return false;
    }
    v3_scale(face, 1 / length, face);
    v3_sub(to_eye, camera->eye, x + 3 * v[0]);
    const double side = v3_dot(face, to_eye) >= 0 ? 1 : -1;
    for (int i = 0; i < 3; i++) {
        const double *mean = normals + 3 * v[i];
        double n[3];
        v3_scale(n, side, v3_dot(mean, face) > crease_cosine ? mean : face);
        cipc_camera_see(camera, x + 3 * v[i], c[i].seen);
        c[i].shade = cipc_shade_of(lighting, n);
    }
    return true;
}

/* Cut off what is nearer than z: 0, 3 or 4 corners remain. */
static int clip(const corner in[3], double z, corner out[4])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        const corner *a = &in[i], *b = &in[(i + 1) % 3];
        if (a->seen[2] >= z) {
            out[count++] = *a;
        }
        if ((a->seen[2] >= z) != (b->seen[2] >= z)) {
            const double t = (z - a->seen[2]) / (b->seen[2] - a->seen[2]);
            for (int k = 0; k < 3; k++) {
                out[count].seen[k] = a->seen[k] + t * (b->seen[k] - a->seen[k]);
            }
            out[count].shade.brightness = a->shade.brightness + t * (b->shade.brightness - a->shade.brightness);
            out[count++].shade.key = a->shade.key + t * (b->shade.key - a->shade.key);
        }
    }
    return count;
}

static cipc_raster_corner project(const cipc_raster *raster, const cipc_camera *camera, const corner *c)
{
    const double inverse_depth = 1 / c->seen[2];
    return (cipc_raster_corner){
        .x = raster->width * (0.5 + 0.5 * c->seen[0] * inverse_depth / camera->slope_x),
        .y = raster->height * (0.5 - 0.5 * c->seen[1] * inverse_depth / camera->slope_y),
        .inverse_depth = inverse_depth,
        .shade = c->shade,
    };
}

static double mean_side(const cipc_raster_corner c[3])
{
    return (hypot(c[1].x - c[0].x, c[1].y - c[0].y) + hypot(c[2].x - c[1].x, c[2].y - c[1].y) + hypot(c[0].x - c[2].x, c[0].y - c[2].y)) /
           (3 * CIPC_RASTER_SAMPLES);
}

static double ink_of(double side)
{
    return ink_most * fmin(fmax((side - ink_from) / (ink_full - ink_from), 0), 1);
}

void cipc_surface_draw(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_camera *camera,
                       const cipc_lighting *lighting, double *normals)
{
    node_normals(model, position, normals);
    for (int t = 0; t < model->triangle_count; t++) {
        const cipc_colour colour = cipc_colour_to_linear(cipc_body_colour(model, model->triangle_body[t]));
        corner seen[3], clipped[4];
        if (!shade_corners(position, model->triangles[t], normals, camera, lighting, seen)) {
            continue;
        }
        const int count = clip(seen, cipc_camera_nearest(camera), clipped);
        for (int i = 2; i < count; i++) {
            const cipc_raster_corner fan[3] = {project(raster, camera, &clipped[0]), project(raster, camera, &clipped[i - 1]),
                                               project(raster, camera, &clipped[i])};
            cipc_raster_triangle(raster, fan, colour, count == 3 ? ink_of(mean_side(fan)) : 0);
        }
    }
}
