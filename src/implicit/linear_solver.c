/* CHOLMOD behind the interface of linear_solver.h. */
#include "implicit/linear_solver.h"

#include <cholmod.h>
#include <omp.h>
#include <string.h>

#include "implicit/split_factor.h"

/* An order is kept for the patterns that follow (contacts come and go, the mesh stays) until the factor has grown by this much since it was made. */
static const double largest_growth = 1.25;

struct cipc_linear_solver {
    cipc_split_factor *split;
    bool in_halves;       /* the present pattern is factorised by `split` */
    cholmod_common common;
    int *order;           /* fill-reducing order of the scalars, 3 n; NULL: none yet */
    int n;                /* block rows it is for */
    double fresh_entries; /* entries of the factor when the order was fresh; 0: it is being made */
    cholmod_factor *factor;
    cholmod_dense *solution, *workspace_y, *workspace_e;
};

cipc_status cipc_linear_solver_create(cipc_linear_solver **solver, cipc_error *error)
{
    cipc_linear_solver *s = cipc_alloc(1, sizeof *s);
    *solver = s;
    if (!s) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory");
    if (!cholmod_start(&s->common)) {
        cipc_free(s);
        *solver = NULL;
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "CHOLMOD does not start");
    }
    cipc_status status = cipc_split_factor_create(&s->split, error);
    if (status) {
        cipc_linear_solver_destroy(s);
        *solver = NULL;
        return status;
    }
    s->common.print = 0; /* errors come back as status */
    s->common.final_ll = 1;
    return CIPC_OK;
}

void cipc_linear_solver_destroy(cipc_linear_solver *s)
{
    if (!s) return;
    cipc_split_factor_destroy(s->split);
    cipc_free(s->order);
    cholmod_free_factor(&s->factor, &s->common);
    cholmod_free_dense(&s->solution, &s->common);
    cholmod_free_dense(&s->workspace_y, &s->common);
    cholmod_free_dense(&s->workspace_e, &s->common);
    cholmod_finish(&s->common);
    cipc_free(s);
}

static cipc_status solver_error(const cipc_linear_solver *s, const char *what, cipc_error *error)
{
    if (s->common.status == CHOLMOD_OUT_OF_MEMORY) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory to %s", what);
    return cipc_fail(error, CIPC_E_FACTORIZATION, "linear solver", "CHOLMOD failed to %s (status %d)", what, s->common.status);
}

/* Views of our arrays as CHOLMOD's; nothing is copied. */
static cholmod_sparse scalar_view(const cipc_block_matrix *A)
{
    size_t n = 3 * (size_t)A->n, entries = 9 * (size_t)A->start[A->n];
    cholmod_sparse view = {.nrow = n, .ncol = n, .nzmax = entries, .p = A->p, .i = A->i, .x = A->x, .stype = -1, .itype = CHOLMOD_INT,
                           .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE, .sorted = 1, .packed = 1};
    return view;
}

static cholmod_sparse block_graph_view(const cipc_block_matrix *A)
{
    size_t n = (size_t)A->n;
    cholmod_sparse view = {.nrow = n, .ncol = n, .nzmax = (size_t)A->start[A->n], .p = A->start, .i = A->row, .stype = -1, .itype = CHOLMOD_INT,
                           .xtype = CHOLMOD_PATTERN, .dtype = CHOLMOD_DOUBLE, .sorted = 1, .packed = 1};
    return view;
}

/* Fill-reducing order of the block graph: the better of AMD and METIS by fill, expanded to scalars. */
static cipc_status make_order(cipc_linear_solver *s, const cipc_block_matrix *A, cipc_error *error)
{
    cipc_free(s->order);
    s->order = cipc_alloc(3 * (size_t)A->n, sizeof(int));
    if (!s->order) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory to order the matrix");
    cholmod_sparse graph = block_graph_view(A);
    s->common.nmethods = 2;
    s->common.method[0].ordering = CHOLMOD_AMD;
    s->common.method[1].ordering = CHOLMOD_METIS;
    s->common.supernodal = CHOLMOD_SIMPLICIAL;
    cholmod_factor *symbolic = cholmod_analyze(&graph, &s->common);
    if (!symbolic) {
        cipc_free(s->order);
        s->order = NULL;
        return solver_error(s, "order the matrix", error);
    }
    const int *block_order = symbolic->Perm;
    for (int k = 0; k < 3 * A->n; k++) s->order[k] = 3 * block_order[k / 3] + k % 3;
    cholmod_free_factor(&symbolic, &s->common);
    s->n = A->n;
    s->fresh_entries = 0;
    return CIPC_OK;
}

/* Symbolic factorisation in the order at hand. */
static cipc_status analyze_in_order(cipc_linear_solver *s, const cipc_block_matrix *A, cipc_error *error)
{
    cholmod_sparse view = scalar_view(A);
    s->common.nmethods = 1;
    s->common.method[0].ordering = CHOLMOD_GIVEN;
    s->common.supernodal = CHOLMOD_AUTO;
    cholmod_free_factor(&s->factor, &s->common);
    s->factor = cholmod_analyze_p(&view, s->order, NULL, 0, &s->common);
    return s->factor ? CIPC_OK : solver_error(s, "analyse the matrix", error);
}

cipc_status cipc_linear_solver_analyze(cipc_linear_solver *s, const cipc_block_matrix *A, cipc_error *error)
{
    cipc_status status = cipc_split_factor_analyze(s->split, A, &s->in_halves, error);
    if (status || s->in_halves) return status;
    if (s->order && s->n == A->n) {
        status = analyze_in_order(s, A, error);
        if (status || s->common.lnz <= largest_growth * s->fresh_entries) return status;
    }
    status = make_order(s, A, error);
    if (!status) status = analyze_in_order(s, A, error);
    if (!status) s->fresh_entries = s->common.lnz;
    return status;
}

cipc_status cipc_linear_solver_factorize(cipc_linear_solver *s, const cipc_block_matrix *A, int threads, bool *definite, cipc_error *error)
{
    cholmod_sparse view = scalar_view(A);
    /* CHOLMOD opens parallel regions of its own accord; one thread asked for is one thread used. */
    int levels = omp_get_max_active_levels();
    if (threads == 1) omp_set_max_active_levels(0);
    if (s->in_halves) {
        cipc_status status = cipc_split_factor_factorize(s->split, A, threads, definite, error);
        omp_set_max_active_levels(levels);
        return status;
    }
    cholmod_factorize(&view, s->factor, &s->common);
    omp_set_max_active_levels(levels);
    *definite = s->common.status == CHOLMOD_OK;
    if (s->common.status == CHOLMOD_OK || s->common.status == CHOLMOD_NOT_POSDEF) return CIPC_OK;
    return solver_error(s, "factorise the matrix", error);
}

cipc_status cipc_linear_solver_solve(cipc_linear_solver *s, const double *b, double *x, int threads, cipc_error *error)
{
    if (s->in_halves) return cipc_split_factor_solve(s->split, b, x, threads, error);
    size_t n = s->factor->n;
    double *values = cipc_alloc(n, sizeof(double)); /* CHOLMOD's views are not const */
    if (!values) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory to solve");
    memcpy(values, b, n * sizeof(double));
    cholmod_dense right = {.nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = values, .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE};
    int solved = cholmod_solve2(CHOLMOD_A, s->factor, &right, NULL, &s->solution, NULL, &s->workspace_y, &s->workspace_e, &s->common);
    cipc_free(values);
    if (!solved) return solver_error(s, "solve", error);
    memcpy(x, s->solution->x, n * sizeof(double));
    return CIPC_OK;
}

double cipc_linear_solver_factor_entries(const cipc_linear_solver *s)
{
    if (s->in_halves) return cipc_split_factor_entries(s->split);
    return s->factor ? (s->factor->is_super ? (double)s->factor->xsize : (double)s->factor->nzmax) : 0;
}
