/* Which nodes of a model are particles: those of its bodies of particles. */
#ifndef OUTPUT_PARTICLE_NODES_H
#define OUTPUT_PARTICLE_NODES_H

#include "cipc/model.h"

int cipc_particle_count(const cipc_model *model);
/* Their indices, ascending, a block of cipc_alloc; NULL: out of memory. */
int *cipc_particle_nodes(const cipc_model *model);

#endif
