/* The solver's own answers to queries. */
#include <string.h>

#include "base/json_number.h"
#include "cipc/contact.h"
#include "verify/conformance.h"
#include "verify/distance.h"
#include "verify/energies.h"
#include "verify/truth.h"
#include "verify/two_triangles.h"

static json_t *scalar_answer(const cipc_query *q, bool *good)
{
    double f[3] = {0, 0, 0};
    json_t *got = json_object();
    if (strcmp(q->fn, "barrier") == 0) cipc_barrier(q->x[0], q->x[1], f);
    else if (strcmp(q->fn, "strain_limit_barrier") == 0) cipc_strain_limit_barrier(q->x[0], q->x[1], q->x[2], f);
    else cipc_friction_mollifier(q->x[0], q->x[1], f);
    cipc_json_put(got, "f", verify_numbers_json(f, 3), good);
    return got;
}

static void put_derivatives(json_t *got, double value, const double *g, const double *H, int n, bool *good)
{
    cipc_json_put(got, "value", cipc_json_number(value), good);
    cipc_json_put(got, "gradient", verify_numbers_json(g, n), good);
    cipc_json_put(got, "hessian", verify_numbers_json(H, n * n), good);
}

/* The feature's derivatives in the places of its nodes. */
void verify_scatter(const cipc_feature *feature, int n, const double *g, const double *H, double *whole_g, double *whole_H)
{
    int m = 3 * feature->count;
    memset(whole_g, 0, (size_t)n * sizeof *whole_g);
    memset(whole_H, 0, (size_t)(n * n) * sizeof *whole_H);
    for (int i = 0; i < m; i++) {
        int r = 3 * feature->local[i / 3] + i % 3;
        whole_g[r] = g[i];
        for (int j = 0; j < m; j++) whole_H[r * n + 3 * feature->local[j / 3] + j % 3] = H[i * m + j];
    }
}

static json_t *distance_answer(const cipc_query *q, cipc_pair_kind kind, bool *good)
{
    double value, g[12], H[144];
    json_t *got = json_object();
    cipc_feature feature = verify_distance_of_the_solver.feature(kind, q->x);
    switch (kind) {
    case CIPC_POINT_POINT:
        value = cipc_point_point_distance2_value(q->x);
        cipc_point_point_distance2_gradient(q->x, g);
        cipc_point_point_distance2_hessian(q->x, H);
        break;
    case CIPC_POINT_EDGE:
        value = cipc_point_edge_distance2(q->x);
        cipc_point_edge_distance2_gradient(q->x, g);
        cipc_point_edge_distance2_hessian(q->x, H);
        break;
    case CIPC_POINT_TRIANGLE:
        value = cipc_point_triangle_distance2(q->x);
        cipc_point_triangle_distance2_gradient(q->x, g);
        cipc_point_triangle_distance2_hessian(q->x, H);
        break;
    default:
        value = cipc_edge_edge_distance2(q->x);
        cipc_edge_edge_distance2_gradient(q->x, g);
        cipc_edge_edge_distance2_hessian(q->x, H);
        break;
    }
    put_derivatives(got, value, g, H, 3 * cipc_pair_nodes(kind), good);
    cipc_json_put(got, "feature", json_string(cipc_feature_name(kind, cipc_feature_index(kind, &feature))), good);
    return got;
}

static json_t *energy_answer(const cipc_query *q, bool *good)
{
    const cipc_energy *energy = cipc_energy_find(q->fn + 7);
    verify_params params;
    double g[12], H[144];
    json_t *got = json_object();
    cipc_energy_params(energy, q->params, &params);
    energy->gradient(q->x, &params, g);
    energy->hessian(q->x, &params, H);
    put_derivatives(got, energy->value(q->x, &params), g, H, 3 * energy->nodes, good);
    return got;
}

void verify_query_path(const cipc_query *q, cipc_pair_kind kind, cipc_stencil_path *path)
{
    *path = (cipc_stencil_path){.kind = kind, .to_end = !q->displacement};
    memcpy(path->x, q->x, sizeof path->x);
    memcpy(path->p, q->x1, sizeof path->p);
}

static json_t *toi_answer(const cipc_query *q, cipc_pair_kind kind, bool *good)
{
    cipc_stencil_path path;
    cipc_ccd_options options = cipc_ccd_options_default();
    json_t *got = json_object();
    options.slackness = q->scale;
    verify_query_path(q, kind, &path);
    cipc_ccd_result r = cipc_certified_ccd(&path, q->thickness, 1, &options);
    cipc_json_put(got, "toi", cipc_json_number(r.toi), good);
    cipc_json_put(got, "hit", json_boolean(r.hit), good);
    return got;
}

json_t *verify_answer(const cipc_query *q)
{
    bool good = true;
    cipc_pair_kind kind;
    json_t *got;
    if (verify_query_kind(q->fn, "toi_", &kind)) {
        got = toi_answer(q, kind, &good);
    } else if (verify_query_kind(q->fn, "distance2_", &kind)) {
        got = distance_answer(q, kind, &good);
    } else if (verify_function_level(q->fn) == 2) {
        got = energy_answer(q, &good);
    } else if (verify_function_level(q->fn) == 4) {
        got = verify_two_triangles_answer(q, &good);
    } else if (verify_function_level(q->fn) == 0) {
        got = scalar_answer(q, &good);
    } else if (strcmp(q->fn, "orient3d") == 0) {
        got = json_object();
        cipc_json_put(got, "sign", json_integer(cipc_orient3d(q->x, q->x + 3, q->x + 6, q->x + 9)), &good);
    } else {
        got = json_object();
        cipc_json_put(got, "intersects", json_boolean(cipc_edge_triangle_intersect(q->x, q->x + 6)), &good);
    }
    if (!good) json_decref(got);
    return good ? got : NULL;
}
