/* Integer polynomials and the exact isolation of their roots in (0, 1] by Descartes' rule and bisection (docs/theory/oracle_impact.md, sections 2, 3). */
#include "oracle/polynomial.h"

#include <math.h>

/* Intervals are halved this often before repeated roots are suspected; then the polynomial is made square-free. */
enum { SUSPICION_DEPTH = 12 };
/* And this often at all: the recursion is as deep. Roots of a square-free polynomial that are nearer than 2^-4000 to one another would be reported as beyond
 * the cap; coordinates from 2^-300 to 2^300 can come near it in theory only. */
enum { DEPTH_LIMIT = 4000 };

void oracle_polynomial_init(oracle_polynomial *p)
{
    p->degree = -1;
    for (int i = 0; i <= ORACLE_DEGREE_LIMIT; i++) mpz_init(p->c[i]);
}

void oracle_polynomial_clear(oracle_polynomial *p)
{
    for (int i = 0; i <= ORACLE_DEGREE_LIMIT; i++) mpz_clear(p->c[i]);
}

/* Set the degree; what is above it becomes 0. */
static void cut(oracle_polynomial *p, int degree, int old_degree)
{
    for (int i = degree + 1; i <= old_degree; i++) mpz_set_ui(p->c[i], 0);
    p->degree = degree;
    while (p->degree >= 0 && mpz_sgn(p->c[p->degree]) == 0) p->degree--;
}

void oracle_polynomial_trim(oracle_polynomial *p) { cut(p, ORACLE_DEGREE_LIMIT, ORACLE_DEGREE_LIMIT); }

void oracle_polynomial_set(oracle_polynomial *r, const oracle_polynomial *a)
{
    if (r == a) return;
    for (int i = 0; i <= a->degree; i++) mpz_set(r->c[i], a->c[i]);
    cut(r, a->degree, r->degree);
}

static int larger(int a, int b) { return a > b ? a : b; }

void oracle_polynomial_add(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b)
{
    int degree = larger(a->degree, b->degree);
    for (int i = 0; i <= degree; i++) mpz_add(r->c[i], a->c[i], b->c[i]);
    cut(r, degree, r->degree);
}

void oracle_polynomial_sub(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b)
{
    int degree = larger(a->degree, b->degree);
    for (int i = 0; i <= degree; i++) mpz_sub(r->c[i], a->c[i], b->c[i]);
    cut(r, degree, r->degree);
}

void oracle_polynomial_mul(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b)
{
    if (a->degree < 0 || b->degree < 0) {
        cut(r, -1, r->degree);
        return;
    }
    mpz_t product[ORACLE_DEGREE_LIMIT + 1];
    int degree = a->degree + b->degree;
    for (int i = 0; i <= degree; i++) mpz_init(product[i]);
    for (int i = 0; i <= a->degree; i++)
        for (int j = 0; j <= b->degree; j++) mpz_addmul(product[i + j], a->c[i], b->c[j]);
    for (int i = 0; i <= degree; i++) {
        mpz_swap(r->c[i], product[i]);
        mpz_clear(product[i]);
    }
    cut(r, degree, r->degree);
}

void oracle_polynomial_scale(oracle_polynomial *r, const oracle_polynomial *a, const mpz_t factor)
{
    int degree = a->degree;
    for (int i = 0; i <= degree; i++) mpz_mul(r->c[i], a->c[i], factor);
    cut(r, degree, r->degree);
}

void oracle_polynomial_derivative(oracle_polynomial *r, const oracle_polynomial *a)
{
    int degree = a->degree;
    for (int i = 1; i <= degree; i++) mpz_mul_ui(r->c[i - 1], a->c[i], (unsigned long)i);
    cut(r, degree - 1, larger(r->degree, degree));
}

/* --- square-free part: a / gcd(a, a') --- */

/* Divide by the greatest common divisor of the coefficients. */
static void make_primitive(oracle_polynomial *p)
{
    mpz_t content;
    mpz_init(content);
    for (int i = 0; i <= p->degree; i++) mpz_gcd(content, content, p->c[i]);
    for (int i = 0; i <= p->degree; i++) mpz_divexact(p->c[i], p->c[i], content);
    mpz_clear(content);
}

/* a := remainder of lead(b)^k a divided by b. */
static void pseudo_remainder(oracle_polynomial *a, const oracle_polynomial *b)
{
    mpz_t lead;
    mpz_init(lead);
    while (a->degree >= b->degree) {
        int shift = a->degree - b->degree, old = a->degree;
        mpz_set(lead, a->c[a->degree]);
        for (int i = 0; i < old; i++) mpz_mul(a->c[i], a->c[i], b->c[b->degree]);
        for (int i = 0; i < b->degree; i++) mpz_submul(a->c[i + shift], lead, b->c[i]);
        cut(a, old - 1, old);
    }
    mpz_clear(lead);
}

/* r := a / b, up to a constant factor; b divides a. */
static void exact_quotient(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b)
{
    oracle_polynomial rest;
    oracle_polynomial_init(&rest);
    oracle_polynomial_set(&rest, a);
    int degree = a->degree - b->degree;
    cut(r, -1, r->degree);
    while (rest.degree >= b->degree) {
        int shift = rest.degree - b->degree, old = rest.degree;
        /* rest := lead(b) rest - lead(rest) s^shift b; the quotient so far is multiplied by lead(b) too. */
        for (int i = 0; i <= degree; i++) mpz_mul(r->c[i], r->c[i], b->c[b->degree]);
        mpz_set(r->c[shift], rest.c[old]);
        for (int i = 0; i < old; i++) mpz_mul(rest.c[i], rest.c[i], b->c[b->degree]);
        for (int i = 0; i < b->degree; i++) mpz_submul(rest.c[i + shift], r->c[shift], b->c[i]);
        cut(&rest, old - 1, old);
    }
    cut(r, degree, degree);
    oracle_polynomial_clear(&rest);
    make_primitive(r);
}

void oracle_polynomial_square_free(oracle_polynomial *r, const oracle_polynomial *a)
{
    oracle_polynomial u, v;
    oracle_polynomial_init(&u);
    oracle_polynomial_init(&v);
    oracle_polynomial_set(&u, a);
    oracle_polynomial_derivative(&v, a);
    oracle_polynomial *x = &u, *y = &v;
    while (y->degree >= 0) { /* Euclid, with primitive remainders */
        make_primitive(y);
        pseudo_remainder(x, y);
        oracle_polynomial *rest = x;
        x = y;
        y = rest;
    }
    if (x->degree > 0) {
        oracle_polynomial copy;
        oracle_polynomial_init(&copy);
        exact_quotient(&copy, a, x);
        oracle_polynomial_set(r, &copy);
        oracle_polynomial_clear(&copy);
    } else {
        oracle_polynomial_set(r, a);
    }
    oracle_polynomial_clear(&u);
    oracle_polynomial_clear(&v);
}

/* --- evaluation and changes of variable --- */

int oracle_polynomial_sign_at(const oracle_polynomial *p, const mpz_t numerator, unsigned long bits)
{
    if (p->degree < 0) return 0;
    mpz_t value, term;
    mpz_inits(value, term, NULL);
    mpz_set(value, p->c[p->degree]);
    for (int i = p->degree - 1; i >= 0; i--) { /* Horner, times 2^bits a step */
        mpz_mul(value, value, numerator);
        mpz_mul_2exp(term, p->c[i], bits * (unsigned long)(p->degree - i));
        mpz_add(value, value, term);
    }
    int sign = mpz_sgn(value);
    mpz_clears(value, term, NULL);
    return sign;
}

/* p(s) := p(s + 1). */
static void shift_by_one(oracle_polynomial *p)
{
    for (int i = 0; i < p->degree; i++)
        for (int j = p->degree - 1; j >= i; j--) mpz_add(p->c[j], p->c[j], p->c[j + 1]);
}

/* p(s) := 2^n p(s / 2), n the degree. */
static void halve(oracle_polynomial *p)
{
    for (int i = 0; i < p->degree; i++) mpz_mul_2exp(p->c[i], p->c[i], (mp_bitcnt_t)(p->degree - i));
}

/* p(s) := 2^(bits n) p((s + numerator) / 2^bits). */
static void zoom(oracle_polynomial *p, const mpz_t numerator, unsigned long bits)
{
    int n = p->degree;
    for (int i = 0; i < n; i++) mpz_mul_2exp(p->c[i], p->c[i], bits * (unsigned long)(n - i));
    for (int i = 0; i < n; i++)
        for (int j = n - 1; j >= i; j--) mpz_addmul(p->c[j], p->c[j + 1], numerator);
}

/* Common power of two out of the coefficients: they do not grow without need. */
static void drop_power_of_two(oracle_polynomial *p)
{
    mp_bitcnt_t least = ~(mp_bitcnt_t)0;
    for (int i = 0; i <= p->degree; i++) {
        if (mpz_sgn(p->c[i]) != 0) {
            mp_bitcnt_t zeros = mpz_scan1(p->c[i], 0);
            least = zeros < least ? zeros : least;
        }
    }
    if (p->degree < 0 || least == 0) return;
    for (int i = 0; i <= p->degree; i++) mpz_tdiv_q_2exp(p->c[i], p->c[i], least);
}

/* Sign changes of the Bernstein coefficients over [0, 1] (times positive binomials): sum_j b_j s^j (1-s)^(n-j), which are those of (1+s)^n p(1/(1+s)). */
static int variations(const oracle_polynomial *p, bool *has_zero_end)
{
    mpz_t b[ORACLE_DEGREE_LIMIT + 1];
    int n = p->degree, changes = 0, last = 0;
    for (int i = 0; i <= n; i++) mpz_init_set(b[i], p->c[n - i]);
    for (int i = 0; i < n; i++)
        for (int j = n - 1; j >= i; j--) mpz_add(b[j], b[j], b[j + 1]);
    *has_zero_end = mpz_sgn(b[0]) == 0 || mpz_sgn(b[n]) == 0;
    for (int i = 0; i <= n; i++) {
        int sign = mpz_sgn(b[i]);
        if (sign != 0) {
            changes += last != 0 && sign != last;
            last = sign;
        }
        mpz_clear(b[i]);
    }
    return changes;
}

bool oracle_polynomial_no_root(const oracle_polynomial *p)
{
    bool zero_end = false;
    return p->degree >= 0 && variations(p, &zero_end) == 0 && !zero_end;
}

/* --- isolation --- */

void oracle_root_init(oracle_root *root)
{
    root->exact = false;
    root->bits = 0;
    mpz_init(root->numerator);
    oracle_polynomial_init(&root->local);
}

void oracle_root_clear(oracle_root *root)
{
    mpz_clear(root->numerator);
    oracle_polynomial_clear(&root->local);
}

typedef struct isolation {
    oracle_root *root;
    int count;
    bool square_free, repeated, capped;
} isolation;

static void record(isolation *s, bool exact, const mpz_t numerator, unsigned long bits, const oracle_polynomial *local)
{
    oracle_root *root = &s->root[s->count++];
    root->exact = exact;
    root->bits = bits;
    mpz_set(root->numerator, numerator);
    if (!exact) oracle_polynomial_set(&root->local, local);
}

/* Take the roots at s = 0 out. Returns whether there were any. */
static bool divide_by_s(oracle_polynomial *p)
{
    int zeros = 0;
    while (zeros <= p->degree && mpz_sgn(p->c[zeros]) == 0) zeros++;
    if (zeros == 0) return false;
    for (int i = zeros; i <= p->degree; i++) mpz_swap(p->c[i - zeros], p->c[i]);
    cut(p, p->degree - zeros, p->degree);
    return true;
}

/* The roots in the open interval (numerator, numerator + 1) / 2^bits, over which p is given for s in (0, 1), p(0) != 0. p is used up. Halves are taken in a
 * loop over the right and a recursion into the left, so the depth of the stack is that of the bisection. */
static void isolate(isolation *s, oracle_polynomial *p, const mpz_t numerator, unsigned long bits)
{
    bool zero_end;
    int changes = variations(p, &zero_end);
    if (changes == 0 || s->repeated || s->capped) return;
    if (changes == 1) {
        record(s, false, numerator, bits, p);
        return;
    }
    if (!s->square_free && bits >= SUSPICION_DEPTH) {
        s->repeated = true;
        return;
    }
    if (bits >= DEPTH_LIMIT) {
        s->capped = true;
        return;
    }
    oracle_polynomial half;
    mpz_t place;
    oracle_polynomial_init(&half);
    mpz_init(place);
    halve(p);
    oracle_polynomial_set(&half, p);
    mpz_mul_2exp(place, numerator, 1);
    isolate(s, &half, place, bits + 1);
    shift_by_one(p);
    drop_power_of_two(p);
    mpz_add_ui(place, place, 1);
    if (divide_by_s(p)) record(s, true, place, bits + 1, NULL);
    isolate(s, p, place, bits + 1);
    mpz_clear(place);
    oracle_polynomial_clear(&half);
}

static void isolate_all(isolation *s, const oracle_polynomial *p)
{
    oracle_polynomial q;
    mpz_t place;
    oracle_polynomial_init(&q);
    mpz_init(place);
    oracle_polynomial_set(&q, p);
    s->count = 0;
    divide_by_s(&q);
    isolate(s, &q, place, 0);
    mpz_set_ui(place, 1);
    if (!s->repeated && oracle_polynomial_sign_at(p, place, 0) == 0) record(s, true, place, 0, NULL);
    mpz_clear(place);
    oracle_polynomial_clear(&q);
}

int oracle_polynomial_roots(const oracle_polynomial *p, oracle_root root[ORACLE_ROOT_LIMIT])
{
    if (p->degree <= 0 || oracle_polynomial_no_root(p)) return 0;
    isolation s = {.root = root};
    isolate_all(&s, p);
    if (s.repeated) {
        oracle_polynomial simple;
        oracle_polynomial_init(&simple);
        oracle_polynomial_square_free(&simple, p);
        s = (isolation){.root = root, .square_free = true};
        isolate_all(&s, &simple);
        oracle_polynomial_clear(&simple);
    }
    return s.capped ? -1 : s.count;
}

/* --- refinement --- */

/* A guess, in doubles, of the root of q in (0, 1): bisection on values, scaled by the largest coefficient. Only speed depends on it. */
static double guess(const oracle_polynomial *q)
{
    double c[ORACLE_DEGREE_LIMIT + 1];
    long exponent[ORACLE_DEGREE_LIMIT + 1], most = 0;
    for (int i = 0; i <= q->degree; i++) {
        c[i] = mpz_get_d_2exp(&exponent[i], q->c[i]);
        if (i == 0 || (c[i] != 0 && exponent[i] > most)) most = exponent[i];
    }
    for (int i = 0; i <= q->degree; i++) {
        long e = exponent[i] - most;
        c[i] = e < -900 ? 0 : ldexp(c[i], (int)e);
    }
    double lo = 0, hi = 1;
    for (int step = 0; step < 60; step++) {
        double s = 0.5 * (lo + hi), value = 0;
        for (int i = q->degree; i >= 0; i--) value = value * s + c[i];
        if ((value < 0) == (c[0] < 0)) lo = s;
        else hi = s;
    }
    return lo;
}

/* The part [numerator, numerator + 1] / 2^bits of the interval becomes the interval. */
static void narrow(oracle_root *root, const mpz_t numerator, unsigned long bits)
{
    mpz_mul_2exp(root->numerator, root->numerator, bits);
    mpz_add(root->numerator, root->numerator, numerator);
    root->bits += bits;
    zoom(&root->local, numerator, bits);
    drop_power_of_two(&root->local);
    if (mpz_sgn(root->local.c[0]) == 0) root->exact = true;
}

/* Jump to the interval of width 2^-GUESS_BITS around the guess if two exact signs say that the root is there. */
enum { GUESS_BITS = 40 };
static bool jump(oracle_root *root)
{
    mpz_t left, right;
    mpz_inits(left, right, NULL);
    mpz_set_d(left, floor(ldexp(guess(&root->local), GUESS_BITS)));
    mpz_add_ui(right, left, 1);
    int start = mpz_sgn(root->local.c[0]);
    int at_left = mpz_sgn(left) == 0 ? start : oracle_polynomial_sign_at(&root->local, left, GUESS_BITS);
    bool inside = at_left == 0 || (at_left == start && oracle_polynomial_sign_at(&root->local, right, GUESS_BITS) == -start);
    if (inside) narrow(root, left, GUESS_BITS);
    mpz_clears(left, right, NULL);
    return inside;
}

static void bisect(oracle_root *root)
{
    mpz_t one;
    mpz_init_set_ui(one, 1);
    int middle = oracle_polynomial_sign_at(&root->local, one, 1);
    if (middle == -mpz_sgn(root->local.c[0])) mpz_set_ui(one, 0); /* the root is in the left half */
    narrow(root, one, 1); /* a root in the middle itself becomes exact */
    mpz_clear(one);
}

void oracle_root_refine(oracle_root *root, unsigned long bits)
{
    while (!root->exact && root->bits < bits)
        if (!jump(root)) bisect(root);
}
