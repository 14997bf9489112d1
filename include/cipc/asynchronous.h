/* cipc/asynchronous.h - asynchronous contact mechanics (SPEC A): every force has a clock of its own, contact is an infinite family of nested
 * penalty layers of which only those in touch tick, and kinetic certificates tell when the next one is touched. Floor 5. */
#ifndef CIPC_ASYNCHRONOUS_H
#define CIPC_ASYNCHRONOUS_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/model.h"

/* ---- The layers (SPEC A.4, A.5; docs/theory/asynchronous.md) ---------------------------------------------------------------------------- */

/* eta(l) = eta(1) l^(-1/4) and r(l) = r(1) l^3, l = 1, 2, ... */
double cipc_layer_thickness(double thickness, int layer);
double cipc_layer_stiffness(double stiffness, int layer);
/* h(l) = gamma 2/omega(l), omega(l)^2 = 2 r(l)/m: the stable step of a layer between primitives whose lightest node that can move weighs m. */
double cipc_layer_step(double stiffness, double mass, double factor, int layer);
/* How many layers act at a gap: the l with eta(l) > gap; INT_MAX if more than that. */
int cipc_layer_count(double thickness, double gap);
/* sum over l of 1/2 r(l) (eta(l) - gap)_+^2, J. */
double cipc_layer_energy(double thickness, double stiffness, double gap);

/* ---- The integrator --------------------------------------------------------------------------------------------------------------------- */

/* Which clock a force inside a body gets: one with its own stable step, or the longest of frame / 2^k that is not longer, so that like forces tick together. */
typedef enum cipc_clocks { CIPC_CLOCKS_NESTED = 0, CIPC_CLOCKS_OWN } cipc_clocks;

typedef struct cipc_asynchronous_options {
    double frame;           /* s: what one cipc_asynchronous_step advances */
    double thickness;       /* eta(1), m: distance less thickness at which contact sets on */
    double stiffness;       /* r(1), N/m; 0: by rule, so that the mean free node rests at a twentieth of eta(1) */
    double layer_factor;    /* gamma of the layers, in (0, 1] (F2: 0.025 for energy nearly conserved) */
    double element_factor;  /* gamma of the forces inside bodies, in (0, 1] */
    double gravity_step;    /* s: of gravity and loads; 0: frame / 16 */
    double script_step;     /* s: between changes of prescribed velocities; 0: frame */
    double restitution;     /* e in [0, 1]: relative speed after by before an impact (SPEC A.8, F3) */
    cipc_clocks clocks;
    long event_limit;       /* ticks and certificates in one step, beyond which it counts as stalled */
    int always_layers;      /* 0; else the reference without culling: every pair that meets ticks in layers 1..always_layers at all times */
    double mirror;          /* 0; else clocks run backwards from mirror / 2 on: ticks at mirror - k h (for tests of reversibility) */
} cipc_asynchronous_options;
/* frame 1/25 s, thickness 1e-3 m, layer_factor .025, element_factor .5, restitution 0, event_limit 200 million, nested clocks. */
cipc_asynchronous_options cipc_asynchronous_options_default(void);

#define CIPC_EVENTS(X) X(SCRIPT, "script") X(GRAVITY, "gravity") X(STRETCHING, "stretching") X(BENDING, "bending") X(VOLUME, "volume") \
    X(PENALTY, "penalty") X(IDLE, "idle_penalty") X(SLAB, "slab") X(CELL, "cell")
/* Idle: ticks of an active layer that is out of reach and did nothing. */
typedef enum cipc_event_kind {
#define CIPC_X(name, text) CIPC_EVENT_##name,
    CIPC_EVENTS(CIPC_X)
#undef CIPC_X
    CIPC_EVENT_COUNT
} cipc_event_kind;
const char *cipc_event_name(cipc_event_kind kind);

/* What a step's time is split into: forces inside bodies, gravity and script; layers; slabs that failed; slabs checked because a node's velocity changed; the same
 * two of the k-DOP hierarchy; the monitor; the queue and the rest. */
#define CIPC_ASYNCHRONOUS_PHASES(X) X(INTEGRATION, "integration") X(PENALTY, "penalty") X(SLAB, "slab_processing") X(SLAB_CHECK, "slab_rescheduling") \
    X(CELL, "kdop_processing") X(CELL_CHECK, "kdop_rescheduling") X(MONITOR, "monitor") X(OTHER, "other")
typedef enum cipc_asynchronous_phase {
#define CIPC_X(name, text) CIPC_ASYNCHRONOUS_PHASE_##name,
    CIPC_ASYNCHRONOUS_PHASES(CIPC_X)
#undef CIPC_X
    CIPC_ASYNCHRONOUS_PHASE_COUNT
} cipc_asynchronous_phase;
const char *cipc_asynchronous_phase_name(cipc_asynchronous_phase phase);

/* Quantiles that the distribution of vertex steps is told by: least, 5, 25, 50, 75, 95 %, greatest. */
enum { CIPC_QUANTILES = 7 };
extern const double cipc_quantiles[CIPC_QUANTILES];

/* A pair in contact. */
typedef struct cipc_contact_place {
    int layers;                   /* 0: there is none */
    cipc_pair_kind kind;
    int nodes[4];                 /* unused: -1 */
    double gap;                   /* d - xi, m */
    double step;                  /* s, of its deepest layer */
} cipc_contact_place;

/* What one step did. */
typedef struct cipc_asynchronous_report {
    long events[CIPC_EVENT_COUNT];
    long total_events;
    long activations, deactivations;     /* of layers */
    int contacts, max_contacts;          /* pairs with an active layer: at the end; most at any time */
    int certificates;                    /* pairs that own a slab, at the end */
    int separations;                     /* entries of the separation list, at the end */
    int layers;                          /* deepest layer that was active */
    cipc_contact_place deepest;          /* the pair that was in it, when it was deepest */
    double min_gap;                      /* least d - xi of any tick of a layer, m; INFINITY: none */
    double smallest_step;                /* s: of the clocks that ticked */
    double vertex_steps[CIPC_QUANTILES]; /* s: over the free nodes, mean time between changes of velocity in this step */
    double kinetic, gravitational, elastic, contact; /* J, at the end; velocities as means of those before and after the last kick */
    double seconds[CIPC_ASYNCHRONOUS_PHASE_COUNT];   /* sampled, but for the monitor's */
} cipc_asynchronous_report;

typedef struct cipc_asynchronous cipc_asynchronous;
/* CIPC_E_OUT_OF_RANGE on options out of range; CIPC_E_WRONG_TYPE if the model has what the method does not know: strain limits. The model must outlive it. */
cipc_status cipc_asynchronous_create(cipc_asynchronous **integrator, const cipc_model *model, const cipc_asynchronous_options *options, cipc_error *error);
void cipc_asynchronous_destroy(cipc_asynchronous *integrator);

/* Told of the paths of all nodes, window after window, without gaps: each begins where the last one ended. Returns CIPC_OK to go on; anything else stops the step,
 * which returns it with the error as filled. */
typedef cipc_status cipc_paths_callback(void *context, const cipc_paths *paths, cipc_error *error);
void cipc_asynchronous_set_monitor(cipc_asynchronous *integrator, cipc_paths_callback *callback, void *context);

/* Advance the state by one frame. What the integrator keeps from step to step (layers, certificates) follows from the state alone and does not change the
 * trajectory by a bit: a state that is not the one it left is taken up anew. CIPC_E_NO_PROGRESS: stalled, the error names the deepest pair; *state is as of the
 * instant then reached (its time says which; step is not advanced), and valid. CIPC_E_INITIAL_GAP: pairs too near to start from. */
cipc_status cipc_asynchronous_step(cipc_asynchronous *integrator, cipc_state *state, cipc_asynchronous_report *report, cipc_error *error);

#endif
