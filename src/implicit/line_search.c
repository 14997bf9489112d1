/* Line search: the step is first cut to what the strain limit and contact allow, then halved until E decreases sufficiently (SPEC D.5, C.7). */
#include "implicit/stepper.h"

#include <math.h>
#include <string.h>

/* Armijo's constant: E(x + alpha p) <= E(x) + c alpha p.grad E + noise. The released code takes any decrease (c = 0). */
static const double sufficient_decrease = 1e-4;
/* Where only the noise lets a point pass, its slope decides: p.grad E(x + alpha p) <= this part of |p.grad E(x)|, so that the minimum along p is hardly passed by. Steps that overshoot
 * a kink of friction would go round in a circle within the noise otherwise. (Hager and Zhang's "approximate Wolfe" condition, 2005, asks for less, 1 - 2 c, which is enough for
 * a smooth E only.) */
static const double passed_slope = 0.1;

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

static void swap_points(cipc_stepper *s)
{
    double *x = s->x;
    s->x = s->trial;
    s->trial = x;
    swap_contacts(s);
}

/* p.grad E at the trial point; leaves the stepper as it was but for s->gradient, which the next iteration makes anew. */
static cipc_status trial_slope(cipc_stepper *s, double *slope, cipc_error *error)
{
    const double noise = s->noise;
    swap_points(s);
    cipc_status status = cipc_potential_gradient(s, error);
    swap_points(s);
    s->noise = noise;
    *slope = 0;
    for (int i = 0; i < 3 * s->model->node_count; i++) *slope += s->gradient[i] * s->direction[i];
    return status;
}

/* Is E low enough at the trial point, or, where rounding hides it, is its slope? */
static cipc_status accepts(cipc_stepper *s, double before, double after, double alpha, double slope, bool *good, cipc_error *error)
{
    const double c = s->options.released ? 0 : sufficient_decrease, most = before + c * alpha * slope;
    *good = after <= most + s->noise;
    if (s->options.released || after <= most || !*good || -slope <= s->noise) return CIPC_OK; /* a slope that small is rounding itself */
    double there;
    cipc_status status = trial_slope(s, &there, error);
    *good = there <= passed_slope * -slope;
    return status;
}

cipc_status cipc_line_search(cipc_stepper *s, int iteration, double slope, double *energy, double *alpha, cipc_error *error)
{
    double before = *energy, after = INFINITY;
    bool good = false;
    cipc_status status = feasible_step(s, alpha, error);
    for (int halvings = 0; !status; halvings++) {
        status = try_point(s, *alpha, &after, error);
        if (!status) status = accepts(s, before, after, *alpha, slope, &good, error);
        if (status) return status;
        if (good) break;
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
