/* One look of one monitor at a model made by hand. Header only. */
#ifndef SUPPORT_MONITOR_TRIAL_H
#define SUPPORT_MONITOR_TRIAL_H

#include "cipc/invariant.h"
#include "support/hand_model.h"

typedef cipc_status monitor_function(cipc_monitor *, const double *, cipc_invariant_report *, cipc_error *);

/* The last look: what it said. */
typedef struct monitor_trial {
    cipc_status status;
    cipc_invariant_report report;
    cipc_error error;
} monitor_trial;

/* A new monitor looks at h->x. options NULL: the defaults. */
static inline monitor_trial try_monitor(monitor_function *look, const hand_model *h, const cipc_invariant_options *options)
{
    monitor_trial t = {.status = CIPC_OK};
    cipc_monitor *monitor;
    cipc_invariant_report_init(&t.report);
    t.status = cipc_monitor_create(&monitor, &h->model, options, &t.error);
    if (t.status == CIPC_OK) { t.status = look(monitor, h->x, &t.report, &t.error); }
    cipc_monitor_destroy(monitor);
    return t;
}

#endif
