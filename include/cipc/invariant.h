/* cipc/invariant.h - the monitors: what must hold at every accepted line-search point, checked without any code of the solver. Floor 6.
 * Of the solver's floors they use the model's structs and the exact predicates only: no distance, barrier or CCD code, no active set, a
 * broad phase of their own (SPEC V.5). What each monitor proves, and what it does not: docs/monitors.md.
 *
 * Which pairs meet: every node that is not inside a volume and every triangle; every two edges; every node of a rod or particle and every
 * segment; every two particles. Left out are pairs that share a node or have nodes sewn to each other, and pairs of bodies that the scene
 * lets pass (cipc_model_meet). M1 looks at every edge and every triangle, with the same exceptions. */
#ifndef CIPC_INVARIANT_H
#define CIPC_INVARIANT_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/model.h"

/* What one look at a state found. Everything but lists_made depends on the positions only, neither on the number of threads nor on
 * earlier looks (the counts exact_*, pairs_checked and crossings_checked: except for pairs so degenerate that the filter cannot measure
 * them; paths_checked and exact_path_checks: the lists of an earlier look are used where they serve). */
typedef struct cipc_invariant_report {
    double min_gap;       /* min over pairs within reach of d - xi, m: the exact minimum, rounded to nearest; INFINITY: none within reach */
    int min_gap_nodes[4]; /* the pair: -1 for unused; point first, or edge a then edge b. Of pairs with the same rounded gap the first */
    cipc_pair_kind min_gap_kind; /* what it is, if there is one */
    double max_stretch; /* largest principal stretch over all triangles of bodies that have a membrane or a limit: of the triangle that double
                         * arithmetic finds to be stretched most, the exact value rounded upwards */
    int max_stretch_triangle;                   /* -1: none */
    double max_stretch_ratio;                   /* of all strain limits the largest fraction that is used: (sigma_1 - 1)/(s - 1),
                                                 * (1 - sigma_2)/(1 - s) of lower limits, |E|/L of woven cloth; likewise; 0 if none or below 0 */
    long exact_gap_checks, exact_strain_checks; /* how often the filter had to hand over to exact arithmetic */
    long pairs_checked;                         /* pairs of all kinds with d - xi <= reach */
    long crossings_checked; /* edge-triangle pairs that no separating plane was found for: decided by the exact predicate */
    long paths_checked;     /* M5: pairs of all kinds whose paths were looked at */
    long exact_path_checks; /* of those, how many no fixed direction separates, on some piece of paths with breaks: decided by the exact time of impact */
    bool lists_made;        /* the lists of candidate pairs were made anew at this look */
} cipc_invariant_report;

typedef struct cipc_invariant_options {
    double reach;           /* m, >= 0: pairs with d - xi <= reach are measured for min_gap (those with d <= xi always are) */
    int threads;            /* >= 1 */
    bool allow_fixed_fixed; /* pairs of nodes that are all in fixed bodies are not checked (obstacles may interpenetrate): default true */
    double margin;          /* m, >= 0: lists of candidates reach this much further, and serve until a node has moved more than half of it;
                                * 0: made anew whenever a node has moved. Affects speed only */
} cipc_invariant_options;
/* reach 1e-3 m, 1 thread, fixed-fixed pairs not checked, margin 1e-3 m. */
cipc_invariant_options cipc_invariant_options_default(void);

/* The model must outlive the monitor. Not thread-safe: one monitor serves one caller (it works in threads by itself). options NULL: the
 * defaults. CIPC_E_OUT_OF_MEMORY; CIPC_E_OUT_OF_RANGE on options out of range. */
typedef struct cipc_monitor cipc_monitor;
cipc_status cipc_monitor_create(cipc_monitor **monitor, const cipc_model *model, const cipc_invariant_options *options, cipc_error *error);
void cipc_monitor_destroy(cipc_monitor *monitor);

/* M8, M1, M2, M3, M4 on positions x[3 * node_count], in this order (M8 first: nothing else means anything on NaN). CIPC_OK, or
 * CIPC_E_VIOLATED_* with the pair, its nodes, bodies, values and thresholds in decimal and hexadecimal in error->what; or
 * CIPC_E_OUT_OF_MEMORY. *report (may be NULL) is filled as far as it got. */
cipc_status cipc_monitor_check(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error);

/* The monitors one by one, same contract; each fills its own fields of *report and leaves the others as they are. */
void cipc_invariant_report_init(cipc_invariant_report *report);                               /* nothing seen yet */
cipc_status cipc_monitor_finite(const cipc_model *model, const double *x, cipc_error *error); /* M8 */
cipc_status cipc_monitor_intersection(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error); /* M1 */
cipc_status cipc_monitor_gap(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error);          /* M2 */
cipc_status cipc_monitor_strain(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error);       /* M3 */
/* How many triangles M3 has something to say about. */
int cipc_invariant_limited_triangles(const cipc_model *model);
cipc_status cipc_monitor_inversion(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error);    /* M4 */

/* M5, separately, because it takes two states: along the straight path of every node from x_from to x_to (both [3 * node_count]) no pair that meets comes
 * to its xi or below. Decided exactly. CIPC_E_VIOLATED_SWEPT; CIPC_E_VIOLATED_FINITE; CIPC_E_INDETERMINATE; fills report->paths_checked and
 * exact_path_checks. */
cipc_status cipc_monitor_swept(cipc_monitor *monitor, const double *x_from, const double *x_to, cipc_invariant_report *report, cipc_error *error);

/* M5 for paths with breaks: along the straight pieces that `paths` says, each node's from one of its own breaks to the next, no pair that meets comes to its xi or
 * below. Decided exactly: of the paths as they are, with the places of nodes between their breaks as the ratios that they are. CIPC_E_VIOLATED_SWEPT, with the time
 * in seconds, a lower bound of the first of the pair named; CIPC_E_VIOLATED_FINITE also on times that are not finite; CIPC_E_INDETERMINATE; CIPC_E_OUT_OF_RANGE on
 * times out of order or outside of begin and end, on another number of nodes than the model's, and where a node would be at two places at one time;
 * CIPC_E_OUT_OF_MEMORY. Fills report->paths_checked and exact_path_checks. */
cipc_status cipc_monitor_paths(cipc_monitor *monitor, const cipc_paths *paths, cipc_invariant_report *report, cipc_error *error);

/* M6: energy decrease between consecutive accepted points, and the residual at convergence. `noise` >= 0 is the caller's derived bound on
 * the rounding error of the difference of the two energies: after - before <= noise, decided exactly. Non-finite numbers violate. */
cipc_status cipc_monitor_energy(double before, double after, double noise, cipc_error *error);
/* 0 <= residual <= tolerance. */
cipc_status cipc_monitor_residual(double residual, double tolerance, cipc_error *error);

/* M7: total linear momentum from step to step. What of the model changes it: "gravity", "Dirichlet nodes", "mass damping", "loads"; NULL: nothing,
 * it is conserved. */
const char *cipc_momentum_source(const cipc_model *model);
/* How a step was solved: its Newton steps p ended with |p|/h <= tolerance, and v' = (x' - x)/(beta h) + ... */
typedef struct cipc_momentum_rule {
    double tolerance;   /* m/s */
    bool rms;           /* |p| is the root mean square over the nodes; false: the largest */
    double time_step;   /* h, s */
    double beta;        /* 1: implicit Euler */
    int minimisations;  /* one after another in a step, each of them to the tolerance */
} cipc_momentum_rule;
/* By how much it may change in a step that ends at x, kg m/s (docs/monitors.md, "The momentum bound"). */
double cipc_momentum_bound(const cipc_model *model, const double *x, const cipc_momentum_rule *rule);
/* The same of a step that is made of kicks, each of which adds opposite impulses to the up to four nodes of one element or pair: what rounding may lose. energy: the largest
 * that is known of the step, without the gravitational one, J (docs/monitors.md, "The momentum bound of kicks"). */
double cipc_momentum_rounding(const cipc_model *model, const double *v_before, const double *v_after, long kicks, double energy);
/* |sum m v_after - sum m v_before| <= bound, but for the rounding of the sums themselves, which are twofold; velocities [3 * node_count] are
 * finite or it is violated. *change: the left-hand side, kg m/s. CIPC_E_VIOLATED_MOMENTUM; CIPC_E_OUT_OF_RANGE on a bad bound. */
cipc_status cipc_monitor_momentum(const cipc_model *model, const double *v_before, const double *v_after, double bound, double *change,
                                  cipc_error *error);

#endif
