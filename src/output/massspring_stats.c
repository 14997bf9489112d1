/* stats.jsonl of the method mass-spring: a line per time step, and the way back from it. */
#include <math.h>

#include "base/json_number.h"
#include "output/fields.h"
#include "output/stats_line.h"
#include "output/step_invariants.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define REPORT_FIELD(name, type) {#name, type, offsetof(cipc_massspring_report, name)}
static const cipc_field report_fields[] = {
    REPORT_FIELD(substeps, CIPC_FIELD_INTEGER),
    REPORT_FIELD(substep, CIPC_FIELD_REAL),
    REPORT_FIELD(contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(hits, CIPC_FIELD_LONG),
    REPORT_FIELD(arrivals, CIPC_FIELD_LONG),
    {"bisection_iterations", CIPC_FIELD_LONG, offsetof(cipc_massspring_report, iterations)},
    REPORT_FIELD(self_contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(sweeps, CIPC_FIELD_INTEGER),
    REPORT_FIELD(beyond_bound, CIPC_FIELD_INTEGER),
    REPORT_FIELD(inside, CIPC_FIELD_INTEGER),
    REPORT_FIELD(deformation, CIPC_FIELD_REAL),
    REPORT_FIELD(reversals, CIPC_FIELD_LONG),
};
static const cipc_field energy_fields[] = {
    REPORT_FIELD(kinetic, CIPC_FIELD_REAL),
    REPORT_FIELD(gravitational, CIPC_FIELD_REAL),
    REPORT_FIELD(elastic, CIPC_FIELD_REAL),
};
static const cipc_field seconds_fields[] = {
    {"step", CIPC_FIELD_REAL, offsetof(cipc_massspring_times, step)},
    {"monitor", CIPC_FIELD_REAL, offsetof(cipc_massspring_times, monitor)},
};

/* ---- Writing -------------------------------------------------------------------------------------------------------------- */

static json_t *energy_object(const cipc_massspring_report *report, bool *good)
{
    json_t *object = json_object();
    cipc_fields_put(object, energy_fields, COUNT(energy_fields), report, good);
    cipc_json_put(object, "total", cipc_json_number(report->kinetic + report->gravitational + report->elastic), good);
    return object;
}

static json_t *seconds_object(const cipc_massspring_times *times, bool *good)
{
    json_t *object = json_object();
    cipc_fields_put(object, seconds_fields, COUNT(seconds_fields), times, good);
    cipc_json_put(object, "total", cipc_json_number(times->step + times->monitor), good);
    return object;
}

cipc_status cipc_massspring_stats_write(FILE *file, const cipc_state *state, const cipc_massspring_report *report, const cipc_massspring_times *times,
                                        const cipc_step_invariants *invariants, cipc_error *error)
{
    bool good = true;
    json_t *line = json_object();
    cipc_json_put(line, "step", json_integer(state->step), &good);
    cipc_json_put(line, "time", cipc_json_number(state->time), &good);
    cipc_fields_put(line, report_fields, COUNT(report_fields), report, &good);
    cipc_step_invariants_put(line, invariants, &good);
    const bool counted = invariants != NULL && invariants->counted;
    cipc_json_put(line, "intersects", counted ? json_boolean(invariants->intersects) : json_null(), &good);
    cipc_json_put(line, "too_near", counted ? json_boolean(invariants->too_near) : json_null(), &good);
    cipc_json_put(line, "energy", energy_object(report, &good), &good);
    cipc_json_put(line, "seconds", seconds_object(times, &good), &good);
    cipc_json_put(line, "real_time_factor", times->step > 0 ? cipc_json_number(times->frame / times->step) : json_null(), &good);
    return cipc_stats_line_write(file, line, good, state->step, error);
}

/* ---- Reading back --------------------------------------------------------------------------------------------------------- */

static double finite_or_zero(double x) { return isfinite(x) ? x : 0; }

void cipc_massspring_line_add(const json_t *line, cipc_run_summary *summary)
{
    cipc_massspring_report report = {0};
    cipc_massspring_times times = {0};
    cipc_step_invariants invariants;
    const bool monitored = cipc_step_invariants_get(line, &invariants);
    invariants.counted = json_is_boolean(json_object_get(line, "intersects"));
    invariants.intersects = json_is_true(json_object_get(line, "intersects"));
    invariants.too_near = json_is_true(json_object_get(line, "too_near"));
    cipc_fields_get(line, report_fields, COUNT(report_fields), &report);
    cipc_fields_get(json_object_get(line, "seconds"), seconds_fields, COUNT(seconds_fields), &times);
    times.step = finite_or_zero(times.step);
    times.monitor = finite_or_zero(times.monitor);
    times.frame = finite_or_zero(cipc_json_double(json_object_get(line, "real_time_factor")) * times.step);
    summary->seconds += times.step + times.monitor;
    cipc_massspring_summary_add(summary, &report, &times, monitored ? &invariants : NULL);
}
