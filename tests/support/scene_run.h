/* A scene of tests/scenes run through the library as `cipc run` does it: every accepted point goes to the monitors, every step has to
 * converge; of the method asynchronous every frame and all paths in between go to the monitors; of mass-spring
 * every frame, where intersections are counted. What comes out is what the golden bands
 * (golden.h) and the claims are about. */
#ifndef SUPPORT_SCENE_RUN_H
#define SUPPORT_SCENE_RUN_H

#include "cipc/scene.h"
#include "support/scene_frame.h"

/* Which run: scene file, overrides as after --set (NULL-terminated, at most SCENE_RUN_OVERRIDES), and how it is disturbed. */
enum { SCENE_RUN_OVERRIDES = 8 };
typedef struct scene_request {
    const char *file;                  /* relative to the project's folder, where tests run */
    const char *overrides[SCENE_RUN_OVERRIDES + 1];
    int threads;                       /* >= 1 */
    double tolerance_factor;           /* multiplies newton.tolerance; 0 means 1 */
    double jitter;                     /* m: every free node starts up to this far from its place in x, y and z; 0: none */
    unsigned long jitter_seed;
    /* Called after every step (from 1) with what it left; false: the run ends there, without being a failure. NULL: to the last step. */
    bool (*watch)(void *context, int step, const scene_frame *frame);
    void *context;
} scene_request;

typedef struct scene_outcome {
    scene_frame last;                  /* after the last step */
    int probe[SCENE_PROBES];           /* the probes' nodes */
    int steps;                         /* taken, all converged */
    cipc_method method;
    long points, energy_checks;        /* accepted points (frames of the methods asynchronous and mass-spring) that the monitors looked at; those with comparable energies */
    long intersecting, too_near;       /* mass-spring: frames that break M1 and M2 */
    long windows, momentum_checks;     /* asynchronous: windows of paths that were looked at; steps whose momentum had to be kept */
    double min_gap;                    /* m: d - xi, smallest at any accepted point; INFINITY: nothing came within reach */
    double max_stretch, max_stretch_ratio; /* at any accepted point */
    double max_step_stretch;           /* largest principal stretch after any step */
    long exact_gap_checks, exact_strain_checks;
    long paths_checked, exact_path_checks; /* M5 */
    int max_contacts, max_layers;      /* layers: of the method asynchronous, deepest */
    double max_friction;               /* J: largest friction term of a step's incremental potential; > 0: friction was active */
    double time_step, tolerance, moving_mass; /* s, m/s, kg */
    double travel;                     /* m, of the centre of mass */
    double speed;                      /* m/s, of the centre of mass at the end */
    double stretch_limit;              /* the smallest limit of any body; 0: none */
    int node_count;
    double *position, *velocity;       /* 3 * node_count, of cipc_alloc: the state at the end */
} scene_outcome;
void scene_outcome_free(scene_outcome *outcome);

/* Run it to its last step. CIPC_OK: every step converged and every invariant held at every accepted point. Anything else: what the step
 * or a monitor said, with the place prefixed by step and iteration (both from 1) or time. *outcome is to be freed in either case. */
cipc_status scene_run(const scene_request *request, scene_outcome *outcome, cipc_error *error);

#endif
