/* Box, ball, solid cylinder, solid of revolution or file. */
#include "scene/volume.h"

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"
#include "scene/solid_revolution.h"

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

void scene_read_volume(scene_reader *r, const scene_cursor *volume, cipc_mesh *mesh)
{
    enum { BOX, BALL, CYLINDER, REVOLUTION, MESH };
    static const char *const keys[] = {"box", "ball", "cylinder", "revolution", "mesh", NULL};
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
    else
        scene_read_mesh_file(r, volume, CIPC_MESH_TETRAHEDRA, mesh);
}
