/* One panel of a plot. */
#include "output/axes.h"

#include <math.h>
#include <stdio.h>

static const double margin_of_range = 0.06;   /* of the range, above and below */
static const double air_of_decade = 2;        /* factor */
static const double least_decade = -300, greatest_decade = 300; /* where a logarithmic axis ends */
static const double small_text = 12, title_text = 14; /* pixels */
enum { MOST_TICKS = 6, MOST_DECADES = 8 };

cipc_axes cipc_axes_new(double left, double top, double width, double height, bool log_y)
{
    return (cipc_axes){.left = left, .top = top, .width = width, .height = height, .x_lo = INFINITY, .x_hi = -INFINITY, .y_lo = INFINITY,
                       .y_hi = -INFINITY, .log_y = log_y, .empty = true};
}

static bool drawable(const cipc_axes *axes, double x, double y)
{
    return isfinite(x) && isfinite(y) && (!axes->log_y || y > 0);
}

void cipc_axes_include(cipc_axes *axes, double x, double y)
{
    if (drawable(axes, x, y)) {
        axes->x_lo = fmin(axes->x_lo, x);
        axes->x_hi = fmax(axes->x_hi, x);
        axes->y_lo = fmin(axes->y_lo, y);
        axes->y_hi = fmax(axes->y_hi, y);
        axes->empty = false;
    }
}

static void settle_linear(double *lo, double *hi)
{
    /* A range that rounding could produce from equal numbers is no range. */
    const double least = 1e-9 * fmax(fabs(*lo), fabs(*hi));
    if (*hi - *lo <= least) {
        const double half = *lo != 0 ? 0.01 * fabs(*lo) : 1;
        *lo -= half;
        *hi += half;
    }
    const double margin = margin_of_range * (*hi - *lo);
    *lo -= margin;
    *hi += margin;
}

void cipc_axes_settle(cipc_axes *axes)
{
    if (axes->empty) {
        axes->x_lo = 0;
        axes->x_hi = 1;
        axes->y_lo = axes->log_y ? 0.1 : 0;
        axes->y_hi = 1;
        return;
    }
    if (!(axes->x_hi > axes->x_lo)) {
        const double half = fmax(0.5, margin_of_range * fabs(axes->x_lo));
        axes->x_lo -= half;
        axes->x_hi += half;
    }
    if (!axes->log_y) {
        settle_linear(&axes->y_lo, &axes->y_hi);
        return;
    }
    const double lo = fmin(fmax(floor(log10(axes->y_lo)), least_decade), greatest_decade - 1);
    const double hi = fmin(fmax(ceil(log10(axes->y_hi)), lo + 1), greatest_decade);
    const double above = axes->y_hi > 0.7 * pow(10, hi) ? air_of_decade : 1; /* a curve along the box's side is hard to see */
    axes->y_lo = pow(10, lo);
    axes->y_hi = above * pow(10, hi);
}

static double place_x(const cipc_axes *axes, double x)
{
    return axes->left + axes->width * (x - axes->x_lo) / (axes->x_hi - axes->x_lo);
}

static double place_y(const cipc_axes *axes, double y)
{
    const double t = axes->log_y ? (log10(y) - log10(axes->y_lo)) / (log10(axes->y_hi) - log10(axes->y_lo))
                                 : (y - axes->y_lo) / (axes->y_hi - axes->y_lo);
    return axes->top + axes->height * (1 - t);
}

/* 1, 2 or 5 times a power of ten, so that at most MOST_TICKS fit. */
static double tick_step(double range)
{
    const double rough = range / MOST_TICKS, power = pow(10, floor(log10(rough))), factor = rough / power;
    return power * (factor <= 1 ? 1 : factor <= 2 ? 2 : factor <= 5 ? 5 : 10);
}

typedef enum anchor { LEFT, CENTRE, RIGHT } anchor;

static void put_text(cairo_t *cr, double x, double y, double size, anchor at, const char *text)
{
    cairo_text_extents_t extents;
    cairo_set_font_size(cr, size);
    cairo_text_extents(cr, text, &extents);
    cairo_move_to(cr, x - (at == LEFT ? 0 : at == CENTRE ? extents.x_advance / 2 : extents.x_advance), y);
    cairo_show_text(cr, text);
}

static void set_colour(cairo_t *cr, cipc_colour colour)
{
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
}

static const cipc_colour text_colour = {0.2, 0.22, 0.26}, grid_colour = {0.9, 0.91, 0.925}, box_colour = {0.55, 0.57, 0.6};

static void grid_line(cairo_t *cr, double x0, double y0, double x1, double y1)
{
    set_colour(cr, grid_colour);
    cairo_set_line_width(cr, 1);
    cairo_move_to(cr, round(x0) + 0.5, round(y0) + 0.5);
    cairo_line_to(cr, round(x1) + 0.5, round(y1) + 0.5);
    cairo_stroke(cr);
    set_colour(cr, text_colour);
}

static void put_x_tick(const cipc_axes *axes, cairo_t *cr, double x)
{
    char text[32];
    snprintf(text, sizeof text, "%.6g", x);
    grid_line(cr, place_x(axes, x), axes->top, place_x(axes, x), axes->top + axes->height);
    put_text(cr, place_x(axes, x), axes->top + axes->height + 17, small_text, CENTRE, text);
}

static void put_y_tick(const cipc_axes *axes, cairo_t *cr, double y, const char *text)
{
    grid_line(cr, axes->left, place_y(axes, y), axes->left + axes->width, place_y(axes, y));
    put_text(cr, axes->left - 7, place_y(axes, y) + 4, small_text, RIGHT, text);
}

static void put_linear_y_ticks(const cipc_axes *axes, cairo_t *cr)
{
    const double step = tick_step(axes->y_hi - axes->y_lo), first = ceil(axes->y_lo / step);
    for (int i = 0; i <= MOST_TICKS && (first + i) * step <= axes->y_hi; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.6g", (first + i) * step);
        put_y_tick(axes, cr, (first + i) * step, text);
    }
}

static void put_log_y_ticks(const cipc_axes *axes, cairo_t *cr)
{
    const int lo = (int)lround(log10(axes->y_lo)), hi = (int)floor(log10(axes->y_hi) + 1e-9),
              stride = (hi - lo + MOST_DECADES - 1) / MOST_DECADES;
    for (int decade = lo; decade <= hi; decade += stride) {
        char text[32];
        snprintf(text, sizeof text, "1e%d", decade);
        put_y_tick(axes, cr, pow(10, decade), text);
    }
}

static void put_y_label(const cipc_axes *axes, cairo_t *cr, const char *text)
{
    cairo_save(cr);
    cairo_translate(cr, axes->left - 58, axes->top + axes->height / 2);
    cairo_rotate(cr, -acos(0.0));
    put_text(cr, 0, 0, small_text, CENTRE, text);
    cairo_restore(cr);
}

void cipc_axes_draw(cipc_axes *axes, cairo_t *cr, const char *title, const char *x_label, const char *y_label)
{
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    const double step = tick_step(axes->x_hi - axes->x_lo), first = ceil(axes->x_lo / step);
    for (int i = 0; i <= MOST_TICKS && (first + i) * step <= axes->x_hi; i++) {
        put_x_tick(axes, cr, (first + i) * step);
    }
    if (axes->log_y) {
        put_log_y_ticks(axes, cr);
    } else {
        put_linear_y_ticks(axes, cr);
    }
    set_colour(cr, box_colour);
    cairo_rectangle(cr, round(axes->left) + 0.5, round(axes->top) + 0.5, round(axes->width), round(axes->height));
    cairo_stroke(cr);
    set_colour(cr, text_colour);
    put_text(cr, axes->left, axes->top - 10, title_text, LEFT, title);
    put_text(cr, axes->left + axes->width / 2, axes->top + axes->height + 35, small_text, CENTRE, x_label);
    put_y_label(axes, cr, y_label);
    if (axes->empty) {
        put_text(cr, axes->left + axes->width / 2, axes->top + axes->height / 2, title_text, CENTRE, "no data");
    }
}

/* Names stand above the box, each behind a piece of its line, from right to left in the order they are added. */
static void put_legend(cipc_axes *axes, cairo_t *cr, cipc_colour colour, const char *text)
{
    const double right = axes->left + axes->width - axes->legend_width, baseline = axes->top - 10;
    cairo_text_extents_t extents;
    cairo_set_font_size(cr, small_text);
    cairo_text_extents(cr, text, &extents);
    set_colour(cr, text_colour);
    put_text(cr, right, baseline, small_text, RIGHT, text);
    set_colour(cr, colour);
    cairo_move_to(cr, right - extents.x_advance - 24, baseline - 4);
    cairo_line_to(cr, right - extents.x_advance - 6, baseline - 4);
    cairo_stroke(cr);
    axes->legend_width += extents.x_advance + 40;
}

static void clip_to_box(const cipc_axes *axes, cairo_t *cr)
{
    cairo_rectangle(cr, axes->left, axes->top, axes->width + 1, axes->height + 1);
    cairo_clip(cr);
}

static void put_dot(cairo_t *cr, double x, double y)
{
    cairo_arc(cr, x, y, 2.5, 0, 4 * acos(0.0));
    cairo_fill(cr);
}

void cipc_axes_curve(cipc_axes *axes, cairo_t *cr, const double *x, const double *y, int count, cipc_colour colour, const char *legend)
{
    cairo_save(cr);
    cairo_set_line_width(cr, 1.8);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    if (legend != NULL) {
        put_legend(axes, cr, colour, legend);
    }
    clip_to_box(axes, cr);
    set_colour(cr, colour);
    for (int i = 0; i < count; i++) {
        const bool here = drawable(axes, x[i], y[i]);
        const bool before = i > 0 && drawable(axes, x[i - 1], y[i - 1]), after = i + 1 < count && drawable(axes, x[i + 1], y[i + 1]);
        if (here && before) {
            cairo_line_to(cr, place_x(axes, x[i]), place_y(axes, y[i]));
        } else if (here && after) {
            cairo_move_to(cr, place_x(axes, x[i]), place_y(axes, y[i]));
        } else if (here) {
            put_dot(cr, place_x(axes, x[i]), place_y(axes, y[i]));
        }
        if (here && !after) {
            cairo_stroke(cr);
        }
    }
    cairo_restore(cr);
}

/* Points first to last - 1: along the upper curve and back along the lower. */
static void fill_between(const cipc_axes *axes, cairo_t *cr, const double *x, const double *lower, const double *upper, int first, int last)
{
    for (int i = first; i < last; i++) {
        cairo_line_to(cr, place_x(axes, x[i]), place_y(axes, upper[i]));
    }
    for (int i = last - 1; i >= first; i--) {
        cairo_line_to(cr, place_x(axes, x[i]), place_y(axes, lower[i]));
    }
    if (last - first == 1) {
        cairo_stroke(cr);
    } else {
        cairo_close_path(cr);
        cairo_fill(cr);
    }
}

void cipc_axes_band(cipc_axes *axes, cairo_t *cr, const double *x, const double *lower, const double *upper, int count, cipc_colour colour, const char *legend)
{
    cairo_save(cr);
    cairo_set_line_width(cr, 6);
    if (legend != NULL) {
        put_legend(axes, cr, colour, legend);
    }
    clip_to_box(axes, cr);
    set_colour(cr, colour);
    for (int first = 0, last; first < count; first = last + 1) {
        for (last = first; last < count && drawable(axes, x[last], lower[last]) && drawable(axes, x[last], upper[last]);) {
            last++;
        }
        if (last > first) {
            fill_between(axes, cr, x, lower, upper, first, last);
        }
    }
    cairo_restore(cr);
}

void cipc_axes_bars(cipc_axes *axes, cairo_t *cr, const double *x, const double *y, int count, double width, cipc_colour colour)
{
    cairo_save(cr);
    clip_to_box(axes, cr);
    set_colour(cr, colour);
    const double bottom = axes->top + axes->height, pixels = fmax(width * axes->width / (axes->x_hi - axes->x_lo), 1);
    for (int i = 0; i < count; i++) {
        if (drawable(axes, x[i], y[i])) {
            cairo_rectangle(cr, place_x(axes, x[i]) - pixels / 2, place_y(axes, y[i]), pixels, bottom - place_y(axes, y[i]));
        }
    }
    cairo_fill(cr);
    cairo_restore(cr);
}

void cipc_axes_level(cipc_axes *axes, cairo_t *cr, double y, cipc_colour colour, const char *legend)
{
    const double dashes[] = {6, 4};
    if (!drawable(axes, axes->x_lo, y)) {
        return;
    }
    cairo_save(cr);
    cairo_set_line_width(cr, 1.5);
    cairo_set_dash(cr, dashes, 2, 0);
    put_legend(axes, cr, colour, legend);
    clip_to_box(axes, cr);
    cairo_move_to(cr, axes->left, place_y(axes, y));
    cairo_line_to(cr, axes->left + axes->width, place_y(axes, y));
    cairo_stroke(cr);
    cairo_restore(cr);
}
