/* The strain limit on the iterate: feasibility, largest feasible step, stiffness adaptation (SPEC C.2). */
#include "implicit/stepper.h"

#include <math.h>

#include "base/vector.h"
#include "implicit/element_limits.h"

/* A step limited by strain ends this far of the way to the limit, so that the logarithm stays finite and the next step has room. */
static const double fraction_to_limit = 0.9;
/* Doubling rule of SPEC C.2: slack below this fraction of (s - shat) in two iterates; stiffness cap, Pa. */
static const double near_limit_fraction = 1e-4, stiffness_cap = 1e5;

/* The groups that have limits. */
typedef struct limited_group {
    int group;
    const element_limit *limit;
} limited_group;
static const limited_group limited[] = {{CIPC_GROUP_STRAIN_LIMIT, &implicit_limit_upper},
                                        {CIPC_GROUP_STRAIN_LIMIT_LOWER, &implicit_limit_lower},
                                        {CIPC_GROUP_ORTHOTROPIC, &implicit_limit_strains},
                                        {CIPC_GROUP_COROTATIONAL, &implicit_limit_volume},
                                        {CIPC_GROUP_VOLUME_NEO_HOOKEAN, &implicit_limit_volume}};
enum { LIMITED = sizeof limited / sizeof *limited };

/* Element i of a group: its constants, and whole-model vectors at its nodes. */
static const void *element_params(const cipc_element_group *g, int i) { return (const char *)g->params + g->energy->params_size * (size_t)i; }

static void gather(const cipc_element_group *g, int i, const double *x, double y[12])
{
    const int *nodes = g->nodes + g->energy->nodes * i;
    for (int k = 0; k < g->energy->nodes; k++) v3_copy(y + 3 * k, x + 3 * nodes[k]);
}

/* The predictor of a split step knows no strain limits. */
static int limited_count(const cipc_stepper *s, const limited_group *l)
{
    return s->stage == CIPC_STAGE_PREDICT && cipc_is_strain_limit(l->group) ? 0 : s->groups[l->group].count;
}

bool cipc_strain_feasible(const cipc_stepper *s, const double *x)
{
    bool good = true;
    for (const limited_group *l = limited; l < limited + LIMITED; l++) {
        const cipc_element_group *g = &s->groups[l->group];
        int count = limited_count(s, l);
#pragma omp parallel for schedule(static) num_threads(s->options.threads) reduction(&& : good)
        for (int i = 0; i < count; i++) {
            double y[12];
            gather(g, i, x, y);
            good = good && l->limit->slack(element_params(g, i), y) > 0;
        }
    }
    return good;
}

double cipc_strain_step(cipc_stepper *s, const double *x, const double *p)
{
    double step = 1;
    const int *limiting = NULL;
    int limiting_nodes = 0;
    for (const limited_group *l = limited; l < limited + LIMITED; l++) {
        const cipc_element_group *g = &s->groups[l->group];
        for (int i = 0, count = limited_count(s, l); i < count; i++) {
            double y[12], d[12];
            gather(g, i, x, y);
            gather(g, i, p, d);
            double own = implicit_limit_step(l->limit, element_params(g, i), g->energy->nodes, y, d, step);
            if (own == step) continue;
            step = own;
            limiting = g->nodes + g->energy->nodes * i;
            limiting_nodes = g->energy->nodes;
        }
    }
    if (!limiting) return 1;
    if (s->options.released) { /* SPEC R.2: halved from 1 until feasible */
        double halved = 1;
        while (halved > step) halved *= 0.5;
        step = halved / fraction_to_limit;
    }
    s->limit.what = limiting_nodes == 4 ? "inversion" : "strain limit";
    for (int k = 0; k < 4; k++) s->limit.nodes[k] = k < limiting_nodes ? limiting[k] : -1;
    return fraction_to_limit * step;
}

/* What is left of (s - shat), as a fraction, at the stretch nearest to the limit. */
static double slack(const cipc_stepper *s, int group, int i)
{
    double y[9], sigma[2];
    const cipc_element_group *g = &s->groups[group];
    const cipc_strain_limit *params = (const cipc_strain_limit *)g->params + i;
    for (int k = 0; k < 3; k++) v3_copy(y + 3 * k, s->x + 3 * g->nodes[3 * i + k]);
    cipc_principal_stretches(y, params->inverse_rest, sigma);
    return (params->limit - sigma[group == CIPC_GROUP_STRAIN_LIMIT_LOWER]) / (params->limit - params->activation);
}

bool cipc_strain_adapt(cipc_stepper *s)
{
    bool twice = false;
    if (s->stage == CIPC_STAGE_PREDICT) return false;
    for (int group = CIPC_GROUP_STRAIN_LIMIT, slot = 0; group <= CIPC_GROUP_STRAIN_LIMIT_LOWER; group++)
        for (int i = 0; i < s->groups[group].count; i++, slot++) {
            bool near = slack(s, group, i) < near_limit_fraction;
            twice = twice || (near && s->near_limit[slot]);
            s->near_limit[slot] = near;
        }
    if (!twice || s->max_strain_stiffness * s->strain_factor >= stiffness_cap) return false;
    s->strain_factor = fmin(2 * s->strain_factor, stiffness_cap / s->max_strain_stiffness);
    return true;
}
