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

/* The groups that have limits, and whether an element of theirs at y keeps its own by the margin. */
static bool keeps_upper(const void *params, const double *y)
{
    const cipc_strain_limit *p = params;
    double sigma[2];
    cipc_principal_stretches(y, p->inverse_rest, sigma);
    return sigma[0] < p->limit * (1 - stretch_margin);
}

static bool keeps_lower(const void *params, const double *y)
{
    const cipc_strain_limit *p = params;
    double sigma[2];
    cipc_principal_stretches(y, p->inverse_rest, sigma);
    return sigma[1] > p->limit * (1 + stretch_margin);
}

/* A Green strain has an error of some u of what it is a difference of, 1 + 2 |E|, not of itself. */
static bool keeps_strain(double strain, double limit) { return fabs(strain) < limit - stretch_margin * (1 + 2 * fabs(strain)); }

static bool keeps_strains(const void *params, const double *y)
{
    const cipc_orthotropic *p = params;
    double f1[3], f2[3];
    for (int k = 0; k < 3; k++) {
        double a = y[3 + k] - y[k], b = y[6 + k] - y[k];
        f1[k] = p->warp[0] * a + p->warp[1] * b;
        f2[k] = p->weft[0] * a + p->weft[1] * b;
    }
    return keeps_strain(0.5 * (v3_norm2(f1) - 1), p->limit11) && keeps_strain(0.5 * (v3_norm2(f2) - 1), p->limit22) &&
           keeps_strain(0.5 * (v3_dot(f1, f2) - p->rest_cosine), p->limit12);
}

/* Volume against the product of the edges' lengths: its sign is then that of the exact volume. */
static bool keeps_volume(const void *params, const double *y)
{
    double e[3][3], n[3];
    (void)params;
    for (int i = 0; i < 3; i++) v3_sub(e[i], y + 3 + 3 * i, y);
    v3_cross(n, e[0], e[1]);
    return v3_dot(n, e[2]) > stretch_margin * v3_norm(e[0]) * v3_norm(e[1]) * v3_norm(e[2]);
}

typedef struct limited_group {
    int group;
    bool (*keeps)(const void *params, const double *y);
} limited_group;
static const limited_group limited[] = {
    {CIPC_GROUP_STRAIN_LIMIT, keeps_upper}, {CIPC_GROUP_STRAIN_LIMIT_LOWER, keeps_lower}, {CIPC_GROUP_ORTHOTROPIC, keeps_strains}, {CIPC_GROUP_COROTATIONAL, keeps_volume}, {CIPC_GROUP_VOLUME_NEO_HOOKEAN, keeps_volume}};
enum { LIMITED = sizeof limited / sizeof *limited };

/* Does element i at x + alpha p keep its limit? The predictor of a split step knows no strain limits. */
static bool keeps_limit(const cipc_stepper *s, const limited_group *l, int i, const double *x, const double *p, double alpha)
{
    double y[12];
    const cipc_element_group *g = &s->groups[l->group];
    const int *nodes = g->nodes + g->energy->nodes * i;
    for (int k = 0; k < g->energy->nodes; k++) {
        v3_copy(y + 3 * k, x + 3 * nodes[k]);
        if (p) v3_axpy(y + 3 * k, alpha, p + 3 * nodes[k]);
    }
    return l->keeps((const char *)g->params + g->energy->params_size * (size_t)i, y);
}

static int limited_count(const cipc_stepper *s, const limited_group *l)
{
    return s->stage == CIPC_STAGE_PREDICT && cipc_is_strain_limit(l->group) ? 0 : s->groups[l->group].count;
}

bool cipc_strain_feasible(const cipc_stepper *s, const double *x)
{
    bool good = true;
    for (const limited_group *l = limited; l < limited + LIMITED; l++) {
        int count = limited_count(s, l);
#pragma omp parallel for schedule(static) num_threads(s->options.threads) reduction(&& : good)
        for (int i = 0; i < count; i++) good = good && keeps_limit(s, l, i, x, NULL, 0);
    }
    return good;
}

/* The end of a step at which element i keeps its limit, by bisection of [0, step]. */
static double feasible_end(const cipc_stepper *s, const limited_group *l, int i, const double *x, const double *p, double step)
{
    double low = 0, high = step;
    for (int k = 0; k < BISECTIONS; k++) {
        double middle = 0.5 * (low + high);
        if (keeps_limit(s, l, i, x, p, middle)) low = middle;
        else high = middle;
    }
    return low;
}

/* sigma_1 is a convex function of the positions (a norm of F), so for an upper limit the feasible steps along a line are an interval from 0. The other limits are not convex: there
 * the step found is feasible, but need not be the largest. An element that an earlier one has cut the step for is looked at again when the point is tried. */
double cipc_strain_step(cipc_stepper *s, const double *x, const double *p)
{
    double step = 1;
    const int *limiting = NULL;
    int limiting_nodes = 0;
    for (const limited_group *l = limited; l < limited + LIMITED; l++) {
        const cipc_element_group *g = &s->groups[l->group];
        for (int i = 0, count = limited_count(s, l); i < count; i++) {
            if (keeps_limit(s, l, i, x, p, step)) continue;
            step = feasible_end(s, l, i, x, p, step);
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
