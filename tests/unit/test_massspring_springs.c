/* Springs: the three forms, their signs, energies and digits; forces on both ends. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include <mpfr.h>

#include "cipc/massspring.h"

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g: %g off", got, want, got / want - 1);
}

static void test_linear_and_slack(void **state)
{
    (void)state;
    cipc_spring s = {.form = CIPC_SPRING_LINEAR, .length = 2, .stiffness = 3};
    assert_true(cipc_spring_tension(&s, 2.5) == 1.5);
    assert_true(cipc_spring_tension(&s, 1.5) == -1.5);
    s.form = CIPC_SPRING_TENSION;
    assert_true(cipc_spring_tension(&s, 2.5) == 1.5);
    assert_true(cipc_spring_tension(&s, 2) == 0);
    assert_true(cipc_spring_tension(&s, 1.5) == 0);
    s.form = CIPC_SPRING_BUCKLING;
    s.bending = 1;
    assert_true(cipc_spring_tension(&s, 2.5) == 1.5);
    assert_true(cipc_spring_tension(&s, 2) == 0);
}

/* u in [0, pi] with sin(u)/u = r/L by bisection in 320 bits, then (4) as it stands. */
static double exact_buckled(double bending, double length, double r)
{
    enum { BITS = 320 };
    mpfr_t low, high, u, ratio, t, cosine;
    mpfr_inits2(BITS, low, high, u, ratio, t, cosine, (mpfr_ptr)0);
    mpfr_set_d(ratio, r, MPFR_RNDN);
    mpfr_div_d(ratio, ratio, length, MPFR_RNDN);
    mpfr_set_ui(low, 0, MPFR_RNDN);
    mpfr_const_pi(high, MPFR_RNDN);
    for (int i = 0; i < BITS; i++) {
        mpfr_add(u, low, high, MPFR_RNDN);
        mpfr_div_2ui(u, u, 1, MPFR_RNDN);
        mpfr_sin(t, u, MPFR_RNDN);
        mpfr_div(t, t, u, MPFR_RNDN);
        if (mpfr_cmp(t, ratio) > 0) mpfr_set(low, u, MPFR_RNDN);
        else mpfr_set(high, u, MPFR_RNDN);
    }
    mpfr_cos(cosine, u, MPFR_RNDN);
    mpfr_sub(cosine, cosine, ratio, MPFR_RNDN);
    mpfr_mul_ui(t, u, 2, MPFR_RNDN);
    mpfr_div_d(t, t, length, MPFR_RNDN); /* kappa */
    mpfr_sqr(t, t, MPFR_RNDN);
    mpfr_mul_d(t, t, bending, MPFR_RNDN);
    mpfr_div(t, t, cosine, MPFR_RNDN);
    const double f = mpfr_get_d(t, MPFR_RNDN);
    mpfr_clears(low, high, u, ratio, t, cosine, (mpfr_ptr)0);
    return f;
}

/* A spring so stiff that the arc is what pushes less, from the last number below L to the ends' meeting. */
static void test_the_arc_in_high_precision(void **state)
{
    (void)state;
    const double length = 0.3, bending = 2e-6, lost[] = {0x1p-52, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1};
    const cipc_spring s = {.form = CIPC_SPRING_BUCKLING, .length = length, .stiffness = 1e30, .bending = bending};
    for (int i = 0; i < (int)(sizeof lost / sizeof *lost); i++) {
        const double r = length * (1 - lost[i]);
        assert_relative(cipc_spring_tension(&s, r), exact_buckled(bending, length, r), 8 * DBL_EPSILON);
    }
    assert_relative(cipc_spring_tension(&s, nextafter(length, 0)), -12 * bending / (length * length), 4 * DBL_EPSILON);       /* its limit at L */
    assert_relative(cipc_spring_tension(&s, 0), -4 * M_PI * M_PI * bending / (length * length), 8 * DBL_EPSILON);            /* at 0 */
}

/* Linear where that pushes less, then the arc; continuous, monotone; without bending stiffness there is nothing to push. */
static void test_where_it_buckles(void **state)
{
    (void)state;
    cipc_spring s = {.form = CIPC_SPRING_BUCKLING, .length = 1, .stiffness = 100, .bending = 0.5}; /* 12 k_b/L^2 = 6: from a loss of a little more than 0.06 on */
    assert_relative(cipc_spring_tension(&s, 1 - 0.03125), -3.125, DBL_EPSILON);
    const double arc = cipc_spring_tension(&s, 0.5);
    assert_true(arc > -50 && arc < -6);
    double before = 1, last = 0;
    for (int i = 1; i <= 10000; i++) {
        const double r = 1 - 1e-4 * i, f = cipc_spring_tension(&s, r);
        assert_true(f <= last && last - f <= 100 * (before - r) * (1 + 1e-9));
        before = r;
        last = f;
    }
    s.bending = 0;
    assert_true(cipc_spring_tension(&s, 0.5) == 0);
    s.bending = 100; /* so stiff that it never buckles: 12 k_b/L^2 is above k L */
    assert_true(cipc_spring_tension(&s, 0.25) == -75);
}

/* k/2 (r - d)^2; of the arc the energy of a beam of curvature kappa, k_b L kappa^2/2 (5), from an inverse of sin(u)/u by bisection. */
static double energy_of(const cipc_spring *s, const double x[6], bool buckled)
{
    const double r = hypot(hypot(x[3] - x[0], x[4] - x[1]), x[5] - x[2]), d = s->length;
    if (s->form == CIPC_SPRING_TENSION && r < d) return 0;
    if (!buckled) return 0.5 * s->stiffness * (r - d) * (r - d);
    double low = 1e-3, high = M_PI;
    for (int i = 0; i < 200; i++) {
        const double u = 0.5 * (low + high);
        if (sin(u) / u > r / d) low = u;
        else high = u;
    }
    return 2 * s->bending * low * low / d;
}

static void assert_gradient(const cipc_spring *s, const double x[6], bool buckled)
{
    const double rest[6] = {0}, step = 1e-6;
    double f[3];
    cipc_spring_force(s, x, rest, f);
    const double size = fabs(f[0]) + fabs(f[1]) + fabs(f[2]);
    for (int k = 0; k < 3; k++) {
        double less[6], more[6];
        for (int i = 0; i < 6; i++) less[i] = more[i] = x[i];
        less[k] -= step;
        more[k] += step;
        const double slope = (energy_of(s, more, buckled) - energy_of(s, less, buckled)) / (2 * step);
        if (!(fabs(f[k] + slope) <= 1e-8 * size)) fail_msg("form %d: force %.17g, -dE/dx %.17g", (int)s->form, f[k], -slope);
    }
}

static void test_force_is_minus_the_gradient(void **state)
{
    (void)state;
    const double stretched[6] = {0.1, 0.2, -0.1, 0.9, 1.3, -0.4}, shortened[6] = {0.1, 0.2, -0.1, 0.4, 0.7, 0.2};
    cipc_spring s = {.length = 1, .stiffness = 3, .bending = 0.01};
    assert_gradient(&s, stretched, false);
    assert_gradient(&s, shortened, false);
    s.form = CIPC_SPRING_TENSION;
    assert_gradient(&s, stretched, false);
    s.form = CIPC_SPRING_BUCKLING;
    assert_gradient(&s, stretched, false);
    assert_gradient(&s, shortened, true);
}

/* The library's energy: nothing at rest, and between any two lengths the work of the tension, which is taken by Simpson's rule on steps so fine that the kink, where the spring gives way, costs no more than
 * a step's length times the change of slope (some k) times a step: 1e-8 of k L^2. */
static void test_energy_is_the_work(void **state)
{
    (void)state;
    enum { STEPS = 10000 };
    const cipc_spring_form forms[] = {CIPC_SPRING_LINEAR, CIPC_SPRING_TENSION, CIPC_SPRING_BUCKLING, CIPC_SPRING_BUCKLING, CIPC_SPRING_BUCKLING};
    const double bendings[] = {0, 0, 0.01, 0, 100}; /* gives way on the way; at once; never */
    for (size_t f = 0; f < sizeof forms / sizeof *forms; f++) {
        const cipc_spring s = {.form = forms[f], .length = 1, .stiffness = 3, .bending = bendings[f]};
        const double h = 0.9 / STEPS;
        double work = 0;
        assert_true(cipc_spring_energy(&s, 1) == 0);
        assert_true(cipc_spring_energy(&s, 1.5) == 0.375);
        for (int i = 0; i < STEPS; i++) {
            const double r = 1 - i * h;
            work -= h / 6 * (cipc_spring_tension(&s, r) + 4 * cipc_spring_tension(&s, r - 0.5 * h) + cipc_spring_tension(&s, r - h));
            if (i % 500 == 499) assert_true(fabs(cipc_spring_energy(&s, r - h) - work) < 1e-8 * s.stiffness);
        }
    }
}

/* The first end is pulled towards the second; seen from the other end the force is the opposite to the last bit, and damping resists the ends' drawing apart only. */
static void test_pairs_and_damping(void **state)
{
    (void)state;
    const double x[6] = {0.1, 0.7, -0.3, 0.9, 1.1, 0.4}, back[6] = {0.9, 1.1, 0.4, 0.1, 0.7, -0.3};
    const double v[6] = {0.2, -0.1, 0.5, 0.3, 0.8, -0.7}, v_back[6] = {0.3, 0.8, -0.7, 0.2, -0.1, 0.5};
    for (int form = 0; form <= CIPC_SPRING_BUCKLING; form++) {
        const cipc_spring s = {.form = (cipc_spring_form)form, .length = 1.25, .stiffness = 7, .damping = 0.3, .bending = 0.01};
        double f[3], opposite[3];
        cipc_spring_force(&s, x, v, f);
        cipc_spring_force(&s, back, v_back, opposite);
        for (int k = 0; k < 3; k++) assert_true(f[k] == -opposite[k]);
    }
    const cipc_spring s = {.length = 2, .stiffness = 3, .damping = 0.5};
    const double along[6] = {0, 0, 0, 3, 0, 0}, apart[6] = {-1, 5, 0, 3, 0, 7};
    double f[3];
    cipc_spring_force(&s, along, apart, f);
    assert_true(f[0] == 3 + 0.5 * 4 && f[1] == 0 && f[2] == 0);
    const double met[6] = {1, 2, 3, 1, 2, 3};
    cipc_spring_force(&s, met, apart, f);
    assert_true(f[0] == 0 && f[1] == 0 && f[2] == 0);
}

static void test_stiffness_of_a_sheet(void **state)
{
    (void)state;
    assert_relative(cipc_spring_stiffness_of_sheet(4e5, 3e-4), 60 * sqrt(3.0), 4 * DBL_EPSILON);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_and_slack),
        cmocka_unit_test(test_the_arc_in_high_precision),
        cmocka_unit_test(test_where_it_buckles),
        cmocka_unit_test(test_force_is_minus_the_gradient),
        cmocka_unit_test(test_energy_is_the_work),
        cmocka_unit_test(test_pairs_and_damping),
        cmocka_unit_test(test_stiffness_of_a_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
