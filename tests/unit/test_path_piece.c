/* The exact time of impact on a piece of paths with breaks: where it is an ordinary path, where places are thirds and fifths, against rationals, and bad input. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gmp.h>
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"

/* Every node moves all the time of the path. */
static cipc_stencil_piece whole_piece(const cipc_stencil_path *path, double begin, double end)
{
    cipc_stencil_piece piece = {.kind = path->kind, .begin = begin, .end = end};
    memcpy(piece.x, path->x, sizeof piece.x);
    memcpy(piece.p, path->p, sizeof piece.p);
    for (int i = 0; i < 4; i++) {
        piece.start[i] = begin;
        piece.stop[i] = end;
    }
    return piece;
}

static void expect(const cipc_stencil_piece *piece, double xi, cipc_verdict verdict, double lo, double hi)
{
    cipc_exact_impact impact = cipc_exact_piece_toi(piece, xi);
    if (impact.verdict != verdict || (verdict == CIPC_YES && (impact.lo != lo || impact.hi != hi))) {
        fail_msg("%s, xi %.17g: verdict %d [%.17g, %.17g], not %d [%.17g, %.17g]", cipc_pair_name(piece->kind), xi, (int)impact.verdict, impact.lo, impact.hi,
                 (int)verdict, lo, hi);
    }
}

static cipc_stencil_path random_path(uint64_t *seed, cipc_pair_kind kind)
{
    cipc_stencil_path path = {.kind = kind, .to_end = true};
    for (int i = 0; i < 12; i++) { /* multiples of 2^-10: what is half or a quarter of the way is a double */
        path.x[i] = ldexp(random_below(seed, 2048) - 1024, -10);
        path.p[i] = ldexp(random_below(seed, 2048) - 1024, -10);
    }
    return path;
}

/* Nodes that all move from 0 to 1, or from 8 to 12: as on an ordinary path. */
static void test_ordinary_paths(void **state)
{
    (void)state;
    uint64_t seed = 5;
    int hits = 0, misses = 0;
    for (int n = 0; n < 400; n++) {
        cipc_stencil_path path = random_path(&seed, (cipc_pair_kind)(n % CIPC_PAIR_KIND_COUNT));
        double xi = n % 3 == 0 ? 0 : 0.1;
        cipc_exact_impact want = cipc_exact_toi(&path, xi, 1);
        cipc_stencil_piece piece = whole_piece(&path, 0, 1), later = whole_piece(&path, 8, 12);
        expect(&piece, xi, want.verdict, want.lo, want.hi);
        cipc_exact_impact got = cipc_exact_piece_toi(&later, xi);
        assert_int_equal(got.verdict, want.verdict);
        if (want.verdict == CIPC_YES) { assert_true(8 + 4 * want.lo >= got.lo - 0x1p-49 && got.lo >= 8 + 4 * want.lo - 0x1p-49); }
        hits += want.verdict == CIPC_YES;
        misses += want.verdict == CIPC_NO;
    }
    assert_true(hits >= 50 && misses >= 50);
}

/* From a quarter of the way to three quarters, where each node's own piece begins at 0 or at the quarter and ends at the three quarters or at 1. */
static void test_own_times(void **state)
{
    (void)state;
    uint64_t seed = 6;
    int hits = 0, misses = 0;
    for (int n = 0; n < 400; n++) {
        cipc_stencil_path path = random_path(&seed, (cipc_pair_kind)(n % CIPC_PAIR_KIND_COUNT)), middle = path;
        cipc_stencil_piece piece = whole_piece(&path, 0, 1);
        for (int i = 0; i < 12; i++) {
            middle.x[i] = 0.75 * path.x[i] + 0.25 * path.p[i];
            middle.p[i] = 0.25 * path.x[i] + 0.75 * path.p[i];
        }
        piece.begin = 0.25;
        piece.end = 0.75;
        for (int i = 0; i < 4; i++) {
            if (random_below(&seed, 2) == 0) {
                piece.start[i] = 0.25;
                memcpy(&piece.x[3 * i], &middle.x[3 * i], 3 * sizeof(double));
            }
            if (random_below(&seed, 2) == 0) {
                piece.stop[i] = 0.75;
                memcpy(&piece.p[3 * i], &middle.p[3 * i], 3 * sizeof(double));
            }
        }
        cipc_exact_impact want = cipc_exact_toi(&middle, 0.125, 1), got = cipc_exact_piece_toi(&piece, 0.125);
        assert_int_equal(got.verdict, want.verdict);
        if (want.verdict == CIPC_YES) { assert_true(fabs(0.25 + 0.5 * want.lo - got.lo) <= 0x1p-52 && got.hi <= nextafter(got.lo, 1)); }
        hits += want.verdict == CIPC_YES;
        misses += want.verdict == CIPC_NO;
    }
    assert_true(hits >= 50 && misses >= 50);
}

/* A point on its way from 0 to 1 in three seconds and one from 1 to 0 in five: they meet at t (1/3 + 1/5) = 1, and are within xi from 15/8 (1 - xi) on. At no
 * end of a piece is either of them at a double. */
static void test_thirds_and_fifths(void **state)
{
    (void)state;
    cipc_stencil_piece piece = {.kind = CIPC_POINT_POINT, .begin = 1, .end = 2, .stop = {3, 5}, .x = {0, 0, 0, 1, 0, 0}, .p = {1, 0, 0, 0, 0, 0}};
    expect(&piece, 0, CIPC_YES, 1.875, 1.875);
    expect(&piece, 0.25, CIPC_YES, 1.40625, 1.40625);
    piece.end = 1.875;
    expect(&piece, 0, CIPC_YES, 1.875, 1.875);
    piece.end = nextafter(1.875, 0);
    expect(&piece, 0, CIPC_NO, 0, 0);
    piece.begin = 1.9; /* already past each other */
    piece.end = 3;
    expect(&piece, 0, CIPC_NO, 0, 0);
    piece.begin = piece.end = 1.875;
    expect(&piece, 0, CIPC_YES, 1.875, 1.875);
}

/* The four kinds head on along z, every node with times of its own on the same motion z = 1 - t/2: the impact at t = 2 (1 - xi). */
static void test_kinds(void **state)
{
    (void)state;
    static const double flat[CIPC_PAIR_KIND_COUNT][12] = {
        {0, 0, 0, 0, 0, 0}, {0, 0, 0, -1, 0, 0, 1, 0, 0}, {0, 0, 0, -1, -1, 0, 2, -1, 0, 0, 2, 0}, {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0}};
    static const double start[4] = {-1, -2, 0, 0.5}, stop[4] = {2, 5, 7, 11.5};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        for (int moving = 0; moving < 2; moving++) { /* the first primitive down, or the second one up */
            cipc_stencil_piece piece = {.kind = (cipc_pair_kind)kind, .begin = 0.5, .end = 2};
            memcpy(piece.x, flat[kind], sizeof piece.x);
            memcpy(piece.p, flat[kind], sizeof piece.p);
            for (int i = 0; i < 4; i++) {
                bool first = i < cipc_pair_first_nodes(piece.kind);
                piece.start[i] = start[i];
                piece.stop[i] = stop[i];
                if (first == (moving == 0)) {
                    piece.x[3 * i + 2] = (first ? 1 : -1) * (1 - start[i] / 2);
                    piece.p[3 * i + 2] = (first ? 1 : -1) * (1 - stop[i] / 2);
                }
            }
            expect(&piece, 0, CIPC_YES, 2, 2);
            expect(&piece, 0.25, CIPC_YES, 1.5, 1.5);
            piece.end = nextafter(1.5, 0);
            expect(&piece, 0.25, CIPC_NO, 0, 0);
            expect(&piece, 0.75, CIPC_YES, 0.5, 0.5); /* at the beginning already */
        }
    }
}

/* Random times: a point comes down on another one that rests at 0, at a + z (b - a)/(z - w), a rational between neighbouring doubles. */
static void test_times_against_rationals(void **state)
{
    (void)state;
    uint64_t seed = 7;
    mpq_t t, a, b, z, w;
    mpq_inits(t, a, b, z, w, NULL);
    for (int n = 0; n < 300; n++) {
        double shift = n % 2 == 0 ? 0 : 1e6;
        cipc_stencil_piece piece = {.kind = CIPC_POINT_POINT, .start = {shift + random_uniform(&seed, -1, 0), -1}, .stop = {shift + random_uniform(&seed, 0.5, 1), 1e9},
                                    .x = {0, 0, random_uniform(&seed, 0.1, 1)}, .p = {0, 0, random_uniform(&seed, -1, -0.1)}};
        piece.begin = piece.start[0] > -1 ? piece.start[0] : -1;
        piece.end = piece.stop[0];
        mpq_set_d(a, piece.start[0]);
        mpq_set_d(b, piece.stop[0]);
        mpq_set_d(z, piece.x[2]);
        mpq_set_d(w, piece.p[2]);
        mpq_sub(b, b, a);
        mpq_sub(w, z, w);
        mpq_mul(t, z, b);
        mpq_div(t, t, w);
        mpq_add(t, t, a);
        cipc_exact_impact impact = cipc_exact_piece_toi(&piece, 0);
        assert_int_equal(impact.verdict, CIPC_YES);
        mpq_set_d(a, impact.lo);
        mpq_set_d(b, impact.hi);
        assert_true(mpq_cmp(a, t) <= 0 && mpq_cmp(t, b) <= 0);
        assert_true(impact.hi <= nextafter(impact.lo, INFINITY));
    }
    mpq_clears(t, a, b, z, w, NULL);
}

/* Powers of two of length and time, and a common shift in space, change nothing. */
static void test_scales(void **state)
{
    (void)state;
    for (int e = -200; e <= 200; e += 100) {
        for (int f = -200; f <= 200; f += 100) {
            cipc_stencil_piece piece = {.kind = CIPC_POINT_POINT, .begin = ldexp(1, f), .end = ldexp(2, f), .stop = {ldexp(3, f), ldexp(5, f)},
                                        .x = {0, 0, 0, ldexp(1, e), 0, 0}, .p = {ldexp(1, e), 0, 0, 0, 0, 0}};
            expect(&piece, 0, CIPC_YES, ldexp(1.875, f), ldexp(1.875, f));
        }
    }
    cipc_stencil_piece shifted = {.kind = CIPC_POINT_POINT, .begin = 1, .end = 2, .stop = {3, 5}, .x = {0, 0, 0, 1, 0, 0}, .p = {1, 0, 0, 0, 0, 0}};
    for (int i = 0; i < 6; i++) {
        shifted.x[i] += 0x1p40;
        shifted.p[i] += 0x1p40;
    }
    expect(&shifted, 0, CIPC_YES, 1.875, 1.875);
}

static void test_bad_input_is_indeterminate(void **state)
{
    (void)state;
    const cipc_stencil_piece good = {.kind = CIPC_POINT_POINT, .begin = 1, .end = 2, .stop = {3, 5}, .x = {0, 0, 0, 1, 0, 0}, .p = {1, 0, 0, 0, 0, 0}};
    cipc_stencil_piece bad[10];
    for (int i = 0; i < 10; i++) { bad[i] = good; }
    bad[0].begin = 2.5;
    bad[1].start[1] = 1.5;
    bad[2].stop[0] = 1.5;
    bad[3].end = NAN;
    bad[4].begin = -INFINITY;
    bad[5].start[0] = -INFINITY;
    bad[6].stop[1] = INFINITY;
    bad[7].x[2] = NAN;
    bad[8].p[5] = INFINITY;
    bad[9].begin = bad[9].end = bad[9].start[0] = bad[9].stop[0] = 1; /* at two places at once */
    for (int i = 0; i < 10; i++) { expect(&bad[i], 0.1, CIPC_INDETERMINATE, 0, 0); }
    expect(&good, -1, CIPC_INDETERMINATE, 0, 0);
    expect(&good, NAN, CIPC_INDETERMINATE, 0, 0);
    bad[9].p[0] = 0; /* stays where it is: right */
    expect(&bad[9], 0.1, CIPC_NO, 0, 0);
    cipc_stencil_piece unused = good;
    unused.x[6] = unused.start[2] = NAN; /* of nodes that a pair of points does not have */
    expect(&unused, 0, CIPC_YES, 1.875, 1.875);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ordinary_paths),          cmocka_unit_test(test_own_times), cmocka_unit_test(test_thirds_and_fifths), cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_times_against_rationals), cmocka_unit_test(test_scales),    cmocka_unit_test(test_bad_input_is_indeterminate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
