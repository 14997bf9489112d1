/* Loads: constant forces on sets of nodes. */
#include "cipc/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_ints(const void *a, const void *b)
{
    int p = *(const int *)a, q = *(const int *)b;
    return (p > q) - (p < q);
}

static cipc_status check_load(const cipc_model *model, const cipc_load *load, cipc_error *error)
{
    if (load->node_count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "loads", "the load has no nodes");
    for (int i = 0; i < load->node_count; i++)
        if (load->nodes[i] < 0 || load->nodes[i] >= model->node_count)
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "loads", "node %d does not exist; the model has %d", load->nodes[i], model->node_count);
    for (int k = 0; k < 3; k++)
        if (!isfinite(load->force[k])) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "loads", "the force is not finite");
    if (!isfinite(load->begin) || !(load->end > load->begin))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "loads", "a load ends at %g s, not after its begin %g s", load->end, load->begin);
    return CIPC_OK;
}

cipc_status cipc_model_add_load(cipc_model *model, const cipc_load *load, cipc_error *error)
{
    cipc_status status = check_load(model, load, error);
    if (status) return status;
    cipc_load *loads = cipc_realloc(model->loads, (size_t)model->load_count + 1, sizeof *loads);
    if (loads) model->loads = loads;
    int *nodes = cipc_alloc((size_t)load->node_count, sizeof *nodes);
    if (!loads || !nodes) {
        cipc_free(nodes);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "loads", "no memory for a load on %d nodes", load->node_count);
    }
    memcpy(nodes, load->nodes, (size_t)load->node_count * sizeof *nodes);
    qsort(nodes, (size_t)load->node_count, sizeof *nodes, compare_ints);
    int unique = 0;
    for (int i = 0; i < load->node_count; i++)
        if (i == 0 || nodes[i] != nodes[unique - 1]) nodes[unique++] = nodes[i];
    cipc_load copy = *load;
    copy.nodes = nodes;
    copy.node_count = unique;
    model->loads[model->load_count++] = copy;
    return CIPC_OK;
}
