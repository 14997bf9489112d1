/* Random stencils: laid out in a frame where the closest points lie above one another, then turned and shifted. */
#include "verify/stencils.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

double verify_uniform(gsl_rng *rng, double low, double high) { return low + (high - low) * gsl_rng_uniform(rng); }

double verify_log_uniform(gsl_rng *rng, double low, double high) { return exp(verify_uniform(rng, log(low), log(high))); }

int verify_index(gsl_rng *rng, int count) { return (int)gsl_rng_uniform_int(rng, (unsigned long)count); }

bool verify_chance(gsl_rng *rng, double share) { return gsl_rng_uniform(rng) < share; }

verify_shape verify_shape_default(void) { return (verify_shape){.size = 1, .gap = 0.1, .angle = 1, .approach = 0.5}; }

/* Parameter of a closest point on an edge or towards a side. */
static double draw_foot(gsl_rng *rng, double near_end)
{
    if (near_end > 0) return verify_chance(rng, 0.5) ? near_end : 1 - near_end;
    return verify_uniform(rng, 0.1, 0.9);
}

/* Both primitives around the origin, the first one raised by h. */
static void lay_out(gsl_rng *rng, cipc_pair_kind kind, const verify_shape *shape, double h, double x[12])
{
    double foot = draw_foot(rng, shape->foot), other = draw_foot(rng, 0), c = cos(shape->angle), s = sin(shape->angle), length = verify_uniform(rng, 0.5, 1);
    memset(x, 0, 12 * sizeof *x);
    x[2] = h;
    switch (kind) {
    case CIPC_POINT_POINT: break;
    case CIPC_POINT_EDGE:
        x[3] = -foot;
        x[6] = 1 - foot;
        break;
    case CIPC_POINT_TRIANGLE: /* base along the first axis, height s; the origin at the weights (1 - other) (1 - foot), (1 - other) foot, other */
        x[3] = -foot * (1 - other) - other * 0.4, x[4] = -other * s;
        x[6] = x[3] + 1, x[7] = x[4];
        x[9] = x[3] + 0.4, x[10] = x[4] + s;
        break;
    default: /* the first edge crosses above the second */
        x[0] = -other * length * c, x[1] = -other * length * s;
        x[3] = (1 - other) * length * c, x[4] = (1 - other) * length * s, x[5] = h;
        x[6] = -foot;
        x[9] = 1 - foot;
        break;
    }
}

/* Columns of a random rotation (a unit quaternion drawn in the ball). */
static void draw_rotation(gsl_rng *rng, bool aligned, double R[3][3])
{
    double q[4] = {1, 0, 0, 0}, norm2 = 1;
    while (!aligned) {
        norm2 = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = verify_uniform(rng, -1, 1);
            norm2 += q[i] * q[i];
        }
        if (norm2 <= 1 && norm2 >= 0.01) break;
    }
    double s = 2 / norm2, w = q[0], x = q[1], y = q[2], z = q[3];
    const double columns[3][3] = {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
                                  {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
                                  {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
    memcpy(R, columns, sizeof columns);
}

static void turn(double R[3][3], double size, const double v[3], double r[3])
{
    for (int k = 0; k < 3; k++) r[k] = size * (v[0] * R[0][k] + v[1] * R[1][k] + v[2] * R[2][k]);
}

void verify_place(gsl_rng *rng, cipc_pair_kind kind, const verify_shape *shape, cipc_stencil_path *path)
{
    double x[12], R[3][3], shift[3], common[3], turned[3], across = verify_uniform(rng, 0, 6.3);
    *path = (cipc_stencil_path){.kind = kind};
    lay_out(rng, kind, shape, shape->thickness + shape->gap, x);
    draw_rotation(rng, shape->aligned, R);
    for (int k = 0; k < 3; k++) {
        shift[k] = shape->size * shape->offset * verify_uniform(rng, -1, 1);
        common[k] = shape->size * shape->common * verify_uniform(rng, -1, 1);
    }
    for (int i = 0; i < cipc_pair_nodes(kind); i++) {
        double p[3];
        turn(R, shape->size, x + 3 * i, turned);
        v3_add(path->x + 3 * i, turned, shift);
        bool moves = i < cipc_pair_first_nodes(kind);
        p[0] = moves ? shape->slide * cos(across) : 0;
        p[1] = moves ? shape->slide * sin(across) : 0;
        p[2] = moves ? -shape->approach : 0;
        for (int k = 0; k < 3; k++) p[k] += shape->tumble * verify_uniform(rng, -1, 1);
        turn(R, shape->size, p, turned);
        v3_add(path->p + 3 * i, turned, common);
    }
}
