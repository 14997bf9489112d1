/* Tetrahedra of the lattice have two neighbouring middles and two neighbouring corners of the face between their cubes: two long edges and four short ones. The part of each inside the
 * solid is itself, or one, two or three tetrahedra. */
#include "scene/stuffing.h"

#include "base/vector.h"

enum { UNNUMBERED = -1 };

/* Nodes and tetrahedra as they are found; counted only as long as there is no mesh. */
typedef struct filling {
    const scene_lattice *l;
    int *number;     /* (1 + SCENE_LATTICE_EDGES) * points: of the mesh's nodes at points, and at cuts; UNNUMBERED: none yet */
    cipc_mesh *mesh; /* NULL: count */
    int node_count;
    long long tetrahedron_count;
} filling;

static int number_node(filling *f, long long slot, const double x[3])
{
    if (f->number[slot] == UNNUMBERED) f->number[slot] = f->node_count++;
    if (f->mesh != NULL) v3_copy(f->mesh->nodes + 3 * f->number[slot], x);
    return f->number[slot];
}

static int point_node(filling *f, long long point)
{
    return number_node(f, point, f->l->place + 3 * point);
}

/* The cut of the edge between two points of a tetrahedron. */
static int cut_node(filling *f, long long a, long long b)
{
    const scene_lattice *l = f->l;
    bool a_is_middle = a >= l->points / 2, b_is_middle = b >= l->points / 2;
    long long owner = a_is_middle == b_is_middle ? (a < b ? a : b) : (a_is_middle ? a : b), other = owner == a ? b : a;
    int slot = a_is_middle == b_is_middle ? 0 : SCENE_LONG_EDGES;
    while (scene_lattice_other_end(l, owner, slot) != other) slot++;
    double x[3];
    scene_lattice_between(l, owner, other, l->cut[SCENE_LATTICE_EDGES * owner + slot], x);
    return number_node(f, l->points + SCENE_LATTICE_EDGES * owner + slot, x);
}

static void add(filling *f, int a, int b, int c, int d)
{
    long long t = f->tetrahedron_count++;
    if (f->mesh == NULL) return;
    const double *x = f->mesh->nodes;
    double u[3], v[3], w[3], n[3];
    v3_sub(u, x + 3 * b, x + 3 * a);
    v3_sub(v, x + 3 * c, x + 3 * a);
    v3_sub(w, x + 3 * d, x + 3 * a);
    v3_cross(n, u, v);
    bool turned = v3_dot(n, w) < 0;
    int *out = f->mesh->tetrahedra[t];
    out[0] = a;
    out[1] = turned ? c : b;
    out[2] = turned ? b : c;
    out[3] = d;
}

/* A quadrilateral, its corners in turn, is cut along the diagonal from its corner of the lowest number: the same from both sides. */
static bool is_cut_from_first(const int q[4])
{
    return (q[0] < q[2] ? q[0] : q[2]) < (q[1] < q[3] ? q[1] : q[3]);
}

static void add_pyramid(filling *f, const int base[4], int top)
{
    const int *b = base;
    if (is_cut_from_first(base)) {
        add(f, b[0], b[1], b[2], top);
        add(f, b[0], b[2], b[3], top);
    } else {
        add(f, b[1], b[2], b[3], top);
        add(f, b[1], b[3], b[0], top);
    }
}

/* Between the triangles (a0 a1 a2) and (b0 b1 b2): turned so that a0 has the lowest number, a tetrahedron from it to the opposite triangle and a pyramid on the opposite
 * quadrilateral (Dompierre, Labbe, Vallet, Camarero: How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999). */
static void add_prism(filling *f, const int prism[6])
{
    int first = 0;
    for (int i = 1; i < 6; i++) {
        if (prism[i] < prism[first]) first = i;
    }
    int near = first < 3 ? 0 : 3, far = 3 - near, i0 = first % 3, i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3;
    const int base[4] = {prism[near + i1], prism[near + i2], prism[far + i2], prism[far + i1]};
    add(f, prism[first], prism[far + i0], prism[far + i1], prism[far + i2]);
    add_pyramid(f, base, prism[first]);
}

/* The part inside of a tetrahedron whose points are sorted: `inside` of them inside, then `on` on the surface, the others outside. Nodes are numbered one by one: in one list of arguments
 * the order would be the compiler's. */
static void add_part(filling *f, const long long point[4], int inside, int on)
{
    int in[4], cut[4] = {0, 0, 0, 0}, cuts = 0;
    for (int i = 0; i < inside + on; i++) in[i] = point_node(f, point[i]);
    for (int i = 0; i < inside; i++) {
        for (int k = inside + on; k < 4; k++) cut[cuts++] = cut_node(f, point[i], point[k]);
    }
    if (inside == 1) {
        for (int i = 0; i < cuts; i++) in[1 + on + i] = cut[i];
        add(f, in[0], in[1], in[2], in[3]);
    } else if (inside == 2 && on == 1) {
        add_pyramid(f, (const int[4]){in[0], in[1], cut[1], cut[0]}, in[2]);
    } else if (inside == 2) {
        add_prism(f, (const int[6]){in[0], cut[0], cut[1], in[1], cut[2], cut[3]});
    } else {
        add_prism(f, (const int[6]){in[0], in[1], in[2], cut[0], cut[1], cut[2]});
    }
}

static void add_tetrahedron(filling *f, const long long point[4])
{
    long long sorted[4];
    int of_side[3] = {0, 0, 0}, count = 0;
    for (int side = 1; side >= -1; side--) {
        for (int i = 0; i < 4; i++) {
            if (f->l->side[point[i]] != side) continue;
            sorted[count++] = point[i];
            of_side[1 - side]++;
        }
    }
    if (of_side[0] == 0) return;
    if (of_side[2] > 0) {
        add_part(f, sorted, of_side[0], of_side[1]);
        return;
    }
    int whole[4];
    for (int i = 0; i < 4; i++) whole[i] = point_node(f, point[i]);
    add(f, whole[0], whole[1], whole[2], whole[3]);
}

/* Four tetrahedra around the long edge from a middle to the next along an axis: with each edge of the face between their cubes. */
static void fill_face(filling *f, const int at[3], int axis)
{
    const scene_lattice *l = f->l;
    static const int around[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const long long middle = scene_lattice_point(l, true, at), next = scene_lattice_other_end(l, middle, axis);
    for (int e = 0; e < 4; e++) {
        long long ends[2];
        for (int k = 0; k < 2; k++) {
            int bits[3] = {at[0], at[1], at[2]};
            bits[axis]++;
            bits[(axis + 1) % 3] += around[e + k][0];
            bits[(axis + 2) % 3] += around[e + k][1];
            ends[k] = scene_lattice_point(l, false, bits);
        }
        const long long point[4] = {middle, next, ends[0], ends[1]};
        add_tetrahedron(f, point);
    }
}

static void fill(filling *f)
{
    int at[3];
    for (at[1] = 0; at[1] + 1 < f->l->count[1]; at[1]++) {
        for (at[2] = 0; at[2] + 1 < f->l->count[2]; at[2]++) {
            for (at[0] = 0; at[0] + 1 < f->l->count[0]; at[0]++) {
                for (int axis = 0; axis < 3; axis++) {
                    if (scene_lattice_has_edge(f->l, true, at, axis)) fill_face(f, at, axis);
                }
            }
        }
    }
}

static cipc_status stuff_lattice(cipc_mesh *mesh, const scene_lattice *l, const char *place, cipc_error *error)
{
    size_t slots = (size_t)(1 + SCENE_LATTICE_EDGES) * (size_t)l->points;
    filling f = {.l = l, .number = cipc_alloc(slots, sizeof *f.number)};
    if (f.number == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a lattice of %lld points", l->points);
    for (size_t i = 0; i < slots; i++) f.number[i] = UNNUMBERED;
    fill(&f);
    scene_mesh_sizes sizes = {.nodes = f.node_count, .tetrahedra = f.tetrahedron_count};
    cipc_status status = f.tetrahedron_count > 0 ? scene_mesh_allocate_sizes(mesh, &sizes, place, error)
                                                 : cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "cells of %g m are too large: none lies inside", l->cell);
    if (status == CIPC_OK) {
        f.mesh = mesh;
        f.tetrahedron_count = 0;
        fill(&f);
    }
    cipc_free(f.number);
    return status;
}

cipc_status scene_stuff(cipc_mesh *mesh, scene_depth depth, const void *shape, const double low[3], const double high[3], double cell, const char *place, cipc_error *error)
{
    scene_lattice l;
    *mesh = (cipc_mesh){0};
    cipc_status status = scene_lattice_init(&l, depth, shape, low, high, cell, place, error);
    if (status == CIPC_OK) status = stuff_lattice(mesh, &l, place, error);
    scene_lattice_free(&l);
    return status;
}
