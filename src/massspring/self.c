/* Cloth against itself: nodes that no spring joins push each other apart, and rub (SPEC B.6, [R]). No guarantee: nodes alone are looked at. */
#include "massspring/stepper.h"

#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "cipc/geometry.h"

typedef struct search {
    cipc_massspring *s;
    const double *x, *v;
    int node;
} search;

static bool is_joined(const cipc_massspring *s, int a, int b)
{
    const long long wanted = massspring_join(s, a, b);
    return bsearch(&wanted, s->joined, (size_t)s->spring_count, sizeof wanted, massspring_compare_joins) != NULL;
}

/* Half springs of the repulsion's stiffness, and Coulomb friction of what they push, at most what stops the sliding. */
static void push_apart(search *c, int other)
{
    cipc_massspring *s = c->s;
    double between[3], speed[3], f[3];
    if (other <= c->node || !s->is_cloth[other] || is_joined(s, c->node, other)) return;
    v3_sub(between, c->x + 3 * c->node, c->x + 3 * other);
    v3_sub(speed, c->v + 3 * c->node, c->v + 3 * other);
    const double distance = v3_norm(between), w = s->inverse_mass[c->node] + s->inverse_mass[other];
    if (!(distance < s->options.self_distance) || !(distance > 0) || !(w > 0)) return;
    v3_scale(between, 1 / distance, between);
    const double push = s->options.repulsion * (s->options.self_distance - distance), along = v3_dot(speed, between);
    v3_scale(f, push, between);
    v3_axpy(speed, -along, between);
    const double sliding = v3_norm(speed);
    if (sliding > 0) v3_axpy(f, -fmin(s->options.self_friction * push, sliding / (w * s->h)) / sliding, speed);
    v3_axpy(s->force + 3 * c->node, 1, f);
    v3_axpy(s->force + 3 * other, -1, f);
    s->report.self_contacts++;
}

static void visit(void *context, int other) { push_apart(context, other); }

cipc_status massspring_self_forces(cipc_massspring *s, const double *x, const double *v, cipc_error *error)
{
    const int n = s->model->node_count;
    cipc_box *boxes = cipc_alloc((size_t)n, sizeof *boxes);
    cipc_box_tree *tree = NULL;
    s->report.self_contacts = 0;
    if (!boxes) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "mass-spring", "no memory for the collision of cloth with itself");
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            boxes[i].lo[k] = x[3 * i + k] - 0.5 * s->options.self_distance;
            boxes[i].hi[k] = x[3 * i + k] + 0.5 * s->options.self_distance;
        }
    const cipc_status status = cipc_box_tree_create(&tree, boxes, n, error);
    for (int i = 0; i < n && !status; i++) {
        search c = {s, x, v, i};
        if (s->is_cloth[i]) cipc_box_tree_query(tree, &boxes[i], visit, &c, NULL);
    }
    cipc_box_tree_destroy(tree);
    cipc_free(boxes);
    return status;
}
