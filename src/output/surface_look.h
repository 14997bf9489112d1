/* How the surfaces of a model look in one frame: corner normals and their brightness. */
#ifndef OUTPUT_SURFACE_LOOK_H
#define OUTPUT_SURFACE_LOOK_H

#include "cipc/model.h"
#include "output/camera.h"
#include "output/lighting.h"
#include "output/raster.h"

/* Draw all triangles of the model. normals[3 * node_count] is scratch space. */
void cipc_surface_draw(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_camera *camera,
                       const cipc_lighting *lighting, double *normals);

#endif
