/* The working memory of the mass-spring integrator. One substep reads: stepper.c -> forces.c (springs, gravity, wind, repulsion, friction) -> response.c (bisection) -> bound.c (deformation). */
#ifndef MASSSPRING_STEPPER_H
#define MASSSPRING_STEPPER_H

#include "base/vector.h"
#include "cipc/massspring.h"
#include "massspring/bound.h"

/* A node's contact with a body: friction's memory. */
typedef struct massspring_contact {
    int collider;          /* -1: none */
    double z[3];           /* m: internal state of the friction law, in the tangent plane */
    double impulse;        /* N s: what bisection took along the normal in the substep before */
    double tangent[3];     /* m/s: tangential velocity a substep ago */
} massspring_contact;

/* How far a node was from a body, less all rounding, and where it was then: now it is at least so far as that less what it has moved, since distance changes no faster than its point. */
typedef struct massspring_clearance {
    double distance;       /* m; -INFINITY: not known */
    double at[3];
} massspring_clearance;

/* Pairs of nodes that may be near each other, self.c. */
typedef struct massspring_near_pair {
    int node[2];           /* the lower first */
    double apart;          /* m: they are kept so far apart: as the cloth is, or 1/sqrt(2) of what they are at rest if that is less */
} massspring_near_pair;
typedef struct massspring_near_list {
    massspring_near_pair *pairs; /* in order of their nodes */
    int count, room;
    double *at;            /* 3 * node_count: where all nodes were when it was made; NULL: cloth passes through itself */
    bool made;
} massspring_near_list;

struct cipc_massspring {
    const cipc_model *model;
    cipc_massspring_options options;
    cipc_collider *colliders;
    int collider_count;
    int spring_count, structural_count;
    cipc_spring *springs;
    int (*ends)[2];
    int triangle_count;            /* of cloth: wind blows on them */
    const int (**triangles)[3];
    double *areas;                 /* m^2: as large as these count in the wind at most */
    int substeps;                  /* in a frame */
    double h;                      /* s */
    double *inverse_mass;          /* 0: prescribed now */
    double *force;                 /* 3 * node_count, N */
    double *target;                /* of prescribed nodes */
    bool *is_dirichlet, *moves;
    massspring_contact *contacts;  /* by node */
    massspring_clearance *clearances; /* by node, and of it by body */
    bool *is_cloth;
    long long *joined;             /* pairs of nodes that a spring joins, lower * node_count + higher, sorted */
    massspring_near_list near;
    massspring_bound *bound;       /* of the structural springs */
    cipc_massspring_report report;
};

/* Two nodes as one number, the same in either order; and the order of such numbers. */
static inline long long massspring_join(const cipc_massspring *s, int a, int b) { return (long long)(a < b ? a : b) * s->model->node_count + (a < b ? b : a); }
static inline int massspring_compare_joins(const void *p, const void *q)
{
    const long long a = *(const long long *)p, b = *(const long long *)q;
    return (a > b) - (a < b);
}

/* forces.c: all forces at x and v into s->force. */
void massspring_forces(cipc_massspring *s, const double *x, const double *v);
/* self.c: nodes of the cloth that are too near to each other. CIPC_E_OUT_OF_MEMORY. */
cipc_status massspring_self_forces(cipc_massspring *s, const double *x, const double *v, cipc_error *error);
static inline massspring_clearance *massspring_clearance_of(const cipc_massspring *s, int node, int collider) { return &s->clearances[(size_t)node * (size_t)s->collider_count + (size_t)collider]; }

/* Whether a node at x is farther than `reach` >= 0 from a body, by what is known without looking at it. */
static inline bool massspring_is_clear(const cipc_massspring *s, int node, int collider, const double x[3], double reach)
{
    const massspring_clearance *known = massspring_clearance_of(s, node, collider);
    const double beyond = known->distance - reach;
    double moved[3];
    v3_sub(moved, x, known->at);
    return beyond > 0 && v3_norm2(moved) < beyond * beyond;
}

/* clearance.c: its distance, which is then known; normal as of cipc_collider_distance. */
double massspring_look(cipc_massspring *s, int node, int collider, const double x[3], double normal[3]);
/* response.c: a node's way of a substep, cut where it would lead into a body; its velocity loses what goes inward. */
void massspring_respond(cipc_massspring *s, int node, double x[3], double v[3]);
/* response.c: a node that the bound on deformation has moved into a body goes out to where there is contact; its velocity loses what goes inward. Bisection begins outside: from inside
 * a node would never move again, whatever its velocity becomes. Returns whether the node was inside. */
bool massspring_leave_bodies(cipc_massspring *s, int node, double x[3], double v[3]);

#endif
