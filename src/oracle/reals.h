/* MPFR numbers written as formulas: every operation gives a new number out of a store, all of one precision. */
#ifndef CIPC_ORACLE_REALS_H
#define CIPC_ORACLE_REALS_H

#include <stdbool.h>
#include <mpfr.h>

enum { ORACLE_REALS_LIMIT = 768 };
/* The sides of a formula's switches across which derivatives are not to be differenced: a jump of the value; a jump of the second derivative. Formulas note on
 * which one they are; over all points of a difference only one of each pair may be seen. Switches across which second derivatives are continuous need no note. */
enum { ORACLE_JUMP_BELOW = 1, ORACLE_JUMP_ABOVE = 2, ORACLE_BEND_BELOW = 4, ORACLE_BEND_ABOVE = 8 };
typedef struct oracle_reals {
    mpfr_prec_t precision;
    int used, made;
    unsigned sides; /* seen so far */
    mpfr_t value[ORACLE_REALS_LIMIT];
} oracle_reals;

void oracle_reals_init(oracle_reals *s, mpfr_prec_t precision);
void oracle_reals_clear(oracle_reals *s);

/* s.used = 0 takes all numbers back. */
mpfr_ptr oracle_number(oracle_reals *s, double x);
mpfr_ptr oracle_add(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b);
mpfr_ptr oracle_sub(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b);
mpfr_ptr oracle_mul(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b);
mpfr_ptr oracle_div(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b);
mpfr_ptr oracle_scaled(oracle_reals *s, double factor, mpfr_srcptr a);
mpfr_ptr oracle_sqrt(oracle_reals *s, mpfr_srcptr a);
mpfr_ptr oracle_log(oracle_reals *s, mpfr_srcptr a);

typedef struct oracle_real3 {
    mpfr_srcptr c[3];
} oracle_real3;
oracle_real3 oracle_point(const mpfr_t *x, int node);
oracle_real3 oracle_difference(oracle_reals *s, const mpfr_t *x, int node, int from); /* x_node - x_from */
oracle_real3 oracle_cross(oracle_reals *s, oracle_real3 a, oracle_real3 b);
mpfr_ptr oracle_dot(oracle_reals *s, oracle_real3 a, oracle_real3 b);

#endif
