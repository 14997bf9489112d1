/* What the files of scene_run share: a run under way, and what a method has to do of it. */
#ifndef SUPPORT_SCENE_RUNNING_H
#define SUPPORT_SCENE_RUNNING_H

#include "cipc/asynchronous.h"
#include "cipc/implicit.h"
#include "cipc/invariant.h"
#include "cipc/massspring.h"
#include "support/scene_run.h"

typedef struct scene_method scene_method;
typedef struct scene_running {
    cipc_scene *scene;
    cipc_monitor *monitor;
    const scene_method *method;
    scene_outcome *outcome;
    cipc_invariant_report seen;       /* of the state after the step */
    bool stopped;                     /* the watcher has seen enough */
    double *previous;                 /* c-ipc: the point accepted before, where the next path begins; asynchronous: velocities before the step, if momentum is kept */
    cipc_stepper *stepper;            /* of c-ipc */
    long points_of_step;
    cipc_asynchronous *integrator;    /* of asynchronous */
    cipc_massspring *springs;         /* of mass-spring */
    double energy;                    /* J, after the step before, without the gravitational one */
} scene_running;

/* begin: the solver, with the monitors set. take: a step, looked at and recorded in outcome->last; anything but CIPC_OK ends the run. */
struct scene_method {
    cipc_status (*begin)(scene_running *run, cipc_error *error);
    cipc_status (*take)(scene_running *run, cipc_error *error);
    void (*end)(scene_running *run);
};
extern const scene_method scene_implicit, scene_asynchronous, scene_massspring;

/* What a good look at a state found goes to the outcome, and is what was seen last. */
void scene_take_in(scene_running *run, const cipc_invariant_report *report);

#endif
