/* The oracle's values and derivatives: closed forms to the last bit, the printed table of SPEC C.2, twice the precision, and what it must refuse to answer. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/energy.h"
#include "cipc/oracle.h"
#include "oracle/energies.h"

enum { N = 12 };
static const long double LN2 = 0.693147180559945309417232121458176568L, PI = 3.14159265358979323846264338327950288L;

typedef struct answer {
    cipc_verdict verdict;
    double value, g[N], H[N * N];
} answer;

static answer ask(const char *name, const double *x, const double *fields)
{
    answer a;
    const cipc_oracle_function *f = cipc_oracle_function_find(name);
    assert_non_null(f);
    memset(&a, 0, sizeof a);
    a.verdict = cipc_oracle_evaluate(f, x, fields, &a.value, a.g, a.H);
    return a;
}

static answer ask_well(const char *name, const double *x, const double *fields)
{
    answer a = ask(name, x, fields);
    assert_int_equal(a.verdict, CIPC_YES);
    return a;
}

static void same(double got, double want)
{
    if (got != want) fail_msg("%.17g, want %.17g", got, want);
}

/* --- closed forms: every number below is the closed form rounded once, and must be met to the last bit --- */

static void test_single_nodes(void **state)
{
    (void)state;
    const double x[3] = {1, 2, 4}, inertia[4] = {3, 0.5, 2, 1}, gravity[4] = {2, 0, -10, 0.25}, penalty[5] = {5, 3, 0, 2, 5};
    answer a = ask_well("inertia", x, inertia);
    same(a.value, 1.5 * (0.25 + 9));
    same(a.g[0], 1.5);
    same(a.g[2], 9);
    same(a.H[4], 3);
    same(a.H[1], 0);
    a = ask_well("gravity", x, gravity);
    same(a.value, -2 * (-20 + 1));
    same(a.g[1], 20);
    same(a.H[4], 0);
    a = ask_well("dirichlet_penalty", x, penalty);
    same(a.value, 7.5 * 2);
    same(a.g[0], 15);
    same(a.H[8], 15);
}

/* D = 2, Dhat = 4: b = 4 ln 2, b' = -4 ln 2 - 2, b'' = 2 ln 2 + 5. */
static void test_barrier_in_closed_form(void **state)
{
    (void)state;
    const double x[6] = {1, 1, 0, 0, 0, 0}, fields[4] = {1, 1, 0, 2};
    answer a = ask_well("barrier_point_point", x, fields);
    same(a.value, (double)(4 * LN2));
    same(a.g[0], (double)(-8 * LN2 - 4));
    same(a.g[3], (double)(8 * LN2 + 4));
    same(a.g[2], 0);
    same(a.H[0], 16); /* 4 b'' + 2 b' */
    same(a.H[1], (double)(8 * LN2 + 20));
    same(a.H[14], (double)(-8 * LN2 - 4));
    double f[3], Dhat = 4;
    assert_int_equal(cipc_oracle_scalar("barrier", 2, &Dhat, f), CIPC_YES);
    same(f[0], (double)(4 * LN2));
    same(f[1], (double)(-4 * LN2 - 2));
    same(f[2], (double)(2 * LN2 + 5));
    assert_int_equal(cipc_oracle_scalar("barrier", 8, &Dhat, f), CIPC_YES); /* beyond its support */
    for (int i = 0; i < 3; i++) same(f[i], 0);
}

/* With thickness: xi = 1, dhat = 1: Dhat = 3; d^2 = 2.5: D = 1.5 = Dhat / 2. Point over an edge, over a triangle; edges crossing, unmollified (eps 0). */
static void test_thickness_and_kinds(void **state)
{
    (void)state;
    const double h = 1.5, fields[6] = {2, 3, 0.5, 1.5, 0, 8}; /* xi = 1/2, reach = 2, Dhat = 15/4; d^2 = 9/4, D = 2 */
    const double edge[9] = {0.25, h, 0, -1, 0, 0, 1, 0, 0}, triangle[12] = {0.25, h, 0.25, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double crossing[12] = {0, h, -1, 0, h, 1, -1, 0, 0, 1, 0, 0};
    long double past = 2 - 15 / 4.0L, slope = -2 * past * logl(2 / (15 / 4.0L)) - past * past / 2;
    answer a = ask_well("barrier_point_edge", edge, fields), b = ask_well("barrier_point_triangle", triangle, fields), c = ask_well("barrier_edge_edge", crossing, fields);
    assert_true(fabs(a.value - (double)(-6 * past * past * logl(2 / (15 / 4.0L)))) <= 4e-16 * a.value);
    same(b.value, a.value);
    same(c.value, a.value);
    assert_true(fabs(a.g[1] - (double)(6 * slope * 2 * h)) <= 4e-16 * fabs(a.g[1])); /* long double's logarithm, rounded */
    same(b.g[1], a.g[1]);
    same(c.g[1] + c.g[4], a.g[1]);
    same(a.g[0], 0);
}

static void test_distances(void **state)
{
    (void)state;
    const double pp[6] = {3, 0, 0, 0, 4, 0}, pe[9] = {5, 3, 0, 0, 0, 0, 2, 0, 0}, pt[12] = {9, 7, 0.5, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    const double ll[12] = {0, 0, 2, 1, 0, 2, 0, 3, 0, 0, 4, 0};
    answer a = ask_well("distance2_point_point", pp, NULL);
    same(a.value, 25);
    same(a.g[0], 6);
    same(a.H[3], -2);
    a = ask_well("distance2_point_line", pe, NULL);
    same(a.value, 9);
    same(a.g[1], 6);
    same(a.g[4], 9);    /* 2 w_1 d, w_1 = t - 1 = 3/2 */
    same(a.g[7], -15);
    a = ask_well("distance2_point_plane", pt, NULL);
    same(a.value, 0.25);
    same(a.g[2], 1);
    same(a.g[5], 15); /* barycentrics -15, 9, 7 */
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < i; j++) same(a.H[12 * i + j], a.H[12 * j + i]);
    a = ask_well("distance2_line_line", ll, NULL);
    same(a.value, 4);
    same(a.g[2], 4);
    same(a.g[5], 0);
    same(a.g[8], -16); /* closest at four edge lengths from b0 = (0, 3, 0) backwards: weights 4, -3 */
    same(a.g[11], 12);
}

/* c = 1. eps = 2: e = 3/4; e'' and e' enter H. Beyond the end: 1, exactly flat. */
static void test_mollifier(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1}, inside = 2, outside = 0.5, none = 0;
    answer a = ask_well("edge_edge_mollifier", x, &inside);
    same(a.value, 0.75);
    same(a.g[3], 1);             /* e' dc/da = 1/2 * 2 */
    same(a.H[3 * 12 + 3], -1);   /* e' 2 + e'' 2 2 = 1 - 2 */
    assert_true(fabs(a.H[3 * 12 + 10]) < 1e-58); /* nothing but what the step leaves, 2^-200 */
    a = ask_well("edge_edge_mollifier", x, &outside);
    same(a.value, 1);
    for (int i = 0; i < 12; i++) same(a.g[i], 0);
    same(ask_well("edge_edge_mollifier", x, &none).value, 1);
}

/* F = diag(2, 1), V = 1, mu = 3, lambda = 5. */
static void test_membranes(void **state)
{
    (void)state;
    const double x[9] = {0, 0, 0, 2, 0, 0, 0, 1, 0}, fields[7] = {1, 0, 1, 0.5, 1, 3, 5};
    answer a = ask_well("membrane_stvk", x, fields);
    same(a.value, 2.5 * 2.25 + 3 * 2.25);
    same(a.g[3], 2 * (5 * 1.5 + 6 * 1.5)); /* F S, S_11 = lambda tr E + 2 mu E_11 */
    same(a.g[7], 5 * 1.5);
    a = ask_well("membrane_neo_hookean", x, fields);
    same(a.value, (double)(1.5L * (3 - 2 * LN2) + 2.5L * LN2 * LN2));
    same(a.g[3], (double)(3 * 2 + (5 * LN2 - 3) / 2));
    same(a.g[7], (double)(5 * LN2)); /* mu + (lambda ln J - mu) */
}

/* SPEC C.2's table, as printed: nine digits. */
static void test_strain_limit_as_tabulated(void **state)
{
    (void)state;
    static const double at[2] = {1.02, 1.05}, b[2][3] = {{.0431643555, 6.96855249, 811.248031}, {1.16865833, 109.365761, 11742.5761}};
    const double range[2] = {1.0608, 1}, fields[7] = {1, 0, 1, 1, 1.0608, 1, 1};
    for (int k = 0; k < 2; k++) {
        double f[3];
        assert_int_equal(cipc_oracle_scalar("strain_limit_barrier", at[k], range, f), CIPC_YES);
        for (int i = 0; i < 3; i++) assert_true(fabs(f[i] - b[k][i]) <= 6e-9 * b[k][i]); /* half a unit of the last printed digit */
        const double x[9] = {0, 0, 0, at[k], 0, 0, 0, 0.5, 0};
        answer a = ask_well("strain_limit", x, fields);
        same(a.value, f[0]);
        same(a.g[3], f[1]);
        same(a.H[3 * 9 + 3], f[2]);
    }
}

/* The lower limit half way: s = 1/2, shat = 1, sigma = 3/4: t = 1/2. The upper one's mirror image. */
static void test_lower_strain_limit(void **state)
{
    (void)state;
    const double x[9] = {0, 0, 0, 0.75, 0, 0, 0, 2, 0}, fields[7] = {1, 0, 1, 1, 0.5, 1, 1};
    answer a = ask_well("strain_limit_lower", x, fields);
    same(a.value, (double)(LN2 / 4));
    same(a.g[3], (double)(-2 * LN2 - 1));
    same(a.H[3 * 9 + 3], (double)(8 * LN2 + 20));
    const double equal[9] = {0, 0, 0, 0.75, 0, 0, 0, 0.75, 0};
    a = ask_well("strain_limit_lower", equal, fields); /* where the stretches are not differentiable, their sum is */
    same(a.value, (double)(LN2 / 2));
    same(a.g[7], (double)(-2 * LN2 - 1));
    same(a.H[7 * 9 + 7], (double)(8 * LN2 + 20));
}

/* E11 = 3/2 of 2, the other strains 0: eta = -Q ln(7/16). Then shear alone, by the rest angle. */
static void test_orthotropic(void **state)
{
    (void)state;
    const double x[9] = {0, 0, 0, 2, 0, 0, 0, 1, 0};
    double fields[13] = {1, 0, 0, 1, 0, 1, 4, 2, 8, 1, 2, 1, 1};
    answer a = ask_well("membrane_orthotropic", x, fields);
    assert_true(fabs(a.value - (double)(-8 * logl(7 / 16.0L))) <= 4e-16 * a.value); /* Q = 4, q = 9/4 */
    assert_true(fabs(a.g[3] - 192 / 7.0) <= 4e-15 * a.g[3]);                         /* a11 eta' E11 f1 = 4 16/7 3/2 2 */
    same(a.g[7], 3);                                                                 /* a12 E11 */
    fields[0] = 0.5; /* f1 a unit vector */
    fields[4] = 0.25; /* E12 = -1/8 */
    a = ask_well("membrane_orthotropic", x, fields);
    assert_true(fabs(a.value - (double)(-logl(63 / 64.0L))) <= 4e-16 * a.value);
}

/* F = diag(2, 1, 1), V = 1, mu = 3, lambda = 5; and a half turn of it. */
static void test_volumes(void **state)
{
    (void)state;
    const double fields[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 3, 5}, x[12] = {0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1}, turned[12] = {1, 1, 1, -1, 1, 1, 1, 0, 1, 1, 1, 2};
    answer a = ask_well("volume_neo_hookean", x, fields);
    same(a.value, (double)(4.5L - 3 * LN2 + 2.5L * LN2 * LN2));
    same(a.g[3], (double)(3 * 2 + (5 * LN2 - 3) / 2));
    same(a.g[7], (double)(5 * LN2));
    a = ask_well("volume_corotational", x, fields);
    same(a.value, 3 + 2.5);
    same(a.g[3], 2 * 3 + 5);      /* 2 mu (sigma - 1) + lambda (J - 1) J / sigma */
    same(a.g[7], 5 * 2);
    same(a.H[3 * 12 + 3], 2 * 3 + 5);
    same(a.H[4 * 12 + 4], 4); /* a shear: 2 mu (1 - 1/(2 + 1)); and with its partner */
    same(a.H[4 * 12 + 6], 2 - 5);
    same(ask_well("volume_corotational", turned, fields).value, 3 + 2.5);
    same(ask_well("volume_neo_hookean", turned, fields).value, (double)(4.5L - 3 * LN2 + 2.5L * LN2 * LN2));
    const double tripled[12] = {0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3};
    a = ask_well("volume_corotational", tripled, fields); /* three equal stretches: sqrt(3 tr C) is their sum */
    same(a.value, 3 * 12 + 2.5 * 26 * 26);
    same(a.H[4 * 12 + 4], 5);
}

/* A right angle, up and down. Stiffness 1, rest angle 0: theta^2 = pi^2/4; the tip's gradient is 2 theta / height. */
static void test_hinge(void **state)
{
    (void)state;
    const double fields[2] = {1, 0};
    for (int sign = -1; sign <= 1; sign += 2) {
        const double x[12] = {0, 0, 0, 1, 0, 0, 0.25, 2, 0, 0.5, 0, -sign};
        answer a = ask_well("hinge_bending", x, fields);
        same(a.value, (double)(PI * PI / 4));
        same(a.g[8], (double)(-sign * PI / 2)); /* height 2, the normal points up, and theta grows when the tip sinks */
        same(a.g[7], 0);
        same(a.H[8 * 12 + 8], 0.5);             /* 2 (1/height)^2 */
    }
}

/* l = 5 against l0 = 4, E A = 8: k = 2, tension 2. */
static void test_rod_stretching(void **state)
{
    (void)state;
    const double x[6] = {1, 1, 1, 4, 5, 1}, fields[2] = {8, 4}, rest[2] = {8, 5};
    answer a = ask_well("rod_stretching", x, fields);
    same(a.value, 1);
    same(a.g[3], (double)(2 * 3 / 5.0L));
    same(a.g[1], (double)(-2 * 4 / 5.0L));
    same(a.H[35], (double)(2 / 5.0L)); /* across: tension / l */
    same(a.H[3 * 6 + 4], (double)((2 - 2 / 5.0L) * 12 / 25));
    a = ask_well("rod_stretching", x, rest);
    same(a.value, 0);
    assert_true(fabs(a.g[3]) < 1e-58); /* nothing but what the step leaves, 2^-200 */
    same(a.H[3 * 6 + 3], (double)(8 / 5.0L * 9 / 25));
}

/* A right angle: kappa = 2, sigma = 2. Stiffness 3. The segments have the lengths 1 and 2. */
static void test_rod_bending(void **state)
{
    (void)state;
    const double x[9] = {-1, 0, 0, 0, 0, 0, 0, 2, 0}, straight[9] = {-1, 0, 0, 0, 0, 0, 2, 0, 0}, soft[2] = {3, 0}, curved[2] = {3, 1};
    answer a = ask_well("rod_bending", x, soft);
    same(a.value, 12);
    same(a.g[1], 24);    /* turning by dphi raises E by 2 k kappa sigma dphi; x0 by dphi / 1, downwards */
    same(a.g[6], -12);
    same(a.H[8 * 9 + 8], 0); /* out of plane: kappa cot phi = 0 */
    same(a.H[6 * 9 + 6], (double)(2 * 3 * 2 * 4 / 4.0L)); /* F (sigma + kappa^2/2) / b^2 */
    a = ask_well("rod_bending", x, curved);
    same(a.value, 3);
    same(a.g[1], 12);
    same(a.H[2 * 9 + 8], (double)(-12 * 0.5L * 2 / -2)); /* F s sigma / (a b), with the minus of e0 = x1 - x0 */
    a = ask_well("rod_bending", straight, soft);
    same(a.value, 0);
    same(a.g[1], 0);
    same(a.H[1 * 9 + 1], 6); /* 2 k / a^2 */
    same(a.H[2 * 9 + 8], 3); /* 2 k / (a b) */
}

static void test_stitch(void **state)
{
    (void)state;
    const double x[9] = {0, 3, 0, 0, 1, 0, 4, 1, 0}, fields[2] = {2, 0.25};
    answer a = ask_well("stitch", x, fields); /* the gap (-1, 2, 0) */
    same(a.value, 5);
    same(a.g[0], -2);
    same(a.g[4], -3);
    same(a.g[7], -1);
    same(a.H[0], 2);
    same(a.H[3 * 9 + 6], 0.375);
}

/* K of two dyads, one of which reaches over all nodes: the first and the last number of the triangle, and the corner between them. */
static void test_damping(void **state)
{
    (void)state;
    double fields[91] = {0.5}, x[12] = {0};
    fields[1] = 1;          /* start */
    fields[12] = -1;
    fields[13] = 4;         /* K_00 */
    fields[13 + 11] = 2;    /* K_0,11 */
    fields[13 + 77] = 3;    /* K_11,11 */
    x[0] = 2;
    x[11] = 1;
    answer a = ask_well("damping", x, fields); /* d = (1, 0, .., 2): 1/4 (4 + 2 * 2 * 2 + 3 * 4) */
    same(a.value, 6);
    same(a.g[0], 4);
    same(a.g[11], 4);
    same(a.g[5], 0);
    same(a.H[0], 2);
    same(a.H[11], 1);
    same(a.H[143], 1.5);
}

/* Sticking at half the width, at rest, at the transition, beyond. */
static void test_friction(void **state)
{
    (void)state;
    double fields[24] = {2, 0.5, 1, -1, 0, 0, 1, 0, 0, 0, 1, 0}, x[12] = {0.25, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0}, f[3], e = 0.5;
    answer a = ask_well("friction", x, fields);
    same(a.value, (double)(2 * (0.0625L / 0.5L * (1 - 0.25L / 1.5L) + 0.5L / 3)));
    same(a.g[0], 2 * 0.75);
    same(a.g[3], -2 * 0.75);
    same(a.g[2], 0);
    same(a.H[0], 2 * 2);      /* f1' = 2/e - 2y/e^2 */
    same(a.H[13], 2 * 3);     /* f1 / y */
    assert_int_equal(cipc_oracle_scalar("friction_mollifier", 0.25, &e, f), CIPC_YES);
    same(f[1], 0.75);
    same(f[2], 2);
    assert_int_equal(cipc_oracle_scalar("friction_mollifier", 2, &e, f), CIPC_YES);
    same(f[0], 2);
    same(f[1], 1);
    same(f[2], 0);
    x[0] = 0;
    a = ask_well("friction", x, fields);
    same(a.value, (double)(1 / 3.0L));
    same(a.H[0], 8);
    same(a.H[13], 8);
    x[0] = 0.5;
    a = ask_well("friction", x, fields); /* on the switch: second derivatives are continuous */
    same(a.g[0], 2);
    same(a.H[13], 4);
    assert_true(fabs(a.H[0]) < 1e-28);
    x[0] = 4;
    a = ask_well("friction", x, fields);
    same(a.value, 8);
    same(a.H[0], 0);
    same(a.H[13], 0.5);
}

/* --- precision --- */

typedef struct named {
    const char *name;
    mpfr_ptr (*value)(oracle_reals *s, const mpfr_t *x, const double *fields);
} named;
static const named formulas[] = {
    {"inertia", oracle_inertia},
    {"gravity", oracle_gravity},
    {"dirichlet_penalty", oracle_dirichlet_penalty},
    {"membrane_neo_hookean", oracle_membrane_neo_hookean},
    {"membrane_stvk", oracle_membrane_stvk},
    {"strain_limit", oracle_strain_limit},
    {"strain_limit_lower", oracle_strain_limit_lower},
    {"membrane_orthotropic", oracle_membrane_orthotropic},
    {"hinge_bending", oracle_hinge_bending},
    {"volume_corotational", oracle_volume_corotational},
    {"volume_neo_hookean", oracle_volume_neo_hookean},
    {"rod_stretching", oracle_rod_stretching},
    {"rod_bending", oracle_rod_bending},
    {"stitch", oracle_stitch},
    {"damping", oracle_damping},
    {"barrier_point_point", oracle_barrier_point_point},
    {"barrier_point_edge", oracle_barrier_point_edge},
    {"barrier_point_triangle", oracle_barrier_point_triangle},
    {"barrier_edge_edge", oracle_barrier_edge_edge},
    {"friction", oracle_friction},
};

static void value_at(const named *f, mpfr_prec_t precision, const double *x, int n, const double *fields, mpfr_t value)
{
    oracle_reals store;
    mpfr_t y[N];
    oracle_reals_init(&store, precision);
    for (int i = 0; i < n; i++) {
        mpfr_init2(y[i], precision);
        mpfr_set_d(y[i], x[i], MPFR_RNDN);
    }
    mpfr_ptr found = f->value(&store, (const mpfr_t *)y, fields);
    assert_non_null(found);
    assert_true(store.used < ORACLE_REALS_LIMIT / 2);
    mpfr_set(value, found, MPFR_RNDN);
    for (int i = 0; i < n; i++) mpfr_clear(y[i]);
    oracle_reals_clear(&store);
}

/* 512 bits against 1024, on every branch: they agree to 2^-380 of the value, unless the value is a square of almost nothing. Second differences at steps of
 * 2^-100 cost 200 bits of that. */
static void test_twice_the_precision(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, 20261127);
    for (size_t k = 0; k < sizeof formulas / sizeof *formulas; k++) {
        const cipc_energy *energy = cipc_energy_find(formulas[k].name);
        for (int trial = 0; trial < 20 * energy->branch_count; trial++) {
            union { double align; unsigned char bytes[1024]; } params = {0};
            double x[N], fields[CIPC_ENERGY_NUMBERS];
            mpfr_t once, twice, difference;
            energy->sample(rng, trial % energy->branch_count, x, &params);
            cipc_energy_numbers(energy, &params, fields);
            mpfr_inits2(1024, once, twice, difference, (mpfr_ptr)NULL);
            value_at(&formulas[k], 512, x, 3 * energy->nodes, fields, once);
            value_at(&formulas[k], 1024, x, 3 * energy->nodes, fields, twice);
            mpfr_sub(difference, once, twice, MPFR_RNDN);
            if (!mpfr_zero_p(difference) && mpfr_get_exp(difference) > mpfr_get_exp(twice) - 380)
                fail_msg("%s: 512 bits are good for 2^%ld only", energy->name, (long)(mpfr_get_exp(difference) - mpfr_get_exp(twice)));
            mpfr_clears(once, twice, difference, (mpfr_ptr)NULL);
        }
    }
    gsl_rng_free(rng);
}

/* --- what is refused --- */

static void refused(const char *name, const double *x, const double *fields)
{
    if (ask(name, x, fields).verdict != CIPC_INDETERMINATE) fail_msg("%s: answered", name);
}

static void test_infeasible_is_refused(void **state)
{
    (void)state;
    const double fields[4] = {1, 1, 1, 1}, touching[6] = {1, 0, 0, 0, 0, 0}, inside[6] = {0.5, 0, 0, 0, 0, 0}, broken[6] = {1, NAN, 0, 0, 0, 0};
    const double limit[7] = {1, 0, 1, 1, 1.5, 1, 1}, stretched[9] = {0, 0, 0, 1.5, 0, 0, 0, 1, 0}, membrane[7] = {1, 0, 1, 0.5, 1, 3, 5};
    const double flat[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, hinge[2] = {1, 0}, collapsed[12] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0}, infinite[4] = {1, 1, 1, INFINITY};
    refused("barrier_point_point", touching, fields);
    refused("barrier_point_point", inside, fields);
    refused("barrier_point_point", broken, fields);
    refused("barrier_point_point", touching, infinite);
    refused("strain_limit", stretched, limit);
    refused("membrane_neo_hookean", flat, membrane);
    refused("hinge_bending", collapsed, hinge);
    const double squeezed[9] = {0, 0, 0, 0.5, 0, 0, 0, 1, 0}, lower[7] = {1, 0, 1, 1, 0.5, 1, 1}, cloth[13] = {1, 0, 0, 1, 0, 1, 1, 1, 1, 1, 0.625, 1, 1};
    const double plane[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, mirrored[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, volume[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 3, 5};
    refused("strain_limit_lower", squeezed, lower);
    refused("strain_limit_lower", flat, lower);
    refused("membrane_orthotropic", stretched, cloth); /* E11 = 5/8 */
    for (int k = 0; k < 2; k++) {
        refused(k ? "volume_corotational" : "volume_neo_hookean", plane, volume);
        refused(k ? "volume_corotational" : "volume_neo_hookean", mirrored, volume);
    }
    double f[3], Dhat = 1;
    assert_int_equal(cipc_oracle_scalar("barrier", 0, &Dhat, f), CIPC_INDETERMINATE);
    assert_int_equal(cipc_oracle_scalar("barrier", NAN, &Dhat, f), CIPC_INDETERMINATE);
    assert_int_equal(cipc_oracle_scalar("no_such_scalar", 1, &Dhat, f), CIPC_INDETERMINATE);
}

/* A gap that the step of 2^-100 of the size crosses, and one that it nearly crosses; a larger one is answered. */
static void test_steps_that_are_too_long_are_noticed(void **state)
{
    (void)state;
    const double fields[4] = {1, 1, 0, 1};
    double x[9] = {0.5, 0, 1e-35, 0, 0, 0, 1, 0, 0};
    refused("barrier_point_edge", x, fields);
    x[2] = 1e-29;
    refused("barrier_point_edge", x, fields);
    x[2] = 1e-24;
    refused("barrier_point_edge", x, fields);
    x[2] = 1e-15;
    assert_int_equal(ask("barrier_point_edge", x, fields).verdict, CIPC_YES);
}

/* On the end of the mollifier, where its second derivative jumps, there is no Hessian; gradient and value there are continuous. One ulp beside there is. */
static void test_end_of_the_mollifier(void **state)
{
    (void)state;
    double x[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1}, eps = 1, value, g[N];
    refused("edge_edge_mollifier", x, &eps);
    const cipc_oracle_function *f = cipc_oracle_function_find("edge_edge_mollifier");
    assert_int_equal(cipc_oracle_evaluate(f, x, &eps, &value, g, NULL), CIPC_YES);
    same(value, 1);
    assert_true(fabs(g[3]) < 1e-29);
    double above = nextafter(1, 2), below = nextafter(1, 0);
    same(ask_well("edge_edge_mollifier", x, &below).H[3 * 12 + 3], 0);
    answer a = ask_well("edge_edge_mollifier", x, &above);
    assert_true(fabs(a.H[3 * 12 + 3] + 8) < 1e-12); /* e'' 2 2 */
    const double fields[6] = {1, 1, 0, 2, 1, 8}; /* the same in the barrier's product */
    refused("barrier_edge_edge", x, fields);
}

/* Folded exactly: the angle is pi on one side and -pi on the other. A third derivative too rough: at the end of a barrier's support nothing but it is left. */
static void test_jumps_and_ends_are_refused(void **state)
{
    (void)state;
    const double hinge[2] = {1, 0}, folded[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 1, 0}, nearly[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 1, 0x1p-52};
    refused("hinge_bending", folded, hinge);
    assert_int_equal(ask("hinge_bending", nearly, hinge).verdict, CIPC_YES);
    const double fields[4] = {1, 1, 0, 1}, end[6] = {1, 0, 0, 0, 0, 0}, inside[6] = {0x1.fffffffffffffp-1, 0, 0, 0, 0, 0};
    refused("barrier_point_point", end, fields);
    assert_int_equal(ask("barrier_point_point", inside, fields).verdict, CIPC_YES);
}

/* Where a segment has no length there is no gradient of its length, and where a curved rod is straight none of its curvature: by symmetry all differences
 * would be 0. The values are answered; folded back there is none. */
static void test_cones_are_refused(void **state)
{
    (void)state;
    const double straight[9] = {-1, 0, 0, 0, 0, 0, 2, 0, 0}, folded[9] = {1, 0, 0, 0, 0, 0, 2, 0, 0}, none[9] = {0}, curved[2] = {3, 2}, soft[2] = {3, 0};
    const char *const names[2] = {"rod_stretching", "rod_bending"};
    const double *const at[2] = {none, straight};
    for (int k = 0; k < 2; k++) {
        double value, g[N];
        const cipc_oracle_function *f = cipc_oracle_function_find(names[k]);
        assert_int_equal(cipc_oracle_evaluate(f, at[k], curved, &value, NULL, NULL), CIPC_YES);
        same(value, k == 0 ? 3 : 12);
        assert_int_equal(cipc_oracle_evaluate(f, at[k], curved, &value, g, NULL), CIPC_INDETERMINATE);
        refused(names[k], at[k], curved);
    }
    refused("rod_bending", folded, soft);
    refused("rod_bending", none, soft);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_nodes),
        cmocka_unit_test(test_barrier_in_closed_form),
        cmocka_unit_test(test_thickness_and_kinds),
        cmocka_unit_test(test_distances),
        cmocka_unit_test(test_mollifier),
        cmocka_unit_test(test_membranes),
        cmocka_unit_test(test_strain_limit_as_tabulated),
        cmocka_unit_test(test_lower_strain_limit),
        cmocka_unit_test(test_orthotropic),
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_hinge),
        cmocka_unit_test(test_rod_stretching),
        cmocka_unit_test(test_rod_bending),
        cmocka_unit_test(test_stitch),
        cmocka_unit_test(test_damping),
        cmocka_unit_test(test_friction),
        cmocka_unit_test(test_twice_the_precision),
        cmocka_unit_test(test_infeasible_is_refused),
        cmocka_unit_test(test_steps_that_are_too_long_are_noticed),
        cmocka_unit_test(test_end_of_the_mollifier),
        cmocka_unit_test(test_jumps_and_ends_are_refused),
        cmocka_unit_test(test_cones_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
