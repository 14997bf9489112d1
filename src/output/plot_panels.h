/* The panels that the plots of every method have, and the sheet they are drawn on. */
#ifndef OUTPUT_PLOT_PANELS_H
#define OUTPUT_PLOT_PANELS_H

#include "output/axes.h"
#include "output/plot_table.h"

/* The columns that these panels read; a method's own follow. */
enum { CIPC_PLOT_TIME, CIPC_PLOT_GAP, CIPC_PLOT_STRETCH, CIPC_PLOT_SEGMENT_STRETCH, CIPC_PLOT_KINETIC, CIPC_PLOT_GRAVITATIONAL, CIPC_PLOT_ELASTIC, CIPC_PLOT_TOTAL, CIPC_PLOT_OWN };
#define CIPC_PLOT_KEYS                                                                                                                     \
    [CIPC_PLOT_TIME] = "time", [CIPC_PLOT_GAP] = "min_gap", [CIPC_PLOT_STRETCH] = "max_stretch", [CIPC_PLOT_SEGMENT_STRETCH] = "max_segment_stretch", \
    [CIPC_PLOT_KINETIC] = "energy.kinetic", [CIPC_PLOT_GRAVITATIONAL] = "energy.gravitational", [CIPC_PLOT_ELASTIC] = "energy.elastic", [CIPC_PLOT_TOTAL] = "energy.total"

/* Where a panel stands: from the left, from above. */
typedef struct cipc_plot_place { int column, row; } cipc_plot_place;

/* A white sheet for columns x 2 panels. */
cairo_surface_t *cipc_plot_sheet(int columns, cairo_t **cr);
/* After reading: the zero of gravitational energy is arbitrary, so it and the total are counted from the first step on; stretches of nothing are no numbers. */
void cipc_plot_prepare(cipc_plot_table *table);
/* Axes whose range holds these columns. */
cipc_axes cipc_plot_panel(const cipc_plot_table *table, cipc_plot_place place, bool log_y, const int *columns, int count);

/* `level`: where contact sets on, m. */
void cipc_plot_gap(const cipc_plot_table *table, cairo_t *cr, cipc_plot_place place, double level);
/* strain_limit 0: there is none. */
void cipc_plot_stretch(const cipc_plot_table *table, cairo_t *cr, cipc_plot_place place, double strain_limit);
void cipc_plot_energies(const cipc_plot_table *table, cairo_t *cr, cipc_plot_place place);
/* A count per step, as bars. */
void cipc_plot_count(const cipc_plot_table *table, cairo_t *cr, cipc_plot_place place, int column, const char *title);

#endif
