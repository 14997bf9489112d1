/* A body-centred lattice over a solid, with the cuts of its edges by the surface: what isosurface stuffing starts from. Its points are the corners and the middles of cubes; its edges
 * join neighbouring corners and neighbouring middles (long edges, as long as a cube's) and middles with the corners of their cubes (short ones, sqrt(3)/2 of that). */
#ifndef SCENE_CUT_LATTICE_H
#define SCENE_CUT_LATTICE_H

#include "scene/mesh.h"

/* Positive inside, negative outside, continuous. */
typedef double (*scene_depth)(const void *shape, const double x[3]);

enum { SCENE_LONG_EDGES = 3, SCENE_SHORT_EDGES = 8, SCENE_LATTICE_EDGES = SCENE_LONG_EDGES + SCENE_SHORT_EDGES };

/* Edges are owned by the lower of two points of a kind (slots 0 to 2: along x, y, z), and by middles (slots 3 to 10: to the corners of its cube, bits x, y, z of the slot - 3). */
typedef struct scene_lattice {
    int count[3];        /* points of each kind along x, y, z; the last middles of a row are beyond the box, and never used */
    long long points;    /* corners, then as many middles */
    double low[3], cell; /* m */
    double *place;       /* 3 * points: m; points near the surface have been moved onto it */
    signed char *side;   /* points: 1 inside, 0 on the surface, -1 outside */
    double *cut;         /* SCENE_LATTICE_EDGES * points: distance of the cut from the point that owns the edge, as a share of the edge; negative: none */
} scene_lattice;

/* Over the box from low to high, beyond which `depth` is negative, with cubes of `cell` m: points placed, edges cut, points too near to a cut moved onto it, their other cuts
 * forgotten. To be freed in any case. OUT_OF_RANGE: too many points. */
cipc_status scene_lattice_init(scene_lattice *lattice, scene_depth depth, const void *shape, const double low[3], const double high[3], double cell, const char *place,
                               cipc_error *error);
void scene_lattice_free(scene_lattice *lattice);

long long scene_lattice_point(const scene_lattice *lattice, bool middle, const int at[3]);
/* Does this point own such an edge within the box, and where does it lead? */
bool scene_lattice_has_edge(const scene_lattice *lattice, bool middle, const int at[3], int slot);
long long scene_lattice_other_end(const scene_lattice *lattice, long long point, int slot);
/* The point at a share of the way from a to b. */
void scene_lattice_between(const scene_lattice *lattice, long long a, long long b, double share, double x[3]);

#endif
