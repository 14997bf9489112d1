/* The largest collision-free step over all candidate pairs (SPEC C.5, D.5; docs/theory/contact.md (19), (20)). */
#include "cipc/contact.h"

#include <math.h>

#include "base/vector.h"
#include "contact/ccd.h"
#include "contact/stencil.h"

/* Do the two primitives' boxes, swept over [0, t] and grown by xi, stay apart? The far corner x + t p is rounded like the path itself; the slack
 * covers both roundings. `first` nodes belong to the first primitive. */
static bool swept_apart(const double y[12], const double q[12], int first, int count, double t, double xi)
{
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, size = 0;
        for (int i = 0; i < count; i++) {
            double from = y[3 * i + k], to = from + t * q[3 * i + k];
            int side = i >= first;
            lo[side] = min2(lo[side], min2(from, to));
            hi[side] = max2(hi[side], max2(from, to));
            size = max2(size, max2(fabs(from), fabs(to)));
        }
        double slack = xi + 0x1p-49 * (size + xi);
        if (lo[0] - hi[1] > slack || lo[1] - hi[0] > slack) return true;
    }
    return false;
}

bool cipc_candidates_query(const cipc_model *model, const cipc_candidates *c, long index, const double *x, const double *p, double t_max,
                           const cipc_ccd_options *options, cipc_stencil_path *path, double *xi)
{
    int nodes[4];
    const int *pair = cipc_candidates_pair(c, index, &path->kind);
    int count = cipc_pair_nodes(path->kind);
    path->to_end = false;
    cipc_stencil_nodes(model, path->kind, pair, nodes);
    cipc_stencil_positions(x, nodes, count, path->x);
    cipc_stencil_positions(p, nodes, count, path->p);
    *xi = cipc_stencil_offset(model, path->kind, nodes);
    double whole = options->gap_first ? 1 : t_max; /* the released code looks at the whole path */
    return !swept_apart(path->x, path->p, cipc_pair_first_nodes(path->kind), count, whole, *xi);
}

typedef struct earliest {
    double t;
    long index;
} earliest;

/* (19): every pair is asked with the same t_max - the end of the path decides whether a gap is an early hit (17) - and may only give up early
 * when another pair has hit before. So the minimum over pairs does not depend on their order. */
static void test_candidate(const cipc_model *model, const cipc_candidates *c, const double *x, const double *p, double t_max, long index,
                           const cipc_ccd_options *options, earliest *best)
{
    cipc_stencil_path path;
    double xi;
    if (!cipc_candidates_query(model, c, index, x, p, t_max, options, &path, &xi)) return;
    cipc_ccd_result r = contact_ccd_until(&path, xi, t_max, best->t, options);
    if (r.hit && (r.toi < best->t || best->index < 0)) {
        best->t = r.toi;
        best->index = index;
    }
}

double cipc_candidates_ccd(const cipc_model *model, const cipc_candidates *candidates, const double *x, const double *p, double t_max,
                           const cipc_ccd_options *options, int threads, int nodes[4], cipc_pair_kind *kind)
{
    long total = cipc_candidates_count(candidates);
    earliest best = {t_max, -1};
#pragma omp parallel num_threads(threads)
    {
        earliest mine = {t_max, -1};
#pragma omp for schedule(dynamic, 64)
        for (long i = 0; i < total; i++) test_candidate(model, candidates, x, p, t_max, i, options, &mine);
#pragma omp critical
        if (mine.index >= 0 && (mine.t < best.t || (mine.t == best.t && (best.index < 0 || mine.index < best.index)))) best = mine;
    }
    for (int i = 0; nodes && i < 4; i++) nodes[i] = -1;
    if (best.index < 0) return best.t;
    cipc_pair_kind limiting;
    const int *pair = cipc_candidates_pair(candidates, best.index, &limiting);
    if (nodes) cipc_stencil_nodes(model, limiting, pair, nodes);
    if (kind) *kind = limiting;
    return best.t;
}
