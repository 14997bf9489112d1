/* What is recorded of a scene after each step: the numbers that golden files bound (golden.h) and that `test_scenes --record` prints. */
#ifndef SUPPORT_SCENE_FRAME_H
#define SUPPORT_SCENE_FRAME_H

#include "cipc/asynchronous.h"
#include "cipc/implicit.h"
#include "cipc/invariant.h"
#include "cipc/massspring.h"
#include "cipc/model.h"

/* X(name, numbers, unit). "Moving nodes" are those of bodies that are not fixed; `min_gap` and the stretches are of the state after the step;
 * membrane to friction are the terms of the incremental potential, `elastic` the energy itself (docs/formats.md, stats.jsonl). What the method
 * does not have is 0: of asynchronous and mass-spring the terms of the incremental potential and Newton iterations, of c-ipc what comes after these. Of asynchronous only
 * such numbers are taken as follow from the trajectory: not how many events it took to see that nothing was to be done. */
#define SCENE_QUANTITIES(X)                                                                                                          \
    X(centre_of_mass, 3, "m")   /* of the moving nodes */                                                                            \
    X(box_low, 3, "m")          /* their bounding box */                                                                             \
    X(box_high, 3, "m")                                                                                                              \
    X(first_node, 3, "m")       /* probes: of the nodes that are free at the start */                                                \
    X(middle_node, 3, "m")                                                                                                           \
    X(last_node, 3, "m")                                                                                                             \
    X(kinetic, 1, "J")                                                                                                               \
    X(gravitational, 1, "J")                                                                                                         \
    X(elastic, 1, "J")                                                                                                               \
    X(membrane, 1, "J")                                                                                                              \
    X(bending, 1, "J")                                                                                                               \
    X(strain_limit, 1, "J")                                                                                                          \
    X(stretching, 1, "J")       /* of rods */                                                                                        \
    X(volume, 1, "J")                                                                                                                \
    X(stitches, 1, "J")                                                                                                              \
    X(damping, 1, "J")                                                                                                               \
    X(barrier, 1, "J")                                                                                                               \
    X(friction, 1, "J")                                                                                                              \
    X(min_gap, 1, "m")          /* d - xi of the nearest pair; the monitor's reach when none is nearer */                            \
    X(largest_stretch, 1, "1")  /* of triangles; 0: none has a membrane or a limit */                                                \
    X(segment_stretch, 1, "1")  /* of rods; 0: none */                                                                               \
    X(contacts, 1, "1")         /* active stencils; asynchronous: pairs within the monitor's reach, which is eta(1); mass-spring: nodes on bodies */               \
    X(newton_iterations, 1, "1") /* of all steps so far */                                                                           \
    X(contact, 1, "J")          /* asynchronous: of all layers */                                                                    \
    X(layers, 1, "1")           /* the deepest that was active in the step */                                                        \
    X(impulses, 1, "1")         /* ticks of layers that did something, in all steps so far */                           \
    X(deformation, 1, "1")      /* mass-spring: largest B of its springs */

/* Doubles and nothing else, so that a frame is also an array of SCENE_NUMBERS. */
typedef struct scene_frame {
#define X(name, numbers, unit) double name[numbers];
    SCENE_QUANTITIES(X)
#undef X
} scene_frame;

typedef enum scene_quantity {
#define X(name, numbers, unit) QUANTITY_##name,
    SCENE_QUANTITIES(X)
#undef X
    QUANTITY_COUNT
} scene_quantity;
enum { SCENE_NUMBERS = sizeof(scene_frame) / sizeof(double) };

const char *scene_quantity_name(scene_quantity quantity);
const char *scene_quantity_unit(scene_quantity quantity);
int scene_quantity_numbers(scene_quantity quantity);
int scene_quantity_first(scene_quantity quantity); /* where its numbers begin among those of the frame */
scene_quantity scene_quantity_of(int number);      /* whose number this is */
double *scene_frame_numbers(scene_frame *frame);
const double *scene_frame_values(const scene_frame *frame);

/* First, middle and last of the nodes that are free during the first step; of all moving nodes when all are held. */
enum { SCENE_PROBES = 3 };
void scene_probes(const cipc_model *model, const bool *held, int probe[SCENE_PROBES]);
bool scene_node_moves(const cipc_model *model, int node);

/* What a step left: positions x[3 * node_count], what the monitors saw of x, and the frame before it (of the start all 0). */
typedef struct scene_step {
    const cipc_model *model;
    const double *x;
    const int *probe;
    const cipc_invariant_report *seen;
    double reach; /* m, of the monitors */
    const scene_frame *before;
} scene_step;
scene_frame scene_frame_of(const scene_step *step, const cipc_step_report *report);
scene_frame scene_frame_of_asynchronous(const scene_step *step, const cipc_asynchronous_report *report);
scene_frame scene_frame_of_massspring(const scene_step *step, const cipc_massspring_report *report);

#endif
