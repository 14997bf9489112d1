/* Exact comparison of the Green strains of woven cloth with limits, in integers (SPEC C.3, V.5 M3).
 *
 * A direction w, projected onto the plane of the rest triangle with edges E1, E2, is c1 E1 + c2 E2 with c = Ibar^-1 (w.E1, w.E2), Ibar the
 * first fundamental form at rest. In the present shape it has become c1 e1 + c2 e2. So, for directions c and k,
 *   E = 1/2 (c^T I k - c^T Ibar k) / sqrt(c^T Ibar c  k^T Ibar k),
 * and |E| < L can be squared: rational in the doubles given, although the directions of unit length are not. With adj Ibar in place of
 * Ibar^-1 there is no division either. */
#include "cipc/oracle.h"

#include <math.h>

#include "oracle/integers.h"

/* Edges of a triangle in some unit and its first fundamental form in the square of it: |e1|^2, e1.e2, |e2|^2. */
typedef struct exact_triangle {
    cipc_integer3 e1, e2;
    mpz_t form[3];
} exact_triangle;

/* The two directions c and k of a component, each in the edges at rest. */
typedef struct exact_axes {
    mpz_t c[2], k[2];
} exact_axes;

static void triangle_init(exact_triangle *t, const double x[9], int exponent)
{
    cipc_integer3 first;
    cipc_integer3_init(&first);
    cipc_integer3_init(&t->e1);
    cipc_integer3_init(&t->e2);
    mpz_inits(t->form[0], t->form[1], t->form[2], NULL);
    cipc_integer3_from_doubles(&first, &x[0], exponent);
    cipc_integer3_from_doubles(&t->e1, &x[3], exponent);
    cipc_integer3_from_doubles(&t->e2, &x[6], exponent);
    cipc_integer3_sub(&t->e1, &t->e1, &first);
    cipc_integer3_sub(&t->e2, &t->e2, &first);
    cipc_integer3_dot(t->form[0], &t->e1, &t->e1);
    cipc_integer3_dot(t->form[1], &t->e1, &t->e2);
    cipc_integer3_dot(t->form[2], &t->e2, &t->e2);
    cipc_integer3_clear(&first);
}

static void triangle_clear(exact_triangle *t)
{
    cipc_integer3_clear(&t->e1);
    cipc_integer3_clear(&t->e2);
    mpz_clears(t->form[0], t->form[1], t->form[2], NULL);
}

/* c = adj Ibar (w.E1, w.E2). */
static void project(mpz_t c[2], const exact_triangle *rest, const cipc_integer3 *w)
{
    mpz_t r1, r2;
    mpz_inits(r1, r2, NULL);
    cipc_integer3_dot(r1, w, &rest->e1);
    cipc_integer3_dot(r2, w, &rest->e2);
    mpz_mul(c[0], rest->form[2], r1);
    mpz_submul(c[0], rest->form[1], r2);
    mpz_mul(c[1], rest->form[0], r2);
    mpz_submul(c[1], rest->form[1], r1);
    mpz_clears(r1, r2, NULL);
}

/* Warp and weft in the edges at rest; a weft of no length: across the warp, (E1 x E2) x warp. */
static void project_both(mpz_t warp_axis[2], mpz_t weft_axis[2], const exact_triangle *rest, const double warp[3], const double weft[3])
{
    cipc_integer3 w, normal, across;
    cipc_integer3_init(&w);
    cipc_integer3_init(&normal);
    cipc_integer3_init(&across);
    cipc_integer3_from_doubles(&w, warp, cipc_common_exponent(warp, 3, 0));
    project(warp_axis, rest, &w);
    if (weft[0] == 0 && weft[1] == 0 && weft[2] == 0) {
        cipc_integer3_cross(&normal, &rest->e1, &rest->e2);
        cipc_integer3_cross(&across, &normal, &w);
    } else {
        cipc_integer3_from_doubles(&across, weft, cipc_common_exponent(weft, 3, 0));
    }
    project(weft_axis, rest, &across);
    cipc_integer3_clear(&w);
    cipc_integer3_clear(&normal);
    cipc_integer3_clear(&across);
}

/* q = a^T form b. */
static void bilinear(mpz_t q, mpz_t form[3], mpz_t a[2], mpz_t b[2])
{
    mpz_t left, right;
    mpz_inits(left, right, NULL);
    mpz_mul(left, form[0], a[0]);
    mpz_addmul(left, form[1], a[1]);
    mpz_mul(right, form[1], a[0]);
    mpz_addmul(right, form[2], a[1]);
    mpz_mul(q, left, b[0]);
    mpz_addmul(q, right, b[1]);
    mpz_clears(left, right, NULL);
}

/* Sign of 4 L^2 (c^T Ibar c) (k^T Ibar k) - (c^T I k - c^T Ibar k)^2, L = limit / 2^-exponent. */
static int compare(exact_axes *axes, exact_triangle *rest, exact_triangle *now, const mpz_t limit, int exponent)
{
    mpz_t change, cc, kk, allowed;
    mpz_inits(change, cc, kk, allowed, NULL);
    bilinear(change, now->form, axes->c, axes->k);
    bilinear(cc, rest->form, axes->c, axes->k);
    mpz_sub(change, change, cc);
    mpz_mul(change, change, change);
    mpz_mul_2exp(change, change, (mp_bitcnt_t)(-2 * exponent));
    bilinear(cc, rest->form, axes->c, axes->c);
    bilinear(kk, rest->form, axes->k, axes->k);
    mpz_mul(allowed, limit, limit);
    mpz_mul(allowed, allowed, cc);
    mpz_mul(allowed, allowed, kk);
    mpz_mul_2exp(allowed, allowed, 2);
    int sign = mpz_cmp(allowed, change);
    mpz_clears(change, cc, kk, allowed, NULL);
    return (sign > 0) - (sign < 0);
}

static bool all_finite(const double rest[9], const double warp[3], const double weft[3])
{
    return cipc_all_finite(rest, 9) && cipc_all_finite(warp, 3) && cipc_all_finite(weft, 3);
}

int cipc_exact_compare_green_strain(cipc_green_strain component, const double rest[9], const double x[9], const double warp[3],
                                    const double weft[3], double limit)
{
    if (!all_finite(rest, warp, weft) || !cipc_all_finite(x, 9) || !isfinite(limit)) { return -1; }
    int exponent = cipc_common_exponent(x, 9, cipc_common_exponent(rest, 9, 0)), limit_exponent = cipc_common_exponent(&limit, 1, 0);
    exact_triangle before, now;
    exact_axes axes;
    mpz_t bound;
    mpz_inits(axes.c[0], axes.c[1], axes.k[0], axes.k[1], bound, NULL);
    triangle_init(&before, rest, exponent);
    triangle_init(&now, x, exponent);
    cipc_integer_from_double(bound, limit, limit_exponent);
    project_both(axes.c, axes.k, &before, warp, weft);
    for (int i = 0; i < 2 && component == CIPC_GREEN_WARP; i++) { mpz_set(axes.k[i], axes.c[i]); }
    for (int i = 0; i < 2 && component == CIPC_GREEN_WEFT; i++) { mpz_set(axes.c[i], axes.k[i]); }
    int sign = compare(&axes, &before, &now, bound, limit_exponent);
    triangle_clear(&before);
    triangle_clear(&now);
    mpz_clears(axes.c[0], axes.c[1], axes.k[0], axes.k[1], bound, NULL);
    return sign;
}

/* Bits of the quotients below: their own error is then far below the one of cutting them to a double. */
enum { QUOTIENT_BITS = 192 };

/* numerator 2^shift / sqrt(square), cut to a double. */
static double over_root(const mpz_t numerator, mp_bitcnt_t shift, const mpz_t square)
{
    mpf_t quotient, root;
    mpf_init2(quotient, QUOTIENT_BITS);
    mpf_init2(root, QUOTIENT_BITS);
    mpf_set_z(quotient, numerator);
    mpf_set_z(root, square);
    mpf_sqrt(root, root);
    mpf_mul_2exp(quotient, quotient, shift);
    mpf_div(quotient, quotient, root);
    double value = mpf_get_d(quotient);
    mpf_clear(quotient);
    mpf_clear(root);
    return value;
}

bool cipc_exact_fabric_axes(const double rest[9], const double warp[3], const double weft[3], double axes[4], double *cosine)
{
    if (!all_finite(rest, warp, weft)) { return false; }
    int exponent = cipc_common_exponent(rest, 9, 0);
    exact_triangle before;
    exact_axes a;
    mpz_t cc, kk, ck;
    mpz_inits(a.c[0], a.c[1], a.k[0], a.k[1], cc, kk, ck, NULL);
    triangle_init(&before, rest, exponent);
    project_both(a.c, a.k, &before, warp, weft);
    bilinear(cc, before.form, a.c, a.c);
    bilinear(kk, before.form, a.k, a.k);
    bilinear(ck, before.form, a.c, a.k);
    bool good = mpz_sgn(cc) > 0 && mpz_sgn(kk) > 0;
    for (int i = 0; i < 2 && good; i++) {
        axes[i] = over_root(a.c[i], (mp_bitcnt_t)-exponent, cc);
        axes[2 + i] = over_root(a.k[i], (mp_bitcnt_t)-exponent, kk);
    }
    mpz_mul(kk, cc, kk);
    if (good) { *cosine = over_root(ck, 0, kk); }
    triangle_clear(&before);
    mpz_clears(a.c[0], a.c[1], a.k[0], a.k[1], cc, kk, ck, NULL);
    return good;
}
