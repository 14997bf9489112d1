/* The largest stable step of semi-implicit Euler with springs (docs/theory/massspring_springs.md (7)-(10)). */
#include "base/vector.h"
#include "cipc/massspring.h"

/* Stiffness that a spring shows at most, N/m. A buckled one is steepest when its ends meet: 12 pi^2 k_b/L^3 (6). */
static double greatest_stiffness(const cipc_spring *s)
{
    if (s->form != CIPC_SPRING_BUCKLING) return s->stiffness;
    return max2(s->stiffness, 12 * M_PI * M_PI * s->bending / (s->length * s->length * s->length));
}

/* Sums over the springs of one node: rows of K and C in absolute values. A held end has no column. */
static void add_spring(const cipc_spring *s, double inverse_mass, bool other_is_held, double *stiffness, double *damping)
{
    const double weight = inverse_mass * (other_is_held ? 1 : 2);
    *stiffness += weight * greatest_stiffness(s);
    *damping += weight * s->damping;
}

/* (9): h^2 k + 2 h c = 4, the form without a difference of near numbers. */
static double limit_of(double k, double c) { return k > 0 || c > 0 ? 4 / (c + hypot(c, 2 * sqrt(k))) : INFINITY; }

double cipc_spring_stable_step(const cipc_spring *springs, const int (*ends)[2], int count, double push, double drag, const double *inverse_mass, int node_count)
{
    double *sums = cipc_alloc(2 * (size_t)node_count, sizeof *sums), step = INFINITY;
    if (!sums) return (double)NAN;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const int node = ends[i][k], other = ends[i][1 - k];
            add_spring(&springs[i], inverse_mass[node], !(inverse_mass[other] > 0), &sums[2 * node], &sums[2 * node + 1]);
        }
    }
    for (int i = 0; i < node_count; i++)
        if (inverse_mass[i] > 0) step = min2(step, limit_of(sums[2 * i] + inverse_mass[i] * push, sums[2 * i + 1] + drag));
    cipc_free(sums);
    return step;
}
