/* Exact squared distance of a stencil in integers (SPEC V.2).
 *
 * d^2 is the least of a few candidates, each the squared distance to a point that really lies on the primitive. In integer coordinates
 * each candidate is a ratio numerator / denominator of integers:
 *   point-point           |p - q|^2 / 1
 *   point-edge            |(p - e0) x d|^2 / |d|^2,  d = e1 - e0,   if 0 < (p - e0).d < |d|^2
 *   point-triangle inside ((p - t0).n)^2 / |n|^2,    n = (t1 - t0) x (t2 - t0), if n != 0 and all three barycentrics are positive
 *   edge-edge inside      ((b0 - a0).n)^2 / |n|^2,   n = (a1 - a0) x (b1 - b0), if n != 0 and both line parameters are in (0, 1) */
#include "oracle/exact_search.h"

void oracle_search_init(oracle_search *f)
{
    for (int i = 0; i < 4; i++) cipc_integer3_init(&f->node[i]);
    cipc_integer3 *vectors[] = {&f->u, &f->v, &f->w, &f->n, &f->s};
    for (int i = 0; i < 5; i++) cipc_integer3_init(vectors[i]);
    mpz_inits(f->numerator, f->denominator, f->least_numerator, f->least_denominator, f->p, f->q, NULL);
    f->features = 0;
}

void oracle_search_clear(oracle_search *f)
{
    for (int i = 0; i < 4; i++) cipc_integer3_clear(&f->node[i]);
    cipc_integer3 *vectors[] = {&f->u, &f->v, &f->w, &f->n, &f->s};
    for (int i = 0; i < 5; i++) cipc_integer3_clear(vectors[i]);
    mpz_clears(f->numerator, f->denominator, f->least_numerator, f->least_denominator, f->p, f->q, NULL);
}

/* Keep the candidate if it is less than the least: n/d < N/D <=> n D < N d; an equal one joins the set. */
static void offer_candidate(oracle_search *f, int feature)
{
    int order = -1;
    if (f->features != 0) {
        mpz_mul(f->p, f->numerator, f->least_denominator);
        mpz_mul(f->q, f->least_numerator, f->denominator);
        order = mpz_cmp(f->p, f->q);
    }
    if (order > 0) return;
    f->features = (order < 0 ? 0u : f->features) | 1u << feature;
    if (order == 0) return;
    mpz_set(f->least_numerator, f->numerator);
    mpz_set(f->least_denominator, f->denominator);
}

static void offer_point_point(oracle_search *f, int feature, int i, int j)
{
    cipc_integer3_sub(&f->u, &f->node[i], &f->node[j]);
    cipc_integer3_dot(f->numerator, &f->u, &f->u);
    mpz_set_ui(f->denominator, 1);
    offer_candidate(f, feature);
}

static void offer_point_edge(oracle_search *f, int feature, int point, int e0, int e1)
{
    cipc_integer3_sub(&f->v, &f->node[e1], &f->node[e0]);
    cipc_integer3_sub(&f->u, &f->node[point], &f->node[e0]);
    cipc_integer3_dot(f->denominator, &f->v, &f->v);
    cipc_integer3_dot(f->p, &f->u, &f->v);
    if (mpz_sgn(f->p) <= 0 || mpz_cmp(f->p, f->denominator) >= 0) return; /* the foot is not inside the edge, or the edge has no length */
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->numerator, &f->n, &f->n);
    offer_candidate(f, feature);
}

/* The candidate (w.n)^2 / |n|^2 for the n and w of the search. */
static void offer_normal(oracle_search *f, int feature)
{
    cipc_integer3_dot(f->p, &f->w, &f->n);
    mpz_mul(f->numerator, f->p, f->p);
    offer_candidate(f, feature);
}

/* (a x b).n into r; uses s. */
static void triple(oracle_search *f, mpz_t r, const cipc_integer3 *a, const cipc_integer3 *b)
{
    cipc_integer3_cross(&f->s, a, b);
    cipc_integer3_dot(r, &f->s, &f->n);
}

static void offer_triangle_interior(oracle_search *f, int feature)
{
    cipc_integer3_sub(&f->u, &f->node[2], &f->node[1]);
    cipc_integer3_sub(&f->v, &f->node[3], &f->node[1]);
    cipc_integer3_sub(&f->w, &f->node[0], &f->node[1]);
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->denominator, &f->n, &f->n);
    /* Barycentric coordinates times |n|^2: beta1 = (w x v).n, beta2 = (u x w).n, beta0 = |n|^2 - beta1 - beta2. */
    triple(f, f->p, &f->w, &f->v);
    triple(f, f->q, &f->u, &f->w);
    bool positive = mpz_sgn(f->p) > 0 && mpz_sgn(f->q) > 0;
    mpz_add(f->p, f->p, f->q);
    if (positive && mpz_cmp(f->p, f->denominator) < 0) offer_normal(f, feature);
}

static void offer_edges_interior(oracle_search *f, int feature)
{
    cipc_integer3_sub(&f->u, &f->node[1], &f->node[0]);
    cipc_integer3_sub(&f->v, &f->node[3], &f->node[2]);
    cipc_integer3_sub(&f->w, &f->node[2], &f->node[0]);
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->denominator, &f->n, &f->n);
    /* Parameters of the closest points of the lines, times |n|^2: (w x v).n on the first, (w x u).n on the second. */
    triple(f, f->p, &f->w, &f->v);
    triple(f, f->q, &f->w, &f->u);
    if (mpz_sgn(f->p) > 0 && mpz_cmp(f->p, f->denominator) < 0 && mpz_sgn(f->q) > 0 && mpz_cmp(f->q, f->denominator) < 0) {
        offer_normal(f, feature);
    }
}

void oracle_search_run(oracle_search *f, cipc_pair_kind kind)
{
    f->features = 0;
    for (int i = 0; i < cipc_feature_count(kind); i++) {
        cipc_feature feature = cipc_feature_at(kind, i);
        switch (feature.kind) {
        case CIPC_POINT_POINT: offer_point_point(f, i, feature.local[0], feature.local[1]); break;
        case CIPC_POINT_EDGE: offer_point_edge(f, i, feature.local[0], feature.local[1], feature.local[2]); break;
        case CIPC_POINT_TRIANGLE: offer_triangle_interior(f, i); break;
        default: offer_edges_interior(f, i); break;
        }
    }
}

int oracle_search_compare(oracle_search *f, const mpz_t xi)
{
    mpz_mul(f->p, xi, xi);
    mpz_mul(f->p, f->p, f->least_denominator);
    return mpz_cmp(f->least_numerator, f->p);
}
