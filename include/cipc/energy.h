/* cipc/energy.h - every energy of cipc: value, gradient, Hessian, nothing else; and the registry that lists them all.
 * Floor 3. An energy is a pure function of the positions x of its stencil (at most 4 nodes, 12 numbers) and a constant params struct.
 * Gradients g[n], Hessians H[n*n] row-major, n = 3 * nodes; exact, not projected. An infeasible configuration (barrier at or beyond its
 * limit, element collapsed) has the value INFINITY; gradient and Hessian there are not defined and must not be asked for. */
#ifndef CIPC_ENERGY_H
#define CIPC_ENERGY_H

#include <stdbool.h>
#include <stddef.h>
#include <gsl/gsl_rng.h>
#include "cipc/base.h"
#include "cipc/geometry.h"

/* --- 1 node ------------------------------------------------------------------------------------------------------------------ */

/* Inertia: 1/2 m |x - xhat|^2 (SPEC C.1). */
typedef struct cipc_inertia { double mass, target[3]; } cipc_inertia;
double cipc_inertia_value(const double x[3], const cipc_inertia *params);
void cipc_inertia_gradient(const double x[3], const cipc_inertia *params, double g[3]);
void cipc_inertia_hessian(const double x[3], const cipc_inertia *params, double H[9]);

/* Gravity: -m a.x, a the acceleration of gravity. */
typedef struct cipc_gravity { double mass, acceleration[3]; } cipc_gravity;
double cipc_gravity_value(const double x[3], const cipc_gravity *params);
void cipc_gravity_gradient(const double x[3], const cipc_gravity *params, double g[3]);
void cipc_gravity_hessian(const double x[3], const cipc_gravity *params, double H[9]);

/* Dirichlet penalty: 1/2 k m |x - target|^2 (SPEC C.7). stiffness = k. */
typedef struct cipc_dirichlet_penalty { double stiffness, mass, target[3]; } cipc_dirichlet_penalty;
double cipc_dirichlet_penalty_value(const double x[3], const cipc_dirichlet_penalty *params);
void cipc_dirichlet_penalty_gradient(const double x[3], const cipc_dirichlet_penalty *params, double g[3]);
void cipc_dirichlet_penalty_hessian(const double x[3], const cipc_dirichlet_penalty *params, double H[9]);

/* --- triangles: x = x0, x1, x2 --------------------------------------------------------------------------------------------- */

/* Rest data of a triangle. B = [X1-X0, X2-X0] in an orthonormal basis of the rest plane, upper triangular; F = [x1-x0, x2-x0] B^-1 (3x2). */
typedef struct cipc_membrane {
    double inverse_rest[3]; /* B^-1 = [[b0, b1], [0, b2]] */
    double area;            /* rest area, m^2 */
    double volume;          /* V = area * thickness, m^3 */
    double mu, lambda;      /* Pa; mu = E/(2(1+nu)), lambda = E nu/(1-nu^2), plane stress (SPEC C.6) */
} cipc_membrane;
/* Returns false for a rest triangle of zero area. */
bool cipc_membrane_init(cipc_membrane *params, const double rest[9], double thickness, double young, double poisson);

/* Neo-Hookean: V [mu/2 (tr(C) - 2 - 2 ln J) + lambda/2 (ln J)^2], C = F^T F = similar to Ibar^-1 I, J^2 = det C (SPEC C.6). */
double cipc_membrane_neo_hookean_value(const double x[9], const cipc_membrane *params);
void cipc_membrane_neo_hookean_gradient(const double x[9], const cipc_membrane *params, double g[9]);
void cipc_membrane_neo_hookean_hessian(const double x[9], const cipc_membrane *params, double H[81]);

/* StVK: V [lambda/2 tr(E)^2 + mu tr(E^2)], E = (C - 1)/2 (SPEC C.6). */
double cipc_membrane_stvk_value(const double x[9], const cipc_membrane *params);
void cipc_membrane_stvk_gradient(const double x[9], const cipc_membrane *params, double g[9]);
void cipc_membrane_stvk_hessian(const double x[9], const cipc_membrane *params, double H[81]);

/* Isotropic strain limit: kappa_s V sum_i b(sigma_i), sigma_i the singular values of F, b of SPEC C.2 (eqs 4-7 as corrected there). */
typedef struct cipc_strain_limit {
    double inverse_rest[3];
    double volume;
    double limit;      /* s */
    double activation; /* shat */
    double stiffness;  /* kappa_s, Pa */
} cipc_strain_limit;
bool cipc_strain_limit_init(cipc_strain_limit *params, const double rest[9], double thickness, double limit, double activation, double stiffness);
double cipc_strain_limit_value(const double x[9], const cipc_strain_limit *params);
void cipc_strain_limit_gradient(const double x[9], const cipc_strain_limit *params, double g[9]);
void cipc_strain_limit_hessian(const double x[9], const cipc_strain_limit *params, double H[81]);
/* Principal stretches sigma_1 >= sigma_2 >= 0 of a triangle. */
void cipc_principal_stretches(const double x[9], const double inverse_rest[3], double sigma[2]);
/* The scalar barrier b(sigma) and its first two derivatives; 0 for sigma <= shat. Requires sigma < s. With s < shat it is the barrier of a lower
 * limit: 0 for sigma >= shat, and sigma > s is required. */
void cipc_strain_limit_barrier(double sigma, double limit, double activation, double b[3]);

/* Lower strain limit: the same sum with b mirrored, which acts on stretches below shat and is infinite at the limit s, 0 < s < shat <= 1 (SPEC C.2).
 * Returns false for a rest triangle of zero area and for numbers in any other order. */
bool cipc_strain_limit_lower_init(cipc_strain_limit *params, const double rest[9], double thickness, double limit, double activation, double stiffness);
double cipc_strain_limit_lower_value(const double x[9], const cipc_strain_limit *params);
void cipc_strain_limit_lower_gradient(const double x[9], const cipc_strain_limit *params, double g[9]);
void cipc_strain_limit_lower_hessian(const double x[9], const cipc_strain_limit *params, double H[81]);

/* Orthotropic membrane with its own limits, in Green strains E along warp, weft and between them (SPEC C.3, eqs 8-10 as corrected there):
 * V [a11/2 eta(E11^2; L11^2) + a12 eta(E11 E22; L11 L22) + a22/2 eta(E22^2; L22^2) + g12 eta(E12^2; L12^2)], eta(q; Q) = -Q ln((Q - q)/Q),
 * INFINITY unless |E11| < L11, |E22| < L22 and |E12| < L12. */
typedef struct cipc_orthotropic {
    double warp[2], weft[2];            /* present image of the unit warp direction: f1 = warp[0] (x1-x0) + warp[1] (x2-x0); of weft likewise f2 */
    double rest_cosine;                 /* d1.d2 of the unit rest directions; E12 = (f1.f2 - d1.d2)/2 */
    double volume;                      /* m^3 */
    double a11, a12, a22, g12;          /* Pa */
    double limit11, limit22, limit12;   /* of the Green strains */
} cipc_orthotropic;
/* Directions are projected onto the plane of the rest triangle and normalised; weft NULL: across the warp. moduli = a11, a12, a22, g12; limits = L11,
 * L22, L12. Returns false, and writes nothing, for a rest triangle of zero area, a direction across its plane, or directions that are parallel. */
bool cipc_orthotropic_init(cipc_orthotropic *params, const double rest[9], double thickness, const double warp[3], const double *weft, const double moduli[4],
                           const double limits[3]);
double cipc_membrane_orthotropic_value(const double x[9], const cipc_orthotropic *params);
void cipc_membrane_orthotropic_gradient(const double x[9], const cipc_orthotropic *params, double g[9]);
void cipc_membrane_orthotropic_hessian(const double x[9], const cipc_orthotropic *params, double H[81]);

/* --- hinges: x = v0, v1 (shared edge), v2, v3; triangles (v0,v1,v2) and (v1,v0,v3) ------------------------------------------ */

/* Hinge bending: k w (theta - thetabar)^2, w = ebar / hbar = 3 ebar^2 / (A1 + A2) at rest (SPEC C.6, F1). */
typedef struct cipc_hinge_bending {
    double stiffness;  /* k w, J */
    double rest_angle; /* thetabar, rad; 0 is flat */
} cipc_hinge_bending;
/* k = D/6 ("plate") or D/2 ("cipc"), D = E t^3 / (12 (1-nu^2)); `cipc_constant` chooses the latter. */
void cipc_hinge_bending_init(cipc_hinge_bending *params, const double rest[12], double thickness, double young, double poisson, bool cipc_constant);
/* Signed dihedral angle theta in (-pi, pi], 0 flat: atan2(e.(n1 x n2)/|e|, n1.n2), n1 = (v1-v0)x(v2-v0), n2 = (v0-v1)x(v3-v1). */
double cipc_hinge_angle(const double x[12]);
/* Its gradient; neither triangle has zero area. */
void cipc_hinge_angle_gradient(const double x[12], double g[12]);
double cipc_hinge_bending_value(const double x[12], const cipc_hinge_bending *params);
void cipc_hinge_bending_gradient(const double x[12], const cipc_hinge_bending *params, double g[12]);
void cipc_hinge_bending_hessian(const double x[12], const cipc_hinge_bending *params, double H[144]);

/* --- tetrahedra: x = x0, x1, x2, x3, of positive orientation at rest ---------------------------------------------------------------- */

/* Rest data of a tetrahedron. B = [X1-X0, X2-X0, X3-X0]; F = [x1-x0, x2-x0, x3-x0] B^-1; J = det F. */
typedef struct cipc_volume {
    double inverse_rest[9]; /* B^-1, row-major */
    double volume;          /* m^3 */
    double mu, lambda;      /* Pa; mu = E/(2(1+nu)), lambda = E nu/((1+nu)(1-2nu)) (SPEC C.6) */
} cipc_volume;
/* Returns false, and writes nothing, unless the rest volume is a positive finite number. */
bool cipc_volume_init(cipc_volume *params, const double rest[12], double young, double poisson);

/* Fixed corotational, the volumes of the C-IPC paper (F5): V [mu |F - R|^2 + lambda/2 (J-1)^2], R the rotation nearest to F. INFINITY for J <= 0:
 * the formula would go on there, but a line search that halves until the value is finite then keeps tetrahedra from inverting. */
double cipc_volume_corotational_value(const double x[12], const cipc_volume *params);
void cipc_volume_corotational_gradient(const double x[12], const cipc_volume *params, double g[12]);
void cipc_volume_corotational_hessian(const double x[12], const cipc_volume *params, double H[144]);

/* Neo-Hookean, the volumes of the released code (F5): V [mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2]; INFINITY for J <= 0 (SPEC C.6). */
double cipc_volume_neo_hookean_value(const double x[12], const cipc_volume *params);
void cipc_volume_neo_hookean_gradient(const double x[12], const cipc_volume *params, double g[12]);
void cipc_volume_neo_hookean_hessian(const double x[12], const cipc_volume *params, double H[144]);
/* --- rods: segments x0, x1; joints x0, x1, x2 with the segments (x0,x1) and (x1,x2) ---------------------------------------------- */

/* Stretching: E A l0/2 (l/l0 - 1)^2 (SPEC C.6). Where both nodes coincide the value is finite but gradient and Hessian do not exist. */
typedef struct cipc_rod_stretching {
    double stiffness; /* E A, N; A = pi d^2/4 */
    double length;    /* l0, m */
} cipc_rod_stretching;
/* Returns false for a rest segment of no length. */
bool cipc_rod_stretching_init(cipc_rod_stretching *params, const double rest[6], double diameter, double young);
double cipc_rod_stretching_value(const double x[6], const cipc_rod_stretching *params);
void cipc_rod_stretching_gradient(const double x[6], const cipc_rod_stretching *params, double g[6]);
void cipc_rod_stretching_hessian(const double x[6], const cipc_rod_stretching *params, double H[36]);

/* Bending: k (|kb| - kbar)^2, kb = 2 e0 x e1 / (|e0||e1| + e0.e1), |kb| = 2 tan(phi/2), phi the turning angle (Bergou et al. 2008; SPEC C.6). Isotropic and
 * without material frames: of a curved rest shape only the amount of curvature counts, not its plane; gradient and Hessian at exactly phi = 0, where such
 * a rod has a cone, are those of the part without it. INFINITY: folded back (phi = pi), or a segment of no length. */
typedef struct cipc_rod_bending {
    double stiffness;      /* k = E I / (l0_0 + l0_1), N m; I = pi d^4/64 */
    double rest_curvature; /* kbar = |kb| at rest, 1; 0 is straight */
} cipc_rod_bending;
/* `curved`: kbar is that of the rest shape, else 0. Returns false for a rest segment of no length and for a rest shape folded back. */
bool cipc_rod_bending_init(cipc_rod_bending *params, const double rest[9], double diameter, double young, bool curved);
double cipc_rod_bending_value(const double x[9], const cipc_rod_bending *params);
void cipc_rod_bending_gradient(const double x[9], const cipc_rod_bending *params, double g[9]);
void cipc_rod_bending_hessian(const double x[9], const cipc_rod_bending *params, double H[81]);

/* Stitch of node x0 to the place r on the edge (x1,x2): k/2 |x0 - ((1-r) x1 + r x2)|^2 (SPEC C.6). */
typedef struct cipc_stitch {
    double stiffness; /* k, N/m */
    double ratio;     /* r, 0 at x1 and 1 at x2 */
} cipc_stitch;
double cipc_stitch_value(const double x[9], const cipc_stitch *params);
void cipc_stitch_gradient(const double x[9], const cipc_stitch *params, double g[9]);
void cipc_stitch_hessian(const double x[9], const cipc_stitch *params, double H[81]);

/* --- damping of any element, up to 4 nodes -------------------------------------------------------------------------------------- */

/* Rayleigh damping as a potential: c/2 (x - start)^T K (x - start), K the element's stiffness at the start of the step. */
typedef struct cipc_damping {
    double factor;        /* c >= 0: 1, or s, as the assembly divides by the time step */
    double start[12];     /* positions at the start of the step, m */
    double stiffness[78]; /* K, N/m: symmetric positive semi-definite 12 x 12, upper triangle row by row; rows of absent nodes are zero */
} cipc_damping;
/* K := hessian[n*n], n = 3 * nodes, of which the upper triangle is read; start[n]. The absent nodes' start is 0. */
void cipc_damping_init(cipc_damping *params, double factor, int nodes, const double *start, const double *hessian);
double cipc_damping_value(const double x[12], const cipc_damping *params);
void cipc_damping_gradient(const double x[12], const cipc_damping *params, double g[12]);
void cipc_damping_hessian(const double x[12], const cipc_damping *params, double H[144]);

/* --- contact ---------------------------------------------------------------------------------------------------------------- */

/* The scalar barrier of SPEC C.4: b(D) = -(D - Dhat)^2 ln(D / Dhat) for 0 < D < Dhat, 0 beyond; b[0..2] = b, b', b''. D <= 0: b[0] = INFINITY, others 0. */
void cipc_barrier(double D, double Dhat, double b[3]);

/* Barrier of one contact stencil: kappa w e(c) b(d^2 - xi^2), Dhat = 2 xi dhat + dhat^2 (SPEC C.4, D.2, D.3); e = 1 unless mollified. */
typedef struct cipc_contact_barrier {
    double stiffness;     /* kappa */
    double weight;        /* multiplicity or area weight */
    double offset;        /* xi, m */
    double dhat;          /* m: support d < xi + dhat */
    double mollifier_eps; /* edge-edge only: eps_x of SPEC D.3, m^4; 0: no mollifier */
    cipc_feature feature; /* edge-edge only: closest features (a mollified stencil keeps 4 nodes whatever its feature) */
} cipc_contact_barrier;
double cipc_barrier_point_point_value(const double x[6], const cipc_contact_barrier *params);
void cipc_barrier_point_point_gradient(const double x[6], const cipc_contact_barrier *params, double g[6]);
void cipc_barrier_point_point_hessian(const double x[6], const cipc_contact_barrier *params, double H[36]);
double cipc_barrier_point_edge_value(const double x[9], const cipc_contact_barrier *params);
void cipc_barrier_point_edge_gradient(const double x[9], const cipc_contact_barrier *params, double g[9]);
void cipc_barrier_point_edge_hessian(const double x[9], const cipc_contact_barrier *params, double H[81]);
double cipc_barrier_point_triangle_value(const double x[12], const cipc_contact_barrier *params);
void cipc_barrier_point_triangle_gradient(const double x[12], const cipc_contact_barrier *params, double g[12]);
void cipc_barrier_point_triangle_hessian(const double x[12], const cipc_contact_barrier *params, double H[144]);
double cipc_barrier_edge_edge_value(const double x[12], const cipc_contact_barrier *params);
void cipc_barrier_edge_edge_gradient(const double x[12], const cipc_contact_barrier *params, double g[12]);
void cipc_barrier_edge_edge_hessian(const double x[12], const cipc_contact_barrier *params, double H[144]);

/* Smoothed friction of one lagged contact (SPEC D.6): mu lambda f0(|u|), u = P^T sum_i w_i (x_i - start_i). Nodes beyond the contact's own
 * have weight 0 (their gradient and Hessian entries are 0). */
typedef struct cipc_friction {
    double coefficient; /* mu lambda (lambda includes weight and multiplicity) */
    double eps;         /* eps_v h, m */
    double weights[4];  /* w of cipc_closest_weights, lagged */
    double basis[6];    /* P: two orthonormal tangents, basis[0..2] and basis[3..5] */
    double start[12];   /* x^n of the stencil */
} cipc_friction;
double cipc_friction_value(const double x[12], const cipc_friction *params);
void cipc_friction_gradient(const double x[12], const cipc_friction *params, double g[12]);
void cipc_friction_hessian(const double x[12], const cipc_friction *params, double H[144]);
/* Hessian of the quadratic with value and gradient of the friction at x that lies above it everywhere: mu lambda (f1/|u|) P P^T between the nodes (docs/theory/energies.md (34)). */
void cipc_friction_majorizer(const double x[12], const cipc_friction *params, double H[144]);
/* f0(y), f1(y) = f0', f1'(y) of SPEC D.6 for transition width e. */
void cipc_friction_mollifier(double y, double e, double f[3]);

/* --- the registry ------------------------------------------------------------------------------------------------------------- */

enum { CIPC_INVARIANT_TRANSLATION = 1, CIPC_INVARIANT_ROTATION = 2 };

/* One member of a params struct: `count` doubles at `offset`, or (feature true) a cipc_feature, which counts as one number: its
 * cipc_feature_index among the features of edge-edge. */
typedef struct cipc_energy_field {
    const char *name;
    size_t offset;
    int count;
    bool feature;
} cipc_energy_field;

/* One energy as the assembler, the derivative checkers and the campaigns see it. */
typedef struct cipc_energy {
    const char *name;   /* "hinge_bending": the file's name */
    int nodes;          /* 1..4 */
    size_t params_size; /* sizeof the params struct */
    double (*value)(const double *x, const void *params);
    void (*gradient)(const double *x, const void *params, double *g);
    void (*hessian)(const double *x, const void *params, double *H);
    unsigned invariances;
    /* Branches that a campaign must reach, and a sampler that draws a legal configuration aimed at one of them. */
    int branch_count;
    const char *const *branch_names;
    void (*sample)(gsl_rng *rng, int branch, double *x, void *params);
    /* Which branch a configuration is on (what was reached, not what was aimed at). */
    int (*branch)(const double *x, const void *params);
    /* The members of the params struct, all of them, in order: as a flat list of doubles they are what oracle and conformance vectors speak. */
    int field_count;
    const cipc_energy_field *fields;
} cipc_energy;

typedef enum cipc_energy_id {
    CIPC_ENERGY_INERTIA = 0, CIPC_ENERGY_GRAVITY, CIPC_ENERGY_DIRICHLET_PENALTY,
    CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN, CIPC_ENERGY_MEMBRANE_STVK, CIPC_ENERGY_STRAIN_LIMIT,
    CIPC_ENERGY_STRAIN_LIMIT_LOWER, CIPC_ENERGY_MEMBRANE_ORTHOTROPIC,
    CIPC_ENERGY_HINGE_BENDING,
    CIPC_ENERGY_ROD_STRETCHING, CIPC_ENERGY_ROD_BENDING, CIPC_ENERGY_STITCH, CIPC_ENERGY_DAMPING,
    CIPC_ENERGY_VOLUME_COROTATIONAL, CIPC_ENERGY_VOLUME_NEO_HOOKEAN,
    CIPC_ENERGY_BARRIER_POINT_POINT, CIPC_ENERGY_BARRIER_POINT_EDGE, CIPC_ENERGY_BARRIER_POINT_TRIANGLE, CIPC_ENERGY_BARRIER_EDGE_EDGE,
    CIPC_ENERGY_FRICTION,
    CIPC_ENERGY_COUNT
} cipc_energy_id;

/* The entry of an energy; the table is constant. */
const cipc_energy *cipc_energy_entry(cipc_energy_id id);
/* By name, or NULL. */
const cipc_energy *cipc_energy_find(const char *name);
/* The flat list of an energy's parameters: its length (at most CIPC_ENERGY_NUMBERS), and both ways. Reading is false for a feature that is none. */
enum { CIPC_ENERGY_NUMBERS = 96 };
int cipc_energy_number_count(const cipc_energy *energy);
void cipc_energy_numbers(const cipc_energy *energy, const void *params, double *numbers);
bool cipc_energy_params(const cipc_energy *energy, const double *numbers, void *params);

#endif
