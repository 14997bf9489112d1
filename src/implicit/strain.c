/* The strain limit on the iterate: feasibility, largest feasible step, stiffness adaptation (SPEC C.2). */
#include "implicit/stepper.h"

#include <math.h>

#include "base/vector.h"

/* A stretch is computed with a relative error below 2^-46 (a dozen operations on well-scaled 2x2 and 3x2 products): staying below the limit by that
 * much keeps the exact stretch below it, which is what the monitor asserts. */
static const double stretch_margin = 0x1p-46;
/* Halvings of the interval when the largest feasible step is sought: the step is then known to 2^-20 of itself. */
enum { BISECTIONS = 20 };
/* A step limited by strain ends this far of the way to the limit, so that the logarithm stays finite and the next step has room. */
static const double fraction_to_limit = 0.9;
/* Doubling rule of SPEC C.2: slack below this fraction of (s - shat) in two iterates; stiffness cap, Pa. */
static const double near_limit_fraction = 1e-4, stiffness_cap = 1e5;

static const cipc_strain_limit *limit_params(const cipc_stepper *s, int i) { return (const cipc_strain_limit *)s->groups[CIPC_GROUP_STRAIN_LIMIT].params + i; }

/* sigma_1 of limited triangle i at x + alpha p. */
static double stretch(const cipc_stepper *s, int i, const double *x, const double *p, double alpha)
{
    double y[9], sigma[2];
    const int *nodes = s->groups[CIPC_GROUP_STRAIN_LIMIT].nodes + 3 * i;
    for (int k = 0; k < 3; k++) {
        v3_copy(y + 3 * k, x + 3 * nodes[k]);
        if (p) v3_axpy(y + 3 * k, alpha, p + 3 * nodes[k]);
    }
    cipc_principal_stretches(y, limit_params(s, i)->inverse_rest, sigma);
    return sigma[0];
}

static bool below_limit(const cipc_stepper *s, int i, const double *x, const double *p, double alpha)
{
    return stretch(s, i, x, p, alpha) < limit_params(s, i)->limit * (1 - stretch_margin);
}

bool cipc_strain_feasible(const cipc_stepper *s, const double *x)
{
    bool good = true;
    if (s->stage == CIPC_STAGE_PREDICT) return true;
#pragma omp parallel for schedule(static) num_threads(s->options.threads) reduction(&& : good)
    for (int i = 0; i < s->groups[CIPC_GROUP_STRAIN_LIMIT].count; i++) good = good && below_limit(s, i, x, NULL, 0);
    return good;
}

/* sigma_1 is a convex function of the positions (a norm of F), so along a line the feasible steps are an interval from 0: bisection finds its end. */
double cipc_strain_step(cipc_stepper *s, const double *x, const double *p)
{
    double step = 1;
    int limiting = -1;
    if (s->stage == CIPC_STAGE_PREDICT) return 1;
    for (int i = 0; i < s->groups[CIPC_GROUP_STRAIN_LIMIT].count; i++) {
        if (below_limit(s, i, x, p, step)) continue;
        double low = 0, high = step;
        for (int k = 0; k < BISECTIONS; k++) {
            double middle = 0.5 * (low + high);
            if (below_limit(s, i, x, p, middle)) low = middle;
            else high = middle;
        }
        step = low;
        limiting = i;
    }
    if (limiting < 0) return 1;
    if (s->options.released) { /* SPEC R.2: halved from 1 until feasible */
        double halved = 1;
        while (halved > step) halved *= 0.5;
        step = halved / fraction_to_limit;
    }
    s->limit.what = "strain limit";
    for (int k = 0; k < 3; k++) s->limit.nodes[k] = s->groups[CIPC_GROUP_STRAIN_LIMIT].nodes[3 * limiting + k];
    s->limit.nodes[3] = -1;
    return fraction_to_limit * step;
}

bool cipc_strain_adapt(cipc_stepper *s)
{
    bool twice = false;
    if (s->stage == CIPC_STAGE_PREDICT) return false;
    for (int i = 0; i < s->groups[CIPC_GROUP_STRAIN_LIMIT].count; i++) {
        const cipc_strain_limit *params = limit_params(s, i);
        bool near = params->limit - stretch(s, i, s->x, NULL, 0) < near_limit_fraction * (params->limit - params->activation);
        twice = twice || (near && s->near_limit[i]);
        s->near_limit[i] = near;
    }
    if (!twice || s->max_strain_stiffness * s->strain_factor >= stiffness_cap) return false;
    s->strain_factor = fmin(2 * s->strain_factor, stiffness_cap / s->max_strain_stiffness);
    return true;
}
