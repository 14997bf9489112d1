/* Changing a scene before it is read: "PATH=VALUE" and blocks of sizes. */
#ifndef SCENE_OVERRIDES_H
#define SCENE_OVERRIDES_H

#include "scene/reader.h"

/* Apply the size block and then the overrides, in order, to reader->root; "sizes" is removed from the tree, and "size" holds the name
 * chosen.
 * The name is that of the last override "size=NAME", else the scene's own "size", else "ci" if the scene has sizes. */
cipc_status scene_apply_overrides(scene_reader *reader, int count, const char *const *overrides);

#endif
