/* What a body is made of, and which keys that gives it. */
#ifndef SCENE_BODY_KIND_H
#define SCENE_BODY_KIND_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* The key of a body that holds its mesh: "shell", "rods", "particles" or "volume". */
const char *scene_kind_key(cipc_body_kind kind);
/* The elements that its mesh consists of. */
cipc_mesh_kind scene_kind_mesh(cipc_body_kind kind);
/* Is the body an object with known keys? */
bool scene_is_body(scene_reader *reader, const scene_cursor *body);
/* The kind of a body; rejects a body of none or several, and keys that bodies of that kind do not have. */
cipc_body_kind scene_read_kind(scene_reader *reader, const scene_cursor *body);
/* Read its mesh; empty if rejected. */
void scene_read_kind_mesh(scene_reader *reader, const scene_cursor *body, cipc_body_kind kind, unsigned long seed, cipc_mesh *mesh);

#endif
