/* Sheets of springs on equilateral triangles, moved and brought to rest by plain semi-implicit Euler: for tests of springs. Anything that fails ends the test. */
#ifndef SUPPORT_SPRING_SHEET_H
#define SUPPORT_SPRING_SHEET_H

#include "cipc/massspring.h"
#include "cipc/scene.h"
#include "massspring/topology.h"

typedef struct spring_sheet {
    cipc_mesh mesh;
    cipc_model *model;
    int node_count;
    massspring_topology topology;
    cipc_spring *springs;           /* topology.count, of the form, stiffness and damping given */
    double *x, *v, *force;          /* 3 * node_count */
    double *mass, *inverse_mass;    /* node_count; of the cloth, inverse 0: held */
    double gravity[3];
    double drag;                    /* 1/s, times mass and velocity */
    double step;                    /* of spring_sheet_step, s */
} spring_sheet;

/* columns by rows cells with edge d, kg/m^2; bending springs have a part `bending` of the stiffness. At rest in the x-z plane. */
void spring_sheet_init(spring_sheet *sheet, double d, int columns, int rows, double surface_density, const cipc_spring *spring, double bending);
void spring_sheet_free(spring_sheet *sheet);

/* Every coordinate moves by up to `by`, velocities are up to 1 m/s in each, masses become 0.5 to 1.5 of what they were. */
void spring_sheet_crumple(spring_sheet *sheet, unsigned long seed, double by);

/* Forces of springs and gravity at x, v. */
void spring_sheet_forces(spring_sheet *sheet);
/* One step of semi-implicit Euler; drag is implicit, so that the step stays stable. */
void spring_sheet_step(spring_sheet *sheet);
/* Largest force on a free node, N, at the forces last taken, without drag. */
double spring_sheet_residual(const spring_sheet *sheet);
/* Steps until no free node feels more than `residual`, N. Returns how many. */
int spring_sheet_settle(spring_sheet *sheet, double residual, int steps_max);

#endif
