/* Friction data lagged from the present iterate: normal forces, tangents and weights stay fixed while E is minimised (SPEC D.6). */
#include "implicit/stepper.h"

static cipc_status reserve(cipc_friction_set *set, int count, cipc_error *error)
{
    if (count <= set->capacity) return CIPC_OK;
    cipc_friction *params = cipc_realloc(set->params, (size_t)count, sizeof *params);
    if (params) set->params = params;
    int(*nodes)[4] = cipc_realloc(set->nodes, (size_t)count, sizeof *nodes);
    if (nodes) set->nodes = nodes;
    if (!params || !nodes) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "friction", "no memory for %d contacts", count);
    set->capacity = count;
    return CIPC_OK;
}

cipc_status cipc_friction_lag(cipc_stepper *s, cipc_error *error)
{
    const cipc_model *m = s->model;
    cipc_friction_set *set = &s->friction;
    cipc_status status = reserve(set, s->contacts.count, error);
    if (status) return status;
    double eps = s->options.friction_velocity * s->options.time_step;
    set->count = 0;
    for (int i = 0; i < s->contacts.count; i++) {
        const cipc_contact *contact = &s->contacts.contacts[i];
        int a = m->node_body[contact->nodes[0]], b = m->node_body[contact->nodes[contact->count - 1]];
        double mu = m->pair_friction[a * m->body_count + b];
        if (!cipc_friction_from_contact(&set->params[set->count], contact, s->x, s->x_start, mu, eps)) continue;
        for (int k = 0; k < 4; k++) set->nodes[set->count][k] = contact->nodes[k < contact->count ? k : 0];
        set->count++;
    }
    return CIPC_OK;
}
