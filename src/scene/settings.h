/* Everything of a scene that is not a body or a constraint: time, integrator, solver, contact, monitors, output. */
#ifndef SCENE_SETTINGS_H
#define SCENE_SETTINGS_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Fill title, size, steps, seed, method, the options of every method, colliders, monitor and camera of *scene, and the gravity (m/s^2). */
void scene_read_settings(scene_reader *reader, const scene_cursor *root, cipc_scene *scene, double gravity[3]);

#endif
