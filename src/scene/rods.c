/* Line, polyline, arc, grid of rods, net or file. */
#include "scene/rods.h"

#include <limits.h>

#include "scene/alternatives.h"
#include "scene/lists.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"

static int read_segments(scene_reader *r, const scene_cursor *object)
{
    return scene_integer(r, object, "segments", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
}

/* A line has two points and cannot be closed. */
static void read_line(scene_reader *r, const scene_cursor *line, cipc_mesh *mesh)
{
    static const char *const keys[] = {"points", "segments", NULL};
    cipc_error error;
    int count;
    if (!scene_is_object(r, line, keys)) return;
    int segments = read_segments(r, line);
    double *points = scene_points(r, line, "points", 3, 2, 2, &count);
    if (r->status == CIPC_OK)
        scene_adopt(r, line, cipc_mesh_polyline(mesh, count, (const double(*)[3])points, segments, false, &error), &error);
    cipc_free(points);
}

static void read_polyline(scene_reader *r, const scene_cursor *line, cipc_mesh *mesh)
{
    static const char *const keys[] = {"points", "segments", "closed", NULL};
    cipc_error error;
    int count;
    if (!scene_is_object(r, line, keys)) return;
    int segments = read_segments(r, line);
    bool closed = scene_boolean(r, line, "closed", false);
    double *points = scene_points(r, line, "points", 3, closed ? 3 : 2, SCENE_NODES_MAX, &count);
    if (r->status == CIPC_OK)
        scene_adopt(r, line, cipc_mesh_polyline(mesh, count, (const double(*)[3])points, segments, closed, &error), &error);
    cipc_free(points);
}

static void read_arc(scene_reader *r, const scene_cursor *arc, cipc_mesh *mesh)
{
    static const char *const keys[] = {"radius", "angle", "segments", NULL};
    cipc_error error;
    if (!scene_is_object(r, arc, keys)) return;
    double radius = scene_number(r, arc, "radius", SCENE_REQUIRED_NUMBER, scene_positive);
    double angle = scene_number(r, arc, "angle", SCENE_REQUIRED_NUMBER, scene_positive);
    int segments = read_segments(r, arc);
    if (r->status == CIPC_OK) scene_adopt(r, arc, cipc_mesh_arc(mesh, radius, angle, segments, &error), &error);
}

static void read_grid(scene_reader *r, const scene_cursor *grid, unsigned long seed, cipc_mesh *mesh)
{
    static const char *const keys[] = {"count", "spacing", "length", "segments", "round", "shorten", "seed", NULL};
    int count[3];
    double spacing[3];
    cipc_error error;
    if (!scene_is_object(r, grid, keys)) return;
    scene_integers(r, grid, "count", 3, 1, SCENE_NODES_MAX, count);
    scene_numbers(r, grid, "spacing", 3, scene_positive, spacing);
    double length = scene_number(r, grid, "length", SCENE_REQUIRED_NUMBER, scene_positive);
    int segments = read_segments(r, grid);
    bool round = scene_boolean(r, grid, "round", false);
    double shorten = scene_number(r, grid, "shorten", 0, scene_not_negative);
    unsigned long own_seed = (unsigned long)scene_integer(r, grid, "seed", (int)seed, 0, INT_MAX);
    if (r->status == CIPC_OK) scene_adopt(r, grid, cipc_mesh_rods(mesh, count, spacing, length, segments, round, &error), &error);
    if (r->status == CIPC_OK) scene_adopt(r, grid, cipc_mesh_shorten_rods(mesh, length, segments, shorten, own_seed, &error), &error);
    if (r->status != CIPC_OK) cipc_mesh_free(mesh);
}

static void read_net(scene_reader *r, const scene_cursor *net, cipc_mesh *mesh)
{
    static const char *const keys[] = {"size", "rods", "segments", "lift", NULL};
    cipc_error error;
    if (!scene_is_object(r, net, keys)) return;
    double size = scene_number(r, net, "size", SCENE_REQUIRED_NUMBER, scene_positive);
    int rods = scene_integer(r, net, "rods", SCENE_REQUIRED, 1, SCENE_NODES_MAX);
    int segments = read_segments(r, net);
    double lift = scene_number(r, net, "lift", SCENE_REQUIRED_NUMBER, scene_not_negative);
    if (r->status == CIPC_OK) scene_adopt(r, net, cipc_mesh_net(mesh, size, rods, segments, lift, &error), &error);
}

void scene_read_rods(scene_reader *r, const scene_cursor *rods, unsigned long seed, cipc_mesh *mesh)
{
    enum { LINE, POLYLINE, ARC, GRID, NET, MESH };
    static const char *const keys[] = {"line", "polyline", "arc", "grid", "net", "mesh", NULL};
    *mesh = (cipc_mesh){0};
    if (!scene_is_object(r, rods, keys)) return;
    int way = scene_one_of(r, rods, keys);
    if (way < 0) return;
    scene_cursor member = scene_member(rods, keys[way]);
    if (way == LINE)
        read_line(r, &member, mesh);
    else if (way == POLYLINE)
        read_polyline(r, &member, mesh);
    else if (way == ARC)
        read_arc(r, &member, mesh);
    else if (way == GRID)
        read_grid(r, &member, seed, mesh);
    else if (way == NET)
        read_net(r, &member, mesh);
    else
        scene_read_mesh_file(r, rods, CIPC_MESH_SEGMENTS, mesh);
}
