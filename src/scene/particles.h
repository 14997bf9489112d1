/* The nodes of particles: generated, listed or read. */
#ifndef SCENE_PARTICLES_H
#define SCENE_PARTICLES_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read a "particles" object, as scene_read_shell reads its own. */
void scene_read_particles(scene_reader *reader, const scene_cursor *particles, unsigned long seed, cipc_mesh *mesh);

#endif
