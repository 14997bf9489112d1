/* Samplers and branch classifiers of the registry, and the random shapes they share. A sampler fills positions and parameters with a legal
 * configuration aimed at one branch; the classifier tells which branch a configuration is on. Ranges are log-uniform over what scenes of
 * cloth in SI units contain. */
#ifndef CIPC_ENERGY_SAMPLERS_H
#define CIPC_ENERGY_SAMPLERS_H

#include <gsl/gsl_rng.h>
#include "cipc/energy.h"

/* Random numbers and shapes (draw.c). */
double energy_draw_uniform(gsl_rng *rng, double low, double high);
double energy_draw_log(gsl_rng *rng, double low, double high); /* log-uniform, 0 < low <= high */
int energy_draw_index(gsl_rng *rng, int count);                /* 0..count-1 */
void energy_draw_rotation(gsl_rng *rng, double columns[3][3]); /* three orthonormal vectors, right-handed, uniform */
/* Move `nodes` points given in a local frame by a random rotation and a translation of at most `reach` per coordinate. */
void energy_draw_placement(gsl_rng *rng, double reach, int nodes, const double *local, double *x);
/* A rest triangle in the plane, longest side about `size`, height over base in [flattest, 1.5]. */
void energy_draw_triangle(gsl_rng *rng, double size, double flattest, double rest[9]);

/* Positions of a rest triangle under the stretches sigma along two random directions of its plane, placed in space (samplers_element.c). */
void energy_draw_deformed_triangle(gsl_rng *rng, const double inverse_rest[3], const double sigma[2], double x[9]);

/* The registry's columns sample, branch and branch_names for one energy. */
#define ENERGY_SAMPLER(name)                                                                                                               \
    void energy_sample_##name(gsl_rng *rng, int branch, double *x, void *params);                                                          \
    int energy_branch_##name(const double *x, const void *params)

enum {
    ENERGY_NODAL_BRANCHES = 2,
    ENERGY_GRAVITY_BRANCHES = 1,
    ENERGY_MEMBRANE_BRANCHES = 5,
    ENERGY_STRAIN_LIMIT_BRANCHES = 7,
    ENERGY_HINGE_BRANCHES = 14
};
enum { ENERGY_STRAIN_LIMIT_LOWER_BRANCHES = 6, ENERGY_ORTHOTROPIC_BRANCHES = 14 };
enum { ENERGY_VOLUME_BRANCHES = 8 };
enum {
    ENERGY_ROD_STRETCHING_BRANCHES = 4,
    ENERGY_ROD_BENDING_BRANCHES = 10,
    ENERGY_STITCH_BRANCHES = 4,
    ENERGY_DAMPING_BRANCHES = 6
};
enum {
    ENERGY_CONTACT_BRANCHES = 6,
    ENERGY_POINT_EDGE_BRANCHES = 7,
    ENERGY_POINT_TRIANGLE_BRANCHES = 7,
    ENERGY_EDGE_EDGE_BRANCHES = 19,
    ENERGY_FRICTION_BRANCHES = 16
};

extern const char *const energy_nodal_branch_names[ENERGY_NODAL_BRANCHES];
extern const char *const energy_gravity_branch_names[ENERGY_GRAVITY_BRANCHES];
extern const char *const energy_membrane_branch_names[ENERGY_MEMBRANE_BRANCHES];
extern const char *const energy_strain_limit_branch_names[ENERGY_STRAIN_LIMIT_BRANCHES];
extern const char *const energy_strain_limit_lower_branch_names[ENERGY_STRAIN_LIMIT_LOWER_BRANCHES];
extern const char *const energy_orthotropic_branch_names[ENERGY_ORTHOTROPIC_BRANCHES];
extern const char *const energy_hinge_branch_names[ENERGY_HINGE_BRANCHES];
extern const char *const energy_volume_branch_names[ENERGY_VOLUME_BRANCHES];
extern const char *const energy_rod_stretching_branch_names[ENERGY_ROD_STRETCHING_BRANCHES];
extern const char *const energy_rod_bending_branch_names[ENERGY_ROD_BENDING_BRANCHES];
extern const char *const energy_stitch_branch_names[ENERGY_STITCH_BRANCHES];
extern const char *const energy_damping_branch_names[ENERGY_DAMPING_BRANCHES];
extern const char *const energy_contact_branch_names[ENERGY_CONTACT_BRANCHES];
extern const char *const energy_point_edge_branch_names[ENERGY_POINT_EDGE_BRANCHES];
extern const char *const energy_point_triangle_branch_names[ENERGY_POINT_TRIANGLE_BRANCHES];
extern const char *const energy_edge_edge_branch_names[ENERGY_EDGE_EDGE_BRANCHES];
extern const char *const energy_friction_branch_names[ENERGY_FRICTION_BRANCHES];

ENERGY_SAMPLER(inertia);
ENERGY_SAMPLER(gravity);
ENERGY_SAMPLER(dirichlet_penalty);
ENERGY_SAMPLER(membrane);
ENERGY_SAMPLER(strain_limit);
ENERGY_SAMPLER(strain_limit_lower);
ENERGY_SAMPLER(membrane_orthotropic);
ENERGY_SAMPLER(hinge_bending);
ENERGY_SAMPLER(volume);
ENERGY_SAMPLER(rod_stretching);
ENERGY_SAMPLER(rod_bending);
ENERGY_SAMPLER(stitch);
ENERGY_SAMPLER(damping);
ENERGY_SAMPLER(barrier_point_point);
ENERGY_SAMPLER(barrier_point_edge);
ENERGY_SAMPLER(barrier_point_triangle);
ENERGY_SAMPLER(barrier_edge_edge);
ENERGY_SAMPLER(friction);

#endif
