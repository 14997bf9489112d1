/* Structural springs along the edges of a shell, bending springs across them (SPEC B.1). */
#include "massspring/topology.h"

#include "base/vector.h"

static void add(massspring_topology *t, const cipc_model *m, int a, int b)
{
    double between[3];
    v3_sub(between, m->rest + 3 * (size_t)b, m->rest + 3 * (size_t)a);
    t->ends[t->count][0] = a;
    t->ends[t->count][1] = b;
    t->lengths[t->count++] = v3_norm(between);
}

/* The unique edges of triangles stand before those of rods; hinges are of shells only. */
static void list(massspring_topology *t, const cipc_model *m, int body)
{
    for (int i = 0; i < m->first_segment; i++)
        if (m->node_body[m->edges[i][0]] == body) add(t, m, m->edges[i][0], m->edges[i][1]);
    t->structural_count = t->count;
    for (int i = 0; i < m->hinge_count; i++) {
        const int *v = m->hinges[i];
        if (m->node_body[v[0]] == body && v[2] != v[3]) add(t, m, v[2], v[3]);
    }
}

cipc_status massspring_topology_create(massspring_topology *topology, const cipc_model *model, int body, cipc_error *error)
{
    const size_t most = (size_t)model->first_segment + (size_t)model->hinge_count;
    *topology = (massspring_topology){0};
    topology->ends = cipc_alloc(most, sizeof *topology->ends);
    topology->lengths = cipc_alloc(most, sizeof *topology->lengths);
    if (!topology->ends || !topology->lengths) {
        massspring_topology_free(topology);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "springs", "%zu of them", most);
    }
    list(topology, model, body);
    return CIPC_OK;
}

void massspring_topology_free(massspring_topology *topology)
{
    cipc_free(topology->ends);
    cipc_free(topology->lengths);
    *topology = (massspring_topology){0};
}
