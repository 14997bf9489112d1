/* The nodes and elements of a mesh file, as they are read; then the mesh of one kind of them. */
#ifndef SCENE_MESH_PARTS_H
#define SCENE_MESH_PARTS_H

#include "cipc/scene.h"
#include "scene/text_scan.h"

/* Arrays grow with what has been read, never with what a file announces. */
typedef struct scene_parts {
    cipc_mesh_kind kind;         /* wanted: elements of other kinds are counted only */
    const char *one, *many;      /* what the format calls a node: "vertex", "vertices" */
    int first;                   /* the format's number of the first node */
    long long node_count, node_capacity;
    double *nodes;
    long long element_count, corner_capacity, line_capacity;
    long long *corners;          /* scene_corners(kind) an element, nodes from 0 */
    int *lines;                  /* where each element stands */
    long long seen[4];           /* elements of each kind in the file */
    long long unread_count;      /* elements of types that are not read */
    char unread[32];             /* what the first of them is */
} scene_parts;

/* Nodes of an element: 3, 2, 1, 4. */
int scene_corners(cipc_mesh_kind kind);
/* "triangles", "segments", "nodes", "tetrahedra". */
const char *scene_kind_name(cipc_mesh_kind kind);

scene_parts scene_parts_of(cipc_mesh_kind kind);
void scene_parts_free(scene_parts *parts);

/* Room for one more element of `size` bytes behind `count` in a growing array. OUT_OF_MEMORY at the line read last. */
cipc_status scene_grow(scene_scan *scan, void *array, long long count, long long *capacity, size_t size);

cipc_status scene_parts_add_node(scene_parts *parts, scene_scan *scan, const double x[3]);
/* An element of some kind with scene_corners(kind) nodes, from 0, not yet checked; kept if the kind is wanted. */
cipc_status scene_parts_add(scene_parts *parts, scene_scan *scan, int line, cipc_mesh_kind kind, const long long *corners);
/* The triangles a b c, a c d, ... of a polygon a b c d ...; the segments a b, b c, ... of a polyline. */
cipc_status scene_parts_add_polygon(scene_parts *parts, scene_scan *scan, int line, const long long *corners, long long count);
cipc_status scene_parts_add_polyline(scene_parts *parts, scene_scan *scan, int line, const long long *corners, long long count);
/* Elements of a type that is not read. */
void scene_parts_skip(scene_parts *parts, const char *what, long long count);

/* The mesh. Checks that there are elements of the wanted kind, that their nodes are there and differ, and that tetrahedra have a volume; those of negative volume are turned.
 * keep_all: keep nodes that no element uses (those of particles are always kept). */
cipc_status scene_parts_finish(const scene_parts *parts, scene_scan *scan, bool keep_all, cipc_mesh *mesh);

#endif
