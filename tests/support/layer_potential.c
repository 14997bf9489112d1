#include "support/layer_potential.h"

#include <math.h>

static double thickness(layer_law law, int l) { return law.thickness * pow(l, -0.25); }
static double stiffness(layer_law law, int l) { return law.stiffness * pow(l, 3); }

int layer_law_count(layer_law law, double gap)
{
    int n = 0;
    while (thickness(law, n + 1) > gap) n++;
    return n;
}

double layer_law_energy(layer_law law, double gap)
{
    double sum = 0;
    for (int l = 1; thickness(law, l) > gap; l++) sum += 0.5 * stiffness(law, l) * pow(thickness(law, l) - gap, 2);
    return sum;
}

double layer_law_force(layer_law law, double gap)
{
    double sum = 0;
    for (int l = 1; thickness(law, l) > gap; l++) sum += stiffness(law, l) * (thickness(law, l) - gap);
    return sum;
}

/* Both grow as the gap shrinks. */
static double gap_at(layer_law law, double (*of)(layer_law, double), double value)
{
    double low = 0.1 * law.thickness, high = law.thickness; /* 10,000 layers: more than any test reaches */
    for (int k = 0; k < 100; k++) {
        const double middle = 0.5 * (low + high);
        if (of(law, middle) > value) low = middle;
        else high = middle;
    }
    return 0.5 * (low + high);
}

double layer_law_gap_at_energy(layer_law law, double energy) { return gap_at(law, layer_law_energy, energy); }
double layer_law_gap_at_force(layer_law law, double force) { return gap_at(law, layer_law_force, force); }

/* t = integral of dx/v from the turning gap d on, v^2 = 2 (K - V(x))/m; with x = d + u^2 the integrand is bounded: v ~ u. */
double layer_law_times(layer_law law, double mass, double speed, int count, double *times)
{
    enum { PIECES = 4000 };
    const double energy = 0.5 * mass * speed * speed, d = layer_law_gap_at_energy(law, energy), end = sqrt(law.thickness - d);
    double t = 0;
    for (int i = 0, l = count; i < PIECES; i++) {
        const double du = end / PIECES, u = (i + 0.5) * du, left = energy - layer_law_energy(law, d + u * u);
        while (l >= 1 && !(thickness(law, l) > d + i * i * du * du)) times[l--] = 2 * t;
        t += 2 * u * du / sqrt(2 * left / mass);
        if (i == PIECES - 1)
            for (; l >= 1; l--) times[l] = 2 * t;
    }
    return d;
}

double layer_law_step(layer_law law, double mass, double gamma, int layer) { return gamma * 2 / sqrt(stiffness(law, layer) / mass); }
