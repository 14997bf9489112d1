#include "support/every_kind.h"

#include <stdarg.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

enum { MOST_NODES = 4, MOST_BODIES = 8 };

static const char *const names[] = {
    [CIPC_BODY_SHELL] = "cloth", [CIPC_BODY_RODS] = "strand", [CIPC_BODY_PARTICLES] = "grains", [CIPC_BODY_VOLUME] = "block"};
static const int node_counts[] = {
    [CIPC_BODY_SHELL] = 4, [CIPC_BODY_RODS] = STRAND_NODES, [CIPC_BODY_PARTICLES] = GRAIN_COUNT, [CIPC_BODY_VOLUME] = 4};
static const double shapes[][3 * MOST_NODES] = {
    [CIPC_BODY_SHELL] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1},
    [CIPC_BODY_RODS] = {0, 0, 0, 0.3, 0.2, 0, 0.6, 0.2, 0.3, 1, 0, 0.3},
    [CIPC_BODY_PARTICLES] = {0, 0, 0, 0.5, 0, 0.4, 1, 0.5, 0},
    [CIPC_BODY_VOLUME] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
};
static const int triangles[2][3] = {{0, 1, 2}, {2, 1, 3}};
static const int segments[STRAND_NODES - 1][2] = {{0, 1}, {1, 2}, {2, 3}};
static const int tetrahedra[1][4] = {{0, 1, 2, 3}};
static const double needle_ends[] = {0, -0.5, 0, 0, 0, 0, 1, -0.5, 0, 1, 0, 0};
static const int needle_segments[2][2] = {{0, 1}, {2, 3}};

static cipc_body_description describe(cipc_body_kind kind, const double *nodes)
{
    cipc_body_description d = {.kind = kind, .node_count = node_counts[kind], .rest = nodes, .position = nodes};
    d.material = (cipc_material){.density = 500, .thickness = 0.05, .membrane = CIPC_MEMBRANE_NEO_HOOKEAN, .membrane_young = 1e4,
                                 .membrane_poisson = 0.3, .young = 1e5, .poisson = 0.3};
    snprintf(d.name, sizeof d.name, "%s", names[kind]);
    if (kind == CIPC_BODY_SHELL) {
        d.triangle_count = 2;
        d.triangles = triangles;
    } else if (kind == CIPC_BODY_RODS) {
        d.segment_count = STRAND_NODES - 1;
        d.segments = segments;
    } else if (kind == CIPC_BODY_VOLUME) {
        d.tetrahedron_count = 1;
        d.tetrahedra = tetrahedra;
    }
    return d;
}

static cipc_body_description describe_needles(void)
{
    cipc_body_description d = describe(CIPC_BODY_RODS, needle_ends);
    snprintf(d.name, sizeof d.name, "needles");
    d.fixed = true;
    d.segment_count = 2;
    d.segments = needle_segments;
    return d;
}

sample_run every_kind_create(const cipc_body_kind *kinds, int count, bool needles)
{
    static const double gravity[3] = {0, -9.81, 0}, apart = 1.5;
    double nodes[MOST_BODIES][3 * MOST_NODES];
    cipc_body_description bodies[MOST_BODIES];
    assert_in_range(count, 0, MOST_BODIES - 1);
    for (int b = 0; b < count; b++) {
        for (int i = 0; i < 3 * node_counts[kinds[b]]; i++) {
            nodes[b][i] = shapes[kinds[b]][i] + (i % 3 == 0 ? apart * b : 0);
        }
        bodies[b] = describe(kinds[b], nodes[b]);
    }
    if (needles) {
        bodies[count++] = describe_needles();
    }
    sample_run run = {NULL, NULL};
    cipc_error error;
    if (cipc_model_create(&run.model, bodies, count, gravity, &error) != CIPC_OK ||
        cipc_state_create(&run.state, bodies, count, &error) != CIPC_OK) {
        fail_msg("%s: %s", error.place, error.what);
    }
    return run;
}

sample_run every_kind_create_all(void)
{
    const cipc_body_kind kinds[] = {CIPC_BODY_SHELL, CIPC_BODY_RODS, CIPC_BODY_PARTICLES, CIPC_BODY_VOLUME};
    return every_kind_create(kinds, 4, true);
}
