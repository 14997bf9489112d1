/* The exact time of impact: closed forms, touches, degenerate stencils, scales, and an independent twin by sampling; and the public queries when they are there. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "verify/query_files.h"

/* Two primitives face each other across the plane z = 0 at distance 1; the first one moves down by `way`. */
static cipc_stencil_path head_on(cipc_pair_kind kind, double way)
{
    static const double stencils[CIPC_PAIR_KIND_COUNT][12] = {
        {0, 0, 1, 0, 0, 0}, {0, 0, 1, -1, 0, 0, 1, 0, 0}, {0, 0, 1, -1, -1, 0, 2, -1, 0, 0, 2, 0}, {-1, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 0}};
    cipc_stencil_path path = {.kind = kind};
    memcpy(path.x, stencils[kind], sizeof path.x);
    for (int i = 0; i < cipc_pair_first_nodes(kind); i++) path.p[3 * i + 2] = -way;
    return path;
}

static void expect(const cipc_stencil_path *path, double xi, double t_max, cipc_verdict verdict, double lo, double hi)
{
    cipc_exact_impact impact = cipc_exact_toi(path, xi, t_max);
    if (impact.verdict != verdict || (verdict == CIPC_YES && (impact.lo != lo || impact.hi != hi))) {
        fail_msg("%s, xi %.17g, t_max %.17g: verdict %d [%.17g, %.17g], not %d [%.17g, %.17g]", cipc_pair_name(path->kind), xi, t_max, (int)impact.verdict,
                 impact.lo, impact.hi, (int)verdict, lo, hi);
    }
    cipc_verdict clear = cipc_exact_path_clear(path, xi, t_max);
    assert_int_equal(clear, verdict == CIPC_YES ? CIPC_NO : CIPC_YES);
}

/* Way 2, so contact at (1 - xi)/2: a double for the thicknesses chosen; and a path that ends there, just before, or goes the other way. */
static void test_head_on(void **state)
{
    (void)state;
    static const double thicknesses[] = {0, 0.25, 0.5, 0x1p-40};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        for (int i = 0; i < 4; i++) {
            double xi = thicknesses[i], t = (1 - xi) / 2;
            cipc_stencil_path path = head_on((cipc_pair_kind)kind, 2), away = head_on((cipc_pair_kind)kind, -2);
            expect(&path, xi, 1, CIPC_YES, t, t);
            expect(&path, xi, t, CIPC_YES, t, t);
            expect(&path, xi, nextafter(t, 0), CIPC_NO, 0, 0);
            expect(&away, xi, 1, CIPC_NO, 0, 0);
        }
        /* Times that are doubles, at a third of t_max: the interval that encloses them never ends at them. */
        cipc_stencil_path path = head_on((cipc_pair_kind)kind, 2);
        expect(&path, 0.5, 0.75, CIPC_YES, 0.25, 0.25);
        expect(&path, 0, 0.75, CIPC_YES, 0.5, 0.5);
        cipc_stencil_path third = head_on((cipc_pair_kind)kind, 3); /* at 1/3, which is no double */
        double lo = 1.0 / 3;
        lo = lo * 3 > 1 || (long double)lo > 1.0L / 3 ? nextafter(lo, 0) : lo;
        expect(&third, 0, 1, CIPC_YES, lo, nextafter(lo, 1));
    }
}

static void test_started_in_contact(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        cipc_stencil_path path = head_on((cipc_pair_kind)kind, -1);
        expect(&path, 1, 1, CIPC_YES, 0, 0);
        expect(&path, 1.5, 0, CIPC_YES, 0, 0);
        expect(&path, nextafter(1, 0), 1, CIPC_NO, 0, 0);
        cipc_stencil_path still = head_on((cipc_pair_kind)kind, 0);
        expect(&still, 0.5, 1, CIPC_NO, 0, 0);
        for (int i = 0; i < 12; i++) still.p[i] = 1e10; /* no relative motion */
        expect(&still, 0.5, 1, CIPC_NO, 0, 0);
    }
}

/* A point that passes another at distance 1/4 exactly: a touch without crossing is a hit, one ulp less thickness is none. */
static void test_touch(void **state)
{
    (void)state;
    cipc_stencil_path points = {.kind = CIPC_POINT_POINT, .x = {-1, 0.25, 0, 0, 0, 0}, .p = {2, 0, 0}};
    expect(&points, 0.25, 1, CIPC_YES, 0.5, 0.5);
    expect(&points, nextafter(0.25, 0), 1, CIPC_NO, 0, 0);
    cipc_exact_impact impact = cipc_exact_toi(&points, nextafter(0.25, 1), 1);
    assert_true(impact.verdict == CIPC_YES && impact.lo < 0.5 && impact.hi < 0.5 && impact.lo > 0.49);
    /* An edge grazes another at thickness 0: they touch at one moment, end on end. */
    cipc_stencil_path edges = {.kind = CIPC_EDGE_EDGE, .x = {-2, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1, 0}, .p = {2, 0, 0, 2, 0, 0}};
    expect(&edges, 0, 1, CIPC_YES, 0.5, 0.5);
    /* A point moves in a triangle's plane and touches its corner in passing. */
    cipc_stencil_path corner = {.kind = CIPC_POINT_TRIANGLE, .x = {-1, 1, 0, 0, 1, 0, -1, 0, 0, 1, 0, 0}, .p = {2, 0, 0}};
    expect(&corner, 0, 1, CIPC_YES, 0.5, 0.5);
    corner.x[1] = nextafter(1, 2);
    expect(&corner, 0, 1, CIPC_NO, 0, 0);
    corner.x[1] = nextafter(1, 0);
    impact = cipc_exact_toi(&corner, 0, 1);
    assert_true(impact.verdict == CIPC_YES && impact.lo < 0.5 && 0.5 - impact.lo < 0x1p-50);
}

/* Flats that coincide identically: parallel edges and points in a triangle's plane; degenerate edges and triangles. */
static void test_degenerate(void **state)
{
    (void)state;
    cipc_stencil_path parallel = {.kind = CIPC_EDGE_EDGE, .x = {0, 1, 0, 1, 1, 0, 0.5, 0, 0, 1.5, 0, 0}, .p = {0, -2, 0, 0, -2, 0}};
    expect(&parallel, 0, 1, CIPC_YES, 0.5, 0.5);
    expect(&parallel, 0.5, 1, CIPC_YES, 0.25, 0.25);
    cipc_stencil_path collinear = {.kind = CIPC_EDGE_EDGE, .x = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, .p = {2, 0, 0, 2, 0, 0}};
    expect(&collinear, 0, 1, CIPC_YES, 0.5, 0.5);
    cipc_stencil_path points = {.kind = CIPC_EDGE_EDGE, .x = {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0}, .p = {2, 0, 0, 2, 0, 0}};
    expect(&points, 0, 1, CIPC_YES, 0.5, 0.5);
    cipc_stencil_path flat = {.kind = CIPC_POINT_TRIANGLE, .x = {0.5, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0}, .p = {0, -2, 0}};
    expect(&flat, 0, 1, CIPC_YES, 0.5, 0.5);
    expect(&flat, 0.25, 1, CIPC_YES, 0.375, 0.375);
    cipc_stencil_path in_plane = {.kind = CIPC_POINT_TRIANGLE, .x = {-1, 0.25, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, .p = {2, 0, 0}};
    expect(&in_plane, 0, 1, CIPC_YES, 0.5, 0.5);
    /* A sliding edge that turns through parallelism without coming near. */
    cipc_stencil_path turning = {.kind = CIPC_EDGE_EDGE, .x = {0, 1, 1, 1, 1, -1, 0, 0, 0, 1, 0, 0}, .p = {0, 0, -2, 0, 0, 2}};
    expect(&turning, 0.5, 1, CIPC_NO, 0, 0);
}

/* Powers of two, a huge common shift and a common motion change nothing. */
static void test_scales_and_shifts(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        for (int e = -300; e <= 300; e += 150) {
            cipc_stencil_path path = head_on((cipc_pair_kind)kind, 2);
            for (int i = 0; i < 12; i++) {
                path.x[i] = ldexp(path.x[i], e);
                path.p[i] = ldexp(path.p[i], e);
            }
            expect(&path, ldexp(0.25, e), 1, CIPC_YES, 0.375, 0.375);
        }
        cipc_stencil_path shifted = head_on((cipc_pair_kind)kind, 2);
        for (int i = 0; i < 3 * cipc_pair_nodes((cipc_pair_kind)kind); i++) {
            shifted.x[i] += 0x1p40 * (i % 3 + 1);
            shifted.p[i] += 0x1p40;
        }
        expect(&shifted, 0.25, 1, CIPC_YES, 0.375, 0.375);
        shifted.to_end = true;
        for (int i = 0; i < 3 * cipc_pair_nodes((cipc_pair_kind)kind); i++) shifted.p[i] += shifted.x[i];
        expect(&shifted, 0.25, 1, CIPC_YES, 0.375, 0.375);
    }
}

/* The displacement between two positions need not be a double: p - x is taken exactly. */
static void test_exact_displacement(void **state)
{
    (void)state;
    cipc_stencil_path path = {.kind = CIPC_POINT_POINT, .to_end = true, .x = {1, 0, 0, 0, 0, 0}, .p = {-0x1p-80, 0, 0, 0, 0, 0}};
    cipc_exact_impact impact = cipc_exact_toi(&path, 0, 1);
    assert_true(impact.verdict == CIPC_YES && impact.hi == 1 && impact.lo == nextafter(1, 0)); /* 1 / (1 + 2^-80) */
    path.p[0] = 0x1p-80;
    assert_int_equal(cipc_exact_toi(&path, 0, 1).verdict, CIPC_NO);
}

static void test_bad_input_is_indeterminate(void **state)
{
    (void)state;
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        cipc_stencil_path path = head_on(CIPC_EDGE_EDGE, 2);
        path.p[11] = bad[i];
        assert_int_equal(cipc_exact_toi(&path, 0, 1).verdict, CIPC_INDETERMINATE);
        assert_int_equal(cipc_exact_path_clear(&path, 0, 1), CIPC_INDETERMINATE);
        assert_int_equal(cipc_exact_path_minimum(&path, 1, NULL, NULL, NULL), CIPC_INDETERMINATE);
        path = head_on(CIPC_EDGE_EDGE, 2);
        assert_int_equal(cipc_exact_toi(&path, bad[i], 1).verdict, CIPC_INDETERMINATE);
        assert_int_equal(cipc_exact_toi(&path, 0, bad[i]).verdict, CIPC_INDETERMINATE);
    }
    cipc_stencil_path path = head_on(CIPC_EDGE_EDGE, 2);
    assert_int_equal(cipc_exact_toi(&path, -1, 1).verdict, CIPC_INDETERMINATE);
    assert_int_equal(cipc_exact_toi(&path, 0, 1.5).verdict, CIPC_INDETERMINATE);
}

/* --- an independent twin: exact distances at many times --- */

/* Positions at t, exact as doubles: coordinates are multiples of 2^-10, t of 2^-10. */
static void positions_at(const cipc_stencil_path *path, double t, double y[12])
{
    for (int i = 0; i < 12; i++) y[i] = path->x[i] + t * path->p[i];
}

static cipc_stencil_path draw(gsl_rng *rng, cipc_pair_kind kind)
{
    cipc_stencil_path path = {.kind = kind};
    for (int i = 0; i < 3 * cipc_pair_nodes(kind); i++) {
        path.x[i] = floor(1024 * (gsl_rng_uniform(rng) - 0.5)) / 1024;
        path.p[i] = floor(2048 * (gsl_rng_uniform(rng) - 0.5)) / 1024;
    }
    if (gsl_rng_uniform(rng) < 0.2) memcpy(path.x + 3, path.x, 3 * sizeof path.x[0]); /* zero length, or a point on a corner */
    if (gsl_rng_uniform(rng) < 0.2) memcpy(path.p + 6, path.p + 3, 3 * sizeof path.p[0]);
    return path;
}

/* No sampled time before lo is in contact; contact holds at hi or just behind it; the least distance agrees with both. */
static void check_against_samples(const cipc_stencil_path *path, double xi, int *hits)
{
    enum { SAMPLES = 64 };
    cipc_exact_impact impact = cipc_exact_toi(path, xi, 1);
    assert_true(impact.verdict != CIPC_INDETERMINATE);
    double least = INFINITY, y[12], lo, hi, at;
    for (int i = 0; i <= SAMPLES; i++) {
        double t = (double)i / SAMPLES;
        positions_at(path, t, y);
        if (impact.verdict == CIPC_NO || t < impact.lo) assert_int_equal(cipc_exact_distance_sign(path->kind, y, xi), 1);
        least = fmin(least, sqrt(cipc_exact_distance2(path->kind, y, NULL)));
    }
    assert_int_equal(cipc_exact_path_minimum(path, 1, &lo, &hi, &at), CIPC_YES);
    assert_true(lo <= hi && hi <= least * (1 + 2 * DBL_EPSILON));
    assert_true(hi <= nextafter(lo, INFINITY) || hi < 1e-55);
    assert_true(impact.verdict == CIPC_YES ? lo <= xi : hi >= xi);
    positions_at(path, at, y);
    double there = sqrt(cipc_exact_distance2(path->kind, y, NULL));
    assert_true(fabs(there - hi) <= 8 * DBL_EPSILON * 4); /* at is rounded: positions of size 1 move by some u, at speeds of a few */
    if (impact.verdict == CIPC_YES && impact.lo > 0) {
        (*hits)++;
        assert_int_equal(cipc_exact_path_clear(path, xi, nextafter(impact.lo, 0)), CIPC_YES);
        assert_int_equal(cipc_exact_path_clear(path, xi, impact.hi), CIPC_NO);
        positions_at(path, impact.hi, y);
        assert_true(fabs(sqrt(cipc_exact_distance2(path->kind, y, NULL)) - xi) <= 1e-14);
    }
}

static void test_against_samples(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 7);
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        int hits = 0;
        for (int i = 0; i < 1500; i++) {
            cipc_stencil_path path = draw(rng, (cipc_pair_kind)kind);
            check_against_samples(&path, i % 2 ? 0 : 0.5 * gsl_rng_uniform(rng), &hits);
        }
        print_message("%s: %d hits\n", cipc_pair_name((cipc_pair_kind)kind), hits);
        assert_true(hits >= (kind == CIPC_POINT_POINT ? 15 : 40)); /* two points seldom meet */
    }
    gsl_rng_free(rng);
}

/* --- the public queries --- */

static void test_public_queries(void **state)
{
    (void)state;
    static const char *const directory = "../shared/data/ccd";
    verify_public_queries q = {0};
    cipc_error error;
    cipc_status status = verify_public_queries_read_all(&q, directory, &error);
    if (status == CIPC_E_MISSING_FILE) {
        print_message("%s is not there: the public queries are not checked\n", directory);
        skip();
    }
    if (status != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    int hits = 0;
    for (int i = 0; i < q.count; i++) {
        cipc_exact_impact impact = cipc_exact_toi(&q.query[i].path, 0, 1);
        if (impact.verdict != (q.query[i].hit ? CIPC_YES : CIPC_NO)) fail_msg("query %d: verdict %d, truth %d", i, (int)impact.verdict, q.query[i].hit);
        hits += impact.verdict == CIPC_YES;
    }
    print_message("%d public queries, %d hits: the oracle agrees with the truth column on every one\n", q.count, hits);
    assert_true(q.count > 5000 && hits > 300);
    verify_public_queries_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_head_on),
        cmocka_unit_test(test_started_in_contact),
        cmocka_unit_test(test_touch),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_scales_and_shifts),
        cmocka_unit_test(test_exact_displacement),
        cmocka_unit_test(test_bad_input_is_indeterminate),
        cmocka_unit_test(test_against_samples),
        cmocka_unit_test(test_public_queries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
