/* The table of pair kinds and features: consistent with itself and with the classification's own answers. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "cipc/geometry.h"

static void test_numbers_and_features_agree(void **state)
{
    (void)state;
    static const int nodes[] = {2, 3, 4, 4}, first[] = {1, 1, 1, 2}, features[] = {1, 3, 7, 9};
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) {
        cipc_pair_kind kind = (cipc_pair_kind)k;
        assert_int_equal(cipc_pair_nodes(kind), nodes[k]);
        assert_int_equal(cipc_pair_first_nodes(kind), first[k]);
        assert_int_equal(cipc_feature_count(kind), features[k]);
        for (int i = 0; i < features[k]; i++) {
            cipc_feature feature = cipc_feature_at(kind, i);
            assert_int_equal(feature.count, cipc_pair_nodes(feature.kind));
            assert_int_equal(cipc_feature_index(kind, &feature), i);
            for (int j = 0; j < i; j++) assert_string_not_equal(cipc_feature_name(kind, i), cipc_feature_name(kind, j));
        }
    }
}

/* The ends of an edge may come in either order; the first node and the kind may not change. */
static void test_orders_of_an_edge(void **state)
{
    (void)state;
    const cipc_feature turned = {CIPC_POINT_EDGE, 3, {0, 1, 3, 0}}, foreign = {CIPC_POINT_EDGE, 3, {1, 0, 2, 0}};
    assert_int_equal(cipc_feature_index(CIPC_POINT_TRIANGLE, &turned), 5);
    assert_string_equal(cipc_feature_name(CIPC_POINT_TRIANGLE, 5), "p-t2t0");
    assert_int_equal(cipc_feature_index(CIPC_POINT_TRIANGLE, &foreign), -1);
    const cipc_feature points = {CIPC_POINT_POINT, 2, {0, 1, 0, 0}};
    assert_int_equal(cipc_feature_index(CIPC_EDGE_EDGE, &points), -1);
}

/* Whatever the classification answers has a number. */
static void test_the_classification_speaks_these_words(void **state)
{
    (void)state;
    static const double over_corner[12] = {-1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, inside[12] = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const double over_side[12] = {-1, 0.5, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, crossing[12] = {-1, 0, 0, 1, 0, 0, 0, -1, 1, 0, 1, 1};
    cipc_feature f = cipc_point_triangle_feature(over_corner);
    assert_string_equal(cipc_feature_name(CIPC_POINT_TRIANGLE, cipc_feature_index(CIPC_POINT_TRIANGLE, &f)), "p-t0");
    f = cipc_point_triangle_feature(inside);
    assert_string_equal(cipc_feature_name(CIPC_POINT_TRIANGLE, cipc_feature_index(CIPC_POINT_TRIANGLE, &f)), "p-t");
    f = cipc_point_triangle_feature(over_side);
    assert_string_equal(cipc_feature_name(CIPC_POINT_TRIANGLE, cipc_feature_index(CIPC_POINT_TRIANGLE, &f)), "p-t2t0");
    f = cipc_edge_edge_feature(crossing);
    assert_string_equal(cipc_feature_name(CIPC_EDGE_EDGE, cipc_feature_index(CIPC_EDGE_EDGE, &f)), "a-b");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_and_features_agree),
        cmocka_unit_test(test_orders_of_an_edge),
        cmocka_unit_test(test_the_classification_speaks_these_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
