/* M1: the intersection monitor rejects an edge that touches a triangle, and accepts it one ulp away. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "support/monitor_trial.h"

static monitor_trial look(const hand_model *h)
{
    return try_monitor(cipc_monitor_intersection, h, NULL);
}

/* Nodes 0 1: an edge of body "rod"; nodes 2 3 4: a triangle of body "sheet". */
static hand_model *edge_and_triangle(const double edge[6], const double triangle[9])
{
    hand_model *h = hand_model_create();
    int rod = hand_body(h, "rod", 0, 0, false), sheet = hand_body(h, "sheet", 0, 0, false);
    hand_node(h, rod, edge[0], edge[1], edge[2]);
    hand_node(h, rod, edge[3], edge[4], edge[5]);
    for (int i = 0; i < 3; i++) { hand_node(h, sheet, triangle[3 * i], triangle[3 * i + 1], triangle[3 * i + 2]); }
    hand_edge(h, 0, 1);
    hand_triangle(h, 2, 3, 4);
    return h;
}

/* A state and whether it must be rejected. */
typedef struct crossing_case {
    const char *name;
    double edge[6];
    bool meets;
} crossing_case;

static const double sheet[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0};

static const crossing_case cases[] = {
    {"through the inside", {1, 1, -1, 1, 1, 1}, true},
    {"end on the inside", {1, 1, 0, 1, 1, 1}, true},
    {"end one step above", {1, 1, 0x1p-1074, 1, 1, 1}, false},
    {"end one step below", {1, 1, -0x1p-1074, 1, 1, -1}, false},
    {"through a side", {2, 0, -1, 2, 0, 1}, true},
    {"just outside a side", {2, -0x1p-1074, -1, 2, -0x1p-1074, 1}, false},
    {"through a corner", {0, 0, -1, 0, 0, 1}, true},
    {"through the slanted side", {2, 2, -1, 2, 2, 1}, true},
    {"just outside the slanted side", {0x1.0000000000001p+1, 2, -1, 0x1.0000000000001p+1, 2, 1}, false},
    {"in the plane, across", {-1, 1, 0, 5, 1, 0}, true},
    {"in the plane, inside", {1, 1, 0, 1.5, 1, 0}, true},
    {"in the plane, beside", {3, 3, 0, 5, 1, 0}, false},
    {"in the plane, along a side", {-1, 0, 0, 9, 0, 0}, true},
    {"in the plane, touching a corner", {-1, 1, 0, 1, -1, 0}, true},
    {"in the plane, just missing a corner", {-1, 0x1.fffffffffffffp-1, 0, 1, -1.0000000000000002, 0}, false},
    {"parallel above", {0, 0, 1, 4, 4, 1}, false},
    {"line through, edge short of it", {1, 1, 0x1p-40, 1, 1, 1}, false},
    {"a point on it", {1, 1, 0, 1, 1, 0}, true},
    {"a point beside it", {3, 3, 0, 3, 3, 0}, false},
};

static void check_cases(const double translation[3])
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        hand_model *h = edge_and_triangle(cases[i].edge, sheet);
        hand_translate(h, translation);
        monitor_trial t = look(h);
        if (t.status != (cases[i].meets ? CIPC_E_VIOLATED_INTERSECTION : CIPC_OK)) {
            fail_msg("%s: status %d: %s", cases[i].name, (int)t.status, t.error.what);
        }
        if (cases[i].meets) { assert_int_equal(t.report.crossings_checked, 1); }
        hand_model_destroy(h);
    }
}

static void test_cases(void **state)
{
    (void)state;
    const double nowhere[3] = {0, 0, 0};
    check_cases(nowhere);
}

/* At a distance of 2^20 an ulp is 2^-32, so the near misses become hits; what is clear stays so. */
static void test_large_common_translation(void **state)
{
    (void)state;
    const double far[3] = {0x1p20, -0x1p20, 0x1p20};
    const double through[6] = {1, 1, -1, 1, 1, 1}, above[6] = {1, 1, 0x1p-32, 1, 1, 1};
    hand_model *h = edge_and_triangle(through, sheet);
    hand_translate(h, far);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    hand_model_destroy(h);
    h = edge_and_triangle(above, sheet);
    hand_translate(h, far);
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[2] = nextafter(h->x[2], -INFINITY);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    hand_model_destroy(h);
}

static void test_filter_and_predicate_are_both_reached(void **state)
{
    (void)state;
    const double clear[6] = {1, 1, 1e-4, 1, 1, 1}, close[6] = {1, 1, 0x1p-1074, 1, 1, 1};
    hand_model *h = edge_and_triangle(clear, sheet);
    assert_int_equal(look(h).report.crossings_checked, 0);
    hand_model_destroy(h);
    h = edge_and_triangle(close, sheet);
    monitor_trial t = look(h);
    assert_true(t.status == CIPC_OK && t.report.crossings_checked == 1);
    hand_model_destroy(h);
}

/* A flat cloth at rest, exactly in one plane: neighbours only touch through shared nodes, and no exact predicate is needed. */
static void test_flat_mesh(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0, 0, false);
    const double o[3] = {0.1, 0.2, 0.3}, u[3] = {1, 0.3, 0.1}, v[3] = {-0.2, 1, 0.3};
    hand_grid(h, body, o, u, v, 9, 7);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_int_equal(t.report.crossings_checked, 0);
    hand_model_destroy(h);
}

/* Two triangles folded onto one another share an edge: their other sides touch, but only through shared nodes; a fifth node makes it a
 * crossing. */
static void test_incident_pairs_are_no_pairs(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0, 0, false);
    hand_node(h, body, 0, 0, 0);
    hand_node(h, body, 1, 0, 0);
    hand_node(h, body, 0, 1, 0);
    hand_node(h, body, 0, 1, 0); /* folded flat onto node 2 */
    hand_triangle(h, 0, 1, 2);
    hand_triangle(h, 1, 0, 3);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_node(h, body, 0.25, 0.25, -1);
    hand_edge(h, 3, 4); /* shares node 3 with the second triangle, and touches the first at (0, 1, 0) */
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_INTERSECTION);
    assert_non_null(strstr(t.error.what, "nodes 0 1 2"));
    hand_model_destroy(h);
}

static void test_fixed_bodies_may_interpenetrate(void **state)
{
    (void)state;
    hand_model *h = edge_and_triangle(cases[0].edge, sheet);
    h->model.bodies[0].fixed = h->model.bodies[1].fixed = true;
    assert_int_equal(look(h).status, CIPC_OK);
    cipc_invariant_options options = cipc_invariant_options_default();
    options.allow_fixed_fixed = false;
    assert_int_equal(try_monitor(cipc_monitor_intersection, h, &options).status, CIPC_E_VIOLATED_INTERSECTION);
    for (int moving = 0; moving < 2; moving++) {
        h->model.bodies[moving].fixed = false;
        h->model.bodies[1 - moving].fixed = true;
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    }
    hand_model_destroy(h);
}

/* Bodies apart, and a node of the edge sewn to one of the triangle. */
static void test_what_the_scene_lets_pass(void **state)
{
    (void)state;
    hand_model *h = edge_and_triangle(cases[0].edge, sheet);
    hand_apart(h, 1, 1);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    hand_apart(h, 1, 0);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
    h = edge_and_triangle(cases[0].edge, sheet);
    hand_sew(h, 1, 4);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

/* A segment of a rope is an edge like others; a node inside a volume does not make its edges pass. */
static void test_segments_count(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int jelly = hand_body_of(h, CIPC_BODY_VOLUME, "jelly", 0, false), rope = hand_body_of(h, CIPC_BODY_RODS, "rope", 0, false);
    hand_new_triangle(h, jelly, sheet);
    int low = hand_node(h, rope, 1, 1, -1);
    hand_segment(h, low, hand_node(h, rope, 1, 1, 0));
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    hand_interior(h, low + 1);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_INTERSECTION);
    h->x[14] = -0x1p-1074;
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

/* Thickness is M2's: touching is what M1 looks for, whatever the offset. */
static void test_offset_does_not_matter(void **state)
{
    (void)state;
    const double above[6] = {1, 1, 1e-6, 1, 1, 1};
    hand_model *h = edge_and_triangle(above, sheet);
    h->model.bodies[0].offset = h->model.bodies[1].offset = 0.1;
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_degenerate_triangles(void **state)
{
    (void)state;
    const double line[9] = {0, 0, 0, 4, 0, 0, 2, 0, 0}, dot[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    const double across[6] = {1, -1, 0, 1, 1, 0}, past[6] = {5, -1, 0, 5, 1, 0}, through[6] = {0, 0, 0, 2, 2, 2},
                 beside[6] = {0, 0, 0, 2, 2, 2.5};
    const struct {
        const double *edge, *triangle;
        bool meets;
    } table[] = {{across, line, true}, {past, line, false}, {through, dot, true}, {beside, dot, false}};
    for (int i = 0; i < 4; i++) {
        hand_model *h = edge_and_triangle(table[i].edge, table[i].triangle);
        assert_int_equal(look(h).status, table[i].meets ? CIPC_E_VIOLATED_INTERSECTION : CIPC_OK);
        hand_model_destroy(h);
    }
}

static void test_message(void **state)
{
    (void)state;
    hand_model *h = edge_and_triangle(cases[0].edge, sheet);
    monitor_trial t = look(h);
    const char *const parts[] = {"edge 0 (nodes 0 1, body \"rod\")", "triangle 0 (nodes 2 3 4, body \"sheet\")",
                                 "x0 = (0x1p+0, 0x1p+0, -0x1p+0)", "x3 = (0x1p+2, 0x0p+0, 0x0p+0)"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) { assert_non_null(strstr(t.error.what, parts[i])); }
    assert_string_equal(t.error.place, "monitor intersection");
    hand_model_destroy(h);
}

static void test_not_a_number_is_rejected(void **state)
{
    (void)state;
    hand_model *h = edge_and_triangle(cases[15].edge, sheet);
    h->x[0] = INFINITY;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_FINITE);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cases),
        cmocka_unit_test(test_large_common_translation),
        cmocka_unit_test(test_filter_and_predicate_are_both_reached),
        cmocka_unit_test(test_flat_mesh),
        cmocka_unit_test(test_incident_pairs_are_no_pairs),
        cmocka_unit_test(test_fixed_bodies_may_interpenetrate),
        cmocka_unit_test(test_what_the_scene_lets_pass),
        cmocka_unit_test(test_segments_count),
        cmocka_unit_test(test_offset_does_not_matter),
        cmocka_unit_test(test_degenerate_triangles),
        cmocka_unit_test(test_message),
        cmocka_unit_test(test_not_a_number_is_rejected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
