/* The changing part of a simulation. */
#include "cipc/model.h"

#include <string.h>

cipc_status cipc_state_create(cipc_state **state, const cipc_body_description *bodies, int body_count, cipc_error *error)
{
    *state = NULL;
    int nodes = 0;
    for (int b = 0; b < body_count; b++) nodes += bodies[b].node_count;
    cipc_state *s = cipc_alloc(1, sizeof *s);
    if (!s) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "state", "no memory for a state");
    s->node_count = nodes;
    s->strain_stiffness_factor = 1;
    s->position = cipc_alloc(3 * (size_t)nodes, sizeof(double));
    s->velocity = cipc_alloc(3 * (size_t)nodes, sizeof(double));
    if (!s->position || !s->velocity) {
        cipc_state_destroy(s);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "state", "no memory for %d nodes", nodes);
    }
    for (int b = 0, first = 0; b < body_count; first += bodies[b].node_count, b++) {
        size_t bytes = 3 * (size_t)bodies[b].node_count * sizeof(double);
        memcpy(s->position + 3 * first, bodies[b].position, bytes);
        if (bodies[b].velocity) memcpy(s->velocity + 3 * first, bodies[b].velocity, bytes);
    }
    *state = s;
    return CIPC_OK;
}

cipc_status cipc_state_remember(cipc_state *state, int count, cipc_error *error)
{
    double *memory = cipc_alloc((size_t)count, sizeof *memory);
    if (!memory) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "state", "no memory for %d numbers", count);
    cipc_free(state->memory);
    state->memory = memory;
    state->memory_count = count;
    return CIPC_OK;
}

void cipc_state_destroy(cipc_state *state)
{
    if (!state) return;
    cipc_free(state->memory);
    cipc_free(state->position);
    cipc_free(state->velocity);
    cipc_free(state);
}
