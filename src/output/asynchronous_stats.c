/* stats.jsonl of the method asynchronous: a line per time step, and the way back from it. */
#include <math.h>

#include "base/json_number.h"
#include "output/contact_place.h"
#include "output/fields.h"
#include "output/stats_line.h"
#include "output/step_invariants.h"

const char *const cipc_quantile_names[CIPC_QUANTILES] = {"min", "p5", "p25", "median", "p75", "p95", "max"};

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define REPORT_FIELD(name, type) {#name, type, offsetof(cipc_asynchronous_report, name)}
static const cipc_field report_fields[] = {
    REPORT_FIELD(total_events, CIPC_FIELD_LONG),
    REPORT_FIELD(activations, CIPC_FIELD_LONG),
    REPORT_FIELD(deactivations, CIPC_FIELD_LONG),
    REPORT_FIELD(contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(max_contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(certificates, CIPC_FIELD_INTEGER),
    REPORT_FIELD(separations, CIPC_FIELD_INTEGER),
    REPORT_FIELD(layers, CIPC_FIELD_INTEGER),
    REPORT_FIELD(smallest_step, CIPC_FIELD_REAL),
    {"solver_min_gap", CIPC_FIELD_REAL, offsetof(cipc_asynchronous_report, min_gap)},
};
static const cipc_field energy_fields[] = {
    REPORT_FIELD(kinetic, CIPC_FIELD_REAL),
    REPORT_FIELD(gravitational, CIPC_FIELD_REAL),
    REPORT_FIELD(elastic, CIPC_FIELD_REAL),
    REPORT_FIELD(contact, CIPC_FIELD_REAL),
};
static const cipc_field window_field = {"windows_checked", CIPC_FIELD_LONG, offsetof(cipc_step_invariants, windows)};

/* ---- Writing -------------------------------------------------------------------------------------------------------------- */

static json_t *events_object(const long events[CIPC_EVENT_COUNT], bool *good)
{
    json_t *object = json_object();
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) {
        cipc_json_put(object, cipc_event_name((cipc_event_kind)k), json_integer(events[k]), good);
    }
    return object;
}

static json_t *quantiles_object(const double steps[CIPC_QUANTILES], bool *good)
{
    json_t *object = json_object();
    for (int q = 0; q < CIPC_QUANTILES; q++) {
        cipc_json_put(object, cipc_quantile_names[q], cipc_json_number(steps[q]), good);
    }
    return object;
}

static json_t *energy_object(const cipc_asynchronous_report *report, bool *good)
{
    json_t *object = json_object();
    cipc_fields_put(object, energy_fields, COUNT(energy_fields), report, good);
    cipc_json_put(object, "total", cipc_json_number(report->kinetic + report->gravitational + report->elastic + report->contact), good);
    return object;
}

static json_t *seconds_object(const double seconds[CIPC_ASYNCHRONOUS_PHASE_COUNT], bool *good)
{
    json_t *object = json_object();
    double total = 0;
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) {
        cipc_json_put(object, cipc_asynchronous_phase_name((cipc_asynchronous_phase)i), cipc_json_number(seconds[i]), good);
        total += seconds[i];
    }
    cipc_json_put(object, "total", cipc_json_number(total), good);
    return object;
}

cipc_status cipc_asynchronous_stats_write(FILE *file, const cipc_state *state, const cipc_asynchronous_report *report,
                                          const cipc_step_invariants *invariants, cipc_error *error)
{
    bool good = true;
    json_t *line = json_object();
    cipc_json_put(line, "step", json_integer(state->step), &good);
    cipc_json_put(line, "time", cipc_json_number(state->time), &good);
    cipc_json_put(line, "events", events_object(report->events, &good), &good);
    cipc_fields_put(line, report_fields, COUNT(report_fields), report, &good);
    cipc_json_put(line, "deepest", cipc_contact_place_object(&report->deepest, &good), &good);
    cipc_json_put(line, "vertex_steps", quantiles_object(report->vertex_steps, &good), &good);
    cipc_step_invariants_put(line, invariants, &good);
    cipc_fields_put(line, &window_field, 1, invariants, &good);
    cipc_json_put(line, "energy", energy_object(report, &good), &good);
    cipc_json_put(line, "seconds", seconds_object(report->seconds, &good), &good);
    return cipc_stats_line_write(file, line, good, state->step, error);
}

/* ---- Resuming ------------------------------------------------------------------------------------------------------------- */

static double seconds_of(const json_t *line, int phase)
{
    const double seconds = cipc_json_double(json_object_get(json_object_get(line, "seconds"), cipc_asynchronous_phase_name((cipc_asynchronous_phase)phase)));
    return isfinite(seconds) ? seconds : 0;
}

void cipc_asynchronous_line_add(const json_t *line, cipc_run_summary *summary)
{
    cipc_asynchronous_report report = {.min_gap = INFINITY, .smallest_step = INFINITY};
    cipc_step_invariants invariants;
    const bool monitored = cipc_step_invariants_get(line, &invariants);
    cipc_fields_get(line, &window_field, 1, &invariants);
    cipc_fields_get(line, report_fields, COUNT(report_fields), &report);
    report.deepest = cipc_contact_place_of(json_object_get(line, "deepest"));
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) {
        report.events[k] = (long)json_integer_value(json_object_get(json_object_get(line, "events"), cipc_event_name((cipc_event_kind)k)));
    }
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) {
        report.seconds[i] = seconds_of(line, i);
        summary->seconds += report.seconds[i];
    }
    cipc_asynchronous_summary_add(summary, &report, monitored ? &invariants : NULL);
}
