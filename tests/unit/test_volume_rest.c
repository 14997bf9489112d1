/* Rest data of a tetrahedron: B^-1, volume, Lame constants; what has no volume is refused (SPEC C.6). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/energy.h"

static const double ROUNDINGS = 16 * DBL_EPSILON;

static void test_inverse_and_volume(void **state)
{
    (void)state;
    /* Edges (2, 0, 0), (1, 4, 0), (0, 2, 0.5): B upper triangular, det 4. */
    const double rest[12] = {1, 1, 1, 3, 1, 1, 2, 5, 1, 1, 3, 1.5}, want[9] = {0.5, -0.125, 0.5, 0, 0.25, -1, 0, 0, 2};
    cipc_volume p;
    assert_true(cipc_volume_init(&p, rest, 1, 0));
    assert_true(fabs(p.volume - 4 / 6.0) <= ROUNDINGS);
    for (int i = 0; i < 9; i++) assert_true(fabs(p.inverse_rest[i] - want[i]) <= ROUNDINGS);
}

static void test_lame_constants(void **state)
{
    (void)state;
    const double rest[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    cipc_volume p;
    assert_true(cipc_volume_init(&p, rest, 13, 0.3));
    assert_true(fabs(p.mu - 5) <= 5 * ROUNDINGS);
    assert_true(fabs(p.lambda - 7.5) <= 7.5 * ROUNDINGS); /* 13 * 0.3 / (1.3 * 0.4) */
}

static void test_without_volume_nothing_is_written(void **state)
{
    (void)state;
    const double flat[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, mirrored[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, point[12] = {0};
    const double broken[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NAN}, huge[12] = {0, 0, 0, 1e200, 0, 0, 0, 1e200, 0, 0, 0, 1e200};
    const double *const refused[] = {flat, mirrored, point, broken, huge};
    const cipc_volume before = {.volume = 7};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        cipc_volume p = before;
        assert_false(cipc_volume_init(&p, refused[i], 1, 0.3));
        assert_memory_equal(&p, &before, sizeof p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inverse_and_volume),
        cmocka_unit_test(test_lame_constants),
        cmocka_unit_test(test_without_volume_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
