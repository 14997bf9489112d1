/* Arrays of numbers of a known or unknown length. */
#ifndef SCENE_LISTS_H
#define SCENE_LISTS_H

#include "scene/reader.h"

/* The member `key`, which must be an array of `count` numbers or integers. Values that are rejected are 0. */
void scene_numbers(scene_reader *reader, const scene_cursor *object, const char *key, size_t count, scene_range range, double *values);
void scene_integers(scene_reader *reader, const scene_cursor *object, const char *key, size_t count, int lower, int upper, int *values);
/* The member `key`, which must be an array of `minimum` to `maximum` points of `dimension` numbers each, one behind the other; free with
 * cipc_free. NULL if rejected. */
double *scene_points(scene_reader *reader, const scene_cursor *object, const char *key, size_t dimension, size_t minimum, size_t maximum,
                     int *count);
/* The same of the array under the cursor. */
double *scene_points_at(scene_reader *reader, const scene_cursor *list, size_t dimension, size_t minimum, size_t maximum, int *count);
/* Integers likewise. */
int *scene_integer_list(scene_reader *reader, const scene_cursor *object, const char *key, int lower, int upper, size_t minimum,
                        size_t maximum, int *count);

#endif
