/* Random numbers and shapes that the samplers are made of. */
#include "base/vector.h"
#include "energy/samplers.h"

double energy_draw_uniform(gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

double energy_draw_log(gsl_rng *rng, double low, double high)
{
    return exp(energy_draw_uniform(rng, log(low), log(high)));
}

int energy_draw_index(gsl_rng *rng, int count)
{
    return (int)gsl_rng_uniform_int(rng, (unsigned long)count);
}

/* Columns of the rotation of a unit quaternion, drawn in the ball by rejection. */
void energy_draw_rotation(gsl_rng *rng, double columns[3][3])
{
    double q[4], norm2;
    do {
        norm2 = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = energy_draw_uniform(rng, -1, 1);
            norm2 += q[i] * q[i];
        }
    } while (norm2 > 1 || norm2 < 0.01);
    double s = 2 / norm2, w = q[0], x = q[1], y = q[2], z = q[3];
    double first[3] = {1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)};
    double second[3] = {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)};
    v3_copy(columns[0], first);
    v3_copy(columns[1], second);
    v3_cross(columns[2], first, second);
}

void energy_draw_placement(gsl_rng *rng, double reach, int nodes, const double *local, double *x)
{
    double R[3][3], shift[3];
    energy_draw_rotation(rng, R);
    for (int k = 0; k < 3; k++) shift[k] = energy_draw_uniform(rng, -reach, reach);
    for (int i = 0; i < nodes; i++) {
        const double *p = local + 3 * i;
        for (int k = 0; k < 3; k++) x[3 * i + k] = shift[k] + p[0] * R[0][k] + p[1] * R[1][k] + p[2] * R[2][k];
    }
}

void energy_draw_triangle(gsl_rng *rng, double size, double flattest, double rest[9])
{
    double foot = energy_draw_uniform(rng, -0.2, 1.2), height = energy_draw_log(rng, flattest, 1.5);
    double local[9] = {0, 0, 0, size, 0, 0, foot * size, height * size, 0};
    for (int i = 0; i < 9; i++) rest[i] = local[i];
}
