/* The monitors together: creation, one look at a state, what they share (SPEC V.5). */
#include "cipc/invariant.h"

#include <math.h>
#include <stdio.h>

#include "invariant/monitor.h"

static const char place[] = "monitor";
/* The activation distance of the scenes of the paper, m; the margin is as large: near convergence nodes move less than half of it. */
#define DEFAULT_REACH  1e-3
#define DEFAULT_MARGIN 1e-3

cipc_invariant_options cipc_invariant_options_default(void)
{
    return (cipc_invariant_options){.reach = DEFAULT_REACH, .threads = 1, .allow_fixed_fixed = true, .margin = DEFAULT_MARGIN};
}

void cipc_invariant_report_init(cipc_invariant_report *report)
{
    *report = (cipc_invariant_report){.min_gap = INFINITY, .min_gap_nodes = {-1, -1, -1, -1}, .max_stretch_triangle = -1};
}

int cipc_monitor_sections(int count)
{
    return (count + CIPC_MONITOR_SECTION - 1) / CIPC_MONITOR_SECTION;
}

const char *cipc_monitor_body(const cipc_model *model, int node)
{
    return model->bodies[model->node_body[node]].name;
}

/* One primitive of n nodes; returns the length of the text, which has room in half of a pair's. */
static int name_primitive(char *text, size_t size, const cipc_model *model, const int *nodes, int n)
{
    const char *body = cipc_monitor_body(model, nodes[0]);
    if (n == 1) { return snprintf(text, size, "node %d (body \"%s\")", nodes[0], body); }
    if (n == 2) { return snprintf(text, size, "edge (nodes %d %d, body \"%s\")", nodes[0], nodes[1], body); }
    return snprintf(text, size, "triangle (nodes %d %d %d, body \"%s\")", nodes[0], nodes[1], nodes[2], body);
}

void cipc_monitor_name_pair(char text[CIPC_MONITOR_PAIR_SIZE], const cipc_model *model, cipc_pair_kind kind, const int nodes[4])
{
    size_t used = 0;
    int na = cipc_pair_first_nodes(kind);
    used += (size_t)name_primitive(text, CIPC_MONITOR_PAIR_SIZE, model, nodes, na);
    used += (size_t)snprintf(&text[used], CIPC_MONITOR_PAIR_SIZE - used, " and ");
    name_primitive(&text[used], CIPC_MONITOR_PAIR_SIZE - used, model, &nodes[na], cipc_pair_nodes(kind) - na);
}

static cipc_status check_options(const cipc_invariant_options *o, cipc_error *error)
{
    if (!(o->reach >= 0) || !isfinite(o->reach) || !(o->margin >= 0) || !isfinite(o->margin)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "reach %g and margin %g must be finite and not negative", o->reach, o->margin);
    }
    if (o->threads < 1) { return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "threads is %d; it must be at least 1", o->threads); }
    return CIPC_OK;
}

cipc_status cipc_monitor_create(cipc_monitor **monitor, const cipc_model *model, const cipc_invariant_options *options, cipc_error *error)
{
    *monitor = NULL;
    cipc_invariant_options o = options != NULL ? *options : cipc_invariant_options_default();
    cipc_status status = check_options(&o, error);
    if (status != CIPC_OK) { return status; }
    cipc_monitor *m = cipc_alloc(1, sizeof *m);
    if (m == NULL) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the monitor"); }
    m->model = model;
    m->options = o;
    m->rest = cipc_alloc((size_t)model->triangle_count, sizeof *m->rest);
    if (!invariant_candidates_init(&m->candidates, model, o.reach, o.margin, o.threads, o.allow_fixed_fixed) ||
        !invariant_candidates_init(&m->paths, model, 0, 0, o.threads, o.allow_fixed_fixed) || m->rest == NULL) {
        cipc_monitor_destroy(m);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the broad phase of %d nodes", model->node_count);
    }
    for (int t = 0; t < model->triangle_count; t++) { cipc_strain_rest_init(&m->rest[t], model, t); }
    *monitor = m;
    return CIPC_OK;
}

void cipc_monitor_destroy(cipc_monitor *monitor)
{
    if (monitor != NULL) {
        invariant_candidates_free(&monitor->candidates);
        invariant_candidates_free(&monitor->paths);
        cipc_free(monitor->rest);
        cipc_free(monitor);
    }
}

cipc_status cipc_monitor_prepare(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    cipc_status status = cipc_monitor_finite(monitor->model, x, error);
    if (status != CIPC_OK) { return status; }
    bool made_now;
    if (!invariant_candidates_update(&monitor->candidates, x, &made_now)) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the lists of candidate pairs");
    }
    if (report != NULL) { report->lists_made = report->lists_made || made_now; }
    return CIPC_OK;
}

cipc_status cipc_monitor_check(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    typedef cipc_status check(cipc_monitor *, const double *, cipc_invariant_report *, cipc_error *);
    static check *const checks[] = {cipc_monitor_intersection, cipc_monitor_gap, cipc_monitor_strain, cipc_monitor_inversion};
    if (report != NULL) { cipc_invariant_report_init(report); }
    cipc_status status = cipc_monitor_finite(monitor->model, x, error);
    for (size_t i = 0; i < sizeof checks / sizeof checks[0] && status == CIPC_OK; i++) { status = checks[i](monitor, x, report, error); }
    return status;
}
