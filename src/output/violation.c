/* violation.json: what a monitor found, for whoever has to find out why. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "base/json_number.h"

static json_t *text_or_null(const char *text)
{
    json_t *value = json_string(text);
    return value != NULL ? value : json_null();
}

static json_t *report_object(const cipc_invariant_report *report, bool *good)
{
    if (report == NULL) {
        return json_null();
    }
    json_t *object = json_object(), *nodes = json_array();
    for (int i = 0; i < 4 && report->min_gap_nodes[i] >= 0; i++) {
        json_array_append_new(nodes, json_integer(report->min_gap_nodes[i]));
    }
    cipc_json_put(object, "min_gap", cipc_json_number(report->min_gap), good);
    cipc_json_put(object, "min_gap_nodes", nodes, good);
    cipc_json_put(object, "min_gap_kind", report->min_gap_nodes[0] >= 0 ? json_string(cipc_pair_name(report->min_gap_kind)) : json_null(), good);
    cipc_json_put(object, "max_stretch", cipc_json_number(report->max_stretch), good);
    cipc_json_put(object, "max_stretch_triangle", json_integer(report->max_stretch_triangle), good);
    cipc_json_put(object, "max_stretch_ratio", cipc_json_number(report->max_stretch_ratio), good);
    return object;
}

/* What every violation has. */
static json_t *violation_object(int steps_taken, double time_before, const cipc_error *violation, bool *good)
{
    json_t *object = json_object();
    cipc_json_put(object, "status", json_string(cipc_status_name(violation->status)), good);
    cipc_json_put(object, "number", json_integer(violation->status), good);
    cipc_json_put(object, "where", text_or_null(violation->place), good);
    cipc_json_put(object, "what", text_or_null(violation->what), good);
    cipc_json_put(object, "steps_taken", json_integer(steps_taken), good);
    cipc_json_put(object, "time_before", cipc_json_number(time_before), good);
    return object;
}

static json_t *energy_object(const cipc_accepted_point *point, bool *good)
{
    json_t *energy = json_object();
    cipc_json_put(energy, "comparable", json_boolean(point->energy_valid), good);
    cipc_json_put(energy, "before", cipc_json_number(point->energy_before), good);
    cipc_json_put(energy, "after", cipc_json_number(point->energy_after), good);
    cipc_json_put(energy, "noise", cipc_json_number(point->energy_noise), good);
    return energy;
}

/* Takes over the reference. */
static cipc_status write_object(const char *path, json_t *object, bool good, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status =
        good ? cipc_atomic_open(&file, path, error) : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the report");
    if (status == CIPC_OK) {
        json_dumpf(object, file.stream, JSON_INDENT(2) | CIPC_JSON_FORMAT);
        fputc('\n', file.stream);
        status = cipc_atomic_close(&file, CIPC_OK, error);
    }
    json_decref(object);
    return status;
}

cipc_status cipc_violation_write(const char *path, const cipc_accepted_point *point, double time_before,
                                 const cipc_invariant_report *report, const cipc_error *violation, cipc_error *error)
{
    bool good = true;
    json_t *object = violation_object(point->step, time_before, violation, &good);
    cipc_json_put(object, "iteration", json_integer(point->iteration), &good);
    cipc_json_put(object, "energy", energy_object(point, &good), &good);
    cipc_json_put(object, "report", report_object(report, &good), &good);
    return write_object(path, object, good, error);
}

cipc_status cipc_asynchronous_violation_write(const char *path, int steps_taken, double time_before, const double window[2],
                                              const cipc_invariant_report *report, const cipc_error *violation, cipc_error *error)
{
    bool good = true;
    json_t *object = violation_object(steps_taken, time_before, violation, &good), *times = json_object();
    cipc_json_put(times, "begin", cipc_json_number(window[0]), &good);
    cipc_json_put(times, "end", cipc_json_number(window[1]), &good);
    cipc_json_put(object, "window", times, &good);
    cipc_json_put(object, "report", report_object(report, &good), &good);
    return write_object(path, object, good, error);
}
