/* Six panels over simulated time, from stats.jsonl of the method asynchronous. */
#include "cipc/output.h"
#include "output/plot_panels.h"
#include "output/png.h"

enum { EVENTS = CIPC_PLOT_OWN, LAYERS, SMALLEST_STEP, QUANTILES, COLUMN_COUNT = QUANTILES + CIPC_QUANTILES };

/* A curve's colour, paler: 0 white, 1 itself. */
static cipc_colour pale(cipc_colour c, double strength)
{
    return (cipc_colour){1 - strength * (1 - c.r), 1 - strength * (1 - c.g), 1 - strength * (1 - c.b)};
}

/* Bands from the outermost quantiles inwards, then the median: each lies on the one before. */
static void draw_vertex_steps(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place)
{
    static const char *const names[] = {"all", "90 %", "50 %"};
    static const double strengths[] = {0.15, 0.35, 0.6};
    enum { BANDS = CIPC_QUANTILES / 2, MEDIAN = QUANTILES + BANDS };
    const int columns[] = {QUANTILES, QUANTILES + CIPC_QUANTILES - 1, SMALLEST_STEP};
    const double *time = t->values[CIPC_PLOT_TIME];
    cipc_axes axes = cipc_plot_panel(t, place, true, columns, 3);
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Vertex steps", "time [s]", "[s]");
    for (int b = 0; b < BANDS; b++) {
        cipc_axes_band(&axes, cr, time, t->values[QUANTILES + b], t->values[QUANTILES + CIPC_QUANTILES - 1 - b], t->count, pale(cipc_curve_colour(0), strengths[b]), names[b]);
    }
    cipc_axes_curve(&axes, cr, time, t->values[MEDIAN], t->count, cipc_curve_colour(0), "median");
    cipc_axes_curve(&axes, cr, time, t->values[SMALLEST_STEP], t->count, cipc_curve_colour(1), "least clock");
}

static cipc_status draw(const char *path, const cipc_plot_table *t, double thickness, cipc_error *error)
{
    cairo_t *cr;
    cairo_surface_t *surface = cipc_plot_sheet(3, &cr);
    cipc_plot_gap(t, cr, (cipc_plot_place){0, 0}, thickness);
    cipc_plot_stretch(t, cr, (cipc_plot_place){1, 0}, 0);
    cipc_plot_energies(t, cr, (cipc_plot_place){2, 0});
    draw_vertex_steps(t, cr, (cipc_plot_place){0, 1});
    cipc_plot_count(t, cr, (cipc_plot_place){1, 1}, EVENTS, "Events per step");
    cipc_plot_count(t, cr, (cipc_plot_place){2, 1}, LAYERS, "Deepest layer");
    cairo_destroy(cr);
    cipc_status status = cipc_png_write(path, surface, error);
    cairo_surface_destroy(surface);
    return status;
}

cipc_status cipc_asynchronous_plots_png(const char *path, const char *stats_path, double thickness, cipc_error *error)
{
    static const char *const own[] = {[EVENTS] = "total_events", [LAYERS] = "layers", [SMALLEST_STEP] = "smallest_step"};
    static const char *const common[] = {CIPC_PLOT_KEYS};
    const char *keys[COLUMN_COUNT];
    char quantiles[CIPC_QUANTILES][32];
    for (int c = 0; c < QUANTILES; c++) {
        keys[c] = c < CIPC_PLOT_OWN ? common[c] : own[c];
    }
    for (int q = 0; q < CIPC_QUANTILES; q++) {
        snprintf(quantiles[q], sizeof quantiles[q], "vertex_steps.%s", cipc_quantile_names[q]);
        keys[QUANTILES + q] = quantiles[q];
    }
    cipc_plot_table t;
    cipc_status status = cipc_plot_table_read(&t, stats_path, keys, COLUMN_COUNT, error);
    if (status == CIPC_OK) {
        cipc_plot_prepare(&t);
        status = draw(path, &t, thickness, error);
    }
    cipc_plot_table_free(&t);
    return status;
}
