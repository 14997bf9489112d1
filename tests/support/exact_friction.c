#include "support/exact_friction.h"

#include <mpfr.h>

enum { BITS = 400 };

exact_friction exact_friction_step(double level, double sigma0, double v, double dt, double z)
{
    exact_friction result;
    mpfr_t bound, share, change, term;
    mpfr_inits2(BITS, bound, share, change, term, (mpfr_ptr)0);
    mpfr_set_d(bound, level, MPFR_RNDN);
    mpfr_div_d(bound, bound, sigma0, MPFR_RNDN);
    mpfr_set_d(share, v < 0 ? v : -v, MPFR_RNDN);
    mpfr_mul_d(share, share, dt, MPFR_RNDN);
    mpfr_div(share, share, bound, MPFR_RNDN); /* -u */
    mpfr_exp(term, share, MPFR_RNDN);
    mpfr_mul_d(term, term, z < 0 ? -z : z, MPFR_RNDN);
    mpfr_expm1(share, share, MPFR_RNDN);
    mpfr_neg(share, share, MPFR_RNDN);
    mpfr_mul(change, bound, share, MPFR_RNDN);
    mpfr_add(term, term, change, MPFR_RNDN);
    result.size = mpfr_get_d(term, MPFR_RNDN);
    if (v < 0) mpfr_neg(bound, bound, MPFR_RNDN);
    mpfr_sub_d(change, bound, z, MPFR_RNDN);
    mpfr_mul(change, change, share, MPFR_RNDN);
    result.change = mpfr_get_d(change, MPFR_RNDN);
    mpfr_add_d(term, change, z, MPFR_RNDN);
    result.z = mpfr_get_d(term, MPFR_RNDN);
    mpfr_clears(bound, share, change, term, (mpfr_ptr)0);
    return result;
}

static double tanh_of(double a, int defect)
{
    mpfr_t x, y;
    mpfr_inits2(BITS, x, y, (mpfr_ptr)0);
    mpfr_set_d(x, a, MPFR_RNDN);
    mpfr_tanh(y, x, MPFR_RNDN);
    mpfr_sub(x, x, y, MPFR_RNDN);
    double result = mpfr_get_d(defect ? x : y, MPFR_RNDN);
    mpfr_clears(x, y, (mpfr_ptr)0);
    return result;
}

double exact_tanh(double a) { return tanh_of(a, 0); }
double exact_tanh_defect(double a) { return tanh_of(a, 1); }

double exact_log_ratio(double scale, double numerator, double denominator)
{
    mpfr_t x;
    mpfr_init2(x, BITS);
    mpfr_set_d(x, numerator, MPFR_RNDN);
    mpfr_div_d(x, x, denominator, MPFR_RNDN);
    mpfr_log(x, x, MPFR_RNDN);
    mpfr_mul_d(x, x, scale, MPFR_RNDN);
    double result = mpfr_get_d(x, MPFR_RNDN);
    mpfr_clear(x);
    return result;
}

double friction_block_spring(const friction_block *block)
{
    return block->spring * (block->pull * block->time - block->x);
}

void friction_block_step(friction_block *block, const cipc_friction_force *force, double dt)
{
    block->v += dt / block->mass * (friction_block_spring(block) + block->load - block->drag * block->v - block->friction);
    block->x += dt * block->v;
    block->friction = cipc_friction_step(force, block->v, dt, &block->z);
    block->time += dt;
}
