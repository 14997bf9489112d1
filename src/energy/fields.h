/* The fields of the registry's params structs (fields.c), which registry.c hands out. */
#ifndef CIPC_ENERGY_FIELDS_H
#define CIPC_ENERGY_FIELDS_H

#include "cipc/energy.h"

extern const cipc_energy_field energy_fields_inertia[2];
extern const cipc_energy_field energy_fields_gravity[2];
extern const cipc_energy_field energy_fields_dirichlet_penalty[3];
extern const cipc_energy_field energy_fields_membrane[5];
extern const cipc_energy_field energy_fields_strain_limit[5];
extern const cipc_energy_field energy_fields_orthotropic[11];
extern const cipc_energy_field energy_fields_hinge_bending[2];
extern const cipc_energy_field energy_fields_volume[4];
extern const cipc_energy_field energy_fields_rod_stretching[2];
extern const cipc_energy_field energy_fields_rod_bending[2];
extern const cipc_energy_field energy_fields_stitch[2];
extern const cipc_energy_field energy_fields_damping[3];
extern const cipc_energy_field energy_fields_barrier[6];
extern const cipc_energy_field energy_fields_friction[5];
/* Only edge-edge looks at mollifier and feature: the last two fields of the barrier are its alone. */
enum { ENERGY_BARRIER_PLAIN_FIELDS = 4, ENERGY_BARRIER_FIELDS = 6 };

#endif
