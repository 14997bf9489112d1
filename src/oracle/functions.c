/* The table of what MPFR can evaluate, and derivatives by central differences (SPEC V.6; docs/theory/oracle_energies.md). */
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "oracle/energies.h"

typedef mpfr_ptr (*formula)(oracle_reals *s, const mpfr_t *x, const double *fields);
typedef struct entry {
    cipc_oracle_function function;
    formula value;
} entry;

static const char *const mass_target[] = {"mass", "target[0]", "target[1]", "target[2]"};
static const char *const mass_acceleration[] = {"mass", "acceleration[0]", "acceleration[1]", "acceleration[2]"};
static const char *const penalty[] = {"stiffness", "mass", "target[0]", "target[1]", "target[2]"};
static const char *const membrane[] = {"inverse_rest[0]", "inverse_rest[1]", "inverse_rest[2]", "area", "volume", "mu", "lambda"};
static const char *const strain[] = {"inverse_rest[0]", "inverse_rest[1]", "inverse_rest[2]", "volume", "limit", "activation", "stiffness"};
static const char *const hinge[] = {"stiffness", "rest_angle"};
static const char *const barrier[] = {"stiffness", "weight", "offset", "dhat", "mollifier_eps", "feature"};
static const char *const friction[] = {"coefficient", "eps",       "weights[0]", "weights[1]", "weights[2]", "weights[3]", "basis[0]", "basis[1]",
                                       "basis[2]",    "basis[3]",  "basis[4]",   "basis[5]",   "start[0]",   "start[1]",   "start[2]", "start[3]",
                                       "start[4]",    "start[5]",  "start[6]",   "start[7]",   "start[8]",   "start[9]",   "start[10]", "start[11]"};
static const char *const mollifier[] = {"eps"};

static const entry table[] = {
    {{"inertia", 1, 4, mass_target}, oracle_inertia},
    {{"gravity", 1, 4, mass_acceleration}, oracle_gravity},
    {{"dirichlet_penalty", 1, 5, penalty}, oracle_dirichlet_penalty},
    {{"membrane_neo_hookean", 3, 7, membrane}, oracle_membrane_neo_hookean},
    {{"membrane_stvk", 3, 7, membrane}, oracle_membrane_stvk},
    {{"strain_limit", 3, 7, strain}, oracle_strain_limit},
    {{"hinge_bending", 4, 2, hinge}, oracle_hinge_bending},
    {{"barrier_point_point", 2, 4, barrier}, oracle_barrier_point_point},
    {{"barrier_point_edge", 3, 4, barrier}, oracle_barrier_point_edge},
    {{"barrier_point_triangle", 4, 4, barrier}, oracle_barrier_point_triangle},
    {{"barrier_edge_edge", 4, 6, barrier}, oracle_barrier_edge_edge},
    {{"friction", 4, 24, friction}, oracle_friction},
    {{"distance2_point_point", 2, 0, NULL}, oracle_distance2_point_point},
    {{"distance2_point_line", 3, 0, NULL}, oracle_distance2_point_line},
    {{"distance2_point_plane", 4, 0, NULL}, oracle_distance2_point_plane},
    {{"distance2_line_line", 4, 0, NULL}, oracle_distance2_line_line},
    {{"edge_edge_mollifier", 4, 1, mollifier}, oracle_edge_edge_mollifier},
};
enum { TABLE_COUNT = sizeof table / sizeof table[0] };

int cipc_oracle_function_count(void) { return TABLE_COUNT; }

const cipc_oracle_function *cipc_oracle_function_at(int index) { return &table[index].function; }

const cipc_oracle_function *cipc_oracle_function_find(const char *name)
{
    for (int i = 0; i < TABLE_COUNT; i++)
        if (strcmp(table[i].function.name, name) == 0) return &table[i].function;
    return NULL;
}

/* --- differences --- */

enum { PRECISION = 512, STEP_BITS = 100, MOST = 12 };

typedef struct evaluation {
    formula value;
    int n;
    const double *fields;
    oracle_reals store;
    mpfr_t x[MOST], h, center, ahead[MOST], behind[MOST], corner[4], result;
    bool feasible;
} evaluation;

static void evaluation_init(evaluation *e, const entry *t, const double *x, const double *fields, mpfr_prec_t precision)
{
    *e = (evaluation){.value = t->value, .n = 3 * t->function.nodes, .fields = fields, .feasible = true};
    oracle_reals_init(&e->store, precision);
    for (int i = 0; i < MOST; i++) mpfr_inits2(precision, e->x[i], e->ahead[i], e->behind[i], (mpfr_ptr)NULL);
    for (int i = 0; i < 4; i++) mpfr_init2(e->corner[i], precision);
    mpfr_inits2(precision, e->h, e->center, e->result, (mpfr_ptr)NULL);
    double size = 0;
    for (int i = 0; i < e->n; i++) {
        mpfr_set_d(e->x[i], x[i], MPFR_RNDN);
        size = fmax(size, fabs(x[i] - x[i % 3]));
    }
    if (size == 0) size = 1; /* one node, or all in one place */
    mpfr_set_ui_2exp(e->h, 1, ilogb(size) - STEP_BITS, MPFR_RNDN);
}

static void evaluation_clear(evaluation *e)
{
    oracle_reals_clear(&e->store);
    for (int i = 0; i < MOST; i++) mpfr_clears(e->x[i], e->ahead[i], e->behind[i], (mpfr_ptr)NULL);
    for (int i = 0; i < 4; i++) mpfr_clear(e->corner[i]);
    mpfr_clears(e->h, e->center, e->result, (mpfr_ptr)NULL);
}

static void evaluate(evaluation *e, mpfr_t r)
{
    e->store.used = 0;
    mpfr_ptr value = e->value(&e->store, (const mpfr_t *)e->x, e->fields);
    e->feasible = e->feasible && value != NULL && mpfr_number_p(value);
    if (e->feasible) mpfr_set(r, value, MPFR_RNDN);
}

/* r := f(x + si h e_i + sj h e_j); j < 0: only i. */
static void evaluate_at(evaluation *e, mpfr_t r, int i, int si, int j, int sj)
{
    mpfr_t kept_i, kept_j;
    mpfr_inits2(e->store.precision, kept_i, kept_j, (mpfr_ptr)NULL);
    mpfr_set(kept_i, e->x[i], MPFR_RNDN);
    if (si > 0) mpfr_add(e->x[i], e->x[i], e->h, MPFR_RNDN);
    else mpfr_sub(e->x[i], e->x[i], e->h, MPFR_RNDN);
    if (j >= 0) {
        mpfr_set(kept_j, e->x[j], MPFR_RNDN);
        if (sj > 0) mpfr_add(e->x[j], e->x[j], e->h, MPFR_RNDN);
        else mpfr_sub(e->x[j], e->x[j], e->h, MPFR_RNDN);
    }
    evaluate(e, r);
    if (j >= 0) mpfr_set(e->x[j], kept_j, MPFR_RNDN);
    mpfr_set(e->x[i], kept_i, MPFR_RNDN);
    mpfr_clears(kept_i, kept_j, (mpfr_ptr)NULL);
}

/* g_i = (f(x + h e_i) - f(x - h e_i)) / (2 h). */
static void differentiate(evaluation *e, double *g)
{
    for (int i = 0; i < e->n; i++) {
        evaluate_at(e, e->ahead[i], i, 1, -1, 0);
        evaluate_at(e, e->behind[i], i, -1, -1, 0);
        if (!e->feasible) return;
        mpfr_sub(e->result, e->ahead[i], e->behind[i], MPFR_RNDN);
        mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
        if (g != NULL) g[i] = 0.5 * mpfr_get_d(e->result, MPFR_RNDN);
    }
}

/* H_ii = (f(+) - 2 f + f(-)) / h^2; H_ij = (f(++) - f(+-) - f(-+) + f(--)) / (4 h^2). differentiate has been called. */
static void differentiate_twice(evaluation *e, double *H)
{
    for (int i = 0; i < e->n && e->feasible; i++) {
        mpfr_add(e->result, e->ahead[i], e->behind[i], MPFR_RNDN);
        mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
        mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
        mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
        mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
        H[i * e->n + i] = mpfr_get_d(e->result, MPFR_RNDN);
        for (int j = 0; j < i && e->feasible; j++) {
            for (int c = 0; c < 4; c++) evaluate_at(e, e->corner[c], i, c & 1 ? 1 : -1, j, c & 2 ? 1 : -1);
            if (!e->feasible) return;
            mpfr_add(e->result, e->corner[0], e->corner[3], MPFR_RNDN);
            mpfr_sub(e->result, e->result, e->corner[1], MPFR_RNDN);
            mpfr_sub(e->result, e->result, e->corner[2], MPFR_RNDN);
            mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
            mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
            H[i * e->n + j] = H[j * e->n + i] = 0.25 * mpfr_get_d(e->result, MPFR_RNDN);
        }
    }
}

/* The value at twice the precision rounds to the same double? */
static bool confirmed(const entry *t, const double *x, const double *fields, double value)
{
    evaluation e;
    evaluation_init(&e, t, x, fields, 2 * PRECISION);
    evaluate(&e, e.center);
    bool same = e.feasible && mpfr_get_d(e.center, MPFR_RNDN) == value;
    evaluation_clear(&e);
    return same;
}

cipc_verdict cipc_oracle_evaluate(const cipc_oracle_function *function, const double *x, const double *fields, double *value, double *g, double *H)
{
    const entry *t = table;
    while (&t->function != function) t++;
    for (int i = 0; i < 3 * function->nodes; i++)
        if (!isfinite(x[i])) return CIPC_INDETERMINATE;
    for (int i = 0; i < function->field_count; i++)
        if (!isfinite(fields[i])) return CIPC_INDETERMINATE;
    evaluation e;
    evaluation_init(&e, t, x, fields, PRECISION);
    evaluate(&e, e.center);
    double center = e.feasible ? mpfr_get_d(e.center, MPFR_RNDN) : INFINITY;
    if (value != NULL) *value = center;
    if (e.feasible && (g != NULL || H != NULL)) differentiate(&e, g);
    if (e.feasible && H != NULL) differentiate_twice(&e, H);
    bool feasible = e.feasible;
    evaluation_clear(&e);
    return feasible && confirmed(t, x, fields, center) ? CIPC_YES : CIPC_INDETERMINATE;
}
