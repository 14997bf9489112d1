/* Checked memory: zeroed, overflow-safe, never NULL on success, and failing where the test says. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "cipc/base.h"
#include "support/failing_memory.h"

static int all_allocations_succeed(void **state)
{
    (void)state;
    fail_allocation(0);
    return 0;
}

static void test_alloc_is_zeroed(void **state)
{
    (void)state;
    enum { COUNT = 1000 };
    /* Dirty a block of the same size first, so that plain recycled memory would show. */
    unsigned char *dirty = cipc_alloc(COUNT, sizeof(double));
    assert_non_null(dirty);
    memset(dirty, 0xff, COUNT * sizeof(double));
    cipc_free(dirty);
    double *block = cipc_alloc(COUNT, sizeof *block);
    assert_non_null(block);
    for (int i = 0; i < COUNT; i++) {
        assert_true(block[i] == 0.0);
    }
    cipc_free(block);
}

static void test_empty_arrays_have_a_block(void **state)
{
    (void)state;
    void *a = cipc_alloc(0, sizeof(double)), *b = cipc_alloc(3, 0);
    assert_non_null(a);
    assert_non_null(b);
    assert_ptr_not_equal(a, b);
    a = cipc_realloc(a, 0, sizeof(double));
    assert_non_null(a);
    cipc_free(a);
    cipc_free(b);
}

static void test_product_that_overflows_is_refused(void **state)
{
    (void)state;
    int *block = cipc_alloc(1, sizeof *block);
    assert_non_null(block);
    *block = 42;
    assert_null(cipc_alloc(SIZE_MAX / 4 + 1, 4)); /* 2^64: wraps to 0 */
    assert_null(cipc_alloc(SIZE_MAX / 2 + 2, 2)); /* wraps to 2 */
    assert_null(cipc_realloc(block, SIZE_MAX / 4 + 1, 4));
    assert_null(cipc_realloc(block, SIZE_MAX / 2 + 2, 2));
    assert_int_equal(*block, 42); /* the old block stays valid */
    assert_int_equal(allocation_count(), 1); /* none of the four reached the system */
    cipc_free(block);
}

static void test_realloc_keeps_the_content(void **state)
{
    (void)state;
    int *block = cipc_realloc(NULL, 4, sizeof *block);
    assert_non_null(block);
    for (int i = 0; i < 4; i++) {
        block[i] = i;
    }
    block = cipc_realloc(block, 100000, sizeof *block);
    assert_non_null(block);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(block[i], i);
    }
    cipc_free(block);
}

static void test_free_takes_null(void **state)
{
    (void)state;
    cipc_free(NULL);
    assert_int_equal(allocation_count(), 0);
}

/* The countdown itself: exactly the N-th call fails, the ones before and after do not. */
static void test_nth_call_fails(void **state)
{
    (void)state;
    enum { CALLS = 6 };
    for (long n = 1; n <= CALLS; n++) {
        fail_allocation(n);
        for (long i = 1; i <= CALLS; i++) {
            void *block = i % 2 == 1 ? cipc_alloc(8, 8) : cipc_realloc(NULL, 8, 8);
            assert_int_equal(block == NULL, i == n);
            assert_int_equal(allocation_failed(), i >= n);
            cipc_free(block);
        }
        assert_int_equal(allocation_count(), CALLS);
    }
}

static void test_failed_realloc_leaves_the_old_block(void **state)
{
    (void)state;
    int *block = cipc_alloc(2, sizeof *block);
    assert_non_null(block);
    block[1] = 7;
    fail_allocation(1);
    assert_null(cipc_realloc(block, 1000, sizeof *block));
    assert_int_equal(block[1], 7);
    cipc_free(block);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_alloc_is_zeroed, all_allocations_succeed),
        cmocka_unit_test_setup(test_empty_arrays_have_a_block, all_allocations_succeed),
        cmocka_unit_test_setup(test_product_that_overflows_is_refused, all_allocations_succeed),
        cmocka_unit_test_setup(test_realloc_keeps_the_content, all_allocations_succeed),
        cmocka_unit_test_setup(test_free_takes_null, all_allocations_succeed),
        cmocka_unit_test_setup(test_nth_call_fails, all_allocations_succeed),
        cmocka_unit_test_setup(test_failed_realloc_leaves_the_old_block, all_allocations_succeed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
