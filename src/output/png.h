/* Cairo surfaces as PNG files. */
#ifndef OUTPUT_PNG_H
#define OUTPUT_PNG_H

#include <cairo.h>
#include "cipc/base.h"

/* Write the surface atomically. Also an error if a drawing operation on it has failed before. */
cipc_status cipc_png_write(const char *path, cairo_surface_t *surface, cipc_error *error);

#endif
