/* Candidate pairs kept over several iterations: found with some slack around the path, they stay complete while no node leaves it (Verlet's idea). */
#include "implicit/stepper.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* Slack as a multiple of dhat: at least, and at most; between them half of the step's largest displacement, so that the next, usually smaller, steps are covered. */
static const double least_slack = 4, most_slack = 16;

/* Largest distance of a node on the path from its reference position: a path is straight, so its ends decide. */
static double largest_excursion(const cipc_stepper *s, const double *x, const double *p)
{
    double most = 0;
    for (int i = 0; i < s->model->node_count; i++) {
        double from[3], to[3];
        v3_sub(from, x + 3 * i, s->cache.reference + 3 * i);
        most = max2(most, v3_norm2(from));
        if (!p) continue;
        v3_add(to, from, p + 3 * i);
        most = max2(most, v3_norm2(to));
    }
    return sqrt(most);
}

static double largest_displacement(const cipc_stepper *s, const double *p)
{
    double most = 0;
    for (int i = 0; p && i < s->model->node_count; i++) most = max2(most, v3_norm2(p + 3 * i));
    return sqrt(most);
}

cipc_status cipc_cache_cover(cipc_stepper *s, const double *x, const double *p, cipc_error *error)
{
    cipc_candidate_cache *c = &s->cache;
    c->along_path = false;
    /* Two primitives approach by at most twice the largest excursion of their nodes. */
    if (c->slack > 0 && 2 * largest_excursion(s, x, p) < c->slack) return CIPC_OK;
    double begin = cipc_seconds(), dhat = s->options.contact.dhat;
    double slack = min2(max2(0.5 * largest_displacement(s, p), least_slack * dhat), most_slack * dhat);
    cipc_status status = cipc_broad_phase_find(c->broad_phase, s->model, x, p, 1, dhat + slack, s->passive, s->options.threads, &c->candidates, error);
    memcpy(c->reference, x, 3 * (size_t)s->model->node_count * sizeof(double));
    c->along_path = p != NULL;
    c->slack = status ? 0 : slack;
    s->report->seconds[CIPC_PHASE_BROAD_PHASE] += cipc_seconds() - begin;
    return status;
}

void cipc_cache_recentre(cipc_stepper *s)
{
    if (s->cache.along_path) memcpy(s->cache.reference, s->x, 3 * (size_t)s->model->node_count * sizeof(double));
    s->cache.along_path = false;
}

cipc_status cipc_contacts_at(cipc_stepper *s, const double *x, cipc_contact_set *set, cipc_error *error)
{
    double begin = cipc_seconds();
    cipc_status status = cipc_contact_set_build(set, s->model, &s->cache.candidates, x, s->kappa, &s->options.contact, s->options.threads, error);
    s->report->seconds[CIPC_PHASE_CONTACT] += cipc_seconds() - begin;
    return status;
}
