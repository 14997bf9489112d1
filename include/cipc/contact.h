/* cipc/contact.h - broad phase, active contact stencils, additive CCD, barrier stiffness, lagged friction.
 * Floor 4. */
#ifndef CIPC_CONTACT_H
#define CIPC_CONTACT_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/energy.h"
#include "cipc/geometry.h"
#include "cipc/model.h"

/* What may touch (SPEC C.4, D.1; docs/theory/contact.md): of pairs that share no node, meet at all (cipc_model_meet) and are not wholly Dirichlet,
 * - every node that is not inside a volume against every triangle,
 * - every edge against every edge,
 * - every node of rods and every particle against every segment: edge-edge leaves out parallel segments, which the mollifier switches off,
 * - every particle against every particle.
 * A list for each cipc_pair_kind; indices into the model's nodes, triangles and edges, the point or the lower index first. */
typedef struct cipc_candidate_list {
    int count, capacity;
    int (*pairs)[2];
} cipc_candidate_list;
typedef struct cipc_candidates {
    cipc_candidate_list lists[CIPC_PAIR_KIND_COUNT];
} cipc_candidates;
long cipc_candidates_count(const cipc_candidates *candidates);
/* The i-th of all: point-triangle pairs first, then edge-edge, point-edge, point-point. */
const int *cipc_candidates_pair(const cipc_candidates *candidates, long index, cipc_pair_kind *kind);
void cipc_candidates_free(cipc_candidates *candidates);

/* Broad phase: box trees over triangles, edges, segments and particles, kept between calls. */
typedef struct cipc_broad_phase cipc_broad_phase;
cipc_status cipc_broad_phase_create(cipc_broad_phase **broad_phase, const cipc_model *model, cipc_error *error);
void cipc_broad_phase_destroy(cipc_broad_phase *broad_phase);
/* A superset of all pairs that come within xi_pair + reach of one another while every node moves on the straight line x + t p,
 * t in [0, t_max]; p may be NULL (no motion). is_dirichlet (may be NULL): pairs of four Dirichlet nodes are skipped.
 * The order of the answer depends on the model and the positions only, never on `threads`. */
cipc_status cipc_broad_phase_find(cipc_broad_phase *broad_phase, const cipc_model *model, const double *x, const double *p, double t_max,
                                  double reach, const bool *is_dirichlet, int threads, cipc_candidates *candidates, cipc_error *error);

/* One active contact: a stencil of `count` global nodes with its barrier parameters. */
typedef struct cipc_contact {
    cipc_energy_id energy;       /* CIPC_ENERGY_BARRIER_... */
    int count;                   /* 2, 3, 4 */
    int nodes[4];                /* unused: -1 */
    cipc_contact_barrier barrier;
    int multiplicity;            /* how many primitive pairs it stands for */
} cipc_contact;

typedef struct cipc_contact_set {
    int count, capacity;
    cipc_contact *contacts;      /* in a fixed order */
    int total_multiplicity;
    double min_gap;              /* min over the set of d - xi, m; INFINITY if empty */
    int min_gap_contact;         /* index, or -1 */
} cipc_contact_set;
void cipc_contact_set_free(cipc_contact_set *set);
/* d - xi of a contact at positions x of the whole model, m. */
double cipc_contact_gap(const cipc_contact *contact, const double *x);

typedef struct cipc_contact_options {
    double dhat;                 /* m */
    bool area_weights;           /* weight = area of the primitive / mean area (dimensionless); false: 1 (as the released code) */
    bool merge_directed;         /* merge stencils only if their nodes come in the same order (as the released code: more stencils, same energy) */
} cipc_contact_options;
cipc_contact_options cipc_contact_options_default(void);

/* Active stencils at x among the candidates: d < xi + dhat, classified to closest features, equal point-point and point-edge stencils
 * merged (weights added), near-parallel edge-edge stencils mollified (SPEC D.1-D.3). stiffness goes into each barrier. */
cipc_status cipc_contact_set_build(cipc_contact_set *set, const cipc_model *model, const cipc_candidates *candidates, const double *x,
                                   double stiffness, const cipc_contact_options *options, int threads, cipc_error *error);

/* Continuous collision detection of one pair: how far may the stencil go along its path? */
typedef enum cipc_ccd_method {
    CIPC_CCD_CERTIFIED = 0, /* additive CCD, conservative in double arithmetic by construction, MPFR where doubles do not suffice (SPEC V.4) */
    CIPC_CCD_ADDITIVE,      /* additive CCD as in the paper (SPEC C.5, Algorithm 1): the readable form, not conservative under rounding */
    CIPC_CCD_CUBIC,         /* roots of the coplanarity cubic in floating point (GSL): the baseline that the paper shows failing; ignores thickness */
    CIPC_CCD_MINIMUM_SEPARATION /* floating-point roots with a minimum separation, by the conservative strategy of the IPC codes: the baseline with thickness */
} cipc_ccd_method;
typedef struct cipc_ccd_options {
    cipc_ccd_method method;
    double slackness;   /* s */
    int max_iterations;
    bool gap_first;     /* additive only: the paper's order of tests, with its early hits just beyond t_max (as the released code) */
    bool refine;        /* certified only: go on beyond the target gap s (d - xi) while that is cheap, to tell early hits from true ones */
} cipc_ccd_options;
cipc_ccd_options cipc_ccd_options_default(void);
typedef enum cipc_ccd_outcome {
    CIPC_CCD_FREE = 0,       /* no contact on [0, t_max]; toi = t_max */
    CIPC_CCD_HIT,            /* stopped before contact, or before a gap below s (d - xi); toi in (0, t_max] */
    CIPC_CCD_INITIALLY_CLOSE,/* d <= xi at the start; toi = 0 */
    CIPC_CCD_INDETERMINATE   /* the caps of iterations and precision were met; toi = last certified time */
} cipc_ccd_outcome;
typedef struct cipc_ccd_result {
    double toi;
    bool hit; /* outcome is not CIPC_CCD_FREE */
    int iterations;
    bool capped;
    cipc_ccd_outcome outcome;
    int precision; /* bits of the arithmetic that the answer was found in: 53 for doubles */
} cipc_ccd_result;
/* x[n], p[n]: the stencil's positions and displacements. thickness xi >= 0, slackness s in (0,1), t_max in (0,1]. */
cipc_ccd_result cipc_additive_ccd(cipc_pair_kind kind, const double *x, const double *p, double thickness, double t_max,
                                  const cipc_ccd_options *options);
/* For every path: exact distance > thickness on all of [0, toi] (unless initially close), toi > 0 unless initially close (docs/theory/certified_ccd.md). */
cipc_ccd_result cipc_certified_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);
cipc_ccd_result cipc_cubic_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);
/* docs/theory/minimum_separation_ccd.md: nothing is promised. iterations: how often roots were looked for. */
cipc_ccd_result cipc_minimum_separation_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);
/* By options->method. */
cipc_ccd_result cipc_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);

/* What cipc_candidates_ccd asks of the i-th candidate on the path x + t p, t in [0, t_max]: the path of its stencil (displacements as in p, not cut at t_max) and its
 * thickness. False: nothing, because the boxes of the two paths stay apart by more than that. */
bool cipc_candidates_query(const cipc_model *model, const cipc_candidates *candidates, long index, const double *x, const double *p, double t_max,
                           const cipc_ccd_options *options, cipc_stencil_path *path, double *thickness);

/* The smallest step of cipc_ccd over all candidates on the path x + t p, t in [0, t_max]; the limiting stencil's nodes and kind in
 * *nodes and *kind (may be NULL; nodes -1 if nothing limits). Thickness is each pair's xi. */
double cipc_candidates_ccd(const cipc_model *model, const cipc_candidates *candidates, const double *x, const double *p, double t_max,
                           const cipc_ccd_options *options, int threads, int nodes[4], cipc_pair_kind *kind);

/* Barrier stiffness of SPEC D.4 (bounding-box rule) or C.7 (as released). */
typedef struct cipc_stiffness_range { double minimum, maximum; } cipc_stiffness_range;
cipc_stiffness_range cipc_barrier_stiffness_range(double bounding_box_diagonal, double mean_mass, double offset, double dhat);
cipc_stiffness_range cipc_barrier_stiffness_range_released(double mean_mass, double dhat);

/* Lagged friction of a contact at x (= x^n): fills *friction and returns true; false for mollified stencils, zero coefficient or zero
 * normal force (SPEC D.6). mu is the pair's coefficient; eps = eps_v h. x and start are whole-model arrays. */
bool cipc_friction_from_contact(cipc_friction *friction, const cipc_contact *contact, const double *x, const double *start, double mu, double eps);

#endif
