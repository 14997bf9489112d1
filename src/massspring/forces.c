/* Forces of a substep: gravity, springs, wind, repulsion and friction of bodies (SPEC B.1, B.6; docs/theory/massspring.md). */
#include "massspring/stepper.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "massspring/spring_force.h"

static void add_gravity(cipc_massspring *s)
{
    for (int i = 0; i < s->model->node_count; i++)
        if (s->inverse_mass[i] > 0) v3_axpy(s->force + 3 * i, s->model->mass[i], s->model->gravity);
}

static void add_springs(cipc_massspring *s, const double *x, const double *v)
{
    for (int k = 0; k < s->spring_count; k++) {
        const int i = 3 * s->ends[k][0], j = 3 * s->ends[k][1];
        double f[3];
        massspring_spring_force(&s->springs[k], x + i, x + j, v + i, v + j, f);
        v3_axpy(s->force + i, 1, f);
        v3_axpy(s->force + j, -1, f);
    }
}

static void add_wind(cipc_massspring *s, const double *x, const double *v)
{
    for (int t = 0; t < s->triangle_count; t++) {
        const int *n = *s->triangles[t];
        const double *const corners[3] = {x + 3 * n[0], x + 3 * n[1], x + 3 * n[2]}, *const speeds[3] = {v + 3 * n[0], v + 3 * n[1], v + 3 * n[2]};
        double f[3];
        massspring_wind_force(s->options.wind_pressure, s->options.wind, s->areas[t], corners, speeds, f);
        for (int i = 0; i < 3; i++) v3_axpy(s->force + 3 * n[i], 1, f);
    }
}

/* The nearest body, if it is nearer than twice the threshold: what bisection leaves is nearer than the threshold, and rounding may not lose it. */
static int nearest_body(cipc_massspring *s, int node, const double x[3], double normal[3])
{
    const double reach = 2 * s->options.threshold;
    double least = reach, n[3];
    int nearest = -1;
    for (int c = 0; c < s->collider_count; c++) {
        if (massspring_is_clear(s, node, c, x, reach)) continue;
        const double distance = massspring_look(s, node, c, x, n);
        if (distance >= least) continue;
        least = distance;
        nearest = c;
        v3_copy(normal, n);
    }
    return nearest;
}

/* A node that comes to another body, or away from all, forgets. */
static void find_contact(cipc_massspring *s, int node, const double x[3], double normal[3])
{
    const int nearest = nearest_body(s, node, x, normal);
    if (nearest != s->contacts[node].collider) s->contacts[node] = (massspring_contact){.collider = nearest};
}

/* sigma0 = Fc / presliding, sigma1 = 2 zeta sqrt(sigma0 m) (SPEC B.7). */
static cipc_friction_force law_of(const cipc_massspring *s, double mu, double normal_force, double mass)
{
    const cipc_massspring_options *o = &s->options;
    cipc_friction_force force = {.law = o->law, .coulomb = mu * normal_force, .band = o->band};
    force.breakaway = o->breakaway * force.coulomb;
    force.sigma0 = force.coulomb / o->presliding;
    force.sigma1 = 2 * o->damping_ratio * sqrt(force.sigma0 * mass);
    return force;
}

/* Friction may not turn the sliding round within a substep: what is left of the impulse beyond that is not applied. The law's memory goes on as it is. */
static void add_friction(cipc_massspring *s, int node, const double normal[3], double normal_force, const double v[3])
{
    massspring_contact *contact = &s->contacts[node];
    const double mass = s->model->mass[node], along = v3_dot(v, normal);
    const cipc_friction_force law = law_of(s, s->colliders[contact->collider].friction, normal_force, mass);
    double tangent[3], f[3];
    for (int k = 0; k < 3; k++) tangent[k] = v[k] - along * normal[k];
    if (!(law.coulomb > 0)) return;
    cipc_friction_step_plane(&law, normal, v, s->h, contact->z, f);
    const double most = v3_norm(tangent) * mass / s->h + law.sigma0 * v3_norm(contact->z), size = v3_norm(f);
    v3_axpy(s->force + 3 * node, size > most && size > 0 ? -most / size : -1, f);
    if (v3_dot(tangent, contact->tangent) < 0) s->report.reversals++;
    v3_copy(contact->tangent, tangent);
}

static void add_contact(cipc_massspring *s, int node, const double *x, const double *v)
{
    massspring_contact *contact = &s->contacts[node];
    double normal[3], push[3] = {0, 0, 0};
    find_contact(s, node, x, normal);
    if (contact->collider < 0) return;
    if (s->options.repulsion > 0) cipc_collider_repulsion(&s->colliders[contact->collider], s->options.repulsion, s->options.threshold, x, v, push);
    v3_axpy(s->force + 3 * node, 1, push);
    add_friction(s, node, normal, v3_norm(push) + contact->impulse / s->h, v);
    contact->impulse = 0;
    s->report.contacts++;
}

void massspring_forces(cipc_massspring *s, const double *x, const double *v)
{
    memset(s->force, 0, 3 * (size_t)s->model->node_count * sizeof *s->force);
    add_gravity(s);
    add_springs(s, x, v);
    if (s->options.wind_pressure > 0) add_wind(s, x, v);
    s->report.contacts = 0;
    for (int i = 0; i < s->model->node_count; i++)
        if (s->is_cloth[i] && s->inverse_mass[i] > 0) add_contact(s, i, x + 3 * i, v + 3 * i);
}
