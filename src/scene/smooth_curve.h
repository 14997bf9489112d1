/* A smooth curve through points, measured along its length: natural cubic splines over the lengths of the chords. */
#ifndef SCENE_SMOOTH_CURVE_H
#define SCENE_SMOOTH_CURVE_H

#include <gsl/gsl_spline.h>

#include "cipc/base.h"

typedef struct scene_curve {
    int pieces;           /* between one point and the next */
    double *knots;        /* pieces + 1: the parameter at each point, m: sums of the lengths of the chords */
    double *lengths;      /* pieces + 1: the length of the curve up to each point, m */
    gsl_spline *place[3]; /* x, y and z over the parameter */
} scene_curve;

/* Through `count` >= 2 points, straight on at both ends (second derivatives 0 there). OUT_OF_RANGE: fewer points, two equal ones behind each other, numbers that are not
 * finite. The curve is to be freed in any case. */
cipc_status scene_curve_init(scene_curve *curve, int count, const double (*points)[3], const char *place, cipc_error *error);
void scene_curve_free(scene_curve *curve);

double scene_curve_length(const scene_curve *curve); /* m */
/* The parameter at a length s of the curve, 0 to its whole length, m. */
double scene_curve_parameter(const scene_curve *curve, double s);
/* Point and derivative with respect to the parameter there: about the unit tangent. */
void scene_curve_at(const scene_curve *curve, double parameter, double x[3], double derivative[3]);

/* Splines of three numbers each: NULL if there is no memory. values[3 k], ... at knots[k]. For what goes with a curve: normals at its points. */
bool scene_spline3_init(gsl_spline *spline[3], int count, const double *knots, const double (*values)[3]);
void scene_spline3_free(gsl_spline *spline[3]);
void scene_spline3_at(gsl_spline *const spline[3], double parameter, double value[3]);

#endif
