/* A stencil in straight motion, in integers: x_i(s) = X_i + s P_i, s in [0, 1] for the time t = s t_max; and the polynomials in s that its feature pairs'
 * distances are made of (SPEC V.3; docs/theory/oracle_impact.md, section 1). */
#ifndef CIPC_ORACLE_PATH_H
#define CIPC_ORACLE_PATH_H

#include "cipc/oracle.h"
#include "oracle/exact_search.h"
#include "oracle/polynomial.h"

typedef struct oracle_path {
    cipc_pair_kind kind;
    int exponent; /* the unit 2^exponent of X and P */
    cipc_integer3 X[4], P[4];
    oracle_search search; /* of the positions at one time */
} oracle_path;

/* False: a number is not finite, or t_max is not in [0, 1] or xi < 0. xi (may be NULL) becomes the thickness in the path's unit. Clear in any case. */
bool oracle_path_init(oracle_path *path, const cipc_stencil_path *motion, double thickness, double t_max, mpz_t xi);
/* The same of a piece of paths with breaks, s in [0, 1] for the time t = begin + s (end - begin), in a unit of 2^exponent divided by an integer. False: a number is
 * not finite, or the times are not in order. */
bool oracle_path_init_piece(oracle_path *path, const cipc_stencil_piece *piece, double thickness, mpz_t xi);
void oracle_path_clear(oracle_path *path);
/* What both are made with: a path at rest in the origin; the motion and the place of the first node taken out of all - distances do not change, numbers get shorter. */
void oracle_path_init_empty(oracle_path *path, cipc_pair_kind kind);
void oracle_path_localize(oracle_path *path);

/* Exact squared distance at s = numerator / 2^bits: search.least_numerator / least_denominator, in the square of the unit 2^(exponent - bits). */
void oracle_path_search_at(oracle_path *path, const mpz_t numerator, unsigned long bits);
/* Sign of d^2 - xi^2 at that s. */
int oracle_path_compare_at(oracle_path *path, const mpz_t xi, const mpz_t numerator, unsigned long bits);
/* At s = numerator / denominator, which is positive. */
int oracle_path_compare_at_ratio(oracle_path *path, const mpz_t xi, const mpz_t numerator, const mpz_t denominator);

/* Squared distance of the flats of a feature (points, lines, planes): square / norm2 for two points (norm2 = 1) and point and line, height^2 / norm2 for point
 * and plane and for two lines. */
typedef struct oracle_flat_distance {
    bool has_height;
    oracle_polynomial square, height, norm2;
} oracle_flat_distance;
void oracle_flat_distance_init(oracle_flat_distance *d);
void oracle_flat_distance_clear(oracle_flat_distance *d);
void oracle_path_flat_distance(const oracle_path *path, const cipc_feature *feature, oracle_flat_distance *d);

/* An integer >= L = max |P_A| + max |P_B|, in the path's unit: the distance changes by at most L |s - s'|. */
void oracle_path_speed(const oracle_path *path, mpz_t speed);

#endif
