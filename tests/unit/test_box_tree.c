/* Box tree: the same answers as all against all, after building and after refitting; cost n log n; out of memory at every allocation. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "support/exact_geometry.h"
#include "support/failing_memory.h"

/* A set of at most this many items, in the order they were visited. */
enum { MOST_ITEMS = 8000 };
typedef struct answer {
    int count;
    int items[MOST_ITEMS];
} answer;

static void visit(void *context, int item)
{
    answer *a = context;
    assert_true(a->count < MOST_ITEMS);
    a->items[a->count++] = item;
}

static int by_value(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

enum { SPREAD, ALL_ALIKE, ON_A_LINE, FEW_PLACES, INFINITE, POINTS, FAMILIES };

static cipc_box draw_box(uint64_t *seed, int family, double side)
{
    cipc_box box;
    for (int k = 0; k < 3; k++) {
        double at = random_uniform(seed, 0.0, 1.0);
        if (family == ALL_ALIKE || (family == ON_A_LINE && k)) at = 0.5;
        if (family == FEW_PLACES) at = 0.25 * random_below(seed, 4);
        box.lo[k] = at;
        box.hi[k] = at + (family == POINTS || family == FEW_PLACES ? 0.0 : side);
        if (family == INFINITE && !random_below(seed, 8)) box.lo[k] = -INFINITY;
        if (family == INFINITE && !random_below(seed, 8)) box.hi[k] = INFINITY;
    }
    return box;
}

static cipc_box *draw_boxes(uint64_t *seed, int family, int count, double side)
{
    cipc_box *boxes = cipc_alloc((size_t)count, sizeof *boxes);
    assert_non_null(boxes);
    for (int i = 0; i < count; i++) boxes[i] = draw_box(seed, family, side);
    return boxes;
}

/* Each box of the set, and some others, against all of them. Returns the number of overlaps. */
static int assert_equals_brute_force(uint64_t *seed, const cipc_box_tree *tree, const cipc_box *boxes, int count, int family)
{
    static answer got;
    int overlaps = 0;
    for (int q = 0; q < count + 10; q++) {
        cipc_box query = q < count ? boxes[q] : draw_box(seed, family, 0.3);
        got.count = 0;
        cipc_box_tree_query(tree, &query, visit, &got, NULL);
        qsort(got.items, (size_t)got.count, sizeof got.items[0], by_value);
        int place = 0;
        for (int i = 0; i < count; i++) {
            bool apart = false;
            for (int k = 0; k < 3; k++) apart = apart || boxes[i].hi[k] < query.lo[k] || query.hi[k] < boxes[i].lo[k];
            if (apart) continue;
            assert_true(place < got.count && got.items[place] == i);
            place++;
        }
        assert_int_equal(place, got.count);
        overlaps += place;
    }
    return overlaps;
}

static void test_equals_brute_force(void **state)
{
    (void)state;
    static const int counts[] = {0, 1, 2, 4, 5, 6, 9, 33, 300};
    uint64_t seed = 101;
    for (int family = 0; family < FAMILIES; family++) {
        int overlaps = 0;
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            cipc_box *boxes = draw_boxes(&seed, family, counts[c], 0.2), *moved = draw_boxes(&seed, family, counts[c], 0.2);
            cipc_box_tree *tree;
            assert_int_equal(cipc_box_tree_create(&tree, boxes, counts[c], NULL), CIPC_OK);
            overlaps += assert_equals_brute_force(&seed, tree, boxes, counts[c], family);
            cipc_box_tree_refit(tree, moved);
            overlaps += assert_equals_brute_force(&seed, tree, moved, counts[c], family);
            cipc_box_tree_destroy(tree);
            cipc_free(boxes);
            cipc_free(moved);
        }
        assert_true(overlaps >= 300);
    }
}

static void test_overlap_is_closed(void **state)
{
    (void)state;
    const cipc_box unit = {{0, 0, 0}, {1, 1, 1}};
    for (int k = 0; k < 3; k++) {
        cipc_box touching = unit, apart = unit;
        touching.lo[k] = 1.0, touching.hi[k] = 2.0;
        apart.lo[k] = 1.0 + DBL_EPSILON, apart.hi[k] = 2.0;
        assert_true(cipc_box_overlap(&unit, &touching) && cipc_box_overlap(&touching, &unit));
        assert_false(cipc_box_overlap(&unit, &apart) || cipc_box_overlap(&apart, &unit));
    }
}

/* The order of the answers depends on the boxes alone, not on the run. */
static void test_order_is_fixed(void **state)
{
    (void)state;
    static answer first, second;
    uint64_t seed = 102;
    enum { COUNT = 500 };
    cipc_box *boxes = draw_boxes(&seed, SPREAD, COUNT, 0.1);
    const cipc_box all = {{-9, -9, -9}, {9, 9, 9}};
    cipc_box_tree *a, *b;
    assert_int_equal(cipc_box_tree_create(&a, boxes, COUNT, NULL), CIPC_OK);
    assert_int_equal(cipc_box_tree_create(&b, boxes, COUNT, NULL), CIPC_OK);
    first.count = second.count = 0;
    cipc_box_tree_query(a, &all, visit, &first, NULL);
    cipc_box_tree_query(b, &all, visit, &second, NULL);
    assert_int_equal(first.count, COUNT);
    assert_int_equal(second.count, COUNT);
    assert_memory_equal(first.items, second.items, COUNT * sizeof first.items[0]);
    cipc_box_tree_destroy(a);
    cipc_box_tree_destroy(b);
    cipc_free(boxes);
}

/* Box tests of n queries with n boxes, in units of n log2 n. */
static double cost(int count, int family, double side)
{
    static answer got;
    uint64_t seed = 103;
    size_t tests = 0;
    cipc_box *boxes = draw_boxes(&seed, family, count, side);
    cipc_box_tree *tree;
    assert_int_equal(cipc_box_tree_create(&tree, boxes, count, NULL), CIPC_OK);
    for (int i = 0; i < count; i++) {
        got.count = 0;
        cipc_box_tree_query(tree, &boxes[i], visit, &got, &tests);
    }
    cipc_box_tree_destroy(tree);
    cipc_free(boxes);
    return (double)tests / (count * log2(count));
}

/* Spread-out boxes: about half the mean spacing wide, whatever their number. A descent tests two children a level, so 2 is
 * the least; the neighbours that a box straddles add to it. Measured: 3.4 for every count; the bound leaves half as much again. And
 * the growth from 1000 to 8000 boxes would be a factor 6 if the cost were quadratic. */
#define MOST_TESTS_PER_N_LOG_N 5.0
#define MOST_GROWTH 1.25
static void test_cost_grows_like_n_log_n(void **state)
{
    (void)state;
    double least = INFINITY, most = 0.0;
    for (int count = 1000; count <= MOST_ITEMS; count *= 2) {
        double units = cost(count, SPREAD, 0.5 * pow(count, -1.0 / 3.0));
        assert_true(units <= MOST_TESTS_PER_N_LOG_N);
        least = fmin(least, units);
        most = fmax(most, units);
    }
    assert_true(most <= MOST_GROWTH * least);
}

/* The check must be able to fail: boxes that all overlap cost n^2. */
static void test_cost_rejects(void **state)
{
    (void)state;
    assert_true(cost(1000, ALL_ALIKE, 0.5) > MOST_TESTS_PER_N_LOG_N);
}

static void test_failures(void **state)
{
    (void)state;
    uint64_t seed = 104;
    cipc_box *boxes = draw_boxes(&seed, SPREAD, 20, 0.1);
    cipc_box_tree *tree;
    cipc_error error;
    assert_int_equal(cipc_box_tree_create(&tree, boxes, -1, &error), CIPC_E_OUT_OF_RANGE);
    assert_null(tree);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_box_tree_create(&tree, boxes, 20, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_null(tree);
    }
    fail_allocation(0);
    assert_non_null(tree);
    cipc_box_tree_destroy(tree);
    cipc_box_tree_destroy(NULL);
    cipc_free(boxes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equals_brute_force),      cmocka_unit_test(test_overlap_is_closed), cmocka_unit_test(test_order_is_fixed),
        cmocka_unit_test(test_cost_grows_like_n_log_n), cmocka_unit_test(test_cost_rejects),      cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
