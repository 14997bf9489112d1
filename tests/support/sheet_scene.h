/* Small scenes of triangulated sheets, made in memory, for tests of the time step: bodies -> model, state and stepper. Anything that fails
 * ends the test. */
#ifndef SUPPORT_SHEET_SCENE_H
#define SUPPORT_SHEET_SCENE_H

#include "cipc/implicit.h"
#include "cipc/invariant.h"

enum { SHEET_SCENE_BODIES = 8 };

typedef struct sheet_scene {
    int body_count;
    cipc_body_description bodies[SHEET_SCENE_BODIES];
    double gravity[3];
    cipc_implicit_options options;
    cipc_model *model;
    cipc_state *state;
    cipc_stepper *stepper;
    cipc_step_report report; /* of the last step */
    cipc_error error;
    cipc_monitor *monitor;    /* of sheet_watch */
    int accepted;             /* points that the monitor saw */
    int energy_rises;         /* among them: energy went up by more than the noise claimed */
    double min_gap;           /* least d - xi of all points seen, m; INFINITY: none within reach */
    double max_stretch_ratio; /* largest (sigma - 1)/(s - 1) */
} sheet_scene;

/* Default options, no bodies, no gravity. */
void sheet_scene_init(sheet_scene *scene);
void sheet_scene_free(sheet_scene *scene);

/* A body of any kind; the arrays are copied (velocity NULL: at rest). */
cipc_body_description *sheet_add(sheet_scene *scene, const cipc_body_description *body);
/* A cloth-like material: Neo-Hookean, bending, no strain limit. Change the description that is returned before building. */
cipc_body_description *sheet_add_body(sheet_scene *scene, const char *name, int nodes, const double *rest, int triangles,
                                      const int (*triangle)[3]);
/* nx * ny cells spanned by u and v from `corner`, two triangles each, nodes row by row along u. */
cipc_body_description *sheet_add_grid(sheet_scene *scene, const char *name, const double corner[3], const double u[3], const double v[3],
                                      int nx, int ny);
/* One triangle. */
cipc_body_description *sheet_add_triangle(sheet_scene *scene, const char *name, const double a[3], const double b[3], const double c[3]);
/* A velocity for every node of a body. */
void sheet_set_velocity(cipc_body_description *body, const double velocity[3]);

/* Model and state; then the stepper (rebuilt if there is one, e.g. with other options). */
void sheet_scene_model(sheet_scene *scene);
void sheet_scene_stepper(sheet_scene *scene);
void sheet_scene_build(sheet_scene *scene);
/* One set of Dirichlet nodes with at most one motion; between sheet_scene_model and sheet_scene_stepper. */
void sheet_hold(sheet_scene *scene, const int *nodes, int count, const cipc_motion *motion, double release);

/* One step: its status is returned, report and error are kept. */
cipc_status sheet_try_step(sheet_scene *scene);
/* One step that must converge. */
void sheet_step(sheet_scene *scene);
void sheet_steps(sheet_scene *scene, int count);

/* From now on the exact monitors look at every accepted point; a violation ends the step with its status. After the stepper is made. */
void sheet_watch(sheet_scene *scene);

/* Working arrays of the stepper as at the start of a step, for tests of its single parts: needs "implicit/stepper.h" to look at. */
void sheet_begin(sheet_scene *scene);

/* Same bits? */
int sheet_same_bits(const double *a, const double *b, int count);

#endif
