/* How rods and particles look in one frame: tubes and balls of their diameter. */
#ifndef OUTPUT_ROUND_LOOK_H
#define OUTPUT_ROUND_LOOK_H

#include "cipc/model.h"
#include "output/camera.h"
#include "output/lighting.h"
#include "output/raster.h"

/* How a raster sees space: through a point, as a camera does, or along parallel lines, as a distant light does. */
typedef struct cipc_round_view {
    double origin[3];
    double right[3], up[3], back[3];  /* orthonormal; the view goes against `back` */
    double half_width, half_height;   /* of the raster: at depth 1, or, of a parallel view, at any depth, m */
    bool parallel;
    double nearest;                   /* m, depth: nothing nearer is drawn */
    double fade;                      /* 1/m: the inverse depth of a parallel view is 1 - fade * depth */
    double least_width;               /* samples: what is thinner is drawn as wide as this */
} cipc_round_view;

/* The view of a camera, in which even a hair is wide enough to be seen. */
cipc_round_view cipc_round_view_of(const cipc_camera *camera);

/* Draw all segments and particles of the model. lighting NULL: depths only. */
void cipc_round_draw(cipc_raster *raster, const cipc_model *model, const double *position, const cipc_round_view *view,
                     const cipc_lighting *lighting);

#endif
