/* The working memory of the implicit integrator, shared by its files. One time step reads: step.c -> newton.c -> line_search.c, assembly.c. */
#ifndef CIPC_IMPLICIT_STEPPER_H
#define CIPC_IMPLICIT_STEPPER_H

#include <time.h>
#include "cipc/implicit.h"
#include "implicit/block_matrix.h"
#include "implicit/linear_solver.h"

/* Elements of one energy: stencils and params side by side. */
typedef struct cipc_element_group {
    const cipc_energy *energy;
    int count;
    int *nodes;     /* count * energy->nodes */
    void *params;   /* count * energy->params_size */
    int *triangles; /* upper strain limit only: which triangle each element is */
} cipc_element_group;

enum {
    CIPC_GROUP_NEO_HOOKEAN = 0, CIPC_GROUP_STVK, CIPC_GROUP_ORTHOTROPIC, CIPC_GROUP_HINGE,
    CIPC_GROUP_ROD_STRETCHING, CIPC_GROUP_ROD_BENDING, CIPC_GROUP_COROTATIONAL, CIPC_GROUP_VOLUME_NEO_HOOKEAN, CIPC_GROUP_STITCH,
    CIPC_GROUP_STRAIN_LIMIT, CIPC_GROUP_STRAIN_LIMIT_LOWER, CIPC_GROUP_COUNT
};

static inline bool cipc_is_strain_limit(int group) { return group == CIPC_GROUP_STRAIN_LIMIT || group == CIPC_GROUP_STRAIN_LIMIT_LOWER; }

/* Lagged friction: one entry a contact that has any (SPEC D.6). */
typedef struct cipc_friction_set {
    int count, capacity;
    cipc_friction *params;
    int (*nodes)[4]; /* a repeated node with weight 0 fills short stencils */
} cipc_friction_set;

/* Lagged damping: one entry an element of a body that has any. */
typedef struct cipc_damping_set {
    int count;
    cipc_damping *params;
    int (*nodes)[4]; /* as for friction */
} cipc_damping_set;

/* Candidate pairs that stay valid while every node is within slack/2 of its reference position. */
typedef struct cipc_candidate_cache {
    cipc_broad_phase *broad_phase;
    cipc_candidates candidates;
    double *reference; /* 3 * node_count */
    double slack;      /* m; 0: empty */
    bool along_path;   /* found around a whole path: any point of it may become the reference */
} cipc_candidate_cache;

/* What limited the last line search, for the report of a step that fails. */
typedef struct cipc_limit {
    const char *what; /* "contact", "strain limit", "energy decrease", or NULL */
    int nodes[4];
} cipc_limit;

/* What a solve minimises: all of E; or, with split strain limits, first E without limits, then the distance to its minimum with limits and contact (SPEC 6.3). */
typedef enum cipc_stage { CIPC_STAGE_WHOLE = 0, CIPC_STAGE_PREDICT, CIPC_STAGE_PROJECT } cipc_stage;

struct cipc_stepper {
    const cipc_model *model;
    cipc_implicit_options options;
    cipc_monitor_callback *monitor;
    void *monitor_context;
    cipc_ccd_watch *ccd_watch;
    void *ccd_watch_context;
    double bounding_box_diagonal; /* of the rest shape and the first state, m */
    double mean_mass;             /* kg */
    double min_strain_stiffness, max_strain_stiffness;

    cipc_element_group groups[CIPC_GROUP_COUNT];
    bool *near_limit;             /* elements of the two strain limits, upper then lower, close to their limit at the previous iterate */

    /* the present step */
    double *x_start, *x_hat, *x, *trial, *blend; /* 3 * node_count each: x^n, xhat, iterate, trial, beta x + gamma x^n */
    double *gradient, *direction;                /* 3 * node_count; 0 at Dirichlet nodes */
    double *target;
    bool *is_dirichlet, *moves;
    bool *passive;                /* nodes that do not meet one another: see dirichlet_motion.c */
    int *free_index;              /* node -> row of the Newton system, or -1 */
    int *free_nodes, free_count;
    double penalty;               /* k_D of nodes that could not be moved at once; 0: none */
    double kappa, strain_factor;
    cipc_stage stage;             /* what of E this solve minimises */
    double noise;                 /* bound on the rounding error of E near the iterate, J */
    cipc_contact_set contacts, trial_contacts;
    cipc_friction_set friction;
    cipc_damping_set damping;
    cipc_candidate_cache cache;
    cipc_limit limit;
    int step;

    /* the Newton system */
    cipc_block_matrix matrix;
    bool pattern_valid;
    bool project;                 /* local Hessians are projected to positive semi-definite */
    bool majorize_friction;       /* friction enters the Newton matrix by its majorizer */
    int *static_slots;            /* block index of every pair of nodes of every element, -1: Dirichlet */
    int *contact_slots;
    int contact_slot_capacity;
    int (*kept_pairs)[2];         /* block pairs of contacts that the pattern keeps: those of the last analyses */
    long kept_pair_count;
    cipc_linear_solver *solver;
    double *right, *solution;     /* 3 * free_count */
    double *values, *locals;      /* per element: value; local gradient or Hessian */
    size_t value_capacity, local_capacity;

    cipc_step_report *report;
};

static inline double cipc_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* elements.c: element groups from the model. */
cipc_status cipc_elements_create(cipc_stepper *s, cipc_error *error);
void cipc_elements_destroy(cipc_stepper *s);

/* potential.c: E at x with a given contact set; its terms; its gradient at s->x (and s->noise). INFINITY where infeasible. */
cipc_status cipc_potential_value(cipc_stepper *s, const double *x, const cipc_contact_set *contacts, cipc_energy_terms *terms, cipc_error *error);
cipc_status cipc_potential_gradient(cipc_stepper *s, cipc_error *error);
/* Gradient of the barrier alone with kappa = 1, and of everything else, for the stiffness fit of SPEC D.4: returns the fitted kappa, or 0. */
cipc_status cipc_fit_stiffness(cipc_stepper *s, double *kappa, cipc_error *error);

/* The parts of E as lists of like terms, so that value, gradient and Hessian walk the same thing. */
typedef struct cipc_term_list {
    const cipc_energy *energy; /* NULL: each contact has its own */
    int count;
    const char *params;        /* stride bytes apart */
    size_t params_stride;
    const char *nodes;         /* int[...], stride bytes apart */
    size_t nodes_stride;
    double scale;              /* factor of the energy in E */
    double chain;              /* d(position)/dx: beta where the energy sees beta x + gamma x^n, else 1 */
    bool blended;
    double intrinsic_noise;    /* J per unit of u: size of the intermediate terms that cancel; see potential.c */
    bool convex;               /* Hessian needs no projection */
} cipc_term_list;
enum {
    CIPC_LIST_CONTACT = CIPC_GROUP_COUNT, CIPC_LIST_FRICTION, CIPC_LIST_DAMPING,
    CIPC_LIST_COUNT
};
void cipc_term_lists(const cipc_stepper *s, const cipc_contact_set *contacts, cipc_term_list lists[CIPC_LIST_COUNT]);
static inline const cipc_energy *cipc_term_energy(const cipc_term_list *list, int i)
{
    return list->energy ? list->energy : cipc_energy_entry(((const cipc_contact *)(const void *)(list->params + (size_t)i * list->params_stride))->energy);
}
static inline const void *cipc_term_params(const cipc_term_list *list, int i)
{
    const char *p = list->params + (size_t)i * list->params_stride;
    return list->energy ? (const void *)p : (const void *)&((const cipc_contact *)(const void *)p)->barrier;
}
static inline const int *cipc_term_nodes(const cipc_term_list *list, int i) { return (const int *)(const void *)(list->nodes + (size_t)i * list->nodes_stride); }

/* Factor m of a node's drag 1/2 m |x - x^n|^2 by mass-proportional damping, kg; its inertia has that factor too, or none in an equilibrium. */
static inline double cipc_drag_mass(const cipc_stepper *s, int node)
{
    const cipc_material *material = &s->model->bodies[s->model->node_body[node]].material;
    if (s->stage == CIPC_STAGE_PROJECT) return 0;
    return material->damping_mass * s->options.integrator.alpha * s->options.time_step * s->model->mass[node];
}
static inline double cipc_inertial_mass(const cipc_stepper *s, int node)
{
    return s->options.quasistatic && s->stage != CIPC_STAGE_PROJECT ? 0 : s->model->mass[node];
}

/* assembly.c: projected Hessian of E at s->x into s->matrix; keeps pattern and symbolic factorisation while they fit. Call cipc_potential_gradient first:
 * it fills s->blend. */
cipc_status cipc_assemble_hessian(cipc_stepper *s, cipc_error *error);
void cipc_assembly_invalidate(cipc_stepper *s);

/* candidates.c: make the cached candidates valid for the path x + t p, t in [0,1], within dhat; p may be NULL. */
cipc_status cipc_cache_cover(cipc_stepper *s, const double *x, const double *p, cipc_error *error);
/* The iterate has moved to s->x, a point of the path last covered: keep the candidates centred where that is allowed. */
void cipc_cache_recentre(cipc_stepper *s);
/* Contact set at x from the cached candidates, which must cover it. */
cipc_status cipc_contacts_at(cipc_stepper *s, const double *x, cipc_contact_set *set, cipc_error *error);

/* strain.c: all limited triangles strictly within their limits and all tetrahedra of positive volume (with a margin for rounding). A step along p, the largest but for a
 * fraction, at whose end they are so. */
bool cipc_strain_feasible(const cipc_stepper *s, const double *x);
double cipc_strain_step(cipc_stepper *s, const double *x, const double *p);
/* Doubles s->strain_factor by the rule of SPEC C.2; true if it did. */
bool cipc_strain_adapt(cipc_stepper *s);

/* contact_step.c: the largest part, up to t_max, of the way from s->x along s->direction, which the cache must cover, that meets no contact; what limits it goes to
 * s->limit. */
double cipc_contact_step(cipc_stepper *s, double t_max);

/* dirichlet_motion.c */
cipc_status cipc_dirichlet_begin(cipc_stepper *s, double time, cipc_error *error);
/* Fraction of the way that penalised nodes have gone; 1 if there are none. */
double cipc_dirichlet_progress(const cipc_stepper *s);
/* Try to put penalised nodes on their targets; true if they are there and fixed. */
cipc_status cipc_dirichlet_finish(cipc_stepper *s, int iteration, bool *done, cipc_error *error);
void cipc_number_free_nodes(cipc_stepper *s);

/* line_search.c: move s->x along s->direction; *alpha the step taken (0: none found); E before in *energy, after on return. */
cipc_status cipc_line_search(cipc_stepper *s, int iteration, double slope, double *energy, double *alpha, cipc_error *error);

/* newton.c: minimise E from s->x with fixed friction data. */
cipc_status cipc_newton(cipc_stepper *s, cipc_error *error);

/* friction_lag.c: friction data from the present contacts. */
cipc_status cipc_friction_lag(cipc_stepper *s, cipc_error *error);

/* damping_lag.c: damping data from the elements at x^n. */
cipc_status cipc_damping_lag(cipc_stepper *s, cipc_error *error);

/* step.c: tell the monitor of an accepted point. */
cipc_status cipc_accept(cipc_stepper *s, int iteration, bool energy_valid, double before, double after, cipc_error *error);
/* Value buffer of at least `count` doubles / local buffer of `count` * `size`. */
cipc_status cipc_reserve_values(cipc_stepper *s, size_t count, cipc_error *error);
cipc_status cipc_reserve_locals(cipc_stepper *s, size_t count, cipc_error *error);

#endif
