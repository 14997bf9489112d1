/* cipc/implicit.h - the C-IPC time step: incremental potential, projected Newton, line search, friction lag, Dirichlet motion.
 * Floor 5. */
#ifndef CIPC_IMPLICIT_H
#define CIPC_IMPLICIT_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/contact.h"
#include "cipc/model.h"

/* E(x) = 1/2 |x - xhat|_M^2 + alpha h^2 Psi(beta x + gamma x^n) + B(x) + D(x) (SPEC C.1). Implicit Euler (1, 1, 0), implicit midpoint (1, 1/2, 1/2). */
typedef struct cipc_integrator { double alpha, beta, gamma; } cipc_integrator;

/* How a Newton step's length is measured for the stopping rule. */
typedef enum cipc_newton_norm {
    CIPC_NORM_MAX = 0, /* max_i |p_i| / h over free nodes (SPEC D.7) */
    CIPC_NORM_RMS      /* sqrt(sum |p_i|^2 / n_free) / h, the largest of the last three iterations (SPEC R.2, as released) */
} cipc_newton_norm;

/* How strain limits enter a step (paper, section 6.3): in the one incremental potential; or, for comparison, after it: a predictor without limits, then the point
 * nearest to it (mass-weighted) that keeps limits and contact. */
typedef enum cipc_strain_coupling { CIPC_STRAIN_COUPLED = 0, CIPC_STRAIN_SPLIT } cipc_strain_coupling;

typedef struct cipc_implicit_options {
    double time_step;                 /* h, s */
    bool quasistatic;                 /* no inertia: every step ends in an equilibrium, at rest; h scales scripted motion, friction and the tolerance only */
    cipc_strain_coupling strain_coupling;
    cipc_integrator integrator;
    double newton_tolerance;          /* m/s */
    cipc_newton_norm newton_norm;
    int newton_iterations;            /* cap per solve */
    int line_search_halvings;         /* cap per line search */
    int friction_iterations;          /* lagging passes: >= 1, or 0: until it converges (capped by friction_cap) */
    int friction_cap;
    double friction_velocity;         /* eps_v, m/s */
    cipc_contact_options contact;
    cipc_ccd_options ccd;
    double barrier_stiffness;         /* kappa at the start; 0: chosen by the rule */
    bool released;                    /* "compat": "released": the choices of the released C-IPC code (SPEC R) */
    int threads;
} cipc_implicit_options;
cipc_implicit_options cipc_implicit_options_default(void);

/* Phases that a step's time is split into. */
#define CIPC_PHASES(X) X(BROAD_PHASE, "broad_phase") X(CONTACT, "contact") X(ASSEMBLY, "assembly") X(SYMBOLIC, "symbolic") X(FACTORIZATION, "factorization") \
    X(SOLVE, "solve") X(CCD, "ccd") X(LINE_SEARCH, "line_search") X(MONITOR, "monitor") X(OTHER, "other")
typedef enum cipc_phase {
#define CIPC_X(name, text) CIPC_PHASE_##name,
    CIPC_PHASES(CIPC_X)
#undef CIPC_X
    CIPC_PHASE_COUNT
} cipc_phase;
const char *cipc_phase_name(cipc_phase phase);

/* The incremental potential by term, J (elastic terms are times alpha h^2; barrier and friction as they enter E). */
typedef struct cipc_energy_terms {
    double inertia, membrane, bending, strain_limit, barrier, friction, penalty;
    double damping;
    double stretching, volume, stitches; /* of rods; of tetrahedra; bending is that of shells and rods */
    double total;
    double noise;   /* bound on the rounding error of total */
} cipc_energy_terms;

/* What one time step did. */
typedef struct cipc_step_report {
    bool converged;
    int newton_iterations, line_search_halvings, friction_passes, factorizations, symbolic_analyses;
    int contacts;                 /* active stencils at the end */
    int max_contacts;
    double residual;              /* m/s, at the end */
    double barrier_stiffness, strain_stiffness_factor;
    double min_gap;               /* of the solver's own active set, m */
    cipc_energy_terms incremental;    /* E and its terms at the end of the step */
    double kinetic, gravitational, elastic;  /* physical energies at the end of the step, J: 1/2 m v^2 of free nodes, -m g.x of free nodes, Psi */
    double seconds[CIPC_PHASE_COUNT];
} cipc_step_report;

/* One accepted point: what a monitor is told. The first of a step (iteration -1) is the Dirichlet motion, if any. */
typedef struct cipc_accepted_point {
    const double *x;              /* 3 * node_count */
    int step, iteration;
    bool energy_valid;            /* energies before and after are comparable (same potential) */
    double energy_before, energy_after, energy_noise;
} cipc_accepted_point;
/* Returns CIPC_OK to go on; anything else stops the step, which returns that status with the error as filled. */
typedef cipc_status cipc_monitor_callback(void *context, const cipc_accepted_point *point, cipc_error *error);

typedef struct cipc_stepper cipc_stepper;
/* CIPC_E_OUT_OF_RANGE on options out of range; CIPC_E_WRONG_TYPE if the model has what the method does not know: loads, membranes of springs. The model must outlive it. */
cipc_status cipc_stepper_create(cipc_stepper **stepper, const cipc_model *model, const cipc_implicit_options *options, cipc_error *error);
void cipc_stepper_destroy(cipc_stepper *stepper);
void cipc_stepper_set_monitor(cipc_stepper *stepper, cipc_monitor_callback *callback, void *context);

/* A search for the part of a path x + t p, t in [0, t_max], that meets no contact: of a line search, or of scripted motion. What is asked of each candidate is told by
 * cipc_candidates_query. */
typedef struct cipc_ccd_search {
    const cipc_candidates *candidates; /* in an order that does not depend on the number of threads */
    const double *x, *p;               /* 3 * node_count each */
    double t_max;
    int step;                          /* the time step under way, from 0 */
    const cipc_ccd_options *options;
} cipc_ccd_search;
/* Called before each search, from one thread; what the search holds is valid during the call only. It changes nothing and cannot fail. */
typedef void cipc_ccd_watch(void *context, const cipc_ccd_search *search);
void cipc_stepper_set_ccd_watch(cipc_stepper *stepper, cipc_ccd_watch *watch, void *context);

/* Advance state by one time step. CIPC_OK: converged. CIPC_E_NOT_CONVERGED / _NO_PROGRESS / ...: *state holds the last accepted point (never
 * intersecting), state->step and time are not advanced; error names the step, the residual and the limiting pair. */
cipc_status cipc_step(cipc_stepper *stepper, cipc_state *state, cipc_step_report *report, cipc_error *error);

#endif
