/* Positions that a Dirichlet set passes through, from a sequence of files. */
#ifndef SCENE_TRACK_H
#define SCENE_TRACK_H

#include "cipc/model.h"
#include "scene/reader.h"

/* Whose track it is: `count` of the `body_count` nodes of a body, by their numbers in the body. */
typedef struct scene_tracked {
    const char *body;
    int body_count;
    const int *nodes;
    int count;
} scene_tracked;

/* Read a "track" object. The frames are the caller's (cipc_free); there are none if rejected. In the tree the files become absolute. */
void scene_read_track(scene_reader *reader, const scene_cursor *track, const scene_tracked *tracked, cipc_track *result);

#endif
