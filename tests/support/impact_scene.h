/* Particles that fly straight at a fixed plane, side by side and out of each other's reach: many impacts in one run, each with a phase of its own to the clocks of the layers. */
#ifndef SUPPORT_IMPACT_SCENE_H
#define SUPPORT_IMPACT_SCENE_H

#include "support/asynchronous_scene.h"

enum { IMPACT_MOST = 1600 };
/* Everything in A.9 and F2 is about m = 1 kg, eta(1) = 0.1 m, r(1) = 1000 N/m; particles fly at distances of 0.5 m. */
extern const double impact_thickness, impact_stiffness, impact_mass;

/* F2's gamma counts in steps of 2/omega(l), omega(l)^2 = r(l)/m, of a particle on a plane; layer_factor in steps of 2/sqrt(r(l) 2/m), because two equal masses may meet (A.5). The same step:
 * layer_factor = sqrt(2) gamma. */
double impact_layer_factor(double gamma);

/* Particles at the given gaps above the plane y = 0 with the velocity `speed` towards it; elastic, without gravity; not built yet: frame and clocks are up to the test. */
void impact_scene_init(asynchronous_scene *scene, int count, const double *gaps, double speed, double gamma);
/* Gap and speed away from the plane of particle i. */
double impact_gap(const asynchronous_scene *scene, int i);
double impact_speed(const asynchronous_scene *scene, int i);

#endif
