/* Panels over simulated time that every method has. */
#include "output/plot_panels.h"

#include <math.h>

enum { SPACING_X = 600, SPACING_Y = 392, LEFT = 82, TOP = 48, PANEL_WIDTH = 490, PANEL_HEIGHT = 280, HEIGHT = 800 }; /* pixels */

cairo_surface_t *cipc_plot_sheet(int columns, cairo_t **cr)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SPACING_X * columns, HEIGHT);
    *cr = cairo_create(surface);
    cairo_set_source_rgb(*cr, 1, 1, 1);
    cairo_paint(*cr);
    return surface;
}

static void drop_zeros(cipc_plot_table *t, int column)
{
    for (int i = 0; i < t->count; i++) {
        if (t->values[column][i] == 0) { /* no triangle, no segment: nothing to plot */
            t->values[column][i] = (double)NAN;
        }
    }
}

void cipc_plot_prepare(cipc_plot_table *t)
{
    drop_zeros(t, CIPC_PLOT_STRETCH);
    drop_zeros(t, CIPC_PLOT_SEGMENT_STRETCH);
    if (t->count > 0 && isfinite(t->values[CIPC_PLOT_GRAVITATIONAL][0])) {
        const double start = t->values[CIPC_PLOT_GRAVITATIONAL][0];
        for (int i = 0; i < t->count; i++) {
            t->values[CIPC_PLOT_GRAVITATIONAL][i] -= start;
            t->values[CIPC_PLOT_TOTAL][i] -= start;
        }
    }
}

cipc_axes cipc_plot_panel(const cipc_plot_table *t, cipc_plot_place place, bool log_y, const int *columns, int count)
{
    cipc_axes axes = cipc_axes_new(LEFT + SPACING_X * place.column, TOP + SPACING_Y * place.row, PANEL_WIDTH, PANEL_HEIGHT, log_y);
    for (int c = 0; c < count; c++) {
        for (int i = 0; i < t->count; i++) {
            cipc_axes_include(&axes, t->values[CIPC_PLOT_TIME][i], t->values[columns[c]][i]);
        }
    }
    return axes;
}

/* A level is included in the range only if there is a curve to hold against it. */
static void include_level(cipc_axes *axes, double level)
{
    if (!axes->empty) {
        cipc_axes_include(axes, axes->x_lo, level);
    }
}

void cipc_plot_gap(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place, double level)
{
    const int columns[] = {CIPC_PLOT_GAP};
    cipc_axes axes = cipc_plot_panel(t, place, true, columns, 1);
    include_level(&axes, level);
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Smallest gap minus thickness", "time [s]", "[m]");
    cipc_axes_level(&axes, cr, level, cipc_curve_colour(1), "activation");
    cipc_axes_curve(&axes, cr, t->values[CIPC_PLOT_TIME], t->values[CIPC_PLOT_GAP], t->count, cipc_curve_colour(0), "gap");
}

void cipc_plot_stretch(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place, double strain_limit)
{
    const int columns[] = {CIPC_PLOT_STRETCH, CIPC_PLOT_SEGMENT_STRETCH};
    cipc_axes axes = cipc_plot_panel(t, place, false, columns, 2);
    include_level(&axes, 1);
    if (strain_limit > 0) {
        include_level(&axes, strain_limit);
    }
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Largest stretch", "time [s]", "[1]");
    if (strain_limit > 0) {
        cipc_axes_level(&axes, cr, strain_limit, cipc_curve_colour(1), "limit");
    }
    if (cipc_plot_table_any(t, CIPC_PLOT_SEGMENT_STRETCH)) {
        cipc_axes_curve(&axes, cr, t->values[CIPC_PLOT_TIME], t->values[CIPC_PLOT_SEGMENT_STRETCH], t->count, cipc_curve_colour(2), "rods");
    }
    if (cipc_plot_table_any(t, CIPC_PLOT_STRETCH)) {
        cipc_axes_curve(&axes, cr, t->values[CIPC_PLOT_TIME], t->values[CIPC_PLOT_STRETCH], t->count, cipc_curve_colour(0), "triangles");
    }
}

void cipc_plot_energies(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place)
{
    const int columns[] = {CIPC_PLOT_KINETIC, CIPC_PLOT_GRAVITATIONAL, CIPC_PLOT_ELASTIC, CIPC_PLOT_TOTAL};
    static const char *const names[] = {"kinetic", "gravitational", "elastic", "total"};
    cipc_axes axes = cipc_plot_panel(t, place, false, columns, 4);
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Energies", "time [s]", "[J]");
    for (int c = 3; c >= 0; c--) {
        cipc_axes_curve(&axes, cr, t->values[CIPC_PLOT_TIME], t->values[columns[c]], t->count, cipc_curve_colour(c), names[c]);
    }
}

void cipc_plot_count(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place, int column, const char *title)
{
    const double *time = t->values[CIPC_PLOT_TIME];
    cipc_axes axes = cipc_plot_panel(t, place, false, &column, 1);
    const double step = t->count > 1 ? (time[t->count - 1] - time[0]) / (t->count - 1) : 1;
    if (!axes.empty && isfinite(step)) {
        cipc_axes_include(&axes, axes.x_lo - step / 2, 0);
        cipc_axes_include(&axes, axes.x_hi + step / 2, 0);
    }
    cipc_axes_settle(&axes);
    axes.y_lo = 0;
    cipc_axes_draw(&axes, cr, title, "time [s]", "[1]");
    cipc_axes_bars(&axes, cr, time, t->values[column], t->count, 0.8 * step, cipc_curve_colour(0));
}
