/* summary.json: what a run did and what may be claimed of it. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "output/contact_place.h"
#include "base/json_number.h"
#include "output/versions.h"

#include <math.h>
#include <string.h>

enum { INVARIANT_COUNT = 8 };

/* Frames that break M1 or M2, of the method mass-spring. */
static const cipc_counted *counted_of(const cipc_run_summary *summary, int invariant)
{
    return invariant == 1 ? &summary->massspring.intersecting : &summary->massspring.too_near;
}

/* Why M5 and M6 are not checked, or NULL. */
static const char *reason_of_method(const cipc_run_summary *summary, int invariant)
{
    const bool massspring = summary->method == CIPC_METHOD_MASS_SPRING;
    if (invariant == 5 && massspring) {
        return "the method makes no claim about paths";
    }
    if (invariant == 6 && massspring) {
        return "explicit steps minimise no potential";
    }
    return invariant == 6 && summary->method == CIPC_METHOD_ASYNCHRONOUS ? "the energy oscillates" : NULL;
}

/* The verdict; of those of the method mass-spring that are counted, how many, and of M5 to M7 why there is none. */
static json_t *verdict_text(const cipc_run_summary *summary, int invariant)
{
    const char *verdict = cipc_run_summary_verdict(summary, invariant);
    if (invariant == 7 && summary->monitored && summary->momentum_source != NULL) {
        return json_sprintf("%s: %s", verdict, summary->momentum_source);
    }
    if (strcmp(verdict, "counted") == 0) {
        return json_sprintf("%s: %ld of %ld frames %s", verdict, counted_of(summary, invariant)->frames, summary->massspring.frames, invariant == 1 ? "intersect" : "are too near");
    }
    const char *reason = reason_of_method(summary, invariant);
    if (reason != NULL && summary->monitored) {
        return json_sprintf("%s: %s", verdict, reason);
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

static double monitor_seconds(const cipc_run_summary *summary)
{
    if (summary->method == CIPC_METHOD_MASS_SPRING) {
        return summary->massspring.monitor_seconds;
    }
    return summary->method == CIPC_METHOD_ASYNCHRONOUS ? summary->asynchronous.seconds[CIPC_ASYNCHRONOUS_PHASE_MONITOR] : summary->seconds_by_phase[CIPC_PHASE_MONITOR];
}

/* Of the first frame that breaks an invariant which the method mass-spring does not guarantee. */
static json_t *first_object(const cipc_counted *counted, bool *good)
{
    if (counted->frames == 0) {
        return json_null();
    }
    json_t *object = json_object();
    cipc_json_put(object, "step", json_integer(counted->first_step), good);
    cipc_json_put(object, "what", text_or_null(counted->first.what), good);
    return object;
}

static json_t *counted_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "frames", json_integer(summary->massspring.frames), good);
    for (int invariant = 1; invariant <= 2; invariant++) {
        const cipc_counted *counted = counted_of(summary, invariant);
        json_t *one = json_object();
        cipc_json_put(one, "frames", json_integer(counted->frames), good);
        cipc_json_put(one, "first", first_object(counted, good), good);
        cipc_json_put(object, invariant == 1 ? "M1" : "M2", one, good);
    }
    return object;
}

static json_t *monitors_object(const cipc_run_summary *summary, bool *good)
{
    const bool asynchronous = summary->method == CIPC_METHOD_ASYNCHRONOUS;
    const double seconds = monitor_seconds(summary);
    json_t *object = json_object();
    cipc_json_put(object, "points_checked", json_integer(summary->points_checked), good);
    if (asynchronous) {
        cipc_json_put(object, "windows_checked", json_integer(summary->windows_checked), good);
    }
    if (summary->method == CIPC_METHOD_MASS_SPRING) {
        cipc_json_put(object, "counted", counted_object(summary, good), good);
    }
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

static void put_asynchronous_extremes(json_t *object, const cipc_asynchronous_totals *totals, bool *good)
{
    cipc_json_put(object, "max_events", json_integer(totals->max_events), good);
    cipc_json_put(object, "layers", json_integer(totals->layers), good);
    cipc_json_put(object, "deepest", cipc_contact_place_object(&totals->deepest, good), good);
    cipc_json_put(object, "solver_min_gap", cipc_json_number(totals->min_gap), good);
    cipc_json_put(object, "smallest_step", cipc_json_number(totals->smallest_step), good);
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
    if (summary->method == CIPC_METHOD_ASYNCHRONOUS) {
        put_asynchronous_extremes(object, &summary->asynchronous, good);
    } else if (summary->method == CIPC_METHOD_MASS_SPRING) {
        cipc_json_put(object, "max_deformation", cipc_json_number(summary->massspring.max_deformation), good);
        cipc_json_put(object, "max_self_contacts", json_integer(summary->massspring.max_self_contacts), good);
        cipc_json_put(object, "max_inside", json_integer(summary->massspring.max_inside), good);
    } else {
        cipc_json_put(object, "max_newton_iterations", json_integer(summary->max_newton_iterations), good);
    }
    return object;
}

static json_t *asynchronous_totals_object(const cipc_asynchronous_totals *totals, bool *good)
{
    json_t *object = json_object(), *events = json_object();
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) {
        cipc_json_put(events, cipc_event_name((cipc_event_kind)k), json_integer(totals->events[k]), good);
    }
    cipc_json_put(object, "events", events, good);
    cipc_json_put(object, "total_events", json_integer(totals->total_events), good);
    cipc_json_put(object, "activations", json_integer(totals->activations), good);
    cipc_json_put(object, "deactivations", json_integer(totals->deactivations), good);
    return object;
}

static json_t *massspring_totals_object(const cipc_massspring_totals *totals, bool *good)
{
    json_t *object = json_object();
    const bool measured = totals->step_seconds > 0;
    cipc_json_put(object, "substeps", json_integer(totals->substeps), good);
    cipc_json_put(object, "hits", json_integer(totals->hits), good);
    cipc_json_put(object, "arrivals", json_integer(totals->arrivals), good);
    cipc_json_put(object, "bisection_iterations", json_integer(totals->iterations), good);
    cipc_json_put(object, "sweeps", json_integer(totals->sweeps), good);
    cipc_json_put(object, "beyond_bound", json_integer(totals->beyond_bound), good);
    cipc_json_put(object, "reversals", json_integer(totals->reversals), good);
    cipc_json_put(object, "real_time_factor", measured ? cipc_json_number(totals->frame_seconds / totals->step_seconds) : json_null(), good);
    return object;
}

static json_t *totals_object(const cipc_run_summary *summary, bool *good)
{
    if (summary->method == CIPC_METHOD_MASS_SPRING) {
        return massspring_totals_object(&summary->massspring, good);
    }
    if (summary->method == CIPC_METHOD_ASYNCHRONOUS) {
        return asynchronous_totals_object(&summary->asynchronous, good);
    }
    json_t *object = json_object();
    cipc_json_put(object, "newton_iterations", json_integer(summary->newton_iterations), good);
    cipc_json_put(object, "line_search_halvings", json_integer(summary->line_search_halvings), good);
    cipc_json_put(object, "friction_passes", json_integer(summary->friction_passes), good);
    cipc_json_put(object, "symbolic_analyses", json_integer(summary->symbolic_analyses), good);
    cipc_json_put(object, "factorizations", json_integer(summary->factorizations), good);
    return object;
}

static void put_phases(json_t *object, const cipc_run_summary *summary, bool *good)
{
    const bool asynchronous = summary->method == CIPC_METHOD_ASYNCHRONOUS;
    if (summary->method == CIPC_METHOD_MASS_SPRING) {
        cipc_json_put(object, "step", cipc_json_number(summary->massspring.step_seconds), good);
        cipc_json_put(object, "monitor", cipc_json_number(summary->massspring.monitor_seconds), good);
        return;
    }
    for (int i = 0; asynchronous && i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) {
        cipc_json_put(object, cipc_asynchronous_phase_name((cipc_asynchronous_phase)i), cipc_json_number(summary->asynchronous.seconds[i]), good);
    }
    for (int i = 0; !asynchronous && i < CIPC_PHASE_COUNT; i++) {
        cipc_json_put(object, cipc_phase_name((cipc_phase)i), cipc_json_number(summary->seconds_by_phase[i]), good);
    }
}

static json_t *seconds_object(const cipc_run_summary *summary, bool *good)
{
    json_t *object = json_object();
    put_phases(object, summary, good);
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
    cipc_json_put(object, "method", json_string(cipc_method_name(summary->method)), good);
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
