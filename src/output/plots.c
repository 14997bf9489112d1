/* Four panels over simulated time, from stats.jsonl. */
#include "cipc/output.h"
#include "output/axes.h"
#include "base/json_number.h"
#include "output/png.h"

#include <errno.h>
#include <math.h>
#include <string.h>

enum { WIDTH = 1200, HEIGHT = 800, PANEL_WIDTH = 490, PANEL_HEIGHT = 280 }; /* pixels */
static const double panel_left[2] = {82, 682}, panel_top[2] = {48, 440};

/* Columns of numbers, one row per step. */
typedef enum column { TIME, GAP, STRETCH, SEGMENT_STRETCH, KINETIC, GRAVITATIONAL, ELASTIC, TOTAL, NEWTON, COLUMN_COUNT } column;
typedef struct table {
    int count, capacity;
    double *values[COLUMN_COUNT];
} table;

static void table_free(table *t)
{
    for (int c = 0; c < COLUMN_COUNT; c++) {
        cipc_free(t->values[c]);
    }
}

static bool table_reserve(table *t)
{
    if (t->count < t->capacity) {
        return true;
    }
    const int capacity = t->capacity > 0 ? 2 * t->capacity : 256;
    for (int c = 0; c < COLUMN_COUNT; c++) {
        double *larger = cipc_realloc(t->values[c], (size_t)capacity, sizeof(double));
        if (larger == NULL) {
            return false;
        }
        t->values[c] = larger;
    }
    t->capacity = capacity;
    return true;
}

static void add_row(table *t, const json_t *line)
{
    static const char *const keys[COLUMN_COUNT] = {
        [TIME] = "time", [GAP] = "min_gap", [STRETCH] = "max_stretch", [SEGMENT_STRETCH] = "max_segment_stretch",
        [KINETIC] = "kinetic", [GRAVITATIONAL] = "gravitational", [ELASTIC] = "elastic", [TOTAL] = "total", [NEWTON] = "newton_iterations",
    };
    const json_t *energy = json_object_get(line, "energy");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        const bool is_energy = c >= KINETIC && c <= TOTAL;
        const double value = cipc_json_double(json_object_get(is_energy ? energy : line, keys[c]));
        const bool of_nothing = (c == STRETCH || c == SEGMENT_STRETCH) && value == 0; /* no triangle, no segment: nothing to plot */
        t->values[c][t->count] = of_nothing ? (double)NAN : value;
    }
    t->count++;
}

/* The lines up to the first that is broken: a run that was killed may have left half a line. */
static cipc_status table_read(table *t, const char *path, cipc_error *error)
{
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        return cipc_fail(error, errno == ENOENT ? CIPC_E_MISSING_FILE : CIPC_E_IO, path, "cannot read the statistics: %s", strerror(errno));
    }
    cipc_status status = CIPC_OK;
    json_t *line;
    while (status == CIPC_OK && (line = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL)) != NULL) {
        if (table_reserve(t)) {
            add_row(t, line);
        } else {
            status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the statistics");
        }
        json_decref(line);
    }
    fclose(in);
    return status;
}

/* The zero of gravitational energy is arbitrary: count it, and the total, from the first step on. */
static void shift_to_start(table *t)
{
    if (t->count > 0 && isfinite(t->values[GRAVITATIONAL][0])) {
        const double start = t->values[GRAVITATIONAL][0];
        for (int i = 0; i < t->count; i++) {
            t->values[GRAVITATIONAL][i] -= start;
            t->values[TOTAL][i] -= start;
        }
    }
}

static cipc_axes panel(const table *t, int column_of_panel, int row, bool log_y, const column *columns, int count)
{
    cipc_axes axes = cipc_axes_new(panel_left[column_of_panel], panel_top[row], PANEL_WIDTH, PANEL_HEIGHT, log_y);
    for (int c = 0; c < count; c++) {
        for (int i = 0; i < t->count; i++) {
            cipc_axes_include(&axes, t->values[TIME][i], t->values[columns[c]][i]);
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

static void draw_gap(const table *t, cairo_t *cr, double dhat)
{
    const column columns[] = {GAP};
    cipc_axes axes = panel(t, 0, 0, true, columns, 1);
    include_level(&axes, dhat);
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Smallest gap minus thickness", "time [s]", "[m]");
    cipc_axes_level(&axes, cr, dhat, cipc_curve_colour(1), "activation");
    cipc_axes_curve(&axes, cr, t->values[TIME], t->values[GAP], t->count, cipc_curve_colour(0), "gap");
}

static bool any_number(const table *t, column c)
{
    for (int i = 0; i < t->count; i++) {
        if (isfinite(t->values[c][i])) {
            return true;
        }
    }
    return false;
}

static void draw_stretch(const table *t, cairo_t *cr, double strain_limit)
{
    const column columns[] = {STRETCH, SEGMENT_STRETCH};
    cipc_axes axes = panel(t, 1, 0, false, columns, 2);
    include_level(&axes, 1);
    if (strain_limit > 0) {
        include_level(&axes, strain_limit);
    }
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Largest stretch", "time [s]", "[1]");
    if (strain_limit > 0) {
        cipc_axes_level(&axes, cr, strain_limit, cipc_curve_colour(1), "limit");
    }
    if (any_number(t, SEGMENT_STRETCH)) {
        cipc_axes_curve(&axes, cr, t->values[TIME], t->values[SEGMENT_STRETCH], t->count, cipc_curve_colour(2), "rods");
    }
    if (any_number(t, STRETCH)) {
        cipc_axes_curve(&axes, cr, t->values[TIME], t->values[STRETCH], t->count, cipc_curve_colour(0), "triangles");
    }
}

static void draw_energies(const table *t, cairo_t *cr)
{
    const column columns[] = {KINETIC, GRAVITATIONAL, ELASTIC, TOTAL};
    static const char *const names[] = {"kinetic", "gravitational", "elastic", "total"};
    cipc_axes axes = panel(t, 0, 1, false, columns, 4);
    cipc_axes_settle(&axes);
    cipc_axes_draw(&axes, cr, "Energies", "time [s]", "[J]");
    for (int c = 3; c >= 0; c--) {
        cipc_axes_curve(&axes, cr, t->values[TIME], t->values[columns[c]], t->count, cipc_curve_colour(c), names[c]);
    }
}

static void draw_newton(const table *t, cairo_t *cr)
{
    const column columns[] = {NEWTON};
    cipc_axes axes = panel(t, 1, 1, false, columns, 1);
    const double step = t->count > 1 ? (t->values[TIME][t->count - 1] - t->values[TIME][0]) / (t->count - 1) : 1;
    if (!axes.empty && isfinite(step)) {
        cipc_axes_include(&axes, axes.x_lo - step / 2, 0);
        cipc_axes_include(&axes, axes.x_hi + step / 2, 0);
    }
    cipc_axes_settle(&axes);
    axes.y_lo = 0;
    cipc_axes_draw(&axes, cr, "Newton iterations per step", "time [s]", "[1]");
    cipc_axes_bars(&axes, cr, t->values[TIME], t->values[NEWTON], t->count, 0.8 * step, cipc_curve_colour(0));
}

static cipc_status draw(const char *path, const table *t, double strain_limit, double dhat, cipc_error *error)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    draw_gap(t, cr, dhat);
    draw_stretch(t, cr, strain_limit);
    draw_energies(t, cr);
    draw_newton(t, cr);
    cairo_destroy(cr);
    cipc_status status = cipc_png_write(path, surface, error);
    cairo_surface_destroy(surface);
    return status;
}

cipc_status cipc_plots_png(const char *path, const char *stats_path, double strain_limit, double dhat, cipc_error *error)
{
    table t = {0};
    cipc_status status = table_read(&t, stats_path, error);
    if (status == CIPC_OK) {
        shift_to_start(&t);
        status = draw(path, &t, strain_limit, dhat, error);
    }
    table_free(&t);
    return status;
}
