/* Small vectors and matrices, all static inline: the alphabet of the formulas above. v[3] are metres unless said; M[9] is row-major. */
#ifndef CIPC_BASE_VECTOR_H
#define CIPC_BASE_VECTOR_H

#include <math.h>

/* The smaller and the larger of two numbers, inlined; NaN in b is passed on, NaN in a is not. */
static inline double min2(double a, double b) { return a < b ? a : b; }
static inline double max2(double a, double b) { return a > b ? a : b; }

static inline void v3_sub(double r[3], const double a[3], const double b[3]) { for (int i = 0; i < 3; i++) r[i] = a[i] - b[i]; }
static inline void v3_add(double r[3], const double a[3], const double b[3]) { for (int i = 0; i < 3; i++) r[i] = a[i] + b[i]; }
static inline void v3_scale(double r[3], double s, const double a[3]) { for (int i = 0; i < 3; i++) r[i] = s * a[i]; }
static inline void v3_axpy(double r[3], double s, const double a[3]) { for (int i = 0; i < 3; i++) r[i] += s * a[i]; }
static inline void v3_copy(double r[3], const double a[3]) { for (int i = 0; i < 3; i++) r[i] = a[i]; }
static inline double v3_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline double v3_norm2(const double a[3]) { return v3_dot(a, a); }
static inline double v3_norm(const double a[3]) { return sqrt(v3_dot(a, a)); }
static inline void v3_cross(double r[3], const double a[3], const double b[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    r[0] = x; r[1] = y; r[2] = z;
}

#endif
