/* The assembled barrier potential of two triangles, as the conformance kit asks for it: against closed forms, and our answers against the oracle's sum. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "verify/conformance.h"
#include "verify/two_triangles.h"

/* The closed form has a quotient, a logarithm near -1 and four products, 8 u at most; the barrier's own chain is no longer, and six terms are summed with 5 u. */
#define TOLERANCE (24 * 0x1p-53)

/* Two corners that point at one another, a gap h apart along z, everything else far beyond reach. */
static cipc_query corners(double h, double thickness, double dhat)
{
    static const double a[9] = {0, 0, 0, 1, 0, -1, -0.5, 1, -1}, b[9] = {0, 0, 0, 1, 0.25, 1, -0.5, -1, 1};
    cipc_query q = {.fn = verify_function_name("potential/two_triangles"), .thickness = thickness};
    for (int i = 0; i < 9; i++) {
        q.x[i] = a[i];
        q.x[9 + i] = b[i] + (i % 3 == 2 ? h : 0);
    }
    memcpy(q.rest, q.x, sizeof q.x);
    q.params[VERIFY_DHAT] = dhat;
    q.params[VERIFY_STIFFNESS] = 3;
    return q;
}

static double first_number(const json_t *want, const char *field)
{
    return cipc_json_double(json_array_get(json_object_get(json_object_get(want, field), "numbers"), 0));
}

/* Two point-triangle and four edge-edge pairs meet in the two corners: six barriers of the same distance. */
static void test_corners_count_six_times(void **state)
{
    (void)state;
    const double h = 0.0625, xi = 0.03125, dhat = 0.0625;
    cipc_query q = corners(h, xi, dhat);
    double D = h * h - xi * xi, Dhat = (xi + dhat) * (xi + dhat) - xi * xi, want = -3 * 6 * (D - Dhat) * (D - Dhat) * log(D / Dhat);
    bool good = true;
    json_t *got = verify_two_triangles_answer(&q, &good), *truth = json_object();
    assert_true(good && verify_two_triangles_truth(&q, truth));
    assert_true(fabs(cipc_json_double(json_object_get(got, "value")) - want) < TOLERANCE * want);
    assert_true(fabs(first_number(truth, "value") - want) < TOLERANCE * want);
    json_decref(got);
    json_decref(truth);
}

static void test_out_of_reach_is_zero_and_touching_is_no_answer(void **state)
{
    (void)state;
    cipc_query far = corners(0.125, 0.0625, 0.0625), touching = corners(0.0625, 0.0625, 0.125); /* d = xi + dhat; d = xi */
    json_t *truth = json_object();
    assert_true(verify_two_triangles_truth(&far, truth));
    assert_true(first_number(truth, "value") == 0);
    json_decref(truth);
    bool good = true;
    json_t *got = verify_two_triangles_answer(&far, &good);
    assert_true(good && cipc_json_double(json_object_get(got, "value")) == 0);
    json_decref(got);
    truth = json_object();
    assert_false(verify_two_triangles_truth(&touching, truth));
    json_decref(truth);
}

/* Of every class that is drawn, ours agrees with the oracle's; with the largest Hessian entry off by three tolerances it does not. */
static void test_our_answers_pass_and_a_wrong_entry_fails(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    int asked = 0, active = 0, caught = 0, sharp = 0;
    for (int i = 0; i < 60; i++) {
        cipc_query q;
        bool good = true;
        verify_draw_query(verify_function_name("potential/two_triangles"), rng, i, false, &q);
        json_t *want = verify_truth(&q);
        if (want == NULL) continue;
        json_t *got = verify_two_triangles_answer(&q, &good), *hessian = json_object_get(got, "hessian");
        verify_verdict v = verify_judge(q.fn, want, got, VERIFY_BINARY64);
        assert_true(good);
        if (v.failed) fail_msg("sample %d: %s", i, v.reason);
        asked++;
        double largest = 0;
        size_t at = 0;
        for (size_t k = 0; k < json_array_size(hessian); k++) {
            double entry = fabs(cipc_json_double(json_array_get(hessian, k)));
            if (entry > largest) {
                largest = entry;
                at = k;
            }
        }
        if (largest > 0 && !v.other_feature && json_object_get(want, "hessian") != NULL) {
            active++;
            double tolerance = cipc_json_double(json_object_get(json_object_get(want, "hessian"), "tolerance"));
            sharp += tolerance < 1e-9 * largest; /* the others sit at gaps far below the size */
            json_array_set_new(hessian, at, json_real(cipc_json_double(json_array_get(hessian, at)) + 3 * tolerance)); /* ours is off by less than 1 */
            caught += verify_judge(q.fn, want, got, VERIFY_BINARY64).failed;
        }
        json_decref(got);
        json_decref(want);
    }
    gsl_rng_free(rng);
    assert_true(asked >= 50 && active >= 40 && sharp >= 30);
    assert_int_equal(caught, active);
}

/* On a border the derivatives must be there, and are not compared. */
static void test_borders(void **state)
{
    (void)state;
    cipc_query q = corners(0.0625, 0, 0.125);
    bool good = true;
    json_t *want = verify_truth(&q), *got = verify_two_triangles_answer(&q, &good);
    assert_true(want != NULL && good);
    json_array_set_new(json_object_get(got, "hessian"), 7, json_real(1e6));
    assert_true(verify_judge(q.fn, want, got, VERIFY_BINARY64).failed);
    json_object_set_new(want, "border", json_real(0.5));
    assert_false(verify_judge(q.fn, want, got, VERIFY_BINARY64).failed);
    json_object_del(got, "hessian");
    assert_true(verify_judge(q.fn, want, got, VERIFY_BINARY64).failed);
    json_decref(got);
    json_decref(want);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corners_count_six_times),
        cmocka_unit_test(test_out_of_reach_is_zero_and_touching_is_no_answer),
        cmocka_unit_test(test_our_answers_pass_and_a_wrong_entry_fails),
        cmocka_unit_test(test_borders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
