/* Grid, irregular sheet, icosphere or OBJ file. */
#include "scene/shell.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"

enum { SUBDIVISIONS_MAX = 8 };

/* A generator's own complaint, moved to its place in the scene. */
static void adopt(scene_reader *r, const scene_cursor *cursor, cipc_status status, const cipc_error *error)
{
    if (status != CIPC_OK) scene_reject(r, cursor, status, "%s", error->what);
}

static void read_pair(scene_reader *r, const scene_cursor *object, const char *key, double pair[2])
{
    scene_cursor member = scene_member(object, key);
    pair[0] = pair[1] = 1;
    if (member.value == NULL) scene_reject(r, &member, CIPC_E_MISSING_KEY, "required, but missing: an array of 2 numbers");
    if (!scene_is_array(r, &member, 2, 2)) return;
    for (size_t k = 0; k < 2; k++) {
        scene_cursor element = scene_element(&member, k);
        pair[k] = scene_number_at(r, &element, scene_positive);
    }
}

static void read_cells(scene_reader *r, const scene_cursor *grid, int cells[2])
{
    scene_cursor member = scene_member(grid, "cells");
    cells[0] = cells[1] = 1;
    if (member.value == NULL) scene_reject(r, &member, CIPC_E_MISSING_KEY, "required, but missing: an array of 2 integers");
    if (!scene_is_array(r, &member, 2, 2)) return;
    for (size_t k = 0; k < 2; k++) {
        scene_cursor element = scene_element(&member, k);
        cells[k] = scene_integer_at(r, &element, 1, SCENE_NODES_MAX);
    }
}

static void read_grid(scene_reader *r, const scene_cursor *grid, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "cells", "alternate", NULL};
    double size[2];
    int cells[2];
    cipc_error error;
    if (!scene_is_object(r, grid, keys)) return;
    read_pair(r, grid, "size", size);
    read_cells(r, grid, cells);
    bool alternate = scene_boolean(r, grid, "alternate", false);
    if (r->status == CIPC_OK) adopt(r, grid, cipc_mesh_grid(mesh, size[0], size[1], cells[0], cells[1], alternate, &error), &error);
}

static void read_irregular(scene_reader *r, const scene_cursor *irregular, unsigned long seed, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "nodes", "seed", NULL};
    double size[2];
    cipc_error error;
    if (!scene_is_object(r, irregular, keys)) return;
    read_pair(r, irregular, "size", size);
    int nodes = scene_integer(r, irregular, "nodes", SCENE_REQUIRED, 4, SCENE_NODES_MAX);
    unsigned long own_seed = (unsigned long)scene_integer(r, irregular, "seed", (int)seed, 0, INT_MAX);
    if (r->status == CIPC_OK) adopt(r, irregular, cipc_mesh_irregular(mesh, size[0], size[1], nodes, own_seed, &error), &error);
}

static void read_icosphere(scene_reader *r, const scene_cursor *sphere, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "subdivisions", NULL};
    cipc_error error;
    if (!scene_is_object(r, sphere, keys)) return;
    double radius = scene_number(r, sphere, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    int subdivisions = scene_integer(r, sphere, "subdivisions", SCENE_REQUIRED, 0, SUBDIVISIONS_MAX);
    if (r->status == CIPC_OK) adopt(r, sphere, cipc_mesh_icosphere(mesh, radius, subdivisions, &error), &error);
}

/* The path as seen from the working directory. False if it is too long. */
static bool resolve(const char *scene_path, const char *mesh_path, char path[PATH_MAX])
{
    const char *slash = strrchr(scene_path, '/');
    size_t folder = mesh_path[0] == '/' || slash == NULL ? 0 : (size_t)(slash - scene_path) + 1;
    if (folder + strlen(mesh_path) >= PATH_MAX) return false;
    memcpy(path, scene_path, folder);
    snprintf(path + folder, PATH_MAX - folder, "%s", mesh_path);
    return true;
}

/* BAD_MESH keeps its place, which is a line of the mesh file. */
static void read_file(scene_reader *r, const scene_cursor *shell, cipc_mesh *mesh)
{
    char path[PATH_MAX], absolute[PATH_MAX];
    cipc_error error;
    scene_cursor member = scene_member(shell, "mesh");
    const char *name = scene_string_at(r, &member);
    if (r->status != CIPC_OK) return;
    if (!resolve(r->path, name, path)) {
        scene_reject(r, &member, CIPC_E_MISSING_FILE, "a path of more than %d bytes", PATH_MAX - 1);
        return;
    }
    cipc_status status = cipc_mesh_read_obj(mesh, path, &error);
    if (status == CIPC_E_BAD_MESH) {
        r->error = error;
        r->status = status;
    } else if (status != CIPC_OK) {
        scene_reject(r, &member, status, "'%.400s' %s", path, error.what);
    } else if (realpath(path, absolute) != NULL) {
        scene_set(r, shell, "mesh", json_string(absolute));
    }
}

void scene_read_shell(scene_reader *r, const scene_cursor *shell, unsigned long seed, cipc_mesh *mesh)
{
    static const char *const keys[] = {"grid", "irregular", "icosphere", "mesh", NULL};
    *mesh = (cipc_mesh){0};
    if (!scene_is_object(r, shell, keys)) return;
    int ways = 0, way = 0;
    for (int i = 0; keys[i] != NULL; i++) {
        if (json_object_get(shell->value, keys[i]) == NULL) continue;
        ways++;
        way = i;
    }
    scene_cursor member = scene_member(shell, keys[way]);
    if (ways == 0)
        scene_reject(r, shell, CIPC_E_MISSING_KEY, "needs one of grid, irregular, icosphere, mesh");
    else if (ways > 1)
        scene_reject(r, shell, CIPC_E_OUT_OF_RANGE, "has %d of grid, irregular, icosphere, mesh, but must have one", ways);
    else if (way == 0)
        read_grid(r, &member, mesh);
    else if (way == 1)
        read_irregular(r, &member, seed, mesh);
    else if (way == 2)
        read_icosphere(r, &member, mesh);
    else
        read_file(r, shell, mesh);
}
