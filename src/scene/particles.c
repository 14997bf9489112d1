/* Lattice, list of points or file. */
#include "scene/particles.h"

#include <limits.h>

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"

static void read_lattice(scene_reader *r, const scene_cursor *lattice, unsigned long seed, cipc_mesh *mesh)
{
    static const char *const keys[] = {"count", "spacing", "jitter", "seed", NULL};
    int count[3];
    double spacing[3];
    cipc_error error;
    if (!scene_is_object(r, lattice, keys)) return;
    scene_integers(r, lattice, "count", 3, 1, SCENE_NODES_MAX, count);
    scene_numbers(r, lattice, "spacing", 3, scene_positive, spacing);
    double jitter = scene_number(r, lattice, "jitter", 0, scene_not_negative);
    unsigned long own_seed = (unsigned long)scene_integer(r, lattice, "seed", (int)seed, 0, INT_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, lattice, cipc_mesh_lattice(mesh, count, spacing, jitter, own_seed, &error), &error);
}

void scene_read_particles(scene_reader *r, const scene_cursor *particles, unsigned long seed, cipc_mesh *mesh)
{
    enum { LATTICE, POINTS, MESH };
    static const char *const keys[] = {"lattice", "points", "mesh", NULL};
    *mesh = (cipc_mesh){0};
    if (!scene_is_object(r, particles, keys)) return;
    int way = scene_one_of(r, particles, keys);
    if (way < 0) return;
    scene_cursor member = scene_member(particles, keys[way]);
    if (way == LATTICE)
        read_lattice(r, &member, seed, mesh);
    else if (way == POINTS)
        mesh->nodes = scene_points(r, particles, "points", 3, 1, SCENE_NODES_MAX, &mesh->node_count);
    else
        scene_read_mesh_file(r, particles, CIPC_MESH_NODES, mesh);
}
