/* Four panels over simulated time, from stats.jsonl of the method mass-spring. */
#include "cipc/output.h"
#include "output/plot_panels.h"
#include "output/png.h"

#include <math.h>

enum { DEFORMATION = CIPC_PLOT_OWN, CONTACTS, ARRIVALS, ITERATIONS, COLUMN_COUNT };

/* `bound` 0: there is none. */
static void draw_deformation(const cipc_plot_table *t, cairo_t *cr, cipc_plot_place place, double bound)
{
    const int columns[] = {DEFORMATION};
    cipc_axes axes = cipc_plot_panel(t, place, false, columns, 1);
    if (!axes.empty) {
        cipc_axes_include(&axes, axes.x_lo, bound);
        cipc_axes_include(&axes, axes.x_lo, 0);
    }
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Deformation of springs", "time [s]", "B [1]");
    if (bound > 0) {
        cipc_axes_level(&axes, cr, bound, cipc_curve_colour(1), "bound");
    }
    cipc_axes_curve(&axes, cr, t->values[CIPC_PLOT_TIME], t->values[DEFORMATION], t->count, cipc_curve_colour(0), "largest");
}

/* Iterations become those of an arrival; without one there is nothing to plot. */
static void divide_by_arrivals(cipc_plot_table *t)
{
    for (int i = 0; i < t->count; i++) {
        const double arrivals = t->values[ARRIVALS][i];
        t->values[ITERATIONS][i] = arrivals > 0 ? t->values[ITERATIONS][i] / arrivals : (double)NAN;
    }
}

static cipc_status draw(const char *path, const cipc_plot_table *t, double bound, cipc_error *error)
{
    cairo_t *cr;
    cairo_surface_t *surface = cipc_plot_sheet(2, &cr);
    draw_deformation(t, cr, (cipc_plot_place){0, 0}, bound);
    cipc_plot_count(t, cr, (cipc_plot_place){1, 0}, CONTACTS, "Nodes in contact");
    cipc_plot_energies(t, cr, (cipc_plot_place){0, 1});
    cipc_plot_count(t, cr, (cipc_plot_place){1, 1}, ITERATIONS, "Evaluations of bisection per arrival");
    cairo_destroy(cr);
    cipc_status status = cipc_png_write(path, surface, error);
    cairo_surface_destroy(surface);
    return status;
}

cipc_status cipc_massspring_plots_png(const char *path, const char *stats_path, double bound, cipc_error *error)
{
    static const char *const keys[COLUMN_COUNT] = {CIPC_PLOT_KEYS, [DEFORMATION] = "deformation", [CONTACTS] = "contacts", [ARRIVALS] = "arrivals", [ITERATIONS] = "bisection_iterations"};
    cipc_plot_table t;
    cipc_status status = cipc_plot_table_read(&t, stats_path, keys, COLUMN_COUNT, error);
    if (status == CIPC_OK) {
        cipc_plot_prepare(&t);
        divide_by_arrivals(&t);
        status = draw(path, &t, bound, error);
    }
    cipc_plot_table_free(&t);
    return status;
}
