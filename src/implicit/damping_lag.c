/* Stiffness-proportional Rayleigh damping: the elements' projected Hessians at the start of the step, which stay fixed while E is minimised (docs/theory/energies.md (R13)). In E it is
 * alpha beta h^2 (b/h) 1/2 d^T K d, d = x - x^n: the force -b K (x - x^n)/h of a velocity. */
#include "implicit/stepper.h"

#include "base/vector.h"
#include "implicit/psd_projection.h"

/* Stitches and limits are no material: they are not damped. */
static bool is_damped(int group) { return group != CIPC_GROUP_STITCH && !cipc_is_strain_limit(group); }

static double damping_of(const cipc_stepper *s, const int *nodes) { return s->model->bodies[s->model->node_body[nodes[0]]].material.damping_stiffness; }

static int count_damped(const cipc_stepper *s)
{
    int count = 0;
    for (int g = 0; g < CIPC_GROUP_COUNT; g++)
        for (int i = 0; is_damped(g) && i < s->groups[g].count; i++) count += damping_of(s, s->groups[g].nodes + s->groups[g].energy->nodes * i) > 0;
    return count;
}

static void lag_element(const cipc_stepper *s, const cipc_element_group *g, int i, cipc_damping *params, int nodes[4])
{
    double x[12], H[144];
    int count = g->energy->nodes;
    const int *own = g->nodes + count * i;
    for (int k = 0; k < count; k++) v3_copy(x + 3 * k, s->x_start + 3 * own[k]);
    g->energy->hessian(x, (const char *)g->params + g->energy->params_size * (size_t)i, H);
    cipc_psd_project(count, H, true);
    cipc_damping_init(params, damping_of(s, own) / s->options.time_step, count, x, H);
    for (int k = 0; k < 4; k++) nodes[k] = own[k < count ? k : 0];
}

cipc_status cipc_damping_lag(cipc_stepper *s, cipc_error *error)
{
    cipc_damping_set *set = &s->damping;
    if (!set->params) {
        int most = count_damped(s);
        set->params = cipc_alloc((size_t)most, sizeof *set->params);
        set->nodes = cipc_alloc((size_t)most, sizeof *set->nodes);
        if (!set->params || !set->nodes) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "damping", "no memory for %d elements", most);
    }
    set->count = 0;
    for (int g = 0; g < CIPC_GROUP_COUNT; g++)
        for (int i = 0; is_damped(g) && i < s->groups[g].count; i++) {
            if (!(damping_of(s, s->groups[g].nodes + s->groups[g].energy->nodes * i) > 0)) continue;
            lag_element(s, &s->groups[g], i, &set->params[set->count], set->nodes[set->count]);
            set->count++;
        }
    return CIPC_OK;
}
