/* The tetrahedra of a volume: generated or read. */
#ifndef SCENE_VOLUME_H
#define SCENE_VOLUME_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read a "volume" object, as scene_read_shell reads its own. */
void scene_read_volume(scene_reader *reader, const scene_cursor *volume, cipc_mesh *mesh);

#endif
