/* One panel of a plot: a box with ticks, curves in it, a legend. */
#ifndef OUTPUT_AXES_H
#define OUTPUT_AXES_H

#include <stdbool.h>
#include <cairo.h>
#include "output/palette.h"

typedef struct cipc_axes {
    double left, top, width, height;   /* of the box inside the labels, pixels */
    double x_lo, x_hi, y_lo, y_hi;     /* data at its sides */
    bool log_y;
    bool empty;                        /* no finite data: ranges are arbitrary */
    double legend_width;               /* so far, pixels */
} cipc_axes;

/* Ranges grow over what is added; values that are not finite (or not positive, on a logarithmic axis) are left out. */
cipc_axes cipc_axes_new(double left, double top, double width, double height, bool log_y);
void cipc_axes_include(cipc_axes *axes, double x, double y);
/* End of growing: a margin above and below, whole decades on a logarithmic axis, no empty range. */
void cipc_axes_settle(cipc_axes *axes);

/* Box, grid, ticks, labels; "no data" if that is so. */
void cipc_axes_draw(cipc_axes *axes, cairo_t *cr, const char *title, const char *x_label, const char *y_label);
/* A curve, broken where a point cannot be drawn; a point alone is a dot. legend may be NULL. */
void cipc_axes_curve(cipc_axes *axes, cairo_t *cr, const double *x, const double *y, int count, cipc_colour colour, const char *legend);
/* The area between two curves, broken where either cannot be drawn; a point alone is a stroke from one to the other. legend may be NULL. */
void cipc_axes_band(cipc_axes *axes, cairo_t *cr, const double *x, const double *lower, const double *upper, int count, cipc_colour colour, const char *legend);
/* Bars of the given width (in x) from the axis up. */
void cipc_axes_bars(cipc_axes *axes, cairo_t *cr, const double *x, const double *y, int count, double width, cipc_colour colour);
/* A dashed horizontal line with its name in the legend. */
void cipc_axes_level(cipc_axes *axes, cairo_t *cr, double y, cipc_colour colour, const char *legend);

#endif
