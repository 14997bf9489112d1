/* Are two scenes, as resolved JSON texts, the same simulation? */
#ifndef OUTPUT_SCENE_MATCH_H
#define OUTPUT_SCENE_MATCH_H

#include <stdbool.h>
#include <stddef.h>

/* True if the texts are equal as JSON values, apart from top-level members that do not change the trajectory. If they differ, the
 * dotted path of the first difference is put into path[size]. Text that is not JSON matches only text that is equal byte for byte. */
bool cipc_scene_match(const char *a, const char *b, char *path, size_t size);

#endif
