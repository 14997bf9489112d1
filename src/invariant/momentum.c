/* Monitor M7: total linear momentum stays what it was from step to step, where nothing from outside acts (SPEC V.5; docs/monitors.md, "The
 * momentum bound"). */
#include "cipc/invariant.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"

static const char place[] = "monitor momentum";

#define UNIT (0.5 * DBL_EPSILON)
#define ROUNDINGS_OF_KICK 64 /* units, of the momentum of the nodes that a kick touches (docs/monitors.md, "The momentum bound of kicks") */

const char *cipc_momentum_source(const cipc_model *model)
{
    if (v3_norm2(model->gravity) > 0) { return "gravity"; }
    if (model->dirichlet_count > 0) { return "Dirichlet nodes"; }
    for (int b = 0; b < model->body_count; b++) {
        if (model->bodies[b].fixed) { return "Dirichlet nodes"; }
        if (model->bodies[b].material.damping_mass > 0) { return "mass damping"; }
    }
    return model->load_count > 0 ? "loads" : NULL;
}

double cipc_momentum_bound(const cipc_model *model, const double *x, const cipc_momentum_rule *rule)
{
    double mass = 0, mass2 = 0, moment = 0;
    for (int i = 0; i < model->node_count; i++) {
        mass += model->mass[i];
        mass2 += model->mass[i] * model->mass[i];
        moment += model->mass[i] * v3_norm(&x[3 * (size_t)i]);
    }
    double weight = rule->rms ? sqrt(model->node_count * mass2) : mass;
    return (rule->minimisations * weight * rule->tolerance + 8 * UNIT * moment / rule->time_step) / rule->beta;
}

/* sum m |v|. */
static double size_of_momentum(const cipc_model *m, const double *v)
{
    double sum = 0;
    for (int i = 0; i < m->node_count; i++) { sum += m->mass[i] * v3_norm(&v[3 * (size_t)i]); }
    return sum;
}

double cipc_momentum_rounding(const cipc_model *model, const double *v_before, const double *v_after, long kicks, double energy)
{
    double mass = 0;
    for (int i = 0; i < model->node_count; i++) { mass += model->mass[i]; }
    double size = fmax(fmax(size_of_momentum(model, v_before), size_of_momentum(model, v_after)), sqrt(2 * mass * fmax(energy, 0)));
    return ROUNDINGS_OF_KICK * ((double)kicks + model->node_count) * UNIT * size;
}

/* A sum carried along with what its rounding lost, and the sum of the magnitudes. */
typedef struct exact_sum {
    double high, low, size;
} exact_sum;

/* Add a * b: the product's error is a fused multiply-add away, the sum's by Knuth's two-sum. */
static void add_product(exact_sum *s, double a, double b)
{
    double product = a * b, product_low = fma(a, b, -product);
    double high = s->high + product, part = high - s->high;
    s->low += ((s->high - (high - part)) + (product - part)) + product_low;
    s->high = high;
    s->size += fabs(product);
}

/* The norm of sum m (after - before), and a bound of its rounding error in *error. */
static double momentum_change(const cipc_model *m, const double *before, const double *after, double *error)
{
    double change[3], terms = 2.0 * m->node_count, lost = 0;
    for (int k = 0; k < 3; k++) {
        exact_sum s = {0, 0, 0};
        for (int i = 0; i < m->node_count; i++) {
            add_product(&s, m->mass[i], after[3 * (size_t)i + (size_t)k]);
            add_product(&s, -m->mass[i], before[3 * (size_t)i + (size_t)k]);
        }
        change[k] = s.high + s.low;
        /* Twofold sums: u of the result, and the square of what a plain one loses (docs/monitors.md). */
        lost += 4 * terms * terms * UNIT * UNIT * s.size + terms * DBL_MIN;
    }
    double norm = v3_norm(change);
    *error = lost + 6 * UNIT * norm;
    return norm;
}

cipc_status cipc_monitor_momentum(const cipc_model *model, const double *v_before, const double *v_after, double bound, double *change,
                                  cipc_error *error)
{
    double rounding, norm = momentum_change(model, v_before, v_after, &rounding);
    *change = norm;
    if (!(bound >= 0) || !isfinite(bound)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "the bound on the change of momentum is %g; it must be finite and not negative", bound);
    }
    if (norm <= bound + rounding) { return CIPC_OK; }
    return cipc_fail(error, CIPC_E_VIOLATED_MOMENTUM, place,
                     "total momentum changed by %.17g (%a) kg m/s in a step without forces from outside, by more than %.17g (%a), which the "
                     "tolerance or the rounding of the step allows",
                     norm, norm, bound, bound);
}
