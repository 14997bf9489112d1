/* M4: the inversion monitor rejects a flat tetrahedron and accepts it one ulp of volume away. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"
#include "support/monitor_trial.h"

static monitor_trial look(const hand_model *h)
{
    return try_monitor(cipc_monitor_inversion, h, NULL);
}

static hand_model *tetrahedron(double height)
{
    hand_model *h = hand_model_create();
    int body = hand_body(h, "jelly", 0, 0, false);
    hand_node(h, body, 0.1, 0.2, 0.3);
    hand_node(h, body, 1.1, 0.2, 0.3);
    hand_node(h, body, 0.1, 1.2, 0.3);
    hand_node(h, body, 0.7, 0.4, height);
    hand_tetrahedron(h, 0, 1, 2, 3);
    return h;
}

static void test_one_ulp_from_flat(void **state)
{
    (void)state;
    hand_model *h = tetrahedron(0.3);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    h->x[11] = nextafter(0.3, 1);
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[11] = nextafter(0.3, 0);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    h->x[11] = 5;
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[11] = -5;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    hand_model_destroy(h);
}

static void test_degenerate(void **state)
{
    (void)state;
    hand_model *h = tetrahedron(1);
    memcpy(&h->x[9], &h->x[3], 3 * sizeof *h->x);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    memset(h->x, 0, 12 * sizeof *h->x);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    hand_model_destroy(h);
}

/* The fourth node on the plane of the others, or an ulp of one coordinate from it, anywhere in space: the sign is exact arithmetic's. */
static void test_random_planes_by_one_ulp(void **state)
{
    (void)state;
    uint64_t seed = 67;
    int signs[3] = {0, 0, 0};
    for (int i = 0; i < 3000; i++) {
        hand_model *h = tetrahedron(1);
        for (int k = 0; k < 9; k++) { h->x[k] = random_below(&seed, 2048) - 1024; }
        int s = random_below(&seed, 9) - 4, t = random_below(&seed, 9) - 4; /* small integers: the point is on the plane exactly */
        for (int k = 0; k < 3; k++) { h->x[9 + k] = h->x[k] + s * (h->x[3 + k] - h->x[k]) + t * (h->x[6 + k] - h->x[k]); }
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
        int coordinate = 9 + random_below(&seed, 3);
        h->x[coordinate] = nextafter(h->x[coordinate], random_below(&seed, 2) ? INFINITY : -INFINITY);
        int sign = cipc_exact_orientation(&h->x[0], &h->x[3], &h->x[6], &h->x[9]);
        assert_int_equal(look(h).status, sign > 0 ? CIPC_OK : CIPC_E_VIOLATED_INVERSION);
        signs[sign + 1]++;
        hand_model_destroy(h);
    }
    assert_true(signs[0] > 1000 && signs[2] > 1000);
}

static void test_large_common_translation(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "jelly", 0, 0, false);
    hand_node(h, body, 0, 0, 0);
    hand_node(h, body, 1, 0, 0);
    hand_node(h, body, 0, 1, 0);
    hand_node(h, body, 0, 0, 0x1p-22);
    hand_tetrahedron(h, 0, 1, 2, 3);
    const double far[3] = {0x1p30, 0x1p30, 0x1p30};
    hand_translate(h, far);
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[11] = nextafter(h->x[11], 0);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INVERSION);
    hand_model_destroy(h);
}

static void test_first_of_many_is_named(void **state)
{
    (void)state;
    hand_model *h = tetrahedron(1);
    for (int i = 0; i < 200; i++) { hand_tetrahedron(h, 0, i == 150 || i == 170 ? 2 : 1, i == 150 || i == 170 ? 1 : 2, 3); }
    cipc_invariant_options options = cipc_invariant_options_default();
    for (options.threads = 1; options.threads <= 3; options.threads++) {
        monitor_trial t = try_monitor(cipc_monitor_inversion, h, &options);
        assert_int_equal(t.status, CIPC_E_VIOLATED_INVERSION);
        assert_string_equal(t.error.place, "monitor inversion");
        assert_non_null(strstr(t.error.what, "tetrahedron 151 (nodes 0 2 1 3, body \"jelly\")"));
        assert_non_null(strstr(t.error.what, "sign -1"));
    }
    h->x[11] = 0.3;
    assert_non_null(strstr(look(h).error.what, "flat"));
    hand_model_destroy(h);
}

static void test_not_a_number_is_rejected(void **state)
{
    (void)state;
    hand_model *h = tetrahedron(1);
    h->x[0] = NAN;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_FINITE);
    hand_model_destroy(h);
}

static void test_nothing_to_invert(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    hand_node(h, hand_body(h, "point", 0, 0, false), 0, 0, 0);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_ulp_from_flat),        cmocka_unit_test(test_degenerate), cmocka_unit_test(test_random_planes_by_one_ulp),
        cmocka_unit_test(test_large_common_translation), cmocka_unit_test(test_first_of_many_is_named),
        cmocka_unit_test(test_not_a_number_is_rejected), cmocka_unit_test(test_nothing_to_invert),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
