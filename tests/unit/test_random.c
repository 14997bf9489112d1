/* The random numbers of the generators. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/random.h"

/* First outputs of splitmix64 with state 1234567, published with the generator's reference code; the top 53 bits count. */
static void test_it_is_splitmix64(void **state)
{
    (void)state;
    static const uint64_t want[3] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u};
    uint64_t random = 1234567;
    for (int i = 0; i < 3; i++) assert_true(scene_random(&random) == (double)(want[i] >> 11) * 0x1p-53);
}

static void test_it_is_uniform(void **state)
{
    (void)state;
    enum { DRAWS = 100000, BINS = 10 };
    uint64_t random = 1;
    int bins[BINS] = {0};
    for (int i = 0; i < DRAWS; i++) {
        double u = scene_random(&random);
        assert_true(u >= 0 && u < 1);
        bins[(int)(BINS * u)]++;
    }
    for (int b = 0; b < BINS; b++) assert_true(bins[b] > 9600 && bins[b] < 10400); /* 4.2 standard deviations of 95 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_it_is_splitmix64),
        cmocka_unit_test(test_it_is_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
