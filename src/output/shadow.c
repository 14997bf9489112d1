/* A shadow map: everything drawn once more as the light sees them, in parallel projection, depths only. A sample of the picture is in
 * shadow if the map has something nearer to the light on its way. */
#include "output/shadow.h"

#include <math.h>
#include "base/vector.h"
#include "output/round_look.h"

enum { MAP_PIXELS = 512, MAP_SAMPLES = MAP_PIXELS * CIPC_RASTER_SAMPLES };
static const double taken = 0.7;         /* of the key light, by a shadow: the lamp is large and the sky bright */
static const double depth_scale = 0.25;  /* keeps the map's depths of the subject, and of things up to four radii around, above 0 */
static const double least_texels = 2;    /* width of a hair's shadow: thinner, it would be dotted */
static const double slack_texels = 2.5;  /* how much nearer the map must be, in widths of its samples: else a surface shades itself */

/* The light's view: u, v across, and w towards the light; a box around the subject is scaled to the unit square. */
typedef struct light_view {
    double u[3], v[3], w[3];
    double center[3], radius;
    cipc_raster map;
} light_view;

static void look_from_light(light_view *view, const cipc_bounds *bounds, const double light[3])
{
    const double helper[3] = {fabs(light[0]) < 0.5 ? 1 : 0, fabs(light[0]) < 0.5 ? 0 : 1, 0};
    v3_copy(view->w, light);
    v3_cross(view->u, helper, view->w);
    v3_scale(view->u, 1 / v3_norm(view->u), view->u);
    v3_cross(view->v, view->w, view->u);
    for (int k = 0; k < 3; k++) {
        view->center[k] = (bounds->lo[k] + bounds->hi[k]) / 2;
    }
    view->radius = cipc_bounds_diagonal(bounds) / 2;
}

/* Where a point falls in the map: x, y in samples, and a depth that is larger nearer to the light, 1 in the middle. */
static cipc_raster_corner in_map(const light_view *view, const double point[3])
{
    double q[3];
    v3_sub(q, point, view->center);
    return (cipc_raster_corner){
        .x = MAP_SAMPLES * (0.5 + 0.5 * v3_dot(q, view->u) / view->radius),
        .y = MAP_SAMPLES * (0.5 + 0.5 * v3_dot(q, view->v) / view->radius),
        .inverse_depth = 1 + depth_scale * v3_dot(q, view->w) / view->radius,
        .shade = {0, 0},
    };
}

/* Rods and particles are drawn in the same coordinates; y is down there, so `up` is against v. */
static cipc_round_view round_view(const light_view *view)
{
    cipc_round_view round = {.half_width = view->radius, .half_height = view->radius, .parallel = true, .nearest = -INFINITY,
                             .fade = depth_scale / view->radius, .least_width = least_texels};
    v3_copy(round.origin, view->center);
    v3_copy(round.right, view->u);
    v3_scale(round.up, -1, view->v);
    v3_copy(round.back, view->w);
    return round;
}

static void draw_map(light_view *view, const cipc_model *model, const double *position)
{
    static const cipc_colour none = {0, 0, 0};
    cipc_raster_clear(&view->map, none, none);
    for (int t = 0; t < model->triangle_count; t++) {
        const int *n = model->triangles[t];
        const double *a = position + 3 * n[0], *b = position + 3 * n[1], *c = position + 3 * n[2];
        const cipc_raster_corner corners[3] = {in_map(view, a), in_map(view, b), in_map(view, c)};
        cipc_raster_triangle(&view->map, corners, none, 0);
    }
    const cipc_round_view round = round_view(view);
    cipc_round_draw(&view->map, model, position, &round, NULL);
}

/* The point of space that a sample of the picture shows. */
static void unproject(const cipc_raster *raster, const cipc_camera *camera, int x, int y, double depth, double point[3])
{
    const double right = ((x + 0.5) / raster->width * 2 - 1) * camera->slope_x * depth;
    const double up = (1 - (y + 0.5) / raster->height * 2) * camera->slope_y * depth;
    for (int k = 0; k < 3; k++) {
        point[k] = camera->eye[k] + right * camera->right[k] + up * camera->up[k] - depth * camera->back[k];
    }
}

static bool in_shadow(const light_view *view, const double point[3])
{
    const cipc_raster_corner at = in_map(view, point);
    if (!(at.x >= 0 && at.x < MAP_SAMPLES && at.y >= 0 && at.y < MAP_SAMPLES)) {
        return false;
    }
    const double nearest = view->map.depth[(size_t)at.y * MAP_SAMPLES + (size_t)at.x];
    const double slack = depth_scale * slack_texels * 2 / MAP_SAMPLES; /* a sample is 2 radius / MAP_SAMPLES wide */
    return nearest > at.inverse_depth + slack;
}

bool cipc_shadow_cast(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_camera *camera,
                      const cipc_bounds *bounds, const double light[3])
{
    light_view view;
    look_from_light(&view, bounds, light);
    if (!(view.radius > 0)) {
        return true; /* nothing that could cast one */
    }
    if (!cipc_raster_init(&view.map, MAP_PIXELS, MAP_PIXELS)) {
        return false;
    }
    draw_map(&view, model, position);
    for (int y = 0; y < raster->height; y++) {
        for (int x = 0; x < raster->width; x++) {
            const size_t i = (size_t)y * (size_t)raster->width + (size_t)x;
            double point[3];
            if (raster->depth[i] > 0) {
                unproject(raster, camera, x, y, 1 / (double)raster->depth[i], point);
                const double left = in_shadow(&view, point) ? 1 - taken * (double)raster->key[i] : 1;
                for (int k = 0; k < 3; k++) {
                    raster->light[i][k] = (float)(left * raster->light[i][k]);
                }
            }
        }
    }
    cipc_raster_free(&view.map);
    return true;
}
