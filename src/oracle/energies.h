/* The energies' values as formulas in MPFR; functions.c lists them. fields: the parameters in the order of the registry's. NULL: infeasible. */
#ifndef CIPC_ORACLE_ENERGIES_H
#define CIPC_ORACLE_ENERGIES_H

#include "cipc/base.h"
#include "oracle/reals.h"

mpfr_ptr oracle_inertia(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_gravity(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_dirichlet_penalty(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_membrane_neo_hookean(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_membrane_stvk(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_strain_limit(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_strain_limit_lower(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_membrane_orthotropic(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_hinge_bending(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_volume_corotational(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_volume_neo_hookean(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_rod_stretching(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_rod_bending(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_stitch(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_damping(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_barrier_point_point(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_barrier_point_edge(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_barrier_point_triangle(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_barrier_edge_edge(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_friction(oracle_reals *s, const mpfr_t *x, const double *fields);

/* Squared distance of the flats of a feature of the stencil x. */
mpfr_ptr oracle_flat_distance2(oracle_reals *s, const mpfr_t *x, const cipc_feature *feature);
mpfr_ptr oracle_distance2_point_point(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_distance2_point_line(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_distance2_point_plane(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_distance2_line_line(oracle_reals *s, const mpfr_t *x, const double *fields);
mpfr_ptr oracle_edge_edge_mollifier(oracle_reals *s, const mpfr_t *x, const double *fields);

#endif
