/* Finding and reading mesh files. */
#include "scene/mesh_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scene_resolve_path(const char *scene_path, const char *file, char path[PATH_MAX])
{
    const char *slash = strrchr(scene_path, '/');
    size_t folder = file[0] == '/' || slash == NULL ? 0 : (size_t)(slash - scene_path) + 1;
    if (folder + strlen(file) >= PATH_MAX) return false;
    memcpy(path, scene_path, folder);
    snprintf(path + folder, PATH_MAX - folder, "%s", file);
    return true;
}

/* BAD_MESH keeps its place, which is a line of the mesh file. */
void scene_read_mesh_file(scene_reader *r, const scene_cursor *object, cipc_mesh_kind kind, cipc_mesh *mesh)
{
    char path[PATH_MAX], absolute[PATH_MAX];
    cipc_error error;
    scene_cursor member = scene_member(object, "mesh");
    const char *name = scene_string_at(r, &member);
    *mesh = (cipc_mesh){0};
    if (r->status != CIPC_OK) return;
    if (!scene_resolve_path(r->path, name, path)) {
        scene_reject(r, &member, CIPC_E_MISSING_FILE, "a path of more than %d bytes", PATH_MAX - 1);
        return;
    }
    cipc_status status = cipc_mesh_read(mesh, path, kind, &error);
    if (status == CIPC_E_BAD_MESH) {
        r->error = error;
        r->status = status;
    } else if (status != CIPC_OK) {
        scene_reject(r, &member, status, "'%.400s' %s", path, error.what);
    } else if (realpath(path, absolute) != NULL) {
        scene_set(r, object, "mesh", json_string(absolute));
    }
}
