/* cipc/model.h - what is simulated: nodes, elements, materials, thickness, rest shapes, boundary motion; and its state.
 * Floor 2. Plain structs of arrays. A model is immutable once created; everything that changes in time is in cipc_state.
 * SI units, radians. Node i's position is x[3*i .. 3*i+2]. */
#ifndef CIPC_MODEL_H
#define CIPC_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"

#define CIPC_NAME_SIZE 64

typedef enum cipc_membrane_model { CIPC_MEMBRANE_NONE = 0, CIPC_MEMBRANE_NEO_HOOKEAN, CIPC_MEMBRANE_STVK } cipc_membrane_model;

/* Which constant multiplies the hinge energy k (theta - thetabar)^2 ebar / hbar (SPEC F1): "plate" k = D/6, "cipc" k = D/2, D = E t^3 / (12 (1 - nu^2)). */
typedef enum cipc_hinge_constant { CIPC_HINGE_PLATE = 0, CIPC_HINGE_CIPC } cipc_hinge_constant;

/* Material of a shell. */
typedef struct cipc_shell_material {
    double density;                       /* kg/m^3 */
    double thickness;                     /* m, the shell's own (for mass and stiffness) */
    cipc_membrane_model membrane;
    double membrane_young;                /* Pa */
    double membrane_poisson;
    double bending_young;                 /* Pa; 0: no bending energy */
    double bending_poisson;
    cipc_hinge_constant hinge_constant;
    double strain_limit;                  /* s > 1, largest principal stretch; 0: not limited (SPEC C.2) */
    double strain_activation;             /* shat in [1, s) */
    double strain_stiffness;              /* kappa_s, Pa, at the start */
} cipc_shell_material;

/* One body as the scene gives it to cipc_model_create; arrays stay the caller's. */
typedef struct cipc_body_description {
    char name[CIPC_NAME_SIZE];
    cipc_shell_material material;
    double offset;                        /* xi, m: contact thickness; a pair's is the mean of the two bodies' (SPEC C.4) */
    double friction;                      /* default coefficient; a pair without an entry uses the smaller of the two bodies' */
    bool fixed;                           /* every node is a fixed Dirichlet node */
    int node_count;
    const double *rest;                   /* 3 * node_count: rest shape */
    const double *position;               /* 3 * node_count: start */
    const double *velocity;               /* 3 * node_count, or NULL: at rest */
    int triangle_count;
    const int (*triangles)[3];            /* body-local node indices */
} cipc_body_description;

/* A window of prescribed motion of one set of nodes (SPEC R.2, C.7): the part of the step that lies in [begin, end) is driven. */
typedef struct cipc_motion {
    double begin, end;                    /* s; end may be INFINITY */
    double velocity[3];                   /* m/s */
    double center[3], axis[3];            /* rotation about the axis through center; axis of unit length */
    double angular_velocity;              /* rad/s; the rotation of a step is exact and comes before the translation */
} cipc_motion;

/* A set of Dirichlet nodes: fixed where they are, or moved by windows, until released. */
typedef struct cipc_dirichlet_set {
    int node_count;
    int *nodes;                           /* global node indices, ascending */
    double release;                       /* s; free from the first step that starts at or after it; INFINITY: never */
    int motion_count;
    cipc_motion *motions;
} cipc_dirichlet_set;

typedef struct cipc_body {
    char name[CIPC_NAME_SIZE];
    cipc_shell_material material;
    double offset;
    double friction;
    bool fixed;
    int first_node, node_count;
    int first_triangle, triangle_count;
} cipc_body;

typedef struct cipc_model {
    double gravity[3];                    /* m/s^2 */
    int body_count;
    cipc_body *bodies;
    double *pair_friction;                /* body_count * body_count, symmetric */
    int node_count;
    double *rest;                         /* 3 * node_count */
    double *mass;                         /* node_count, kg, lumped (SPEC C.1) */
    int *node_body;                       /* node_count */
    int triangle_count;
    int (*triangles)[3];                  /* global node indices */
    int *triangle_body;
    int edge_count;
    int (*edges)[2];                      /* unique edges of all triangles, ascending by lower, then higher node; directed as in their first triangle */
    int hinge_count;
    int (*hinges)[4];                     /* v0 v1 the shared edge, v2 and v3 opposite: triangles (v0,v1,v2) and (v1,v0,v3) */
    int tetrahedron_count;                /* volumes: positive orientation det[x1-x0, x2-x0, x3-x0] > 0 */
    int (*tetrahedra)[4];
    double *node_area;                    /* node_count, m^2: a third of the incident rest triangles */
    double *edge_area;                    /* edge_count, m^2: a third of the incident rest triangles */
    int dirichlet_count;
    cipc_dirichlet_set *dirichlet;        /* the fixed bodies first, one set each, then the scene's */
} cipc_model;

/* Everything that changes in time and must survive a restart. */
typedef struct cipc_state {
    int step;                             /* number of steps taken */
    double time;                          /* s */
    int node_count;
    double *position, *velocity;          /* 3 * node_count; m, m/s */
    double barrier_stiffness;             /* kappa; 0: not chosen yet */
    double strain_stiffness_factor;       /* multiplies every body's strain_stiffness; starts at 1 (SPEC C.2) */
} cipc_state;

/* Build a model from bodies: lumped masses, unique edges, hinges (of edges with exactly two triangles of consistent or mended orientation;
 * edges with three or more triangles get none), areas. CIPC_E_BAD_MESH on an index out of range, a triangle with a repeated node or zero rest area, a node that
 * no triangle uses; CIPC_E_OUT_OF_RANGE on non-finite or non-positive numbers. pair_friction starts from the bodies' own coefficients. */
cipc_status cipc_model_create(cipc_model **model, const cipc_body_description *bodies, int body_count, const double gravity[3], cipc_error *error);
void cipc_model_destroy(cipc_model *model);

/* Set the friction coefficient of a pair of bodies (both orders). */
void cipc_model_set_friction(cipc_model *model, int body_a, int body_b, double mu);
/* Append a Dirichlet set (nodes and motions are copied; nodes are sorted and made unique). */
cipc_status cipc_model_add_dirichlet(cipc_model *model, const cipc_dirichlet_set *set, cipc_error *error);
/* Index of the body of that name, or -1. */
int cipc_model_find_body(const cipc_model *model, const char *name);

/* State at time 0 from the descriptions the model was built of. */
cipc_status cipc_state_create(cipc_state **state, const cipc_body_description *bodies, int body_count, cipc_error *error);
void cipc_state_destroy(cipc_state *state);

/* Contact thickness of a pair of nodes' primitives, (xi_a + xi_b)/2 by the bodies of one node of each (SPEC C.4, eq. 11). */
double cipc_model_pair_offset(const cipc_model *model, int node_a, int node_b);

/* Which nodes are Dirichlet during the step that starts at `time` and where they are to be at time + h.
 * is_dirichlet[node_count] and target[3*node_count] are filled; target = position for fixed and free nodes alike. A node in several sets
 * follows the last set that is not released; moves[node_count] (may be NULL) tells which nodes have a target other than their position. */
void cipc_dirichlet_targets(const cipc_model *model, const double *position, double time, double h, bool *is_dirichlet, double *target, bool *moves);

#endif
