/* The broad phase misses nothing (SPEC A.10): at instants all through the frames of crowds in collision, every pair of primitives nearer than eta(1), found by brute force, owns a certificate,
 * and every layer that a gap has reached is active. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"

/* ---- All pairs of a model, noted once ---- */

typedef struct pair { cipc_pair_kind kind; int nodes[4]; double offset; } pair;
enum { MOST_PAIRS = 20000 };
typedef struct all_pairs { const cipc_model *model; int count; pair list[MOST_PAIRS]; } all_pairs;

static void note(void *context, cipc_pair_kind kind, const int nodes[4], int first, int second)
{
    all_pairs *all = context;
    pair p = {.kind = kind};
    (void)first, (void)second;
    memcpy(p.nodes, nodes, sizeof p.nodes);
    p.offset = cipc_model_pair_offset(all->model, nodes[0], nodes[cipc_pair_first_nodes(kind)]);
    assert_true(all->count < MOST_PAIRS);
    all->list[all->count++] = p;
}

/* ---- One instant ---- */

typedef struct witness {
    asynchronous_scene *scene;
    all_pairs *all;
    double frame_begin;
    long instants, inside, near, layers;
} witness;

static const asynchronous_pair *owner(const cipc_asynchronous *a, const pair *p)
{
    const struct asynchronous_incidences *of = &a->pairs.of_node[p->nodes[0]];
    const asynchronous_pair *found = NULL;
    for (int i = 0; i < of->count; i++) {
        const asynchronous_pair *live = &a->pairs.pair[asynchronous_incidence_pair(of->list[i])];
        if (live->kind != p->kind || memcmp(live->nodes, p->nodes, sizeof p->nodes) != 0) continue;
        assert_null(found);
        found = live;
    }
    return found;
}

/* Is the pair farther than `reach` by a look at its coordinates alone? Most are. */
static bool clearly_apart(const pair *p, const double x[12], double reach)
{
    const int own = cipc_pair_first_nodes(p->kind), count = cipc_pair_nodes(p->kind);
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < count; i++) {
            lo[i >= own] = fmin(lo[i >= own], x[3 * i + k]);
            hi[i >= own] = fmax(hi[i >= own], x[3 * i + k]);
        }
        if (lo[0] - hi[1] > reach || lo[1] - hi[0] > reach) return true;
    }
    return false;
}

static void look_at_all(witness *w, const double *positions)
{
    const double eta1 = w->scene->options.thickness;
    for (int i = 0; i < w->all->count; i++) {
        const pair *p = &w->all->list[i];
        double x[12] = {0};
        for (int n = 0; n < cipc_pair_nodes(p->kind); n++) v3_copy(x + 3 * n, positions + 3 * p->nodes[n]);
        if (clearly_apart(p, x, eta1 + p->offset)) continue;
        const double gap = asynchronous_closest_points(p->kind, x).distance - p->offset;
        if (!(gap < eta1)) continue;
        const asynchronous_pair *live = owner(w->scene->integrator, p);
        assert_non_null(live);
        assert_true(live->layers >= cipc_layer_count(eta1, gap));
        w->near++;
        w->layers += live->layers;
    }
}

/* At the end of each window, which is an instant inside the frame, or its end. */
static cipc_status look(void *context, const cipc_paths *paths, cipc_error *error)
{
    witness *w = context;
    (void)error;
    look_at_all(w, paths->to);
    w->instants++;
    w->inside += paths->end > w->frame_begin && paths->end < w->frame_begin + 0.999 * w->scene->options.frame;
    return CIPC_OK;
}

static void run(const crowd_shape *shape, uint64_t seed, double restitution, int frames, long kicks, witness *w)
{
    static all_pairs all;
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    crowd_add(&s, shape, seed);
    s.options.restitution = restitution;
    crowd_build(&s, shape);
    all.model = s.sheet.model;
    all.count = 0;
    crowd_visit_pairs(s.sheet.model, note, &all);
    w->scene = &s;
    w->all = &all;
    cipc_asynchronous_set_monitor(s.integrator, look, w);
    assert_int_equal(asynchronous_windows_start(s.integrator, &s.error), CIPC_OK);
    s.integrator->break_capacity = kicks; /* of the memory that there now is: windows of so many kicks */
    for (int frame = 0; frame < frames; frame++) {
        w->frame_begin = s.sheet.state->time;
        asynchronous_steps(&s, 1);
    }
    asynchronous_scene_free(&s);
}

static void test_nothing_is_missed(void **state)
{
    (void)state;
    witness w = {.scene = NULL};
    for (uint64_t seed = 0; seed < 3; seed++) {
        crowd_shape shape = crowd_shape_default();
        shape.friction = 0.1 * (double)seed;
        shape.speed = seed == 2 ? 3 : 1;
        run(&shape, seed, 0.3 * (double)seed, 25, 293, &w);
    }
    assert_true(w.inside > 1000 && w.near > 10000 && w.layers > w.near);
}

/* Fast ones, which cross the whole scene in a frame: balls and lists have to follow inside it. */
static void test_fast_crowds(void **state)
{
    (void)state;
    witness w = {.scene = NULL};
    for (uint64_t seed = 10; seed < 50; seed++) {
        crowd_shape shape = crowd_shape_default();
        shape.kinds = CROWD_RODS | CROWD_PARTICLES;
        shape.speed = 30;
        run(&shape, seed, 1, 3, 3, &w);
    }
    assert_true(w.inside > 1000 && w.near > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_is_missed),
        cmocka_unit_test(test_fast_crowds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
