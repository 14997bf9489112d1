/* cipc/scene.h - a scene file (JSON) becomes a model, a state and the options of its integrator; mesh generators and readers.
 * Floor 7. The format is described in docs/scene.md. */
#ifndef CIPC_SCENE_H
#define CIPC_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/implicit.h"
#include "cipc/model.h"

/* A surface mesh; arrays are owned. */
typedef struct cipc_mesh {
    int node_count;
    double *nodes;             /* 3 * node_count, m */
    int triangle_count;
    int (*triangles)[3];
} cipc_mesh;
void cipc_mesh_free(cipc_mesh *mesh);

/* Generators. All lie where docs/scene.md says: sheets in the x-z plane around the origin with normal +y.
 * grid: cells_x by cells_z squares, split along one diagonal, or alternating ("union jack" of 2x2) if alternate. */
cipc_status cipc_mesh_grid(cipc_mesh *mesh, double size_x, double size_z, int cells_x, int cells_z, bool alternate, cipc_error *error);
/* Irregular triangulation of a rectangle: about `nodes` points (boundary evenly spaced, inside jittered by a seeded generator), Delaunay by qhull. */
cipc_status cipc_mesh_irregular(cipc_mesh *mesh, double size_x, double size_z, int nodes, unsigned long seed, cipc_error *error);
/* Icosphere of a radius: an icosahedron split `subdivisions` times, 10 * 4^s + 2 nodes, normals outward. */
cipc_status cipc_mesh_icosphere(cipc_mesh *mesh, double radius, int subdivisions, cipc_error *error);
/* Wavefront OBJ: v and f lines (polygons are fanned, indices may be negative, v/vt/vn accepted). Errors name file and line. */
cipc_status cipc_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_error *error);

typedef struct cipc_scene {
    char *path;                          /* of the scene file */
    char *title;                         /* "" if the scene has none */
    char size[16];                       /* which block of sizes was applied: "ci", "desk", "paper", ... or "" */
    int steps;
    unsigned long seed;
    cipc_implicit_options options;
    bool monitor;                        /* default true */
    bool monitor_swept;                  /* paths too (M5); default true */
    double monitor_reach;                /* m */
    bool write_obj;
    double camera_azimuth, camera_elevation, camera_zoom;   /* of frames.png; degrees are never implied: radians */
    char *resolved;                      /* the scene as resolved (overrides applied, defaults filled in), JSON text */
    cipc_model *model;
    cipc_state *state;
} cipc_scene;

/* Load a scene; overrides are "PATH=VALUE" strings (docs/scene.md), applied in order after the size block ("size=desk" chooses it).
 * The initial state is not yet checked for intersections (the caller does that with the monitors). */
cipc_status cipc_scene_load(cipc_scene **scene, const char *path, int override_count, const char *const *overrides, cipc_error *error);
void cipc_scene_destroy(cipc_scene *scene);

/* A scene known by the catalogue: name, what it shows, source (paper, figure, SCENES row), its file. */
typedef struct cipc_scene_entry { const char *name, *title, *source, *file; } cipc_scene_entry;
const cipc_scene_entry *cipc_scene_catalogue(int *count);

#endif
