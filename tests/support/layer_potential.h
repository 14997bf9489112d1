/* The penalty layers as SPEC A.4 writes them down, summed here term by term from the definition, so that tests need not ask the library what it should give. */
#ifndef SUPPORT_LAYER_POTENTIAL_H
#define SUPPORT_LAYER_POTENTIAL_H

/* eta(l) = eta(1) l^(-1/4), r(l) = r(1) l^3. */
typedef struct layer_law { double thickness, stiffness; } layer_law;

/* How many layers are thicker than the gap. */
int layer_law_count(layer_law law, double gap);
/* sum over l of 1/2 r(l) (eta(l) - gap)^2 of those, J; and its force, N. */
double layer_law_energy(layer_law law, double gap);
double layer_law_force(layer_law law, double gap);
/* The gap at which they have taken up an energy, or carry a force. */
double layer_law_gap_at_energy(layer_law law, double energy);
double layer_law_gap_at_force(layer_law law, double force);
/* What an elastic head-on impact of a mass m takes: for each layer, s, the time that it is in reach. times[1..count]; the turning gap is returned. */
double layer_law_times(layer_law law, double mass, double speed, int count, double *times);
/* h(l) of leapfrog at the fraction gamma of the stable step of one mass against something that does not move, omega^2 = r(l)/m (F2). */
double layer_law_step(layer_law law, double mass, double gamma, int layer);

#endif
