/* A rest shape from a mesh of its own: garments sewn from flat panels, bodies that start deformed. */
#ifndef SCENE_REST_MESH_H
#define SCENE_REST_MESH_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* If the body's "rest" names a mesh, read it: it must have the elements of `mesh`. If it is "flat", the pattern of `mesh`, which must have one.
 * The nodes are the caller's (cipc_free); NULL: neither, or rejected. */
double *scene_read_rest_mesh(scene_reader *reader, const scene_cursor *body, cipc_mesh_kind kind, const cipc_mesh *mesh);

#endif
