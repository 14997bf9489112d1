/* Solids of revolution as a scene describes them. */
#ifndef SCENE_SOLID_REVOLUTION_H
#define SCENE_SOLID_REVOLUTION_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read {"section": [[[r, y], ...], ...], "divide": [across, along], "sectors": n}; the mesh is empty if rejected. */
void scene_read_solid_revolution(scene_reader *reader, const scene_cursor *revolution, cipc_mesh *mesh);

#endif
