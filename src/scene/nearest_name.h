/* The known name that a misspelt one most likely stands for. */
#ifndef SCENE_NEAREST_NAME_H
#define SCENE_NEAREST_NAME_H

/* Number of letters to insert, delete, replace or swap with their neighbour that turns a into b (optimal string alignment; letter case is
 * ignored; only the first 63 bytes count). */
int scene_edit_distance(const char *a, const char *b);
/* The name of smallest distance; of equals the first. NULL if count is 0. */
const char *scene_nearest_name(const char *name, const char *const *names, int count);

#endif
