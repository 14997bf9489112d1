/* Paths of nodes with breaks (docs/monitors.md, "Paths with breaks"). */
#include "invariant/polylines.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vector.h"

/* Interpolated coordinates are off by at most 11.1 u M, u = DBL_EPSILON / 2, M the largest coordinate of the node's path; places so by 19.3 u M. */
#define PLACE_ERROR (10 * DBL_EPSILON)
/* What underflow can lose: below 2^-535 in the root of a sum of squares, far less elsewhere. */
#define UNDERFLOW_ERROR 0x1p-500
/* Differences of larger coordinates could overflow: nothing is known of their places then. */
#define LARGEST_COORDINATE 0x1p1000
/* A length is evaluated with a relative error below 2.5 u, a difference of coordinates u; the product with this adds one more. */
#define ROUND_UP (1 + 4 * DBL_EPSILON)

/* --- corners --- */

/* Is the place that of the node's last knot, if their times are equal? */
static bool same_place(const cipc_knot *knot, const double x[3])
{
    return knot->x[0] == x[0] && knot->x[1] == x[1] && knot->x[2] == x[2];
}

/* Count each node's knots: several at one time are one. `last` is scratch. */
static void count_knots(cipc_polylines *p, const cipc_paths *paths, double *last)
{
    for (int i = 0; i < p->node_count; i++) {
        last[i] = paths->begin;
        p->first[i + 1] = 1;
    }
    for (long b = 0; b < paths->break_count; b++) {
        const cipc_path_break *at = &paths->breaks[b];
        p->first[at->node + 1] += at->time > last[at->node] ? 1 : 0;
        last[at->node] = at->time;
    }
    for (int i = 0; i < p->node_count; i++) { p->first[i + 1] += p->first[i] + (paths->end > last[i] ? 1 : 0); }
}

/* Add a knot to those of a node, of which `next` is where the next one goes. False: the node is elsewhere at that time. */
static bool add_knot(cipc_polylines *p, long *next, int node, double time, const double x[3])
{
    if (*next > p->first[node] && p->knots[*next - 1].time == time) { return same_place(&p->knots[*next - 1], x); }
    p->knots[*next].time = time;
    v3_copy(p->knots[*next].x, x);
    ++*next;
    return true;
}

static cipc_status fail_jump(int node, double time, cipc_error *error)
{
    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "paths", "node %d is at two places at the time %.17g s", node, time);
}

static cipc_status fill_knots(cipc_polylines *p, const cipc_paths *paths, long *next, cipc_error *error)
{
    for (int i = 0; i < p->node_count; i++) {
        next[i] = p->first[i];
        add_knot(p, &next[i], i, paths->begin, &paths->from[3 * (size_t)i]);
    }
    for (long b = 0; b < paths->break_count; b++) {
        const cipc_path_break *at = &paths->breaks[b];
        if (!add_knot(p, &next[at->node], at->node, at->time, at->x)) { return fail_jump(at->node, at->time, error); }
    }
    for (int i = 0; i < p->node_count; i++) {
        if (!add_knot(p, &next[i], i, paths->end, &paths->to[3 * (size_t)i])) { return fail_jump(i, paths->end, error); }
    }
    return CIPC_OK;
}

/* --- places --- */

/* from + (t - begin)/(end - begin) (to - from), rounded; begin < t < end. */
static void interpolate(double x[3], double t, double begin, double end, const double from[3], const double to[3])
{
    double share = (t - begin) / (end - begin);
    for (int k = 0; k < 3; k++) { x[k] = from[k] + share * (to[k] - from[k]); }
}

bool cipc_polylines_place(const cipc_polylines *p, long k, double time, double x[3])
{
    const cipc_knot *here = &p->knots[k];
    bool exact = here->time == time;
    if (exact) { v3_copy(x, here->x); }
    else { interpolate(x, time, here[0].time, here[1].time, here[0].x, here[1].x); }
    return exact;
}

static void bound_rounding(cipc_polylines *p, int node)
{
    double most = 0;
    for (long k = p->first[node]; k < p->first[node + 1]; k++) {
        for (int c = 0; c < 3; c++) { most = fmax(most, fabs(p->knots[k].x[c])); }
    }
    p->rounding[node] = most < LARGEST_COORDINATE ? PLACE_ERROR * most + UNDERFLOW_ERROR : INFINITY;
}

/* A node's places at all instants. */
static void place_node(cipc_polylines *p, int node)
{
    long k = p->first[node];
    for (int j = 0; j <= p->slices; j++) {
        while (k + 1 < p->first[node + 1] && p->knots[k + 1].time <= p->times[j]) { k++; }
        size_t at = (size_t)j * (size_t)p->node_count + (size_t)node;
        p->knot_at[at] = k;
        cipc_polylines_place(p, k, p->times[j], &p->places[3 * at]);
    }
}

/* --- deviations --- */

/* How far knot k lies from the straight way between the places at instants i < j, between which it is. */
static double stray(const cipc_polylines *p, long k, int node, int i, int j)
{
    const cipc_knot *knot = &p->knots[k];
    const double *from = &p->places[3 * ((size_t)i * (size_t)p->node_count + (size_t)node)];
    const double *to = &p->places[3 * ((size_t)j * (size_t)p->node_count + (size_t)node)];
    double x[3];
    interpolate(x, knot->time, p->times[i], p->times[j], from, to);
    v3_sub(x, knot->x, x);
    double length = v3_norm(x) * ROUND_UP;
    return length >= 0 ? length : INFINITY; /* not a number: too large to be evaluated */
}

/* The path's difference from the straight way is straight between knots, so its length is greatest at a knot or at an end, where it is the rounding of places.
 * A path that is straight and ends at knots does not stray. */
static double deviation_between(const cipc_polylines *p, int node, int i, int j)
{
    long before = p->knot_at[(size_t)i * (size_t)p->node_count + (size_t)node], last = p->knot_at[(size_t)j * (size_t)p->node_count + (size_t)node];
    double most = 0;
    if (p->knots[before].time == p->times[i] && p->knots[last].time == p->times[j] && last - before <= 1) { return 0; }
    for (long k = before + 1; k <= last; k++) {
        double s = p->knots[k].time < p->times[j] ? stray(p, k, node, i, j) : 0;
        most = s > most ? s : most;
    }
    return most + p->rounding[node];
}

static void bound_deviation(cipc_polylines *p, int node)
{
    for (int count = 1, width = p->slices; count <= p->slices; count *= 2, width /= 2) {
        for (int s = 0; s < count; s++) {
            p->deviation[(size_t)(count + s) * (size_t)p->node_count + (size_t)node] = deviation_between(p, node, s * width, (s + 1) * width);
        }
    }
}

/* --- all of it --- */

/* As many slices as are not more than the mean node has breaks. */
static int choose_slices(const cipc_paths *paths)
{
    enum { MOST = 1 << 20 };
    int slices = 1;
    while (paths->break_count > 0 && slices < MOST && 2L * slices * paths->node_count <= paths->break_count) { slices *= 2; }
    return slices;
}

/* Instants at equal distances, as far as rounding lets them be. */
static void set_times(cipc_polylines *p, const cipc_paths *paths)
{
    for (int j = 1; j < p->slices; j++) {
        double t = paths->begin + (paths->end - paths->begin) * ((double)j / p->slices);
        p->times[j] = t < paths->end ? t : paths->end;
    }
    p->times[0] = paths->begin;
    p->times[p->slices] = paths->end;
}

static bool allocate(cipc_polylines *p)
{
    size_t nodes = (size_t)p->node_count, slices = (size_t)p->slices;
    p->knots = cipc_alloc((size_t)p->first[nodes], sizeof *p->knots);
    p->rounding = cipc_alloc(nodes, sizeof *p->rounding);
    p->times = cipc_alloc(slices + 1, sizeof *p->times);
    p->places = cipc_alloc((slices + 1) * 3 * nodes, sizeof *p->places);
    p->knot_at = cipc_alloc((slices + 1) * nodes, sizeof *p->knot_at);
    p->deviation = cipc_alloc(2 * slices * nodes, sizeof *p->deviation);
    return p->knots != NULL && p->rounding != NULL && p->times != NULL && p->places != NULL && p->knot_at != NULL && p->deviation != NULL;
}

static cipc_status fail_memory(const cipc_paths *paths, cipc_error *error)
{
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "paths", "no memory for the paths of %d nodes with %ld breaks", paths->node_count, paths->break_count);
}

static cipc_status make_knots(cipc_polylines *p, const cipc_paths *paths, cipc_error *error)
{
    size_t nodes = (size_t)p->node_count;
    double *last = cipc_alloc(nodes, sizeof *last);
    long *next = cipc_alloc(nodes, sizeof *next);
    p->first = cipc_alloc(nodes + 1, sizeof *p->first);
    cipc_status status = CIPC_E_OUT_OF_MEMORY;
    if (last != NULL && next != NULL && p->first != NULL) {
        count_knots(p, paths, last);
        status = allocate(p) ? fill_knots(p, paths, next, error) : CIPC_E_OUT_OF_MEMORY;
    }
    cipc_free(last);
    cipc_free(next);
    return status == CIPC_E_OUT_OF_MEMORY ? fail_memory(paths, error) : status;
}

cipc_status cipc_polylines_init(cipc_polylines *p, const cipc_paths *paths, int threads, cipc_error *error)
{
    memset(p, 0, sizeof *p);
    p->node_count = paths->node_count;
    p->slices = choose_slices(paths);
    cipc_status status = make_knots(p, paths, error);
    if (status != CIPC_OK) { return status; }
    set_times(p, paths);
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
    for (int i = 0; i < p->node_count; i++) {
        bound_rounding(p, i);
        place_node(p, i);
        bound_deviation(p, i);
    }
    return CIPC_OK;
}

void cipc_polylines_free(cipc_polylines *p)
{
    cipc_free(p->first);
    cipc_free(p->knots);
    cipc_free(p->rounding);
    cipc_free(p->times);
    cipc_free(p->places);
    cipc_free(p->knot_at);
    cipc_free(p->deviation);
    memset(p, 0, sizeof *p);
}

void cipc_polylines_boxes(const cipc_polylines *p, double *lo, double *hi)
{
    for (size_t i = 0; i < (size_t)p->node_count; i++) {
        v3_copy(&lo[3 * i], p->knots[p->first[i]].x);
        v3_copy(&hi[3 * i], p->knots[p->first[i]].x);
        for (long k = p->first[i] + 1; k < p->first[i + 1]; k++) {
            for (int c = 0; c < 3; c++) {
                double v = p->knots[k].x[c];
                lo[3 * i + (size_t)c] = fmin(lo[3 * i + (size_t)c], v);
                hi[3 * i + (size_t)c] = fmax(hi[3 * i + (size_t)c], v);
            }
        }
    }
}
