/* Readers of mesh files: what they find goes into parts. The scan stands at the beginning of a text without zero bytes. */
#ifndef SCENE_MESH_FORMATS_H
#define SCENE_MESH_FORMATS_H

#include "scene/mesh_parts.h"

/* Wavefront OBJ. segments: lines "s i j" are segments (.seg), not smoothing groups. */
cipc_status scene_read_obj(scene_scan *scan, scene_parts *parts, bool segments);
/* Gmsh, ASCII, 2.2 and 4.1. */
cipc_status scene_read_gmsh(scene_scan *scan, scene_parts *parts);
/* Legacy VTK, ASCII, unstructured grids and polydata. */
cipc_status scene_read_vtk(scene_scan *scan, scene_parts *parts);

/* cipc_mesh_read of a file's content, which '\0' follows. */
cipc_status scene_read_mesh_text(cipc_mesh *mesh, const char *path, const char *text, size_t length, cipc_mesh_kind kind, cipc_error *error);

#endif
