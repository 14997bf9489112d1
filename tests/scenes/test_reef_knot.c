/* The reef knot of C-IPC's fig. 4: it is one, and under the strain limit it ends tighter than without. CIPC_SIZE=desk runs it at that size (default ci). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "support/claim.h"
#include "support/figure_run.h"

static const char file[] = "tests/scenes/reef-knot.json";
static const double limit = 1.134;
/* The core of the knot: what of each ribbon is less than this from the middle of its length, m: about half the way once round the other's two legs when they lie bundled. */
static const double core_length = 0.03;
/* Tighter, as the paper has it. By how much is left to the details of the crumpling: at size ci the limited core has 0.54 to 0.74 of the other's radius with the start as it is and disturbed
 * by 1e-9 m in three ways, and 0.92 with another BLAS's kernels (OPENBLAS_CORETYPE=Haswell), which disturb the last bits of every step. */
static const double tighter = 1;
enum { RIBBONS = 2, CROSSINGS_MAX = 32, CROSSINGS = 6 };

/* ---- Is it a reef knot? ----------------------------------------------------------------------------------------------------- */

/* The middle line of a ribbon: `count` points, from one end to the other. */
typedef struct line {
    int count;
    double (*x)[3];
} line;

/* Nodes of a section, which follow one another: across + 1, from (along + 1) (across + 1) nodes and 2 along across triangles. */
static int nodes_across(int nodes, int triangles)
{
    for (int wide = 2; wide <= nodes / 2; wide++) {
        if (nodes % wide == 0 && 2 * (nodes / wide - 1) * (wide - 1) == triangles && wide < nodes / wide) return wide;
    }
    fail_msg("%d nodes and %d triangles are no ribbon", nodes, triangles);
    return 0;
}

static line middle_line(const cipc_model *m, const double *position, int body)
{
    const cipc_body *b = &m->bodies[body];
    int wide = nodes_across(b->node_count, b->triangle_count);
    line l = {b->node_count / wide, calloc((size_t)(b->node_count / wide), sizeof(double[3]))};
    assert_non_null(l.x);
    for (int i = 0; i < b->node_count; i++) v3_axpy(l.x[i / wide], 1.0 / wide, position + 3 * (b->first_node + i));
    return l;
}

/* Where two lines cross as seen along y: the places on both, counted in points, and which is higher. */
typedef struct crossing {
    double on[RIBBONS];
    bool left_above;
} crossing;

static bool cross(const line *p, int i, const line *q, int j, crossing *found)
{
    const double *a = p->x[i], *b = p->x[i + 1], *c = q->x[j], *d = q->x[j + 1];
    double ux = b[0] - a[0], uz = b[2] - a[2], vx = d[0] - c[0], vz = d[2] - c[2], wx = c[0] - a[0], wz = c[2] - a[2], det = ux * vz - uz * vx;
    double s = (wx * vz - wz * vx) / det, t = (wx * uz - wz * ux) / det;
    if (!(s >= 0 && s < 1 && t >= 0 && t < 1)) return false;
    *found = (crossing){{i + s, j + t}, a[1] + s * (b[1] - a[1]) > c[1] + t * (d[1] - c[1])};
    return true;
}

static int find_crossings(const line lines[RIBBONS], crossing found[CROSSINGS_MAX])
{
    int count = 0;
    for (int i = 0; i + 1 < lines[0].count; i++) { /* in the order of the left ribbon */
        for (int j = 0; j + 1 < lines[1].count; j++) {
            assert_true(count < CROSSINGS_MAX);
            count += cross(&lines[0], i, &lines[1], j, &found[count]);
        }
    }
    return count;
}

static int crossings_with_itself(const line *l)
{
    int count = 0;
    crossing unused;
    for (int i = 0; i + 1 < l->count; i++) {
        for (int j = i + 2; j + 1 < l->count; j++) count += cross(l, i, l, j, &unused);
    }
    return count;
}

static int compare_on_right(const void *a, const void *b)
{
    const crossing *p = a, *q = b;
    return (p->on[1] > q->on[1]) - (p->on[1] < q->on[1]);
}

/* The diagram of a reef knot: the left ribbon passes over the right's bight, under its leg, over both legs, under the other leg, over the bight; and the right ribbon the other way
 * about. Both ends of each ribbon lie on one side of the other's bight; in the granny knot, whose diagram alternates, they do not. */
static bool is_reef(const crossing *found, int count)
{
    static const bool left[CROSSINGS] = {true, false, true, true, false, true};
    static const int partner[CROSSINGS] = {2, 1, 0, 5, 4, 3}; /* the k-th crossing along the left ribbon is this one along the right */
    crossing sorted[CROSSINGS_MAX];
    if (count != CROSSINGS) return false;
    memcpy(sorted, found, CROSSINGS * sizeof *sorted);
    qsort(sorted, CROSSINGS, sizeof *sorted, compare_on_right);
    for (int k = 0; k < CROSSINGS; k++) {
        if (found[k].left_above != left[k] || sorted[partner[k]].on[0] != found[k].on[0]) return false;
    }
    return true;
}

static void test_it_is_a_reef_knot(void **state)
{
    (void)state;
    char size[64];
    snprintf(size, sizeof size, "size=%s", figure_size());
    const char *overrides[1] = {size};
    cipc_scene *scene;
    cipc_error error;
    crossing found[CROSSINGS_MAX];
    if (cipc_scene_load(&scene, file, 1, overrides, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    line lines[RIBBONS];
    for (int r = 0; r < RIBBONS; r++) {
        lines[r] = middle_line(scene->model, scene->state->position, r);
        assert_int_equal(crossings_with_itself(&lines[r]), 0);
    }
    int count = find_crossings(lines, found);
    assert_true(is_reef(found, count));
    /* What is not one: the half of the left ribbon beyond its middle upside down (a granny), one ribbon above all of the other (two loose bights), and the ribbons drawn apart. */
    for (int i = lines[0].count / 2; i < lines[0].count; i++) lines[0].x[i][1] *= -1;
    assert_false(is_reef(found, find_crossings(lines, found)));
    for (int i = 0; i < lines[0].count; i++) lines[0].x[i][1] = 1;
    assert_false(is_reef(found, find_crossings(lines, found)));
    for (int i = 0; i < lines[0].count; i++) lines[0].x[i][0] -= 1;
    assert_int_equal(find_crossings(lines, found), 0);
    assert_false(is_reef(found, 0));
    for (int r = 0; r < RIBBONS; r++) free(lines[r].x);
    cipc_scene_destroy(scene);
}

/* ---- Does the limit tighten it? --------------------------------------------------------------------------------------------- */

/* Root mean square distance from their middle of the nodes in the core of both bights, m. Which these are, the start tells. */
static double core_radius(const cipc_model *m, const double *start, const double *position)
{
    double sum[3] = {0, 0, 0}, square = 0;
    int count = 0;
    for (int r = 0; r < RIBBONS; r++) {
        line l = middle_line(m, start, r);
        const cipc_body *b = &m->bodies[r];
        double length = 0, step[3];
        for (int i = 0; i + 1 < l.count; i++) {
            v3_sub(step, l.x[i + 1], l.x[i]);
            length += v3_norm(step);
        }
        for (int i = 0; i < b->node_count; i++) {
            double s = length * ((double)(i / (b->node_count / l.count)) / (l.count - 1) - 0.5);
            if (fabs(s) > core_length) continue;
            const double *x = position + 3 * (b->first_node + i);
            v3_add(sum, sum, x);
            square += v3_norm2(x);
            count++;
        }
        free(l.x);
    }
    return sqrt(square / count - v3_norm2(sum) / count / count);
}

typedef struct result {
    double radius, start_radius, stretch;
} result;

static result knot_of(const char *name, const char *const *overrides)
{
    figure_run run = figure_run_of(name, "reef-knot", overrides);
    const double *start = run.scene->state->position;
    const result r = {core_radius(run.scene->model, start, run.end), core_radius(run.scene->model, start, start), run.max_stretch};
    print_message("%s: core radius %.4f m (start %.4f m), largest stretch %.4f, smallest gap %.2e m\n", name, r.radius, r.start_radius, r.stretch, run.min_gap);
    figure_run_free(&run);
    return r;
}

static void test_the_limit_tightens_it(void **state)
{
    (void)state;
    const result with = knot_of("reef-knot", NULL);
    const result without = knot_of("reef-knot-no-limit", (const char *[]){"bodies.left.strain_limit=false", "bodies.right.strain_limit=false", NULL});
    assert_true(with.stretch < limit && without.stretch > limit); /* the limit was needed */
    claim_figure("C4 knot", "radius of the knot's core drawn without the limit over that at the start", without.radius / without.start_radius, "1", CLAIM_LESS, 0.5);
    claim_figure("C4 knot", "radius of the knot's core drawn with the limit of 1.134 over that without", with.radius / without.radius, "1", CLAIM_LESS, tighter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_it_is_a_reef_knot),
        cmocka_unit_test(test_the_limit_tightens_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
