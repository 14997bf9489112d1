/* stats.jsonl: one JSON line per time step, and the way back from it. */
#include "output/stats_line.h"
#include "output/atomic_file.h"
#include "output/fields.h"
#include "output/step_invariants.h"
#include "base/json_number.h"

#include <errno.h>
#include <math.h>
#include <string.h>

/* ---- One table for both directions ---------------------------------------------------------------------------------------- */

#define REPORT_FIELD(name, type) {#name, type, offsetof(cipc_step_report, name)}
static const cipc_field report_fields[] = {
    REPORT_FIELD(newton_iterations, CIPC_FIELD_INTEGER),
    REPORT_FIELD(line_search_halvings, CIPC_FIELD_INTEGER),
    REPORT_FIELD(friction_passes, CIPC_FIELD_INTEGER),
    REPORT_FIELD(factorizations, CIPC_FIELD_INTEGER),
    REPORT_FIELD(symbolic_analyses, CIPC_FIELD_INTEGER),
    REPORT_FIELD(contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(max_contacts, CIPC_FIELD_INTEGER),
    REPORT_FIELD(residual, CIPC_FIELD_REAL),
    REPORT_FIELD(barrier_stiffness, CIPC_FIELD_REAL),
    REPORT_FIELD(strain_stiffness_factor, CIPC_FIELD_REAL),
    {"solver_min_gap", CIPC_FIELD_REAL, offsetof(cipc_step_report, min_gap)},
};

static const cipc_field energy_fields[] = {
    REPORT_FIELD(kinetic, CIPC_FIELD_REAL),
    REPORT_FIELD(gravitational, CIPC_FIELD_REAL),
    REPORT_FIELD(elastic, CIPC_FIELD_REAL),
};

#define TERM_FIELD(name) {#name, CIPC_FIELD_REAL, offsetof(cipc_step_report, incremental.name)}
static const cipc_field term_fields[] = {
    TERM_FIELD(inertia), TERM_FIELD(membrane), TERM_FIELD(bending), TERM_FIELD(strain_limit), TERM_FIELD(barrier),
    TERM_FIELD(friction), TERM_FIELD(penalty), TERM_FIELD(damping), TERM_FIELD(stretching), TERM_FIELD(volume), TERM_FIELD(stitches),
    TERM_FIELD(total), TERM_FIELD(noise),
};

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* ---- Writing -------------------------------------------------------------------------------------------------------------- */

static json_t *phases_object(const double seconds[CIPC_PHASE_COUNT], bool *good)
{
    json_t *object = json_object();
    double total = 0;
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        cipc_json_put(object, cipc_phase_name((cipc_phase)i), cipc_json_number(seconds[i]), good);
        total += seconds[i];
    }
    cipc_json_put(object, "total", cipc_json_number(total), good);
    return object;
}

static json_t *line_object(const cipc_state *state, const cipc_step_report *report, const cipc_step_invariants *invariants, bool *good)
{
    json_t *line = json_object(), *energy = json_object(), *terms = json_object();
    cipc_json_put(line, "step", json_integer(state->step), good);
    cipc_json_put(line, "time", cipc_json_number(state->time), good);
    cipc_json_put(line, "converged", json_boolean(report->converged), good);
    cipc_fields_put(line, report_fields, COUNT(report_fields), report, good);
    cipc_step_invariants_put(line, invariants, good);
    cipc_fields_put(energy, energy_fields, COUNT(energy_fields), report, good);
    cipc_json_put(energy, "total", cipc_json_number(report->kinetic + report->gravitational + report->elastic), good);
    cipc_json_put(line, "energy", energy, good);
    cipc_fields_put(terms, term_fields, COUNT(term_fields), report, good);
    cipc_json_put(line, "incremental_potential", terms, good);
    cipc_json_put(line, "seconds", phases_object(report->seconds, good), good);
    return line;
}

cipc_status cipc_stats_line_write(FILE *file, json_t *line, bool good, int step, cipc_error *error)
{
    if (!good) {
        json_decref(line);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stats.jsonl", "no memory for the line of step %d", step);
    }
    errno = 0;
    bool written = json_dumpf(line, file, JSON_COMPACT | CIPC_JSON_FORMAT) == 0 && fputc('\n', file) != EOF && fflush(file) == 0;
    json_decref(line);
    return written ? CIPC_OK : cipc_fail_io(error, "stats.jsonl", "write a line");
}

cipc_status cipc_stats_write(FILE *file, const cipc_state *state, const cipc_step_report *report, const cipc_step_invariants *invariants,
                             cipc_error *error)
{
    bool good = true;
    json_t *line = line_object(state, report, invariants, &good);
    return cipc_stats_line_write(file, line, good, state->step, error);
}

/* ---- Resuming ------------------------------------------------------------------------------------------------------------- */

static void add_line(const json_t *line, cipc_run_summary *summary)
{
    cipc_step_report report = {0};
    cipc_step_invariants invariants;
    const bool monitored = cipc_step_invariants_get(line, &invariants);
    report.converged = json_is_true(json_object_get(line, "converged"));
    cipc_fields_get(line, report_fields, COUNT(report_fields), &report);
    const json_t *seconds = json_object_get(line, "seconds");
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        double phase = cipc_json_double(json_object_get(seconds, cipc_phase_name((cipc_phase)i)));
        report.seconds[i] = isfinite(phase) ? phase : 0;
        summary->seconds += report.seconds[i];
    }
    cipc_run_summary_add(summary, &report, monitored ? &invariants : NULL);
}

typedef void line_adder(const json_t *line, cipc_run_summary *summary);

static line_adder *add_line_of(cipc_method method)
{
    if (method == CIPC_METHOD_MASS_SPRING) {
        return cipc_massspring_line_add;
    }
    return method == CIPC_METHOD_ASYNCHRONOUS ? cipc_asynchronous_line_add : add_line;
}

/* Copy the lines of steps 1..step from `in` to `out` and add them up; returns how many there were. */
static int keep_lines(FILE *in, FILE *out, int step, cipc_run_summary *summary)
{
    int kept = 0;
    while (kept < step) {
        json_t *line = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL);
        bool expected = line != NULL && json_integer_value(json_object_get(line, "step")) == kept + 1;
        if (expected) {
            add_line_of(summary->method)(line, summary);
            json_dumpf(line, out, JSON_COMPACT | CIPC_JSON_FORMAT);
            fputc('\n', out);
            kept++;
        }
        json_decref(line);
        if (!expected) {
            break;
        }
    }
    return kept;
}

cipc_status cipc_stats_resume(const char *path, int step, cipc_run_summary *summary, cipc_error *error)
{
    FILE *in = fopen(path, "rb");
    if (in == NULL && !(errno == ENOENT && step == 0)) {
        cipc_status status = errno == ENOENT ? CIPC_E_NOT_RESUMABLE : CIPC_E_IO;
        return cipc_fail(error, status, path, "cannot read the statistics of the steps done: %s", strerror(errno));
    }
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status == CIPC_OK) {
        int kept = in != NULL ? keep_lines(in, file.stream, step, summary) : 0;
        if (kept < step) {
            status = cipc_fail(error, CIPC_E_NOT_RESUMABLE, path, "the line of step %d is missing or damaged", kept + 1);
        }
        status = cipc_atomic_close(&file, status, error);
    }
    if (in != NULL) {
        fclose(in);
    }
    return status;
}
