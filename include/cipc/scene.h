/* cipc/scene.h - a scene file (JSON) becomes a model, a state and the options of its integrator; mesh generators and readers.
 * Floor 7. The format is described in docs/scene.md. */
#ifndef CIPC_SCENE_H
#define CIPC_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/asynchronous.h"
#include "cipc/base.h"
#include "cipc/implicit.h"
#include "cipc/massspring.h"
#include "cipc/model.h"

/* A mesh: triangles of a shell, segments of rods, tetrahedra of a volume, or nodes alone; arrays are owned. */
typedef struct cipc_mesh {
    int node_count;
    double *nodes;             /* 3 * node_count, m */
    int triangle_count;
    int (*triangles)[3];
    int segment_count;
    int (*segments)[2];
    int tetrahedron_count;
    int (*tetrahedra)[4];      /* positive volume */
    double *pattern;           /* of garments and ribbons: the same nodes cut flat in the x-z plane, 3 * node_count, m; NULL: there is none */
    int panel_count, panel_columns, panel_rows; /* of garments: panels of columns * rows nodes each, row by row from the top, left to right; 0: none */
} cipc_mesh;
void cipc_mesh_free(cipc_mesh *mesh);

/* Generators. All lie where docs/scene.md says: sheets in the x-z plane around the origin with normal +y.
 * grid: cells_x by cells_z squares, split along one diagonal, or alternating ("union jack" of 2x2) if alternate. */
cipc_status cipc_mesh_grid(cipc_mesh *mesh, double size_x, double size_z, int cells_x, int cells_z, bool alternate, cipc_error *error);
/* Equilateral triangles, all edges of length `edge`, m: rows + 1 lines of columns + 1 nodes along x, x fastest, edge sqrt(3)/2 apart in z and shifted by -edge/4 and +edge/4 in turn, so
 * that the ends in x are ragged (straight ones would need half triangles). edge (columns + 1/2) wide in x, edge sqrt(3)/2 rows in z. */
cipc_status cipc_mesh_equilateral(cipc_mesh *mesh, double edge, int columns, int rows, cipc_error *error);
/* Irregular triangulation of a rectangle: about `nodes` points (boundary evenly spaced, inside jittered by a seeded generator), Delaunay by qhull. */
cipc_status cipc_mesh_irregular(cipc_mesh *mesh, double size_x, double size_z, int nodes, unsigned long seed, cipc_error *error);
/* Icosphere of a radius: an icosahedron split `subdivisions` times, 10 * 4^s + 2 nodes, normals outward. */
cipc_status cipc_mesh_icosphere(cipc_mesh *mesh, double radius, int subdivisions, cipc_error *error);
/* Wavefront OBJ: v and f lines (polygons are fanned, indices may be negative, v/vt/vn accepted). Errors name file and line. */
cipc_status cipc_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_error *error);

/* Shell of revolution about +y: `count` points (radius, height) of the profile, each a ring of `sectors` nodes (staggered from ring to ring), a point on the axis
 * (radius 0, first or last only) a single node. Normals to the right of the profile seen with +r to the right and +y up: outward if the profile goes up. */
cipc_status cipc_mesh_revolution(cipc_mesh *mesh, int count, const double (*profile)[2], int sectors, cipc_error *error);
/* Open cylinder about x, from -length/2 to length/2, of near-equilateral triangles: `around` nodes a ring, rings staggered, `along` + 1 rings. */
cipc_status cipc_mesh_cylinder(cipc_mesh *mesh, double radius, double length, int around, int along, cipc_error *error);

/* Capsule about y: balls of radii[0] and radii[1] around (0, -length/2, 0) and (0, length/2, 0) and the cone that touches both; `along` equal steps
 * from pole to pole, `around` nodes a ring. */
cipc_status cipc_mesh_capsule(cipc_mesh *mesh, const double radii[2], double length, int around, int along, cipc_error *error);

/* A bed of nails standing on y = 0 around the origin: count[0] x count[1] pyramids of four slivers each (no base), `spacing` from point to point in x and z, x fastest. Five nodes a
 * nail: the base's corners, then the point, which is at y = height. Slivers face outward. */
typedef struct cipc_nails {
    int count[2];
    double spacing[2], width, height; /* m */
} cipc_nails;
cipc_status cipc_mesh_nails(cipc_mesh *mesh, const cipc_nails *nails, cipc_error *error);

/* A ring of panels around y, of a skirt or a bodice: radius `top` at y = 0, `bottom` at y = -height, m; `down` rows of cells. The panels have nodes
 * of their own along the seams. */
typedef struct cipc_panel_ring {
    int panels, down;
    double top, bottom, height;
} cipc_panel_ring;
/* Gores: pieces of a cone, `across` cells each. The first begins at +x; then towards -z. Has a pattern. */
cipc_status cipc_mesh_gores(cipc_mesh *mesh, const cipc_panel_ring *ring, int across, cipc_error *error);
/* Knife pleats: `count` of them around, folded under by `depth`, layers a gap apart, both in m at the top, where `ring.top` is the mean radius; cells
 * across the way forward and the way back, and one at each fold. Has a pattern. OUT_OF_RANGE too if there is no room for the pleats, or if the columns
 * are so wide that layers come nearer than half the gap. */
typedef struct cipc_pleating {
    int count, forward, back;
    double depth, gap;
} cipc_pleating;
cipc_status cipc_mesh_pleats(cipc_mesh *mesh, const cipc_panel_ring *ring, const cipc_pleating *pleats, cipc_error *error);
/* Ribbon of a width along a smooth curve through `count` >= 2 points (natural cubic splines over the lengths of the chords), `along` x `across` cells cut along alternating
 * diagonals. Cross-sections lie at equal lengths of the curve; node i (across + 1) + j is j-th of section i, from -width/2 to width/2 along tangent x normal; triangles are turned
 * towards the normal. The pattern is a rectangle around the origin, along x as long as the chords between sections together. OUT_OF_RANGE if the curve runs along its normal or bends so sharply that an element has no size or is turned over. */
typedef struct cipc_ribbon {
    int count;
    const double (*points)[3];  /* m */
    const double (*normals)[3]; /* one for each point, of any length, interpolated as the points are; NULL: the first section's normal is carried along with the least rotation */
    double normal[3];           /* of the first section; not read if `normals` are given */
    double width;               /* m */
    int along, across;
} cipc_ribbon;
cipc_status cipc_mesh_ribbon(cipc_mesh *mesh, const cipc_ribbon *ribbon, cipc_error *error);

/* Rods. A polyline through `count` points, each stretch divided into `segments` equal segments; closed joins the last to the first. */
cipc_status cipc_mesh_polyline(cipc_mesh *mesh, int count, const double (*points)[3], int segments, bool closed, cipc_error *error);
/* Arc in the x-y plane about the origin from angle 0 at (radius, 0, 0), anticlockwise; angle 2 pi: a closed ring. */
cipc_status cipc_mesh_arc(cipc_mesh *mesh, double radius, double angle, int segments, cipc_error *error);
/* count[0] x count[1] x count[2] straight vertical (y) rods of a length, centred, `spacing` from axis to axis in x and z and from middle to middle in y; `round`: of each layer only
 * those within the inscribed ellipse. Nodes rod by rod from below, x fastest, then z, then y. */
cipc_status cipc_mesh_rods(cipc_mesh *mesh, const int count[3], const double spacing[3], double length, int segments, bool round, cipc_error *error);
/* Hair: every rod of such a mesh (rods of `segments`, `length` long) loses up to `shorten` < length at its lower end, at random (seeded). */
cipc_status cipc_mesh_shorten_rods(cipc_mesh *mesh, double length, int segments, double shorten, unsigned long seed, cipc_error *error);
/* Interwoven net of n + n rods along x and z, extent `size`, `segments` each; where two cross one is `lift` above and the other below, alternately. segments >= 2 n. */
cipc_status cipc_mesh_net(cipc_mesh *mesh, double size, int n, int segments, double lift, cipc_error *error);

/* Particles: a lattice of count[0] x count[1] x count[2] nodes around the origin, each moved by up to `jitter` in every coordinate (seeded). */
cipc_status cipc_mesh_lattice(cipc_mesh *mesh, const int count[3], const double spacing[3], double jitter, unsigned long seed, cipc_error *error);

/* Volumes. Box around the origin, each cell cut into six tetrahedra; ball: a cube of `cells`^3 carried onto the ball; solid cylinder about y likewise, `cells_across` cells wide. Both of these numbers are even. */
cipc_status cipc_mesh_box(cipc_mesh *mesh, const double size[3], const int cells[3], cipc_error *error);
cipc_status cipc_mesh_ball(cipc_mesh *mesh, double radius, int cells, cipc_error *error);
cipc_status cipc_mesh_solid_cylinder(cipc_mesh *mesh, double radius, double length, int cells_across, int cells_along, cipc_error *error);
/* Solid of revolution about +y: the section is a lattice of `rows` x `columns` points (radius >= 0, height), row by row, its cells convex and all turned the same way; `sectors` >= 3 around.
 * Points on the axis are single nodes. Nodes: point by point, each around from +x towards -z. */
cipc_status cipc_mesh_solid_revolution(cipc_mesh *mesh, int rows, int columns, const double (*points)[2], int sectors, cipc_error *error);

/* A ball swept along a segment, its radius growing or shrinking evenly on the way; begin = end: a ball. */
typedef struct cipc_capsule {
    double begin[3], end[3]; /* m */
    double radius[2];        /* m, > 0, at begin and end */
} cipc_capsule;
/* The union of capsules, figures for instance, filled with tetrahedra of a body-centred lattice of `cell` m; the surface's nodes lie on the capsules. `blend` (m, >= 0) rounds off the
 * corners where parts meet. In one piece: OUT_OF_RANGE if parts do not meet or are thinner than the cells resolve. */
cipc_status cipc_mesh_capsules(cipc_mesh *mesh, int count, const cipc_capsule *parts, double blend, double cell, cipc_error *error);

/* By the file's ending: .obj (surface; with l lines only: segments; with v lines only: particles), .seg (segments, as OBJ lines), .msh (Gmsh ASCII 2.2 and 4.1), .vtk (legacy ASCII unstructured grid or
 * polydata). Elements of the wanted kind must be there; the nodes that they do not use are left out (particles: all nodes). */
typedef enum cipc_mesh_kind { CIPC_MESH_TRIANGLES = 0, CIPC_MESH_SEGMENTS, CIPC_MESH_NODES, CIPC_MESH_TETRAHEDRA } cipc_mesh_kind;
cipc_status cipc_mesh_read(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error);

typedef struct cipc_scene {
    char *path;                          /* of the scene file */
    char *title;                         /* "" if the scene has none */
    char size[16];                       /* which block of sizes was applied: "ci", "desk", "paper", ... or "" */
    int steps;
    unsigned long seed;
    cipc_method method;
    cipc_implicit_options options;       /* of the method c-ipc; time_step and threads are those of every method */
    cipc_asynchronous_options asynchronous; /* of the method asynchronous */
    cipc_massspring_options massspring;  /* of the method mass-spring */
    int collider_count;                  /* of the method mass-spring; others have none */
    cipc_collider *colliders;
    bool monitor;                        /* default true */
    bool monitor_swept;                  /* paths too (M5); default true */
    double monitor_reach;                /* m */
    bool write_obj;
    double camera_azimuth, camera_elevation, camera_zoom;   /* of frames.png; degrees are never implied: radians */
    bool *camera_subject;                /* of each body, or NULL: does the camera look at it? */
    char *resolved;                      /* the scene as resolved (overrides applied, defaults filled in), JSON text */
    cipc_model *model;
    cipc_state *state;
} cipc_scene;

/* Load a scene; overrides are "PATH=VALUE" strings (docs/scene.md), applied in order after the size block ("size=desk" chooses it).
 * The initial state is not yet checked for intersections (the caller does that with the monitors). */
cipc_status cipc_scene_load(cipc_scene **scene, const char *path, int override_count, const char *const *overrides, cipc_error *error);
void cipc_scene_destroy(cipc_scene *scene);

/* A scene known by the catalogue: name, what it shows, source (paper, figure, SCENES row), its file. */
typedef struct cipc_scene_entry {
    const char *name, *title, *source, *file;
    cipc_status ends; /* as what its run ends: CIPC_OK; or what the scene is there to show, and then a run that comes to its end has not shown it */
} cipc_scene_entry;
const cipc_scene_entry *cipc_scene_catalogue(int *count);

/* What a scene costs at a size, as measured once (docs/scenes.md says where): nodes, steps, seconds on one thread with all monitors, peak memory. */
typedef struct cipc_scene_cost {
    const char *scene, *size;
    int nodes, steps;
    double seconds;            /* 0: not measured */
    int megabytes;
    bool extrapolated;         /* from the first steps, which are the cheap ones: at least so long */
} cipc_scene_cost;
/* NULL: no such scene or size. */
const cipc_scene_cost *cipc_scene_cost_of(const char *scene, const char *size);

#endif
