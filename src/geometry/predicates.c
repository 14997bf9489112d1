/* Exact orientation signs: floating-point filter, then integers. SPEC V.1; docs/theory/distance.md section 8. */
#include "geometry/predicates.h"

#include <float.h>
#include <gmp.h>
#include <math.h>

#include "cipc/geometry.h"
#include "base/vector.h"

/* Bounds of section 8.2, in units u = 2^-53: eight (four) roundings per monomial in 3-D (2-D), and the rest covers those of the bound. */
#define ORIENT3D_BOUND (10.0 * 0.5 * DBL_EPSILON)
#define ORIENT2D_BOUND (6.0 * 0.5 * DBL_EPSILON)
/* Underflow loses at most 2^-1075 per product; the smallest normal number, 2^-1022, covers all products of one determinant, and is quick to
 * multiply with, which the smallest positive one is not. */
#define UNDERFLOW_BOUND DBL_MIN

/* The sign of a computed determinant that is off by at most `bound`. NaN and infinity, from overflow, fail the comparison. */
static int certain_sign(double determinant, double bound)
{
    if (!(fabs(determinant) > bound)) return CIPC_UNDECIDED;
    return determinant > 0.0 ? 1 : -1;
}

int cipc_orient3d_filter(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double p[3], q[3], r[3];
    v3_sub(p, b, a);
    v3_sub(q, c, a);
    v3_sub(r, d, a);
    double yz = q[1] * r[2], zy = q[2] * r[1], zx = q[2] * r[0], xz = q[0] * r[2], xy = q[0] * r[1], yx = q[1] * r[0];
    double determinant = p[0] * (yz - zy) + p[1] * (zx - xz) + p[2] * (xy - yx);
    double px = fabs(p[0]), py = fabs(p[1]), pz = fabs(p[2]);
    double permanent = px * (fabs(yz) + fabs(zy)) + py * (fabs(zx) + fabs(xz)) + pz * (fabs(xy) + fabs(yx));
    return certain_sign(determinant, ORIENT3D_BOUND * permanent + UNDERFLOW_BOUND * (1.0 + px + py + pz));
}

int cipc_orient2d_filter(const double a[3], const double b[3], const double c[3], int axis)
{
    int x = (axis + 1) % 3, y = (axis + 2) % 3;
    double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
    return certain_sign(left - right, ORIENT2D_BOUND * (fabs(left) + fabs(right)) + UNDERFLOW_BOUND);
}

/* Least power of two that all the numbers are integer multiples of, as an exponent (any large one if all are zero). */
static int common_exponent(const double *const *points, int count)
{
    int least = DBL_MAX_EXP;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            int exponent;
            if (points[i][k] == 0.0) continue;
            (void)frexp(points[i][k], &exponent);
            if (exponent - DBL_MANT_DIG < least) least = exponent - DBL_MANT_DIG;
        }
    }
    return least;
}

/* r = value / 2^least, an integer. */
static void set_scaled(mpz_t r, double value, int least)
{
    int exponent;
    double mantissa = frexp(value, &exponent);
    mpz_set_d(r, ldexp(mantissa, DBL_MANT_DIG));
    if (value != 0.0) mpz_mul_2exp(r, r, (mp_bitcnt_t)(exponent - DBL_MANT_DIG - least));
}

/* rows[3 (i-1) + k] = points[i][k] - points[0][k], all scaled by one power of two, for i = 1 .. count-1. */
static void exact_differences(mpz_t rows[9], const double *const *points, int count)
{
    int least = common_exponent(points, count);
    mpz_t origin;
    mpz_init(origin);
    for (int k = 0; k < 3; k++) {
        set_scaled(origin, points[0][k], least);
        for (int i = 1; i < count; i++) {
            mpz_init(rows[3 * (i - 1) + k]);
            set_scaled(rows[3 * (i - 1) + k], points[i][k], least);
            mpz_sub(rows[3 * (i - 1) + k], rows[3 * (i - 1) + k], origin);
        }
    }
    mpz_clear(origin);
}

/* r = p s - q t. */
static void determinant2(mpz_t r, const mpz_t p, const mpz_t s, const mpz_t q, const mpz_t t)
{
    mpz_mul(r, p, s);
    mpz_submul(r, q, t);
}

int cipc_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3])
{
    const double *const points[4] = {a, b, c, d};
    mpz_t m[9], minor, determinant;
    exact_differences(m, points, 4);
    mpz_inits(minor, determinant, NULL);
    for (int k = 0; k < 3; k++) { /* along the first row */
        int y = (k + 1) % 3, z = (k + 2) % 3;
        determinant2(minor, m[3 + y], m[6 + z], m[3 + z], m[6 + y]);
        mpz_addmul(determinant, m[k], minor);
    }
    int sign = mpz_sgn(determinant);
    mpz_clears(minor, determinant, NULL);
    for (int i = 0; i < 9; i++) mpz_clear(m[i]);
    return sign;
}

int cipc_orient2d_exact(const double a[3], const double b[3], const double c[3], int axis)
{
    const double *const points[3] = {a, b, c};
    int x = (axis + 1) % 3, y = (axis + 2) % 3;
    mpz_t m[9], determinant;
    exact_differences(m, points, 3);
    mpz_init(determinant);
    determinant2(determinant, m[x], m[3 + y], m[y], m[3 + x]);
    int sign = mpz_sgn(determinant);
    mpz_clear(determinant);
    for (int i = 0; i < 6; i++) mpz_clear(m[i]);
    return sign;
}

/* Do all points share one coordinate? Then they are coplanar; common in flat cloth, and cheaper to see than to compute. */
static bool share_coordinate(const double a[3], const double b[3], const double c[3], const double d[3])
{
    for (int k = 0; k < 3; k++)
        if (a[k] == b[k] && a[k] == c[k] && a[k] == d[k]) return true;
    return false;
}

int cipc_orient3d(const double a[3], const double b[3], const double c[3], const double d[3])
{
    int sign = cipc_orient3d_filter(a, b, c, d);
    if (sign != CIPC_UNDECIDED) return sign;
    return share_coordinate(a, b, c, d) ? 0 : cipc_orient3d_exact(a, b, c, d);
}

int cipc_orient2d(const double a[3], const double b[3], const double c[3], int axis)
{
    int sign = cipc_orient2d_filter(a, b, c, axis);
    return sign != CIPC_UNDECIDED ? sign : cipc_orient2d_exact(a, b, c, axis);
}
