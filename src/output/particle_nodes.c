/* Which nodes of a model are particles. */
#include "output/particle_nodes.h"

int cipc_particle_count(const cipc_model *model)
{
    int count = 0;
    for (int b = 0; b < model->body_count; b++) {
        count += model->bodies[b].kind == CIPC_BODY_PARTICLES ? model->bodies[b].node_count : 0;
    }
    return count;
}

int *cipc_particle_nodes(const cipc_model *model)
{
    int *nodes = cipc_alloc((size_t)cipc_particle_count(model), sizeof *nodes), count = 0;
    for (int b = 0; nodes != NULL && b < model->body_count; b++) {
        const cipc_body *body = &model->bodies[b];
        for (int i = 0; i < body->node_count && body->kind == CIPC_BODY_PARTICLES; i++) {
            nodes[count++] = body->first_node + i;
        }
    }
    return nodes;
}
