/* A body that stands for several: a stack, a row, a bundle. */
#ifndef SCENE_COPIES_H
#define SCENE_COPIES_H

#include "scene/reader.h"

enum { SCENE_COPIES_MAX = 10000 };

/* Copy i (from 0) of a body is the body as placed by its transform, turned by i angle about the axis through the origin and then moved by i translate. */
typedef struct scene_copies {
    int count;           /* 0: no "copies"; the body stands for itself */
    double axis[3];      /* of unit length */
    double angle;        /* rad */
    double translate[3]; /* m */
} scene_copies;

/* Read "copies" of a body, if it has them. */
void scene_read_copies(scene_reader *reader, const scene_cursor *body, scene_copies *copies);
/* Where copy i of the nodes at `position` (3 * node_count) lies. */
void scene_place_copy(const scene_copies *copies, int i, const double *position, int node_count, double *copy);

#endif
