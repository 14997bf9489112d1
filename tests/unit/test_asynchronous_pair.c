/* Pairs of primitives: the separating slab keeps its promise (T-A7) for every kind of pair, however its nodes are kicked; travels with the pair (F8); lasts as long as SPEC A.6 says;
 * layers set on early enough to go on and are not re-phased; the lists of pairs and nodes hold; out of memory at every allocation. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"
#include "support/two_primitives.h"

static const double ETA1 = 0.1;

/* What positions, distances and times of these scenes (coordinates below 64 m) are rounded by, m. */
static const double ROUNDING = 1e-12;

static cipc_asynchronous_options options_of(double frame)
{
    cipc_asynchronous_options options = cipc_asynchronous_options_default();
    options.thickness = ETA1;
    options.stiffness = 1000;
    options.frame = frame;
    return options;
}

/* A random point of the nodes i, i + 1, ... of a primitive. */
static void draw_point(uint64_t *seed, const double *x, int count, double point[3])
{
    double w[3], sum = 0;
    for (int i = 0; i < count; i++) sum += w[i] = random_uniform(seed, 0, 1);
    for (int k = 0; k < 3; k++) point[k] = 0;
    for (int i = 0; i < count; i++) v3_axpy(point, w[i] / sum, x + 3 * i);
}

/* Two primitives of size one, a point of the first `apart` from a point of the second and thrown at it, with speeds of all nodes besides. */
static void draw(uint64_t *seed, const two_primitives *two, double apart, double speed, double x[12], double v[12])
{
    double direction[3], point[2][3];
    random_fill(seed, direction, 3, 1);
    v3_scale(direction, 1 / v3_norm(direction), direction);
    random_fill(seed, x, 12, 0.5);
    draw_point(seed, x, two->first, point[0]);
    draw_point(seed, x + 3 * two->first, two->count - two->first, point[1]);
    const double throw = speed * random_uniform(seed, 0.3, 1);
    for (int i = 0; i < 12; i++) {
        const int k = i % 3;
        if (i / 3 < two->first) x[i] += point[1][k] - point[0][k] + apart * direction[k];
        v[i] = (i / 3 < two->first ? -throw * direction[k] : 0) + random_uniform(seed, -0.05, 0.05) * speed;
    }
}

static double distance_at(const two_primitives *two, double t)
{
    double x[12];
    two_primitives_at(two, t, x);
    return sqrt(cipc_exact_distance2(two->kind, x, NULL));
}

static const asynchronous_pair *meet(two_primitives *two)
{
    const int number = two_primitives_meet(two);
    return &two->a->pairs.pair[number];
}

/* ---- T-A7 ---- */

/* Exactly, between two instants without a kick: the distance stays above what the slab vouches for. */
static void assert_kept(const two_primitives *two, double from, double to, double distance)
{
    cipc_stencil_path path = {.kind = two->kind, .to_end = true};
    two_primitives_at(two, from, path.x);
    two_primitives_at(two, to, path.p);
    assert_int_equal(cipc_exact_path_clear(&path, fmax(distance - ROUNDING, 0), 1), CIPC_YES);
}

typedef struct tally { int kept, refitted, expired, activations; } tally;

static double vouched_for(const two_primitives *two, int pair)
{
    const asynchronous_pair *p = &two->a->pairs.pair[pair];
    return cipc_layer_thickness(ETA1, p->layers + 1) + p->offset;
}

static void kick_someone(uint64_t *seed, two_primitives *two, int pair, double speed, tally *seen)
{
    cipc_asynchronous *a = two->a;
    const int node = two->nodes[random_below(seed, two->count)];
    const double before = a->pairs.slab[pair].since, strength = random_below(seed, 3) ? 1e-3 * speed : 0.2 * speed;
    double x[3], dv[3];
    asynchronous_position(&a->nodes[node], a->now, x);
    random_fill(seed, dv, 3, strength);
    asynchronous_kick(a, node, x, dv);
    asynchronous_pairs_check(a, node);
    a->pairs.slab[pair].since == before ? seen->kept++ : seen->refitted++;
}

/* Life of a pair from its making through kicks and failing slabs, until the gap is small or it has lived long enough. */
static void live(uint64_t *seed, two_primitives *two, double speed, tally *seen)
{
    cipc_asynchronous *a = two->a;
    const int pair = two_primitives_meet(two);
    for (int instant = 0; instant < 40 && a->pairs.pair[pair].layers < 60; instant++) {
        const asynchronous_slab *slab = &a->pairs.slab[pair];
        const double deadline = slab->deadline, eta = vouched_for(two, pair), from = a->now;
        const int layers = a->pairs.pair[pair].layers;
        const bool kick = random_below(seed, 3) > 0;
        assert_true(deadline > from && deadline <= from + a->options.frame);
        assert_true(asynchronous_queue_time(&a->queue, a->pairs.pair[pair].event) == deadline);
        assert_kept(two, from, deadline, eta);
        a->now = kick ? fmin(deadline, from + random_uniform(seed, 0, 1.2) * (deadline - from)) : deadline;
        if (a->now < deadline) kick_someone(seed, two, pair, speed, seen);
        else asynchronous_pair_certify(a, pair), seen->expired++;
        assert_int_equal(a->status, CIPC_OK);
        seen->activations += a->pairs.pair[pair].layers - layers;
    }
}

static void test_the_slab_keeps_its_promise(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        tally seen = {0};
        for (int offset = 0; offset < 2; offset++) {
            const cipc_asynchronous_options options = options_of(5);
            two_primitives two;
            two_primitives_init(&two, (cipc_pair_kind)kind, &options, 0.05 * offset, 0);
            for (int trial = 0; trial < 60; trial++) {
                const double speed = exp(random_uniform(&seed, -3, 4));
                double x[12], v[12];
                draw(&seed, &two, random_uniform(&seed, 0.2, 2), speed, x, v);
                if (sqrt(cipc_exact_distance2(two.kind, x, NULL)) < 0.6 * ETA1 + 0.05 * offset) continue;
                two_primitives_place(&two, x, v, random_uniform(&seed, 0, 10));
                live(&seed, &two, speed, &seen);
            }
            two_primitives_free(&two);
        }
        assert_true(seen.kept >= 100 && seen.refitted >= 100 && seen.expired >= 100 && seen.activations >= 100);
    }
}

/* ---- F8: the slab travels with the pair ---- */

/* When a slab about the closest points that moves at `drift` along n fails, by SPEC A.6. */
static double lifetime_of(const two_primitives *two, const double x[12], const double v[12], double drift)
{
    const asynchronous_closest closest = asynchronous_closest_points(two->kind, x);
    double middle = 0, least = INFINITY;
    for (int i = 0; i < two->count; i++) middle += 0.5 * fabs(closest.c[i]) * v3_dot(closest.n, x + 3 * i);
    for (int i = 0; i < two->count; i++) {
        const double side = i < two->first ? 1 : -1, room = side * (v3_dot(closest.n, x + 3 * i) - middle) - 0.5 * ETA1, speed = side * (drift - v3_dot(closest.n, v + 3 * i));
        if (speed > 0) least = fmin(least, room / speed);
    }
    return least;
}

static double drift_of(const two_primitives *two, const double x[12], const double v[12], double sign_of_second)
{
    const asynchronous_closest closest = asynchronous_closest_points(two->kind, x);
    double first = 0, second = 0;
    for (int i = 0; i < two->count; i++) *(i < two->first ? &first : &second) += fabs(closest.c[i]) * v3_dot(closest.n, v + 3 * i);
    return sign_of_second > 0 ? 0.5 * (first + second) : first - second;
}

static double fastest_along(const two_primitives *two, const double x[12], const double v[12])
{
    const asynchronous_closest closest = asynchronous_closest_points(two->kind, x);
    const double u = drift_of(two, x, v, 1);
    double fastest = 0;
    for (int i = 0; i < two->count; i++) fastest = fmax(fastest, fabs(v3_dot(closest.n, v + 3 * i) - u));
    return fastest;
}

static double lifetime(two_primitives *two, const double x[12], const double v[12])
{
    two_primitives_place(two, x, v, 0);
    const int pair = two_primitives_meet(two);
    assert_int_equal(two->a->pairs.pair[pair].layers, 0);
    return two->a->pairs.slab[pair].deadline;
}

/* A velocity common to all nodes changes nothing; it would, if the slab were at rest or travelled with the velocity of one point relative to the other. */
static void test_common_motion_changes_nothing(void **state)
{
    (void)state;
    uint64_t seed = 2;
    const cipc_asynchronous_options options = options_of(1e6);
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        two_primitives two;
        int at_rest = 0, relative = 0, trials = 0;
        two_primitives_init(&two, (cipc_pair_kind)kind, &options, 0, 0);
        while (trials < 300) {
            double x[12], v[12], moving[12], common[3];
            draw(&seed, &two, 2, 1, x, v);
            if (sqrt(cipc_exact_distance2(two.kind, x, NULL)) < 2 * ETA1) continue;
            random_fill(&seed, common, 3, 100);
            for (int i = 0; i < 12; i++) moving[i] = v[i] + common[i % 3];
            const double own = lifetime(&two, x, v), fast = lifetime(&two, x, moving), want = lifetime_of(&two, x, v, drift_of(&two, x, v, 1));
            if (!(own < 1e5)) continue;
            assert_true(fabs(own - want) <= 1e-9 * own);
            assert_true(fabs(own - fast) <= 1e-9 * own);
            at_rest += lifetime_of(&two, x, moving, 0) < 0.5 * lifetime_of(&two, x, v, 0);
            relative += lifetime_of(&two, x, moving, drift_of(&two, x, moving, -1)) < 0.5 * lifetime_of(&two, x, v, drift_of(&two, x, v, -1));
            trials++;
        }
        assert_true(at_rest > 150 && relative > 150); /* the wrong ones are told from the right one */
        two_primitives_free(&two);
    }
}

/* SPEC A.6: a lifetime of at least (d - eta)/(2 max |(v_i - u).n|); and of two particles head on, exactly until the layer is reached. */
static void test_lifetime(void **state)
{
    (void)state;
    uint64_t seed = 3;
    const cipc_asynchronous_options options = options_of(1e6);
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        two_primitives two;
        two_primitives_init(&two, (cipc_pair_kind)kind, &options, 0, 0);
        for (int trial = 0; trial < 300; trial++) {
            double x[12], v[12];
            draw(&seed, &two, 2, 1, x, v);
            const asynchronous_closest closest = asynchronous_closest_points(two.kind, x);
            if (closest.distance < 1.1 * ETA1) continue;
            assert_true(lifetime(&two, x, v) >= (closest.distance - ETA1) / (2 * fastest_along(&two, x, v)) * (1 - 1e-9));
        }
        two_primitives_free(&two);
    }
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_POINT, &options, 0, 0);
    const double x[12] = {0, 0, 0, 2, 0, 0}, v[12] = {3, 0, 0, 2, 0, 0};
    assert_true(fabs(lifetime(&two, x, v) - (2 - ETA1)) < 1e-9);
    two_primitives_free(&two);
}

/* At most a frame: what integrators keep beyond a frame would not survive its end. */
static void test_lifetime_is_at_most_a_frame(void **state)
{
    (void)state;
    const cipc_asynchronous_options options = options_of(0.25);
    const double x[12] = {0, 0, 0, 2, 0, 0}, v[12] = {0};
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_POINT, &options, 0, 0);
    assert_true(lifetime(&two, x, v) == 0.25);
    two_primitives_free(&two);
}

/* ---- Activation ---- */

/* At eta(l) + the spare a slab is made, at less the layer is activated: 1e-3 of the way to the next layer above it. */
static void test_layers_set_on_a_little_early(void **state)
{
    (void)state;
    const cipc_asynchronous_options options = options_of(1);
    const double v[12] = {0};
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_POINT, &options, 0.02, 0);
    for (int l = 1; l < 50; l++) {
        const double eta = cipc_layer_thickness(ETA1, l), spare = 1e-3 * (eta - cipc_layer_thickness(ETA1, l + 1));
        for (int above = 0; above < 2; above++) {
            const double x[12] = {0, 0, 0, 0.02 + eta + (above ? 1.01 : 0.99) * spare, 0, 0};
            two_primitives_place(&two, x, v, 0);
            assert_int_equal(meet(&two)->layers, above ? l - 1 : l);
        }
    }
    two_primitives_free(&two);
}

/* No endless sequence of ever shorter certificates just above a layer: what is not in its spare is certified for a time in which the fastest node could cross half of that. */
static void test_no_stall_above_a_layer(void **state)
{
    (void)state;
    uint64_t seed = 4;
    const cipc_asynchronous_options options = options_of(1e3);
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        two_primitives two;
        int close = 0;
        two_primitives_init(&two, (cipc_pair_kind)kind, &options, 0, 0);
        for (int trial = 0; trial < 200; trial++) {
            double x[12], v[12];
            draw(&seed, &two, 2, 1, x, v);
            if (sqrt(cipc_exact_distance2(two.kind, x, NULL)) < 2 * ETA1) continue;
            two_primitives_place(&two, x, v, random_uniform(&seed, 0, 10));
            const int pair = two_primitives_meet(&two);
            for (int instant = 0; instant < 200 && two.a->pairs.pair[pair].layers < 30; instant++) {
                const int next = two.a->pairs.pair[pair].layers + 1;
                const double eta = cipc_layer_thickness(ETA1, next), spare = 1e-3 * (eta - cipc_layer_thickness(ETA1, next + 1)), lifetime = two.a->pairs.slab[pair].deadline - two.a->now;
                two_primitives_at(&two, two.a->now, x);
                assert_true(lifetime >= 0.5 * spare / fastest_along(&two, x, v) * (1 - 1e-6));
                close += distance_at(&two, two.a->now) - eta < 2 * spare;
                two.a->now += lifetime;
                asynchronous_pair_certify(two.a, pair);
                assert_int_equal(two.a->status, CIPC_OK);
            }
        }
        assert_true(close >= 20);
        two_primitives_free(&two);
    }
}

/* A layer's clock has been ticking since time 0, whenever the layer is activated, and the ticks come by layer, then by pair. */
static void test_clocks_are_not_phased_anew(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const cipc_asynchronous_options options = options_of(1);
    const double v[12] = {0};
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_TRIANGLE, &options, 0, 0);
    for (int trial = 0; trial < 200; trial++) {
        const double t = random_uniform(&seed, 0, 100), x[12] = {0.1, 0.1, random_uniform(&seed, 0.45, 0.9) * ETA1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
        double mass[4];
        for (int i = 0; i < 4; i++) mass[i] = exp(random_uniform(&seed, -5, 5));
        two_primitives_weigh(&two, mass);
        two_primitives_place(&two, x, v, t);
        const asynchronous_pair *pair = meet(&two);
        assert_true(pair->layers > 0 && pair->layers >= cipc_layer_count(ETA1, x[2]));
        for (int l = 1; l <= pair->layers; l++) {
            const asynchronous_layer *layer = &pair->layer[l - 1];
            const asynchronous_event *event = &two.a->queue.events[layer->event];
            const double lightest = fmin(fmin(mass[0], mass[1]), fmin(mass[2], mass[3])), h = cipc_layer_step(1000, lightest, options.layer_factor, l);
            const double tick = asynchronous_queue_time(&two.a->queue, layer->event);
            assert_true(tick > t && tick <= t + h * (1 + 1e-9));
            assert_true(fabs(tick / h - (double)layer->k) < 1e-6 * fmin(1, 1e-9 * tick / h + 1e-3));
            assert_int_equal(event->rank, ASYNCHRONOUS_RANK_PENALTY + l);
            assert_true(event->order == asynchronous_pair_order(CIPC_POINT_TRIANGLE, 0, 1));
        }
    }
    two_primitives_free(&two);
}

/* What is prescribed now may be released: its mass counts from the beginning. What is fixed for good does not count. */
static void test_lightest_node(void **state)
{
    (void)state;
    const cipc_asynchronous_options options = options_of(1);
    const double v[12] = {0}, x[12] = {0.1, 0.1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, mass[4] = {5, 0.25, 3, 4}, held[4] = {5, 0, 3, 4};
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_TRIANGLE, &options, 0, 0);
    two_primitives_weigh(&two, mass);
    two_primitives_place(&two, x, v, 0);
    assert_true(meet(&two)->mass == 0.25);
    two_primitives_weigh(&two, held);
    two_primitives_place(&two, x, v, 0);
    assert_true(meet(&two)->mass == 0.25);
    two.scene.sheet.model->bodies[1].fixed = true;
    two_primitives_place(&two, x, v, 0);
    assert_true(meet(&two)->mass == 5);
    two_primitives_free(&two);
}

/* ---- A gap that no layer can hold open ---- */

static void test_no_gap_is_no_progress(void **state)
{
    (void)state;
    const cipc_asynchronous_options options = options_of(1);
    const double v[12] = {0}, touching[12] = {0, 0, 0, 0.02, 0, 0}, far_away[12] = {0, 0, 0, 0.02 + 1e-4 * ETA1, 0, 0};
    two_primitives two;
    two_primitives_init(&two, CIPC_POINT_POINT, &options, 0.02, 0);
    for (int i = 0; i < 2; i++) {
        two.a->status = CIPC_OK;
        two_primitives_place(&two, i ? far_away : touching, v, 0);
        asynchronous_pair_create(two.a, CIPC_POINT_POINT, two.nodes, 0);
        assert_int_equal(two.a->status, CIPC_E_NO_PROGRESS);
        assert_non_null(strstr(two.a->error.what, "layer 4095"));
    }
    /* Steps that time no longer resolves: late in a long simulation even a few layers are too many. */
    const double near[12] = {0, 0, 0, 0.02 + 0.5 * ETA1, 0, 0};
    two.a->status = CIPC_OK;
    two_primitives_place(&two, near, v, 1e14);
    asynchronous_pair_create(two.a, CIPC_POINT_POINT, two.nodes, 0);
    assert_int_equal(two.a->status, CIPC_E_NO_PROGRESS);
    two_primitives_free(&two);
}

/* ---- Lists ---- */

static void assert_lists_hold(const cipc_asynchronous *a)
{
    const asynchronous_pairs *pairs = &a->pairs;
    int incidences = 0, wanted = 0;
    for (int i = 0; i < pairs->live_count; i++) {
        const asynchronous_pair *pair = &pairs->pair[pairs->live[i]];
        assert_int_equal(pair->index_in_live, i);
        for (int place = 0; place < pair->node_count; place++) {
            const int incidence = pairs->of_node[pair->nodes[place]].list[pair->chain[place]];
            assert_int_equal(asynchronous_incidence_pair(incidence), pairs->live[i]);
            assert_int_equal(asynchronous_incidence_place(incidence), place);
            assert_int_equal(asynchronous_incidence_second(incidence), place >= cipc_pair_first_nodes(pair->kind));
        }
        wanted += pair->node_count;
    }
    for (int i = 0; i < a->model->node_count; i++) incidences += pairs->of_node[i].count;
    assert_int_equal(incidences, wanted);
}

/* Particles in a row, every second pair of which is made and destroyed at random. */
static void row_of_particles(asynchronous_scene *s, int count)
{
    double position[3 * 40] = {0};
    const double velocity[3] = {0};
    assert_true(count <= 40);
    for (int i = 0; i < count; i++) position[3 * i] = 0.07 * i;
    asynchronous_scene_init(s);
    s->options = options_of(1);
    asynchronous_add_particles(s, "row", count, position, velocity, 1);
    asynchronous_scene_build(s);
    for (int i = 0; i < count; i++) v3_copy(s->integrator->nodes[i].q, position + 3 * i);
}

static void test_lists(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    uint64_t seed = 6;
    asynchronous_scene s;
    row_of_particles(&s, COUNT);
    cipc_asynchronous *a = s.integrator;
    int pair[COUNT][COUNT], most = 0;
    memset(pair, -1, sizeof pair);
    for (int step = 0; step < 6000; step++) {
        const int i = random_below(&seed, COUNT), j = random_below(&seed, COUNT), nodes[2] = {i < j ? i : j, i < j ? j : i};
        if (i == j) continue;
        int *number = &pair[nodes[0]][nodes[1]];
        if (*number >= 0) {
            asynchronous_pair_destroy(a, *number);
            *number = -1;
        } else {
            *number = asynchronous_pair_create(a, CIPC_POINT_POINT, nodes, asynchronous_pair_order(CIPC_POINT_POINT, nodes[0], nodes[1]));
            assert_int_equal(a->pairs.pair[*number].layers > 0, nodes[1] - nodes[0] == 1); /* neighbours are in reach of each other */
        }
        most = a->pairs.live_count > most ? a->pairs.live_count : most;
        if (step % 100 == 0) assert_lists_hold(a);
    }
    int in_contact = 0;
    for (int i = 0; i + 1 < COUNT; i++) in_contact += pair[i][i + 1] >= 0;
    assert_int_equal(a->pairs.in_contact, in_contact);
    assert_true(most > 300);
    while (a->pairs.live_count > 0) asynchronous_pair_destroy(a, a->pairs.live[a->pairs.live_count / 2]);
    assert_lists_hold(a);
    assert_int_equal(a->pairs.in_contact, 0);
    assert_int_equal(a->report.activations, a->report.deactivations);
    asynchronous_scene_free(&s);
}

/* A pair is made or it is not: what there was stays whole, and with memory again all can be destroyed. */
static void test_out_of_memory(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    long n = 1;
    for (;; n++) {
        asynchronous_scene s;
        row_of_particles(&s, COUNT);
        cipc_asynchronous *a = s.integrator;
        int refused = 0;
        fail_allocation(n);
        for (int i = 0; i < COUNT; i++)
            for (int j = i + 1; j < COUNT && j < i + 4; j++) {
                const int nodes[2] = {i, j};
                if (asynchronous_pair_create(a, CIPC_POINT_POINT, nodes, asynchronous_pair_order(CIPC_POINT_POINT, i, j)) < 0) refused++;
                if (a->status) assert_int_equal(a->status, CIPC_E_OUT_OF_MEMORY);
                a->status = CIPC_OK;
            }
        const bool failed = allocation_failed();
        fail_allocation(0);
        assert_true(refused <= failed); /* without room for a layer the pair itself is there */
        assert_int_equal(a->pairs.live_count, 3 * COUNT - 6 - refused);
        assert_lists_hold(a);
        while (a->pairs.live_count > 0) asynchronous_pair_destroy(a, a->pairs.live[0]);
        assert_lists_hold(a);
        asynchronous_scene_free(&s);
        if (!failed) break;
    }
    assert_true(n > 40);
}

/* ---- The reference without culling ---- */

static void test_always_layers(void **state)
{
    (void)state;
    cipc_asynchronous_options options = options_of(1);
    const double v[12] = {0}, x[12] = {0, 0, 0, 9, 0, 0};
    two_primitives two;
    options.always_layers = 7;
    two_primitives_init(&two, CIPC_POINT_POINT, &options, 0, 0);
    two_primitives_place(&two, x, v, 0);
    const int pair = two_primitives_meet(&two);
    assert_int_equal(two.a->pairs.pair[pair].layers, 7);
    assert_true(two.a->queue.events[two.a->pairs.pair[pair].event].place < 0); /* no certificate */
    two_primitives_free(&two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_slab_keeps_its_promise),
        cmocka_unit_test(test_common_motion_changes_nothing),
        cmocka_unit_test(test_lifetime),
        cmocka_unit_test(test_lifetime_is_at_most_a_frame),
        cmocka_unit_test(test_layers_set_on_a_little_early),
        cmocka_unit_test(test_no_stall_above_a_layer),
        cmocka_unit_test(test_clocks_are_not_phased_anew),
        cmocka_unit_test(test_lightest_node),
        cmocka_unit_test(test_no_gap_is_no_progress),
        cmocka_unit_test(test_lists),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_always_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
