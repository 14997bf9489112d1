/* Springs between two nodes: linear, in tension only, buckling (SPEC B.1; docs/theory/massspring_springs.md (1)-(6)). */
#include "base/vector.h"
#include "massspring/spring_force.h"

/* Coefficients of h(w) = 1 - sin(u)/u = w/3! - w^2/5! + ..., w = u^2. The terms left out are below 1e-17 of the first one up to w = pi^2; no two that matter cancel there, so that
 * Horner's rule gives all digits from u = 0 to pi, where 1 - sin(u)/u itself would lose them near 0. */
enum { TERMS = 14 };

typedef struct shortening {
    double value, slope; /* h and dh/dw */
} shortening;

static shortening shortening_of(double w)
{
    shortening h = {0, 0};
    for (int k = TERMS; k >= 1; k--) { /* h = w/(2 3) (1 - w/(4 5) (1 - ...)): inside out, its derivative beside it */
        const double c = 1.0 / (2 * k * (2 * k + 1)), inner = 1 - h.value;
        h.slope = c * (inner - w * h.slope);
        h.value = c * w * inner;
    }
    return h;
}

/* w with h(w) = q, 0 <= q <= 1. h is concave up to w = pi^2 and below w/6: Newton's method starts below the root, stays below it and rises to it; it has arrived when it rises no more. */
static double half_angle2(double q)
{
    enum { STEPS_MAX = 32 };
    double w = 6 * q;
    for (int i = 0; i < STEPS_MAX; i++) {
        const shortening h = shortening_of(w);
        const double next = w + (q - h.value) / h.slope;
        if (!(next > w)) break;
        w = next;
    }
    return w;
}

/* (4): k_b kappa^2 / (cos u - sin(u)/u) with u = kappa L/2; the bracket is -2 w h'(w), and w cancels. */
static double buckled(const cipc_spring *s, double r)
{
    const double w = half_angle2((s->length - r) / s->length);
    return -2 * s->bending / (s->length * s->length * shortening_of(w).slope);
}

double cipc_spring_tension(const cipc_spring *spring, double r)
{
    const double linear = spring->stiffness * (r - spring->length);
    if (r >= spring->length || spring->form == CIPC_SPRING_LINEAR) return linear;
    if (spring->form == CIPC_SPRING_TENSION) return 0;
    return max2(linear, buckled(spring, r)); /* both are negative: the weaker push */
}

/* (5): k_b L kappa^2/2 = 2 k_b w/L, whose slope is (4). */
static double buckled_energy(const cipc_spring *s, double r) { return 2 * s->bending * half_angle2((s->length - r) / s->length) / s->length; }

/* Where the push of the buckled spring has become the weaker one, by bisection; the length if it is so at once, 0 if it never is. */
static double give_way(const cipc_spring *s)
{
    double linear_rules = s->length, buckled_rules = 0; /* the push (4) begins at 12 k_b/L^2, the linear one at 0 */
    if (!(buckled(s, 0) > -s->stiffness * s->length)) return 0;
    for (double middle = 0.5 * s->length; middle > buckled_rules && middle < linear_rules; middle = 0.5 * (buckled_rules + linear_rules)) {
        if (buckled(s, middle) > s->stiffness * (middle - s->length)) buckled_rules = middle;
        else linear_rules = middle;
    }
    return buckled_rules;
}

double cipc_spring_energy(const cipc_spring *spring, double r)
{
    const double longer = r - spring->length, linear = 0.5 * spring->stiffness * longer * longer;
    if (r >= spring->length || spring->form == CIPC_SPRING_LINEAR) return linear;
    if (spring->form == CIPC_SPRING_TENSION) return 0;
    const double from = give_way(spring);
    if (r >= from) return linear;
    return 0.5 * spring->stiffness * (from - spring->length) * (from - spring->length) + (buckled_energy(spring, r) - buckled_energy(spring, from));
}

void cipc_spring_force(const cipc_spring *spring, const double x[6], const double v[6], double f[3]) { massspring_spring_force(spring, x, x + 3, v, v + 3, f); }

double cipc_spring_stiffness_of_sheet(double young, double thickness) { return 0.5 * sqrt(3.0) * young * thickness; }
