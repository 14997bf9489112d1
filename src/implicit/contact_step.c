/* How far along a path contact lets the nodes go: every search for it in a time step comes through here. */
#include "implicit/stepper.h"

#include <string.h>

void cipc_stepper_set_ccd_watch(cipc_stepper *s, cipc_ccd_watch *watch, void *context)
{
    s->ccd_watch = watch;
    s->ccd_watch_context = context;
}

double cipc_contact_step(cipc_stepper *s, double t_max)
{
    int nodes[4];
    if (s->ccd_watch) {
        cipc_ccd_search search = {.candidates = &s->cache.candidates, .x = s->x, .p = s->direction, .t_max = t_max, .step = s->step, .options = &s->options.ccd};
        s->ccd_watch(s->ccd_watch_context, &search);
    }
    double begin = cipc_seconds();
    double t = cipc_candidates_ccd(s->model, &s->cache.candidates, s->x, s->direction, t_max, &s->options.ccd, s->options.threads, nodes, NULL);
    if (t < t_max) {
        s->limit.what = "contact";
        memcpy(s->limit.nodes, nodes, sizeof nodes);
    }
    s->report->seconds[CIPC_PHASE_CCD] += cipc_seconds() - begin;
    return t;
}
