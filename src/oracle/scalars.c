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

/* value[0..4] := f at x - 2h .. x + 2h. False: infeasible. */
static bool evaluate(const scalar *t, oracle_reals *s, double x, mpfr_srcptr h, const double *fields, mpfr_t value[5])
{
    bool feasible = true;
    mpfr_t at;
    mpfr_init2(at, PRECISION);
    for (int i = 0; i < 5 && feasible; i++) {
        mpfr_mul_si(at, h, i - 2, MPFR_RNDN);
        mpfr_add_d(at, at, x, MPFR_RNDN);
        s->used = 0;
        mpfr_ptr found = t->value(s, at, fields);
        feasible = found != NULL && mpfr_number_p(found);
        if (feasible) mpfr_set(value[i], found, MPFR_RNDN);
    }
    mpfr_clear(at);
    return feasible;
}

/* First and second derivative by the step k h, k = 1, 2. */
static void difference(oracle_reals *s, mpfr_srcptr h, mpfr_t value[5], int k, mpfr_ptr d[2])
{
    mpfr_ptr step = oracle_scaled(s, k, h), twice = oracle_scaled(s, 2, value[2]);
    d[0] = oracle_div(s, oracle_sub(s, value[2 + k], value[2 - k]), oracle_scaled(s, 2, step));
    d[1] = oracle_div(s, oracle_sub(s, oracle_add(s, value[2 + k], value[2 - k]), twice), oracle_mul(s, step, step));
}

/* Twice the step gives the same to 2^-60: the step is short against whatever happens near x. noise: what f' and f'' are made of, where they vanish. */
static bool agree(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b, double noise)
{
    double off = fabs(mpfr_get_d(oracle_sub(s, a, b), MPFR_RNDN));
    return off <= 0x1p-60 * fabs(mpfr_get_d(a, MPFR_RNDN)) + 0x1p-150 * noise;
}

cipc_verdict cipc_oracle_scalar(const char *name, double x, const double *fields, double f[3])
{
    const scalar *t = table;
    while (t < table + sizeof table / sizeof table[0] && strcmp(t->name, name) != 0) t++;
    if (t == table + sizeof table / sizeof table[0] || !isfinite(x)) return CIPC_INDETERMINATE;
    oracle_reals s;
    mpfr_t h, value[5];
    double size = x != 0 ? fabs(x) : 1;
    oracle_reals_init(&s, PRECISION);
    mpfr_init2(h, PRECISION);
    for (int i = 0; i < 5; i++) mpfr_init2(value[i], PRECISION);
    mpfr_set_ui_2exp(h, 1, ilogb(size) - STEP_BITS, MPFR_RNDN);
    bool good = evaluate(t, &s, x, h, fields, value);
    if (good) {
        mpfr_ptr d[2], wider[2];
        s.used = 0;
        difference(&s, h, value, 1, d);
        difference(&s, h, value, 2, wider);
        f[0] = mpfr_get_d(value[2], MPFR_RNDN);
        for (int i = 0; i < 2; i++) f[1 + i] = mpfr_get_d(d[i], MPFR_RNDN);
        good = agree(&s, d[0], wider[0], fabs(f[0]) / size + fabs(f[2]) * size) && agree(&s, d[1], wider[1], (fabs(f[0]) / size + fabs(f[1])) / size);
    }
    for (int i = 0; i < 5; i++) mpfr_clear(value[i]);
    mpfr_clear(h);
    oracle_reals_clear(&s);
    return good ? CIPC_YES : CIPC_INDETERMINATE;
}
