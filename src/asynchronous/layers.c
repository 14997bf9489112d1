/* Discrete penalty layers: thickness, stiffness, step (SPEC A.4, A.5; docs/theory/asynchronous.md (3), (5), (6)). */
#include "cipc/asynchronous.h"

#include <limits.h>
#include <math.h>

/* l^(-1/4), of two correctly rounded square roots. */
static double inverse_fourth_root(double l) { return 1 / sqrt(sqrt(l)); }

double cipc_layer_thickness(double thickness, int layer) { return thickness * inverse_fourth_root(layer); }

double cipc_layer_stiffness(double stiffness, int layer)
{
    const double l = layer;
    return stiffness * (l * l * l);
}

double cipc_layer_step(double stiffness, double mass, double factor, int layer)
{
    return factor * 2 / sqrt(cipc_layer_stiffness(stiffness, layer) * 2 / mass);
}

/* The closed form floor((eta1/gap)^4) is a guess whose neighbours are asked, because the layers' own rounded thickness decides. */
int cipc_layer_count(double thickness, double gap)
{
    if (!(gap > 0)) return INT_MAX;
    const double ratio = thickness / gap, guess = ratio * ratio * ratio * ratio;
    if (!(guess < INT_MAX - 2)) return INT_MAX;
    int n = (int)guess;
    while (n > 0 && !(cipc_layer_thickness(thickness, n) > gap)) n--;
    while (cipc_layer_thickness(thickness, n + 1) > gap) n++;
    return n;
}

double cipc_layer_energy(double thickness, double stiffness, double gap)
{
    const int count = cipc_layer_count(thickness, gap);
    double sum = 0;
    if (count == INT_MAX) return INFINITY;
    for (int l = count; l >= 1; l--) { /* the smallest terms first */
        const double overlap = cipc_layer_thickness(thickness, l) - gap;
        sum += 0.5 * cipc_layer_stiffness(stiffness, l) * overlap * overlap;
    }
    return sum;
}
