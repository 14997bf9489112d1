/* Campaigns: they pass on the solver's functions, and each rejects the fault planted in one; samples are the same whatever shards and threads. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "verify/campaign.h"
#include "verify/distance.h"
#include "verify/energies.h"
#include "verify/intersection.h"
#include "verify/toi.h"

enum { ALL_ROWS = -1 };

/* Run the rows (or one) of a campaign with another context (NULL: its own). Returns the number of rows that fail; `text` gets the first reason. */
static int failures(const verify_campaign *campaign, int only, const void *context, long samples, char *text, size_t size)
{
    verify_campaign planted = *campaign;
    if (context != NULL) planted.context = context;
    const verify_run run = {.seed = 7, .samples = samples, .shard = 1, .shards = 1, .threads = 2};
    int failed = 0;
    char reason[256];
    static const char none[] = "";
    memcpy(text, none, sizeof none);
    for (int i = 0; i < campaign->row_count; i++) {
        verify_row row;
        if (only != ALL_ROWS && i != only) continue;
        assert_int_equal(verify_run_row(&planted, i, &run, &row, NULL), CIPC_OK);
        if (!verify_row_failure(&row, true, reason, sizeof reason)) continue;
        if (failed++ == 0) snprintf(text, size, "%s", reason);
    }
    return failed;
}

static void assert_passes(const verify_campaign *campaign, long samples)
{
    char text[256];
    if (failures(campaign, ALL_ROWS, NULL, samples, text, sizeof text) > 0) fail_msg("%s: %s", campaign->name, text);
}

static void assert_row_rejects(const verify_campaign *campaign, int row, const void *context, long samples, const char *part)
{
    char text[256];
    if (failures(campaign, row, context, samples, text, sizeof text) == 0) fail_msg("%s let it pass", campaign->name);
    if (strstr(text, part) == NULL) fail_msg("%s: rejected for another reason: %s", campaign->name, text);
}

static void test_the_solver_passes(void **state)
{
    (void)state;
    assert_passes(&verify_toi, 4000);
    assert_passes(&verify_distance, 8000);
    assert_passes(&verify_intersection, 2000);
    assert_passes(&verify_energies, 2500);
    assert_passes(&verify_derivatives, 2500);
}

static void assert_rejects(const verify_campaign *campaign, const void *context, long samples, const char *part)
{
    assert_row_rejects(campaign, ALL_ROWS, context, samples, part);
}

/* --- times of impact --- */

static cipc_ccd_result without_thickness(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    return cipc_certified_ccd(path, 0 * xi, t_max, options);
}

static cipc_ccd_result a_little_late(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    r.toi = fmin(1, 1.12 * r.toi); /* head-on the answer is 0.9 of the way */
    return r;
}

static cipc_ccd_result never_a_hit(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    r.hit = r.outcome == CIPC_CCD_INITIALLY_CLOSE;
    return r;
}

static cipc_ccd_result no_step(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    if (r.hit) r.toi = 0;
    return r;
}

static cipc_ccd_result far_too_early(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    if (r.hit) r.toi *= 0.01;
    return r;
}

static cipc_ccd_result blind_at_the_start(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_result r = cipc_certified_ccd(path, xi, t_max, options);
    if (r.outcome == CIPC_CCD_INITIALLY_CLOSE) r.outcome = CIPC_CCD_HIT;
    return r;
}

static cipc_ccd_result plain(const cipc_stencil_path *path, double xi, double t_max, const cipc_ccd_options *options)
{
    cipc_ccd_options o = *options;
    o.method = CIPC_CCD_ADDITIVE;
    o.max_iterations = 20000;
    return cipc_ccd(path, xi, t_max, &o);
}

static void test_wrong_times_of_impact(void **state)
{
    (void)state;
    const struct { verify_ccd ccd; long samples; const char *reason; } faults[] = {
        {without_thickness, 2000, "unsafe"}, {a_little_late, 2000, "unsafe"},   {never_a_hit, 2000, "missed"},
        {no_step, 2000, "no step"},          {far_too_early, 2000, "eq. 16"},   {blind_at_the_start, 2000, "start misjudged"},
        {plain, 20000, "unsafe"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        const verify_toi_subject subject = {faults[i].ccd};
        assert_rejects(&verify_toi, &subject, faults[i].samples, faults[i].reason);
    }
}

/* --- distances --- */

static cipc_feature always_the_inside(cipc_pair_kind kind, const double *x)
{
    cipc_feature f = verify_distance_of_the_solver.feature(kind, x);
    return kind == CIPC_POINT_POINT || f.kind == CIPC_POINT_POINT ? f : cipc_feature_at(kind, cipc_feature_count(kind) - 1);
}

static double a_little_long(cipc_pair_kind kind, const double *x) { return cipc_distance2_value(kind, x) * (1 + 1e-13); }

static void one_entry_off(cipc_pair_kind kind, const double *x, double *H)
{
    cipc_distance2_hessian(kind, x, H);
    H[7] *= 1 + 1e-10;
    if (kind == CIPC_EDGE_EDGE) H[20] += 1e-10 * fabs(H[0]);
}

static void half_the_gradient(cipc_pair_kind kind, const double *x, double *g)
{
    cipc_distance2_gradient(kind, x, g);
    for (int i = 0; i < 3 * cipc_pair_nodes(kind); i++) g[i] *= 0.5;
}

static void test_wrong_distances(void **state)
{
    (void)state;
    verify_distance_subject subject = verify_distance_of_the_solver;
    subject.feature = always_the_inside;
    assert_rejects(&verify_distance, &subject, 2000, "ULP of the stencil's size");
    subject = verify_distance_of_the_solver;
    subject.value = a_little_long;
    assert_rejects(&verify_distance, &subject, 2000, "ULP of the stencil's size");
    subject = verify_distance_of_the_solver;
    subject.gradient = half_the_gradient;
    assert_rejects(&verify_distance, &subject, 2000, "gradient");
    subject = verify_distance_of_the_solver;
    subject.hessian = one_entry_off;
    assert_rejects(&verify_distance, &subject, 2000, "Hessian");
}

/* --- intersections --- */

static bool touching_does_not_count(const double edge[6], const double triangle[9])
{
    return cipc_edge_triangle_intersect(edge, triangle) && cipc_orient3d(triangle, triangle + 3, triangle + 6, edge) != 0;
}

static int in_doubles(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    double det = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
    return (det > 0) - (det < 0);
}

static void test_wrong_intersections(void **state)
{
    (void)state;
    verify_intersection_subject subject = verify_intersection_of_the_solver;
    subject.meet = touching_does_not_count;
    assert_rejects(&verify_intersection, &subject, 2000, "wrong");
    subject = verify_intersection_of_the_solver;
    subject.orient3d = in_doubles;
    assert_rejects(&verify_intersection, &subject, 2000, "orient3d");
}

/* --- energies: each of these is right in all but one thing --- */

static cipc_energy planted; /* test programs may have state */
static cipc_energy_id planted_id;

static const cipc_energy *entry_with_fault(cipc_energy_id id) { return id == planted_id ? &planted : cipc_energy_entry(id); }

static void flipped_gradient(const double *x, const void *params, double *g)
{
    cipc_energy_entry(planted_id)->gradient(x, params, g);
    for (int i = 0; i < 3 * planted.nodes; i++) g[i] = -g[i];
}

static void gradient_off_by_a_billionth(const double *x, const void *params, double *g)
{
    cipc_energy_entry(planted_id)->gradient(x, params, g);
    for (int i = 0; i < 3 * planted.nodes; i++) g[i] *= 1 + 1e-9;
}

static void hessian_entry_off(const double *x, const void *params, double *H)
{
    int n = 3 * planted.nodes;
    cipc_energy_entry(planted_id)->hessian(x, params, H);
    H[1] += 1e-9 * fabs(H[0]);
    H[n] += 1e-9 * fabs(H[0]);
}

static double doubled_value(const double *x, const void *params) { return 2 * cipc_energy_entry(planted_id)->value(x, params); }

static void one_branch_only(gsl_rng *rng, int branch, double *x, void *params)
{
    (void)branch;
    cipc_energy_entry(planted_id)->sample(rng, 0, x, params);
}

static void test_wrong_energies(void **state)
{
    (void)state;
    const verify_energy_subject subject = {entry_with_fault};
    static const cipc_energy_id ids[] = {CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN, CIPC_ENERGY_HINGE_BENDING, CIPC_ENERGY_BARRIER_EDGE_EDGE, CIPC_ENERGY_FRICTION};
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        const cipc_energy *right = cipc_energy_entry(ids[i]);
        planted_id = ids[i];
        planted = *right;
        planted.gradient = flipped_gradient;
        assert_row_rejects(&verify_energies, (int)ids[i], &subject, 1200, "gradient");
        assert_row_rejects(&verify_derivatives, (int)ids[i], &subject, 1200, "differences");
        planted.gradient = gradient_off_by_a_billionth;
        assert_row_rejects(&verify_energies, (int)ids[i], &subject, 1200, "gradient");
        planted = *right;
        planted.hessian = hessian_entry_off;
        assert_row_rejects(&verify_energies, (int)ids[i], &subject, 1200, "Hessian");
        planted = *right;
        planted.value = doubled_value;
        assert_row_rejects(&verify_energies, (int)ids[i], &subject, 1200, "value");
        planted = *right;
        planted.sample = one_branch_only;
        assert_row_rejects(&verify_energies, (int)ids[i], &subject, 1200, "branch");
    }
}

/* --- samples --- */

/* The row of three shards on any number of threads is that of one run. */
static void test_shards_and_threads(void **state)
{
    (void)state;
    verify_row whole, parts, part;
    const verify_run all = {.seed = 3, .samples = 9000, .shard = 1, .shards = 1, .threads = 1};
    assert_int_equal(verify_run_row(&verify_distance, 7, &all, &whole, NULL), CIPC_OK);
    for (int shard = 1; shard <= 3; shard++) {
        const verify_run run = {.seed = 3, .samples = 9000, .shard = shard, .shards = 3, .threads = shard};
        assert_int_equal(verify_run_row(&verify_distance, 7, &run, &part, NULL), CIPC_OK);
        if (shard == 1) parts = part;
        else assert_true(verify_row_merge(&parts, &part));
    }
    assert_memory_equal(&parts, &whole, sizeof whole);
    const verify_run other = {.seed = 4, .samples = 9000, .shard = 1, .shards = 1, .threads = 1};
    assert_int_equal(verify_run_row(&verify_distance, 7, &other, &part, NULL), CIPC_OK);
    assert_memory_not_equal(&part, &whole, sizeof whole);
}

static bool stop_at_once(void *context, const char *campaign, const char *row, double share)
{
    (void)campaign, (void)row, (void)share;
    (*(int *)context)++;
    return true;
}

static void test_it_can_be_stopped(void **state)
{
    (void)state;
    int calls = 0;
    verify_row row;
    cipc_error error;
    const verify_run run = {.seed = 3, .samples = 9000, .shard = 1, .shards = 1, .threads = 1, .progress = stop_at_once, .progress_context = &calls};
    assert_int_equal(verify_run_row(&verify_distance, 0, &run, &row, &error), CIPC_E_NO_PROGRESS);
    assert_int_equal(calls, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_solver_passes),    cmocka_unit_test(test_wrong_times_of_impact), cmocka_unit_test(test_wrong_distances),
        cmocka_unit_test(test_wrong_intersections),  cmocka_unit_test(test_wrong_energies),        cmocka_unit_test(test_shards_and_threads),
        cmocka_unit_test(test_it_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
