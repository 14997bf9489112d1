/* What the monitors saw during one step: gathered, and as the fields of a line of stats.jsonl. */
#include "output/step_invariants.h"

#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "output/fields.h"

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

void cipc_step_invariants_add_window(cipc_step_invariants *step, const cipc_invariant_report *report)
{
    step->windows++;
    cipc_step_invariants_add(step, report);
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

/* ---- In stats.jsonl ------------------------------------------------------------------------------------------------------- */

#define MONITOR_FIELD(key, name, type) {key, type, offsetof(cipc_step_invariants, name)}
static const cipc_field monitor_fields[] = {
    MONITOR_FIELD("min_gap", worst.min_gap, CIPC_FIELD_REAL),
    MONITOR_FIELD("max_stretch", worst.max_stretch, CIPC_FIELD_REAL),
    MONITOR_FIELD("max_stretch_triangle", worst.max_stretch_triangle, CIPC_FIELD_INTEGER),
    MONITOR_FIELD("max_stretch_ratio", worst.max_stretch_ratio, CIPC_FIELD_REAL),
    MONITOR_FIELD("max_segment_stretch", max_segment_stretch, CIPC_FIELD_REAL),
    MONITOR_FIELD("points_checked", points, CIPC_FIELD_LONG),
    MONITOR_FIELD("energy_checks", energy_checks, CIPC_FIELD_LONG),
    MONITOR_FIELD("momentum_checks", momentum_checks, CIPC_FIELD_LONG),
    MONITOR_FIELD("momentum_change", momentum_change, CIPC_FIELD_REAL),
    MONITOR_FIELD("exact_gap_checks", worst.exact_gap_checks, CIPC_FIELD_LONG),
    MONITOR_FIELD("exact_strain_checks", worst.exact_strain_checks, CIPC_FIELD_LONG),
    MONITOR_FIELD("paths_checked", worst.paths_checked, CIPC_FIELD_LONG),
    MONITOR_FIELD("exact_path_checks", worst.exact_path_checks, CIPC_FIELD_LONG),
    MONITOR_FIELD("pairs_checked", worst.pairs_checked, CIPC_FIELD_LONG),
    MONITOR_FIELD("crossings_checked", worst.crossings_checked, CIPC_FIELD_LONG),
};
enum { MONITOR_FIELDS = sizeof monitor_fields / sizeof monitor_fields[0] };

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

void cipc_step_invariants_put(json_t *line, const cipc_step_invariants *invariants, bool *good)
{
    cipc_fields_put(line, monitor_fields, MONITOR_FIELDS, invariants, good);
    cipc_json_put(line, "min_gap_nodes", gap_nodes(invariants), good);
}

bool cipc_step_invariants_get(const json_t *line, cipc_step_invariants *invariants)
{
    *invariants = cipc_step_invariants_none();
    cipc_fields_get(line, monitor_fields, MONITOR_FIELDS, invariants);
    return json_is_integer(json_object_get(line, "points_checked"));
}
