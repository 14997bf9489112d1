/* Grid, sheet of equilateral triangles, irregular sheet, icosphere, shell of revolution, open cylinder, capsule, nails, panels of a garment, ribbon or file. */
#include "scene/shell.h"

#include <limits.h>

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"

enum { SUBDIVISIONS_MAX = 8 };

static void read_grid(scene_reader *r, const scene_cursor *grid, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "cells", "alternate", NULL};
    double size[2];
    int cells[2];
    cipc_error error;
    if (!scene_is_object(r, grid, keys)) return;
    scene_numbers(r, grid, "size", 2, scene_positive, size);
    scene_integers(r, grid, "cells", 2, 1, SCENE_NODES_MAX, cells);
    bool alternate = scene_boolean(r, grid, "alternate", false);
    if (r->status == CIPC_OK) scene_adopt(r, grid, cipc_mesh_grid(mesh, size[0], size[1], cells[0], cells[1], alternate, &error), &error);
}

static void read_equilateral(scene_reader *r, const scene_cursor *sheet, cipc_mesh *mesh)
{
    static const char *const keys[] = {"edge", "cells", NULL};
    int cells[2];
    cipc_error error;
    if (!scene_is_object(r, sheet, keys)) return;
    double edge = scene_number(r, sheet, "edge", SCENE_REQUIRED_NUMBER, scene_positive);
    scene_integers(r, sheet, "cells", 2, 1, SCENE_NODES_MAX, cells);
    if (r->status == CIPC_OK) scene_adopt(r, sheet, cipc_mesh_equilateral(mesh, edge, cells[0], cells[1], &error), &error);
}

static void read_irregular(scene_reader *r, const scene_cursor *irregular, unsigned long seed, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "nodes", "seed", NULL};
    double size[2];
    cipc_error error;
    if (!scene_is_object(r, irregular, keys)) return;
    scene_numbers(r, irregular, "size", 2, scene_positive, size);
    int nodes = scene_integer(r, irregular, "nodes", SCENE_REQUIRED, 4, SCENE_NODES_MAX);
    unsigned long own_seed = (unsigned long)scene_integer(r, irregular, "seed", (int)seed, 0, INT_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, irregular, cipc_mesh_irregular(mesh, size[0], size[1], nodes, own_seed, &error), &error);
}

static void read_icosphere(scene_reader *r, const scene_cursor *sphere, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "subdivisions", NULL};
    cipc_error error;
    if (!scene_is_object(r, sphere, keys)) return;
    double radius = scene_number(r, sphere, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    int subdivisions = scene_integer(r, sphere, "subdivisions", SCENE_REQUIRED, 0, SUBDIVISIONS_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, sphere, cipc_mesh_icosphere(mesh, radius, subdivisions, &error), &error);
}

static void read_revolution(scene_reader *r, const scene_cursor *revolution, cipc_mesh *mesh)
{
    static const char *const keys[] = {"profile", "sectors", NULL};
    cipc_error error;
    int count;
    if (!scene_is_object(r, revolution, keys)) return;
    int sectors = scene_integer(r, revolution, "sectors", SCENE_REQUIRED, 3, SCENE_NODES_MAX);
    double *profile = scene_points(r, revolution, "profile", 2, 2, SCENE_NODES_MAX, &count);
    if (r->status == CIPC_OK)
        scene_adopt(r, revolution, cipc_mesh_revolution(mesh, count, (const double(*)[2])profile, sectors, &error), &error);
    cipc_free(profile);
}

static void read_cylinder(scene_reader *r, const scene_cursor *cylinder, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "length", "around", "along", NULL};
    cipc_error error;
    if (!scene_is_object(r, cylinder, keys)) return;
    double radius = scene_number(r, cylinder, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    double length = scene_number(r, cylinder, "length", SCENE_REQUIRED_NUMBER, scene_positive);
    int around = scene_integer(r, cylinder, "around", SCENE_REQUIRED, 3, SCENE_NODES_MAX);
    int along = scene_integer(r, cylinder, "along", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, cylinder, cipc_mesh_cylinder(mesh, radius, length, around, along, &error), &error);
}

static void read_capsule(scene_reader *r, const scene_cursor *capsule, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radii", "length", "around", "along", NULL};
    double radii[2];
    cipc_error error;
    if (!scene_is_object(r, capsule, keys)) return;
    scene_numbers(r, capsule, "radii", 2, scene_positive, radii);
    double length = scene_number(r, capsule, "length", SCENE_REQUIRED_NUMBER, scene_positive);
    int around = scene_integer(r, capsule, "around", SCENE_REQUIRED, 3, SCENE_NODES_MAX);
    int along = scene_integer(r, capsule, "along", SCENE_REQUIRED, 2, SCENE_NODES_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, capsule, cipc_mesh_capsule(mesh, radii, length, around, along, &error), &error);
}

static void read_nails(scene_reader *r, const scene_cursor *nails, cipc_mesh *mesh)
{
    static const char *const keys[] = {"count", "spacing", "width", "height", NULL};
    cipc_nails bed;
    cipc_error error;
    if (!scene_is_object(r, nails, keys)) return;
    scene_integers(r, nails, "count", 2, 1, SCENE_NODES_MAX, bed.count);
    scene_numbers(r, nails, "spacing", 2, scene_positive, bed.spacing);
    bed.width = scene_number(r, nails, "width", SCENE_REQUIRED_NUMBER, scene_positive);
    bed.height = scene_number(r, nails, "height", SCENE_REQUIRED_NUMBER, scene_positive);
    if (r->status == CIPC_OK) scene_adopt(r, nails, cipc_mesh_nails(mesh, &bed, &error), &error);
}

/* What gores and pleats have in common, but the rows. */
static cipc_panel_ring read_panel_ring(scene_reader *r, const scene_cursor *object)
{
    cipc_panel_ring ring = {.panels = scene_integer(r, object, "panels", 1, 1, SCENE_NODES_MAX)};
    ring.top = scene_number(r, object, "top", SCENE_REQUIRED_NUMBER, scene_positive);
    ring.bottom = scene_number(r, object, "bottom", SCENE_REQUIRED_NUMBER, scene_positive);
    ring.height = scene_number(r, object, "height", SCENE_REQUIRED_NUMBER, scene_positive);
    return ring;
}

static void read_gores(scene_reader *r, const scene_cursor *gores, cipc_mesh *mesh)
{
    static const char *const keys[] = {"panels", "top", "bottom", "height", "cells", NULL};
    int cells[2];
    cipc_error error;
    if (!scene_is_object(r, gores, keys)) return;
    cipc_panel_ring ring = read_panel_ring(r, gores);
    scene_integers(r, gores, "cells", 2, 1, SCENE_NODES_MAX, cells);
    ring.down = cells[1];
    if (r->status == CIPC_OK) scene_adopt(r, gores, cipc_mesh_gores(mesh, &ring, cells[0], &error), &error);
}

static void read_pleats(scene_reader *r, const scene_cursor *pleats, cipc_mesh *mesh)
{
    static const char *const keys[] = {"panels", "top", "bottom", "height", "count", "depth", "gap", "cells", NULL};
    int cells[3];
    cipc_error error;
    if (!scene_is_object(r, pleats, keys)) return;
    cipc_panel_ring ring = read_panel_ring(r, pleats);
    cipc_pleating pleating = {.count = scene_integer(r, pleats, "count", SCENE_REQUIRED, 3, SCENE_NODES_MAX)};
    pleating.depth = scene_number(r, pleats, "depth", SCENE_REQUIRED_NUMBER, scene_positive);
    pleating.gap = scene_number(r, pleats, "gap", SCENE_REQUIRED_NUMBER, scene_positive);
    scene_integers(r, pleats, "cells", 3, 1, SCENE_NODES_MAX, cells);
    pleating.forward = cells[0];
    pleating.back = cells[1];
    ring.down = cells[2];
    if (r->status == CIPC_OK) scene_adopt(r, pleats, cipc_mesh_pleats(mesh, &ring, &pleating, &error), &error);
}

/* Normals for all points, or one for the first. */
static void read_ribbon(scene_reader *r, const scene_cursor *ribbon, cipc_mesh *mesh)
{
    static const char *const keys[] = {"points", "normals", "normal", "width", "along", "across", NULL};
    static const double up[3] = {0, 1, 0};
    cipc_error error;
    int normal_count = 0;
    double *normals = NULL;
    if (!scene_is_object(r, ribbon, keys)) return;
    cipc_ribbon d = {.width = scene_number(r, ribbon, "width", SCENE_REQUIRED_NUMBER, scene_positive)};
    d.along = scene_integer(r, ribbon, "along", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    d.across = scene_integer(r, ribbon, "across", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    double *points = scene_points(r, ribbon, "points", 3, 2, SCENE_NODES_MAX, &d.count);
    scene_cursor normal = scene_member(ribbon, "normal");
    if (json_object_get(ribbon->value, "normals") == NULL) {
        scene_vector(r, ribbon, "normal", up, d.normal);
    } else if (normal.value != NULL) {
        scene_reject(r, &normal, CIPC_E_OUT_OF_RANGE, "is given beside 'normals', which say the first normal too");
    } else if (r->status == CIPC_OK) {
        normals = scene_points(r, ribbon, "normals", 3, (size_t)d.count, (size_t)d.count, &normal_count);
    }
    d.points = (const double(*)[3])points;
    d.normals = (const double(*)[3])normals;
    if (r->status == CIPC_OK) scene_adopt(r, ribbon, cipc_mesh_ribbon(mesh, &d, &error), &error);
    cipc_free(points);
    cipc_free(normals);
}

void scene_read_shell(scene_reader *r, const scene_cursor *shell, unsigned long seed, cipc_mesh *mesh)
{
    enum { GRID, EQUILATERAL, IRREGULAR, ICOSPHERE, REVOLUTION, CYLINDER, CAPSULE, NAILS, GORES, PLEATS, RIBBON, MESH };
    static const char *const keys[] = {"grid",  "equilateral", "irregular", "icosphere", "revolution", "cylinder", "capsule",
                                       "nails", "gores",       "pleats",    "ribbon",    "mesh",       NULL};
    *mesh = (cipc_mesh){0};
    if (!scene_is_object(r, shell, keys)) return;
    int way = scene_one_of(r, shell, keys);
    if (way < 0) return;
    scene_cursor member = scene_member(shell, keys[way]);
    if (way == GRID)
        read_grid(r, &member, mesh);
    else if (way == EQUILATERAL)
        read_equilateral(r, &member, mesh);
    else if (way == IRREGULAR)
        read_irregular(r, &member, seed, mesh);
    else if (way == ICOSPHERE)
        read_icosphere(r, &member, mesh);
    else if (way == REVOLUTION)
        read_revolution(r, &member, mesh);
    else if (way == CYLINDER)
        read_cylinder(r, &member, mesh);
    else if (way == CAPSULE)
        read_capsule(r, &member, mesh);
    else if (way == NAILS)
        read_nails(r, &member, mesh);
    else if (way == GORES)
        read_gores(r, &member, mesh);
    else if (way == PLEATS)
        read_pleats(r, &member, mesh);
    else if (way == RIBBON)
        read_ribbon(r, &member, mesh);
    else
        scene_read_mesh_file(r, shell, CIPC_MESH_TRIANGLES, mesh);
}
