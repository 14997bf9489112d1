/* summary.json: what a run did and what may be claimed of it. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "output/particle_nodes.h"
#include "base/json_number.h"
#include "output/versions.h"

#include <math.h>

cipc_run_summary cipc_run_summary_default(void)
{
    cipc_run_summary summary = {0};
    summary.resumed_from = -1;
    summary.converged = true;
    summary.monitored = true;
    summary.min_gap = INFINITY;
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
    if (invariants == NULL) {
        summary->monitored = false;
        return;
    }
    summary->points_checked += invariants->points;
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

enum { INVARIANT_COUNT = 8 };

/* At a point the monitors look in this order and stop at the first violation; M7 looks at whole steps, when all is over. */
static const int turn[INVARIANT_COUNT + 1] = {[6] = 1, [8] = 2, [1] = 3, [2] = 4, [3] = 5, [4] = 6, [5] = 7, [7] = 8};

static int violated_invariant(cipc_status status)
{
    switch (status) {
    case CIPC_E_VIOLATED_INTERSECTION: return 1;
    case CIPC_E_VIOLATED_GAP: return 2;
    case CIPC_E_VIOLATED_STRAIN: return 3;
    case CIPC_E_VIOLATED_INVERSION: return 4;
    case CIPC_E_VIOLATED_SWEPT: return 5;
    case CIPC_E_VIOLATED_ENERGY: return 6;
    case CIPC_E_VIOLATED_MOMENTUM: return 7;
    case CIPC_E_VIOLATED_FINITE: return 8;
    default: return 0;
    }
}

/* Number of points, or steps, that the monitor has looked at and let pass. */
static long points_passed(const cipc_run_summary *summary, int invariant)
{
    const int violated = violated_invariant(summary->status);
    /* Of the last point, the monitors whose turn comes after the violated one know nothing. */
    const long unseen = turn[violated] != 0 && turn[invariant] > turn[violated] ? 1 : 0;
    if (invariant == 6) {
        return summary->energy_checks - unseen;
    }
    if (invariant == 7) {
        return summary->momentum_checks;
    }
    if ((invariant == 3 && summary->limited_triangles == 0) || (invariant == 4 && summary->tetrahedra == 0) || (invariant == 5 && !summary->swept)) {
        return 0;
    }
    return summary->points_checked - unseen;
}

const char *cipc_run_summary_verdict(const cipc_run_summary *summary, int invariant)
{
    if (invariant < 1 || invariant > INVARIANT_COUNT) {
        return "not checked";
    }
    if (violated_invariant(summary->status) == invariant) {
        return "violated";
    }
    const bool undecided = summary->status == CIPC_E_INDETERMINATE && invariant < 6;
    return summary->monitored && !undecided && points_passed(summary, invariant) > 0 ? "holds" : "not checked";
}

/* The verdict, and of M7 why there is none. */
static json_t *verdict_text(const cipc_run_summary *summary, int invariant)
{
    const char *verdict = cipc_run_summary_verdict(summary, invariant);
    if (invariant == 7 && summary->monitored && summary->momentum_source != NULL) {
        return json_sprintf("%s: %s", verdict, summary->momentum_source);
    }
    return json_string(verdict);
}

/* ---- The file ------------------------------------------------------------------------------------------------------------- */

/* Also null for a text that is not UTF-8 (a file name may be anything): then say nothing of it rather than nothing at all. */
static json_t *text_or_null(const char *text)
{
    json_t *value = text != NULL ? json_string(text) : NULL;
    return value != NULL ? value : json_null();
}

static json_t *error_object(const cipc_run_summary *summary, bool *good)
{
    if (summary->error == NULL) {
        return json_null();
    }
    json_t *object = json_object();
    cipc_json_put(object, "number", json_integer(summary->error->status), good);
    cipc_json_put(object, "where", text_or_null(summary->error->place), good);
    cipc_json_put(object, "what", text_or_null(summary->error->what), good);
    cipc_json_put(object, "remedy", text_or_null(summary->error->remedy), good);
    return object;
}

static json_t *scene_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "name", text_or_null(summary->scene_name), good);
    cipc_json_put(object, "file", text_or_null(summary->scene_path), good);
    cipc_json_put(object, "size", text_or_null(summary->scene_size), good);
    return object;
}

static json_t *model_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "bodies", json_integer(summary->bodies), good);
    cipc_json_put(object, "nodes", json_integer(summary->nodes), good);
    cipc_json_put(object, "triangles", json_integer(summary->triangles), good);
    cipc_json_put(object, "segments", json_integer(summary->segments), good);
    cipc_json_put(object, "particles", json_integer(summary->particles), good);
    cipc_json_put(object, "tetrahedra", json_integer(summary->tetrahedra), good);
    return object;
}

static json_t *invariants_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    for (int i = 1; i <= INVARIANT_COUNT; i++) {
        char key[16];
        snprintf(key, sizeof key, "M%d", i);
        cipc_json_put(object, key, verdict_text(summary, i), good);
    }
    return object;
}

static json_t *monitors_object(const cipc_run_summary *summary, bool *good)
{
    const double seconds = summary->seconds_by_phase[CIPC_PHASE_MONITOR];
    json_t *object = json_object();
    cipc_json_put(object, "points_checked", json_integer(summary->points_checked), good);
    cipc_json_put(object, "energy_checks", json_integer(summary->energy_checks), good);
    cipc_json_put(object, "momentum_checks", json_integer(summary->momentum_checks), good);
    cipc_json_put(object, "bodies_apart", json_integer(summary->bodies_apart), good);
    cipc_json_put(object, "stitches", json_integer(summary->stitches), good);
    cipc_json_put(object, "exact_gap_checks", json_integer(summary->exact_gap_checks), good);
    cipc_json_put(object, "exact_strain_checks", json_integer(summary->exact_strain_checks), good);
    cipc_json_put(object, "paths_checked", json_integer(summary->paths_checked), good);
    cipc_json_put(object, "exact_path_checks", json_integer(summary->exact_path_checks), good);
    cipc_json_put(object, "seconds", cipc_json_number(seconds), good);
    cipc_json_put(object, "percent", cipc_json_number(summary->seconds > 0 ? 100 * seconds / summary->seconds : 0), good);
    return object;
}

static json_t *extremes_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "min_gap", summary->monitored ? cipc_json_number(summary->min_gap) : json_null(), good);
    cipc_json_put(object, "max_stretch", summary->monitored ? cipc_json_number(summary->max_stretch) : json_null(), good);
    cipc_json_put(object, "max_stretch_ratio", summary->monitored ? cipc_json_number(summary->max_stretch_ratio) : json_null(), good);
    cipc_json_put(object, "max_segment_stretch", summary->monitored ? cipc_json_number(summary->max_segment_stretch) : json_null(), good);
    cipc_json_put(object, "max_momentum_change", summary->momentum_checks > 0 ? cipc_json_number(summary->max_momentum_change) : json_null(), good);
    cipc_json_put(object, "max_contacts", json_integer(summary->max_contacts), good);
    cipc_json_put(object, "max_newton_iterations", json_integer(summary->max_newton_iterations), good);
    return object;
}

static json_t *totals_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "newton_iterations", json_integer(summary->newton_iterations), good);
    cipc_json_put(object, "line_search_halvings", json_integer(summary->line_search_halvings), good);
    cipc_json_put(object, "friction_passes", json_integer(summary->friction_passes), good);
    cipc_json_put(object, "symbolic_analyses", json_integer(summary->symbolic_analyses), good);
    cipc_json_put(object, "factorizations", json_integer(summary->factorizations), good);
    return object;
}

static json_t *seconds_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        cipc_json_put(object, cipc_phase_name((cipc_phase)i), cipc_json_number(summary->seconds_by_phase[i]), good);
    }
    cipc_json_put(object, "output", cipc_json_number(summary->output_seconds), good);
    cipc_json_put(object, "total", cipc_json_number(summary->seconds), good);
    return object;
}

static void put_outcome(json_t *object, const cipc_run_summary *summary, bool *good)
{
    const int exit_status = summary->interrupted ? 1 : cipc_status_exit(summary->status);
    cipc_json_put(object, "status", json_string(summary->interrupted ? "INTERRUPTED" : cipc_status_name(summary->status)), good);
    cipc_json_put(object, "exit_status", json_integer(exit_status), good);
    cipc_json_put(object, "error", error_object(summary, good), good);
    cipc_json_put(object, "scene", scene_object(summary, good), good);
    cipc_json_put(object, "command", text_or_null(summary->command), good);
    cipc_json_put(object, "seed", json_integer((json_int_t)summary->seed), good);
    cipc_json_put(object, "threads", json_integer(summary->threads), good);
    cipc_json_put(object, "steps_asked", json_integer(summary->steps_asked), good);
    cipc_json_put(object, "steps_taken", json_integer(summary->steps_taken), good);
    cipc_json_put(object, "resumed_from", summary->resumed_from >= 0 ? json_integer(summary->resumed_from) : json_null(), good);
    cipc_json_put(object, "time", cipc_json_number(summary->time), good);
    cipc_json_put(object, "converged", json_boolean(summary->converged), good);
}

static json_t *summary_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    put_outcome(object, summary, good);
    cipc_json_put(object, "model", model_object(summary, good), good);
    cipc_json_put(object, "invariants", invariants_object(summary, good), good);
    cipc_json_put(object, "monitors", monitors_object(summary, good), good);
    cipc_json_put(object, "extremes", extremes_object(summary, good), good);
    cipc_json_put(object, "totals", totals_object(summary, good), good);
    cipc_json_put(object, "seconds", seconds_object(summary, good), good);
    cipc_json_put(object, "peak_memory_kb", json_integer(summary->peak_memory_kb), good);
    cipc_json_put(object, "versions", cipc_versions(), good);
    return object;
}

cipc_status cipc_summary_write(const char *path, const cipc_run_summary *summary, cipc_error *error)
{
    bool good = true;
    json_t *object = summary_object(summary, &good);
    cipc_atomic_file file;
    cipc_status status = good ? cipc_atomic_open(&file, path, error)
                              : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the summary");
    if (status == CIPC_OK) {
        json_dumpf(object, file.stream, JSON_INDENT(2) | CIPC_JSON_FORMAT);
        fputc('\n', file.stream);
        status = cipc_atomic_close(&file, CIPC_OK, error);
    }
    json_decref(object);
    return status;
}
