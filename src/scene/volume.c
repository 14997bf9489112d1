/* Box, ball, solid cylinder, solid of revolution, figure of capsules or file. */
#include "scene/volume.h"

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"
#include "scene/solid_revolution.h"

enum { PARTS_MAX = 1000 }; /* of a union of capsules: every node of the lattice looks at all of them */

static void read_box(scene_reader *r, const scene_cursor *box, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "cells", NULL};
    double size[3];
    int cells[3];
    cipc_error error;
    if (!scene_is_object(r, box, keys)) return;
    scene_numbers(r, box, "size", 3, scene_positive, size);
    scene_integers(r, box, "cells", 3, 1, SCENE_NODES_MAX, cells);
    if (r->status == CIPC_OK) scene_adopt(r, box, cipc_mesh_box(mesh, size, cells, &error), &error);
}

static void read_ball(scene_reader *r, const scene_cursor *ball, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "cells", NULL};
    cipc_error error;
    if (!scene_is_object(r, ball, keys)) return;
    double radius = scene_number(r, ball, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    int cells = scene_integer(r, ball, "cells", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, ball, cipc_mesh_ball(mesh, radius, cells, &error), &error);
}

static void read_cylinder(scene_reader *r, const scene_cursor *cylinder, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "length", "cells_across", "cells_along", NULL};
    cipc_error error;
    if (!scene_is_object(r, cylinder, keys)) return;
    double radius = scene_number(r, cylinder, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    double length = scene_number(r, cylinder, "length", SCENE_REQUIRED_NUMBER, scene_positive);
    int across = scene_integer(r, cylinder, "cells_across", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    int along = scene_integer(r, cylinder, "cells_along", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, cylinder, cipc_mesh_solid_cylinder(mesh, radius, length, across, along, &error), &error);
}

static void read_capsule(scene_reader *r, const scene_cursor *part, cipc_capsule *capsule)
{
    static const char *const keys[] = {"begin", "end", "radius", "end_radius", NULL};
    if (!scene_is_object(r, part, keys)) return;
    scene_numbers(r, part, "begin", 3, scene_any, capsule->begin);
    scene_vector(r, part, "end", capsule->begin, capsule->end);
    capsule->radius[0] = scene_number(r, part, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    capsule->radius[1] = scene_number(r, part, "end_radius", capsule->radius[0], scene_positive);
}

static void read_capsules(scene_reader *r, const scene_cursor *capsules, cipc_mesh *mesh)
{
    static const char *const keys[] = {"parts", "blend", "cell", NULL};
    cipc_error error;
    if (!scene_is_object(r, capsules, keys)) return;
    double blend = scene_number(r, capsules, "blend", 0, scene_not_negative);
    double cell = scene_number(r, capsules, "cell", SCENE_REQUIRED_NUMBER, scene_positive);
    scene_cursor list = scene_member(capsules, "parts");
    if (list.value == NULL) scene_reject(r, &list, CIPC_E_MISSING_KEY, "required, but missing: an array of capsules");
    if (!scene_is_array(r, &list, 1, PARTS_MAX)) return;
    int count = (int)json_array_size(list.value);
    cipc_capsule *parts = cipc_alloc((size_t)count, sizeof *parts);
    if (parts == NULL) scene_reject_memory(r, &list);
    for (int p = 0; p < count && r->status == CIPC_OK; p++) {
        scene_cursor part = scene_element(&list, (size_t)p);
        read_capsule(r, &part, &parts[p]);
    }
    if (r->status == CIPC_OK) scene_adopt(r, capsules, cipc_mesh_capsules(mesh, count, parts, blend, cell, &error), &error);
    cipc_free(parts);
}

void scene_read_volume(scene_reader *r, const scene_cursor *volume, cipc_mesh *mesh)
{
    enum { BOX, BALL, CYLINDER, REVOLUTION, CAPSULES, MESH };
    static const char *const keys[] = {"box", "ball", "cylinder", "revolution", "capsules", "mesh", NULL};
    *mesh = (cipc_mesh){0};
    if (!scene_is_object(r, volume, keys)) return;
    int way = scene_one_of(r, volume, keys);
    if (way < 0) return;
    scene_cursor member = scene_member(volume, keys[way]);
    if (way == BOX)
        read_box(r, &member, mesh);
    else if (way == BALL)
        read_ball(r, &member, mesh);
    else if (way == CYLINDER)
        read_cylinder(r, &member, mesh);
    else if (way == REVOLUTION)
        scene_read_solid_revolution(r, &member, mesh);
    else if (way == CAPSULES)
        read_capsules(r, &member, mesh);
    else
        scene_read_mesh_file(r, volume, CIPC_MESH_TETRAHEDRA, mesh);
}
