/* Sampler of the two energies of tetrahedra, which have the same branches. */
#include "base/vector.h"
#include "energy/samplers.h"
#include "energy/volume.h"

const char *const energy_volume_branch_names[ENERGY_VOLUME_BRANCHES] = {
    "rest", "strained", "stretched", "compressed", "mixed", "flattened", "needle", "near_equal",
};
enum { REST = 0, STRAINED, STRETCHED, COMPRESSED, MIXED, FLATTENED, NEEDLE, NEAR_EQUAL };
static const double REST_STRAIN = 1e-10, SMALL_STRAIN = 0.01, EQUAL_STRETCHES = 1e-7, FLAT_RATIO = 1e-4, NEEDLE_RATIO = 0.015;

/* A rest tetrahedron in its own frame: a triangle and a fourth node at a height of 0.1 to 1.5 of its size. */
static void draw_tetrahedron(gsl_rng *rng, double size, double rest[12])
{
    energy_draw_triangle(rng, size, 0.1, rest);
    rest[9] = size * energy_draw_uniform(rng, -0.2, 1.2);
    rest[10] = size * energy_draw_uniform(rng, -0.2, 1.2);
    rest[11] = size * energy_draw_log(rng, 0.1, 1.5);
}

/* sigma[0] and sigma[1] of the other branches are what they are here: unequal, between half and twice. */
static void draw_stretches(gsl_rng *rng, int branch, double sigma[3])
{
    double level = energy_draw_uniform(rng, 1.02, 2), small = energy_draw_log(rng, 1e-9, 0.3 * SMALL_STRAIN);
    for (int a = 0; a < 3; a++) {
        sigma[a] = 1;
        if (branch == STRAINED) sigma[a] = 1 + small * energy_draw_uniform(rng, -1, 1);
        if (branch == STRETCHED) sigma[a] = energy_draw_log(rng, 1.02, 10);
        if (branch == COMPRESSED) sigma[a] = energy_draw_log(rng, 0.05, 0.98);
        if (branch >= MIXED) sigma[a] = energy_draw_log(rng, 0.5, 2);
        if (branch == NEAR_EQUAL) sigma[a] = level + energy_draw_log(rng, 1e-17, 0.4 * EQUAL_STRETCHES);
    }
    if (branch == MIXED) {
        sigma[0] = level;
        sigma[1] = 1 / level;
    }
    if (branch == FLATTENED) sigma[2] = energy_draw_log(rng, 1e-6, 0.4 * FLAT_RATIO);
    if (branch == NEEDLE) sigma[1] = sigma[2] = energy_draw_log(rng, 1e-3, 0.4 * NEEDLE_RATIO);
    if (branch == NEEDLE) sigma[2] *= energy_draw_uniform(rng, 0.9, 1);
}

/* x = U diag(sigma) V^T X for random rotations, placed in space. */
static void draw_deformed(gsl_rng *rng, const double rest[12], const double sigma[3], double x[12])
{
    double V[3][3], local[12];
    energy_draw_rotation(rng, V);
    for (int i = 0; i < 4; i++) {
        for (int a = 0; a < 3; a++) local[3 * i + a] = sigma[a] * v3_dot(V[a], rest + 3 * i);
    }
    energy_draw_placement(rng, v3_norm(rest + 3), 4, local, x);
}

void energy_sample_volume(gsl_rng *rng, int branch, double *x, void *params)
{
    double rest[12], sigma[3];
    draw_tetrahedron(rng, energy_draw_log(rng, 1e-3, 1), rest);
    double young = energy_draw_log(rng, 1e3, 1e9), poisson = energy_draw_uniform(rng, 0, 0.49);
    (void)cipc_volume_init(params, rest, young, poisson);
    draw_stretches(rng, branch, sigma);
    draw_deformed(rng, rest, sigma, x);
}

/* Turn the columns p, q of A into each other until they are orthogonal. */
static void orthogonalise(double A[3][3], int p, int q)
{
    double pq = v3_dot(A[p], A[q]), half = 0.5 * (v3_norm2(A[q]) - v3_norm2(A[p]));
    if (pq == 0) return;
    double tangent = pq / (half >= 0 ? half + hypot(half, pq) : half - hypot(half, pq)), c = 1 / hypot(1, tangent), s = c * tangent;
    for (int k = 0; k < 3; k++) {
        double a = A[p][k], b = A[q][k];
        A[p][k] = c * a - s * b;
        A[q][k] = s * a + c * b;
    }
}

/* Singular values in falling order, by plane rotations of the columns, which keep the digits of the small ones. */
static void singular_values(const double F[9], double sigma[3])
{
    enum { SWEEPS = 8 }; /* a classifier's: three or four do */
    double A[3][3];
    for (int a = 0; a < 3; a++) {
        for (int k = 0; k < 3; k++) A[a][k] = F[3 * k + a];
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        orthogonalise(A, 0, 1);
        orthogonalise(A, 0, 2);
        orthogonalise(A, 1, 2);
    }
    double n[3] = {v3_norm(A[0]), v3_norm(A[1]), v3_norm(A[2])};
    sigma[0] = fmax(n[0], fmax(n[1], n[2]));
    sigma[2] = fmin(n[0], fmin(n[1], n[2]));
    sigma[1] = fmax(fmin(n[0], n[1]), fmin(fmax(n[0], n[1]), n[2]));
}

int energy_branch_volume(const double *x, const void *params)
{
    double F[9], sigma[3];
    volume_deformation(x, ((const cipc_volume *)params)->inverse_rest, F);
    singular_values(F, sigma);
    double strain = fmax(sigma[0] - 1, 1 - sigma[2]);
    if (sigma[1] < NEEDLE_RATIO * sigma[0]) return NEEDLE;
    if (sigma[2] < FLAT_RATIO * sigma[0]) return FLATTENED;
    if (strain < REST_STRAIN) return REST;
    if (strain < SMALL_STRAIN) return STRAINED;
    if (sigma[0] - sigma[2] < EQUAL_STRETCHES * sigma[0]) return NEAR_EQUAL;
    if (sigma[2] >= 1) return STRETCHED;
    return sigma[0] <= 1 ? COMPRESSED : MIXED;
}
