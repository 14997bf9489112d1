/* Small scenes for tests of asynchronous contact mechanics: a sheet_scene whose bodies are moved by that integrator. Anything that fails ends the test. */
#ifndef SUPPORT_ASYNCHRONOUS_SCENE_H
#define SUPPORT_ASYNCHRONOUS_SCENE_H

#include "cipc/asynchronous.h"
#include "support/sheet_scene.h"

typedef struct asynchronous_scene {
    sheet_scene sheet;                 /* bodies, gravity, model, state; its stepper is not used */
    cipc_asynchronous_options options;
    cipc_asynchronous *integrator;
    cipc_asynchronous_report report;   /* of the last step */
    long events[CIPC_EVENT_COUNT];     /* of all steps so far */
    int layers;                        /* deepest so far */
    double min_gap;                    /* least at a tick of a layer so far, m */
    long paths_checked;                /* of asynchronous_watch: pairs whose paths were looked at */
    double seen_gap;                   /* and the least d - xi at a frame, m; INFINITY: none within eta(1) */
    cipc_error error;
} asynchronous_scene;

void asynchronous_scene_init(asynchronous_scene *scene);
void asynchronous_scene_free(asynchronous_scene *scene);

/* Particles of a mass (kg) each, at 3 * count positions, all with one velocity. */
void asynchronous_add_particles(asynchronous_scene *scene, const char *name, int count, const double *position, const double velocity[3], double mass);
/* A fixed square of two triangles in the plane y = height, half an edge `half`. */
void asynchronous_add_floor(asynchronous_scene *scene, double height, double half);

/* Model and state, masses of the particles as asked; then the integrator (anew if there is one). */
void asynchronous_scene_model(asynchronous_scene *scene);
void asynchronous_scene_start(asynchronous_scene *scene);
void asynchronous_scene_build(asynchronous_scene *scene);

cipc_status asynchronous_try_step(asynchronous_scene *scene);
void asynchronous_steps(asynchronous_scene *scene, int count);

/* From now on the exact monitors look at every frame (M8, M1, M2) and at all paths (M5); a violation ends the step with its status. */
void asynchronous_watch(asynchronous_scene *scene);

#endif
