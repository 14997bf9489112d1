/* The triangles of a shell: generated or read. */
#ifndef SCENE_SHELL_H
#define SCENE_SHELL_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read a "shell" object; the path of a mesh file is taken relative to the scene file, and made absolute in the tree. The mesh is empty if
 * rejected. */
void scene_read_shell(scene_reader *reader, const scene_cursor *shell, unsigned long seed, cipc_mesh *mesh);

#endif
