/* Level 4 of the conformance kit: the barrier potential of two triangles, assembled - every pair classified, activated, weighted, mollified, and summed once
 * (docs/conformance.md). The solver's answer and the truth. */
#include "verify/two_triangles.h"

#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "cipc/contact.h"
#include "verify/condition.h"
#include "verify/truth.h"

enum { NODES = 6, N = VERIFY_TWO_TRIANGLES_NUMBERS };
/* eps_x = 1e-3 |A|^2 |B|^2 with rest lengths (SPEC D.3). */
static const double MOLLIFIER_SHARE = 1e-3;

/* The potential and its derivatives, or their tolerances' parts. */
typedef struct sums {
    double value, g[N], H[N * N];
} sums;

static void scatter(sums *s, const int *nodes, int count, double value, const double *g, const double *H)
{
    int n = 3 * count;
    s->value += value;
    for (int i = 0; i < n; i++) {
        int r = 3 * nodes[i / 3] + i % 3;
        s->g[r] += g[i];
        for (int j = 0; j < n; j++) s->H[N * r + 3 * nodes[j / 3] + j % 3] += H[n * i + j];
    }
}

/* --- the solver's answer --- */

static cipc_status sum_contacts(const cipc_model *model, const cipc_query *q, sums *s, cipc_error *error)
{
    cipc_contact_options options = {.dhat = q->params[VERIFY_DHAT]};
    cipc_broad_phase *broad_phase = NULL;
    cipc_candidates candidates = {0};
    cipc_contact_set set = {0};
    cipc_status status = cipc_broad_phase_create(&broad_phase, model, error);
    if (status == CIPC_OK) status = cipc_broad_phase_find(broad_phase, model, q->x, NULL, 0, options.dhat, NULL, 1, &candidates, error);
    if (status == CIPC_OK) status = cipc_contact_set_build(&set, model, &candidates, q->x, q->params[VERIFY_STIFFNESS], &options, 1, error);
    for (int i = 0; status == CIPC_OK && i < set.count; i++) {
        const cipc_contact *c = &set.contacts[i];
        const cipc_energy *energy = cipc_energy_entry(c->energy);
        double y[12], g[12], H[144];
        for (int k = 0; k < c->count; k++) memcpy(y + 3 * k, q->x + 3 * c->nodes[k], 3 * sizeof *y);
        double value = energy->value(y, &c->barrier);
        if (!isfinite(value)) { /* infeasible: there are no derivatives to ask for */
            s->value = value;
            break;
        }
        energy->gradient(y, &c->barrier, g);
        energy->hessian(y, &c->barrier, H);
        scatter(s, c->nodes, c->count, value, g, H);
    }
    cipc_contact_set_free(&set);
    cipc_candidates_free(&candidates);
    cipc_broad_phase_destroy(broad_phase);
    return status;
}

/* Two bodies of one triangle each, of any material: contact does not ask. */
static cipc_status build_model(cipc_model **model, const cipc_query *q, cipc_error *error)
{
    static const int triangle[1][3] = {{0, 1, 2}};
    static const double no_gravity[3] = {0, 0, 0};
    cipc_body_description bodies[2];
    for (int i = 0; i < 2; i++)
        bodies[i] = (cipc_body_description){.name = "triangle", .material = {.density = 1, .thickness = 1}, .offset = q->thickness, .node_count = 3,
                                            .rest = q->rest + 9 * i, .position = q->x + 9 * i, .triangle_count = 1, .triangles = triangle};
    snprintf(bodies[1].name, sizeof bodies[1].name, "other");
    return cipc_model_create(model, bodies, 2, no_gravity, error);
}

json_t *verify_two_triangles_answer(const cipc_query *q, bool *good)
{
    sums s = {0};
    cipc_model *model = NULL;
    cipc_error error;
    *good = *good && build_model(&model, q, &error) == CIPC_OK && sum_contacts(model, q, &s, &error) == CIPC_OK;
    cipc_model_destroy(model);
    json_t *got = json_object();
    cipc_json_put(got, "value", cipc_json_number(s.value), good);
    cipc_json_put(got, "gradient", verify_numbers_json(s.g, N), good);
    cipc_json_put(got, "hessian", verify_numbers_json(s.H, N * N), good);
    return got;
}

/* --- the truth --- */

/* The nodes of the 15 pairs: each node against the other triangle, each edge against each of the other's. */
enum { POINT_TRIANGLES = 6, PAIRS = 15 };

static cipc_pair_kind pair_nodes(int pair, int nodes[4])
{
    if (pair < POINT_TRIANGLES) {
        int other = pair < 3 ? 3 : 0;
        nodes[0] = pair;
        for (int k = 0; k < 3; k++) nodes[1 + k] = other + k;
        return CIPC_POINT_TRIANGLE;
    }
    int a = (pair - POINT_TRIANGLES) / 3, b = (pair - POINT_TRIANGLES) % 3;
    nodes[0] = a, nodes[1] = (a + 1) % 3;
    nodes[2] = 3 + b, nodes[3] = 3 + (b + 1) % 3;
    return CIPC_EDGE_EDGE;
}

static double rest_length2(const double *rest, int i, int j)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (rest[3 * i + k] - rest[3 * j + k]) * (rest[3 * i + k] - rest[3 * j + k]);
    return sum;
}

/* Do the edges get the mollifier, |a x b|^2 < eps? Asked of the oracle a little to both sides of eps: where the answers differ, the Hessian jumps and rounding decides
 * the side: INDETERMINATE. */
static cipc_verdict is_mollified(const double *y, double eps)
{
    const cipc_oracle_function *f = cipc_oracle_function_find("edge_edge_mollifier");
    double low = eps * (1 - 1e-6), high = eps * (1 + 1e-6), at_low, at_high;
    if (cipc_oracle_evaluate(f, y, &low, &at_low, NULL, NULL) != CIPC_YES || cipc_oracle_evaluate(f, y, &high, &at_high, NULL, NULL) != CIPC_YES) return CIPC_INDETERMINATE;
    if ((at_low < 1) != (at_high < 1)) return CIPC_INDETERMINATE;
    return at_low < 1 ? CIPC_YES : CIPC_NO;
}

/* What has been summed: numbers, their tolerances, and how near the nearest border between two features is (verify_neighbour_off). */
typedef struct truth_sums {
    sums sum;
    double value_tolerance, gradient_tolerance, hessian_tolerance, border;
} truth_sums;

/* Add one barrier by the oracle. nodes: of the energy's stencil. */
static bool add_term(truth_sums *t, const char *name, const double *x, const int *nodes, const double *fields)
{
    const cipc_oracle_function *f = cipc_oracle_function_find(name);
    double y[12], value, g[12], H[144], size = 0;
    int n = 3 * f->nodes;
    for (int k = 0; k < f->nodes; k++) memcpy(y + 3 * k, x + 3 * nodes[k], 3 * sizeof *y);
    for (int i = 0; i < n; i++) size = fmax(size, fabs(y[i] - y[i % 3]));
    if (cipc_oracle_evaluate(f, y, fields, &value, g, H) != CIPC_YES) return false;
    verify_tolerances tolerance = verify_tolerances_of(value, g, H, n, size, verify_hessian_change(f, y, fields, g, H, size, 0x5a3c96));
    scatter(&t->sum, nodes, f->nodes, value, g, H);
    t->value_tolerance += tolerance.value;
    t->gradient_tolerance += tolerance.gradient;
    t->hessian_tolerance += tolerance.hessian;
    return true;
}

/* The barrier of a pair within reach: that of its closest feature on the feature's nodes; near-parallel edges keep their four nodes and get the mollifier. */
static bool add_pair(truth_sums *t, const cipc_query *q, int pair)
{
    static const char *const names[CIPC_PAIR_KIND_COUNT] = {"barrier_point_point", "barrier_point_edge", "barrier_point_triangle", "barrier_edge_edge"};
    int nodes[4], part[4], first = 0;
    double y[12];
    unsigned features;
    cipc_pair_kind kind = pair_nodes(pair, nodes);
    for (int k = 0; k < 4; k++) memcpy(y + 3 * k, q->x + 3 * nodes[k], 3 * sizeof *y);
    if (cipc_exact_distance_sign(kind, y, q->thickness) <= 0) return false;
    if (cipc_exact_distance_gap(kind, y, q->thickness) >= q->params[VERIFY_DHAT]) return true;
    cipc_exact_distance2(kind, y, &features);
    t->border = fmin(t->border, verify_nearest_border(kind, y, features));
    while (!(features >> first & 1)) first++;
    cipc_feature feature = cipc_feature_at(kind, first);
    double eps = 0, fields[6] = {q->params[VERIFY_STIFFNESS], 1, q->thickness, q->params[VERIFY_DHAT], 0, first};
    if (kind == CIPC_EDGE_EDGE) {
        eps = MOLLIFIER_SHARE * rest_length2(q->rest, nodes[0], nodes[1]) * rest_length2(q->rest, nodes[2], nodes[3]);
        cipc_verdict mollified = is_mollified(y, eps);
        if (mollified == CIPC_INDETERMINATE) return false;
        if (mollified == CIPC_YES) {
            fields[4] = eps;
            return add_term(t, names[CIPC_EDGE_EDGE], q->x, nodes, fields);
        }
    }
    for (int k = 0; k < feature.count; k++) part[k] = nodes[feature.local[k]];
    fields[5] = cipc_feature_count(CIPC_EDGE_EDGE) - 1; /* of an edge-edge barrier: the insides */
    return add_term(t, names[feature.kind], q->x, part, fields);
}

bool verify_two_triangles_truth(const cipc_query *q, json_t *want)
{
    truth_sums t = {.border = INFINITY};
    bool good = true;
    for (int i = 0; i < PAIRS; i++)
        if (!add_pair(&t, q, i)) return false;
    verify_put_numbers(want, "value", &t.sum.value, 1, t.value_tolerance, &good);
    verify_put_numbers(want, "gradient", t.sum.g, N, t.gradient_tolerance, &good);
    if (isfinite(t.hessian_tolerance)) verify_put_numbers(want, "hessian", t.sum.H, N * N, t.hessian_tolerance, &good);
    if (isfinite(t.border)) cipc_json_put(want, "border", cipc_json_number(t.border), &good);
    return good;
}

/* --- inputs --- */

/* Two triangles across a gap, one above the other: sometimes with the same outline, so that edges are near-parallel and features nearly tie. */
void verify_two_triangles_draw(gsl_rng *rng, cipc_query *q)
{
    static const double corner[6] = {0, 0, 1, 0, 0, 1};
    double dhat = verify_log_uniform(rng, 1e-3, 0.5), gap = dhat * verify_log_uniform(rng, 1e-6, 0.9), slope = verify_chance(rng, 0.5) ? 0 : dhat;
    double spread = verify_chance(rng, 0.3) ? verify_log_uniform(rng, 1e-6, 1e-2) : 0.5;
    int up = verify_index(rng, 3);
    q->thickness = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-3, 0.2);
    q->params[VERIFY_DHAT] = dhat;
    q->params[VERIFY_STIFFNESS] = verify_log_uniform(rng, 1, 1e9);
    for (int i = 0; i < NODES; i++) {
        double *x = q->x + 3 * i;
        double height = slope * verify_uniform(rng, 0, 1);
        x[(up + 1) % 3] = corner[2 * (i % 3)] + verify_uniform(rng, -spread, spread) * 0.5;
        x[(up + 2) % 3] = corner[2 * (i % 3) + 1] + verify_uniform(rng, -spread, spread) * 0.5;
        x[up] = i < 3 ? -height : q->thickness + gap + height;
    }
    for (int i = 0; i < N; i++) q->rest[i] = q->x[i] + verify_uniform(rng, -0.05, 0.05);
}
