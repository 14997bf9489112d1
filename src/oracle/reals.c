/* A store of MPFR numbers, so that formulas read as formulas. */
#include "oracle/reals.h"

void oracle_reals_init(oracle_reals *s, mpfr_prec_t precision)
{
    s->precision = precision;
    s->used = s->made = 0;
    s->sides = 0;
}

void oracle_reals_clear(oracle_reals *s)
{
    for (int i = 0; i < s->made; i++) mpfr_clear(s->value[i]);
    s->used = s->made = 0;
}

/* No formula comes near the limit: the largest, of a tetrahedron, takes some 220. */
static mpfr_ptr fresh(oracle_reals *s)
{
    if (s->used == s->made) mpfr_init2(s->value[s->made++], s->precision);
    return s->value[s->used++];
}

mpfr_ptr oracle_number(oracle_reals *s, double x)
{
    mpfr_ptr r = fresh(s);
    mpfr_set_d(r, x, MPFR_RNDN);
    return r;
}

#define BINARY(name, operation)                                          \
    mpfr_ptr name(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b)         \
    {                                                                    \
        mpfr_ptr r = fresh(s);                                           \
        operation(r, a, b, MPFR_RNDN);                                   \
        return r;                                                        \
    }
BINARY(oracle_add, mpfr_add)
BINARY(oracle_sub, mpfr_sub)
BINARY(oracle_mul, mpfr_mul)
BINARY(oracle_div, mpfr_div)

mpfr_ptr oracle_scaled(oracle_reals *s, double factor, mpfr_srcptr a)
{
    mpfr_ptr r = fresh(s);
    mpfr_mul_d(r, a, factor, MPFR_RNDN);
    return r;
}

mpfr_ptr oracle_sqrt(oracle_reals *s, mpfr_srcptr a)
{
    mpfr_ptr r = fresh(s);
    mpfr_sqrt(r, a, MPFR_RNDN);
    return r;
}

mpfr_ptr oracle_log(oracle_reals *s, mpfr_srcptr a)
{
    mpfr_ptr r = fresh(s);
    mpfr_log(r, a, MPFR_RNDN);
    return r;
}

oracle_real3 oracle_point(const mpfr_t *x, int node) { return (oracle_real3){{x[3 * node], x[3 * node + 1], x[3 * node + 2]}}; }

oracle_real3 oracle_difference(oracle_reals *s, const mpfr_t *x, int node, int from)
{
    oracle_real3 r;
    for (int k = 0; k < 3; k++) r.c[k] = oracle_sub(s, x[3 * node + k], x[3 * from + k]);
    return r;
}

oracle_real3 oracle_cross(oracle_reals *s, oracle_real3 a, oracle_real3 b)
{
    oracle_real3 r;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        r.c[k] = oracle_sub(s, oracle_mul(s, a.c[i], b.c[j]), oracle_mul(s, a.c[j], b.c[i]));
    }
    return r;
}

mpfr_ptr oracle_dot(oracle_reals *s, oracle_real3 a, oracle_real3 b)
{
    mpfr_ptr first = oracle_add(s, oracle_mul(s, a.c[0], b.c[0]), oracle_mul(s, a.c[1], b.c[1]));
    return oracle_add(s, first, oracle_mul(s, a.c[2], b.c[2]));
}
