/* The broad phase: exactly the boxes that overlap, each once, whatever their order, size and number. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "invariant/patch_tree.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { LARGEST_COUNT = 700 };

static void test_rounding_to_float(void **state)
{
    (void)state;
    const double x[] = {0, 1, 0.1, -0.1, 1e-300, -1e-300, 1e300, -1e300, 16777217, DBL_MAX, 0x1p-150, -0x1p-149};
    for (size_t i = 0; i < sizeof x / sizeof x[0]; i++) {
        float lo = cipc_round_down(x[i]), hi = cipc_round_up(x[i]);
        assert_true((double)lo <= x[i] && (double)hi >= x[i]);
        assert_true(lo == hi || nextafterf(lo, INFINITY) == hi);
    }
    assert_true(cipc_round_down(INFINITY) == INFINITY && cipc_round_up(-INFINITY) == -INFINITY);
    assert_true(cipc_round_down(1e300) == FLT_MAX && isinf(cipc_round_up(1e300)));
}

/* Boxes of sizes from dust to everything. */
static void draw_boxes(uint64_t *seed, cipc_patch_box *boxes, int count)
{
    for (int i = 0; i < count; i++) {
        double size = pow(10, random_uniform(seed, random_below(seed, 2) == 0 ? -1 : -6, 1));
        for (int k = 0; k < 3; k++) {
            double corner = random_below(seed, 4) == 0 ? 0.25 * random_below(seed, 5) : random_uniform(seed, 0, 1);
            boxes[i].lo[k] = cipc_round_down(corner);
            boxes[i].hi[k] = cipc_round_up(corner + (random_below(seed, 4) == 0 ? 0 : size));
        }
    }
}

static bool overlap(const cipc_patch_box *a, const cipc_patch_box *b)
{
    bool meets = true;
    for (int k = 0; k < 3; k++) { meets = meets && a->lo[k] <= b->hi[k] && b->lo[k] <= a->hi[k]; }
    return meets;
}

/* The places that the tree reports for one box, in [begin, end), as the monitors ask. */
static void ask(const cipc_patch_tree *tree, const cipc_patch_box *box, int begin, int end, cipc_place_list *patches,
                int times[LARGEST_COUNT])
{
    patches->count = 0;
    assert_true(cipc_patch_tree_query(tree, box, begin, end, patches));
    for (int i = 0; i < patches->count; i++) {
        assert_true(i == 0 || patches->places[i] > patches->places[i - 1]);
        unsigned bits = cipc_patch_overlaps(&tree->levels[0][patches->places[i]], box);
        assert_true(bits != 0);
        for (; bits != 0; bits &= bits - 1) {
            int place = patches->places[i] * CIPC_PATCH_SIZE + cipc_lowest_bit(bits);
            assert_in_range(place, 0, tree->count - 1);
            times[place] += place >= begin && place < end ? 1 : 0;
        }
    }
}

static void check_tree(uint64_t *seed, int count, long *hits, long *misses)
{
    cipc_patch_tree tree;
    cipc_patch_box boxes[LARGEST_COUNT];
    cipc_place_list patches = {0};
    assert_true(cipc_patch_tree_init(&tree, count));
    for (int round = 0; round < 2; round++) { /* the second time, the boxes have moved */
        draw_boxes(seed, boxes, count);
        for (int i = 0; i < count; i++) { cipc_patch_tree_set(&tree, i, &boxes[i]); }
        cipc_patch_tree_refit(&tree);
        for (int q = 0; q < 40; q++) {
            cipc_patch_box box;
            draw_boxes(seed, &box, 1);
            int begin = random_below(seed, count + 1), end = random_below(seed, 2) ? count : begin + random_below(seed, count - begin + 1);
            int times[LARGEST_COUNT] = {0};
            ask(&tree, &box, begin, end, &patches, times);
            for (int i = 0; i < count; i++) {
                bool expected = i >= begin && i < end && overlap(&box, &boxes[i]);
                assert_int_equal(times[i], expected ? 1 : 0);
                *(expected ? hits : misses) += 1;
            }
        }
    }
    for (int i = 0; i < count; i++) {
        cipc_patch_box box = cipc_patch_tree_item_box(&tree, i), patch = cipc_patch_tree_patch_box(&tree, i / CIPC_PATCH_SIZE);
        assert_memory_equal(&box, &boxes[i], sizeof box);
        for (int k = 0; k < 3; k++) { assert_true(patch.lo[k] <= box.lo[k] && patch.hi[k] >= box.hi[k]); }
    }
    free(patches.places);
    cipc_patch_tree_free(&tree);
}

static void test_against_all_pairs(void **state)
{
    (void)state;
    fail_allocation(0);
    const int counts[] = {0, 1, 7, 8, 9, 63, 64, 65, 512, 513, LARGEST_COUNT};
    uint64_t seed = 61;
    long hits = 0, misses = 0;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) { check_tree(&seed, counts[i], &hits, &misses); }
    assert_true(hits > 1000 && misses > 1000);
}

static void test_boxes_that_touch_overlap(void **state)
{
    (void)state;
    fail_allocation(0);
    cipc_patch_tree tree;
    cipc_place_list patches = {0};
    int times[LARGEST_COUNT] = {0};
    assert_true(cipc_patch_tree_init(&tree, 2));
    const cipc_patch_box a = {{0, 0, 0}, {1, 1, 1}}, b = {{2, 0, 0}, {INFINITY, 1, 1}}, q = {{1, 1, 1}, {2, 2, 2}};
    cipc_patch_tree_set(&tree, 0, &a);
    cipc_patch_tree_set(&tree, 1, &b);
    cipc_patch_tree_refit(&tree);
    ask(&tree, &q, 0, 2, &patches, times);
    assert_int_equal(times[0], 1);
    assert_int_equal(times[1], 1);
    free(patches.places);
    cipc_patch_tree_free(&tree);
}

/* A small box asked of a tree of spread-out boxes must not look at all of them. */
static void test_few_patches_are_visited(void **state)
{
    (void)state;
    fail_allocation(0);
    enum { COUNT = 32768 };
    cipc_patch_tree tree;
    cipc_place_list patches = {0};
    assert_true(cipc_patch_tree_init(&tree, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const cipc_patch_box box = {{(float)i, 0, 0}, {(float)i + 0.5f, 1, 1}};
        cipc_patch_tree_set(&tree, i, &box);
    }
    cipc_patch_tree_refit(&tree);
    for (int i = 0; i < COUNT; i += 1000) {
        const cipc_patch_box box = {{(float)i, 0, 0}, {(float)i + 0.25f, 1, 1}};
        patches.count = 0;
        assert_true(cipc_patch_tree_query(&tree, &box, 0, COUNT, &patches));
        assert_in_range(patches.count, 1, 2);
    }
    free(patches.places);
    cipc_patch_tree_free(&tree);
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    long failures = 0;
    for (long n = 1;; n++) {
        cipc_patch_tree tree;
        cipc_place_list patches = {0};
        const cipc_patch_box all = {{-1, -1, -1}, {2, 2, 2}};
        fail_allocation(n);
        bool ok = cipc_patch_tree_init(&tree, 100);
        if (ok) {
            for (int i = 0; i < 100; i++) { cipc_patch_tree_set(&tree, i, &all); }
            cipc_patch_tree_refit(&tree);
            ok = cipc_patch_tree_query(&tree, &all, 0, 100, &patches);
        }
        assert_int_equal(ok, !allocation_failed());
        failures += ok ? 0 : 1;
        fail_allocation(0);
        free(patches.places);
        cipc_patch_tree_free(&tree);
        if (ok) { break; }
    }
    assert_int_equal(failures, 4); /* three levels (13, 2, 1 patches) and the list of answers */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rounding_to_float),        cmocka_unit_test(test_against_all_pairs),
        cmocka_unit_test(test_boxes_that_touch_overlap), cmocka_unit_test(test_few_patches_are_visited),
        cmocka_unit_test(test_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
