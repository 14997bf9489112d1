/* Certified CCD: closed forms, and against the exact oracle that no path returned has a contact, where the plain algorithm fails. Millions of samples of the same
 * kind are the campaign "toi" (cipc verify). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "contact/certified_ccd.h"

static const double SLACKNESS = 0.1;

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

static cipc_ccd_result solve(const cipc_stencil_path *path, double xi)
{
    cipc_ccd_options options = cipc_ccd_options_default();
    return cipc_certified_ccd(path, xi, 1, &options);
}

/* Along the common normal the target gap is reached at once: (1 - s)(d - xi)/P, short of it by 2^-10 of s and rounding. */
static void test_head_on(void **state)
{
    (void)state;
    static const double thicknesses[] = {0, 0.25, 0.9};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        for (int i = 0; i < 3; i++) {
            double xi = thicknesses[i], want = (1 - SLACKNESS) * (1 - xi) / 2;
            cipc_stencil_path path = head_on((cipc_pair_kind)kind, 2), away = head_on((cipc_pair_kind)kind, -2);
            cipc_ccd_result r = solve(&path, xi), parting = solve(&away, xi);
            assert_true(r.hit && r.outcome == CIPC_CCD_HIT && r.precision == 53);
            assert_true(r.toi <= want && r.toi >= want * (1 - 0x1p-9));
            assert_true(!parting.hit && parting.toi == 1 && parting.outcome == CIPC_CCD_FREE);
        }
    }
}

static void test_starts(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        cipc_stencil_path path = head_on((cipc_pair_kind)kind, 2), still = head_on((cipc_pair_kind)kind, 0);
        cipc_ccd_result r = solve(&path, 1); /* d = xi exactly */
        assert_true(r.hit && r.toi == 0 && r.outcome == CIPC_CCD_INITIALLY_CLOSE);
        r = solve(&path, 1.5);
        assert_true(r.hit && r.toi == 0 && r.outcome == CIPC_CCD_INITIALLY_CLOSE);
        r = solve(&path, nextafter(1, 0)); /* a gap of one rounding: a step, however small */
        assert_true(r.hit && r.toi > 0 && r.toi < 0x1p-54 && r.precision > 53);
        r = solve(&still, 0.5);
        assert_true(!r.hit && r.toi == 1);
        path.p[2] = NAN;
        r = solve(&path, 0);
        assert_true(r.hit && r.toi == 0 && r.outcome == CIPC_CCD_INDETERMINATE);
    }
}

/* A shift of the world by a power of two that leaves the coordinates exact changes nothing, to the last bit. */
static void test_translation(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 4);
    for (int i = 0; i < 500; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT)}, shifted;
        for (int k = 0; k < 12; k++) {
            path.x[k] = floor(1024 * gsl_rng_uniform(rng)) / 1024;
            path.p[k] = gsl_rng_uniform(rng) - 0.5;
        }
        shifted = path;
        for (int k = 0; k < 12; k++) shifted.x[k] += 0x1p30 * (k % 3 - 1);
        assert_true(solve(&path, 0.01).toi == solve(&shifted, 0.01).toi);
    }
    gsl_rng_free(rng);
}

/* Facing primitives at a tiny gap over thickness or none, with motion, turned and far from the origin: where rounding matters. */
static void draw_hard(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    *path = head_on((cipc_pair_kind)gsl_rng_uniform_int(rng, 4), 0);
    double gap = pow(10, -16 + 10 * gsl_rng_uniform(rng)), far = gsl_rng_uniform(rng) < 0.5 ? 0 : pow(10, 6 * gsl_rng_uniform(rng));
    *xi = gsl_rng_uniform(rng) < 0.5 ? 0 : 0.3 * gsl_rng_uniform(rng);
    double angle = 6.3 * gsl_rng_uniform(rng), c = cos(angle), s = sin(angle);
    for (int i = 0; i < cipc_pair_nodes(path->kind); i++) {
        double *x = path->x + 3 * i, *p = path->p + 3 * i;
        if (i < cipc_pair_first_nodes(path->kind)) x[2] = *xi + gap;
        double y = c * x[1] - s * x[2], z = s * x[1] + c * x[2];
        x[0] += far, x[1] = y + far, x[2] = z - far;
        for (int k = 0; k < 3; k++) p[k] = 0.1 * (gsl_rng_uniform(rng) - 0.5);
        if (i < cipc_pair_first_nodes(path->kind)) p[1] += s, p[2] -= c;
    }
}

typedef cipc_ccd_result ccd_function(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);

/* Of so many hard samples: answers with contact on the way, contacts not reported, no step where there is room. */
typedef struct tally {
    int hits, unsafe, missed, stuck;
} tally;

static tally count_faults(ccd_function *ccd, bool gap_first)
{
    tally t = {0};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 6);
    cipc_ccd_options options = cipc_ccd_options_default();
    options.max_iterations = 5000;
    options.gap_first = gap_first;
    for (int i = 0; i < 4000; i++) {
        cipc_stencil_path path;
        double xi;
        draw_hard(rng, &path, &xi);
        cipc_exact_impact impact = cipc_exact_toi(&path, xi, 1);
        assert_true(impact.verdict != CIPC_INDETERMINATE);
        if (impact.verdict == CIPC_YES && impact.hi == 0) continue; /* rounding has closed the gap */
        cipc_ccd_result r = ccd(&path, xi, 1, &options);
        t.hits += impact.verdict == CIPC_YES;
        t.missed += impact.verdict == CIPC_YES && !r.hit;
        t.unsafe += r.toi > 0 && cipc_exact_path_clear(&path, xi, r.toi) != CIPC_YES;
        t.stuck += !(r.toi > 0);
    }
    gsl_rng_free(rng);
    return t;
}

static cipc_ccd_result plain(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_options o = *options;
    o.method = CIPC_CCD_ADDITIVE;
    return cipc_ccd(path, xi, t_max, &o);
}

/* What a certificate must never do: ignore the thickness, or round a time up. */
static cipc_ccd_result without_thickness(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    (void)xi;
    return cipc_certified_ccd(path, 0, t_max, options);
}

static cipc_ccd_result a_little_late(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    if (r.hit) r.toi *= 1.12; /* head-on the answer is 0.9 of the way */
    return r;
}

static void test_certificates_hold_where_rounding_matters(void **state)
{
    (void)state;
    tally certified = count_faults(cipc_certified_ccd, false), additive = count_faults(plain, true), cubic = count_faults(cipc_cubic_ccd, false);
    print_message("hits %d; unsafe, missed, stuck: certified %d %d %d, plain additive %d %d %d, cubic %d %d %d\n", certified.hits, certified.unsafe, certified.missed,
                  certified.stuck, additive.unsafe, additive.missed, additive.stuck, cubic.unsafe, cubic.missed, cubic.stuck);
    assert_true(certified.hits >= 2000);
    assert_true(certified.unsafe == 0 && certified.missed == 0 && certified.stuck == 0);
    assert_true(additive.unsafe + additive.missed > 0);
    assert_true(cubic.unsafe + cubic.missed > 100);
    assert_true(count_faults(without_thickness, false).unsafe > 0);
    assert_true(count_faults(a_little_late, false).unsafe + count_faults(a_little_late, false).missed > 0);
}

/* The same answers, scaled, from the least doubles to the largest. */
static void test_scales(void **state)
{
    (void)state;
    static const int scales[] = {-1060, -900, -540, -310, -280, 280, 310, 540, 900, 1015};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        for (int i = 0; i < 10; i++) {
            for (int faster = 1; faster <= 8; faster += 7) {
                cipc_stencil_path path = head_on((cipc_pair_kind)kind, 1);
                for (int k = 0; k < 12; k++) {
                    path.x[k] = ldexp(path.x[k], scales[i]);
                    path.p[k] = ldexp(path.p[k], scales[i] + faster);
                }
                double xi = ldexp(1, scales[i] - 2), want = ldexp((1 - SLACKNESS) * 0.75, -faster);
                cipc_ccd_result r = solve(&path, xi);
                assert_true(r.outcome == CIPC_CCD_HIT && r.toi <= want && r.toi >= want * (1 - 0x1p-9));
                r = solve(&path, ldexp(1, scales[i]));
                assert_true(r.outcome == CIPC_CCD_INITIALLY_CLOSE && r.toi == 0);
                for (int n = 0; n < 12; n++) path.p[n] = path.x[n] + ldexp(path.p[n], -2); /* the same way by its ends */
                path.to_end = true;
                r = solve(&path, xi);
                assert_true(faster == 1 ? !r.hit : r.outcome == CIPC_CCD_HIT && r.toi <= 4 * want && r.toi >= 4 * want * (1 - 0x1p-9));
            }
        }
    }
}

static double any_double(gsl_rng *rng, int lowest, int span)
{
    return ldexp(gsl_rng_uniform(rng) - 0.5, lowest + (int)(gsl_rng_uniform(rng) * span));
}

/* Coordinates, displacements and thicknesses of any size at all, mixed in one stencil. */
static void test_whole_range_of_doubles(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 12);
    int hits = 0, stepped = 0, wanted = 0, capped = 0;
    for (int i = 0; i < 300; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT), .to_end = i % 3 == 0};
        int span = i % 2 ? 8 : i % 5 ? 120 : 2000, lowest = -1074 + (int)(gsl_rng_uniform(rng) * (2090 - span));
        for (int k = 0; k < 12; k++) {
            path.x[k] = any_double(rng, lowest, span);
            path.p[k] = any_double(rng, lowest, span);
        }
        double xi = i % 7 < 3 ? 0 : fabs(any_double(rng, lowest - 8, span));
        cipc_exact_impact impact = cipc_exact_toi(&path, xi, 1);
        cipc_ccd_result r = solve(&path, xi);
        bool close = impact.verdict == CIPC_YES && impact.hi == 0;
        assert_true(impact.verdict != CIPC_INDETERMINATE);
        assert_true(close == (r.outcome == CIPC_CCD_INITIALLY_CLOSE));
        if (close) continue;
        assert_true(r.hit || impact.verdict == CIPC_NO);
        assert_int_equal(cipc_exact_path_clear(&path, xi, r.toi), CIPC_YES);
        capped += r.capped;
        wanted++;
        stepped += r.toi > 0;
        hits += r.hit;
    }
    print_message("whole range: %d queries with room, %d with a step, %d hits, %d capped\n", wanted, stepped, hits, capped);
    assert_true(wanted >= 200 && hits >= 20 && stepped == wanted && capped < wanted / 8);
    gsl_rng_free(rng);
}

/* Edges that pass by each other, at a distance in the end or touching: refining tells near misses from contacts, and never is late. */
static void test_refined(void **state)
{
    (void)state;
    cipc_ccd_options options = cipc_ccd_options_default();
    int early = 0, early_refined = 0;
    for (int i = -20; i <= 20; i++) {
        cipc_stencil_path path = {.kind = CIPC_EDGE_EDGE, .x = {-1, 0, 1, 1, 0.3, 1, 0.2, -1, 0, 0, 1, 0.1}};
        for (int k = 0; k < 2; k++) path.p[3 * k + 2] = -0.95 + 0.0025 * i;
        cipc_exact_impact impact = cipc_exact_toi(&path, 0, 1);
        options.refine = false;
        cipc_ccd_result plainly = cipc_certified_ccd(&path, 0, 1, &options);
        options.refine = true;
        cipc_ccd_result refined = cipc_certified_ccd(&path, 0, 1, &options);
        assert_int_equal(cipc_exact_path_clear(&path, 0, refined.toi), CIPC_YES);
        if (impact.verdict == CIPC_YES) assert_true(plainly.hit && refined.hit);
        early += plainly.hit && impact.verdict == CIPC_NO;
        early_refined += refined.hit && impact.verdict == CIPC_NO;
        assert_true(refined.toi >= plainly.toi);
    }
    assert_true(early > early_refined && early_refined <= 1);
}

/* A bound lets it give up early, but changes no hit at or before it. */
static void test_until(void **state)
{
    (void)state;
    cipc_ccd_options options = cipc_ccd_options_default();
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 8);
    int hits = 0;
    for (int i = 0; i < 3000; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT)};
        for (int k = 0; k < 12; k++) {
            path.x[k] = gsl_rng_uniform(rng) - 0.5;
            path.p[k] = 2 * gsl_rng_uniform(rng) - 1;
        }
        options.refine = i % 2;
        double bound = gsl_rng_uniform(rng);
        cipc_ccd_result whole = cipc_certified_ccd(&path, 0.05, 1, &options), until = contact_certified_ccd_until(&path, 0.05, 1, bound, &options);
        if (whole.hit && whole.toi <= bound) assert_true(until.hit && until.toi == whole.toi);
        if (until.hit) assert_true(whole.hit && whole.toi == until.toi);
        hits += whole.hit;
    }
    assert_true(hits >= 300);
    gsl_rng_free(rng);
}

/* Far fewer iterations than the plain algorithm where two primitives slide past one another. */
static void test_sliding_is_seen_through(void **state)
{
    (void)state;
    cipc_ccd_options options = cipc_ccd_options_default();
    cipc_stencil_path path = {.kind = CIPC_POINT_TRIANGLE, .x = {-0.5, 0.25, 1e-3, -1, -1, 0, 2, -1, 0, 0, 2, 0}, .p = {1, 0, 0}};
    cipc_ccd_result r = cipc_certified_ccd(&path, 0, 1, &options), p = cipc_additive_ccd(path.kind, path.x, path.p, 0, 1, &options);
    assert_true(!r.hit && !p.hit);
    assert_in_range(r.iterations, 0, 2);
    assert_in_range(p.iterations, 500, 5000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_head_on), cmocka_unit_test(test_starts), cmocka_unit_test(test_translation),
        cmocka_unit_test(test_certificates_hold_where_rounding_matters), cmocka_unit_test(test_refined), cmocka_unit_test(test_until),
        cmocka_unit_test(test_sliding_is_seen_through), cmocka_unit_test(test_scales), cmocka_unit_test(test_whole_range_of_doubles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
