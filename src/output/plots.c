/* Four panels over simulated time, from stats.jsonl. */
#include "cipc/output.h"
#include "output/plot_panels.h"
#include "output/png.h"

enum { NEWTON = CIPC_PLOT_OWN, COLUMN_COUNT };

static cipc_status draw(const char *path, const cipc_plot_table *t, double strain_limit, double dhat, cipc_error *error)
{
    cairo_t *cr;
    cairo_surface_t *surface = cipc_plot_sheet(2, &cr);
    cipc_plot_gap(t, cr, (cipc_plot_place){0, 0}, dhat);
    cipc_plot_stretch(t, cr, (cipc_plot_place){1, 0}, strain_limit);
    cipc_plot_energies(t, cr, (cipc_plot_place){0, 1});
    cipc_plot_count(t, cr, (cipc_plot_place){1, 1}, NEWTON, "Newton iterations per step");
    cairo_destroy(cr);
    cipc_status status = cipc_png_write(path, surface, error);
    cairo_surface_destroy(surface);
    return status;
}

cipc_status cipc_plots_png(const char *path, const char *stats_path, double strain_limit, double dhat, cipc_error *error)
{
    static const char *const keys[COLUMN_COUNT] = {CIPC_PLOT_KEYS, [NEWTON] = "newton_iterations"};
    cipc_plot_table t;
    cipc_status status = cipc_plot_table_read(&t, stats_path, keys, COLUMN_COUNT, error);
    if (status == CIPC_OK) {
        cipc_plot_prepare(&t);
        status = draw(path, &t, strain_limit, dhat, error);
    }
    cipc_plot_table_free(&t);
    return status;
}
