/* Mesh files that a scene names. */
#ifndef SCENE_MESH_FILE_H
#define SCENE_MESH_FILE_H

#include <limits.h>

#include "cipc/scene.h"
#include "scene/reader.h"

/* A path of a scene is taken relative to the scene file. False if the whole is too long. */
bool scene_resolve_path(const char *scene_path, const char *file, char path[PATH_MAX]);
/* Read the mesh whose path is the object's member "mesh", which is made absolute in the tree. The mesh is empty if rejected. */
void scene_read_mesh_file(scene_reader *reader, const scene_cursor *object, cipc_mesh_kind kind, cipc_mesh *mesh);

#endif
