/* Shadows of the key light: which samples of a finished raster does it not reach? */
#ifndef OUTPUT_SHADOW_H
#define OUTPUT_SHADOW_H

#include "cipc/model.h"
#include "output/camera.h"
#include "output/raster.h"

/* Take key light from the samples from which the way to the light is blocked by a surface, a rod or a particle. `light` is the unit vector
 * towards the light. The subject is what the bounds hold; shadows of things far outside it are left out. False: out of memory. */
bool cipc_shadow_cast(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_camera *camera,
                      const cipc_bounds *bounds, const double light[3]);

#endif
