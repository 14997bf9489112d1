/* The verdicts of a run as JUnit XML: how it ended, and each invariant. */
#include "cipc/output.h"

#include <stdio.h>
#include <string.h>
#include "output/junit.h"

enum { INVARIANT_COUNT = 8 };

static const char *const names[INVARIANT_COUNT + 1] = {
    "steps: every step converged",
    "M1: no two surfaces intersect",
    "M2: no gap is at its thickness or below",
    "M3: no strain is at its limit or beyond",
    "M4: no tetrahedron is inverted",
    "M5: nothing meets between two accepted points",
    "M6: the potential falls, the residual is below the tolerance",
    "M7: momentum is kept from step to step",
    "M8: every number is finite",
};

/* Why a monitor has no verdict. */
static const char *unchecked_reason(const cipc_run_summary *s, int invariant)
{
    if (!s->monitored) { return "the monitors are off"; }
    if (s->method == CIPC_METHOD_MASS_SPRING && invariant == 5) { return "the method mass-spring makes no claim about paths"; }
    if (s->method == CIPC_METHOD_MASS_SPRING && invariant == 6) { return "explicit steps minimise no potential"; }
    if (invariant == 3 && s->limited_triangles == 0) { return "nothing in the scene has a strain limit"; }
    if (invariant == 4 && s->tetrahedra == 0) { return "the scene has no tetrahedron"; }
    if (invariant == 5 && !s->swept) { return "monitor.swept is off"; }
    if (invariant == 6 && s->method == CIPC_METHOD_ASYNCHRONOUS) { return "the energy oscillates"; }
    if (invariant == 7 && s->momentum_source != NULL) { return s->momentum_source; }
    return s->status == CIPC_E_INDETERMINATE ? "the exact arithmetic gave up at a point" : "no accepted point was looked at";
}

/* What the method mass-spring does not guarantee, as the summary has it. */
static void put_count(const cipc_run_summary *s, int invariant, cipc_junit_case *c)
{
    const cipc_counted *counted = invariant == 1 ? &s->massspring.intersecting : &s->massspring.too_near;
    snprintf(c->message, sizeof c->message, "counted, not guaranteed by the method mass-spring: %ld of %ld frames%s%s", counted->frames, s->massspring.frames,
             counted->frames > 0 ? "; the first: " : "", counted->frames > 0 ? counted->first.what : "");
}

static void put_error(cipc_junit_case *c, const cipc_error *error)
{
    if (error != NULL) {
        snprintf(c->message, sizeof c->message, "%s: CIPC-%d: %s: %s", error->place, (int)error->status, error->what, error->remedy);
    }
}

/* The run itself: a broken invariant has a case of its own, and of the steps nothing is known then. */
static void judge_steps(const cipc_run_summary *s, bool violated, cipc_junit_case *c)
{
    if (violated) {
        c->outcome = CIPC_JUNIT_SKIPPED;
        snprintf(c->message, sizeof c->message, "an invariant broke in step %d of %d", s->steps_taken + 1, s->steps_asked);
    } else if (s->status != CIPC_OK) {
        c->outcome = CIPC_JUNIT_ERROR;
        put_error(c, s->error);
    } else if (s->interrupted || s->steps_taken < s->steps_asked) {
        c->outcome = CIPC_JUNIT_ERROR;
        snprintf(c->message, sizeof c->message, "interrupted after step %d of %d: go on with --resume", s->steps_taken, s->steps_asked);
    } else if (!s->converged) {
        c->outcome = CIPC_JUNIT_FAILED;
        snprintf(c->message, sizeof c->message, "a step did not converge");
    }
}

cipc_status cipc_summary_junit(const char *path, const cipc_run_summary *summary, cipc_error *error)
{
    cipc_junit_case cases[INVARIANT_COUNT + 1];
    memset(cases, 0, sizeof cases);
    bool violated = false;
    for (int i = 0; i <= INVARIANT_COUNT; i++) {
        cases[i].suite = summary->scene_name != NULL ? summary->scene_name : "cipc run";
        cases[i].name = names[i];
    }
    for (int i = 1; i <= INVARIANT_COUNT; i++) {
        const char *verdict = cipc_run_summary_verdict(summary, i);
        if (strcmp(verdict, "violated") == 0) {
            violated = true;
            cases[i].outcome = CIPC_JUNIT_FAILED;
            put_error(&cases[i], summary->error);
        } else if (strcmp(verdict, "holds") != 0) {
            cases[i].outcome = CIPC_JUNIT_SKIPPED;
            if (strcmp(verdict, "counted") == 0) {
                put_count(summary, i, &cases[i]);
            } else {
                snprintf(cases[i].message, sizeof cases[i].message, "not checked: %s", unchecked_reason(summary, i));
            }
        }
    }
    judge_steps(summary, violated, &cases[0]);
    return cipc_junit_write(path, cases, INVARIANT_COUNT + 1, error);
}
