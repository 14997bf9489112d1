/* Samples with a depth buffer, and triangles of them: several samples a pixel, in linear light. */
#ifndef OUTPUT_RASTER_H
#define OUTPUT_RASTER_H

#include <stdbool.h>
#include <cairo.h>
#include "output/lighting.h"
#include "output/palette.h"

typedef struct cipc_raster {
    int width, height;       /* samples */
    float *depth;            /* 1 / distance along the view; 0: nothing */
    float (*light)[3];       /* linear r, g, b */
    float *key;              /* share of the light that is owed to the key light */
} cipc_raster;

enum { CIPC_RASTER_SAMPLES = 3 }; /* a side, so 9 a pixel */

/* A corner: x right, y down in samples, 1 / depth, and how bright the surface is there. */
typedef struct cipc_raster_corner {
    double x, y, inverse_depth;
    cipc_shade shade;
} cipc_raster_corner;

bool cipc_raster_init(cipc_raster *raster, int pixel_width, int pixel_height);
void cipc_raster_free(cipc_raster *raster);
/* A plain gradient from top to bottom (sRGB). */
void cipc_raster_clear(cipc_raster *raster, cipc_colour top, cipc_colour bottom);
/* The samples of a row or column of `size` that touch the interval; first > last: none. */
void cipc_raster_range(double lowest, double highest, int size, int *first, int *last);
/* Give a sample a colour (linear) times a brightness, unless it shows something nearer. */
void cipc_raster_put(cipc_raster *raster, int x, int y, double inverse_depth, cipc_shade shade, cipc_colour colour);
/* Fill a triangle: colour (linear) times the interpolated brightness; its edges are darkened by `ink` (0: not at all, 1: black). */
void cipc_raster_triangle(cipc_raster *raster, const cipc_raster_corner corner[3], cipc_colour colour, double ink);
/* Average the samples of each pixel into a CAIRO_FORMAT_RGB24 surface at (left, top). */
void cipc_raster_resolve(const cipc_raster *raster, cairo_surface_t *surface, int left, int top);

#endif
