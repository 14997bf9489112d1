/* Random and adversarial stencils in motion: two primitives face each other at a gap, approach or slide past one another, in every way that has ever made
 * collision detection fail. */
#ifndef CIPC_VERIFY_STENCILS_H
#define CIPC_VERIFY_STENCILS_H

#include <gsl/gsl_rng.h>
#include "cipc/base.h"

double verify_uniform(gsl_rng *rng, double low, double high);
double verify_log_uniform(gsl_rng *rng, double low, double high);
int verify_index(gsl_rng *rng, int count);
bool verify_chance(gsl_rng *rng, double share);

/* How two primitives are to lie and move. Lengths in units of the stencil's size. */
typedef struct verify_shape {
    double size;      /* m */
    double gap;       /* along the common normal */
    double thickness; /* the primitives are at thickness + gap */
    double angle;     /* between the edges, rad; or the triangle's flatness */
    double offset;    /* of the world: translation, in units of the size */
    double approach;  /* way along the normal, towards one another */
    double slide;     /* way across */
    double tumble;    /* of each node by itself */
    double common;    /* motion of both */
    double foot;      /* where the closest points lie: 0 anywhere inside, else this near to an end or a side */
    bool aligned;     /* not turned: the gap is not rounded by a rotation */
} verify_shape;
verify_shape verify_shape_default(void);

/* Positions and displacements of such a stencil; closest features are the insides unless the foot says otherwise. */
void verify_place(gsl_rng *rng, cipc_pair_kind kind, const verify_shape *shape, cipc_stencil_path *path);

#endif
