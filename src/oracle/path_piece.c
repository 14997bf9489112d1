/* A piece of paths with breaks, in integers (docs/theory/oracle_impact.md, section 6).
 *
 * Node i is at x at its own time a_i and at p at b_i. At a time t between them it is at x + (t - a_i)/(b_i - a_i) (p - x): a ratio of integers. Times the least
 * common multiple D of all b_i - a_i, places and displacements of all nodes are integers again, and so is the thickness. */
#include "oracle/path.h"

#include <math.h>

/* The times of a piece as integers of one unit: those of the piece and those of one node after another. */
typedef struct piece_times {
    int exponent;
    mpz_t begin, end, start[4], length[4]; /* length 0: the node stays where it is */
    mpz_t common;                          /* D */
} piece_times;

static bool is_sound(const cipc_stencil_piece *piece)
{
    int nodes = cipc_pair_nodes(piece->kind);
    bool sound = piece->begin <= piece->end && cipc_all_finite(&piece->begin, 1) && cipc_all_finite(&piece->end, 1);
    sound = sound && cipc_all_finite(piece->start, nodes) && cipc_all_finite(piece->stop, nodes);
    sound = sound && cipc_all_finite(piece->x, 3 * nodes) && cipc_all_finite(piece->p, 3 * nodes);
    for (int i = 0; sound && i < nodes; i++) {
        sound = piece->start[i] <= piece->begin && piece->end <= piece->stop[i];
        for (int k = 3 * i; k < 3 * i + 3; k++) sound = sound && (piece->start[i] < piece->stop[i] || piece->x[k] == piece->p[k]);
    }
    return sound;
}

static void times_init(piece_times *t, const cipc_stencil_piece *piece)
{
    int nodes = cipc_pair_nodes(piece->kind);
    mpz_inits(t->begin, t->end, NULL);
    mpz_init_set_ui(t->common, 1);
    t->exponent = cipc_common_exponent(piece->start, nodes, cipc_common_exponent(piece->stop, nodes, 0));
    t->exponent = cipc_common_exponent(&piece->begin, 1, cipc_common_exponent(&piece->end, 1, t->exponent));
    cipc_integer_from_double(t->begin, piece->begin, t->exponent);
    cipc_integer_from_double(t->end, piece->end, t->exponent);
    for (int i = 0; i < nodes; i++) {
        mpz_inits(t->start[i], t->length[i], NULL);
        cipc_integer_from_double(t->start[i], piece->start[i], t->exponent);
        cipc_integer_from_double(t->length[i], piece->stop[i], t->exponent);
        mpz_sub(t->length[i], t->length[i], t->start[i]);
        if (mpz_sgn(t->length[i]) > 0) mpz_lcm(t->common, t->common, t->length[i]);
    }
}

static void times_clear(piece_times *t, int nodes)
{
    mpz_clears(t->begin, t->end, t->common, NULL);
    for (int i = 0; i < nodes; i++) mpz_clears(t->start[i], t->length[i], NULL);
}

/* X = D x + D/(b - a) (begin - a) (p - x), P = D/(b - a) (end - begin) (p - x). */
static void place_node(oracle_path *path, int i, const cipc_stencil_piece *piece, const piece_times *t)
{
    mpz_t before, during, way;
    mpz_inits(before, during, way, NULL);
    if (mpz_sgn(t->length[i]) > 0) {
        mpz_divexact(way, t->common, t->length[i]);
        mpz_sub(before, t->begin, t->start[i]);
        mpz_mul(before, before, way);
        mpz_sub(during, t->end, t->begin);
        mpz_mul(during, during, way);
    }
    for (int k = 0; k < 3; k++) {
        cipc_integer_from_double(path->X[i].c[k], piece->x[3 * i + k], path->exponent);
        cipc_integer_from_double(way, piece->p[3 * i + k], path->exponent);
        mpz_sub(way, way, path->X[i].c[k]);
        mpz_mul(path->X[i].c[k], path->X[i].c[k], t->common);
        mpz_addmul(path->X[i].c[k], before, way);
        mpz_mul(path->P[i].c[k], during, way);
    }
    mpz_clears(before, during, way, NULL);
}

bool oracle_path_init_piece(oracle_path *path, const cipc_stencil_piece *piece, double thickness, mpz_t xi)
{
    int nodes = cipc_pair_nodes(piece->kind);
    oracle_path_init_empty(path, piece->kind);
    if (!is_sound(piece) || !(thickness >= 0) || !isfinite(thickness)) return false;
    piece_times t;
    times_init(&t, piece);
    path->exponent = cipc_common_exponent(piece->p, 3 * nodes, cipc_common_exponent(piece->x, 3 * nodes, cipc_common_exponent(&thickness, 1, 0)));
    for (int i = 0; i < nodes; i++) place_node(path, i, piece, &t);
    cipc_integer_from_double(xi, thickness, path->exponent);
    mpz_mul(xi, xi, t.common);
    oracle_path_localize(path);
    times_clear(&t, nodes);
    return true;
}
