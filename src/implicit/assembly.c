/* Assembly of the projected Hessian: local Hessians in parallel into slots of their own, then added to the matrix column range by column range,
 * every entry in the order of the elements whatever the number of threads. The pattern (and with it the symbolic factorisation) is kept while every
 * block that is needed exists in it (docs/theory/assembly.md). */
#include "implicit/stepper.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/contact_hessian.h"
#include "implicit/psd_projection.h"

/* Pairs (i, j), i >= j, of up to four nodes, in the order of the slots. */
enum { PAIRS = 10 };
static const int pair_row[PAIRS] = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3}, pair_column[PAIRS] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};

/* rad: hinges flat to the rounding of their normals. */
static const double flat_angle = 1e-9;

static int pair_count(int nodes) { return nodes * (nodes + 1) / 2; }

void cipc_assembly_invalidate(cipc_stepper *s)
{
    s->pattern_valid = false;
    s->kept_pair_count = 0;
}

/* --- pattern ------------------------------------------------------------------------------------------------------------------- */

static long off_diagonal_pairs(const cipc_stepper *s, const cipc_term_list *list, int (*pairs)[2], long count)
{
    for (int i = 0; i < list->count; i++) {
        const int *nodes = cipc_term_nodes(list, i);
        int n = cipc_term_energy(list, i)->nodes;
        for (int k = 0; k < pair_count(n); k++) {
            int a = s->free_index[nodes[pair_row[k]]], b = s->free_index[nodes[pair_column[k]]];
            if (a < 0 || b < 0 || a == b) continue;
            pairs[count][0] = a;
            pairs[count++][1] = b;
        }
    }
    return count;
}

/* Block pairs of contacts and friction now, and of the pattern before: a contact that comes and goes does not cost an analysis each time. */
static cipc_status collect_pairs(cipc_stepper *s, const cipc_term_list lists[CIPC_LIST_COUNT], int (**pairs)[2], long *count, cipc_error *error)
{
    long most = s->kept_pair_count;
    for (int l = 0; l < CIPC_LIST_COUNT; l++) most += (long)PAIRS * lists[l].count;
    int(*all)[2] = cipc_alloc((size_t)most, sizeof *all);
    if (!all) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "matrix", "no memory for the pattern");
    long n = 0;
    n = off_diagonal_pairs(s, &lists[CIPC_LIST_CONTACT], all, n);
    n = off_diagonal_pairs(s, &lists[CIPC_LIST_FRICTION], all, n);
    int(*kept)[2] = cipc_alloc((size_t)n, sizeof *kept);
    if (!kept) {
        cipc_free(all);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "matrix", "no memory for the pattern");
    }
    if (n) memcpy(kept, all, (size_t)n * sizeof *kept);
    long kept_now = n;
    if (s->kept_pair_count) memcpy(all + n, s->kept_pairs, (size_t)s->kept_pair_count * sizeof *all);
    n += s->kept_pair_count;
    for (int l = 0; l < CIPC_GROUP_COUNT; l++) n = off_diagonal_pairs(s, &lists[l], all, n);
    cipc_free(s->kept_pairs);
    s->kept_pairs = kept;
    s->kept_pair_count = kept_now;
    *pairs = all;
    *count = n;
    return CIPC_OK;
}

/* --- slots --------------------------------------------------------------------------------------------------------------------- */

/* Block index of every node pair of every element of a list; false if the pattern lacks one. */
static bool find_slots(const cipc_stepper *s, const cipc_term_list *list, int *slots)
{
    bool complete = true;
#pragma omp parallel for schedule(static) num_threads(s->options.threads) reduction(&& : complete)
    for (int i = 0; i < list->count; i++) {
        const int *nodes = cipc_term_nodes(list, i);
        int n = pair_count(cipc_term_energy(list, i)->nodes);
        for (int k = 0; k < PAIRS; k++) {
            int slot = -1;
            int a = k < n ? s->free_index[nodes[pair_row[k]]] : -1, b = k < n ? s->free_index[nodes[pair_column[k]]] : -1;
            if (a >= 0 && b >= 0) {
                slot = cipc_block_matrix_find(&s->matrix, a > b ? a : b, a > b ? b : a);
                complete = complete && slot >= 0;
            }
            slots[PAIRS * (size_t)i + (size_t)k] = slot;
        }
    }
    return complete;
}

static size_t static_count(const cipc_stepper *s)
{
    size_t count = 0;
    for (int g = 0; g < CIPC_GROUP_COUNT; g++) count += (size_t)s->groups[g].count;
    return count;
}

static cipc_status reserve_contact_slots(cipc_stepper *s, int count, cipc_error *error)
{
    if (count <= s->contact_slot_capacity) return CIPC_OK;
    int capacity = count + count / 2;
    int *slots = cipc_realloc(s->contact_slots, (size_t)capacity * PAIRS, sizeof(int));
    if (!slots) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "matrix", "no memory for %d contacts", count);
    s->contact_slots = slots;
    s->contact_slot_capacity = capacity;
    return CIPC_OK;
}

/* Contact, friction and damping have their slots one after the other. */
static size_t first_slot(const cipc_term_list lists[CIPC_LIST_COUNT], int list)
{
    size_t first = 0;
    for (int l = CIPC_LIST_CONTACT; l < list; l++) first += PAIRS * (size_t)lists[l].count;
    return first;
}

static bool find_contact_slots(const cipc_stepper *s, const cipc_term_list lists[CIPC_LIST_COUNT])
{
    bool complete = true;
    for (int l = CIPC_LIST_CONTACT; l < CIPC_LIST_COUNT; l++) complete = find_slots(s, &lists[l], s->contact_slots + first_slot(lists, l)) && complete;
    return complete;
}

/* The pattern holds all elements, those too that the present stage leaves out: the next stage needs no other. */
static void whole_lists(cipc_stepper *s, cipc_term_list lists[CIPC_LIST_COUNT])
{
    cipc_stage stage = s->stage;
    s->stage = CIPC_STAGE_WHOLE;
    cipc_term_lists(s, &s->contacts, lists);
    s->stage = stage;
}

static cipc_status new_pattern(cipc_stepper *s, cipc_error *error)
{
    cipc_term_list lists[CIPC_LIST_COUNT];
    whole_lists(s, lists);
    double begin = cipc_seconds();
    int(*pairs)[2] = NULL;
    long count = 0;
    s->pattern_valid = false; /* until all of it is there */
    cipc_status status = collect_pairs(s, lists, &pairs, &count, error);
    if (status) return status;
    cipc_block_matrix_free(&s->matrix);
    status = cipc_block_matrix_create(&s->matrix, s->free_count, (const int(*)[2])pairs, count, error);
    cipc_free(pairs);
    if (!status) status = cipc_linear_solver_analyze(s->solver, &s->matrix, error);
    if (status) return status;
    if (!s->static_slots) s->static_slots = cipc_alloc(PAIRS * static_count(s), sizeof(int));
    if (!s->static_slots) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "matrix", "no memory for the elements' slots");
    size_t first = 0;
    for (int g = 0; g < CIPC_GROUP_COUNT; first += (size_t)s->groups[g].count, g++) find_slots(s, &lists[g], s->static_slots + PAIRS * first);
    find_contact_slots(s, lists);
    s->pattern_valid = true;
    s->report->symbolic_analyses++;
    double seconds = cipc_seconds() - begin;
    s->report->seconds[CIPC_PHASE_SYMBOLIC] += seconds;
    s->report->seconds[CIPC_PHASE_ASSEMBLY] -= seconds; /* the caller counts the whole assembly */
    return CIPC_OK;
}

static cipc_status update_pattern(cipc_stepper *s, const cipc_term_list lists[CIPC_LIST_COUNT], cipc_error *error)
{
    cipc_status status = reserve_contact_slots(s, lists[CIPC_LIST_CONTACT].count + lists[CIPC_LIST_FRICTION].count + lists[CIPC_LIST_DAMPING].count, error);
    if (status) return status;
    if (s->pattern_valid && find_contact_slots(s, lists)) return CIPC_OK;
    return new_pattern(s, error);
}

/* --- values -------------------------------------------------------------------------------------------------------------------- */

/* SPEC R.1: the released code projects the strain limit's Hessian as a 6x6 matrix in F, not in the positions. D = F B, D = [x1-x0, x2-x0], so
 * H_F = (B (x) 1) H_D (B (x) 1)^T with H_D the blocks of nodes 1 and 2, and back with B^-1. */
static void project_in_deformation_gradient(const double inverse[3], double H[81])
{
    const double b[2][2] = {{1 / inverse[0], -inverse[1] / (inverse[0] * inverse[2])}, {0, 1 / inverse[2]}}; /* B */
    const double c[3][2] = {{-inverse[0], -inverse[1] - inverse[2]}, {inverse[0], inverse[1]}, {0, inverse[2]}}; /* dF = sum_i dx_i (x) c_i */
    double S[36], back[81] = {0};
    for (int l = 0; l < 2; l++)
        for (int m = 0; m < 2; m++)
            for (int r = 0; r < 9; r++) {
                double sum = 0;
                for (int k = 0; k < 4; k++) sum += b[l][k / 2] * b[m][k % 2] * H[(3 + 3 * (k / 2) + r / 3) * 9 + 3 + 3 * (k % 2) + r % 3];
                S[(3 * l + r / 3) * 6 + 3 * m + r % 3] = sum;
            }
    cipc_psd_project(2, S, false);
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++)
            for (int k = 0; k < 4; k++) back[i * 9 + j] += c[i / 3][k / 2] * c[j / 3][k % 2] * S[(3 * (k / 2) + i % 3) * 6 + 3 * (k % 2) + j % 3];
    memcpy(H, back, sizeof back);
}

/* The projected local Hessian of one term, 3n x 3n row-major, at its own scale. */
static void local_hessian(const cipc_stepper *s, const cipc_term_list *list, int i, double *H)
{
    double y[12];
    const cipc_energy *energy = cipc_term_energy(list, i);
    const void *params = cipc_term_params(list, i);
    const int *nodes = cipc_term_nodes(list, i);
    const double *positions = list->blended ? s->blend : s->x;
    for (int k = 0; k < energy->nodes; k++) v3_copy(y + 3 * k, positions + 3 * nodes[k]);
    if (!s->project) {
        energy->hessian(y, params, H);
        return;
    }
    if (!list->energy && cipc_contact_hessian_projected(((const cipc_contact *)(const void *)(list->params + (size_t)i * list->params_stride))->energy, y, params, H))
        return;
    if (s->options.released && list->energy == s->groups[CIPC_GROUP_HINGE].energy && fabs(cipc_hinge_angle(y)) < flat_angle) {
        memset(H, 0, 144 * sizeof *H); /* SPEC C.6: its arc cosine gives no gradient where the hinge is flat */
        return;
    }
    if (s->majorize_friction && energy == cipc_energy_entry(CIPC_ENERGY_FRICTION)) {
        cipc_friction_majorizer(y, params, H);
        return;
    }
    energy->hessian(y, params, H);
    if (s->options.released && list->energy == s->groups[CIPC_GROUP_STRAIN_LIMIT].energy)
        project_in_deformation_gradient(((const cipc_strain_limit *)params)->inverse_rest, H);
    else if (!list->convex) cipc_psd_project(energy->nodes, H, true);
}

static void list_hessians(cipc_stepper *s, const cipc_term_list *list)
{
    double factor = list->scale * list->chain * list->chain;
#pragma omp parallel for schedule(dynamic, 32) num_threads(s->options.threads)
    for (int i = 0; i < list->count; i++) {
        double *H = s->locals + 144 * (size_t)i;
        local_hessian(s, list, i, H);
        int n = 3 * cipc_term_energy(list, i)->nodes;
        for (int k = 0; k < n * n; k++) H[k] *= factor;
    }
}

/* Add block (row, column) of H (n x n), or its transpose, to the matrix block. */
static void add_block(double *entries, int stride, const double *H, int n, int row, int column, bool transpose)
{
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++)
            entries[c * stride + r] += transpose ? H[(3 * row + c) * n + 3 * column + r] : H[(3 * row + r) * n + 3 * column + c];
}

/* All blocks of a list that fall into the block columns [first, last). */
static void scatter_range(cipc_stepper *s, const cipc_term_list *list, const int *slots, int first, int last)
{
    for (int i = 0; i < list->count; i++) {
        const int *nodes = cipc_term_nodes(list, i);
        int count = cipc_term_energy(list, i)->nodes;
        const double *H = s->locals + 144 * (size_t)i;
        for (int k = 0; k < pair_count(count); k++) {
            int slot = slots[PAIRS * (size_t)i + (size_t)k];
            if (slot < 0) continue;
            int a = s->free_index[nodes[pair_row[k]]], b = s->free_index[nodes[pair_column[k]]], column = a < b ? a : b;
            if (column < first || column >= last) continue;
            double *entries = s->matrix.x + cipc_block_matrix_entry(&s->matrix, column, slot);
            int stride = cipc_block_matrix_stride(&s->matrix, column);
            add_block(entries, stride, H, 3 * count, pair_row[k], pair_column[k], a < b);
            /* Two nodes of a stencil that are one and the same node (short friction stencils) meet on a diagonal block: both halves count. */
            if (a == b && pair_row[k] != pair_column[k]) add_block(entries, stride, H, 3 * count, pair_row[k], pair_column[k], true);
        }
    }
}

static void scatter(cipc_stepper *s, const cipc_term_list *list, const int *slots)
{
    int threads = s->options.threads;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int t = 0; t < threads; t++)
        scatter_range(s, list, slots, (int)((long)s->free_count * t / threads), (int)((long)s->free_count * (t + 1) / threads));
}

/* Inertia and penalty: diagonal. */
static void add_node_terms(cipc_stepper *s)
{
    for (int k = 0; k < s->free_count; k++) {
        int node = s->free_nodes[k];
        double mass = cipc_inertial_mass(s, node) + cipc_drag_mass(s, node);
        if (s->penalty > 0 && s->moves[node]) mass += s->penalty * s->model->mass[node];
        double *entries = s->matrix.x + cipc_block_matrix_entry(&s->matrix, k, s->matrix.start[k]);
        int stride = cipc_block_matrix_stride(&s->matrix, k);
        for (int c = 0; c < 3; c++) entries[c * stride + c] += mass;
    }
}

cipc_status cipc_assemble_hessian(cipc_stepper *s, cipc_error *error)
{
    cipc_term_list lists[CIPC_LIST_COUNT];
    cipc_term_lists(s, &s->contacts, lists);
    cipc_status status = update_pattern(s, lists, error);
    if (status) return status;
    memset(s->matrix.x, 0, 9 * (size_t)s->matrix.start[s->matrix.n] * sizeof(double));
    size_t first = 0;
    for (int l = 0; l < CIPC_LIST_COUNT; l++) {
        status = cipc_reserve_locals(s, 144 * (size_t)lists[l].count, error);
        if (status) return status;
        list_hessians(s, &lists[l]);
        const int *slots = l < CIPC_GROUP_COUNT ? s->static_slots + PAIRS * first
                                                : s->contact_slots + first_slot(lists, l);
        scatter(s, &lists[l], slots);
        if (l < CIPC_GROUP_COUNT) first += (size_t)s->groups[l].count;
    }
    add_node_terms(s);
    return CIPC_OK;
}
