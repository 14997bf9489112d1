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
static const char *const orthotropic[] = {"warp[0]", "warp[1]", "weft[0]", "weft[1]", "rest_cosine", "volume", "a11", "a12", "a22", "g12", "limit11", "limit22",
                                          "limit12"};
static const char *const hinge[] = {"stiffness", "rest_angle"};
static const char *const volume[] = {"inverse_rest[0]", "inverse_rest[1]", "inverse_rest[2]", "inverse_rest[3]", "inverse_rest[4]", "inverse_rest[5]",
                                     "inverse_rest[6]", "inverse_rest[7]", "inverse_rest[8]", "volume", "mu", "lambda"};
static const char *const rod_stretching[] = {"stiffness", "length"};
static const char *const rod_bending[] = {"stiffness", "rest_curvature"};
static const char *const stitch[] = {"stiffness", "ratio"};
static const char *const damping[] = {
    "factor",
    "start[0]", "start[1]", "start[2]", "start[3]", "start[4]", "start[5]",
    "start[6]", "start[7]", "start[8]", "start[9]", "start[10]", "start[11]",
    "stiffness[0]", "stiffness[1]", "stiffness[2]", "stiffness[3]", "stiffness[4]", "stiffness[5]",
    "stiffness[6]", "stiffness[7]", "stiffness[8]", "stiffness[9]", "stiffness[10]", "stiffness[11]",
    "stiffness[12]", "stiffness[13]", "stiffness[14]", "stiffness[15]", "stiffness[16]", "stiffness[17]",
    "stiffness[18]", "stiffness[19]", "stiffness[20]", "stiffness[21]", "stiffness[22]", "stiffness[23]",
    "stiffness[24]", "stiffness[25]", "stiffness[26]", "stiffness[27]", "stiffness[28]", "stiffness[29]",
    "stiffness[30]", "stiffness[31]", "stiffness[32]", "stiffness[33]", "stiffness[34]", "stiffness[35]",
    "stiffness[36]", "stiffness[37]", "stiffness[38]", "stiffness[39]", "stiffness[40]", "stiffness[41]",
    "stiffness[42]", "stiffness[43]", "stiffness[44]", "stiffness[45]", "stiffness[46]", "stiffness[47]",
    "stiffness[48]", "stiffness[49]", "stiffness[50]", "stiffness[51]", "stiffness[52]", "stiffness[53]",
    "stiffness[54]", "stiffness[55]", "stiffness[56]", "stiffness[57]", "stiffness[58]", "stiffness[59]",
    "stiffness[60]", "stiffness[61]", "stiffness[62]", "stiffness[63]", "stiffness[64]", "stiffness[65]",
    "stiffness[66]", "stiffness[67]", "stiffness[68]", "stiffness[69]", "stiffness[70]", "stiffness[71]",
    "stiffness[72]", "stiffness[73]", "stiffness[74]", "stiffness[75]", "stiffness[76]", "stiffness[77]",
};
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
    {{"strain_limit_lower", 3, 7, strain}, oracle_strain_limit_lower},
    {{"membrane_orthotropic", 3, 13, orthotropic}, oracle_membrane_orthotropic},
    {{"hinge_bending", 4, 2, hinge}, oracle_hinge_bending},
    {{"volume_corotational", 4, 12, volume}, oracle_volume_corotational},
    {{"volume_neo_hookean", 4, 12, volume}, oracle_volume_neo_hookean},
    {{"rod_stretching", 2, 2, rod_stretching}, oracle_rod_stretching},
    {{"rod_bending", 3, 2, rod_bending}, oracle_rod_bending},
    {{"stitch", 3, 2, stitch}, oracle_stitch},
    {{"damping", 4, 91, damping}, oracle_damping},
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

/* How far a difference may be from one that takes the same derivative along a diagonal: what is left of the third and fourth derivatives is this share of the
 * largest entry at most, a hundred times below the roundoff of double... */
static const double SMOOTH = 0x1p-60;
/* ... and where the derivative itself vanishes, these of what it is made of: far below u |H| S, better than which no gradient is known, and above the roundings
 * of 512 bits, which steps of 2^-100 magnify to 2^-412 in first and 2^-312 in second differences. */
static const double NOISE_FIRST = 0x1p-120, NOISE_SECOND = 0x1p-200;

typedef struct evaluation {
    formula value;
    int n;
    double size; /* the step is 2^-100 of it */
    const double *fields;
    oracle_reals store;
    mpfr_t x[MOST], h, center, ahead[MOST], behind[MOST], corner[4], result;
    bool feasible;
    double first_off, second_off; /* largest disagreement with differences along diagonals */
} evaluation;

static void evaluation_init(evaluation *e, const entry *t, const double *x, const double *fields, mpfr_prec_t precision)
{
    *e = (evaluation){.value = t->value, .n = 3 * t->function.nodes, .fields = fields, .feasible = true};
    oracle_reals_init(&e->store, precision);
    for (int i = 0; i < MOST; i++) mpfr_inits2(precision, e->x[i], e->ahead[i], e->behind[i], (mpfr_ptr)NULL);
    for (int i = 0; i < 4; i++) mpfr_init2(e->corner[i], precision);
    mpfr_inits2(precision, e->h, e->center, e->result, (mpfr_ptr)NULL);
    for (int i = 0; i < e->n; i++) {
        mpfr_set_d(e->x[i], x[i], MPFR_RNDN);
        e->size = fmax(e->size, fabs(x[i] - x[i % 3]));
    }
    if (e->size == 0) e->size = 1; /* one node, or all in one place */
    mpfr_set_ui_2exp(e->h, 1, ilogb(e->size) - STEP_BITS, MPFR_RNDN);
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

/* x_i += sign h. */
static void move(evaluation *e, int i, int sign)
{
    if (sign > 0) mpfr_add(e->x[i], e->x[i], e->h, MPFR_RNDN);
    else mpfr_sub(e->x[i], e->x[i], e->h, MPFR_RNDN);
}

/* r := f(x + sign h e_i). */
static void evaluate_along(evaluation *e, mpfr_t r, int i, int sign)
{
    mpfr_t kept;
    mpfr_init2(kept, e->store.precision);
    mpfr_set(kept, e->x[i], MPFR_RNDN);
    move(e, i, sign);
    evaluate(e, r);
    mpfr_set(e->x[i], kept, MPFR_RNDN);
    mpfr_clear(kept);
}

/* corner[c] := f(x +- h e_i +- h e_j), bit 0 of c for i and bit 1 for j: set is plus. */
static void evaluate_corners(evaluation *e, int i, int j)
{
    mpfr_t kept;
    mpfr_init2(kept, e->store.precision);
    for (int c = 0; c < 4; c++) {
        mpfr_set(kept, e->x[i], MPFR_RNDN);
        move(e, i, c & 1 ? 1 : -1);
        evaluate_along(e, e->corner[c], j, c & 2 ? 1 : -1);
        mpfr_set(e->x[i], kept, MPFR_RNDN);
    }
    mpfr_clear(kept);
}

/* result / h^order as a double. */
static double quotient(evaluation *e, int order)
{
    for (int k = 0; k < order; k++) mpfr_div(e->result, e->result, e->h, MPFR_RNDN);
    return mpfr_get_d(e->result, MPFR_RNDN);
}

/* g_i = (f(x + h e_i) - f(x - h e_i)) / (2 h). */
static void differentiate(evaluation *e, double *g)
{
    for (int i = 0; i < e->n; i++) {
        evaluate_along(e, e->ahead[i], i, 1);
        evaluate_along(e, e->behind[i], i, -1);
        if (!e->feasible) return;
        mpfr_sub(e->result, e->ahead[i], e->behind[i], MPFR_RNDN);
        g[i] = 0.5 * quotient(e, 1);
    }
}

/* H_ii = (f(+) - 2 f + f(-)) / h^2. */
static double second_along(evaluation *e, int i)
{
    mpfr_add(e->result, e->ahead[i], e->behind[i], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
    return quotient(e, 2);
}

/* H_ij = (f(++) - f(+-) - f(-+) + f(--)) / (4 h^2). */
static double second_mixed(evaluation *e)
{
    mpfr_add(e->result, e->corner[0], e->corner[3], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->corner[1], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->corner[2], MPFR_RNDN);
    return 0.25 * quotient(e, 2);
}

/* The corners know derivatives too. f(++) - f(--) = 2 h (g_i + g_j) and f(++) + f(+-) + f(-+) + f(--) - 4 f = 2 h^2 (H_ii + H_jj), but for derivatives of
 * third and fourth order: how far these are off is how far the differences are not to be trusted. Subtracted before rounding to double. */
static void compare_diagonals(evaluation *e, int i, int j)
{
    mpfr_sub(e->result, e->corner[3], e->corner[0], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->ahead[i], MPFR_RNDN);
    mpfr_add(e->result, e->result, e->behind[i], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->ahead[j], MPFR_RNDN);
    mpfr_add(e->result, e->result, e->behind[j], MPFR_RNDN);
    e->first_off = fmax(e->first_off, 0.5 * fabs(quotient(e, 1)));
    mpfr_add(e->result, e->ahead[i], e->behind[i], MPFR_RNDN);
    mpfr_add(e->result, e->result, e->ahead[j], MPFR_RNDN);
    mpfr_add(e->result, e->result, e->behind[j], MPFR_RNDN);
    mpfr_mul_2ui(e->result, e->result, 1, MPFR_RNDN);
    for (int c = 0; c < 4; c++) mpfr_sub(e->result, e->result, e->corner[c], MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN); /* 2 (f(+0) + f(-0) + f(0+) + f(0-)) - corners - 4 f */
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
    mpfr_sub(e->result, e->result, e->center, MPFR_RNDN);
    e->second_off = fmax(e->second_off, 0.5 * fabs(quotient(e, 2)));
}

/* H, or NULL: only the comparisons, of neighbouring coordinates; *most: the largest entry seen. differentiate has been called. */
static void differentiate_twice(evaluation *e, double *H, double *most)
{
    for (int i = 0; i < e->n && e->feasible; i++) {
        double along = second_along(e, i);
        *most = fmax(*most, fabs(along));
        if (H != NULL) H[i * e->n + i] = along;
        for (int j = H != NULL || i == 0 ? 0 : i - 1; j < i; j++) {
            evaluate_corners(e, i, j);
            if (!e->feasible) return;
            compare_diagonals(e, i, j);
            double mixed = second_mixed(e);
            *most = fmax(*most, fabs(mixed));
            if (H != NULL) H[i * e->n + j] = H[j * e->n + i] = mixed;
        }
    }
}

static double largest(const double *v, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

/* All points of the differences on one side of every switch, and no derivatives of higher order to be seen in them. */
static bool trusted(const evaluation *e, double value, const double *g, double H_most, bool second)
{
    const unsigned jump = ORACLE_JUMP_BELOW | ORACLE_JUMP_ABOVE, bend = ORACLE_BEND_BELOW | ORACLE_BEND_ABOVE;
    double g_most = largest(g, e->n);
    if ((e->store.sides & jump) == jump || (second && (e->store.sides & bend) == bend)) return false;
    if (!(e->first_off <= SMOOTH * g_most + NOISE_FIRST * (fabs(value) / e->size + H_most * e->size))) return false;
    return !second || e->second_off <= SMOOTH * H_most + NOISE_SECOND * (fabs(value) / e->size + g_most) / e->size;
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
    double slopes[MOST] = {0}, H_most = 0;
    evaluation_init(&e, t, x, fields, PRECISION);
    evaluate(&e, e.center);
    double center = e.feasible ? mpfr_get_d(e.center, MPFR_RNDN) : INFINITY;
    if (value != NULL) *value = center;
    bool derivatives = g != NULL || H != NULL;
    if (e.feasible && derivatives) differentiate(&e, slopes);
    if (e.feasible && derivatives) differentiate_twice(&e, H, &H_most);
    if (g != NULL) memcpy(g, slopes, (size_t)e.n * sizeof *g);
    bool good = e.feasible && (!derivatives || trusted(&e, center, slopes, H_most, H != NULL));
    evaluation_clear(&e);
    return good && confirmed(t, x, fields, center) ? CIPC_YES : CIPC_INDETERMINATE;
}
