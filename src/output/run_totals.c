/* Totals of a run, step by step. */
#include "cipc/output.h"
#include "output/particle_nodes.h"

#include <math.h>

cipc_run_summary cipc_run_summary_default(void)
{
    cipc_run_summary summary = {0};
    summary.resumed_from = -1;
    summary.converged = true;
    summary.monitored = true;
    summary.min_gap = INFINITY;
    summary.asynchronous.min_gap = summary.asynchronous.smallest_step = INFINITY;
    return summary;
}

void cipc_run_summary_of_model(cipc_run_summary *summary, const cipc_model *model)
{
    summary->bodies = model->body_count;
    summary->nodes = model->node_count;
    summary->triangles = model->triangle_count;
    summary->segments = model->segment_count;
    summary->particles = cipc_particle_count(model);
    summary->tetrahedra = model->tetrahedron_count;
}

static void add_invariants(cipc_run_summary *summary, const cipc_step_invariants *invariants)
{
    if (invariants == NULL) {
        summary->monitored = false;
        return;
    }
    summary->points_checked += invariants->points;
    summary->windows_checked += invariants->windows;
    summary->energy_checks += invariants->energy_checks;
    summary->momentum_checks += invariants->momentum_checks;
    summary->max_momentum_change = fmax(summary->max_momentum_change, invariants->momentum_change);
    summary->min_gap = fmin(summary->min_gap, invariants->worst.min_gap);
    summary->max_stretch = fmax(summary->max_stretch, invariants->worst.max_stretch);
    summary->max_stretch_ratio = fmax(summary->max_stretch_ratio, invariants->worst.max_stretch_ratio);
    summary->max_segment_stretch = fmax(summary->max_segment_stretch, invariants->max_segment_stretch);
    summary->exact_gap_checks += invariants->worst.exact_gap_checks;
    summary->exact_strain_checks += invariants->worst.exact_strain_checks;
    summary->exact_path_checks += invariants->worst.exact_path_checks;
    summary->paths_checked += invariants->worst.paths_checked;
}

void cipc_run_summary_add(cipc_run_summary *summary, const cipc_step_report *report, const cipc_step_invariants *invariants)
{
    summary->converged = summary->converged && report->converged;
    summary->newton_iterations += report->newton_iterations;
    summary->line_search_halvings += report->line_search_halvings;
    summary->friction_passes += report->friction_passes;
    summary->symbolic_analyses += report->symbolic_analyses;
    summary->factorizations += report->factorizations;
    summary->max_contacts = report->max_contacts > summary->max_contacts ? report->max_contacts : summary->max_contacts;
    if (report->newton_iterations > summary->max_newton_iterations) {
        summary->max_newton_iterations = report->newton_iterations;
    }
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        summary->seconds_by_phase[i] += report->seconds[i];
    }
    add_invariants(summary, invariants);
}

void cipc_asynchronous_summary_add(cipc_run_summary *summary, const cipc_asynchronous_report *report, const cipc_step_invariants *invariants)
{
    cipc_asynchronous_totals *totals = &summary->asynchronous;
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) {
        totals->events[k] += report->events[k];
    }
    totals->total_events += report->total_events;
    totals->max_events = report->total_events > totals->max_events ? report->total_events : totals->max_events;
    totals->activations += report->activations;
    totals->deactivations += report->deactivations;
    if (report->layers > totals->layers) { /* of equally deep ones the first */
        totals->layers = report->layers;
        totals->deepest = report->deepest;
    }
    totals->min_gap = fmin(totals->min_gap, report->min_gap);
    totals->smallest_step = fmin(totals->smallest_step, report->smallest_step);
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) {
        totals->seconds[i] += report->seconds[i];
    }
    summary->max_contacts = report->max_contacts > summary->max_contacts ? report->max_contacts : summary->max_contacts;
    add_invariants(summary, invariants);
}

/* Steps are counted as frames are: every one is looked at, or none. */
static void count_frame(cipc_counted *counted, bool broken, long frame)
{
    if (broken && counted->frames++ == 0) {
        counted->first_step = (int)frame;
    }
}

void cipc_massspring_summary_add(cipc_run_summary *summary, const cipc_massspring_report *report, const cipc_massspring_times *times, const cipc_step_invariants *invariants)
{
    cipc_massspring_totals *totals = &summary->massspring;
    totals->substeps += report->substeps;
    totals->hits += report->hits;
    totals->arrivals += report->arrivals;
    totals->iterations += report->iterations;
    totals->sweeps += report->sweeps;
    totals->beyond_bound += report->beyond_bound;
    totals->reversals += report->reversals;
    totals->max_self_contacts = report->self_contacts > totals->max_self_contacts ? report->self_contacts : totals->max_self_contacts;
    totals->max_inside = report->inside > totals->max_inside ? report->inside : totals->max_inside;
    totals->max_deformation = fmax(totals->max_deformation, report->deformation);
    totals->frame_seconds += times->frame;
    totals->step_seconds += times->step;
    totals->monitor_seconds += times->monitor;
    summary->max_contacts = report->contacts > summary->max_contacts ? report->contacts : summary->max_contacts;
    add_invariants(summary, invariants);
    if (invariants != NULL && invariants->counted) {
        totals->frames++;
        count_frame(&totals->intersecting, invariants->intersects, totals->frames);
        count_frame(&totals->too_near, invariants->too_near, totals->frames);
    }
}
