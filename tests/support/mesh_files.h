/* Mesh files written as text in the test itself. */
#ifndef SUPPORT_MESH_FILES_H
#define SUPPORT_MESH_FILES_H

#include <stddef.h>

#include "cipc/scene.h"

/* What cipc_mesh_read makes of a file of this name (its ending decides the format) and content. path, if not NULL, receives at most 600 bytes of its path. */
cipc_status try_mesh(const char *name, const char *text, size_t length, cipc_mesh_kind kind, cipc_mesh *mesh, cipc_error *error, char *path);
/* The file is good. */
cipc_mesh accept_mesh(const char *name, const char *text, cipc_mesh_kind kind);
/* Reading fails with this status at the line of the '@' in the text, which is taken out before (no '@': at the file as a whole), with a message of one line that
 * contains `what`, and leaves an empty mesh. */
void reject_mesh(const char *name, const char *text, cipc_mesh_kind kind, cipc_status status, const char *what);

/* The file cut off after every byte, read for every kind of mesh: an error or a mesh whose elements are sound, never a crash; up to `needed` bytes, always an error for
 * `kind`. Then every byte replaced by several others. */
void maim_mesh_file(const char *name, const char *text, cipc_mesh_kind kind, size_t needed);
/* Every allocation fails once. */
void starve_mesh_file(const char *name, const char *text, cipc_mesh_kind kind);

#endif
