/* Cloth against itself: nodes that no spring joins push each other apart, and rub (SPEC B.6, [R]). No guarantee: nodes alone are looked at. */
#include "massspring/stepper.h"

#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "cipc/geometry.h"

/* Pairs within self_distance (1 + slack) are listed, and the list serves until a node has moved by half the slack: so long no other pair can come within self_distance. What rounding might
 * let in is at the end of its half spring, which does not push there. */
static const double slack = 0.5;

/* ---- The list ---- */

static bool is_joined(const cipc_massspring *s, int a, int b)
{
    const long long wanted = massspring_join(s, a, b);
    return bsearch(&wanted, s->joined, (size_t)s->spring_count, sizeof wanted, massspring_compare_joins) != NULL;
}

typedef struct search {
    cipc_massspring *s;
    const double *x;
    int node;
    bool full; /* no memory for more */
} search;

static bool make_room(massspring_near_list *near)
{
    const int room = near->room > 0 ? 2 * near->room : 256;
    massspring_near_pair *pairs = near->count < near->room ? near->pairs : cipc_realloc(near->pairs, (size_t)room, sizeof *pairs);
    if (!pairs) return false;
    near->room = near->count < near->room ? near->room : room;
    near->pairs = pairs;
    return true;
}

static double distance(const double *x, int a, int b)
{
    double between[3];
    v3_sub(between, x + 3 * a, x + 3 * b);
    return v3_norm(between);
}

/* Cloth with short edges would push itself apart at rest, and be stiff where it bends: the distance is meant for 1.4 edges, which is 1/sqrt(2) of what the nearest nodes that no spring joins in line, two
 * edges away, are apart at rest. Different cloths are kept apart by all of it. */
static double kept_apart(const cipc_massspring *s, int a, int b)
{
    const cipc_model *m = s->model;
    return m->node_body[a] == m->node_body[b] ? min2(s->options.self_distance, M_SQRT1_2 * distance(m->rest, a, b)) : s->options.self_distance;
}

static void visit(void *context, int other)
{
    search *c = context;
    cipc_massspring *s = c->s;
    if (other <= c->node || !s->is_cloth[other] || is_joined(s, c->node, other)) return;
    if (!(distance(c->x, c->node, other) < s->options.self_distance * (1 + slack))) return;
    if (!make_room(&s->near)) {
        c->full = true;
        return;
    }
    s->near.pairs[s->near.count++] = (massspring_near_pair){{c->node, other}, kept_apart(s, c->node, other)};
}

/* In the order of their nodes: so forces add up alike, whenever the list was made. */
static int compare_pairs(const void *p, const void *q)
{
    const int *a = ((const massspring_near_pair *)p)->node, *b = ((const massspring_near_pair *)q)->node;
    return a[0] != b[0] ? (a[0] > b[0]) - (a[0] < b[0]) : (a[1] > b[1]) - (a[1] < b[1]);
}

static cipc_status no_memory(cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "mass-spring", "no memory for the collision of cloth with itself"); }

static cipc_status make_list(cipc_massspring *s, const double *x, cipc_error *error)
{
    const int n = s->model->node_count;
    const double half = 0.5 * (1 + slack) * s->options.self_distance;
    cipc_box *boxes = cipc_alloc((size_t)n, sizeof *boxes);
    cipc_box_tree *tree = NULL;
    search c = {.s = s, .x = x};
    s->near.count = 0;
    s->near.made = false;
    if (!boxes) return no_memory(error);
    for (int i = 0; i < 3 * n; i++) {
        boxes[i / 3].lo[i % 3] = x[i] - half;
        boxes[i / 3].hi[i % 3] = x[i] + half;
        s->near.at[i] = x[i];
    }
    cipc_status status = cipc_box_tree_create(&tree, boxes, n, error);
    for (c.node = 0; c.node < n && !status && !c.full; c.node++)
        if (s->is_cloth[c.node]) cipc_box_tree_query(tree, &boxes[c.node], visit, &c, NULL);
    if (!status && c.full) status = no_memory(error);
    cipc_box_tree_destroy(tree);
    cipc_free(boxes);
    if (s->near.count > 0) qsort(s->near.pairs, (size_t)s->near.count, sizeof *s->near.pairs, compare_pairs);
    s->near.made = !status;
    return status;
}

static bool list_serves(const cipc_massspring *s, const double *x)
{
    const double most = 0.5 * slack * s->options.self_distance;
    for (int i = 0; i < s->model->node_count && s->near.made; i++) {
        double moved[3];
        v3_sub(moved, x + 3 * i, s->near.at + 3 * i);
        if (s->is_cloth[i] && !(v3_norm2(moved) < most * most)) return false;
    }
    return s->near.made;
}

/* ---- Forces ---- */

/* Half springs of the repulsion's stiffness, and Coulomb friction of what they push, at most what stops the sliding. */
static void push_apart(cipc_massspring *s, const massspring_near_pair *pair, const double *x, const double *v)
{
    const int node = pair->node[0], other = pair->node[1];
    double between[3], speed[3], f[3];
    v3_sub(between, x + 3 * node, x + 3 * other);
    v3_sub(speed, v + 3 * node, v + 3 * other);
    const double r = v3_norm(between), w = s->inverse_mass[node] + s->inverse_mass[other];
    if (!(r < pair->apart) || !(r > 0) || !(w > 0)) return;
    v3_scale(between, 1 / r, between);
    const double push = s->options.repulsion * (pair->apart - r), along = v3_dot(speed, between);
    v3_scale(f, push, between);
    v3_axpy(speed, -along, between);
    const double sliding = v3_norm(speed);
    if (sliding > 0) v3_axpy(f, -fmin(s->options.self_friction * push, sliding / (w * s->h)) / sliding, speed);
    v3_axpy(s->force + 3 * node, 1, f);
    v3_axpy(s->force + 3 * other, -1, f);
    s->report.self_contacts++;
}

cipc_status massspring_self_forces(cipc_massspring *s, const double *x, const double *v, cipc_error *error)
{
    const cipc_status status = list_serves(s, x) ? CIPC_OK : make_list(s, x, error);
    s->report.self_contacts = 0;
    for (int k = 0; k < s->near.count && !status; k++) push_apart(s, &s->near.pairs[k], x, v);
    return status;
}
