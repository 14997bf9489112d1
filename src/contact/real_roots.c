/* Between neighbouring roots of its derivative a polynomial is monotone and has at most one root: found there by Newton's method, kept inside a bracket. */
#include "contact/real_roots.h"

#include <math.h>
#include <stdbool.h>

/* Newton and bisection together end long before that; it is only there so that the loop ends whatever the rounding. */
enum { MOST_STEPS = 200 };

static double value(const double *c, int degree, double t)
{
    double sum = c[degree];
    for (int i = degree - 1; i >= 0; i--) sum = sum * t + c[i];
    return sum;
}

static double slope(const double *c, int degree, double t)
{
    double sum = degree * c[degree];
    for (int i = degree - 1; i >= 1; i--) sum = sum * t + i * c[i];
    return sum;
}

/* The root between from and to, where the values have opposite signs: until the value is 0, Newton's step vanishes, or no double is left in between. */
static double bracketed_root(const double *c, int degree, double from, double to)
{
    double at_from = value(c, degree, from), t = to;
    for (int i = 0; i < MOST_STEPS; i++) {
        double f = value(c, degree, t);
        if (f == 0) return t;
        if ((f > 0) == (at_from > 0)) from = t;
        else to = t;
        double next = t - f / slope(c, degree, t), middle = from + 0.5 * (to - from);
        if (next == t) return t;
        if (!(next > from && next < to) || i % 4 == 3) next = middle; /* every fourth step at least halves the bracket */
        if (next <= from || next >= to) return to;
        t = next;
    }
    return to;
}

/* Nowhere in [0, end] can the other terms make up for the first one. */
static bool far_from_zero(const double *c, int degree, double end)
{
    double others = 0, power = 1;
    for (int i = 1; i <= degree; i++) {
        power *= end;
        others += fabs(c[i]) * power;
    }
    return fabs(c[0]) > others * (1 + 0x1p-48);
}

int contact_real_roots(const double *c, int degree, double end, double roots[CONTACT_POLYNOMIAL_DEGREE])
{
    double derivative[CONTACT_POLYNOMIAL_DEGREE] = {0}, turns[CONTACT_POLYNOMIAL_DEGREE + 1];
    while (degree > 0 && c[degree] == 0) degree--;
    if (degree == 0 || far_from_zero(c, degree, end)) return 0;
    for (int i = 1; i <= degree; i++) derivative[i - 1] = i * c[i];
    int turn_count = contact_real_roots(derivative, degree - 1, end, turns), count = 0;
    if (turn_count == 0 || turns[turn_count - 1] < end) turns[turn_count++] = end;
    double from = 0, at_from = value(c, degree, 0);
    for (int i = 0; i < turn_count; i++) {
        double to = turns[i], at_to = value(c, degree, to);
        bool changes = (at_from < 0 && at_to > 0) || (at_from > 0 && at_to < 0);
        if (at_to == 0) roots[count++] = to;
        else if (changes) roots[count++] = bracketed_root(c, degree, from, to);
        from = to;
        at_from = at_to;
    }
    return count;
}
