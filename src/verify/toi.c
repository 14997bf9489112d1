/* Campaign "toi": continuous collision detection against the exact time of impact, class by class (SPEC V.3, V.4; docs/verification.md). */
#include "verify/toi.h"

#include <math.h>
#include <string.h>

#include "verify/stencils.h"

typedef struct toi_class {
    const char *name;
    double least_hits; /* share of the samples that must be true contacts */
    void (*draw)(gsl_rng *rng, cipc_stencil_path *path, double *xi);
} toi_class;

static cipc_pair_kind draw_kind(gsl_rng *rng)
{
    static const cipc_pair_kind kinds[] = {CIPC_POINT_POINT,    CIPC_POINT_EDGE, CIPC_POINT_TRIANGLE, CIPC_POINT_TRIANGLE,
                                           CIPC_POINT_TRIANGLE, CIPC_EDGE_EDGE,  CIPC_EDGE_EDGE,      CIPC_EDGE_EDGE};
    return kinds[verify_index(rng, 8)];
}

/* Everything at random in a cube. */
static void draw_random(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    *path = (cipc_stencil_path){.kind = draw_kind(rng)};
    for (int i = 0; i < 12; i++) {
        path->x[i] = verify_uniform(rng, -1, 1);
        path->p[i] = verify_uniform(rng, -2, 2);
    }
    *xi = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-5, 0.3);
}

static void place(gsl_rng *rng, const verify_shape *shape, cipc_stencil_path *path, double *xi)
{
    verify_place(rng, draw_kind(rng), shape, path);
    *xi = shape->thickness * shape->size;
}

static void draw_thick(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.thickness = verify_log_uniform(rng, 1e-5, 1);
    s.gap = s.thickness * verify_log_uniform(rng, 1e-9, 1);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    s.approach = (s.gap + s.thickness) * verify_uniform(rng, 0.5, 3);
    s.tumble = s.approach * verify_uniform(rng, 0, 0.5);
    s.slide = verify_uniform(rng, 0, 0.2);
    place(rng, &s, path, xi);
}

/* Sliding past at nearly the thickness: a touch, a near miss or a shallow contact. */
static void draw_grazing(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.thickness = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-4, 0.3);
    s.gap = verify_log_uniform(rng, 1e-9, 0.1);
    s.approach = s.gap * (1 + (verify_chance(rng, 0.5) ? 1 : -1) * verify_log_uniform(rng, 1e-12, 0.5));
    s.slide = verify_uniform(rng, 0.1, 2);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    s.aligned = verify_chance(rng, 0.5);
    place(rng, &s, path, xi);
}

/* Gap between the rounding of the coordinates and a millionth of the size. */
static void draw_tiny_gap(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.thickness = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-3, 0.3);
    s.gap = verify_log_uniform(rng, 1e-16, 1e-6);
    s.approach = verify_chance(rng, 0.5) ? verify_uniform(rng, 0.1, 1) : s.gap * verify_uniform(rng, 0.5, 10);
    s.tumble = s.approach * verify_uniform(rng, 0, 0.3);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    s.aligned = verify_chance(rng, 0.7);
    place(rng, &s, path, xi);
}

static void draw_world_offset(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.offset = verify_log_uniform(rng, 1, 1e6);
    s.common = verify_chance(rng, 0.3) ? s.offset : 0;
    s.gap = verify_log_uniform(rng, 1e-13, 1e-3);
    s.thickness = verify_chance(rng, 0.5) ? 0 : 2e-3;
    s.approach = s.gap * 3 + verify_uniform(rng, 0, 0.5);
    s.tumble = verify_uniform(rng, 0, 0.1);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    place(rng, &s, path, xi);
}

static void draw_parallel(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.angle = verify_log_uniform(rng, 1e-16, 1e-3);
    s.gap = verify_log_uniform(rng, 1e-12, 0.1);
    s.thickness = verify_chance(rng, 0.7) ? 0 : verify_log_uniform(rng, 1e-4, 0.1);
    s.approach = (s.gap + s.thickness) * verify_uniform(rng, 0.8, 4);
    s.tumble = verify_chance(rng, 0.5) ? 0 : s.approach * verify_log_uniform(rng, 1e-12, 0.1);
    s.slide = verify_chance(rng, 0.5) ? 0 : verify_uniform(rng, 0, 0.3);
    s.aligned = verify_chance(rng, 0.5);
    verify_place(rng, CIPC_EDGE_EDGE, &s, path);
    *xi = s.thickness;
}

static void draw_sliver(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.angle = verify_log_uniform(rng, 1e-16, 1e-3); /* the triangle's height */
    s.gap = verify_log_uniform(rng, 1e-12, 0.1);
    s.thickness = verify_chance(rng, 0.7) ? 0 : verify_log_uniform(rng, 1e-4, 0.1);
    s.approach = (s.gap + s.thickness) * verify_uniform(rng, 0.8, 4);
    s.tumble = verify_chance(rng, 0.5) ? 0 : s.approach * verify_log_uniform(rng, 1e-12, 0.1);
    s.aligned = verify_chance(rng, 0.5);
    verify_place(rng, CIPC_POINT_TRIANGLE, &s, path);
    *xi = s.thickness;
}

static void draw_gap_over_thickness(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.thickness = verify_log_uniform(rng, 1e-4, 1);
    s.gap = s.thickness * verify_log_uniform(rng, 1e-13, 1e-6);
    s.approach = s.thickness * verify_uniform(rng, 0.1, 2);
    s.tumble = s.approach * verify_uniform(rng, 0, 0.3);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    s.aligned = verify_chance(rng, 0.7);
    place(rng, &s, path, xi);
}

/* Sizes from 1e-12 to 1e12; now and then powers of two from the ends of the range of doubles' squares. */
static void draw_scales(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.size = verify_chance(rng, 0.2) ? ldexp(1, verify_index(rng, 481) - 240) : verify_log_uniform(rng, 1e-12, 1e12);
    s.gap = verify_log_uniform(rng, 1e-6, 0.5);
    s.thickness = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-4, 0.3);
    s.approach = (s.gap + s.thickness) * verify_uniform(rng, 0.5, 3);
    s.tumble = verify_uniform(rng, 0, 0.2);
    s.angle = verify_uniform(rng, 0.05, 1.5);
    s.offset = verify_chance(rng, 0.3) ? 10 : 0;
    place(rng, &s, path, xi);
}

/* Nodes that coincide, move together, stand still; contact at ends and corners. */
static void draw_degenerate(gsl_rng *rng, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.gap = verify_log_uniform(rng, 1e-6, 0.3);
    s.approach = s.gap * verify_uniform(rng, 0.5, 3);
    s.foot = verify_chance(rng, 0.5) ? 0x1p-1074 : 1e-15;
    s.aligned = true;
    s.angle = verify_chance(rng, 0.5) ? 0 : 1;
    place(rng, &s, path, xi);
    int nodes = cipc_pair_nodes(path->kind), i = verify_index(rng, nodes), j = verify_index(rng, nodes);
    bool same_side = (i < cipc_pair_first_nodes(path->kind)) == (j < cipc_pair_first_nodes(path->kind));
    if (same_side) memcpy(path->x + 3 * i, path->x + 3 * j, 3 * sizeof path->x[0]);
    if (same_side && verify_chance(rng, 0.5)) memcpy(path->p + 3 * i, path->p + 3 * j, 3 * sizeof path->p[0]);
    if (verify_chance(rng, 0.2)) memset(path->p + 3 * i, 0, 3 * sizeof path->p[0]);
    if (verify_chance(rng, 0.2)) *xi = s.gap * verify_uniform(rng, 0, 1);
}

static const toi_class classes[] = {
    {"random", 0.05, draw_random},
    {"thickness 1e-5..1 of the size", 0.3, draw_thick},
    {"grazing", 0.02, draw_grazing},
    {"gap 1e-16..1e-6 of the size", 0.5, draw_tiny_gap},
    {"world offset to 1e6 sizes", 0.3, draw_world_offset},
    {"edges at 1e-16..1e-3 rad", 0.4, draw_parallel},
    {"slivers 1e-16..1e-3", 0.4, draw_sliver},
    {"gap over thickness 1e-13..1e-6", 0.5, draw_gap_over_thickness},
    {"sizes 2^-240..2^240", 0.2, draw_scales},
    {"degenerate", 0.1, draw_degenerate},
};
enum { CLASS_COUNT = sizeof classes / sizeof classes[0] };

static void describe(int index, verify_row *row) { verify_toi_describe(row, classes[index].name, classes[index].least_hits); }

/* Half of the paths are given by displacements, as the solver does, half by their ends, whose difference need not be a double. */
static void sample(int index, gsl_rng *rng, long number, verify_row *row, const void *context)
{
    cipc_stencil_path path;
    double xi = 0;
    classes[index].draw(rng, &path, &xi);
    if (verify_chance(rng, 0.5)) {
        path.to_end = true;
        for (int i = 0; i < 3 * cipc_pair_nodes(path.kind); i++) path.p[i] += path.x[i];
    }
    verify_toi_judge(&path, xi, number, row, context);
}

static const verify_toi_subject subject = {cipc_certified_ccd};
const verify_campaign verify_toi = {"toi", CLASS_COUNT, describe, sample, &subject, 0.1};
