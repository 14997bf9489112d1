/* Runs for what the papers' figures show: where the bodies of a scene end. Sizes other than "ci" take long, so a test takes the end of a run that `cipc run` has made, if there is one. */
#ifndef SUPPORT_FIGURE_RUN_H
#define SUPPORT_FIGURE_RUN_H

#include "cipc/scene.h"

enum { FIGURE_OVERRIDES = 7 };

/* $CIPC_SIZE, or "ci". */
const char *figure_size(void);

typedef struct figure_run {
    cipc_scene *scene;   /* model, and the state at the start */
    double *end;         /* 3 * node_count: positions after the last step */
    int steps;
    double min_gap, max_stretch; /* m, 1: at any accepted point */
} figure_run;

/* The scene tests/scenes/SCENE.json at figure_size(), with overrides (NULL-terminated, at most FIGURE_OVERRIDES). If $CIPC_RUNS names a folder in which RUN is the output of a complete
 * run of this very scene (the same text when resolved), its last frame; otherwise it is run here, one thread, every monitor on. Fails the test if a step or an invariant fails. If RUN is not
 * selected by $CIPC_RUNS_SELECTED, the test is skipped. */
figure_run figure_run_of(const char *run, const char *scene, const char *const *overrides);
void figure_run_free(figure_run *run);

/* Is it one of the words of `selected`, which a space parts? NULL selects everything. */
bool figure_run_selected(const char *run, const char *selected);

/* The body of this name; fails the test if there is none. */
const cipc_body *figure_body(const figure_run *run, const char *name);
/* Centre of mass of a body at positions x of all nodes. */
void figure_centre(const figure_run *run, const cipc_body *body, const double *x, double centre[3]);

#endif
