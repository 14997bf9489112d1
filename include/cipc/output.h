/* cipc/output.h - what a run writes: HDF5 + XDMF trajectory, OBJ, statistics, summary, progress line, pictures.
 * Floor 7. Formats, field by field with units, in docs/formats.md. */
#ifndef CIPC_OUTPUT_H
#define CIPC_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include "cipc/asynchronous.h"
#include "cipc/base.h"
#include "cipc/implicit.h"
#include "cipc/invariant.h"
#include "cipc/massspring.h"
#include "cipc/model.h"

/* ---- Trajectory (HDF5) ---------------------------------------------------------------------------------------------------
 * Topology once, then positions, velocities and scalars frame by frame. A published file is whole at every instant: room for the
 * coming frames is set aside when it is created, an append writes into that room and raises the counter `frames` last, and
 * nothing else of the file ever changes. So it can be read while the run goes on, and after a kill at any instruction. */
typedef struct cipc_trajectory cipc_trajectory;

/* A new file with frame 0 = *state. It is made under a temporary name and renamed: an older file of that name is replaced by a whole
 * one or not at all. `room` is the number of frames to set room aside for (a hint: more can be appended at the price of a copy). */
cipc_status cipc_trajectory_create(cipc_trajectory **trajectory, const char *path, const cipc_model *model, const cipc_state *state,
                                   const char *scene_json, int room, cipc_error *error);

/* Open to append after the last whole frame, which is read into *state (arrays of the model's node count). Errors: CIPC_E_MISSING_FILE;
 * CIPC_E_NOT_RESUMABLE if the file is damaged, of an older format, or belongs to another model or scene. Of the scene, members that do not change the
 * trajectory may differ: title, comment, size, sizes, steps, monitor, output. */
cipc_status cipc_trajectory_resume(cipc_trajectory **trajectory, const char *path, const cipc_model *model, cipc_state *state,
                                   const char *scene_json, int room, cipc_error *error);

cipc_status cipc_trajectory_append(cipc_trajectory *trajectory, const cipc_state *state, cipc_error *error);
int cipc_trajectory_frames(const cipc_trajectory *trajectory);

/* Give back the room that is left (by writing a file without it and renaming) and free; NULL is fine. */
cipc_status cipc_trajectory_close(cipc_trajectory *trajectory, cipc_error *error);

/* Number of whole frames of a file; the positions (3 * node_count, caller's array) and time of one; all times (caller's array of
 * frame_count). position, time and error may be NULL. Errors: CIPC_E_MISSING_FILE, CIPC_E_IO (damaged, or no such frame). */
cipc_status cipc_trajectory_count(const char *path, int *frames, cipc_error *error);
cipc_status cipc_trajectory_read(const char *path, int frame, double *position, int node_count, double *time, cipc_error *error);
cipc_status cipc_trajectory_times(const char *path, double *times, int frame_count, cipc_error *error);

/* ---- Other files of geometry ---------------------------------------------------------------------------------------------- */

/* XDMF companion for ParaView; h5_name is the file name as XDMF is to name it (relative). Written atomically. times[frame_count]. */
cipc_status cipc_xdmf_write(const char *path, const char *h5_name, const cipc_model *model, int frame_count, const double *times,
                            cipc_error *error);

/* Wavefront OBJ of a state, 17 significant digits, one group per body: faces, lines of segments, points of particles; written atomically. */
cipc_status cipc_obj_write(const char *path, const cipc_model *model, const double *position, cipc_error *error);

/* violation.json: which invariant broke where, and what the monitors reported of the point (report may be NULL). Written atomically. */
cipc_status cipc_violation_write(const char *path, const cipc_accepted_point *point, double time_before,
                                 const cipc_invariant_report *report, const cipc_error *violation, cipc_error *error);
/* The same of the methods that have no accepted points: a window of paths from one time to another, s, or the frame at that time, both the same. */
cipc_status cipc_asynchronous_violation_write(const char *path, int steps_taken, double time_before, const double window[2],
                                              const cipc_invariant_report *report, const cipc_error *violation, cipc_error *error);

/* Any text, written atomically (temporary name, rename). */
cipc_status cipc_text_write(const char *path, const char *text, cipc_error *error);

/* ---- Statistics and summary ----------------------------------------------------------------------------------------------- */

/* What the monitors saw during one step: the worst of all its accepted points. */
typedef struct cipc_step_invariants {
    long points;                    /* accepted points looked at; of the method asynchronous: frames and windows of paths */
    long windows;                   /* of these, windows of paths, which M5 alone looks at (method asynchronous) */
    long energy_checks;             /* of these, points whose energy is comparable with the one before (M6) */
    long momentum_checks;           /* 1: the step's change of momentum was looked at (M7) */
    double momentum_change;         /* kg m/s */
    cipc_invariant_report worst;    /* smallest gap, largest stretch; counters are sums */
    double max_segment_stretch;     /* largest length of a rod's segment by its rest length, in double arithmetic; 0: none */
    bool counted, intersects, too_near; /* of the method mass-spring, which does not guarantee M1 and M2: they have been looked at; the frame breaks them */
} cipc_step_invariants;
cipc_step_invariants cipc_step_invariants_none(void);
/* Take in the report of one more point. */
void cipc_step_invariants_add(cipc_step_invariants *step, const cipc_invariant_report *report);
/* Take in the report of a window of paths. */
void cipc_step_invariants_add_window(cipc_step_invariants *step, const cipc_invariant_report *report);
/* Take in the lengths of the segments at that point, of bodies that are not fixed. */
void cipc_step_invariants_add_segments(cipc_step_invariants *step, const cipc_model *model, const double *position);

/* One line of stats.jsonl, flushed: the step that led to *state. invariants may be NULL (monitors off): its fields are then null. */
cipc_status cipc_stats_write(FILE *file, const cipc_state *state, const cipc_step_report *report, const cipc_step_invariants *invariants,
                             cipc_error *error);

/* The same of the method asynchronous. */
cipc_status cipc_asynchronous_stats_write(FILE *file, const cipc_state *state, const cipc_asynchronous_report *report,
                                          const cipc_step_invariants *invariants, cipc_error *error);
/* The same of the method mass-spring. */
typedef struct cipc_massspring_times { double frame, step, monitor; } cipc_massspring_times; /* s: simulated; of wall clock, of the step and of the monitors */
cipc_status cipc_massspring_stats_write(FILE *file, const cipc_state *state, const cipc_massspring_report *report, const cipc_massspring_times *times,
                                        const cipc_step_invariants *invariants, cipc_error *error);
/* The keys of the quantiles of vertex steps: "min", "p5", "p25", "median", "p75", "p95", "max". */
extern const char *const cipc_quantile_names[CIPC_QUANTILES];

/* Totals that only the method asynchronous has. */
typedef struct cipc_asynchronous_totals {
    long events[CIPC_EVENT_COUNT], total_events;
    long max_events;                /* of a step */
    long activations, deactivations;
    int layers;                     /* deepest that was active */
    cipc_contact_place deepest;     /* the pair that was in it */
    double min_gap;                 /* m, at any tick of a layer; INFINITY: none */
    double smallest_step;           /* s; INFINITY: nothing ticked */
    double seconds[CIPC_ASYNCHRONOUS_PHASE_COUNT];
} cipc_asynchronous_totals;

/* Frames that break an invariant which the method mass-spring does not guarantee. The monitors stop at the first pair: so frames are counted, not pairs. */
typedef struct cipc_counted {
    long frames;
    int first_step;                 /* that led to the first of them; 0: none */
    cipc_error first;               /* what the monitor said of it; "" after reading statistics back, which do not have it */
} cipc_counted;

/* Totals that only the method mass-spring has. */
typedef struct cipc_massspring_totals {
    long frames;                    /* that the monitors looked at */
    cipc_counted intersecting, too_near; /* M1, M2 */
    long substeps, hits, arrivals, iterations, sweeps, beyond_bound, reversals;
    int max_self_contacts, max_inside;
    double max_deformation;         /* B */
    double frame_seconds, step_seconds, monitor_seconds; /* s: simulated; of wall clock */
} cipc_massspring_totals;

/* Totals of a run. */
typedef struct cipc_run_summary {
    cipc_method method;
    const char *scene_path;
    const char *scene_size;
    const char *scene_name;
    const char *command;            /* the words of the command line, or NULL */
    int steps_asked, steps_taken;
    int resumed_from;               /* step that this process went on from; -1: it began at step 0 */
    double time;                    /* s, simulated */
    bool converged;                 /* every step */
    bool interrupted;               /* by a signal */
    bool monitored;                 /* every step */
    bool swept;                     /* the paths between accepted points too (M5) */
    int limited_triangles;          /* of bodies with a strain limit: M3 has something to look at */
    int bodies, nodes, triangles, segments, particles; /* of the model */
    int tetrahedra;                 /* likewise; M4 has something to look at */
    const char *momentum_source;    /* why M7 has nothing to say, or NULL */
    int bodies_apart;               /* pairs of bodies that the scene lets pass through each other */
    int stitches;
    long points_checked;            /* accepted line-search points that the monitors looked at; of the other methods: frames and windows of paths */
    long windows_checked;           /* of these, windows of paths */
    long energy_checks;             /* of these, points of which M6 could be checked */
    long momentum_checks;           /* steps of which M7 was */
    double max_momentum_change;     /* kg m/s, in such a step */
    long newton_iterations, line_search_halvings, friction_passes, symbolic_analyses, factorizations;
    int max_contacts, max_newton_iterations;
    double min_gap, max_stretch, max_stretch_ratio, max_segment_stretch;
    long exact_gap_checks, exact_strain_checks, exact_path_checks, paths_checked;
    double seconds;                 /* of wall clock, in all */
    double output_seconds, seconds_by_phase[CIPC_PHASE_COUNT];
    cipc_asynchronous_totals asynchronous;
    cipc_massspring_totals massspring;
    long peak_memory_kb;
    int threads;
    unsigned long seed;
    cipc_status status;             /* how the run ended */
    const cipc_error *error;        /* NULL if it ended well */
} cipc_run_summary;
/* Zeroes, with the extremes (min_gap INFINITY, resumed_from -1) where an empty run has them. */
cipc_run_summary cipc_run_summary_default(void);
/* The counts of the model. */
void cipc_run_summary_of_model(cipc_run_summary *summary, const cipc_model *model);
/* Add what one step did; invariants NULL: not monitored. */
void cipc_run_summary_add(cipc_run_summary *summary, const cipc_step_report *report, const cipc_step_invariants *invariants);
/* The same of the method asynchronous. */
void cipc_asynchronous_summary_add(cipc_run_summary *summary, const cipc_asynchronous_report *report, const cipc_step_invariants *invariants);
/* The same of the method mass-spring. */
void cipc_massspring_summary_add(cipc_run_summary *summary, const cipc_massspring_report *report, const cipc_massspring_times *times, const cipc_step_invariants *invariants);

/* The verdict on an invariant, 1..8 for M1..M8: "holds", "violated", "counted" (M1 and M2 of the method mass-spring) or "not checked". The files add counts and reasons. */
const char *cipc_run_summary_verdict(const cipc_run_summary *summary, int invariant);

/* summary.json, written atomically. */
cipc_status cipc_summary_write(const char *path, const cipc_run_summary *summary, cipc_error *error);

/* The same verdicts as JUnit XML, written atomically: a case for the steps and one for each of M1..M8; failures with place and remedy, those not checked with the
 * reason. */
cipc_status cipc_summary_junit(const char *path, const cipc_run_summary *summary, cipc_error *error);

/* Cut stats.jsonl after the line of `step` (atomically) and add what the lines kept say to *summary, so that the summary of a resumed run
 * is that of the whole run. CIPC_E_NOT_RESUMABLE if a line is missing; a broken last line is one beyond the cut. */
cipc_status cipc_stats_resume(const char *path, int step, cipc_run_summary *summary, cipc_error *error);

/* ---- Recorded CCD queries ------------------------------------------------------------------------------------------------- */

/* A sample of what a run asks of continuous collision detection, as queries of the conformance protocol (docs/formats.md, docs/conformance.md). Every query has an
 * ordinal, by which it is kept or not: all of them as long as `limit` suffices, then half, a quarter and so on, spread over the whole run. So the sample depends neither
 * on the number of threads nor on anything random. */
typedef struct cipc_ccd_record cipc_ccd_record;
/* Reserves memory for limit >= 1 queries (some 220 bytes each) and path.partial. CIPC_E_IO: the path is a folder, or cannot be written to; CIPC_E_OUT_OF_MEMORY. The
 * model must outlive the record. */
cipc_status cipc_ccd_record_open(cipc_ccd_record **record, const char *path, const cipc_model *model, long limit, cipc_error *error);
/* A cipc_ccd_watch; context is the record. */
void cipc_ccd_record_search(void *context, const cipc_ccd_search *search);
long cipc_ccd_record_count(const cipc_ccd_record *record);
/* Write the file, atomically, and free. NULL is fine. */
cipc_status cipc_ccd_record_close(cipc_ccd_record *record, cipc_error *error);
/* Free without writing anything; an older file of that name stays. NULL is fine. */
void cipc_ccd_record_discard(cipc_ccd_record *record);

/* The progress line of the method asynchronous: step, simulated time, events, deepest layer and contacts of the step, its smallest clock, minimum gap, time left. */
void cipc_asynchronous_progress_line(FILE *terminal, int step, int steps, double time, const cipc_asynchronous_report *report, double min_gap, double seconds_left);
/* That of the method mass-spring: step, simulated time, substeps, contacts, hits, deformation, simulated by real time, time left. */
void cipc_massspring_progress_line(FILE *terminal, int step, int steps, double time, const cipc_massspring_report *report, const cipc_massspring_times *times, double seconds_left);
/* Progress line on a terminal: step, simulated time, Newton iterations, contacts, minimum gap, largest stretch, time left. */
void cipc_progress_line(FILE *terminal, int step, int steps, double time, int newton_iterations, int contacts, double min_gap,
                        double max_stretch, double seconds_left);
/* Wipe it. */
void cipc_progress_clear(FILE *terminal);

/* ---- Pictures ------------------------------------------------------------------------------------------------------------- */

/* Contact sheet of shaded frames, evenly chosen from the trajectory (first and last included), with time labels. Angles in radians:
 * azimuth 0 looks along -z, positive turns the eye towards +x; elevation positive looks down. zoom 1 fits all moving bodies. */
typedef struct cipc_picture_options {
    int columns, rows, tile_width, tile_height; /* tiles; pixels */
    double azimuth, elevation, zoom;
    const bool *subject;                        /* of each body: is the picture about it? NULL: about those that move */
} cipc_picture_options;
cipc_picture_options cipc_picture_options_default(void);
cipc_status cipc_frames_png(const char *path, const char *trajectory_path, const cipc_model *model, const cipc_picture_options *options,
                            cipc_error *error);

/* Four plots over time from stats.jsonl: gap minus thickness (log), largest stretch of triangles against its limit (0: none) and of
 * segments, energies, Newton iterations. */
cipc_status cipc_plots_png(const char *path, const char *stats_path, double strain_limit, double dhat, cipc_error *error);
/* Six plots of the method asynchronous: gap with the layers' thickness, largest stretch, energies; the distribution of vertex steps (log), events per step, deepest layer. */
cipc_status cipc_asynchronous_plots_png(const char *path, const char *stats_path, double thickness, cipc_error *error);
/* Four plots of the method mass-spring: deformation B with its bound (0: none), contacts, energies, evaluations of bisection per arrival. */
cipc_status cipc_massspring_plots_png(const char *path, const char *stats_path, double bound, cipc_error *error);

#endif
