/* M8: any NaN or infinity among the positions is rejected, and named. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/monitor_trial.h"

static hand_model *three_points(void)
{
    hand_model *h = hand_model_create();
    int first = hand_body(h, "first", 0, 0, false), second = hand_body(h, "second", 0, 0, false);
    hand_node(h, first, DBL_MAX, -DBL_MAX, 0x1p-1074);
    hand_node(h, first, -0.0, 0, 1);
    hand_node(h, second, 1, 2, 3);
    return h;
}

static void test_every_coordinate(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    hand_model *h = three_points();
    cipc_error error;
    assert_int_equal(cipc_monitor_finite(&h->model, h->x, &error), CIPC_OK);
    for (int i = 0; i < 9; i++) {
        for (int k = 0; k < 3; k++) {
            double good = h->x[i];
            char name[64];
            h->x[i] = bad[k];
            assert_int_equal(cipc_monitor_finite(&h->model, h->x, &error), CIPC_E_VIOLATED_FINITE);
            snprintf(name, sizeof name, "coordinate %c of node %d of body \"%s\"", "xyz"[i % 3], i / 3, i < 6 ? "first" : "second");
            assert_non_null(strstr(error.what, name));
            assert_string_equal(error.place, "monitor finite");
            h->x[i] = good;
        }
    }
    assert_int_equal(cipc_monitor_finite(&h->model, h->x, NULL), CIPC_OK);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_coordinate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
