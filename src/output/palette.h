/* Colours. sRGB components in [0, 1] where a name says so, else linear light. */
#ifndef OUTPUT_PALETTE_H
#define OUTPUT_PALETTE_H

#include "cipc/model.h"

typedef struct cipc_colour { double r, g, b; } cipc_colour;

/* sRGB colour of a body in pictures: moving bodies in strong colours, fixed ones in greys; each in a fixed order that repeats. */
cipc_colour cipc_body_colour(const cipc_model *model, int body);
/* sRGB colour of the i-th curve of a plot. */
cipc_colour cipc_curve_colour(int i);

/* IEC 61966-2-1 transfer function: of a component, of all three. */
double cipc_srgb_to_linear(double encoded);
double cipc_linear_to_srgb(double linear);
cipc_colour cipc_colour_to_linear(cipc_colour srgb);

#endif
