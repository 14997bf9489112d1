/* The names of the functions that queries can ask (docs/conformance.md). */
#include <string.h>

#include "verify/query.h"

/* In the order of their level. */
typedef struct function_entry {
    const char *name;
    int level;
    int numbers; /* of the field "x", where the name does not tell */
} function_entry;

static const function_entry table[] = {
    {"barrier", 0, 2},              /* D, Dhat */
    {"strain_limit_barrier", 0, 3}, /* sigma, s, shat */
    {"friction_mollifier", 0, 2},   /* y, e */
    {"orient3d", 1, 12},
    {"intersect_edge_triangle", 1, 15},
    {"distance2_point_point", 1, 6},
    {"distance2_point_edge", 1, 9},
    {"distance2_point_triangle", 1, 12},
    {"distance2_edge_edge", 1, 12},
    {"energy/inertia", 2, 0},
    {"energy/gravity", 2, 0},
    {"energy/dirichlet_penalty", 2, 0},
    {"energy/membrane_neo_hookean", 2, 0},
    {"energy/membrane_stvk", 2, 0},
    {"energy/strain_limit", 2, 0},
    {"energy/strain_limit_lower", 2, 0},
    {"energy/membrane_orthotropic", 2, 0},
    {"energy/hinge_bending", 2, 0},
    {"energy/volume_corotational", 2, 0},
    {"energy/volume_neo_hookean", 2, 0},
    {"energy/rod_stretching", 2, 0},
    {"energy/rod_bending", 2, 0},
    {"energy/stitch", 2, 0},
    {"energy/damping", 2, 0},
    {"energy/barrier_point_point", 2, 0},
    {"energy/barrier_point_edge", 2, 0},
    {"energy/barrier_point_triangle", 2, 0},
    {"energy/barrier_edge_edge", 2, 0},
    {"energy/friction", 2, 0},
    {"toi_point_point", 3, 0},
    {"toi_point_edge", 3, 0},
    {"toi_point_triangle", 3, 0},
    {"toi_edge_edge", 3, 0},
    {"potential/two_triangles", 4, 18},
};
enum { TABLE_COUNT = sizeof table / sizeof table[0] };

static const function_entry *find(const char *name)
{
    for (int i = 0; i < TABLE_COUNT; i++)
        if (strcmp(table[i].name, name) == 0) return &table[i];
    return NULL;
}

int verify_function_count(void) { return TABLE_COUNT; }

const char *verify_function_at(int index) { return table[index].name; }

const char *verify_function_name(const char *name)
{
    const function_entry *entry = find(name);
    return entry != NULL ? entry->name : NULL;
}

int verify_function_level(const char *fn) { return find(fn)->level; }

int verify_query_numbers(const char *fn) { return find(fn)->numbers; }
