/* Line search: the step is first cut to what the strain limit and contact allow, then halved until E decreases sufficiently (SPEC D.5, C.7). */
#include "implicit/stepper.h"

#include <math.h>
#include <string.h>

/* Armijo's constant: E(x + alpha p) <= E(x) + c alpha p.grad E + noise. The released code takes any decrease (c = 0). */
static const double sufficient_decrease = 1e-4;

static void swap_contacts(cipc_stepper *s)
{
    cipc_contact_set set = s->contacts;
    s->contacts = s->trial_contacts;
    s->trial_contacts = set;
}

static void set_limit(cipc_stepper *s, const char *what, const int nodes[4])
{
    s->limit.what = what;
    memcpy(s->limit.nodes, nodes, 4 * sizeof(int));
}

/* The largest step without violated strain limit or contact. */
static cipc_status feasible_step(cipc_stepper *s, double *alpha, cipc_error *error)
{
    s->limit.what = NULL;
    *alpha = cipc_strain_step(s, s->x, s->direction);
    cipc_status status = cipc_cache_cover(s, s->x, s->direction, error);
    if (status) return status;
    *alpha = cipc_contact_step(s, *alpha);
    return CIPC_OK;
}

/* E at x + alpha p with the contacts there; INFINITY if the point is not feasible. */
static cipc_status try_point(cipc_stepper *s, double alpha, double *energy, cipc_error *error)
{
    int n = 3 * s->model->node_count;
    for (int i = 0; i < n; i++) s->trial[i] = s->x[i] + alpha * s->direction[i];
    *energy = INFINITY;
    if (!cipc_strain_feasible(s, s->trial)) return CIPC_OK;
    cipc_status status = cipc_contacts_at(s, s->trial, &s->trial_contacts, error);
    if (status || !(s->trial_contacts.min_gap > 0)) return status;
    cipc_energy_terms terms;
    double begin = cipc_seconds();
    status = cipc_potential_value(s, s->trial, &s->trial_contacts, &terms, error);
    s->report->seconds[CIPC_PHASE_LINE_SEARCH] += cipc_seconds() - begin;
    *energy = terms.total;
    return status;
}

cipc_status cipc_line_search(cipc_stepper *s, int iteration, double slope, double *energy, double *alpha, cipc_error *error)
{
    double before = *energy, after = INFINITY, c = s->options.released ? 0 : sufficient_decrease;
    cipc_status status = feasible_step(s, alpha, error);
    for (int halvings = 0; !status; halvings++) {
        status = try_point(s, *alpha, &after, error);
        if (status) return status;
        if (after <= before + c * *alpha * slope + s->noise) break;
        if (halvings == s->options.line_search_halvings) {
            int none[4] = {-1, -1, -1, -1};
            set_limit(s, "energy decrease", none);
            *alpha = 0;
            return CIPC_OK;
        }
        *alpha *= 0.5;
        s->report->line_search_halvings++;
    }
    if (status) return status;
    memcpy(s->x, s->trial, 3 * (size_t)s->model->node_count * sizeof(double));
    cipc_cache_recentre(s);
    swap_contacts(s);
    *energy = after;
    return cipc_accept(s, iteration, true, before, after, error);
}
