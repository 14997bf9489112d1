/* M2: the gap monitor rejects d <= xi to the last bit, and accepts the next double. */
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
    return try_monitor(cipc_monitor_gap, h, NULL);
}

/* A point over a triangle: bodies "point" and "sheet" with these offsets; node 0 is the point. */
static hand_model *point_over_triangle(double offset_point, double offset_sheet, const double point[3], const double triangle[9])
{
    hand_model *h = hand_model_create();
    int a = hand_body(h, "point", offset_point, 0, false), b = hand_body(h, "sheet", offset_sheet, 0, false);
    hand_node(h, a, point[0], point[1], point[2]);
    for (int i = 0; i < 3; i++) { hand_node(h, b, triangle[3 * i], triangle[3 * i + 1], triangle[3 * i + 2]); }
    hand_triangle(h, 1, 2, 3);
    return h;
}

static hand_model *edge_over_edge(double offset_a, double offset_b, const double x[12])
{
    hand_model *h = hand_model_create();
    int a = hand_body(h, "first", offset_a, 0, false), b = hand_body(h, "second", offset_b, 0, false);
    for (int i = 0; i < 4; i++) { hand_node(h, i < 2 ? a : b, x[3 * i], x[3 * i + 1], x[3 * i + 2]); }
    hand_edge(h, 0, 1);
    hand_edge(h, 2, 3);
    return h;
}

static const double flat[9] = {-1, -1, 0, 2, -1, 0, -1, 2, 0};

/* The point at height z exactly: status of the monitor there. */
static void assert_border_at(hand_model *h, int coordinate, double border, double towards_free)
{
    h->x[coordinate] = border;
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_true(t.report.exact_gap_checks == 1 && t.report.min_gap == 0);
    h->x[coordinate] = nextafter(border, towards_free);
    t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_true(t.report.exact_gap_checks == 1 && t.report.min_gap > 0);
    h->x[coordinate] = nextafter(border, -towards_free);
    t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_true(t.report.min_gap < 0);
}

static void test_point_one_ulp_from_the_offset(void **state)
{
    (void)state;
    const double point[3] = {0.1, 0.2, 1};
    const double offsets[] = {0.25, 0.1, 3.18e-4, 1e-6};
    for (int i = 0; i < 4; i++) {
        hand_model *h = point_over_triangle(offsets[i], offsets[i], point, flat);
        assert_border_at(h, 2, offsets[i], INFINITY);
        hand_model_destroy(h);
    }
}

static void test_edges_one_ulp_from_the_offset(void **state)
{
    (void)state;
    const double x[12] = {-1, 0.3, 0.25, 1, -0.2, 0.25, 0.1, -1, 0, 0.2, 1, 0};
    hand_model *h = edge_over_edge(0.25, 0.25, x);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    h->x[2] = h->x[5] = nextafter(0.25, 1);
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[5] = nextafter(0.25, 0); /* one end above, one below: the closest points are between them */
    t = look(h);
    assert_int_equal(t.status, cipc_exact_distance_sign(CIPC_EDGE_EDGE, h->x, 0.25) > 0 ? CIPC_OK : CIPC_E_VIOLATED_GAP);
    h->x[2] = nextafter(0.25, 0);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
}

/* A plane across the axes with a normal (2, 3, 6) of length 7: the point at 7 times any power of two is at an exact distance. */
static void test_slanted_plane(void **state)
{
    (void)state;
    const double triangle[9] = {12, -8, 0, 0, 8, -4, -12, 0, 4}, point[3] = {0.5, 0.75, 1.5};
    hand_model *h = point_over_triangle(1.75, 1.75, point, triangle);
    assert_border_at(h, 2, 1.5, INFINITY);
    hand_model_destroy(h);
}

static void test_offset_is_the_mean_of_the_bodies(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 1};
    hand_model *h = point_over_triangle(0.125, 0.375, point, flat);
    assert_border_at(h, 2, 0.25, INFINITY);
    hand_model_destroy(h);
    h = point_over_triangle(0, 0.5, point, flat);
    assert_border_at(h, 2, 0.25, INFINITY);
    hand_model_destroy(h);
    h = point_over_triangle(0.1, 0.2, point, flat);
    assert_border_at(h, 2, 0.5 * (0.1 + 0.2), INFINITY);
    hand_model_destroy(h);
}

static void test_without_offset_only_contact_is_rejected(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0};
    hand_model *h = point_over_triangle(0, 0, point, flat);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_true(t.report.min_gap == 0);
    for (int sign = -1; sign <= 1; sign += 2) {
        h->x[2] = sign * 0x1p-1074;
        t = look(h);
        assert_int_equal(t.status, CIPC_OK);
        assert_true(t.report.min_gap == 0x1p-1074 && t.report.exact_gap_checks == 1);
    }
    hand_model_destroy(h);
}

static void test_large_common_translation(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.25}, far[3] = {0x1p40, -0x1p40, 0x1p40};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    hand_translate(h, far);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    h->x[2] = nextafter(h->x[2], INFINITY); /* an ulp is 2^-12 there: far above the rounding of the filter, which works with differences */
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_true(t.report.exact_gap_checks == 0 && t.report.min_gap == 0x1p-12);
    hand_model_destroy(h);
}

static void test_incident_pairs_are_no_pairs(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0.01, 0, false);
    const double o[3] = {0, 0, 0}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0};
    hand_grid(h, body, o, u, v, 8, 8);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_int_equal(t.report.pairs_checked, 0);
    assert_true(isinf(t.report.min_gap) && t.report.min_gap_nodes[0] == -1);
    hand_model_destroy(h);
}

/* Within one body, pairs that share no node do count. */
static void test_self_contact(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0.25, 0, false);
    for (int layer = 0; layer < 2; layer++) {
        int a = hand_node(h, body, 0, 0, layer * 0.25);
        hand_node(h, body, 4, 0, layer * 0.25);
        hand_node(h, body, 0, 4, layer * 0.25);
        hand_triangle(h, a, a + 1, a + 2);
    }
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    for (int i = 3; i < 6; i++) { h->x[3 * i + 2] = nextafter(0.25, 1); }
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_fixed_bodies_may_interpenetrate(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0};
    hand_model *h = point_over_triangle(0.1, 0.1, point, flat);
    h->model.bodies[0].fixed = h->model.bodies[1].fixed = true;
    assert_int_equal(look(h).status, CIPC_OK);
    cipc_invariant_options options = cipc_invariant_options_default();
    options.allow_fixed_fixed = false;
    assert_int_equal(try_monitor(cipc_monitor_gap, h, &options).status, CIPC_E_VIOLATED_GAP);
    h->model.bodies[1].fixed = false; /* one of the two moves: the pair counts */
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
}

static void test_degenerate_primitives(void **state)
{
    (void)state;
    const double line[9] = {0, 0, 0, 4, 0, 0, 1, 0, 0}, dot[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, over[3] = {2, 0, 0.25}, at[3] = {0, 0, 0.25};
    hand_model *h = point_over_triangle(0.25, 0.25, over, line);
    assert_border_at(h, 2, 0.25, INFINITY);
    hand_model_destroy(h);
    h = point_over_triangle(0.25, 0.25, at, dot);
    assert_border_at(h, 2, 0.25, INFINITY);
    hand_model_destroy(h);
    const double parallel[12] = {0, 0, 0.25, 4, 0, 0.25, 1, 0, 0, 3, 0, 0}, points[12] = {0, 0, 0.25, 0, 0, 0.25, 0, 0, 0, 0, 0, 0};
    h = edge_over_edge(0.25, 0.25, parallel);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    h->x[2] = h->x[5] = nextafter(0.25, 1);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
    h = edge_over_edge(0.25, 0.25, points);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
}

/* Edges almost parallel and almost touching: where the line-line formula fails, the answer must still be exact. */
static void test_nearly_parallel_edges(void **state)
{
    (void)state;
    for (int e = 10; e <= 50; e += 10) {
        double tilt = ldexp(1, -e), x[12] = {-1, 0, 0x1p-30, 1, 0, 0x1p-30, -1, -tilt, 0, 1, tilt, 0};
        hand_model *h = edge_over_edge(0x1p-30, 0x1p-30, x);
        monitor_trial t = look(h);
        assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
        assert_true(t.report.min_gap == 0);
        h->x[2] = h->x[5] = nextafter(0x1p-30, 1);
        assert_int_equal(look(h).status, CIPC_OK);
        hand_model_destroy(h);
    }
}

static void test_filter_settles_ordinary_pairs(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.2505};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_true(t.report.pairs_checked == 1 && t.report.exact_gap_checks == 0);
    assert_true(t.report.min_gap == 0.2505 - 0.25 && t.report.min_gap_kind == CIPC_POINT_TRIANGLE);
    for (int i = 0; i < 4; i++) { assert_int_equal(t.report.min_gap_nodes[i], i); }
    h->x[2] = 0.26; /* beyond reach */
    t = look(h);
    assert_true(t.report.pairs_checked == 0 && isinf(t.report.min_gap));
    hand_model_destroy(h);
}

static void test_message(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.125};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    monitor_trial t = look(h);
    const char *const parts[] = {"node 0", "\"point\"", "nodes 1 2 3", "\"sheet\"", "0.125",
                                 "0x1p-3", "0.25",      "0x1p-2",      "-0.125",    "-0x1p-3"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) { assert_non_null(strstr(t.error.what, parts[i])); }
    assert_string_equal(t.error.place, "monitor gap");
    assert_int_equal(t.error.status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
    const double x[12] = {-1, 0, 0, 1, 0, 0, 0, -1, 0.125, 0, 1, 0.125};
    h = edge_over_edge(0.25, 0.25, x);
    t = look(h);
    assert_non_null(strstr(t.error.what, "nodes 0 1, body \"first\""));
    assert_non_null(strstr(t.error.what, "nodes 2 3, body \"second\""));
    assert_true(t.report.min_gap == -0.125 && t.report.min_gap_kind == CIPC_EDGE_EDGE);
    hand_model_destroy(h);
}

/* Body "rope": segments in a row through these points, from node 0 on; no edges of triangles. */
static hand_model *rope(double offset, const double x[][3], int count)
{
    hand_model *h = hand_model_create();
    int body = hand_body_of(h, CIPC_BODY_RODS, "rope", offset, false);
    for (int i = 0; i < count; i++) { hand_node(h, body, x[i][0], x[i][1], x[i][2]); }
    for (int i = 1; i < count; i++) { hand_segment(h, i - 1, i); }
    return h;
}

/* A particle beside a segment. */
static void test_particle_one_ulp_from_a_rope(void **state)
{
    (void)state;
    const double x[2][3] = {{-1, 0, 0}, {2, 0, 0}}, offsets[] = {0.25, 0.1, 3.18e-4};
    for (int i = 0; i < 3; i++) {
        hand_model *h = rope(offsets[i], x, 2);
        hand_node(h, hand_body_of(h, CIPC_BODY_PARTICLES, "dust", offsets[i], false), 0.1, 0, 1);
        assert_border_at(h, 8, offsets[i], INFINITY);
        monitor_trial t = look(h); /* below the border now */
        assert_int_equal(t.report.min_gap_kind, CIPC_POINT_EDGE);
        assert_int_equal(t.report.min_gap_nodes[0], 2);
        assert_int_equal(t.report.min_gap_nodes[3], -1);
        assert_non_null(strstr(t.error.what, "node 2 (body \"dust\") and edge (nodes 0 1, body \"rope\"): distance"));
        h->x[6] = 3; /* past its end */
        assert_int_equal(look(h).status, CIPC_OK);
        hand_model_destroy(h);
    }
}

/* Parallel segments: edge-edge pairs alone would see them too; a rope folded back onto the segment next to its end is seen by its end only. */
static void test_rope_folded_back(void **state)
{
    (void)state;
    const double x[3][3] = {{0.5, 0, 0.125}, {2, 0, 0.125}, {-1, 0, 0}};
    hand_model *h = rope(0, x, 3);
    h->x[2] = h->x[5] = 0; /* nodes 0 and 1 on the segment of nodes 1 and 2 */
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_int_equal(t.report.min_gap_kind, CIPC_POINT_EDGE);
    assert_true(t.report.min_gap == 0 && t.report.min_gap_nodes[0] == 0 && t.report.min_gap_nodes[1] == 1);
    h->x[2] = 0x1p-1074;
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_particles_one_ulp_apart(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int sand = hand_body_of(h, CIPC_BODY_PARTICLES, "sand", 0.125, false), salt = hand_body_of(h, CIPC_BODY_PARTICLES, "salt", 0.375, false);
    hand_node(h, sand, 0.5, 0.5, 1);
    hand_node(h, salt, 0.5, 0.5, 0);
    assert_border_at(h, 2, 0.25, INFINITY); /* of unlike bodies: the mean */
    monitor_trial t = look(h);
    assert_int_equal(t.report.min_gap_kind, CIPC_POINT_POINT);
    assert_true(t.report.min_gap_nodes[0] == 0 && t.report.min_gap_nodes[1] == 1 && t.report.min_gap_nodes[2] == -1);
    assert_non_null(strstr(t.error.what, "node 0 (body \"sand\") and node 1 (body \"salt\"): distance"));
    h->model.bodies[salt].kind = CIPC_BODY_SHELL; /* loose nodes of other bodies meet no points */
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

/* Particles and rope against a sheet: pairs of points and edges with the triangle, as for any body. */
static void test_rope_through_a_sheet(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int sheet = hand_body(h, "sheet", 0.25, 0, false), line = hand_body_of(h, CIPC_BODY_RODS, "rope", 0.25, false);
    hand_new_triangle(h, sheet, flat);
    int low = hand_node(h, line, 0.1, 0.1, 0.25);
    hand_segment(h, low, hand_node(h, line, 0.1, 0.1, 3));
    assert_border_at(h, 11, 0.25, INFINITY);
    assert_int_equal(look(h).report.min_gap_kind, CIPC_POINT_TRIANGLE);
    hand_model_destroy(h);
}

/* Nothing touches a node inside a volume; the same node on the outside counts. */
static void test_nodes_inside_volumes_do_not_count(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.125};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_interior(h, 0);
    assert_int_equal(look(h).status, CIPC_OK);
    h->model.interior[0] = false;
    h->model.interior[1] = true; /* not the asking node */
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
}

/* A node of a triangle is on a surface, whatever its mark says. */
static void test_marks_of_surface_nodes_are_not_believed(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.125};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    int a = hand_node(h, 0, 0, 0.5, 9), b = hand_node(h, 0, 0.5, 0, 9);
    hand_triangle(h, 0, a, b);
    hand_interior(h, 0);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_model_destroy(h);
}

static void test_bodies_apart_pass(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    hand_apart(h, 0, 0);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP); /* that is another pair of bodies */
    hand_apart(h, 0, 1);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
    h = hand_model_create(); /* a body apart from itself */
    int sand = hand_body_of(h, CIPC_BODY_PARTICLES, "sand", 0.25, false);
    for (int i = 0; i < 2; i++) { hand_node(h, sand, 0, 0, 0); }
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_GAP);
    hand_apart(h, sand, sand);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_sewn_nodes_pass(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    hand_sew(h, 0, 2);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_node(h, 0, 0.1, 0.1, 0); /* its neighbour is not sewn */
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_int_equal(t.report.min_gap_nodes[0], 4);
    hand_model_destroy(h);
}

/* The worst pair is the one named. */
static void test_worst_pair_is_named(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 0.125};
    hand_model *h = point_over_triangle(0.25, 0.25, point, flat);
    hand_node(h, 0, 0.1, 0.1, 0.0625);
    hand_node(h, 0, 0.1, 0.2, 0.1);
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_GAP);
    assert_int_equal(t.report.min_gap_nodes[0], 4);
    assert_non_null(strstr(t.error.what, "node 4 "));
    hand_model_destroy(h);
}

static void test_not_a_number_is_rejected(void **state)
{
    (void)state;
    const double point[3] = {0, 0, 1};
    hand_model *h = point_over_triangle(0, 0, point, flat);
    h->x[4] = NAN;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_FINITE);
    hand_model_destroy(h);
}

/* Points whose heights over a slanted triangle differ by a few units in the last place: less than the filter's rounding, so that it puts them
 * in another order; the report has the exact minimum, and the first pair that has it. */
static void test_least_gap_is_exact_among_those_the_filter_confuses(void **state)
{
    (void)state;
    enum { POINTS = 40 };
    uint64_t seed = 5;
    for (int trial = 0; trial < 20; trial++) {
        hand_model *h = hand_model_create();
        int dust = hand_body(h, "dust", 0x1p-20, 0, false), sheet = hand_body(h, "sheet", 0x1p-20, 0, false);
        for (int i = 0; i < POINTS; i++) {
            double a = random_uniform(&seed, 0.1, 0.4), b = random_uniform(&seed, 0.1, 0.4);
            hand_node(h, dust, a, b, 0.3 * a + 0.7 * b + 1e-4);
        }
        hand_new_triangle(h, sheet, (const double[9]){0, 0, 0, 1, 0, 0.3, 0, 1, 0.7});
        double least = INFINITY, x[12];
        int first = -1, different = 0;
        memcpy(&x[3], &h->x[3 * POINTS], 9 * sizeof(double));
        for (int i = 0; i < POINTS; i++) {
            memcpy(x, &h->x[3 * i], 3 * sizeof(double));
            double gap = cipc_exact_distance_gap(CIPC_POINT_TRIANGLE, x, 0x1p-20);
            different += i > 0 && gap != least;
            if (gap < least) {
                least = gap;
                first = i;
            }
        }
        monitor_trial t = look(h);
        assert_int_equal(t.status, CIPC_OK);
        assert_true(different > 0 && t.report.exact_gap_checks == 0);
        assert_true(t.report.min_gap == least);
        assert_int_equal(t.report.min_gap_nodes[0], first);
        hand_model_destroy(h);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_point_one_ulp_from_the_offset),
        cmocka_unit_test(test_edges_one_ulp_from_the_offset),
        cmocka_unit_test(test_slanted_plane),
        cmocka_unit_test(test_offset_is_the_mean_of_the_bodies),
        cmocka_unit_test(test_without_offset_only_contact_is_rejected),
        cmocka_unit_test(test_large_common_translation),
        cmocka_unit_test(test_incident_pairs_are_no_pairs),
        cmocka_unit_test(test_self_contact),
        cmocka_unit_test(test_fixed_bodies_may_interpenetrate),
        cmocka_unit_test(test_degenerate_primitives),
        cmocka_unit_test(test_nearly_parallel_edges),
        cmocka_unit_test(test_filter_settles_ordinary_pairs),
        cmocka_unit_test(test_message),
        cmocka_unit_test(test_particle_one_ulp_from_a_rope),
        cmocka_unit_test(test_rope_folded_back),
        cmocka_unit_test(test_particles_one_ulp_apart),
        cmocka_unit_test(test_rope_through_a_sheet),
        cmocka_unit_test(test_nodes_inside_volumes_do_not_count),
        cmocka_unit_test(test_marks_of_surface_nodes_are_not_believed),
        cmocka_unit_test(test_bodies_apart_pass),
        cmocka_unit_test(test_sewn_nodes_pass),
        cmocka_unit_test(test_worst_pair_is_named),
        cmocka_unit_test(test_not_a_number_is_rejected),
        cmocka_unit_test(test_least_gap_is_exact_among_those_the_filter_confuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
