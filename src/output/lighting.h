/* The lights of a picture, and how bright they make a surface. */
#ifndef OUTPUT_LIGHTING_H
#define OUTPUT_LIGHTING_H

#include "output/camera.h"

/* Unit vectors towards the main light, over the viewer's left shoulder, and towards a weak one from the right. */
typedef struct cipc_lighting { double key[3], fill[3]; } cipc_lighting;
cipc_lighting cipc_lighting_of(const cipc_camera *camera);

/* How bright something is, 1 being about its full colour, and how much of that it owes to the key light: what a shadow can take away. */
typedef struct cipc_shade { double brightness, key; } cipc_shade;
/* Of a surface whose unit normal towards the eye is n. */
cipc_shade cipc_shade_of(const cipc_lighting *lighting, const double n[3]);

#endif
