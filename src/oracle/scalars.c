/* Scalar functions of one variable with their first two derivatives, by central differences in MPFR (SPEC C.2, C.4, D.6). */
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "oracle/reals.h"

enum { PRECISION = 512, STEP_BITS = 100 };

/* b(D) = -(D - Dhat)^2 ln(D / Dhat) for 0 < D < Dhat. fields: Dhat. NULL: infeasible. */
static mpfr_ptr barrier(oracle_reals *s, mpfr_srcptr D, const double *f)
{
    mpfr_ptr Dhat = oracle_number(s, f[0]), gap = oracle_sub(s, D, Dhat);
    if (mpfr_sgn(D) <= 0) return NULL;
    if (mpfr_sgn(gap) >= 0) return oracle_number(s, 0);
    return oracle_scaled(s, -1, oracle_mul(s, oracle_mul(s, gap, gap), oracle_log(s, oracle_div(s, D, Dhat))));
}

/* b(sigma) of the strain limit. fields: s, shat. */
static mpfr_ptr strain_limit_barrier(oracle_reals *s, mpfr_srcptr sigma, const double *f)
{
    mpfr_ptr range = oracle_sub(s, oracle_number(s, f[0]), oracle_number(s, f[1]));
    mpfr_ptr over = oracle_sub(s, sigma, oracle_number(s, f[1])), left = oracle_sub(s, oracle_number(s, f[0]), sigma);
    if (mpfr_sgn(left) <= 0) return NULL;
    if (mpfr_sgn(over) <= 0) return oracle_number(s, 0);
    mpfr_ptr y = oracle_div(s, over, range);
    return oracle_scaled(s, -1, oracle_mul(s, oracle_mul(s, y, y), oracle_log(s, oracle_div(s, left, range))));
}

/* f0(y) of friction. fields: e. */
static mpfr_ptr friction_mollifier(oracle_reals *s, mpfr_srcptr y, const double *f)
{
    mpfr_ptr e = oracle_number(s, f[0]), y2 = oracle_mul(s, y, y);
    if (mpfr_greaterequal_p(y, e)) return oracle_scaled(s, 1, y);
    mpfr_ptr cubic = oracle_div(s, oracle_mul(s, y2, y), oracle_scaled(s, 3, oracle_mul(s, e, e)));
    return oracle_add(s, oracle_sub(s, oracle_div(s, y2, e), cubic), oracle_div(s, e, oracle_number(s, 3)));
}

typedef struct scalar {
    const char *name;
    mpfr_ptr (*value)(oracle_reals *s, mpfr_srcptr x, const double *fields);
} scalar;
static const scalar table[] = {{"barrier", barrier}, {"strain_limit_barrier", strain_limit_barrier}, {"friction_mollifier", friction_mollifier}};

cipc_verdict cipc_oracle_scalar(const char *name, double x, const double *fields, double f[3])
{
    const scalar *t = table;
    while (t < table + sizeof table / sizeof table[0] && strcmp(t->name, name) != 0) t++;
    if (t == table + sizeof table / sizeof table[0] || !isfinite(x)) return CIPC_INDETERMINATE;
    oracle_reals s;
    mpfr_t at, h, value[3], r;
    bool feasible = true;
    oracle_reals_init(&s, PRECISION);
    mpfr_inits2(PRECISION, at, h, value[0], value[1], value[2], r, (mpfr_ptr)NULL);
    mpfr_set_ui_2exp(h, 1, (x != 0 ? ilogb(x) : 0) - STEP_BITS, MPFR_RNDN);
    for (int i = 0; i < 3 && feasible; i++) {
        mpfr_mul_si(at, h, i - 1, MPFR_RNDN);
        mpfr_add_d(at, at, x, MPFR_RNDN);
        s.used = 0;
        mpfr_ptr found = t->value(&s, at, fields);
        feasible = found != NULL;
        if (feasible) mpfr_set(value[i], found, MPFR_RNDN);
    }
    if (feasible) {
        f[0] = mpfr_get_d(value[1], MPFR_RNDN);
        mpfr_sub(r, value[2], value[0], MPFR_RNDN);
        mpfr_div(r, r, h, MPFR_RNDN);
        f[1] = 0.5 * mpfr_get_d(r, MPFR_RNDN);
        mpfr_add(r, value[2], value[0], MPFR_RNDN);
        mpfr_sub(r, r, value[1], MPFR_RNDN);
        mpfr_sub(r, r, value[1], MPFR_RNDN);
        mpfr_div(r, r, h, MPFR_RNDN);
        mpfr_div(r, r, h, MPFR_RNDN);
        f[2] = mpfr_get_d(r, MPFR_RNDN);
    }
    mpfr_clears(at, h, value[0], value[1], value[2], r, (mpfr_ptr)NULL);
    oracle_reals_clear(&s);
    return feasible ? CIPC_YES : CIPC_INDETERMINATE;
}
