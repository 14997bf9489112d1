/* The separation list (Weller and Zachmann 2006; SPEC A.10): pairs of tree nodes whose k-DOPs are disjoint, and pairs of leaves whose are not, which together cover every pair of
 * elements. When a k-DOP changes only the entries that it is in are looked at; what no longer is disjoint is taken apart. When it has become twice as long as it was when fresh it is
 * stale and made afresh, which also lets go of what has moved apart. */
#include "asynchronous/integrator.h"

enum { LIST_GROWTH = 2, LIST_SPARE = 256 };

/* ---- Entries -------------------------------------------------------------------------------------------------------------------------------- */

static int take_entry(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    if (b->unused_entry >= 0) {
        const int e = b->unused_entry;
        b->unused_entry = b->entry[e].overlap;
        return e;
    }
    if (b->entry_count == b->entry_capacity) {
        const int capacity = b->entry_capacity > 0 ? 2 * b->entry_capacity : 1024;
        asynchronous_separation *grown = cipc_realloc(b->entry, (size_t)capacity, sizeof *grown);
        if (!grown) return -1;
        b->entry = grown;
        b->entry_capacity = capacity;
    }
    return b->entry_count++;
}

static void link_entry(asynchronous_broad *b, int e)
{
    for (int side = 0; side < 2; side++) {
        asynchronous_tree_node *node = &b->tree[b->entry[e].node[side]];
        const int link = 2 * e + side;
        b->entry[e].previous[side] = -1;
        b->entry[e].next[side] = node->first;
        if (node->first >= 0) b->entry[node->first / 2].previous[node->first % 2] = link;
        node->first = link;
    }
}

static void unlink_entry(asynchronous_broad *b, int e)
{
    for (int side = 0; side < 2; side++) {
        const int previous = b->entry[e].previous[side], next = b->entry[e].next[side];
        if (previous >= 0) b->entry[previous / 2].next[previous % 2] = next;
        else b->tree[b->entry[e].node[side]].first = next;
        if (next >= 0) b->entry[next / 2].previous[next % 2] = previous;
    }
    b->entry[e].overlap = b->unused_entry;
    b->unused_entry = e;
    b->live_entries--;
}

/* How far both sides have travelled. A pair of leaves is left alone until that has used up what they were apart. */
static double travel_of(const asynchronous_broad *b, const asynchronous_separation *e) { return b->travel[e->node[0]] + b->travel[e->node[1]]; }

/* ---- Overlapping leaves ----------------------------------------------------------------------------------------------------------------------- */

static int take_overlap(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    if (b->unused_overlap >= 0) {
        const int o = b->unused_overlap;
        b->unused_overlap = b->overlap[o].pair[0];
        return o;
    }
    if (b->overlap_count == b->overlap_capacity) {
        const int capacity = b->overlap_capacity > 0 ? 2 * b->overlap_capacity : 256;
        asynchronous_overlap *grown = cipc_realloc(b->overlap, (size_t)capacity, sizeof *grown);
        if (!grown) return -1;
        b->overlap = grown;
        b->overlap_capacity = capacity;
    }
    return b->overlap_count++;
}

static void drop_overlap(cipc_asynchronous *a, int number)
{
    asynchronous_overlap *o = &a->broad.overlap[number];
    for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++)
        if (o->pair[i] >= 0) asynchronous_pair_destroy(a, o->pair[i]);
    o->pair[0] = a->broad.unused_overlap;
    a->broad.unused_overlap = number;
}

static uint16_t combinations_that_meet(const cipc_asynchronous *a, const asynchronous_leaf *p, const asynchronous_leaf *q)
{
    unsigned meets = 0;
    asynchronous_combination c;
    for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++)
        if (asynchronous_combination_of(a, p, q, i, &c)) meets |= 1u << i;
    return (uint16_t)meets;
}

static double largest_radius(const cipc_asynchronous *a, const int *nodes, int count)
{
    double r = 0;
    for (int i = 0; i < count; i++) r = fmax(r, a->balls[nodes[i]].radius);
    return r;
}

/* How far two primitives are from contact as long as their nodes stay in their balls: at most 0 if contact is possible. `room`: the sum of the largest radii. */
static double clearance(const cipc_asynchronous *a, const asynchronous_combination *c, double *room)
{
    static const double spare = 1e-6; /* of eta(1): distances are rounded */
    const int count = cipc_pair_nodes(c->kind), first = cipc_pair_first_nodes(c->kind);
    double x[12];
    for (int i = 0; i < count; i++) v3_copy(x + 3 * i, a->balls[c->nodes[i]].center);
    *room = largest_radius(a, c->nodes, first) + largest_radius(a, c->nodes + first, count - first);
    const double reach = a->options.thickness * (1 + spare) + cipc_model_pair_offset(a->model, c->nodes[0], c->nodes[first]);
    return asynchronous_closest_points(c->kind, x).distance - *room - reach;
}

/* The pairs of two overlapping leaves that may come into contact while the balls stay where they are own certificates, and no others. */
static void look_at_overlap(cipc_asynchronous *a, int entry)
{
    asynchronous_separation *e = &a->broad.entry[entry];
    const asynchronous_leaf *p = &a->broad.leaves[a->broad.tree[e->node[0]].leaf], *q = &a->broad.leaves[a->broad.tree[e->node[1]].leaf];
    asynchronous_overlap *o = &a->broad.overlap[e->overlap];
    const double travel = travel_of(&a->broad, e);
    e->bound = INFINITY;
    for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS && !a->status; i++) {
        asynchronous_combination c;
        double room;
        if (!(o->meets >> i & 1u)) continue;
        asynchronous_combination_of(a, p, q, i, &c);
        const double clear = clearance(a, &c, &room);
        if (clear > 0 && o->pair[i] >= 0) {
            asynchronous_pair_destroy(a, o->pair[i]);
            o->pair[i] = -1;
        }
        if (!(clear > 0) && o->pair[i] < 0) o->pair[i] = asynchronous_pair_create(a, c.kind, c.nodes, c.order);
        e->bound = fmin(e->bound, travel + (clear > 0 ? clear : fmax(room, a->options.thickness)));
    }
}

/* Entry e is one of overlapping leaves from now on. */
static void begin_overlap(cipc_asynchronous *a, int e, uint16_t meets)
{
    const int number = take_overlap(a);
    if (number < 0) {
        asynchronous_fail(a, CIPC_E_OUT_OF_MEMORY, "no memory for another pair of elements near contact");
        return;
    }
    asynchronous_overlap *o = &a->broad.overlap[number];
    o->meets = meets;
    for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++) o->pair[i] = -1;
    a->broad.entry[e].axis = -1;
    a->broad.entry[e].overlap = number;
    look_at_overlap(a, e);
}

/* ---- The list ----------------------------------------------------------------------------------------------------------------------------------- */

static const asynchronous_leaf *leaf_of(const asynchronous_broad *b, int node) { return b->tree[node].leaf >= 0 ? &b->leaves[b->tree[node].leaf] : NULL; }

static double extent(const asynchronous_kdop *dop)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += dop->along[k].hi - dop->along[k].lo;
    return sum;
}

static void add_entry(cipc_asynchronous *a, int p, int q, int axis, uint16_t meets)
{
    const int e = take_entry(a);
    if (e < 0) {
        asynchronous_fail(a, CIPC_E_OUT_OF_MEMORY, "no memory for the separation list");
        return;
    }
    a->broad.entry[e] = (asynchronous_separation){.node = {p, q}, .axis = axis, .overlap = -1, .bound = -INFINITY};
    a->broad.live_entries++;
    link_entry(&a->broad, e);
    if (axis < 0) begin_overlap(a, e, meets);
}

/* Cover the pairs of elements below p and q. */
static void cover(cipc_asynchronous *a, int p, int q)
{
    asynchronous_broad *b = &a->broad;
    const asynchronous_leaf *leaf_p = leaf_of(b, p), *leaf_q = leaf_of(b, q);
    if (a->status) return;
    const int axis = asynchronous_kdop_axis(&b->tree[p].dop, &b->tree[q].dop);
    if (leaf_p && leaf_q) {
        const uint16_t meets = combinations_that_meet(a, leaf_p, leaf_q);
        if (meets) add_entry(a, p, q, axis, meets);
    } else if (axis >= 0) {
        add_entry(a, p, q, axis, 0);
    } else if (!leaf_p && (leaf_q || extent(&b->tree[p].dop) >= extent(&b->tree[q].dop))) {
        for (int i = 0; i < 2; i++) cover(a, b->tree[p].child[i], q);
    } else {
        for (int i = 0; i < 2; i++) cover(a, p, b->tree[q].child[i]);
    }
}

static void cover_inside(cipc_asynchronous *a, int node)
{
    const asynchronous_tree_node *n = &a->broad.tree[node];
    if (n->leaf >= 0) return;
    const int first = n->child[0], second = n->child[1];
    cover_inside(a, first);
    cover_inside(a, second);
    cover(a, first, second);
}

void asynchronous_separation_start(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    while (a->pairs.live_count > 0) asynchronous_pair_destroy(a, a->pairs.live[a->pairs.live_count - 1]);
    b->entry_count = b->live_entries = b->overlap_count = 0;
    b->unused_entry = b->unused_overlap = -1;
    for (int i = 0; i < b->tree_count; i++) b->tree[i].first = -1;
    asynchronous_tree_fit(a);
    if (b->tree_count > 0) cover_inside(a, 0);
    b->fresh_entries = b->live_entries;
    b->stale = false;
}

/* ---- Changes -------------------------------------------------------------------------------------------------------------------------------------- */

static bool is_apart(const asynchronous_kdop *p, const asynchronous_kdop *q, int axis) { return p->along[axis].hi < q->along[axis].lo || q->along[axis].hi < p->along[axis].lo; }

static int widest_gap(const asynchronous_kdop *p, const asynchronous_kdop *q, double *gap)
{
    int widest = 0;
    *gap = -INFINITY;
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++) {
        const double apart = max2(q->along[k].lo - p->along[k].hi, p->along[k].lo - q->along[k].hi);
        if (!(apart > *gap)) continue;
        *gap = apart;
        widest = k;
    }
    return widest;
}

/* Two leaves: apart along the direction along which they are most so, or overlapping. */
static void look_at_leaves(cipc_asynchronous *a, int number)
{
    asynchronous_separation *e = &a->broad.entry[number];
    const asynchronous_tree_node *p = &a->broad.tree[e->node[0]], *q = &a->broad.tree[e->node[1]];
    double gap;
    const int axis = widest_gap(&p->dop, &q->dop, &gap);
    if (gap > 0) {
        if (e->axis < 0) drop_overlap(a, e->overlap);
        e->axis = axis;
        e->bound = travel_of(&a->broad, e) + gap;
    } else if (e->axis < 0) {
        look_at_overlap(a, number);
    } else {
        begin_overlap(a, number, combinations_that_meet(a, &a->broad.leaves[p->leaf], &a->broad.leaves[q->leaf]));
    }
}

static void look_at_entry(cipc_asynchronous *a, int number)
{
    asynchronous_broad *b = &a->broad;
    asynchronous_separation *e = &b->entry[number];
    const int p = e->node[0], q = e->node[1];
    if (travel_of(b, e) < e->bound) return;
    const asynchronous_kdop *dop_p = &b->tree[p].dop, *dop_q = &b->tree[q].dop;
    if (leaf_of(b, p) && leaf_of(b, q)) {
        look_at_leaves(a, number);
    } else if (!is_apart(dop_p, dop_q, e->axis)) {
        const int axis = asynchronous_kdop_axis(dop_p, dop_q);
        e->axis = axis;
        if (axis >= 0) return;
        unlink_entry(b, number);
        cover(a, p, q);
    }
}

static void look_at_node(cipc_asynchronous *a, int node)
{
    for (int link = a->broad.tree[node].first, next; link >= 0 && !a->status; link = next) {
        next = a->broad.entry[link / 2].next[link % 2]; /* the entry may be gone afterwards, the next one never */
        look_at_entry(a, link / 2);
    }
}

static bool grow_to_hold(asynchronous_kdop *dop, const asynchronous_kdop *inner)
{
    bool grown = false;
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++) {
        if (inner->along[k].lo < dop->along[k].lo) {
            dop->along[k].lo = inner->along[k].lo;
            grown = true;
        }
        if (inner->along[k].hi > dop->along[k].hi) {
            dop->along[k].hi = inner->along[k].hi;
            grown = true;
        }
    }
    return grown;
}

/* What is above a leaf grows where it must. */
static void look_above(cipc_asynchronous *a, int place)
{
    asynchronous_broad *b = &a->broad;
    int below = place;
    for (int node = b->tree[place].parent; node >= 0 && grow_to_hold(&b->tree[node].dop, &b->tree[below].dop); below = node, node = b->tree[node].parent) look_at_node(a, node);
}

/* All leaves at the node first, because they are each other's neighbours: what they have travelled and where they are must agree when entries are looked at. */
void asynchronous_separation_update(cipc_asynchronous *a, int node, double travel)
{
    asynchronous_broad *b = &a->broad;
    const int *leaves = b->incident + b->incident_first[node], count = b->incident_first[node + 1] - b->incident_first[node];
    for (int i = 0; i < count; i++) {
        const int place = b->leaf_place[leaves[i]];
        b->travel[place] += travel;
        asynchronous_leaf_dop(a, leaves[i], &b->tree[place].dop);
    }
    for (int i = 0; i < count && !a->status; i++) {
        look_above(a, b->leaf_place[leaves[i]]);
        look_at_node(a, b->leaf_place[leaves[i]]);
    }
    b->stale = b->live_entries > LIST_GROWTH * b->fresh_entries + LIST_SPARE;
}

void asynchronous_broad_free(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    void *blocks[] = {b->leaves, b->tree, b->leaf_place, b->travel, b->incident_first, b->incident, b->shadow, b->entry, b->overlap};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}
