/* The kind of a body is told by the key of its mesh. */
#include "scene/body_kind.h"

#include <string.h>

#include "scene/alternatives.h"
#include "scene/particles.h"
#include "scene/rods.h"
#include "scene/shell.h"
#include "scene/volume.h"

enum { KIND_COUNT = 4, OWN_KEYS_MAX = 10 };

static const char *const mesh_keys[] = {"shell", "rods", "particles", "volume", NULL}; /* in the order of cipc_body_kind */

/* Besides those of every body. */
static const char *const own_keys[KIND_COUNT][OWN_KEYS_MAX] = {
    {"shell", "material", "membrane_factor", "bending_factor", "density", "thickness", "membrane", "bending", "strain_limit", NULL},
    {"rods", "density", "diameter", "young", "bending", "bending_factor", "rest_curvature", NULL},
    {"particles", "density", "diameter", NULL},
    {"volume", "density", "young", "poisson", "model", NULL},
};

const char *scene_kind_key(cipc_body_kind kind)
{
    return mesh_keys[kind];
}

cipc_mesh_kind scene_kind_mesh(cipc_body_kind kind)
{
    static const cipc_mesh_kind kinds[KIND_COUNT] = {CIPC_MESH_TRIANGLES, CIPC_MESH_SEGMENTS, CIPC_MESH_NODES, CIPC_MESH_TETRAHEDRA};
    return kinds[kind];
}

bool scene_is_body(scene_reader *r, const scene_cursor *body)
{
    static const char *const keys[] = {"name",      "offset",   "friction", "fixed",    "transform",       "rest",           "velocity",
                                       "damping",   "density",  "shell",    "material", "membrane_factor", "bending_factor", "thickness",
                                       "membrane",  "bending",  "rods",     "diameter", "strain_limit",    "rest_curvature", "young",
                                       "particles", "volume",   "poisson",  "model",    "collision_group", "copies", NULL};
    return scene_is_object(r, body, keys);
}

static bool is_own_key(const char *key, cipc_body_kind kind)
{
    for (const char *const *own = own_keys[kind]; *own != NULL; own++) {
        if (strcmp(key, *own) == 0) return true;
    }
    return false;
}

/* Keys of other kinds are known, so no nearest name helps: what helps are the keys of this kind. */
static void check_keys(scene_reader *r, const scene_cursor *body, cipc_body_kind kind)
{
    char own[200];
    scene_list_names(own_keys[kind] + 1, own, sizeof own);
    for (int other = 0; other < KIND_COUNT; other++) {
        for (int i = 1; own_keys[other][i] != NULL; i++) {
            scene_cursor member = scene_member(body, own_keys[other][i]);
            if (member.value == NULL || is_own_key(own_keys[other][i], kind)) continue;
            scene_reject(r, &member, CIPC_E_UNKNOWN_KEY, "'%s' is a key of %s, but this body is of %s, with the keys %s",
                         own_keys[other][i], mesh_keys[other], mesh_keys[kind], own);
        }
    }
}

cipc_body_kind scene_read_kind(scene_reader *r, const scene_cursor *body)
{
    int way = r->status == CIPC_OK ? scene_one_of(r, body, mesh_keys) : -1;
    if (way < 0) return CIPC_BODY_SHELL;
    check_keys(r, body, (cipc_body_kind)way);
    return (cipc_body_kind)way;
}

void scene_read_kind_mesh(scene_reader *r, const scene_cursor *body, cipc_body_kind kind, unsigned long seed, cipc_mesh *mesh)
{
    scene_cursor member = scene_member(body, mesh_keys[kind]);
    if (kind == CIPC_BODY_SHELL)
        scene_read_shell(r, &member, seed, mesh);
    else if (kind == CIPC_BODY_RODS)
        scene_read_rods(r, &member, seed, mesh);
    else if (kind == CIPC_BODY_PARTICLES)
        scene_read_particles(r, &member, seed, mesh);
    else
        scene_read_volume(r, &member, mesh);
}
