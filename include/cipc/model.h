/* cipc/model.h - what is simulated: nodes, elements, materials, thickness, rest shapes, boundary motion; and its state.
 * Floor 2. Plain structs of arrays. A model is immutable once created; everything that changes in time is in cipc_state.
 * SI units, radians. Node i's position is x[3*i .. 3*i+2]. */
#ifndef CIPC_MODEL_H
#define CIPC_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"

#define CIPC_NAME_SIZE 64

/* What a body is made of. All its elements are of this kind. */
typedef enum cipc_body_kind {
    CIPC_BODY_SHELL = 0,    /* triangles */
    CIPC_BODY_RODS,         /* segments: rods and strands, and (fixed) beds of needles */
    CIPC_BODY_PARTICLES,    /* nodes alone */
    CIPC_BODY_VOLUME        /* tetrahedra; its surface triangles meet what is outside */
} cipc_body_kind;

typedef enum cipc_membrane_model { CIPC_MEMBRANE_NONE = 0, CIPC_MEMBRANE_NEO_HOOKEAN, CIPC_MEMBRANE_STVK, CIPC_MEMBRANE_ORTHOTROPIC,
    CIPC_MEMBRANE_SPRINGS /* a spring along every edge (SPEC A.8); not for the implicit method */ } cipc_membrane_model;
typedef enum cipc_volume_model { CIPC_VOLUME_COROTATIONAL = 0, CIPC_VOLUME_NEO_HOOKEAN } cipc_volume_model;

/* Which constant multiplies the hinge energy k (theta - thetabar)^2 ebar / hbar (SPEC F1): "plate" k = D/6, "cipc" k = D/2, D = E t^3 / (12 (1 - nu^2)). */
typedef enum cipc_hinge_constant { CIPC_HINGE_PLATE = 0, CIPC_HINGE_CIPC } cipc_hinge_constant;

/* Orthotropic cloth with strain limits of its own (SPEC C.3). */
typedef struct cipc_orthotropic_material {
    double moduli[4];                     /* a11, a12, a22, G12, Pa */
    double limits[3];                     /* of the Green strains E11, E22, E12 */
    double warp[3], weft[3];              /* directions in the rest shape, not necessarily of unit length; weft 0: across the warp */
} cipc_orthotropic_material;

/* Material of a body; which members count depends on the body's kind. */
typedef struct cipc_material {
    double density;                       /* kg/m^3 */
    double thickness;                     /* m: of a shell (for mass and stiffness); the diameter of a rod or particle; not used by volumes */
    cipc_membrane_model membrane;         /* shells */
    double membrane_young;                /* Pa */
    double membrane_poisson;
    cipc_orthotropic_material orthotropic;
    double bending_young;                 /* shells and rods, Pa; 0: no bending energy */
    double bending_poisson;
    cipc_hinge_constant hinge_constant;
    double strain_limit;                  /* shells: s > 1, largest principal stretch; 0: not limited (SPEC C.2) */
    double strain_activation;             /* shat in [1, s) */
    double strain_stiffness;              /* kappa_s, Pa, at the start */
    double strain_lower_limit;            /* shells: s in (0, 1), least principal stretch; 0: not limited */
    double strain_lower_activation;       /* shat in (s, 1] */
    double young;                         /* rods (stretching) and volumes, Pa; 0: no such energy */
    double poisson;                       /* volumes */
    bool curved;                          /* rods: bent at rest as the rest shape is; false: straight at rest */
    cipc_volume_model volume;
    double damping_stiffness;             /* s: Rayleigh damping, times the lagged stiffness of the elements */
    double damping_mass;                  /* 1/s: Rayleigh damping, times the mass */
} cipc_material;

/* One body as the scene gives it to cipc_model_create; arrays stay the caller's. */
typedef struct cipc_body_description {
    char name[CIPC_NAME_SIZE];
    cipc_body_kind kind;
    cipc_material material;
    double offset;                        /* xi, m: contact thickness; a pair's is the mean of the two bodies' (SPEC C.4) */
    double friction;                      /* default coefficient; a pair without an entry uses the smaller of the two bodies' */
    bool fixed;                           /* every node is a fixed Dirichlet node */
    int node_count;
    const double *rest;                   /* 3 * node_count: rest shape */
    const double *position;               /* 3 * node_count: start */
    const double *velocity;               /* 3 * node_count, or NULL: at rest */
    int triangle_count;                   /* of shells */
    const int (*triangles)[3];            /* body-local node indices */
    int segment_count;                    /* of rods */
    const int (*segments)[2];
    int tetrahedron_count;                /* of volumes */
    const int (*tetrahedra)[4];
} cipc_body_description;

/* Positions that a set of nodes passes through, one frame every `interval` from `begin` on, straight from one to the next; at rest before the first and
 * after the last. */
typedef struct cipc_track {
    int frame_count;                      /* 0: none */
    double begin, interval;               /* s */
    double *frames;                       /* frame_count * 3 * (nodes of the set, in its order) */
} cipc_track;

/* A window of prescribed motion of one set of nodes (SPEC R.2, C.7): the part of the step that lies in [begin, end) is driven. */
typedef struct cipc_motion {
    double begin, end;                    /* s; end may be INFINITY */
    double velocity[3];                   /* m/s */
    double center[3], axis[3];            /* rotation about the axis through center; axis of unit length */
    double angular_velocity;              /* rad/s; the rotation of a step is exact and comes before the translation */
    double turn;                          /* s: both velocities change sign every so many seconds after the begin; 0: never */
} cipc_motion;

/* A set of Dirichlet nodes: fixed where they are, or moved by windows, until released. */
typedef struct cipc_dirichlet_set {
    int node_count;
    int *nodes;                           /* global node indices, ascending */
    double release;                       /* s; free from the first step that starts at or after it; INFINITY: never */
    int motion_count;
    cipc_motion *motions;
    cipc_track track;                     /* instead of motions */
} cipc_dirichlet_set;

/* A spring of no length from a node to a point of an edge (SPEC C.6): k/2 |x0 - ((1-r) x1 + r x2)|^2. What is sewn together does not meet in
 * contact: no primitive of the node meets a primitive of the edge's ends. */
typedef struct cipc_stitching {
    int nodes[3];                         /* global: the node, the edge's ends */
    double ratio;                         /* r in [0, 1] */
    double stiffness;                     /* k, N/m */
} cipc_stitching;

/* A constant force on each of a set of nodes, while a window of time is open. */
typedef struct cipc_load {
    int node_count;
    int *nodes;                           /* global node indices, ascending */
    double force[3];                      /* N, on each node */
    double begin, end;                    /* s; end may be INFINITY */
} cipc_load;

typedef struct cipc_body {
    char name[CIPC_NAME_SIZE];
    cipc_body_kind kind;
    cipc_material material;
    double offset;
    double friction;
    bool fixed;
    int first_node, node_count;
    int first_triangle, triangle_count;   /* a volume's: its surface */
    int first_segment, segment_count;     /* among the model's segments */
    int first_tetrahedron, tetrahedron_count;
} cipc_body;

typedef struct cipc_model {
    double gravity[3];                    /* m/s^2 */
    int body_count;
    cipc_body *bodies;
    double *pair_friction;                /* body_count * body_count, symmetric */
    bool *pair_apart;                     /* body_count * body_count, symmetric: bodies that do not meet each other (or themselves) */
    int node_count;
    double *rest;                         /* 3 * node_count */
    double *mass;                         /* node_count, kg, lumped (SPEC C.1) */
    int *node_body;                       /* node_count */
    int triangle_count;
    int (*triangles)[3];                  /* global node indices; of shells, and the surfaces of volumes, outward */
    int *triangle_body;
    int edge_count;
    int (*edges)[2];                      /* first the unique edges of all triangles, ascending by lower, then higher node, directed as in their first
                                           * triangle; then the segments */
    int first_segment;                    /* edges[first_segment + i] is segment i */
    int segment_count;
    int joint_count;
    int (*joints)[3];                     /* two segments that share the middle node: all pairs at each node of rods */
    int hinge_count;
    int (*hinges)[4];                     /* v0 v1 the shared edge, v2 and v3 opposite: triangles (v0,v1,v2) and (v1,v0,v3) */
    int tetrahedron_count;                /* volumes: positive orientation det[x1-x0, x2-x0, x3-x0] > 0 */
    int (*tetrahedra)[4];
    double *node_area;                    /* node_count, m^2: a third of the incident rest triangles */
    double *edge_area;                    /* edge_count, m^2: a third of the incident rest triangles */
    double *node_weight, *edge_weight;    /* what a contact of this node or edge weighs, 1 in the mean: areas by the mean area, of rods lengths by the mean
                                           * length, of particles 1 */
    bool *interior;                       /* node_count: inside a volume, where nothing touches it */
    int stitch_count;
    cipc_stitching *stitches;
    long link_count;
    int (*links)[2];                      /* nodes that are sewn to each other: both orders, ascending */
    int dirichlet_count;
    cipc_dirichlet_set *dirichlet;        /* the fixed bodies first, one set each, then the scene's */
    int load_count;
    cipc_load *loads;
} cipc_model;

/* Everything that changes in time and must survive a restart. */
typedef struct cipc_state {
    int step;                             /* number of steps taken */
    double time;                          /* s */
    int node_count;
    double *position, *velocity;          /* 3 * node_count; m, m/s */
    double barrier_stiffness;             /* kappa; 0: not chosen yet */
    double strain_stiffness_factor;       /* multiplies every body's strain_stiffness; starts at 1 (SPEC C.2) */
    int memory_count;                     /* numbers that the method remembers besides; 0: none */
    double *memory;                       /* memory_count, 0 at the start; what they are is the method's affair */
} cipc_state;

/* How all nodes moved from one instant to another: straight and evenly from each of its breaks to the next, a node without breaks all the way. */
typedef struct cipc_path_break {
    double time;                          /* s */
    int node;
    double x[3];                          /* m */
} cipc_path_break;
typedef struct cipc_paths {
    double begin, end;                    /* s, begin <= end */
    int node_count;
    const double *from, *to;              /* 3 * node_count: at begin and at end */
    long break_count;
    const cipc_path_break *breaks;        /* begin <= time <= end, ascending; of one node at one time the position is the same */
} cipc_paths;

/* Build a model from bodies: lumped masses, unique edges, hinges (of shells' edges with exactly two triangles of consistent or mended orientation;
 * edges with three or more triangles get none), joints of rods, surfaces of volumes, areas. CIPC_E_BAD_MESH on an index out of range, an element with a repeated node or
 * of no size at rest (a tetrahedron: of none or negative), a segment given twice, a node that no element uses; CIPC_E_OUT_OF_RANGE on non-finite or non-positive numbers. pair_friction starts from the bodies' own coefficients. */
cipc_status cipc_model_create(cipc_model **model, const cipc_body_description *bodies, int body_count, const double gravity[3], cipc_error *error);
void cipc_model_destroy(cipc_model *model);

/* Set the friction coefficient of a pair of bodies (both orders). */
void cipc_model_set_friction(cipc_model *model, int body_a, int body_b, double mu);
/* Append a Dirichlet set (nodes and motions are copied; nodes are sorted and made unique). */
cipc_status cipc_model_add_dirichlet(cipc_model *model, const cipc_dirichlet_set *set, cipc_error *error);
/* Append a load (nodes are copied, sorted and made unique). CIPC_E_OUT_OF_RANGE on a bad index, force or window. */
cipc_status cipc_model_add_load(cipc_model *model, const cipc_load *load, cipc_error *error);
/* Let a pair of bodies (or a body with itself) pass through each other. */
void cipc_model_set_apart(cipc_model *model, int body_a, int body_b);
/* Sew nodes to edges. CIPC_E_OUT_OF_RANGE on a bad index, ratio or stiffness: none is added then. */
cipc_status cipc_model_add_stitches(cipc_model *model, const cipc_stitching *stitches, int count, cipc_error *error);
/* Do the primitives of these nodes meet at all? Not if they share a node, if their bodies are apart, or if a node of one is sewn to a node of the other. */
bool cipc_model_meet(const cipc_model *model, const int *nodes_a, int count_a, const int *nodes_b, int count_b);
/* Index of the body of that name, or -1. */
int cipc_model_find_body(const cipc_model *model, const char *name);

/* State at time 0 from the descriptions the model was built of. */
cipc_status cipc_state_create(cipc_state **state, const cipc_body_description *bodies, int body_count, cipc_error *error);
/* Give a state the memory that a method asks for, all 0. CIPC_E_OUT_OF_MEMORY: the state is as it was. */
cipc_status cipc_state_remember(cipc_state *state, int count, cipc_error *error);
void cipc_state_destroy(cipc_state *state);

/* Contact thickness of a pair of nodes' primitives, (xi_a + xi_b)/2 by the bodies of one node of each (SPEC C.4, eq. 11). */
double cipc_model_pair_offset(const cipc_model *model, int node_a, int node_b);

/* Which nodes are Dirichlet during the step that starts at `time` and where they are to be at time + h.
 * is_dirichlet[node_count] and target[3*node_count] are filled; target = position for fixed and free nodes alike. A node in several sets
 * follows the last set that is not released; moves[node_count] (may be NULL) tells which nodes have a target other than their position. */
void cipc_dirichlet_targets(const cipc_model *model, const double *position, double time, double h, bool *is_dirichlet, double *target, bool *moves);

#endif
