/* Meshes compared to the last bit: what a reader made of a scene's text against the generator called directly. */
#ifndef SUPPORT_MESH_TRIAL_H
#define SUPPORT_MESH_TRIAL_H

#include "cipc/scene.h"

/* `status` is that of the call that made `want`. Both meshes are freed. */
void assert_same_mesh(cipc_mesh *got, cipc_mesh *want, cipc_status status);

#endif
