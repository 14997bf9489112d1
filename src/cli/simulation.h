/* One run of a scene: from the loaded scene to the files in the output folder. */
#ifndef CLI_SIMULATION_H
#define CLI_SIMULATION_H

#include <stdbool.h>
#include <stdio.h>
#include "cipc/output.h"
#include "cipc/scene.h"

/* What the command line asks for. */
typedef struct cipc_run_request {
    const char *scene_name;  /* "drape" */
    const char *directory;   /* to write to */
    const char *command;     /* the words of the command line */
    const char *junit;       /* file for the verdicts as JUnit XML, or NULL */
    const char *record_ccd;  /* file for the queries put to CCD, or NULL */
    long record_ccd_limit;
    bool resume, monitor, quiet, write_obj;
} cipc_run_request;

typedef struct cipc_simulation {
    const cipc_run_request *request;
    cipc_scene *scene;
    cipc_monitor *monitor;
    cipc_stepper *stepper;           /* of the method c-ipc, else NULL */
    cipc_asynchronous *integrator;   /* of the method asynchronous, else NULL */
    cipc_massspring *massspring;     /* of the method mass-spring, else NULL */
    cipc_trajectory *trajectory;
    FILE *stats;
    cipc_ccd_record *ccd_record;     /* NULL: none is asked for */
    cipc_run_summary summary;
    cipc_step_invariants seen;       /* of the step under way */
    cipc_step_report report;         /* of the last step (c-ipc) */
    cipc_asynchronous_report events; /* of the last step (asynchronous) */
    cipc_massspring_report springs;  /* of the last step (mass-spring) */
    cipc_massspring_times times;     /* likewise */
    double energy;                   /* at its end, without the gravitational, J (asynchronous); 0: not known */
    double *previous;                /* 3 * node_count: the point accepted before, where the next path begins; NULL: paths are not checked */
    double *velocity;                /* 3 * node_count: before the step under way; NULL: momentum is not checked */
    int first_step;                  /* that this process began with */
    double begin, earlier_seconds;   /* of this process; of those it goes on from */
    bool interrupted;
    cipc_error error;                /* how the run ended, if not well */
} cipc_simulation;

/* Seconds on a clock that only goes forward. */
double cipc_clock(void);

/* "DIR/name", a block of cipc_alloc; NULL: out of memory. */
char *cipc_path_in(const char *directory, const char *name);

/* Run the scene. Returns the exit status; messages have been printed. */
int cipc_simulate(cipc_scene *scene, const cipc_run_request *request);

/* The verdicts as JUnit XML, if a file is named, after a run that ends with exit_status. Returns that, or the exit status of a failure to write; the message has been printed. */
int cipc_verdicts_junit(const char *path, const cipc_run_summary *summary, int exit_status);

/* The steps themselves (cli/steps.c): until all are done, one fails, an invariant breaks, or a signal comes. */
cipc_status cipc_simulation_steps(cipc_simulation *s);
/* The state under a name in the output folder; an error is said, not returned (another error is why it is written). */
void cipc_simulation_write_state(const cipc_simulation *s, const char *name, const double *position);

/* The frame of the present state as DIR/obj/frame_NNNNN.obj. */
cipc_status cipc_simulation_frame_obj(const cipc_simulation *s, cipc_error *error);

/* The files of the end (cli/results.c): summary, XDMF, pictures, also after a run that failed. The first error. */
cipc_status cipc_simulation_results(cipc_simulation *s, cipc_error *error);
/* XDMF for the frames so far. */
cipc_status cipc_simulation_xdmf(cipc_simulation *s, cipc_error *error);

#endif
