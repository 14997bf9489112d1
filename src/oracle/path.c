/* Straight motion in integers, and the polynomials of its feature pairs (docs/theory/oracle_impact.md, section 1). */
#include "oracle/path.h"

#include <math.h>

/* t_max = mantissa * 2^exponent: P := mantissa P, and the unit of X is made finer so that P's power of two is an integer's. */
static void scale_time(oracle_path *path, double t_max, mpz_t xi)
{
    mpz_t mantissa;
    mpz_init(mantissa);
    int shift = t_max == 0 ? 0 : cipc_common_exponent(&t_max, 1, 0); /* <= 0 */
    cipc_integer_from_double(mantissa, t_max, shift);
    for (int i = 0; i < cipc_pair_nodes(path->kind); i++) {
        for (int k = 0; k < 3; k++) {
            mpz_mul(path->P[i].c[k], path->P[i].c[k], mantissa);
            mpz_mul_2exp(path->X[i].c[k], path->X[i].c[k], (mp_bitcnt_t)-shift);
        }
    }
    mpz_mul_2exp(xi, xi, (mp_bitcnt_t)-shift);
    path->exponent += shift;
    mpz_clear(mantissa);
}

void oracle_path_localize(oracle_path *path)
{
    for (int i = cipc_pair_nodes(path->kind) - 1; i >= 0; i--) {
        cipc_integer3_sub(&path->X[i], &path->X[i], &path->X[0]);
        cipc_integer3_sub(&path->P[i], &path->P[i], &path->P[0]);
    }
}

void oracle_path_init_empty(oracle_path *path, cipc_pair_kind kind)
{
    path->kind = kind;
    oracle_search_init(&path->search);
    for (int i = 0; i < 4; i++) {
        cipc_integer3_init(&path->X[i]);
        cipc_integer3_init(&path->P[i]);
    }
}

bool oracle_path_init(oracle_path *path, const cipc_stencil_path *motion, double thickness, double t_max, mpz_t xi)
{
    int nodes = cipc_pair_nodes(motion->kind);
    oracle_path_init_empty(path, motion->kind);
    if (!cipc_all_finite(motion->x, 3 * nodes) || !cipc_all_finite(motion->p, 3 * nodes) || !(thickness >= 0) || !isfinite(thickness) ||
        !(t_max >= 0 && t_max <= 1)) {
        return false;
    }
    path->exponent = cipc_common_exponent(motion->p, 3 * nodes, cipc_common_exponent(motion->x, 3 * nodes, cipc_common_exponent(&thickness, 1, 0)));
    for (int i = 0; i < nodes; i++) {
        cipc_integer3_from_doubles(&path->X[i], &motion->x[3 * i], path->exponent);
        cipc_integer3_from_doubles(&path->P[i], &motion->p[3 * i], path->exponent);
        if (motion->to_end) cipc_integer3_sub(&path->P[i], &path->P[i], &path->X[i]);
    }
    cipc_integer_from_double(xi, thickness, path->exponent);
    oracle_path_localize(path);
    scale_time(path, t_max, xi);
    return true;
}

void oracle_path_clear(oracle_path *path)
{
    oracle_search_clear(&path->search);
    for (int i = 0; i < 4; i++) {
        cipc_integer3_clear(&path->X[i]);
        cipc_integer3_clear(&path->P[i]);
    }
}

void oracle_path_search_at(oracle_path *path, const mpz_t numerator, unsigned long bits)
{
    for (int i = 0; i < cipc_pair_nodes(path->kind); i++) {
        for (int k = 0; k < 3; k++) {
            mpz_ptr node = path->search.node[i].c[k];
            mpz_mul_2exp(node, path->X[i].c[k], bits);
            mpz_addmul(node, path->P[i].c[k], numerator);
        }
    }
    oracle_search_run(&path->search, path->kind);
}

int oracle_path_compare_at_ratio(oracle_path *path, const mpz_t xi, const mpz_t numerator, const mpz_t denominator)
{
    mpz_t scaled;
    mpz_init(scaled);
    for (int i = 0; i < cipc_pair_nodes(path->kind); i++) {
        for (int k = 0; k < 3; k++) {
            mpz_ptr node = path->search.node[i].c[k];
            mpz_mul(node, path->X[i].c[k], denominator);
            mpz_addmul(node, path->P[i].c[k], numerator);
        }
    }
    oracle_search_run(&path->search, path->kind);
    mpz_mul(scaled, xi, denominator);
    int sign = oracle_search_compare(&path->search, scaled);
    mpz_clear(scaled);
    return sign;
}

int oracle_path_compare_at(oracle_path *path, const mpz_t xi, const mpz_t numerator, unsigned long bits)
{
    mpz_t scaled;
    mpz_init(scaled);
    mpz_mul_2exp(scaled, xi, bits);
    oracle_path_search_at(path, numerator, bits);
    int sign = oracle_search_compare(&path->search, scaled);
    mpz_clear(scaled);
    return sign;
}

/* --- vectors of polynomials --- */

typedef struct vector {
    oracle_polynomial c[3];
} vector;

static void vector_init(vector *v)
{
    for (int k = 0; k < 3; k++) oracle_polynomial_init(&v->c[k]);
}

static void vector_clear(vector *v)
{
    for (int k = 0; k < 3; k++) oracle_polynomial_clear(&v->c[k]);
}

/* x_i(s) - x_j(s). */
static void difference(vector *v, const oracle_path *path, int i, int j)
{
    for (int k = 0; k < 3; k++) {
        mpz_sub(v->c[k].c[0], path->X[i].c[k], path->X[j].c[k]);
        mpz_sub(v->c[k].c[1], path->P[i].c[k], path->P[j].c[k]);
        oracle_polynomial_trim(&v->c[k]);
    }
}

static void cross(vector *r, const vector *a, const vector *b)
{
    oracle_polynomial term;
    oracle_polynomial_init(&term);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        oracle_polynomial_mul(&r->c[k], &a->c[i], &b->c[j]);
        oracle_polynomial_mul(&term, &a->c[j], &b->c[i]);
        oracle_polynomial_sub(&r->c[k], &r->c[k], &term);
    }
    oracle_polynomial_clear(&term);
}

static void dot(oracle_polynomial *r, const vector *a, const vector *b)
{
    oracle_polynomial term, sum;
    oracle_polynomial_init(&term);
    oracle_polynomial_init(&sum);
    for (int k = 0; k < 3; k++) {
        oracle_polynomial_mul(&term, &a->c[k], &b->c[k]);
        oracle_polynomial_add(&sum, &sum, &term);
    }
    oracle_polynomial_set(r, &sum);
    oracle_polynomial_clear(&term);
    oracle_polynomial_clear(&sum);
}

/* --- distances of flats --- */

void oracle_flat_distance_init(oracle_flat_distance *d)
{
    d->has_height = false;
    oracle_polynomial_init(&d->square);
    oracle_polynomial_init(&d->height);
    oracle_polynomial_init(&d->norm2);
}

void oracle_flat_distance_clear(oracle_flat_distance *d)
{
    oracle_polynomial_clear(&d->square);
    oracle_polynomial_clear(&d->height);
    oracle_polynomial_clear(&d->norm2);
}

void oracle_path_flat_distance(const oracle_path *path, const cipc_feature *feature, oracle_flat_distance *d)
{
    const int *node = feature->local;
    vector u, a, b, n;
    vector_init(&u);
    vector_init(&a);
    vector_init(&b);
    vector_init(&n);
    d->has_height = feature->count == 4;
    if (feature->kind == CIPC_POINT_POINT) { /* |x_i - x_j|^2 / 1 */
        difference(&u, path, node[0], node[1]);
        dot(&d->square, &u, &u);
        mpz_set_ui(d->norm2.c[0], 1);
        oracle_polynomial_trim(&d->norm2);
    } else if (feature->kind == CIPC_POINT_EDGE) { /* |u x a|^2 / |a|^2 */
        difference(&u, path, node[0], node[1]);
        difference(&a, path, node[2], node[1]);
        cross(&n, &u, &a);
        dot(&d->square, &n, &n);
        dot(&d->norm2, &a, &a);
    } else { /* (u.n)^2 / |n|^2, n = a x b */
        bool plane = feature->kind == CIPC_POINT_TRIANGLE;
        difference(&u, path, node[0], node[plane ? 1 : 2]);
        difference(&a, path, node[plane ? 2 : 1], node[plane ? 1 : 0]);
        difference(&b, path, node[3], node[plane ? 1 : 2]);
        cross(&n, &a, &b);
        dot(&d->height, &u, &n);
        dot(&d->norm2, &n, &n);
    }
    vector_clear(&u);
    vector_clear(&a);
    vector_clear(&b);
    vector_clear(&n);
}

void oracle_path_speed(const oracle_path *path, mpz_t speed)
{
    mpz_t most, square;
    mpz_inits(most, square, NULL);
    mpz_set_ui(speed, 0);
    int nodes = cipc_pair_nodes(path->kind), first = cipc_pair_first_nodes(path->kind);
    for (int side = 0; side < 2; side++) {
        mpz_set_ui(most, 0);
        for (int i = side ? first : 0; i < (side ? nodes : first); i++) {
            cipc_integer3_dot(square, &path->P[i], &path->P[i]);
            if (mpz_cmp(square, most) > 0) mpz_set(most, square);
        }
        mpz_sqrt(most, most); /* rounded down: one more is above */
        mpz_add(speed, speed, most);
        mpz_add_ui(speed, speed, 1);
    }
    mpz_clears(most, square, NULL);
}
