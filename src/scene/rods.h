/* The segments of rods: generated or read. */
#ifndef SCENE_RODS_H
#define SCENE_RODS_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read a "rods" object, as scene_read_shell reads its own. */
void scene_read_rods(scene_reader *reader, const scene_cursor *rods, unsigned long seed, cipc_mesh *mesh);

#endif
