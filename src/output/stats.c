/* stats.jsonl: one JSON line per time step, and the way back from it. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "base/json_number.h"

#include <errno.h>
#include <math.h>
#include <string.h>

cipc_step_invariants cipc_step_invariants_none(void)
{
    cipc_step_invariants none = {0};
    none.worst.min_gap = INFINITY;
    for (int i = 0; i < 4; i++) {
        none.worst.min_gap_nodes[i] = -1;
    }
    none.worst.max_stretch_triangle = -1;
    return none;
}

void cipc_step_invariants_add(cipc_step_invariants *step, const cipc_invariant_report *report)
{
    cipc_invariant_report *worst = &step->worst;
    step->points++;
    if (report->min_gap < worst->min_gap) {
        worst->min_gap = report->min_gap;
        memcpy(worst->min_gap_nodes, report->min_gap_nodes, sizeof worst->min_gap_nodes);
        worst->min_gap_kind = report->min_gap_kind;
    }
    if (report->max_stretch > worst->max_stretch) {
        worst->max_stretch = report->max_stretch;
        worst->max_stretch_triangle = report->max_stretch_triangle;
    }
    worst->max_stretch_ratio = fmax(worst->max_stretch_ratio, report->max_stretch_ratio);
    worst->exact_gap_checks += report->exact_gap_checks;
    worst->exact_strain_checks += report->exact_strain_checks;
    worst->paths_checked += report->paths_checked;
    worst->exact_path_checks += report->exact_path_checks;
    worst->pairs_checked += report->pairs_checked;
    worst->crossings_checked += report->crossings_checked;
}

static double distance(const double *a, const double *b)
{
    return hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
}

void cipc_step_invariants_add_segments(cipc_step_invariants *step, const cipc_model *model, const double *position)
{
    for (int i = 0; i < model->segment_count; i++) {
        const int *v = model->edges[model->first_segment + i];
        if (!model->bodies[model->node_body[v[0]]].fixed) {
            const double rest = distance(model->rest + 3 * v[0], model->rest + 3 * v[1]);
            const double length = distance(position + 3 * v[0], position + 3 * v[1]);
            step->max_segment_stretch = fmax(step->max_segment_stretch, length / rest);
        }
    }
}

/* ---- One table for both directions ---------------------------------------------------------------------------------------- */

typedef enum field_type { INTEGER, LONG_INTEGER, REAL } field_type;
typedef struct field {
    const char *key;
    field_type type;
    size_t offset;
} field;

#define REPORT_FIELD(name, type) {#name, type, offsetof(cipc_step_report, name)}
static const field report_fields[] = {
    REPORT_FIELD(newton_iterations, INTEGER),
    REPORT_FIELD(line_search_halvings, INTEGER),
    REPORT_FIELD(friction_passes, INTEGER),
    REPORT_FIELD(factorizations, INTEGER),
    REPORT_FIELD(symbolic_analyses, INTEGER),
    REPORT_FIELD(contacts, INTEGER),
    REPORT_FIELD(max_contacts, INTEGER),
    REPORT_FIELD(residual, REAL),
    REPORT_FIELD(barrier_stiffness, REAL),
    REPORT_FIELD(strain_stiffness_factor, REAL),
    {"solver_min_gap", REAL, offsetof(cipc_step_report, min_gap)},
};

#define MONITOR_FIELD(key, name, type) {key, type, offsetof(cipc_step_invariants, name)}
static const field monitor_fields[] = {
    MONITOR_FIELD("min_gap", worst.min_gap, REAL),
    MONITOR_FIELD("max_stretch", worst.max_stretch, REAL),
    MONITOR_FIELD("max_stretch_triangle", worst.max_stretch_triangle, INTEGER),
    MONITOR_FIELD("max_stretch_ratio", worst.max_stretch_ratio, REAL),
    MONITOR_FIELD("max_segment_stretch", max_segment_stretch, REAL),
    MONITOR_FIELD("points_checked", points, LONG_INTEGER),
    MONITOR_FIELD("energy_checks", energy_checks, LONG_INTEGER),
    MONITOR_FIELD("momentum_checks", momentum_checks, LONG_INTEGER),
    MONITOR_FIELD("momentum_change", momentum_change, REAL),
    MONITOR_FIELD("exact_gap_checks", worst.exact_gap_checks, LONG_INTEGER),
    MONITOR_FIELD("exact_strain_checks", worst.exact_strain_checks, LONG_INTEGER),
    MONITOR_FIELD("paths_checked", worst.paths_checked, LONG_INTEGER),
    MONITOR_FIELD("exact_path_checks", worst.exact_path_checks, LONG_INTEGER),
    MONITOR_FIELD("pairs_checked", worst.pairs_checked, LONG_INTEGER),
    MONITOR_FIELD("crossings_checked", worst.crossings_checked, LONG_INTEGER),
};

static const field energy_fields[] = {
    REPORT_FIELD(kinetic, REAL),
    REPORT_FIELD(gravitational, REAL),
    REPORT_FIELD(elastic, REAL),
};

#define TERM_FIELD(name) {#name, REAL, offsetof(cipc_step_report, incremental.name)}
static const field term_fields[] = {
    TERM_FIELD(inertia), TERM_FIELD(membrane), TERM_FIELD(bending), TERM_FIELD(strain_limit), TERM_FIELD(barrier),
    TERM_FIELD(friction), TERM_FIELD(penalty), TERM_FIELD(damping), TERM_FIELD(stretching), TERM_FIELD(volume), TERM_FIELD(stitches),
    TERM_FIELD(total), TERM_FIELD(noise),
};

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* values NULL: every field becomes null. */
static void put_fields(json_t *object, const field *fields, size_t count, const void *values, bool *good)
{
    for (size_t i = 0; i < count; i++) {
        const void *at = values != NULL ? (const char *)values + fields[i].offset : NULL;
        json_t *value = NULL;
        if (at == NULL) {
            value = json_null();
        } else if (fields[i].type == REAL) {
            value = cipc_json_number(*(const double *)at);
        } else {
            value = json_integer(fields[i].type == INTEGER ? *(const int *)at : *(const long *)at);
        }
        cipc_json_put(object, fields[i].key, value, good);
    }
}

/* Fields that are missing or null leave the value as it is. */
static void get_fields(const json_t *object, const field *fields, size_t count, void *values)
{
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_object_get(object, fields[i].key);
        void *at = (char *)values + fields[i].offset;
        if (value == NULL || json_is_null(value)) {
            continue;
        }
        if (fields[i].type == REAL) {
            *(double *)at = cipc_json_double(value);
        } else if (fields[i].type == INTEGER) {
            *(int *)at = (int)json_integer_value(value);
        } else {
            *(long *)at = (long)json_integer_value(value);
        }
    }
}

/* ---- Writing -------------------------------------------------------------------------------------------------------------- */

static json_t *gap_nodes(const cipc_step_invariants *invariants)
{
    if (invariants == NULL || !isfinite(invariants->worst.min_gap)) {
        return json_null();
    }
    json_t *nodes = json_array();
    for (int i = 0; i < 4 && invariants->worst.min_gap_nodes[i] >= 0; i++) {
        json_array_append_new(nodes, json_integer(invariants->worst.min_gap_nodes[i]));
    }
    return nodes;
}

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
    put_fields(line, report_fields, COUNT(report_fields), report, good);
    put_fields(line, monitor_fields, COUNT(monitor_fields), invariants, good);
    cipc_json_put(line, "min_gap_nodes", gap_nodes(invariants), good);
    put_fields(energy, energy_fields, COUNT(energy_fields), report, good);
    cipc_json_put(energy, "total", cipc_json_number(report->kinetic + report->gravitational + report->elastic), good);
    cipc_json_put(line, "energy", energy, good);
    put_fields(terms, term_fields, COUNT(term_fields), report, good);
    cipc_json_put(line, "incremental_potential", terms, good);
    cipc_json_put(line, "seconds", phases_object(report->seconds, good), good);
    return line;
}

cipc_status cipc_stats_write(FILE *file, const cipc_state *state, const cipc_step_report *report, const cipc_step_invariants *invariants,
                             cipc_error *error)
{
    bool good = true;
    json_t *line = line_object(state, report, invariants, &good);
    if (!good) {
        json_decref(line);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stats.jsonl", "no memory for the line of step %d", state->step);
    }
    errno = 0;
    bool written = json_dumpf(line, file, JSON_COMPACT | CIPC_JSON_FORMAT) == 0 && fputc('\n', file) != EOF && fflush(file) == 0;
    json_decref(line);
    return written ? CIPC_OK : cipc_fail_io(error, "stats.jsonl", "write a line");
}

/* ---- Resuming ------------------------------------------------------------------------------------------------------------- */

static void add_line(const json_t *line, cipc_run_summary *summary)
{
    cipc_step_report report = {0};
    cipc_step_invariants invariants = cipc_step_invariants_none();
    report.converged = json_is_true(json_object_get(line, "converged"));
    get_fields(line, report_fields, COUNT(report_fields), &report);
    get_fields(line, monitor_fields, COUNT(monitor_fields), &invariants);
    const json_t *seconds = json_object_get(line, "seconds");
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        double phase = cipc_json_double(json_object_get(seconds, cipc_phase_name((cipc_phase)i)));
        report.seconds[i] = isfinite(phase) ? phase : 0;
        summary->seconds += report.seconds[i];
    }
    bool monitored = json_is_integer(json_object_get(line, "points_checked"));
    cipc_run_summary_add(summary, &report, monitored ? &invariants : NULL);
}

/* Copy the lines of steps 1..step from `in` to `out` and add them up; returns how many there were. */
static int keep_lines(FILE *in, FILE *out, int step, cipc_run_summary *summary)
{
    int kept = 0;
    while (kept < step) {
        json_t *line = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL);
        bool expected = line != NULL && json_integer_value(json_object_get(line, "step")) == kept + 1;
        if (expected) {
            add_line(line, summary);
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
