/* What a step needs to know of the one before it, besides positions and velocities: into the state and out of it. */
#include "massspring/memory.h"

#include "base/vector.h"

/* Of a node: 1 + its collider (0: none), z, impulse, tangential velocity. Then the lengths of structural springs (0: not changed yet), if they change. */
enum { OF_A_NODE = 8 };

static bool lengths_change(const cipc_massspring_options *o) { return o->deformation > 0 && o->reading == CIPC_DEFORMATION_REST_LENGTH; }

int cipc_massspring_memory(const cipc_model *model, const cipc_massspring_options *options)
{
    return OF_A_NODE * model->node_count + (lengths_change(options) ? model->edge_count : 0);
}

static bool has_memory(const cipc_massspring *s, const cipc_state *state) { return state->memory_count == cipc_massspring_memory(s->model, &s->options); }

void massspring_remember(const cipc_massspring *s, cipc_state *state)
{
    const int n = s->model->node_count;
    if (!has_memory(s, state)) return;
    for (int i = 0; i < n; i++) {
        const massspring_contact *c = &s->contacts[i];
        double *m = state->memory + OF_A_NODE * (size_t)i;
        m[0] = 1 + c->collider;
        v3_copy(m + 1, c->z);
        m[4] = c->impulse;
        v3_copy(m + 5, c->tangent);
    }
    for (int k = 0; k < s->structural_count && lengths_change(&s->options); k++) state->memory[OF_A_NODE * (size_t)n + (size_t)k] = s->springs[k].length;
}

/* A file may say anything. */
static int collider_of(const cipc_massspring *s, double number) { return number >= 1 && number <= s->collider_count ? (int)number - 1 : -1; }

void massspring_recall(cipc_massspring *s, const cipc_state *state)
{
    const int n = s->model->node_count;
    if (!has_memory(s, state)) return;
    for (int i = 0; i < n; i++) {
        massspring_contact *c = &s->contacts[i];
        const double *m = state->memory + OF_A_NODE * (size_t)i;
        c->collider = collider_of(s, m[0]);
        v3_copy(c->z, m + 1);
        c->impulse = m[4];
        v3_copy(c->tangent, m + 5);
    }
    for (int k = 0; k < s->structural_count && lengths_change(&s->options); k++) {
        const double length = state->memory[OF_A_NODE * (size_t)n + (size_t)k];
        if (length > 0) s->springs[k].length = length;
    }
}
