/* The comparison of CCD methods: every answer gets the verdict that it deserves; planted methods - one that is late, one that never hits, one that never moves,
 * one that crawls - are counted as what they are; the solver's own are told apart. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "support/failing_memory.h"
#include "verify/ccd_comparison.h"

static int all_allocations_succeed(void **state)
{
    (void)state;
    fail_allocation(0);
    return 0;
}

typedef struct trial {
    verify_ccd_truth truth;
    bool hit;
    double toi;
    verify_ccd_worth worth;
} trial;

static void test_worth(void **state)
{
    (void)state;
    const verify_ccd_truth at_half = {{CIPC_YES, 0.5, 0.5}, 0.45}, within = {{CIPC_YES, 0.5, nextafter(0.5, 1)}, 0.45}, none = {{CIPC_NO, NAN, NAN}, 1};
    const verify_ccd_truth near_miss = {{CIPC_NO, NAN, NAN}, 0.25}, soon = {{CIPC_YES, 1e-9, 1e-9}, 0.9e-9};
    const double before_half = nextafter(0.5, 0);
    const trial trials[] = {
        {at_half, true, 0.45, VERIFY_CCD_USABLE},
        {at_half, true, before_half, VERIFY_CCD_USABLE},
        {at_half, true, 0.5, VERIFY_CCD_UNSAFE}, /* the contact itself */
        {at_half, true, 0.6, VERIFY_CCD_UNSAFE},
        {at_half, true, NAN, VERIFY_CCD_UNSAFE},
        {at_half, false, 1, VERIFY_CCD_MISSED},
        {at_half, false, 0.4, VERIFY_CCD_MISSED}, /* what it returns does not matter: it says the path is free */
        {at_half, true, 0, VERIFY_CCD_ZERO},
        {at_half, true, -0.1, VERIFY_CCD_ZERO},
        {at_half, true, 0.451e-3, VERIFY_CCD_USABLE},
        {at_half, true, 0.449e-3, VERIFY_CCD_TINY},
        {within, true, 0.5, VERIFY_CCD_USABLE}, /* the contact is between 0.5 and the next double */
        {within, true, nextafter(0.5, 1), VERIFY_CCD_UNSAFE},
        {none, false, 1, VERIFY_CCD_USABLE},
        {none, true, 0.3, VERIFY_CCD_USABLE},
        {none, true, 1e-4, VERIFY_CCD_TINY},
        {none, true, 0, VERIFY_CCD_ZERO},
        {none, true, NAN, VERIFY_CCD_ZERO},
        {near_miss, true, 0.3e-3, VERIFY_CCD_USABLE},
        {soon, true, 0.8e-9, VERIFY_CCD_USABLE}, /* small, but all that there is */
        {soon, true, 1e-6, VERIFY_CCD_UNSAFE},
    };
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) {
        const cipc_ccd_result answer = {.toi = trials[i].toi, .hit = trials[i].hit};
        verify_ccd_worth worth = verify_ccd_worth_of(&trials[i].truth, &answer);
        if (worth != trials[i].worth) fail_msg("trial %zu: %s, not %s", i, verify_ccd_worth_name(worth), verify_ccd_worth_name(trials[i].worth));
    }
}

/* --- whole comparisons --- */

static cipc_ccd_result late(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_ccd(path, xi, t_max, options);
    if (r.hit) r.toi = fmin(1, 1.3 * r.toi); /* past the contact, where that is what cut the step */
    return r;
}
static cipc_ccd_result never_hits(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    (void)path, (void)xi, (void)options;
    return (cipc_ccd_result){.toi = t_max, .outcome = CIPC_CCD_FREE};
}
static cipc_ccd_result never_moves(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    (void)path, (void)xi, (void)t_max, (void)options;
    return (cipc_ccd_result){.hit = true, .outcome = CIPC_CCD_HIT};
}
static cipc_ccd_result crawls(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_ccd(path, xi, t_max, options);
    r.toi *= 1e-4;
    r.hit = true;
    return r;
}

/* Points above a triangle at heights 0.1, 0.2, ... 1 that fall by 0.55: the first five touch it. With a thickness of 0.1 the first starts in contact. */
enum { POINTS = 10 };
static void make_queries(verify_ccd_queries *q, verify_ccd_query storage[POINTS], double xi)
{
    for (int i = 0; i < POINTS; i++) {
        const cipc_stencil_path path = {.kind = CIPC_POINT_TRIANGLE, .x = {0.25, 0.25, 0.1 * (i + 1), 0, 0, 0, 1, 0, 0, 0, 1, 0}, .p = {0, 0, -0.55}};
        storage[i] = (verify_ccd_query){.path = path, .thickness = xi, .scale = 0.1};
    }
    *q = (verify_ccd_queries){.query = storage, .count = POINTS};
}

static void assert_worths(const verify_ccd_score *s, long usable, long missed, long unsafe, long zero, long tiny)
{
    const long expected[VERIFY_CCD_WORTHS] = {usable, missed, unsafe, zero, tiny};
    for (int w = 0; w < VERIFY_CCD_WORTHS; w++)
        if (s->worth[w] != expected[w]) fail_msg("%s: %ld, not %ld", verify_ccd_worth_name((verify_ccd_worth)w), s->worth[w], expected[w]);
}

static void test_planted_methods(void **state)
{
    (void)state;
    verify_ccd_queries q;
    verify_ccd_query storage[POINTS];
    verify_ccd_comparison c;
    const cipc_ccd_options options = cipc_ccd_options_default();
    const verify_ccd_method planted[] = {
        {"late", late, options}, {"never hits", never_hits, options}, {"never moves", never_moves, options}, {"crawls", crawls, options}};
    make_queries(&q, storage, 0);
    assert_int_equal(verify_ccd_compare(&q, planted, 4, &c, NULL), CIPC_OK);
    assert_true(c.queries == POINTS && c.judged == POINTS && c.contacts == 5 && c.started_close == 0 && c.undecided == 0 && c.thick == 0);
    assert_worths(&c.scores[0], 5, 0, 5, 0, 0);
    assert_worths(&c.scores[1], 5, 5, 0, 0, 0);
    assert_worths(&c.scores[2], 0, 0, 0, 10, 0);
    assert_worths(&c.scores[3], 0, 0, 0, 0, 10);
    assert_true(c.scores[3].early == 5 && c.scores[2].early == 5 && c.scores[1].early == 0);
    assert_true(isnan(c.scores[1].median) && c.scores[0].median > 1 && c.scores[2].median == 0);
    make_queries(&q, storage, 0.1); /* 0.1 above: no nearer than the thickness, but as near; 0.6: 0.55 is enough then */
    assert_int_equal(verify_ccd_compare(&q, planted, 4, &c, NULL), CIPC_OK);
    assert_true(c.judged == 9 && c.started_close == 1 && c.contacts == 5 && c.thick == 9);
    assert_worths(&c.scores[1], 4, 5, 0, 0, 0);
}

/* The four of the solver in their order, of which the cubic alone does not see the thickness. The slackness is the query's. */
static void test_own_methods(void **state)
{
    (void)state;
    verify_ccd_queries q;
    verify_ccd_query storage[POINTS];
    verify_ccd_comparison c;
    verify_ccd_method own[VERIFY_CCD_METHODS];
    verify_ccd_own_methods(own);
    assert_true(own[0].options.method == CIPC_CCD_CERTIFIED && strcmp(own[0].name, "certified") == 0);
    assert_true(own[1].options.method == CIPC_CCD_ADDITIVE && own[1].options.gap_first && strcmp(own[1].name, "additive") == 0);
    assert_true(own[2].options.method == CIPC_CCD_CUBIC && strcmp(own[2].name, "cubic") == 0);
    assert_true(own[3].options.method == CIPC_CCD_MINIMUM_SEPARATION && strcmp(own[3].name, "minimum-separation") == 0);
    make_queries(&q, storage, 0.16);
    for (int i = 0; i < POINTS; i++) storage[i].scale = 0.25;
    assert_int_equal(verify_ccd_compare(&q, own, VERIFY_CCD_METHODS, &c, NULL), CIPC_OK);
    assert_true(c.judged == 9 && c.contacts == 6);
    for (int m = 0; m < VERIFY_CCD_METHODS; m++) {
        const verify_ccd_score *s = &c.scores[m];
        if (m != CIPC_CCD_CUBIC) assert_worths(s, 9, 0, 0, 0, 0);
        if (m == CIPC_CCD_MINIMUM_SEPARATION) assert_true(fabs(s->median - 0.75) < 1e-12 /* some roundings */); /* head-on: 1 - s of the time of contact */
        assert_true(s->mean_ns >= 0 && s->median_ns >= 0);
    }
    assert_worths(&c.scores[CIPC_CCD_CUBIC], 3, 2, 4, 0, 0); /* from 0.6 and 0.7 it meets nothing; from lower, three quarters of the way to 0 lead below 0.16 */
}

static void test_out_of_memory(void **state)
{
    (void)state;
    verify_ccd_queries q;
    verify_ccd_query storage[POINTS];
    verify_ccd_comparison c;
    verify_ccd_method own[VERIFY_CCD_METHODS];
    verify_ccd_own_methods(own);
    make_queries(&q, storage, 0);
    for (long n = 1; n <= 3; n++) {
        fail_allocation(n);
        assert_int_equal(verify_ccd_compare(&q, own, 1, &c, NULL), CIPC_E_OUT_OF_MEMORY);
    }
    fail_allocation(4);
    assert_int_equal(verify_ccd_compare(&q, own, 1, &c, NULL), CIPC_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_worth), cmocka_unit_test(test_planted_methods), cmocka_unit_test(test_own_methods),
                                       cmocka_unit_test_teardown(test_out_of_memory, all_allocations_succeed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
