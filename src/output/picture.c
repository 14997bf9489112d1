/* Contact sheet of a run: shaded frames side by side, with their times. */
#include "cipc/output.h"
#include "output/camera.h"
#include "output/png.h"
#include "output/raster.h"
#include "output/round_look.h"
#include "output/shadow.h"
#include "output/surface_look.h"

#include <math.h>
#include <string.h>

enum { MARGIN = 6 }; /* pixels around every tile */
static const double default_azimuth = 0.6, default_elevation = 0.42; /* rad */
static const double size_of_scenery = 1.6; /* a fixed body up to this many times as large as the moving ones is kept in view */

cipc_picture_options cipc_picture_options_default(void)
{
    return (cipc_picture_options){.columns = 3,
                                  .rows = 2,
                                  .tile_width = 480,
                                  .tile_height = 360,
                                  .azimuth = default_azimuth,
                                  .elevation = default_elevation,
                                  .zoom = 1};
}

/* The frames to show, in memory. */
typedef struct sheet {
    int count, columns, rows;
    int node_count;
    double *positions; /* count * 3 * node_count */
    double *times;     /* count */
    double *normals;   /* scratch, 3 * node_count */
    cipc_raster raster;
    cipc_camera camera;
    cipc_bounds subject; /* what the camera looks at */
} sheet;

static void sheet_free(sheet *s)
{
    cipc_free(s->positions);
    cipc_free(s->times);
    cipc_free(s->normals);
    cipc_raster_free(&s->raster);
}

static const double *frame_positions(const sheet *s, int tile)
{
    return s->positions + 3 * (size_t)s->node_count * (size_t)tile;
}

static cipc_status sheet_load(sheet *s, const char *trajectory_path, int frames, cipc_error *error)
{
    const size_t numbers = 3 * (size_t)s->node_count;
    s->positions = cipc_alloc(numbers * (size_t)s->count, sizeof(double));
    s->times = cipc_alloc((size_t)s->count, sizeof(double));
    s->normals = cipc_alloc(numbers, sizeof(double));
    if (s->positions == NULL || s->times == NULL || s->normals == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, trajectory_path, "no memory for %d frames", s->count);
    }
    for (int i = 0; i < s->count; i++) {
        const int frame = s->count > 1 ? (int)lround((double)i * (frames - 1) / (s->count - 1)) : 0;
        cipc_status status =
            cipc_trajectory_read(trajectory_path, frame, s->positions + numbers * (size_t)i, s->node_count, &s->times[i], error);
        if (status != CIPC_OK) {
            return status;
        }
    }
    return CIPC_OK;
}

/* How far a body reaches around its nodes. */
static double radius_of(const cipc_body *body)
{
    return body->kind == CIPC_BODY_RODS || body->kind == CIPC_BODY_PARTICLES ? body->material.thickness / 2 : 0;
}

static void add_body(const sheet *s, const cipc_body *body, cipc_bounds *bounds)
{
    for (int i = 0; i < s->count; i++) {
        for (int n = body->first_node; n < body->first_node + body->node_count; n++) {
            cipc_bounds_add(bounds, frame_positions(s, i) + 3 * n, radius_of(body));
        }
    }
}

/* Does the body decide where the camera stands? If nobody says otherwise, moving bodies do, and fixed ones that are not much larger than these. */
static bool is_subject(const sheet *s, const cipc_model *model, int b, const bool *chosen, double diagonal_of_moving)
{
    const cipc_body *body = &model->bodies[b];
    if (chosen != NULL) return chosen[b];
    if (!body->fixed || !(diagonal_of_moving > 0)) {
        return true;
    }
    cipc_bounds own = cipc_bounds_empty();
    add_body(s, body, &own);
    return cipc_bounds_diagonal(&own) <= size_of_scenery * diagonal_of_moving;
}

static void place_camera(sheet *s, const cipc_model *model, const cipc_picture_options *options)
{
    cipc_bounds moving = cipc_bounds_empty();
    s->subject = cipc_bounds_empty();
    for (int b = 0; b < model->body_count; b++) {
        if (!model->bodies[b].fixed) {
            add_body(s, &model->bodies[b], &moving);
        }
    }
    const double diagonal = cipc_bounds_diagonal(&moving);
    for (int b = 0; b < model->body_count; b++) {
        if (is_subject(s, model, b, options->subject, diagonal)) {
            add_body(s, &model->bodies[b], &s->subject);
        }
    }
    s->camera = cipc_camera_look(&s->subject, options->azimuth, options->elevation, (double)options->tile_width / options->tile_height);
    for (int b = 0; b < model->body_count; b++) {
        const cipc_body *body = &model->bodies[b];
        const bool subject = is_subject(s, model, b, options->subject, diagonal);
        for (int i = 0; i < s->count && subject; i++) {
            for (int n = body->first_node; n < body->first_node + body->node_count; n++) {
                cipc_camera_fit(&s->camera, frame_positions(s, i) + 3 * n, radius_of(body));
            }
        }
    }
    cipc_camera_settle(&s->camera, &s->subject, options->zoom);
}

static void draw_label(cairo_t *cr, double x, double y, double time)
{
    char text[64];
    snprintf(text, sizeof text, "t = %.3g s", time);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 15);
    cairo_set_source_rgb(cr, 0.16, 0.18, 0.22);
    cairo_move_to(cr, x + 12, y + 24);
    cairo_show_text(cr, text);
}

/* False: out of memory. */
static bool draw_tiles(sheet *s, const cipc_model *model, const cipc_picture_options *options, cairo_surface_t *surface)
{
    static const cipc_colour top = {0.965, 0.970, 0.978}, bottom = {0.855, 0.872, 0.895};
    const cipc_lighting lighting = cipc_lighting_of(&s->camera);
    const cipc_round_view round = cipc_round_view_of(&s->camera);
    bool good = true;
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    for (int i = 0; i < s->count && good; i++) {
        const int left = MARGIN + i % s->columns * (options->tile_width + MARGIN);
        const int upper = MARGIN + i / s->columns * (options->tile_height + MARGIN);
        cipc_raster_clear(&s->raster, top, bottom);
        cipc_surface_draw(&s->raster, model, frame_positions(s, i), &s->camera, &lighting, s->normals);
        cipc_round_draw(&s->raster, model, frame_positions(s, i), &round, &lighting);
        good = cipc_shadow_cast(&s->raster, model, frame_positions(s, i), &s->camera, &s->subject, lighting.key);
        cipc_raster_resolve(&s->raster, surface, left, upper);
        draw_label(cr, left, upper, s->times[i]);
    }
    cairo_destroy(cr);
    return good;
}

static cipc_status sheet_paint(sheet *s, const char *path, const cipc_model *model, const cipc_picture_options *options, cipc_error *error)
{
    if (!cipc_raster_init(&s->raster, options->tile_width, options->tile_height)) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory to draw the picture");
    }
    place_camera(s, model, options);
    const int width = MARGIN + s->columns * (options->tile_width + MARGIN), height = MARGIN + s->rows * (options->tile_height + MARGIN);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cipc_status status = CIPC_OK;
    if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS && draw_tiles(s, model, options, surface)) {
        status = cipc_png_write(path, surface, error);
    } else {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for a picture of %d x %d pixels", width, height);
    }
    cairo_surface_destroy(surface);
    return status;
}

cipc_status cipc_frames_png(const char *path, const char *trajectory_path, const cipc_model *model, const cipc_picture_options *options,
                            cipc_error *error)
{
    if (options->columns < 1 || options->rows < 1 || options->tile_width < 1 || options->tile_height < 1 || options->columns > 64 ||
        options->rows > 64 || options->tile_width > 8192 || options->tile_height > 8192) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, path,
                         "a contact sheet has 1 to 64 columns and rows of tiles 1 to 8192 pixels wide and high");
    }
    int frames = 0;
    cipc_status status = cipc_trajectory_count(trajectory_path, &frames, error);
    if (status != CIPC_OK) {
        return status;
    }
    const int tiles = options->columns * options->rows, shown = frames < tiles ? frames : tiles;
    if (shown < 1) {
        return cipc_fail(error, CIPC_E_IO, trajectory_path, "the trajectory has no frames to show");
    }
    sheet s = {.count = shown, .node_count = model->node_count};
    s.columns = shown < options->columns ? shown : options->columns;
    s.rows = (shown + s.columns - 1) / s.columns;
    status = sheet_load(&s, trajectory_path, frames, error);
    if (status == CIPC_OK) {
        status = sheet_paint(&s, path, model, options, error);
    }
    sheet_free(&s);
    return status;
}
