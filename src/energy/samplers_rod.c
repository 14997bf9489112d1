/* Samplers of the energies of rods and stitches: hair of 80 um to ropes, segments of 0.1 mm to 0.1 m. */
#include "base/vector.h"
#include "energy/samplers.h"

const char *const energy_rod_stretching_branch_names[ENERGY_ROD_STRETCHING_BRANCHES] = {"rest", "stretched", "compressed", "short"};
enum { REST = 0, STRETCHED, COMPRESSED, SHORT };
static const double REST_STRAIN = 1e-6, SHORT_STRETCH = 0.05;

void energy_sample_rod_stretching(gsl_rng *rng, int branch, double *x, void *params)
{
    double length = energy_draw_log(rng, 1e-4, 0.1), stretch = 1, rest[6] = {0};
    rest[3] = length;
    (void)cipc_rod_stretching_init(params, rest, energy_draw_log(rng, 5e-5, 1e-2), energy_draw_log(rng, 1e3, 1e9));
    if (branch == STRETCHED) stretch = energy_draw_uniform(rng, 1.0001, 3);
    if (branch == COMPRESSED) stretch = energy_draw_uniform(rng, 1.01 * SHORT_STRETCH, 0.9999);
    if (branch == SHORT) stretch = energy_draw_log(rng, 1e-4, 0.99 * SHORT_STRETCH);
    double local[6] = {0, 0, 0, stretch * length, 0, 0};
    energy_draw_placement(rng, length, 2, local, x);
}

int energy_branch_rod_stretching(const double *x, const void *params)
{
    double e[3];
    v3_sub(e, x + 3, x);
    double stretch = v3_norm(e) / ((const cipc_rod_stretching *)params)->length;
    if (stretch < SHORT_STRETCH) return SHORT;
    if (fabs(stretch - 1) < REST_STRAIN) return REST;
    return stretch > 1 ? STRETCHED : COMPRESSED;
}

/* Five shapes with a straight rest shape, four with a curved one: that energy has the tip of a cone where the joint is straight. */
const char *const energy_rod_bending_branch_names[ENERGY_ROD_BENDING_BRANCHES] = {
    "straight", "small", "large", "folded", "uneven", "small_curved_rest", "large_curved_rest", "folded_curved_rest", "uneven_curved_rest",
};
enum { STRAIGHT = 0, SMALL, LARGE, FOLDED, UNEVEN, CURVED = 4 };
static const double STRAIGHT_ANGLE = 1e-7, SMALL_ANGLE = 0.1, FOLDED_ANGLE = 2.8, UNEVEN_RATIO = 0.02;

static double draw_turn(gsl_rng *rng, int shape, bool curved)
{
    double large = energy_draw_uniform(rng, 1.01 * SMALL_ANGLE, 0.99 * FOLDED_ANGLE);
    if (shape == STRAIGHT) return 0;
    if (shape == SMALL) return energy_draw_log(rng, curved ? 0.02 : 1e-6, 0.99 * SMALL_ANGLE);
    return shape == FOLDED ? 3.14159 - energy_draw_log(rng, 1e-3, 0.3) : large;
}

void energy_sample_rod_bending(gsl_rng *rng, int branch, double *x, void *params)
{
    bool curved = branch > UNEVEN;
    int shape = curved ? branch - CURVED : branch;
    double length = energy_draw_log(rng, 1e-4, 0.1), other = length * energy_draw_log(rng, 0.3, 3), turn = draw_turn(rng, shape, curved);
    if (shape == UNEVEN) other = length * energy_draw_log(rng, 1e-3, 0.9 * UNEVEN_RATIO);
    double rest_turn = energy_draw_uniform(rng, 0.05, 2.5), diameter = energy_draw_log(rng, 5e-5, 1e-2), young = energy_draw_log(rng, 1e3, 1e9);
    double rest[9] = {-length, 0, 0, 0, 0, 0, other * cos(rest_turn), other * sin(rest_turn), 0};
    double local[9] = {-length, 0, 0, 0, 0, 0, other * cos(turn), other * sin(turn), 0};
    (void)cipc_rod_bending_init(params, rest, diameter, young, curved);
    energy_draw_placement(rng, length, 3, local, x);
}

int energy_branch_rod_bending(const double *x, const void *params)
{
    double a[3], b[3], n[3];
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 6, x + 3);
    v3_cross(n, a, b);
    double turn = atan2(v3_norm(n), v3_dot(a, b)), ratio = v3_norm(b) / v3_norm(a);
    int rest = ((const cipc_rod_bending *)params)->rest_curvature > 0 ? CURVED : 0;
    if (ratio < UNEVEN_RATIO || ratio > 1 / UNEVEN_RATIO) return rest + UNEVEN;
    if (turn < STRAIGHT_ANGLE && rest == 0) return STRAIGHT;
    if (turn < SMALL_ANGLE) return rest + SMALL;
    return rest + (turn < FOLDED_ANGLE ? LARGE : FOLDED);
}

const char *const energy_stitch_branch_names[ENERGY_STITCH_BRANCHES] = {"first_end", "inside", "second_end"};

void energy_sample_stitch(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_stitch *p = params;
    p->stiffness = energy_draw_log(rng, 1, 1e4);
    p->ratio = branch == 1 ? energy_draw_uniform(rng, 0.01, 0.99) : branch / 2;
    double size = energy_draw_log(rng, 1e-3, 1);
    double local[9] = {0, 0, 0, size, 0, 0, energy_draw_uniform(rng, -1, 1) * size, size, 0};
    energy_draw_placement(rng, size, 3, local, x);
}

int energy_branch_stitch(const double *x, const void *params)
{
    double ratio = ((const cipc_stitch *)params)->ratio;
    (void)x;
    return ratio == 0 ? 0 : ratio == 1 ? 2 : 1;
}
