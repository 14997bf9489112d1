/* Scripted motion of a Dirichlet set. */
#ifndef SCENE_MOTIONS_H
#define SCENE_MOTIONS_H

#include "cipc/model.h"
#include "scene/reader.h"

/* Read the "motion" of a set: its windows, which are the caller's (cipc_free). */
void scene_read_motions(scene_reader *reader, const scene_cursor *set, int *count, cipc_motion **motions);

#endif
