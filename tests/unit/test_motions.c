/* Windows of motion of a Dirichlet set. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/motions.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

static void test_windows(void **state)
{
    (void)state;
    int count;
    cipc_motion *m;
    scene_reader r = reader_of("{\"motion\": [{}, {\"begin\": 1, \"end\": 3, \"velocity\": [1, 2, 3], \"angular_velocity\": -2, \"axis\": [0, 0, 3], "
                               "\"center\": [4, 5, 6], \"turn\": 0.5}, {\"turn\": \"never\"}]}");
    scene_cursor root = scene_root(r.root);
    scene_read_motions(&r, &root, &count, &m);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(count, 3);
    assert_true(m[0].begin == 0 && isinf(m[0].end) && m[0].velocity[0] == 0 && m[0].angular_velocity == 0 && m[0].turn == 0);
    assert_true(m[0].axis[0] == 0 && m[0].axis[1] == 1);
    assert_true(m[1].begin == 1 && m[1].end == 3 && m[1].velocity[2] == 3 && m[1].angular_velocity == -2 && m[1].turn == 0.5);
    assert_true(m[1].axis[2] == 1 && m[1].center[1] == 5);
    assert_true(m[2].turn == 0);
    cipc_free(m);
    scene_reader_free(&r);
}

static void test_no_motion(void **state)
{
    (void)state;
    int count;
    cipc_motion *m;
    scene_reader r = reader_of("{}");
    scene_cursor root = scene_root(r.root);
    scene_read_motions(&r, &root, &count, &m);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(count, 0);
    assert_true(json_is_array(json_object_get(r.root, "motion")));
    cipc_free(m);
    fail_allocation(1);
    scene_read_motions(&r, &root, &count, &m);
    fail_allocation(0);
    assert_rejection(&r, CIPC_E_OUT_OF_MEMORY, "t.json:1:1 motion", "no memory");
    assert_null(m);
    scene_reader_free(&r);
}

static void refuse(const char *text, cipc_status status, const char *place, const char *what)
{
    int count;
    cipc_motion *m;
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_read_motions(&r, &root, &count, &m);
    assert_rejection(&r, status, place, what);
    cipc_free(m);
    scene_reader_free(&r);
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{\"motion\": {}}", CIPC_E_WRONG_TYPE, "t.json:1:2 motion", "an array");
    refuse("{\"motion\": [{\"turn\": 0}]}", CIPC_E_OUT_OF_RANGE, "t.json:1:14 motion.0.turn", "greater than 0 or \"never\"");
    refuse("{\"motion\": [{\"turn\": -1}]}", CIPC_E_OUT_OF_RANGE, "t.json:1:14 motion.0.turn", "is -1");
    refuse("{\"motion\": [{\"turn\": \"once\"}]}", CIPC_E_WRONG_TYPE, "t.json:1:14 motion.0.turn", "a number or \"never\"");
    refuse("{\"motion\": [{\"end\": 0}]}", CIPC_E_OUT_OF_RANGE, "t.json:1:14 motion.0.end", "must be after the begin at 0");
    refuse("{\"motion\": [{\"trun\": 1}]}", CIPC_E_UNKNOWN_KEY, "t.json:1:14 motion.0.trun", "'turn'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_windows),
        cmocka_unit_test(test_no_motion),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
