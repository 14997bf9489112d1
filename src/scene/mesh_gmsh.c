/* Gmsh's ASCII formats 2.2 and 4.1: nodes and elements; other sections are passed over. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"
#include "scene/token_reader.h"

/* Nodes of Gmsh's element types of first order; 0: not known. Others are refused only if there is nothing of the wanted kind. */
static int nodes_of_type(long long type)
{
    static const int nodes[] = {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
    return type > 0 && type < (long long)(sizeof nodes / sizeof *nodes) ? nodes[type] : 0;
}

static long long type_of_kind(cipc_mesh_kind kind)
{
    static const long long types[] = {2, 1, 15, 4};
    return types[kind];
}

typedef struct tagged {
    long long tag;
    int node;
} tagged;

typedef struct gmsh {
    token_reader r;
    cipc_mesh_kind kind;
    bool version4;
    int node_count, element_count, element_capacity;
    double *nodes;
    tagged *tags; /* sorted when all nodes are read */
    int *elements;
} gmsh;

static int compare_tags(const void *a, const void *b)
{
    const tagged *p = a, *q = b;
    return (p->tag > q->tag) - (p->tag < q->tag);
}

static void no_memory(gmsh *g)
{
    if (g->r.status == CIPC_OK) g->r.status = cipc_fail(g->r.error, CIPC_E_OUT_OF_MEMORY, g->r.path, "no memory for the mesh");
}

static void read_format(gmsh *g)
{
    double version = scene_token_number(&g->r, "a version");
    long long binary = scene_token_integer(&g->r, "the file type", 0, 1);
    if (g->r.status != CIPC_OK) return;
    if (binary != 0) scene_token_reject(&g->r, "a binary file is not read: save it as ASCII");
    if (version != 2.2 && version != 4.1) scene_token_reject(&g->r, "version %g is not read; 2.2 and 4.1 are", version);
    g->version4 = version == 4.1;
    (void)scene_token_integer(&g->r, "the size of a number", 1, 64);
}

/* Room for so many nodes: not more than the text can hold, a node being four words. */
static bool reserve_nodes(gmsh *g, long long count)
{
    if (g->nodes != NULL) {
        scene_token_reject(&g->r, "a second section of nodes");
        return false;
    }
    if (count > (long long)strlen(g->r.at) / 8 + 1) {
        scene_token_reject(&g->r, "%lld nodes are announced, more than the file holds", count);
        return false;
    }
    g->nodes = cipc_alloc(3 * (size_t)count, sizeof *g->nodes);
    g->tags = cipc_alloc((size_t)count, sizeof *g->tags);
    if (g->nodes == NULL || g->tags == NULL) no_memory(g);
    return g->r.status == CIPC_OK;
}

static void read_coordinates(gmsh *g, int node)
{
    for (int k = 0; k < 3; k++) g->nodes[3 * (size_t)node + (size_t)k] = scene_token_number(&g->r, "a coordinate");
}

static void read_nodes2(gmsh *g)
{
    long long count = scene_token_integer(&g->r, "the number of nodes", 1, SCENE_NODES_MAX);
    if (g->r.status != CIPC_OK || !reserve_nodes(g, count)) return;
    for (; g->node_count < count && g->r.status == CIPC_OK; g->node_count++) {
        g->tags[g->node_count] = (tagged){scene_token_integer(&g->r, "a node's number", 1, LLONG_MAX), g->node_count};
        read_coordinates(g, g->node_count);
    }
}

/* Blocks: first the numbers of their nodes, then the coordinates. */
static void read_nodes4(gmsh *g)
{
    long long blocks = scene_token_integer(&g->r, "the number of blocks", 1, SCENE_NODES_MAX), count = scene_token_integer(&g->r, "the number of nodes", 1, SCENE_NODES_MAX);
    for (int i = 0; i < 2; i++) (void)scene_token_integer(&g->r, "a node's number", 0, LLONG_MAX);
    if (g->r.status != CIPC_OK || !reserve_nodes(g, count)) return;
    for (long long b = 0; b < blocks && g->r.status == CIPC_OK; b++) {
        for (int i = 0; i < 2; i++) (void)scene_token_integer(&g->r, "an entity", 0, INT_MAX);
        long long parametric = scene_token_integer(&g->r, "whether nodes are parametric", 0, 1), nodes = scene_token_integer(&g->r, "the number of nodes of a block", 0, count - g->node_count);
        if (parametric != 0) scene_token_reject(&g->r, "parametric nodes are not read");
        for (long long i = 0; i < nodes && g->r.status == CIPC_OK; i++)
            g->tags[g->node_count + i] = (tagged){scene_token_integer(&g->r, "a node's number", 1, LLONG_MAX), g->node_count + (int)i};
        for (long long i = 0; i < nodes && g->r.status == CIPC_OK; i++, g->node_count++) read_coordinates(g, g->node_count);
    }
    if (g->r.status == CIPC_OK && g->node_count < count) scene_token_reject(&g->r, "%lld nodes are announced, %d are given", count, g->node_count);
}

static void sort_tags(gmsh *g)
{
    qsort(g->tags, (size_t)g->node_count, sizeof *g->tags, compare_tags);
    for (int i = 1; i < g->node_count && g->r.status == CIPC_OK; i++) {
        if (g->tags[i].tag == g->tags[i - 1].tag) scene_token_reject(&g->r, "node %lld is given twice", g->tags[i].tag);
    }
}

/* The nodes of one element, kept if it is of the wanted kind. */
static void read_element(gmsh *g, bool wanted, int nodes)
{
    if (wanted && g->element_count == g->element_capacity) {
        int capacity = 2 * g->element_capacity + 256;
        int *grown = cipc_realloc(g->elements, (size_t)capacity * (size_t)nodes, sizeof *grown);
        if (grown == NULL) {
            no_memory(g);
            return;
        }
        g->elements = grown;
        g->element_capacity = capacity;
    }
    for (int k = 0; k < nodes && g->r.status == CIPC_OK; k++) {
        const tagged key = {scene_token_integer(&g->r, "a node's number", 1, LLONG_MAX), 0};
        const tagged *found = bsearch(&key, g->tags, (size_t)g->node_count, sizeof *g->tags, compare_tags);
        if (found == NULL) scene_token_reject(&g->r, "an element names node %lld, which is not in the file", key.tag);
        else if (wanted) g->elements[(size_t)nodes * (size_t)g->element_count + (size_t)k] = found->node;
    }
    g->element_count += wanted;
}

static bool known_type(gmsh *g, long long type)
{
    if (nodes_of_type(type) == 0 && g->r.status == CIPC_OK) scene_token_reject(&g->r, "elements of type %lld are not read", type);
    return g->r.status == CIPC_OK;
}

static void read_elements2(gmsh *g)
{
    long long count = scene_token_integer(&g->r, "the number of elements", 0, SCENE_TRIANGLES_MAX);
    for (long long i = 0; i < count && g->r.status == CIPC_OK; i++) {
        (void)scene_token_integer(&g->r, "an element's number", 1, LLONG_MAX);
        long long type = scene_token_integer(&g->r, "an element's type", 1, 200), tags = scene_token_integer(&g->r, "the number of tags", 0, 1000);
        for (long long k = 0; k < tags && g->r.status == CIPC_OK; k++) (void)scene_token_integer(&g->r, "a tag", LLONG_MIN, LLONG_MAX);
        if (known_type(g, type)) read_element(g, type == type_of_kind(g->kind), nodes_of_type(type));
    }
}

static void read_elements4(gmsh *g)
{
    long long blocks = scene_token_integer(&g->r, "the number of blocks", 0, SCENE_TRIANGLES_MAX), count = scene_token_integer(&g->r, "the number of elements", 0, SCENE_TRIANGLES_MAX);
    for (int i = 0; i < 2; i++) (void)scene_token_integer(&g->r, "an element's number", 0, LLONG_MAX);
    for (long long b = 0; b < blocks && g->r.status == CIPC_OK; b++) {
        for (int i = 0; i < 2; i++) (void)scene_token_integer(&g->r, "an entity", 0, INT_MAX);
        long long type = scene_token_integer(&g->r, "an element's type", 1, 200), elements = scene_token_integer(&g->r, "the number of elements of a block", 0, count);
        for (long long i = 0; known_type(g, type) && i < elements; i++) {
            (void)scene_token_integer(&g->r, "an element's number", 1, LLONG_MAX);
            read_element(g, type == type_of_kind(g->kind), nodes_of_type(type));
        }
    }
}

static void read_sections(gmsh *g)
{
    bool format = false;
    while (scene_token_next(&g->r)) {
        if (scene_token_is(&g->r, "$MeshFormat")) {
            read_format(g);
            format = true;
        } else if (*g->r.word == '$' && !format) {
            scene_token_reject(&g->r, "the file does not begin with $MeshFormat");
        } else if (scene_token_is(&g->r, "$Nodes")) {
            if (g->version4) read_nodes4(g);
            else read_nodes2(g);
            if (g->r.status == CIPC_OK) sort_tags(g);
        } else if (scene_token_is(&g->r, "$Elements")) {
            if (g->version4) read_elements4(g);
            else read_elements2(g);
        } else if (!format) {
            scene_token_reject(&g->r, "not a Gmsh file: it does not begin with $MeshFormat");
        }
    }
}

static cipc_status finish(gmsh *g, cipc_mesh *mesh)
{
    if (g->r.status != CIPC_OK) return g->r.status;
    if (g->node_count == 0) return scene_token_reject(&g->r, "the file ends without nodes");
    if (g->element_count == 0 && g->kind != CIPC_MESH_NODES) {
        static const char *const names[] = {"triangles", "lines", "points", "tetrahedra"};
        return scene_token_reject(&g->r, "the file has no %s", names[g->kind]);
    }
    bool nodes_only = g->kind == CIPC_MESH_NODES;
    cipc_status status = scene_mesh_allocate_kind(mesh, g->kind, g->node_count, nodes_only ? 0 : g->element_count, g->r.path, g->r.error);
    if (status != CIPC_OK) return status;
    memcpy(mesh->nodes, g->nodes, 3 * (size_t)g->node_count * sizeof *mesh->nodes);
    void *into = g->kind == CIPC_MESH_TRIANGLES ? (void *)mesh->triangles : g->kind == CIPC_MESH_SEGMENTS ? (void *)mesh->segments : (void *)mesh->tetrahedra;
    if (!nodes_only) memcpy(into, g->elements, (size_t)g->element_count * (size_t)nodes_of_type(type_of_kind(g->kind)) * sizeof(int));
    return CIPC_OK;
}

cipc_status scene_mesh_read_gmsh(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    gmsh g = {.kind = kind};
    cipc_status status = scene_token_reader_open(&g.r, path, error);
    if (status == CIPC_OK) {
        read_sections(&g);
        status = finish(&g, mesh);
    }
    scene_token_reader_close(&g.r);
    cipc_free(g.nodes);
    cipc_free(g.tags);
    cipc_free(g.elements);
    return status;
}
