/* What the monitor is told: the polylines of all nodes, in windows without gaps. */
#include "asynchronous/integrator.h"

#include <string.h>

/* A window is closed when it holds this many breaks a node, and some more for small scenes: many enough for a look at all pairs to cost little beside them. */
enum { BREAKS_PER_NODE = 32, BREAKS_AT_LEAST = 4096 };

cipc_status asynchronous_windows_start(cipc_asynchronous *a, cipc_error *error)
{
    const size_t nodes = (size_t)a->model->node_count;
    if (a->monitor) {
        const long capacity = BREAKS_AT_LEAST + (long)(BREAKS_PER_NODE * nodes);
        if (!a->breaks && (a->breaks = cipc_alloc((size_t)capacity, sizeof *a->breaks))) a->break_capacity = capacity;
        if (!a->window_from) a->window_from = cipc_alloc(3 * nodes, sizeof *a->window_from);
        if (!a->window_to) a->window_to = cipc_alloc(3 * nodes, sizeof *a->window_to);
        if (!a->breaks || !a->window_from || !a->window_to) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for the paths of %zu nodes", nodes);
    }
    a->window_begin = a->now;
    a->break_count = 0;
    for (size_t i = 0; a->monitor && i < nodes; i++) asynchronous_position(&a->nodes[i], a->now, a->window_from + 3 * i);
    return CIPC_OK;
}

void asynchronous_windows_break(cipc_asynchronous *a, int node, const double x[3])
{
    if (a->break_count == a->break_capacity) {
        const cipc_status status = asynchronous_windows_flush(a, a->now, &a->error);
        if (status && !a->status) a->status = status;
        if (status) return;
    }
    cipc_path_break *b = &a->breaks[a->break_count++];
    b->time = a->now;
    b->node = node;
    v3_copy(b->x, x);
}

cipc_status asynchronous_windows_flush(cipc_asynchronous *a, double t, cipc_error *error)
{
    const double begin = asynchronous_seconds();
    if (!a->monitor) return CIPC_OK;
    for (int i = 0; i < a->model->node_count; i++) asynchronous_position(&a->nodes[i], t, a->window_to + 3 * i);
    const cipc_paths paths = {.begin = a->window_begin, .end = t, .node_count = a->model->node_count, .from = a->window_from, .to = a->window_to,
                              .break_count = a->break_count, .breaks = a->breaks};
    const cipc_status status = a->monitor(a->monitor_context, &paths, error);
    memcpy(a->window_from, a->window_to, 3 * (size_t)a->model->node_count * sizeof *a->window_to);
    a->window_begin = t;
    a->break_count = 0;
    a->report.seconds[CIPC_ASYNCHRONOUS_PHASE_MONITOR] += asynchronous_seconds() - begin;
    return status;
}
