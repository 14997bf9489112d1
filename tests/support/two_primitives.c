/* Two primitives alone in the world. */
#include "support/two_primitives.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static void add_primitive(sheet_scene *sheet, const char *name, int nodes, double offset, double friction)
{
    static const double rest[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const int triangle[1][3] = {{0, 1, 2}}, segment[1][2] = {{0, 1}};
    cipc_body_description body = {.node_count = nodes, .rest = rest, .position = rest, .offset = offset, .friction = friction};
    body.material = (cipc_material){.density = 1000, .thickness = 1e-3};
    body.kind = nodes == 1 ? CIPC_BODY_PARTICLES : nodes == 2 ? CIPC_BODY_RODS : CIPC_BODY_SHELL;
    if (nodes == 2) body.segments = segment;
    if (nodes == 2) body.segment_count = 1;
    if (nodes == 3) body.triangles = triangle;
    if (nodes == 3) body.triangle_count = 1;
    for (int i = 0; name[i]; i++) body.name[i] = name[i];
    sheet_add(sheet, &body);
}

void two_primitives_init(two_primitives *two, cipc_pair_kind kind, const cipc_asynchronous_options *options, double offset, double friction)
{
    *two = (two_primitives){.kind = kind, .count = cipc_pair_nodes(kind), .first = cipc_pair_first_nodes(kind)};
    asynchronous_scene_init(&two->scene);
    two->scene.options = *options;
    add_primitive(&two->scene.sheet, "first", two->first, offset, friction);
    add_primitive(&two->scene.sheet, "second", two->count - two->first, offset, friction);
    asynchronous_scene_build(&two->scene);
    two->a = two->scene.integrator;
    for (int i = 0; i < two->count; i++) {
        two->nodes[i] = i;
        two->mass[i] = two->scene.sheet.model->mass[i];
    }
}

void two_primitives_free(two_primitives *two) { asynchronous_scene_free(&two->scene); }

void two_primitives_weigh(two_primitives *two, const double mass[4])
{
    for (int i = 0; i < two->count; i++) {
        two->mass[i] = mass[i];
        if (mass[i] > 0) two->scene.sheet.model->mass[i] = mass[i];
    }
}

void two_primitives_place(two_primitives *two, const double x[12], const double v[12], double t)
{
    cipc_asynchronous *a = two->a;
    while (a->pairs.live_count > 0) asynchronous_pair_destroy(a, a->pairs.live[0]);
    a->now = t;
    a->scale = 0;
    for (int i = 0; i < two->count; i++) {
        asynchronous_node *node = &a->nodes[i];
        v3_copy(node->q, x + 3 * i);
        v3_copy(node->v, v + 3 * i);
        node->t = t;
        node->inverse_mass = two->mass[i] > 0 ? 1 / two->mass[i] : 0;
        a->dirty[i] = false;
        a->kicked[i] = -INFINITY;
        for (int k = 0; k < 3; k++) a->scale = fmax(a->scale, fabs(x[3 * i + k]));
    }
    a->dirty_count = 0;
}

int two_primitives_meet(two_primitives *two)
{
    const int pair = asynchronous_pair_create(two->a, two->kind, two->nodes, asynchronous_pair_order(two->kind, 0, two->first));
    assert_int_equal(two->a->status, CIPC_OK);
    assert_true(pair >= 0);
    return pair;
}

void two_primitives_at(const two_primitives *two, double t, double x[12])
{
    for (int i = 0; i < 12; i++) x[i] = 0;
    for (int i = 0; i < two->count; i++) asynchronous_position(&two->a->nodes[i], t, x + 3 * i);
}

void two_primitives_velocities(const two_primitives *two, double v[12])
{
    for (int i = 0; i < 12; i++) v[i] = 0;
    for (int i = 0; i < two->count; i++) v3_copy(v + 3 * i, two->a->nodes[i].v);
}
