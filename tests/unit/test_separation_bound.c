/* Bounds of the certified CCD, in doubles and in MPFR: never above the exact gap, and no worse than their page promises (docs/theory/certified_ccd.md). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "contact/separation_bound.h"

/* Standing stencils, so that the gap at any time is the exact gap of x: general, facing closely, edges nearly parallel, far from the origin. */
static void draw(gsl_rng *rng, int shape, cipc_stencil_path *path)
{
    double far = shape == 3 ? 1e4 : 0, gap = pow(10, -14 * gsl_rng_uniform(rng));
    for (int i = 0; i < 12; i++) path->x[i] = gsl_rng_uniform(rng) - 0.5 + far;
    memcpy(path->p, path->x, sizeof path->p);
    path->to_end = true;
    if (shape == 0) return;
    static const double facing[12] = {0.2, 0.3, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, crossing[12] = {-1, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 0};
    bool edges = path->kind == CIPC_EDGE_EDGE;
    for (int i = 0; i < 12; i++) {
        bool first = i / 3 < cipc_pair_first_nodes(path->kind);
        path->x[i] = far + 0.01 * gsl_rng_uniform(rng) * (i % 3 != 2) + (i % 3 == 2 ? first * gap : (edges ? crossing : facing)[i]);
    }
    if (edges && shape == 2) {
        for (int k = 0; k < 2; k++) path->x[9 + k] = path->x[6 + k] + path->x[3 + k] - path->x[k] + 1e-3 * gap * gsl_rng_uniform(rng);
    }
    memcpy(path->p, path->x, sizeof path->p);
}

/* xi + lower <= d, but for the rounding of the sum. */
static bool holds(const cipc_stencil_path *path, double xi, double lower)
{
    return cipc_exact_distance_sign(path->kind, path->x, nextafter(xi + lower, 0)) >= 0;
}

static void test_never_above_the_exact_gap(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 3);
    int certified = 0, tight = 0, refused = 0, planted = 0;
    for (int i = 0; i < 20000; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT)};
        contact_local_path local;
        draw(rng, i / CIPC_PAIR_KIND_COUNT % 4, &path);
        double xi = i % 3 ? 0 : 1e-3 * gsl_rng_uniform(rng), exact = cipc_exact_distance_gap(path.kind, path.x, xi);
        assert_true(contact_local_path_init(&local, &path) && local.speed == 0);
        contact_gap_bound bound = contact_gap_at(&local, xi, 1);
        refused += bound.lower < 0;
        if (bound.lower < 0) continue;
        certified++;
        assert_true(holds(&path, xi, bound.lower));
        planted += !holds(&path, xi, bound.lower + 64 * 0x1p-53 * local.size); /* the same without its rounding bound, and twice that */
        tight += bound.lower >= (1 - 0x1p-10) * exact;
        assert_true(contact_gap_along(&local, bound.n, xi, 0.5) == bound.lower);
        assert_true(bound.lower >= exact - 0x1p-40 * local.size - 0x1p-50 * xi);
    }
    print_message("%d certified, %d within 2^-10, %d refused, %d with a planted excess rejected\n", certified, tight, refused, planted);
    assert_true(certified >= 10000 && tight >= 9000 && refused >= 10 && planted >= certified / 2);
    gsl_rng_free(rng);
}

static void test_mpfr(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 5);
    int close = 0, clear = 0;
    for (int i = 0; i < 2000; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT)};
        draw(rng, i / CIPC_PAIR_KIND_COUNT % 4, &path);
        double d = cipc_exact_distance_gap(path.kind, path.x, 0), xi = i % 2 ? d : nextafter(d, 0), lower = 0; /* d rounded: closer or not, by half an ulp */
        int precision = 0;
        contact_decision decision = contact_gap_mpfr(&path, xi, 0.25, &lower, &precision);
        assert_int_equal(decision, cipc_exact_distance_sign(path.kind, path.x, xi) > 0 ? CONTACT_CLEAR : CONTACT_CLOSE);
        if (decision == CONTACT_CLEAR) {
            double exact = cipc_exact_distance_gap(path.kind, path.x, xi);
            assert_true(lower > 0 && lower <= exact && lower >= 0.5 * exact);
        }
        clear += decision == CONTACT_CLEAR;
        close += decision == CONTACT_CLOSE;
    }
    assert_true(clear >= 500 && close >= 300);
    gsl_rng_free(rng);
}

static void test_surely_close(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 7);
    int said = 0;
    for (int i = 0; i < 20000; i++) {
        cipc_stencil_path path = {.kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT)};
        contact_local_path local;
        draw(rng, i / CIPC_PAIR_KIND_COUNT % 4, &path);
        double d = cipc_exact_distance_gap(path.kind, path.x, 0), xi = d + 64 * 0x1p-53 * (2 * gsl_rng_uniform(rng) - 1);
        assert_true(contact_local_path_init(&local, &path));
        bool close = xi >= 0 && contact_surely_close(&local, xi);
        if (close) assert_true(cipc_exact_distance_sign(path.kind, path.x, xi) <= 0);
        if (xi > d + 50 * 0x1p-53 * local.size + 0x1p-49 * d) assert_true(close);
        said += close;
    }
    assert_true(said >= 300);
    gsl_rng_free(rng);
}

/* l_p of two points, and where its squares would vanish or overflow. */
static void test_speed(void **state)
{
    (void)state;
    for (int e = -1070; e <= 1020; e += 19) {
        cipc_stencil_path path = {.kind = CIPC_POINT_POINT, .x = {0, 0, 1}, .p = {ldexp(1.5, e)}};
        contact_local_path local;
        assert_true(contact_local_path_init(&local, &path));
        assert_true(local.speed_unit == 0 ? local.speed > 0x1p-300 && local.speed < 0x1p300 : local.speed >= 0.5 && local.speed < 1);
        double speed = ldexp(local.speed, local.speed_unit - e);
        assert_true(speed >= 1.5 && speed <= 1.5 * (1 + 0x1p-48));
    }
    cipc_stencil_path still = {.kind = CIPC_POINT_POINT, .x = {0, 0, 1}, .p = {1, 2, 3, 1, 2, 3}}, huge = {.kind = CIPC_POINT_POINT, .x = {1.7e308}, .p = {-1.7e308}, .to_end = true};
    contact_local_path local;
    assert_true(contact_local_path_init(&local, &still) && local.speed == 0);
    assert_true(contact_local_path_init(&local, &huge) && local.speed >= 0.5 && local.speed_unit >= 1025);
    still.p[0] = INFINITY;
    assert_false(contact_local_path_init(&local, &still));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_never_above_the_exact_gap),
        cmocka_unit_test(test_mpfr),
        cmocka_unit_test(test_surely_close),
        cmocka_unit_test(test_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
