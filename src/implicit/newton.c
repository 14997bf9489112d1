/* Projected Newton: minimise E from the present iterate with the friction data as they are (SPEC C.7, D.7). */
#include "implicit/stepper.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"

/* The released code's rule looks at the worst of this many iterations. */
enum { RMS_WINDOW = 3 };
/* kappa is doubled when the smallest gap is below this fraction of the bounding box at two iterates and shrinks (SPEC D.4); released: 1e-9 m. */
static const double doubling_gap_fraction = 1e-9;
/* k_D doubles to at most this (SPEC C.7). */
static const double largest_penalty = 1e8;
/* Multiples of the mass matrix added, growing tenfold, when a factorisation meets a pivot that is not positive. */
static const double first_shift = 1e-6;
enum { SHIFTS = 12 };
/* A step found with more mass added than there is may be short because of that mass alone: it says nothing of how near the minimum is. */
static const double largest_telling_shift = 1;

/* Below this multiple of the tolerance the exact Hessian is tried first: near the minimum it is positive definite as a whole and converges quadratically,
 * where the projected one may creep. After a failure it is left alone for some iterations. */
static const double exact_residual_factor = 100;
enum { EXACT_PAUSE = 4 };

/* After a line search that halved this often, friction enters by its majorizer for some iterations: steps of its Hessian, which does not resist along the motion, go back and forth
 * across its kink (docs/theory/time_step.md). */
enum { ZIGZAG_HALVINGS = 2, MAJORIZED_ITERATIONS = 3 };

/* State of one minimisation. */
typedef struct minimisation {
    int exact_pause;
    int majorized; /* iterations with the majorizer of friction that are left, the present one included */
    double energy, residual, slope;
    double recent[RMS_WINDOW];
    double shift; /* mass added to the last Newton matrix, in multiples of the mass matrix */
    double previous_gap;
    int iteration;
} minimisation;

/* Place of an error. */
enum { PLACE_SIZE = 32 };
static void name_step(const cipc_stepper *s, char place[PLACE_SIZE]) { (void)snprintf(place, PLACE_SIZE, "step %d", s->step); }

static void shift_diagonal(cipc_stepper *s, double shift)
{
    for (int k = 0; k < s->free_count; k++) {
        double *entries = s->matrix.x + cipc_block_matrix_entry(&s->matrix, k, s->matrix.start[k]);
        for (int c = 0; c < 3; c++) entries[c * cipc_block_matrix_stride(&s->matrix, k) + c] += shift * s->model->mass[s->free_nodes[k]];
    }
}

static cipc_status try_factorization(cipc_stepper *s, bool *definite, cipc_error *error)
{
    double begin = cipc_seconds();
    cipc_status status = cipc_linear_solver_factorize(s->solver, &s->matrix, s->options.threads, definite, error);
    s->report->factorizations++;
    s->report->seconds[CIPC_PHASE_FACTORIZATION] += cipc_seconds() - begin;
    return status;
}

static cipc_status assemble(cipc_stepper *s, bool project, cipc_error *error)
{
    double begin = cipc_seconds();
    s->project = project;
    cipc_status status = cipc_assemble_hessian(s, error);
    s->report->seconds[CIPC_PHASE_ASSEMBLY] += cipc_seconds() - begin;
    return status;
}

/* Factorise; M > 0 and every other term is projected, so this fails by rounding only, or in an equilibrium, which has no M, where nothing resists: then more and more mass is added, which keeps a descent direction. */
static cipc_status factorize(cipc_stepper *s, minimisation *m, cipc_error *error)
{
    double shift = first_shift;
    bool definite = false;
    for (int attempt = 0; attempt <= SHIFTS && !definite; attempt++, shift *= 10) {
        if (attempt > 0) {
            shift_diagonal(s, shift);
            m->shift += shift;
        }
        cipc_status status = try_factorization(s, &definite, error);
        if (status) return status;
    }
    if (definite) return CIPC_OK;
    char place[PLACE_SIZE];
    name_step(s, place);
    return cipc_fail(error, CIPC_E_FACTORIZATION, place, "the Newton matrix is not positive definite, even with mass added");
}

/* Factor of the exact Hessian if that is worth trying and positive definite, of the projected one otherwise. */
static cipc_status factor_of_hessian(cipc_stepper *s, minimisation *m, cipc_error *error)
{
    bool definite = false;
    cipc_status status = CIPC_OK;
    m->shift = 0;
    s->majorize_friction = m->majorized > 0;
    if (!s->options.released && m->majorized == 0 && m->exact_pause == 0 && m->iteration > 0 && m->residual < exact_residual_factor * s->options.newton_tolerance) {
        status = assemble(s, false, error);
        if (!status) status = try_factorization(s, &definite, error);
        if (status || definite) return status;
        m->exact_pause = EXACT_PAUSE;
    } else if (m->exact_pause > 0) {
        m->exact_pause--;
    }
    status = assemble(s, true, error);
    return status ? status : factorize(s, m, error);
}

/* p = -H^-1 grad E into s->direction; slope p.grad E into m->slope. */
static cipc_status newton_direction(cipc_stepper *s, minimisation *m, cipc_error *error)
{
    double begin = cipc_seconds(), *slope = &m->slope;
    cipc_status status = cipc_potential_gradient(s, error);
    s->report->seconds[CIPC_PHASE_ASSEMBLY] += cipc_seconds() - begin;
    if (!status) status = factor_of_hessian(s, m, error);
    if (status) return status;
    begin = cipc_seconds();
    for (int k = 0; k < s->free_count; k++) v3_scale(s->right + 3 * k, -1, s->gradient + 3 * s->free_nodes[k]);
    status = cipc_linear_solver_solve(s->solver, s->right, s->solution, s->options.threads, error);
    if (status) return status;
    memset(s->direction, 0, 3 * (size_t)s->model->node_count * sizeof(double));
    *slope = 0;
    for (int k = 0; k < s->free_count; k++) {
        v3_copy(s->direction + 3 * s->free_nodes[k], s->solution + 3 * k);
        *slope -= v3_dot(s->right + 3 * k, s->solution + 3 * k);
    }
    s->report->seconds[CIPC_PHASE_SOLVE] += cipc_seconds() - begin;
    return CIPC_OK;
}

/* Length of the Newton step in the norm of the stopping rule, m/s. */
static double step_length(const cipc_stepper *s)
{
    double most = 0, sum = 0;
    int prescribed = 0;
    for (int i = 0; i < s->model->node_count; i++) {
        double length2 = v3_norm2(s->direction + 3 * i);
        most = fmax(most, length2);
        sum += length2;
        prescribed += s->is_dirichlet[i] || s->moves[i];
    }
    if (s->options.newton_norm == CIPC_NORM_MAX) return sqrt(most) / s->options.time_step;
    int count = s->model->node_count - prescribed;
    return sqrt(sum / (count > 0 ? count : 1)) / s->options.time_step;
}

static bool below_tolerance(const cipc_stepper *s, minimisation *m, double alpha)
{
    bool telling = m->shift <= largest_telling_shift && m->majorized == 0; /* steps of the majorizer are short */
    if (s->options.newton_norm == CIPC_NORM_MAX) return telling && alpha == 1 && m->residual <= s->options.newton_tolerance;
    double worst = 0;
    m->recent[m->iteration % RMS_WINDOW] = m->residual;
    for (int i = 0; i < RMS_WINDOW; i++) worst = fmax(worst, m->recent[i]);
    return telling && m->iteration + 1 >= RMS_WINDOW && worst <= s->options.newton_tolerance;
}

/* How the next iteration takes friction, after one that halved its step `halvings` times. */
static void choose_friction(const cipc_stepper *s, minimisation *m, long halvings)
{
    if (m->majorized > 0) m->majorized--;
    if (m->residual <= s->options.newton_tolerance) m->majorized = 0; /* its Hessian has to confirm that */
    if (!s->options.released && s->friction.count > 0 && halvings >= ZIGZAG_HALVINGS) m->majorized = MAJORIZED_ITERATIONS;
}

static cipc_status energy_now(cipc_stepper *s, double *energy, cipc_error *error)
{
    cipc_energy_terms terms;
    double begin = cipc_seconds();
    cipc_status status = cipc_potential_value(s, s->x, &s->contacts, &terms, error);
    s->report->seconds[CIPC_PHASE_LINE_SEARCH] += cipc_seconds() - begin;
    *energy = terms.total;
    return status;
}

static void set_stiffness(cipc_stepper *s, double kappa)
{
    s->kappa = kappa;
    for (int i = 0; i < s->contacts.count; i++) s->contacts.contacts[i].barrier.stiffness = kappa;
}

static double largest_stiffness(const cipc_stepper *s)
{
    if (s->options.released) return cipc_barrier_stiffness_range_released(s->mean_mass, s->options.contact.dhat).maximum;
    double xi = 0;
    for (int b = 0; b < s->model->body_count; b++) xi = fmax(xi, s->model->bodies[b].offset);
    return cipc_barrier_stiffness_range(s->bounding_box_diagonal, s->mean_mass, xi, s->options.contact.dhat).maximum;
}

/* Stiffness adaptations between iterations; E changes with them. */
static cipc_status adapt(cipc_stepper *s, minimisation *m, cipc_error *error)
{
    double smallest = s->options.released ? 1e-9 : doubling_gap_fraction * s->bounding_box_diagonal, gap = s->contacts.min_gap;
    bool changed = cipc_strain_adapt(s);
    if (gap < smallest && m->previous_gap < smallest && gap < m->previous_gap && s->kappa < largest_stiffness(s)) {
        set_stiffness(s, fmin(2 * s->kappa, largest_stiffness(s)));
        changed = true;
    }
    m->previous_gap = gap;
    return changed ? energy_now(s, &m->energy, error) : CIPC_OK;
}

/* What limited the last step, or else the closest contact, as the end of a message; empty if there is neither. */
enum { LIMIT_SIZE = 160 };
static void describe_limit(const cipc_stepper *s, char text[LIMIT_SIZE])
{
    const int *n = s->limit.nodes;
    text[0] = 0;
    if (s->limit.what && n[0] < 0) {
        (void)snprintf(text, LIMIT_SIZE, "; limited by %s", s->limit.what);
    } else if (s->limit.what) {
        (void)snprintf(text, LIMIT_SIZE, "; limited by %s at nodes %d %d %d %d", s->limit.what, n[0], n[1], n[2], n[3]);
    } else if (s->contacts.count > 0) {
        n = s->contacts.contacts[s->contacts.min_gap_contact].nodes;
        (void)snprintf(text, LIMIT_SIZE, "; closest contact, %.3g m, at nodes %d %d %d %d", s->contacts.min_gap, n[0], n[1], n[2], n[3]);
    }
}

static cipc_status no_progress(const cipc_stepper *s, const minimisation *m, cipc_error *error)
{
    char place[PLACE_SIZE], limit[LIMIT_SIZE];
    name_step(s, place);
    describe_limit(s, limit);
    return cipc_fail(error, CIPC_E_NO_PROGRESS, place, "scripted nodes got %.4g of their way and no further (residual %.3g m/s): something is in it%s",
                     cipc_dirichlet_progress(s), m->residual, limit);
}

/* Penalised nodes: on to their targets, or a stiffer pull. *waiting: they are not there yet. */
static cipc_status drive_penalty(cipc_stepper *s, minimisation *m, bool converged, bool *waiting, cipc_error *error)
{
    *waiting = false;
    if (s->penalty == 0) return CIPC_OK;
    bool done;
    cipc_status status = cipc_dirichlet_finish(s, m->iteration, &done, error);
    if (status) return status;
    *waiting = true;
    if (!done && (converged || m->residual < 10 * s->options.newton_tolerance)) {
        if (s->penalty >= largest_penalty && converged)
            return no_progress(s, m, error);
        s->penalty = fmin(2 * s->penalty, largest_penalty);
    }
    return energy_now(s, &m->energy, error);
}

/* Was the step limited by a tetrahedron of the fixed-corotational energy? */
static bool is_pressed_flat(const cipc_stepper *s)
{
    return s->limit.what && strcmp(s->limit.what, "inversion") == 0 && s->model->bodies[s->model->node_body[s->limit.nodes[0]]].material.volume == CIPC_VOLUME_COROTATIONAL;
}

static cipc_status not_converged(const cipc_stepper *s, const minimisation *m, cipc_error *error)
{
    char place[PLACE_SIZE], limit[LIMIT_SIZE];
    name_step(s, place);
    describe_limit(s, limit);
    cipc_status status = cipc_fail(error, CIPC_E_NOT_CONVERGED, place, "not converged after %d iterations: residual %.3g m/s, tolerance %.3g%s", m->iteration, m->residual,
                                   s->options.newton_tolerance, limit);
    /* The fixed-corotational energy of a flat tetrahedron is finite: its minimum may lie beyond, where no step may go, and more iterations would only come nearer to flat. */
    if (is_pressed_flat(s)) cipc_fail_remedy(error, "give the volume the model neo-hookean, which resists being pressed flat, or shorten time_step");
    return status;
}

cipc_status cipc_newton(cipc_stepper *s, cipc_error *error)
{
    minimisation m = {.previous_gap = INFINITY};
    cipc_status status = energy_now(s, &m.energy, error);
    for (; !status && m.iteration < s->options.newton_iterations; m.iteration++) {
        double alpha = 0;
        bool waiting;
        status = newton_direction(s, &m, error);
        if (status) return status;
        m.residual = step_length(s);
        s->report->residual = m.residual;
        s->report->newton_iterations++;
        const long halvings = s->report->line_search_halvings;
        status = cipc_line_search(s, m.iteration, m.slope, &m.energy, &alpha, error);
        if (status) return status;
        if (alpha == 0) break; /* no decrease to be had: say so rather than call it converged */
        bool converged = below_tolerance(s, &m, alpha);
        status = drive_penalty(s, &m, converged, &waiting, error);
        if (status || (converged && !waiting)) return status;
        choose_friction(s, &m, s->report->line_search_halvings - halvings);
        status = adapt(s, &m, error);
    }
    return status ? status : not_converged(s, &m, error);
}
