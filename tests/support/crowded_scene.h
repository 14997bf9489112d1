/* A small scene in which every term of the incremental potential is at work, and the slow twin of that potential: long double, straight
 * from the definitions. Header only. */
#ifndef SUPPORT_CROWDED_SCENE_H
#define SUPPORT_CROWDED_SCENE_H

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/stepper.h"
#include "support/exact_geometry.h"
#include "support/sheet_scene.h"

static const double crowded_dhat = 0.01; /* m */
static const cipc_integrator crowded_euler = {1, 1, 0}, crowded_midpoint = {1, 0.5, 0.5};

/* Moves free and Dirichlet nodes alike by at most `by` in each direction. */
static inline void crowded_jolt(sheet_scene *scene, uint64_t *seed, double by)
{
    for (int i = 0; i < 3 * scene->model->node_count; i++) scene->stepper->x[i] += random_uniform(seed, -by, by);
}

/* A wall (fixed), over it a cloth with strain limit, over that an StVK sheet with thickness whose last row is prescribed, and a strip on
 * edge that nearly touches the sheet: point-triangle, edge-edge and point-edge contacts, some mollified. The stepper is in the middle of a
 * step: iterate and start of the step differ, the friction data are lagged from a point between them. With `penalty` > 0 the prescribed
 * nodes are pulled. */
static inline void crowded_scene(sheet_scene *scene, uint64_t seed, cipc_integrator integrator, double penalty, int threads)
{
    const double h = 0.6 * crowded_dhat, floor[3] = {-0.5, 0, -0.5}, wide[3] = {2, 0, 0}, deep[3] = {0, 0, 2}, u[3] = {0.5, 0, 0},
                 v[3] = {0, 0, 0.5}, cloth[3] = {0.01, h, 0}, sheet[3] = {0, 2 * h + 0.004, 0.02}, strip[3] = {0.1, 3 * h + 0.006, 0.1},
                 along[3] = {0.3, 0, 0.21}, up[3] = {0, 0.1, 0};
    static const int held[4] = {16 + 4 + 12, 16 + 4 + 13, 16 + 4 + 14, 16 + 4 + 15};
    sheet_scene_init(scene);
    scene->options.integrator = integrator;
    scene->options.contact.dhat = crowded_dhat;
    scene->options.barrier_stiffness = 50;
    scene->options.friction_velocity = 0.05; /* the jolts below slip and stick */
    scene->options.threads = threads;
    scene->gravity[1] = -9.81;
    sheet_add_grid(scene, "floor", floor, wide, deep, 1, 1)->fixed = true;
    cipc_body_description *b = sheet_add_grid(scene, "cloth", cloth, u, v, 3, 3);
    b->material.strain_limit = 1.2;
    b->material.strain_activation = 1.001;
    b->material.strain_stiffness = 1e3;
    b->friction = 0.4;
    b = sheet_add_grid(scene, "sheet", sheet, u, v, 3, 3);
    b->material.membrane = CIPC_MEMBRANE_STVK;
    b->offset = 0.004;
    b->friction = 0.7;
    b = sheet_add_grid(scene, "strip", strip, along, up, 2, 1);
    b->friction = 0.3;
    scene->bodies[0].friction = 0.5;
    sheet_scene_model(scene);
    cipc_motion motion = {.begin = 0, .end = INFINITY, .velocity = {0.1, 0.02, 0}};
    sheet_hold(scene, held, 4, &motion, INFINITY);
    sheet_scene_stepper(scene);
    for (int i = 0; i < 3 * scene->model->node_count; i++) scene->state->velocity[i] = random_uniform(&seed, -0.1, 0.1);
    sheet_begin(scene);
    cipc_stepper *s = scene->stepper;
    s->strain_factor = 2;
    crowded_jolt(scene, &seed, 0.0005);
    assert_int_equal(cipc_contacts_at(s, s->x, &s->contacts, NULL), CIPC_OK);
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    if (penalty > 0) {
        s->penalty = penalty;
        for (int i = 0; i < 4; i++) s->is_dirichlet[held[i]] = false;
        cipc_number_free_nodes(s);
    }
    crowded_jolt(scene, &seed, 0.0005);
    s->cache.slack = 0;
    assert_int_equal(cipc_cache_cover(s, s->x, NULL, NULL), CIPC_OK);
    assert_int_equal(cipc_contacts_at(s, s->x, &s->contacts, NULL), CIPC_OK);
}

/* --- the slow twin -------------------------------------------------------------------------------------------------------------- */

typedef long double real;

static inline void real_sub(real r[3], const real *a, const real *b)
{
    for (int k = 0; k < 3; k++) r[k] = a[k] - b[k];
}
static inline real real_dot(const real *a, const real *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline void real_cross(real r[3], const real *a, const real *b)
{
    for (int k = 0; k < 3; k++) r[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* C = F^T F - 1, F = [x1-x0, x2-x0] B^-1. */
static inline void real_strain(const real *x, const double b[3], real C[3])
{
    real d1[3], d2[3], f0[3], f1[3];
    real_sub(d1, x + 3, x);
    real_sub(d2, x + 6, x);
    for (int k = 0; k < 3; k++) {
        f0[k] = d1[k] * b[0];
        f1[k] = d1[k] * b[1] + d2[k] * b[2];
    }
    C[0] = real_dot(f0, f0) - 1;
    C[1] = real_dot(f1, f1) - 1;
    C[2] = real_dot(f0, f1);
}

static inline real real_neo_hookean(const real *x, const cipc_membrane *p)
{
    real C[3];
    real_strain(x, p->inverse_rest, C);
    real lnJ = logl((1 + C[0]) * (1 + C[1]) - C[2] * C[2]) / 2;
    return p->volume * ((real)p->mu / 2 * (C[0] + C[1] - 2 * lnJ) + (real)p->lambda / 2 * lnJ * lnJ);
}

static inline real real_stvk(const real *x, const cipc_membrane *p)
{
    real C[3];
    real_strain(x, p->inverse_rest, C);
    real trace = (C[0] + C[1]) / 2, square = (C[0] * C[0] + C[1] * C[1] + 2 * C[2] * C[2]) / 4;
    return p->volume * ((real)p->lambda / 2 * trace * trace + (real)p->mu * square);
}

static inline real real_strain_limit(const real *x, const cipc_strain_limit *p)
{
    real C[3], sum = 0;
    real_strain(x, p->inverse_rest, C);
    real middle = (C[0] + C[1]) / 2, radius = hypotl((C[0] - C[1]) / 2, C[2]);
    for (int k = -1; k <= 1; k += 2) {
        real sigma = sqrtl(1 + middle + k * radius), y = (p->activation - sigma) / ((real)p->limit - p->activation);
        if (y < 0) sum -= y * y * logl(1 + y);
    }
    return p->stiffness * (real)p->volume * sum;
}

static inline real real_hinge(const real *x, const cipc_hinge_bending *p)
{
    real e[3], a[3], b[3], n1[3], n2[3], c[3];
    real_sub(e, x + 3, x);
    real_sub(a, x + 6, x);
    real_sub(b, x + 9, x);
    real_cross(n1, e, a);
    real_cross(n2, b, e); /* (v0-v1) x (v3-v1) = -e x (b - e) = b x e */
    real_cross(c, n1, n2);
    real theta = atan2l(real_dot(e, c) / sqrtl(real_dot(e, e)), real_dot(n1, n2));
    return p->stiffness * (theta - p->rest_angle) * (theta - p->rest_angle);
}

static inline real real_distance2(cipc_pair_kind kind, const real *x)
{
    real a[3], b[3], u[3], n[3];
    if (kind == CIPC_POINT_POINT) {
        real_sub(u, x, x + 3);
        return real_dot(u, u);
    }
    if (kind == CIPC_POINT_EDGE) {
        real_sub(u, x, x + 3);
        real_sub(a, x + 6, x + 3);
        real_cross(n, u, a);
        return real_dot(n, n) / real_dot(a, a);
    }
    bool plane = kind == CIPC_POINT_TRIANGLE;
    real_sub(u, x, plane ? x + 3 : x + 6);
    real_sub(a, plane ? x + 6 : x + 3, plane ? x + 3 : x);
    real_sub(b, x + 9, plane ? x + 3 : x + 6);
    real_cross(n, a, b);
    real along = real_dot(u, n);
    return along * along / real_dot(n, n);
}

static inline real real_contact(const real *x, const cipc_contact *contact)
{
    const cipc_contact_barrier *p = &contact->barrier;
    real z[12], D, Dhat = (real)p->dhat * (2 * (real)p->offset + p->dhat), e = 1, a[3], b[3], n[3];
    cipc_feature feature = p->feature;
    if (contact->energy != CIPC_ENERGY_BARRIER_EDGE_EDGE) /* its nodes are the feature's already */
        feature = (cipc_feature){(cipc_pair_kind)(contact->energy - CIPC_ENERGY_BARRIER_POINT_POINT), contact->count, {0, 1, 2, 3}};
    for (int i = 0; i < 3 * feature.count; i++) z[i] = x[3 * feature.local[i / 3] + i % 3];
    D = real_distance2(feature.kind, z) - (real)p->offset * p->offset;
    if (D >= Dhat) return 0;
    if (p->mollifier_eps > 0) {
        real_sub(a, x + 3, x);
        real_sub(b, x + 9, x + 6);
        real_cross(n, a, b);
        real c = real_dot(n, n) / p->mollifier_eps;
        if (c < 1) e = c * (2 - c);
    }
    return -(real)p->stiffness * p->weight * e * (D - Dhat) * (D - Dhat) * logl(D / Dhat);
}

static inline real real_friction(const real *x, const cipc_friction *p)
{
    real u[2] = {0, 0};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 12; i++) u[k] += (real)p->basis[3 * k + i % 3] * p->weights[i / 3] * (x[i] - p->start[i]);
    real y = hypotl(u[0], u[1]), e = p->eps;
    return p->coefficient * (y < e ? y * y * (1 - y / (3 * e)) / e + e / 3 : y);
}

/* E at x by the definitions (SPEC C.1), with the stepper's own constants: terms in the order of cipc_energy_terms, then the total. */
enum {
    REAL_INERTIA = 0,
    REAL_MEMBRANE,
    REAL_BENDING,
    REAL_STRAIN_LIMIT,
    REAL_BARRIER,
    REAL_FRICTION,
    REAL_PENALTY,
    REAL_TOTAL,
    REAL_TERMS
};

static inline void real_potential(const cipc_stepper *s, const real *x, real terms[REAL_TERMS])
{
    const cipc_model *m = s->model;
    real alpha = s->options.integrator.alpha, beta = s->options.integrator.beta, gamma = s->options.integrator.gamma,
         h2 = (real)s->options.time_step * s->options.time_step, y[12], z[12];
    memset(terms, 0, REAL_TERMS * sizeof *terms);
#define GATHER(to, stencil, count, blended)                                                                                                \
    for (int k = 0; k < 3 * (count); k++)                                                                                                  \
    (to)[k] = (blended) ? beta * x[3 * (stencil)[k / 3] + k % 3] + gamma * s->x_start[3 * (stencil)[k / 3] + k % 3]                        \
                        : x[3 * (stencil)[k / 3] + k % 3]
    for (int g = 0; g < CIPC_GROUP_COUNT; g++)
        for (int i = 0; i < s->groups[g].count; i++) {
            const int *nodes = s->groups[g].nodes + s->groups[g].energy->nodes * i;
            GATHER(y, nodes, s->groups[g].energy->nodes, true);
            GATHER(z, nodes, s->groups[g].energy->nodes, false);
            if (g == CIPC_GROUP_NEO_HOOKEAN)
                terms[REAL_MEMBRANE] += alpha * h2 * real_neo_hookean(y, (const cipc_membrane *)s->groups[g].params + i);
            if (g == CIPC_GROUP_STVK) terms[REAL_MEMBRANE] += alpha * h2 * real_stvk(y, (const cipc_membrane *)s->groups[g].params + i);
            if (g == CIPC_GROUP_HINGE)
                terms[REAL_BENDING] += alpha * h2 * real_hinge(y, (const cipc_hinge_bending *)s->groups[g].params + i);
            if (g == CIPC_GROUP_STRAIN_LIMIT)
                terms[REAL_STRAIN_LIMIT] +=
                    alpha * beta * h2 * s->strain_factor * real_strain_limit(z, (const cipc_strain_limit *)s->groups[g].params + i);
        }
    for (int i = 0; i < s->contacts.count; i++) {
        GATHER(z, s->contacts.contacts[i].nodes, s->contacts.contacts[i].count, false);
        terms[REAL_BARRIER] += real_contact(z, &s->contacts.contacts[i]);
    }
    for (int i = 0; i < s->friction.count; i++) {
        GATHER(z, s->friction.nodes[i], 4, false);
        terms[REAL_FRICTION] += real_friction(z, &s->friction.params[i]);
    }
#undef GATHER
    for (int i = 0; i < 3 * m->node_count; i++) {
        if (!s->is_dirichlet[i / 3] || s->options.released)
            terms[REAL_INERTIA] += (real)m->mass[i / 3] / 2 * (x[i] - s->x_hat[i]) * (x[i] - s->x_hat[i]);
        if (s->penalty > 0 && s->moves[i / 3])
            terms[REAL_PENALTY] += (real)s->penalty * m->mass[i / 3] / 2 * (x[i] - s->target[i]) * (x[i] - s->target[i]);
    }
    for (int t = 0; t < REAL_TOTAL; t++) terms[REAL_TOTAL] += terms[t];
}

#endif
