/* The members of every energy's params struct, and the flat list of numbers that they are in queries. */
#include "energy/fields.h"

#include <string.h>

#define ONE(type, member) {#member, offsetof(type, member), 1, false}
#define MANY(type, member, n) {#member, offsetof(type, member), (n), false}

const cipc_energy_field energy_fields_inertia[2] = {ONE(cipc_inertia, mass), MANY(cipc_inertia, target, 3)};
const cipc_energy_field energy_fields_gravity[2] = {ONE(cipc_gravity, mass), MANY(cipc_gravity, acceleration, 3)};
const cipc_energy_field energy_fields_dirichlet_penalty[3] = {ONE(cipc_dirichlet_penalty, stiffness), ONE(cipc_dirichlet_penalty, mass),
                                                      MANY(cipc_dirichlet_penalty, target, 3)};
const cipc_energy_field energy_fields_membrane[5] = {MANY(cipc_membrane, inverse_rest, 3), ONE(cipc_membrane, area), ONE(cipc_membrane, volume), ONE(cipc_membrane, mu),
                                             ONE(cipc_membrane, lambda)};
const cipc_energy_field energy_fields_strain_limit[5] = {MANY(cipc_strain_limit, inverse_rest, 3), ONE(cipc_strain_limit, volume), ONE(cipc_strain_limit, limit),
                                                 ONE(cipc_strain_limit, activation), ONE(cipc_strain_limit, stiffness)};
const cipc_energy_field energy_fields_orthotropic[11] = {MANY(cipc_orthotropic, warp, 2), MANY(cipc_orthotropic, weft, 2), ONE(cipc_orthotropic, rest_cosine),
                                                ONE(cipc_orthotropic, volume), ONE(cipc_orthotropic, a11), ONE(cipc_orthotropic, a12), ONE(cipc_orthotropic, a22),
                                                ONE(cipc_orthotropic, g12), ONE(cipc_orthotropic, limit11), ONE(cipc_orthotropic, limit22),
                                                ONE(cipc_orthotropic, limit12)};
const cipc_energy_field energy_fields_hinge_bending[2] = {ONE(cipc_hinge_bending, stiffness), ONE(cipc_hinge_bending, rest_angle)};
const cipc_energy_field energy_fields_volume[4] = {MANY(cipc_volume, inverse_rest, 9), ONE(cipc_volume, volume), ONE(cipc_volume, mu), ONE(cipc_volume, lambda)};
const cipc_energy_field energy_fields_rod_stretching[2] = {ONE(cipc_rod_stretching, stiffness), ONE(cipc_rod_stretching, length)};
const cipc_energy_field energy_fields_rod_bending[2] = {ONE(cipc_rod_bending, stiffness), ONE(cipc_rod_bending, rest_curvature)};
const cipc_energy_field energy_fields_stitch[2] = {ONE(cipc_stitch, stiffness), ONE(cipc_stitch, ratio)};
const cipc_energy_field energy_fields_damping[3] = {ONE(cipc_damping, factor), MANY(cipc_damping, start, 12), MANY(cipc_damping, stiffness, 78)};
const cipc_energy_field energy_fields_barrier[6] = {ONE(cipc_contact_barrier, stiffness), ONE(cipc_contact_barrier, weight), ONE(cipc_contact_barrier, offset),
                                            ONE(cipc_contact_barrier, dhat), ONE(cipc_contact_barrier, mollifier_eps),
                                            {"feature", offsetof(cipc_contact_barrier, feature), 1, true}};
const cipc_energy_field energy_fields_friction[5] = {ONE(cipc_friction, coefficient), ONE(cipc_friction, eps), MANY(cipc_friction, weights, 4),
                                             MANY(cipc_friction, basis, 6), MANY(cipc_friction, start, 12)};

int cipc_energy_number_count(const cipc_energy *energy)
{
    int count = 0;
    for (int i = 0; i < energy->field_count; i++) count += energy->fields[i].count;
    return count;
}

void cipc_energy_numbers(const cipc_energy *energy, const void *params, double *numbers)
{
    for (int i = 0; i < energy->field_count; i++) {
        const cipc_energy_field *field = &energy->fields[i];
        const char *member = (const char *)params + field->offset;
        if (field->feature) {
            cipc_feature feature;
            memcpy(&feature, member, sizeof feature);
            *numbers = cipc_feature_index(CIPC_EDGE_EDGE, &feature);
        } else {
            memcpy(numbers, member, (size_t)field->count * sizeof *numbers);
        }
        numbers += field->count;
    }
}

bool cipc_energy_params(const cipc_energy *energy, const double *numbers, void *params)
{
    bool good = true;
    memset(params, 0, energy->params_size);
    for (int i = 0; i < energy->field_count; i++) {
        const cipc_energy_field *field = &energy->fields[i];
        char *member = (char *)params + field->offset;
        if (field->feature) {
            bool known = *numbers >= 0 && *numbers < cipc_feature_count(CIPC_EDGE_EDGE) && *numbers == (double)(int)*numbers;
            cipc_feature feature = cipc_feature_at(CIPC_EDGE_EDGE, known ? (int)*numbers : 0);
            memcpy(member, &feature, sizeof feature);
            good = good && known;
        } else {
            memcpy(member, numbers, (size_t)field->count * sizeof *numbers);
        }
        numbers += field->count;
    }
    return good;
}
