/* Rods and particles as a camera or a light sees them. They are not cut into triangles: each sample near one asks where its line of sight
 * enters the capsule, which gives depth and normal exactly, however near or slanted it is. */
#include "output/round_look.h"

#include <math.h>
#include "base/vector.h"
#include "output/capsule.h"

static const double least_pixels = 1.5; /* a hair that is thinner would come and go between the samples */

cipc_round_view cipc_round_view_of(const cipc_camera *camera)
{
    cipc_round_view view = {.half_width = camera->slope_x, .half_height = camera->slope_y, .nearest = cipc_camera_nearest(camera),
                            .least_width = least_pixels * CIPC_RASTER_SAMPLES};
    v3_copy(view.origin, camera->eye);
    v3_copy(view.right, camera->right);
    v3_copy(view.up, camera->up);
    v3_copy(view.back, camera->back);
    return view;
}

/* Coordinates in the view's frame: right, up, and depth. */
static void see(const cipc_round_view *view, const double point[3], double seen[3])
{
    double q[3];
    v3_sub(q, point, view->origin);
    seen[0] = v3_dot(q, view->right);
    seen[1] = v3_dot(q, view->up);
    seen[2] = -v3_dot(q, view->back);
}

/* Cut off what is nearer than the view allows; false: all is. */
static bool clip(const cipc_round_view *view, double a[3], double b[3])
{
    double *nearer = a[2] < b[2] ? a : b, *farther = a[2] < b[2] ? b : a;
    if (nearer[2] < view->nearest && farther[2] >= view->nearest) {
        const double t = (view->nearest - nearer[2]) / (farther[2] - nearer[2]);
        for (int k = 0; k < 3; k++) {
            nearer[k] += t * (farther[k] - nearer[k]);
        }
        nearer[2] = view->nearest;
    }
    return nearer[2] >= view->nearest;
}

/* Samples per metre across the line of sight. */
static double scale_at(const cipc_raster *raster, const cipc_round_view *view, double depth)
{
    return raster->width / (2 * view->half_width * (view->parallel ? 1 : depth));
}

/* A capsule in the raster: its ends, and how far from the line between them its samples may be. */
typedef struct strip { double a[2], b[2], reach; } strip;

static void project(const cipc_raster *raster, const cipc_round_view *view, const double seen[3], double sample[2])
{
    const double depth = view->parallel ? 1 : seen[2];
    sample[0] = raster->width * (0.5 + 0.5 * seen[0] / (view->half_width * depth));
    sample[1] = raster->height * (0.5 - 0.5 * seen[1] / (view->half_height * depth));
}

/* If a line of sight with slopes X, Y passes a point of depth z at distance r, its slopes differ from the point's by at most
 * r sqrt(1 + X^2 + Y^2) / z. */
static strip strip_of(const cipc_raster *raster, const cipc_round_view *view, const cipc_capsule *capsule)
{
    strip s;
    const double slant = view->parallel ? 1 : sqrt(1 + view->half_width * view->half_width + view->half_height * view->half_height);
    project(raster, view, capsule->a, s.a);
    project(raster, view, capsule->b, s.b);
    s.reach = capsule->radius * slant * scale_at(raster, view, fmin(capsule->a[2], capsule->b[2]));
    return s;
}

/* The samples of row y that may be in the strip. */
static void strip_row(const strip *s, int y, int width, int *first, int *last)
{
    const double dx = s->b[0] - s->a[0], dy = s->b[1] - s->a[1], steepness = fabs(dy) / hypot(dx, dy);
    double left = fmin(s->a[0], s->b[0]) - s->reach, right = fmax(s->a[0], s->b[0]) + s->reach;
    const double flat = 1e-6; /* below it, the row runs along the strip */
    if (steepness > flat) {
        const double middle = s->a[0] + (y + 0.5 - s->a[1]) * dx / dy;
        left = fmax(left, middle - s->reach / steepness);
        right = fmin(right, middle + s->reach / steepness);
    }
    cipc_raster_range(left, right, width, first, last);
}

static cipc_shade shade_of(const cipc_round_view *view, const cipc_lighting *lighting, const double n[3])
{
    double normal[3];
    for (int k = 0; k < 3; k++) {
        normal[k] = n[0] * view->right[k] + n[1] * view->up[k] - n[2] * view->back[k];
    }
    return cipc_shade_of(lighting, normal);
}

/* What a sample of the raster looks along. */
typedef struct sight { double origin[3], direction[3]; } sight;

static sight sight_of(const cipc_raster *raster, const cipc_round_view *view, int x, int y)
{
    const double right = ((x + 0.5) / raster->width * 2 - 1) * view->half_width;
    const double up = (1 - (y + 0.5) / raster->height * 2) * view->half_height;
    return view->parallel ? (sight){{right, up, 0}, {0, 0, 1}} : (sight){{0, 0, 0}, {right, up, 1}};
}

static void see_sample(cipc_raster *raster, const cipc_round_view *view, const cipc_lighting *lighting, const cipc_capsule *capsule,
                       cipc_colour colour, int x, int y)
{
    const sight line = sight_of(raster, view, x, y);
    double depth, n[3];
    if (cipc_capsule_enter(capsule, line.origin, line.direction, &depth, n) && depth >= view->nearest) {
        cipc_raster_put(raster, x, y, 1 / depth, shade_of(view, lighting, n), colour);
    }
}

/* A light keeps the middle of what its ray goes through: so nothing round shades the side of it that is lit, however coarse the map. */
static void light_sample(cipc_raster *raster, const cipc_round_view *view, const cipc_capsule *capsule, cipc_colour colour, int x, int y)
{
    static const cipc_shade none = {0, 0};
    const sight line = sight_of(raster, view, x, y);
    const double backward[3] = {-line.direction[0], -line.direction[1], -line.direction[2]};
    double enter, back, n[3];
    if (cipc_capsule_enter(capsule, line.origin, line.direction, &enter, n) &&
        cipc_capsule_enter(capsule, line.origin, backward, &back, n)) {
        cipc_raster_put(raster, x, y, 1 - view->fade * 0.5 * (enter - back), none, colour);
    }
}

static void draw_capsule(cipc_raster *raster, const cipc_round_view *view, const cipc_lighting *lighting, const cipc_capsule *capsule,
                         cipc_colour colour)
{
    const strip s = strip_of(raster, view, capsule);
    int top, bottom, left, right;
    if (!isfinite(s.a[0] + s.a[1] + s.b[0] + s.b[1] + s.reach)) {
        return;
    }
    cipc_raster_range(fmin(s.a[1], s.b[1]) - s.reach, fmax(s.a[1], s.b[1]) + s.reach, raster->height, &top, &bottom);
    for (int y = top; y <= bottom; y++) {
        strip_row(&s, y, raster->width, &left, &right);
        for (int x = left; x <= right; x++) {
            if (view->parallel) {
                light_sample(raster, view, capsule, colour, x, y);
            } else {
                see_sample(raster, view, lighting, capsule, colour, x, y);
            }
        }
    }
}

/* From node a to node b, which may be the same. */
static void draw_round(cipc_raster *raster, const cipc_round_view *view, const cipc_lighting *lighting, const double *a, const double *b,
                       double diameter, cipc_colour colour)
{
    cipc_capsule capsule;
    see(view, a, capsule.a);
    see(view, b, capsule.b);
    if (clip(view, capsule.a, capsule.b)) {
        const double least = view->least_width / scale_at(raster, view, 0.5 * (capsule.a[2] + capsule.b[2]));
        capsule.radius = 0.5 * fmax(diameter, least);
        draw_capsule(raster, view, lighting, &capsule, colour);
    }
}

void cipc_round_draw(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_round_view *view,
                     const cipc_lighting *lighting)
{
    for (int b = 0; b < model->body_count; b++) {
        const cipc_body *body = &model->bodies[b];
        const cipc_colour colour = cipc_colour_to_linear(cipc_body_colour(model, b));
        const double diameter = body->material.thickness;
        for (int i = body->first_segment; i < body->first_segment + body->segment_count; i++) {
            const int *v = model->edges[model->first_segment + i];
            draw_round(raster, view, lighting, position + 3 * v[0], position + 3 * v[1], diameter, colour);
        }
        for (int n = body->first_node; n < body->first_node + body->node_count && body->kind == CIPC_BODY_PARTICLES; n++) {
            draw_round(raster, view, lighting, position + 3 * n, position + 3 * n, diameter, colour);
        }
    }
}
