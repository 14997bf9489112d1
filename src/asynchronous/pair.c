/* A pair of primitives: which of its layers are active, and the certificate that the next one is out of reach: a separating slab that travels with the pair (SPEC A.6, A.7, F8;
 * docs/theory/asynchronous.md, section 5). */
#include "asynchronous/integrator.h"

#include <string.h>

/* A layer is activated this fraction of the way to the next one early, so that no pair stays just short of it, certified for ever shorter times (SPEC A.6). */
static const double early_fraction = 1e-3;
/* And at least this multiple of the largest coordinate: 64 units in the last place, well above what positions and distances are rounded by. */
static const double early_rounding = 0x1p-47;

static double thickness_of(const cipc_asynchronous *a, int layer) { return a->options.thickness * a->eta[layer]; }

static double early(const cipc_asynchronous *a, int layer)
{
    return fmax(early_fraction * (thickness_of(a, layer) - thickness_of(a, layer + 1)), early_rounding * a->scale);
}

/* ---- Lists of the pairs in use, and of those of a node ------------------------------------------------------------------------------------ */

static bool grow(asynchronous_pairs *p)
{
    const int capacity = p->capacity > 0 ? 2 * p->capacity : 64;
    asynchronous_pair *pair = cipc_realloc(p->pair, (size_t)capacity, sizeof *pair);
    if (pair) p->pair = pair;
    asynchronous_slab *slab = cipc_realloc(p->slab, (size_t)capacity, sizeof *slab);
    if (slab) p->slab = slab;
    int *unused = cipc_realloc(p->unused, (size_t)capacity, sizeof *unused);
    if (unused) p->unused = unused;
    int *live = cipc_realloc(p->live, (size_t)capacity, sizeof *live);
    if (live) p->live = live;
    if (!pair || !slab || !unused || !live) return false;
    p->capacity = capacity;
    return true;
}

static bool add_incidence(asynchronous_pairs *pairs, int number, int place)
{
    asynchronous_pair *pair = &pairs->pair[number];
    struct asynchronous_incidences *of = &pairs->of_node[pair->nodes[place]];
    if (of->count == of->capacity) {
        const int capacity = of->capacity > 0 ? 2 * of->capacity : 8;
        int *grown = cipc_realloc(of->list, (size_t)capacity, sizeof *grown);
        if (!grown) return false;
        of->list = grown;
        of->capacity = capacity;
    }
    pair->chain[place] = of->count;
    of->list[of->count++] = 8 * number + 2 * place + (place >= pair->first_count ? 1 : 0);
    return true;
}

static void remove_incidence(asynchronous_pairs *pairs, int number, int place)
{
    asynchronous_pair *pair = &pairs->pair[number];
    struct asynchronous_incidences *of = &pairs->of_node[pair->nodes[place]];
    const int at = pair->chain[place], last = of->list[--of->count];
    of->list[at] = last;
    pairs->pair[asynchronous_incidence_pair(last)].chain[asynchronous_incidence_place(last)] = at;
}

static int take_number(asynchronous_pairs *p)
{
    if (p->unused_count > 0) return p->unused[--p->unused_count];
    if (p->count == p->capacity && !grow(p)) return -1;
    return p->count++;
}

static double lightest(const cipc_asynchronous *a, const int *nodes, int count)
{
    double mass = INFINITY;
    for (int i = 0; i < count; i++)
        if (a->nodes[nodes[i]].inverse_mass > 0) mass = fmin(mass, 1 / a->nodes[nodes[i]].inverse_mass);
    return mass;
}

/* What is prescribed now may be released later: its own mass then counts, so it counts from the beginning. */
static double lightest_ever(const cipc_asynchronous *a, const int *nodes, int count)
{
    double mass = INFINITY;
    for (int i = 0; i < count; i++)
        if (!a->model->bodies[a->model->node_body[nodes[i]]].fixed) mass = fmin(mass, a->model->mass[nodes[i]]);
    return mass < INFINITY ? mass : lightest(a, nodes, count);
}

static void describe(const cipc_asynchronous *a, asynchronous_pair *pair, cipc_pair_kind kind, const int *nodes)
{
    const cipc_model *m = a->model;
    const int count = cipc_pair_nodes(kind), second = nodes[cipc_pair_first_nodes(kind)];
    pair->kind = kind;
    pair->node_count = count;
    pair->first_count = cipc_pair_first_nodes(kind);
    for (int i = 0; i < 4; i++) pair->nodes[i] = i < count ? nodes[i] : -1;
    pair->offset = cipc_model_pair_offset(m, nodes[0], second);
    pair->friction = m->pair_friction[m->node_body[nodes[0]] * m->body_count + m->node_body[second]];
    pair->mass = lightest_ever(a, nodes, count);
    pair->first_step = cipc_layer_step(a->options.stiffness, pair->mass, a->options.layer_factor, 1);
    pair->layers = 0;
}

/* Layers that the reference without culling has at all times. */
static void activate_always(cipc_asynchronous *a, int number)
{
    for (int l = 0; l < a->options.always_layers && !a->status; l++) asynchronous_pair_activate(a, number);
}

/* Take a pair out of the lists, and of those of the first `places` of its nodes; its number is free again. */
static void let_go(cipc_asynchronous *a, int number, int places)
{
    asynchronous_pairs *pairs = &a->pairs;
    const asynchronous_pair *pair = &pairs->pair[number];
    if (pair->event >= 0) asynchronous_queue_drop(&a->queue, pair->event);
    for (int i = 0; i < places; i++) remove_incidence(pairs, number, i);
    const int last = pairs->live[--pairs->live_count];
    pairs->live[pair->index_in_live] = last;
    pairs->pair[last].index_in_live = pair->index_in_live;
    pairs->unused[pairs->unused_count++] = number;
}

static int fail_to_create(cipc_asynchronous *a)
{
    asynchronous_fail(a, CIPC_E_OUT_OF_MEMORY, "no memory for another pair near contact");
    return -1;
}

int asynchronous_pair_create(cipc_asynchronous *a, cipc_pair_kind kind, const int *nodes, uint64_t order)
{
    asynchronous_pairs *pairs = &a->pairs;
    const int number = take_number(pairs);
    if (number < 0) return fail_to_create(a);
    asynchronous_pair *pair = &pairs->pair[number];
    *pair = (asynchronous_pair){0};
    describe(a, pair, kind, nodes);
    pair->event = asynchronous_queue_add(&a->queue, ASYNCHRONOUS_RANK_SLAB, order, number);
    pair->index_in_live = pairs->live_count;
    pairs->live[pairs->live_count++] = number;
    int places = 0;
    while (pair->event >= 0 && places < pair->node_count && add_incidence(pairs, number, places)) places++;
    if (places < pair->node_count) {
        let_go(a, number, places);
        return fail_to_create(a);
    }
    if (a->options.always_layers > 0) activate_always(a, number);
    else asynchronous_pair_certify(a, number);
    return number;
}

void asynchronous_pair_destroy(cipc_asynchronous *a, int number)
{
    asynchronous_pair *pair = &a->pairs.pair[number];
    while (pair->layers > 0) asynchronous_pair_deactivate(a, number);
    cipc_free(pair->layer);
    let_go(a, number, pair->node_count);
}

void asynchronous_pairs_free(cipc_asynchronous *a)
{
    asynchronous_pairs *pairs = &a->pairs;
    for (int i = 0; i < pairs->live_count; i++) cipc_free(pairs->pair[pairs->live[i]].layer);
    for (int i = 0; pairs->of_node && i < a->model->node_count; i++) cipc_free(pairs->of_node[i].list);
    void *blocks[] = {pairs->pair, pairs->slab, pairs->unused, pairs->live, pairs->of_node};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}

/* ---- Layers ------------------------------------------------------------------------------------------------------------------------------- */

static double layer_step(const cipc_asynchronous *a, const asynchronous_pair *pair, int layer) { return pair->first_step * a->layer_rate[layer]; }

cipc_contact_place asynchronous_pair_place(const cipc_asynchronous *a, int number)
{
    const asynchronous_pair *pair = &a->pairs.pair[number];
    double x[12];
    asynchronous_gather(a, pair->nodes, cipc_pair_nodes(pair->kind), x);
    cipc_contact_place place = {.layers = pair->layers, .kind = pair->kind, .step = layer_step(a, pair, pair->layers > 0 ? pair->layers : 1)};
    memcpy(place.nodes, pair->nodes, sizeof place.nodes);
    place.gap = asynchronous_closest_points(pair->kind, x).distance - pair->offset;
    return place;
}

/* Room for the next layer, doubled when full. */
static bool make_room(asynchronous_pair *pair)
{
    if (pair->layers < pair->layer_capacity) return true;
    const int capacity = pair->layer_capacity > 0 ? 2 * pair->layer_capacity : 4;
    asynchronous_layer *grown = cipc_realloc(pair->layer, (size_t)capacity, sizeof *grown);
    if (!grown) return false;
    pair->layer = grown;
    pair->layer_capacity = capacity;
    return true;
}

static void note_depth(cipc_asynchronous *a, int number)
{
    const asynchronous_pair *pair = &a->pairs.pair[number];
    if (pair->layers == 1 && ++a->pairs.in_contact > a->report.max_contacts) a->report.max_contacts = a->pairs.in_contact;
    if (pair->layers <= a->report.layers) return;
    a->report.layers = pair->layers;
    a->report.deepest = asynchronous_pair_place(a, number);
}

/* The next layer's clock has been ticking all along; from now on its ticks count. */
bool asynchronous_pair_activate(cipc_asynchronous *a, int number)
{
    asynchronous_pair *pair = &a->pairs.pair[number];
    const int l = pair->layers + 1;
    const double h = layer_step(a, pair, l);
    if (l >= ASYNCHRONOUS_MOST_LAYERS || h < 4 * 0x1p-52 * fabs(a->now)) {
        asynchronous_fail(a, CIPC_E_NO_PROGRESS, "layer %d with steps of %.3g s is needed: time no longer resolves it", l, h);
        return false;
    }
    const asynchronous_event slab = a->queue.events[pair->event];
    const int event = make_room(pair) ? asynchronous_queue_add(&a->queue, ASYNCHRONOUS_RANK_PENALTY + (uint32_t)l, slab.order, number) : -1;
    if (event < 0) {
        asynchronous_fail(a, CIPC_E_OUT_OF_MEMORY, "no memory for another layer");
        return false;
    }
    asynchronous_layer *layer = &pair->layer[pair->layers++];
    layer->event = event;
    layer->k = asynchronous_first_tick(a->options.mirror, h, a->now);
    asynchronous_queue_schedule(&a->queue, event, asynchronous_tick_time(a->options.mirror, h, layer->k));
    a->report.activations++;
    note_depth(a, number);
    return true;
}

void asynchronous_pair_deactivate(cipc_asynchronous *a, int number)
{
    asynchronous_pair *pair = &a->pairs.pair[number];
    asynchronous_queue_drop(&a->queue, pair->layer[--pair->layers].event);
    if (pair->layers == 0) a->pairs.in_contact--;
    a->report.deactivations++;
}

/* ---- The slab ----------------------------------------------------------------------------------------------------------------------------- */

/* How far inside its half space a node is at time t, less half the slab. The first primitive is on the side of +n. */
static double clearance(const asynchronous_slab *slab, const asynchronous_node *node, bool second, double t)
{
    const double *n = slab->normal, dt = t - node->t;
    const double along = n[0] * (node->q[0] + dt * node->v[0]) + n[1] * (node->q[1] + dt * node->v[1]) + n[2] * (node->q[2] + dt * node->v[2]);
    const double above = along - slab->along - slab->drift * (t - slab->since);
    return (second ? -above : above) - slab->half;
}

/* How fast a node nears the slab. */
static double approach(const asynchronous_slab *slab, const asynchronous_node *node, bool second)
{
    const double along = v3_dot(slab->normal, node->v);
    return second ? along - slab->drift : slab->drift - along;
}

/* When the first node enters the slab, at most a frame from now; now, if it has no room. */
static double failure_time(const cipc_asynchronous *a, const asynchronous_pair *pair, const asynchronous_slab *slab)
{
    double least = a->options.frame;
    for (int i = 0; i < pair->node_count; i++) {
        const asynchronous_node *node = &a->nodes[pair->nodes[i]];
        const bool second = i >= pair->first_count;
        const double speed = approach(slab, node, second), room = clearance(slab, node, second, a->now);
        if (!(room >= 0)) return a->now;
        if (speed > 0 && room < speed * least) least = room / speed;
    }
    return a->now + least;
}

/* Midway between the closest points, travelling with their mean velocity (F8), as thick as the layer and what positions are rounded by. */
static void fit_slab(const cipc_asynchronous *a, const asynchronous_pair *pair, asynchronous_slab *slab, const asynchronous_closest *closest, const double *x)
{
    double middle = 0, drift = 0;
    for (int i = 0; i < pair->node_count; i++) { /* (a + b)/2 and (va + vb)/2 along n: the weights of b are negative */
        middle += 0.5 * fabs(closest->c[i]) * v3_dot(closest->n, x + 3 * i);
        drift += 0.5 * fabs(closest->c[i]) * v3_dot(closest->n, a->nodes[pair->nodes[i]].v);
    }
    v3_copy(slab->normal, closest->n);
    slab->along = middle;
    slab->drift = drift;
    slab->since = a->now;
    slab->half = 0.5 * (pair->offset + thickness_of(a, pair->layers + 1)) + 0.25 * early_rounding * a->scale;
    slab->deadline = failure_time(a, pair, slab);
}

void asynchronous_pair_certify(cipc_asynchronous *a, int number)
{
    asynchronous_pair *pair = &a->pairs.pair[number];
    asynchronous_slab *slab = &a->pairs.slab[number];
    double x[12];
    asynchronous_gather(a, pair->nodes, pair->node_count, x);
    const asynchronous_closest closest = asynchronous_closest_points(pair->kind, x);
    const double gap = closest.distance - pair->offset;
    bool certified = false;
    while (!certified && !a->status) {
        const int next = pair->layers + 1;
        if (gap > thickness_of(a, next) + early(a, next)) {
            fit_slab(a, pair, slab, &closest, x);
            certified = slab->deadline > a->now;
        }
        if (!certified) asynchronous_pair_activate(a, number); /* perhaps early: always right, only wasteful */
    }
    if (!a->status) asynchronous_queue_schedule(&a->queue, pair->event, slab->deadline);
}

/* The other nodes of a pair go on as they did, so only this one is asked. It is outside the slab now, and straight paths that are outside at the deadline too are so all the way. */
void asynchronous_pairs_check(cipc_asynchronous *a, int node)
{
    const struct asynchronous_incidences *of = &a->pairs.of_node[node];
    const asynchronous_node *n = &a->nodes[node];
    for (int k = 0; k < of->count && !a->status; k++) {
        const int incidence = of->list[k], number = asynchronous_incidence_pair(incidence);
        const asynchronous_slab *slab = &a->pairs.slab[number];
        if (!(clearance(slab, n, asynchronous_incidence_second(incidence), slab->deadline) >= 0)) asynchronous_pair_certify(a, number);
    }
}
