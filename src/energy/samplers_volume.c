/* Samplers of volumes and of orthotropic cloth. */
#include "base/vector.h"
#include "energy/samplers.h"
#include "energy/volume.h"

const char *const energy_volume_branch_names[ENERGY_VOLUME_BRANCHES] = {"rest", "stretched", "compressed", "sheared", "flattened"};
enum { REST = 0, STRETCHED, COMPRESSED, SHEARED, FLATTENED };
static const double REST_STRAIN = 1e-6, FLAT_J = 1e-2;

static void draw_stretches(gsl_rng *rng, int branch, double sigma[3])
{
    for (int k = 0; k < 3; k++) {
        sigma[k] = 1;
        if (branch == STRETCHED) sigma[k] = energy_draw_uniform(rng, 1.001, 2);
        if (branch == COMPRESSED) sigma[k] = energy_draw_uniform(rng, 0.4, 0.999);
    }
    if (branch == SHEARED) {
        sigma[0] = energy_draw_uniform(rng, 1.01, 2);
        sigma[1] = energy_draw_uniform(rng, 0.4, 0.99);
    }
    if (branch == FLATTENED) sigma[2] = energy_draw_log(rng, 1e-5, 0.9 * FLAT_J);
    if (branch != REST && branch != FLATTENED && energy_draw_index(rng, 3) == 0) sigma[1] = sigma[0]; /* equal stretches */
}

/* A tetrahedron whose height over its base is 0.3 to 1 of its size. */
static void draw_tetrahedron(gsl_rng *rng, double size, double rest[12])
{
    for (int k = 0; k < 12; k++) rest[k] = 0;
    rest[3] = size;
    rest[6] = size * energy_draw_uniform(rng, 0, 1);
    rest[7] = size * energy_draw_uniform(rng, 0.3, 1);
    rest[9] = size * energy_draw_uniform(rng, 0, 1);
    rest[10] = size * energy_draw_uniform(rng, 0, 1);
    rest[11] = size * energy_draw_uniform(rng, 0.3, 1);
}

/* x = U diag(sigma) V^T X + t with random rotations U and V. */
void energy_sample_volume(gsl_rng *rng, int branch, double *x, void *params)
{
    double size = energy_draw_log(rng, 1e-3, 1), rest[12], sigma[3], V[3][3], local[12];
    draw_tetrahedron(rng, size, rest);
    (void)cipc_volume_init(params, rest, energy_draw_log(rng, 1e3, 1e9), energy_draw_uniform(rng, 0, 0.49));
    draw_stretches(rng, branch, sigma);
    energy_draw_rotation(rng, V);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) local[3 * i + k] = sigma[k] * v3_dot(V[k], rest + 3 * i);
    energy_draw_placement(rng, size, 4, local, x);
}

/* By the principal stretches' bounds: the least and the largest diagonal of F^T F - 1 bound none of them, but J and the trace tell these shapes apart. */
int energy_branch_volume(const double *x, const void *params)
{
    deformation d = deformation_of(x, ((const cipc_volume *)params)->inverse_rest);
    double trace = v3_norm2(d.f[0]) + v3_norm2(d.f[1]) + v3_norm2(d.f[2]), minors = v3_norm2(d.cofactor[0]) + v3_norm2(d.cofactor[1]) + v3_norm2(d.cofactor[2]);
    /* Characteristic polynomial of C - 1 = 0 at its roots e: all e > 0 (or all < 0) iff its coefficients alternate (or do not). */
    double J2 = d.J * d.J, first = trace - 3, second = minors - 2 * trace + 3, third = J2 - minors + trace - 1;
    if (d.J < FLAT_J) return FLATTENED;
    if (fabs(first) < REST_STRAIN && fabs(J2 - 1) < REST_STRAIN) return REST;
    if (first > 0 && second > 0 && third > 0) return STRETCHED;
    return first < 0 && second > 0 && third < 0 ? COMPRESSED : SHEARED;
}

const char *const energy_orthotropic_branch_names[ENERGY_ORTHOTROPIC_BRANCHES] = {"rest", "inside", "near_warp_limit", "near_weft_limit", "near_shear_limit"};
enum { INSIDE = 1, NEAR_WARP, NEAR_WEFT, NEAR_SHEAR };
/* A limit beyond this is drawn on the side of tension only: Green strains below -1/2 do not exist, nor sheared ones not far above. */
static const double NEAR = 0.99, MOST_COMPRESSION = 0.2;

/* Moduli and limits of the five measured fabrics (SPEC C.3): a11, a12, a22, G12 in MPa; L11, L22, L12; thickness in mm. */
static const double fabrics[5][8] = {
    {15.557, 7.779, 25.004, 1.076, .14, .14, .063, .18}, {2.290, 1.145, 2.219, .371, .50, .62, .12, 1.28}, {5.366, 2.683, 19.804, 2.009, .11, .067, .059, .53},
    {4.300, 4.971, 9.942, .570, .41, .34, .11, .18},     {4.793, 4.515, 9.029, 2.448, .28, .28, .05, .66},
};

static double draw_strain(gsl_rng *rng, bool near, double limit)
{
    double sign = energy_draw_index(rng, 2) && limit < MOST_COMPRESSION ? -1 : 1;
    return sign * limit * (near ? 1 - energy_draw_log(rng, 1e-5, 0.9 * (1 - NEAR)) : energy_draw_uniform(rng, 0, 0.97 * NEAR));
}

/* Directions f1, f2 with the drawn strains: |f1|^2 = 1 + 2 E11, f1.f2 = 2 E12 + cosine, |f2|^2 = 1 + 2 E22. */
void energy_sample_orthotropic(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_orthotropic *p = params;
    double rest[9], size = energy_draw_log(rng, 1e-3, 1), angle = energy_draw_uniform(rng, -3.1, 3.1), lean = energy_draw_uniform(rng, 1.3, 1.8), moduli[4];
    const double *fabric = fabrics[energy_draw_index(rng, 5)], factor = energy_draw_log(rng, 1e4, 1e6);
    const double warp[3] = {cos(angle), sin(angle), 0}, weft[3] = {cos(angle + lean), sin(angle + lean), 0}, across[3] = {0, 0, 0};
    energy_draw_triangle(rng, size, 0.2, rest);
    for (int i = 0; i < 4; i++) moduli[i] = factor * fabric[i];
    (void)cipc_orthotropic_init(p, rest, 1e-3 * fabric[7], warp, energy_draw_index(rng, 2) ? across : weft, moduli, fabric + 4);
    double a = draw_strain(rng, branch == NEAR_WARP, fabric[4]), b = draw_strain(rng, branch == NEAR_WEFT, fabric[5]), c = draw_strain(rng, branch == NEAR_SHEAR, fabric[6]);
    if (branch == 0) a = b = c = 0;
    double f1 = sqrt(1 + 2 * a), along = (2 * c + p->rest_cosine) / f1, f2 = sqrt(1 + 2 * b - along * along), determinant = p->warp[0] * p->weft[1] - p->warp[1] * p->weft[0];
    /* [x1 - x0, x2 - x0] = [f1, f2] [warp, weft]^-1 */
    double local[9] = {0, 0, 0, (f1 * p->weft[1] - along * p->warp[1]) / determinant, -f2 * p->warp[1] / determinant, 0,
                       (along * p->warp[0] - f1 * p->weft[0]) / determinant, f2 * p->warp[0] / determinant, 0};
    energy_draw_placement(rng, size, 3, local, x);
}

int energy_branch_orthotropic(const double *x, const void *params)
{
    const cipc_orthotropic *p = params;
    double e[3];
    cipc_orthotropic_strains(x, p, e);
    if (fabs(e[0]) + fabs(e[1]) + fabs(e[2]) < REST_STRAIN) return REST;
    for (int k = 0; k < 3; k++)
        if (fabs(e[k]) > NEAR * p->limits[k]) return NEAR_WARP + k;
    return INSIDE;
}
