/* A = [A11 0 A13; 0 A22 A23; A31 A32 A33], 3 the separator. The halves [Ahh Ah3; A3h A33] are principal submatrices, hence positive definite if A is.
 * Their factors, separator last, end in a triangle Th with Th Th^T = A33 - A3h Ahh^-1 Ah3, so the Schur complement of both is
 *     S = T1 T1^T + T2 T2^T - A33                                                                                                          (7)
 * Its rounding error is that of A33, as in any Cholesky factorisation. Each half is CHOLMOD's, S is LAPACK's. */
#include "implicit/split_factor.h"

#include <cblas.h>
#include <cholmod.h>
#include <lapacke.h>
#include <string.h>

#include "implicit/blas_threads.h"

/* Fewer block rows than this are factorised faster whole. */
enum { SMALLEST_SPLIT = 256 };
/* A separator larger than this share of the block rows costs more than the halves save. */
static const double largest_separator = 0.12;
/* The partition is kept while contacts between the halves have not enlarged the separator by more than this. */
static const double largest_growth = 1.3;

/* One half: its left or right nodes first, the separator after them. */
typedef struct half {
    cholmod_common common;
    cholmod_factor *factor;
    cholmod_dense *solution, *workspace_y, *workspace_e;
    cipc_block_matrix matrix;
    int *nodes;      /* local block -> block of A */
    int own;         /* blocks before the separator */
    long *source;    /* where in A->x each entry of matrix.x comes from, -1: zero */
    int *order;      /* fill-reducing order of the scalars of `own` blocks of the partition, by block of A; -1 ends it */
    double *triangle; /* T, column-major, 3 separator x 3 separator */
    double *values;  /* right-hand side and work, 3 blocks */
    bool definite;
    cipc_status status;
} half;

struct cipc_split_factor {
    half halves[2];
    bool together;   /* the halves may be computed at the same time */
    int n, separator_count, fresh_separator;
    int *side;       /* block -> 0, 1, or 2: separator */
    int *local;      /* block -> local block in its half, or index in the separator */
    int *separator;  /* index -> block */
    double *schur;   /* S, then its factor */
    double *joint;   /* right-hand side of the separator */
};

cipc_status cipc_split_factor_create(cipc_split_factor **split, cipc_error *error)
{
    cipc_split_factor *s = cipc_alloc(1, sizeof *s);
    *split = s;
    if (!s) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory");
    s->together = cipc_blas_one_thread();
    for (int h = 0; h < 2; h++) {
        cholmod_start(&s->halves[h].common);
        s->halves[h].common.print = 0;
    }
    return CIPC_OK;
}

static void free_pattern(cipc_split_factor *s)
{
    for (int h = 0; h < 2; h++) {
        half *a = &s->halves[h];
        cholmod_free_factor(&a->factor, &a->common);
        cipc_block_matrix_free(&a->matrix);
        void **blocks[] = {(void **)&a->nodes, (void **)&a->source, (void **)&a->triangle, (void **)&a->values};
        for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
            cipc_free(*blocks[i]);
            *blocks[i] = NULL;
        }
    }
    cipc_free(s->schur);
    cipc_free(s->joint);
    s->schur = s->joint = NULL;
}

static void free_partition(cipc_split_factor *s)
{
    for (int h = 0; h < 2; h++) {
        cipc_free(s->halves[h].order);
        s->halves[h].order = NULL;
    }
    cipc_free(s->side);
    cipc_free(s->local);
    cipc_free(s->separator);
    s->side = s->local = s->separator = NULL;
    s->n = 0;
}

void cipc_split_factor_destroy(cipc_split_factor *s)
{
    if (!s) return;
    free_pattern(s);
    free_partition(s);
    for (int h = 0; h < 2; h++) {
        half *a = &s->halves[h];
        cholmod_free_dense(&a->solution, &a->common);
        cholmod_free_dense(&a->workspace_y, &a->common);
        cholmod_free_dense(&a->workspace_e, &a->common);
        cholmod_finish(&a->common);
    }
    cipc_free(s);
}

static cipc_status no_memory(cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "linear solver", "no memory for the matrix in halves"); }

static cipc_status half_error(const half *a, cipc_error *error)
{
    if (a->common.status == CHOLMOD_OUT_OF_MEMORY) return no_memory(error);
    return cipc_fail(error, CIPC_E_FACTORIZATION, "linear solver", "CHOLMOD failed on half of the matrix (status %d)", a->common.status);
}

/* --- partition ------------------------------------------------------------------------------------------------------------------ */

static cholmod_sparse graph_view(const cipc_block_matrix *A)
{
    size_t n = (size_t)A->n;
    cholmod_sparse view = {.nrow = n, .ncol = n, .nzmax = (size_t)A->start[A->n], .p = A->start, .i = A->row, .stype = -1, .itype = CHOLMOD_INT,
                           .xtype = CHOLMOD_PATTERN, .dtype = CHOLMOD_DOUBLE, .sorted = 1, .packed = 1};
    return view;
}

static cholmod_sparse scalar_view(const cipc_block_matrix *A)
{
    size_t n = 3 * (size_t)A->n;
    cholmod_sparse view = {.nrow = n, .ncol = n, .nzmax = 9 * (size_t)A->start[A->n], .p = A->p, .i = A->i, .x = A->x, .stype = -1, .itype = CHOLMOD_INT,
                           .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE, .sorted = 1, .packed = 1};
    return view;
}

/* Fill-reducing order of the blocks of one side alone: the better of AMD and METIS. */
static cipc_status order_side(cipc_split_factor *s, int h, const cipc_block_matrix *A, cipc_error *error)
{
    half *a = &s->halves[h];
    int count = 0;
    long pairs = 0;
    for (int j = 0; j < A->n; j++)
        if (s->side[j] == h) s->local[j] = count++;
    int(*list)[2] = cipc_alloc((size_t)A->start[A->n], sizeof *list);
    int *blocks = cipc_alloc((size_t)count, sizeof(int));
    a->order = cipc_alloc((size_t)A->n + 1, sizeof(int));
    cipc_block_matrix graph = {0};
    cipc_status status = list && blocks && a->order ? CIPC_OK : no_memory(error);
    if (!status) {
        for (int j = 0; j < A->n; j++) {
            if (s->side[j] != h) continue;
            blocks[s->local[j]] = j;
            for (int k = A->start[j]; k < A->start[j + 1]; k++)
                if (s->side[A->row[k]] == h) {
                    list[pairs][0] = s->local[A->row[k]];
                    list[pairs++][1] = s->local[j];
                }
        }
        for (long k = 0, kept = 0; k <= pairs; k++) { /* off-diagonal pairs only */
            if (k == pairs) {
                status = cipc_block_matrix_create(&graph, count, (const int(*)[2])list, kept, error);
            } else if (list[k][0] != list[k][1]) {
                list[kept][0] = list[k][0];
                list[kept++][1] = list[k][1];
            }
        }
    }
    if (!status) {
        cholmod_sparse view = graph_view(&graph);
        a->common.nmethods = 2;
        a->common.method[0].ordering = CHOLMOD_AMD;
        a->common.method[1].ordering = CHOLMOD_METIS;
        a->common.supernodal = CHOLMOD_SIMPLICIAL;
        cholmod_factor *symbolic = cholmod_analyze(&view, &a->common);
        if (symbolic) {
            for (int k = 0; k < count; k++) a->order[k] = blocks[((const int *)symbolic->Perm)[k]];
            a->order[count] = -1;
            cholmod_free_factor(&symbolic, &a->common);
        } else {
            status = half_error(a, error);
        }
    }
    cipc_block_matrix_free(&graph);
    cipc_free(list);
    cipc_free(blocks);
    return status;
}

static int count_separator(const cipc_split_factor *s)
{
    int count = 0;
    for (int j = 0; j < s->n; j++) count += s->side[j] == 2;
    return count;
}

static cipc_status make_partition(cipc_split_factor *s, const cipc_block_matrix *A, cipc_error *error)
{
    free_partition(s);
    s->side = cipc_alloc((size_t)A->n, sizeof(int));
    s->local = cipc_alloc((size_t)A->n, sizeof(int));
    s->separator = cipc_alloc((size_t)A->n, sizeof(int));
    if (!s->side || !s->local || !s->separator) return no_memory(error);
    s->n = A->n;
    cholmod_sparse graph = graph_view(A);
    half *a = &s->halves[0];
    if (cholmod_bisect(&graph, NULL, 0, 0, s->side, &a->common) < 0) return half_error(a, error);
    s->fresh_separator = count_separator(s);
    cipc_status status = order_side(s, 0, A, error);
    return status ? status : order_side(s, 1, A, error);
}

/* Blocks that couple the halves directly (a contact that came later) join the separator. */
static void mend_partition(cipc_split_factor *s, const cipc_block_matrix *A)
{
    for (int j = 0; j < A->n; j++)
        for (int k = A->start[j]; k < A->start[j + 1]; k++)
            if (s->side[j] + s->side[A->row[k]] == 1 && s->side[j] != 2 && s->side[A->row[k]] != 2) s->side[j] = 2;
}

/* --- pattern of the halves --------------------------------------------------------------------------------------------------------- */

static cipc_status number_half(cipc_split_factor *s, int h, cipc_error *error)
{
    half *a = &s->halves[h];
    a->own = 0;
    for (int j = 0; j < s->n; j++)
        if (s->side[j] == h) s->local[j] = a->own++;
    a->nodes = cipc_alloc((size_t)(a->own + s->separator_count), sizeof(int));
    if (!a->nodes) return no_memory(error);
    for (int j = 0; j < s->n; j++)
        if (s->side[j] == h) a->nodes[s->local[j]] = j;
    for (int k = 0; k < s->separator_count; k++) a->nodes[a->own + k] = s->separator[k];
    return CIPC_OK;
}

static int local_block(const cipc_split_factor *s, int h, int block)
{
    return s->side[block] == h ? s->local[block] : s->side[block] == 2 ? s->halves[h].own + s->local[block] : -1;
}

/* Blocks of A inside the half, and the whole triangle of the separator, so that it is one dense end of the factor. */
static cipc_status half_pattern(cipc_split_factor *s, int h, const cipc_block_matrix *A, cipc_error *error)
{
    half *a = &s->halves[h];
    long m = s->separator_count, count = 0;
    int(*pairs)[2] = cipc_alloc((size_t)A->start[A->n] + (size_t)(m * (m + 1) / 2), sizeof *pairs);
    if (!pairs) return no_memory(error);
    for (int j = 0; j < A->n; j++)
        for (int k = A->start[j] + 1; k < A->start[j + 1]; k++) {
            int r = local_block(s, h, A->row[k]), c = local_block(s, h, j);
            if (r < 0 || c < 0) continue;
            pairs[count][0] = r;
            pairs[count++][1] = c;
        }
    for (int i = 0; i < m; i++)
        for (int j = 0; j < i; j++) {
            pairs[count][0] = a->own + i;
            pairs[count++][1] = a->own + j;
        }
    cipc_status status = cipc_block_matrix_create(&a->matrix, a->own + (int)m, (const int(*)[2])pairs, count, error);
    cipc_free(pairs);
    return status;
}

/* Where each entry of the half comes from; a block whose local order is turned around comes transposed. */
static cipc_status half_sources(cipc_split_factor *s, int h, const cipc_block_matrix *A, cipc_error *error)
{
    half *a = &s->halves[h];
    const cipc_block_matrix *M = &a->matrix;
    a->source = cipc_alloc(9 * (size_t)M->start[M->n], sizeof(long));
    if (!a->source) return no_memory(error);
    for (int c = 0; c < M->n; c++)
        for (int k = M->start[c]; k < M->start[c + 1]; k++) {
            int row = a->nodes[M->row[k]], column = a->nodes[c];
            bool turned = row < column;
            int low = turned ? row : column, slot = cipc_block_matrix_find(A, turned ? column : row, low);
            int to = cipc_block_matrix_entry(M, c, k), to_stride = cipc_block_matrix_stride(M, c);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    long from = slot < 0 ? -1 : (long)cipc_block_matrix_entry(A, low, slot) + (long)(turned ? i : j) * cipc_block_matrix_stride(A, low) + (turned ? j : i);
                    a->source[to + j * to_stride + i] = from;
                }
        }
    return CIPC_OK;
}

/* Symbolic factorisation, the separator last. *last false if CHOLMOD's postordering did not leave it there in its order (it does where every part of the
 * half touches the separator: its dense triangle is a chain at the root of the elimination tree). */
static cipc_status half_symbolic(cipc_split_factor *s, int h, bool *last, cipc_error *error)
{
    half *a = &s->halves[h];
    int n = 3 * a->matrix.n, filled = 0;
    int *order = cipc_alloc((size_t)n, sizeof(int));
    if (!order) return no_memory(error);
    for (const int *block = a->order; *block >= 0; block++)
        if (s->side[*block] == h)
            for (int c = 0; c < 3; c++) order[filled++] = 3 * s->local[*block] + c;
    for (; filled < n; filled++) order[filled] = filled;
    cholmod_sparse view = scalar_view(&a->matrix);
    a->common.nmethods = 1;
    a->common.method[0].ordering = CHOLMOD_GIVEN;
    a->common.supernodal = CHOLMOD_SUPERNODAL;
    a->factor = cholmod_analyze_p(&view, order, NULL, 0, &a->common);
    cipc_free(order);
    if (!a->factor) return half_error(a, error);
    for (int k = 3 * a->own; k < n; k++) *last = *last && ((const int *)a->factor->Perm)[k] == k;
    return CIPC_OK;
}

static cipc_status analyze_halves(cipc_split_factor *s, const cipc_block_matrix *A, bool *last, cipc_error *error)
{
    size_t m = 0;
    for (int j = 0; j < s->n; j++)
        if (s->side[j] == 2) {
            s->separator[m] = j;
            s->local[j] = (int)m++;
        }
    s->separator_count = (int)m;
    *last = true;
    for (int h = 0; h < 2; h++) {
        half *a = &s->halves[h];
        cipc_status status = number_half(s, h, error);
        if (!status) status = half_pattern(s, h, A, error);
        if (!status) status = half_sources(s, h, A, error);
        if (!status) status = half_symbolic(s, h, last, error);
        if (status) return status;
        a->triangle = cipc_alloc(9 * m * m, sizeof(double));
        a->values = cipc_alloc(3 * (size_t)a->matrix.n, sizeof(double));
        if (!a->triangle || !a->values) return no_memory(error);
    }
    s->schur = cipc_alloc(9 * m * m, sizeof(double));
    s->joint = cipc_alloc(3 * m, sizeof(double));
    return s->schur && s->joint ? CIPC_OK : no_memory(error);
}

cipc_status cipc_split_factor_analyze(cipc_split_factor *s, const cipc_block_matrix *A, bool *worthwhile, cipc_error *error)
{
    cipc_status status = CIPC_OK;
    *worthwhile = false;
    free_pattern(s);
    if (A->n < SMALLEST_SPLIT) return CIPC_OK;
    bool fresh = s->n != A->n || !s->halves[1].order;
    if (!fresh) {
        mend_partition(s, A);
        fresh = count_separator(s) > largest_growth * s->fresh_separator + 4;
    }
    if (fresh) status = make_partition(s, A, error);
    if (status) free_partition(s);
    if (status || count_separator(s) > largest_separator * A->n) return status;
    status = analyze_halves(s, A, worthwhile, error);
    *worthwhile = *worthwhile && !status;
    return status;
}

/* --- values ------------------------------------------------------------------------------------------------------------------------ */

/* How many halves are worked on at the same time: see blas_threads.h. */
static int at_once(const cipc_split_factor *s, int threads) { return threads < 2 || !s->together ? 1 : 2; }

/* T from the supernodes that hold the separator's columns. */
static void extract_triangle(half *a)
{
    const cholmod_factor *L = a->factor;
    const int *super = L->super, *pi = L->pi, *px = L->px, *rows = L->s;
    const double *x = L->x;
    int first = 3 * a->own, m = 3 * a->matrix.n - first;
    memset(a->triangle, 0, (size_t)m * (size_t)m * sizeof(double));
    for (int k = 0; k < (int)L->nsuper; k++) {
        int count = pi[k + 1] - pi[k];
        for (int column = super[k] > first ? super[k] : first; column < super[k + 1]; column++)
            for (int r = column - super[k]; r < count; r++)
                a->triangle[(size_t)(column - first) * (size_t)m + (size_t)(rows[pi[k] + r] - first)] = x[(size_t)px[k] + (size_t)(column - super[k]) * (size_t)count + (size_t)r];
    }
}

static void factorize_half(half *a, const cipc_block_matrix *A)
{
    long entries = 9 * (long)a->matrix.start[a->matrix.n];
    for (long k = 0; k < entries; k++) a->matrix.x[k] = a->source[k] < 0 ? 0 : A->x[a->source[k]];
    cholmod_sparse view = scalar_view(&a->matrix);
    cholmod_factorize(&view, a->factor, &a->common);
    a->definite = a->common.status == CHOLMOD_OK;
    a->status = a->definite || a->common.status == CHOLMOD_NOT_POSDEF ? CIPC_OK : CIPC_E_FACTORIZATION;
    if (a->definite) extract_triangle(a);
}

/* (7), lower triangle. */
static void join(cipc_split_factor *s)
{
    int m = 3 * s->separator_count;
    const half *first = &s->halves[0]; /* both hold A33 */
    for (int j = 0; j < m; j++)
        for (int i = j; i < m; i++) {
            const cipc_block_matrix *M = &first->matrix;
            int c = first->own + j / 3, k = cipc_block_matrix_find(M, first->own + i / 3, c);
            s->schur[(size_t)j * (size_t)m + (size_t)i] = -M->x[cipc_block_matrix_entry(M, c, k) + (j % 3) * cipc_block_matrix_stride(M, c) + i % 3];
        }
    for (int h = 0; h < 2; h++) cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, m, m, 1, s->halves[h].triangle, m, 1, s->schur, m);
}

cipc_status cipc_split_factor_factorize(cipc_split_factor *s, const cipc_block_matrix *A, int threads, bool *definite, cipc_error *error)
{
#pragma omp parallel for num_threads(at_once(s, threads)) schedule(static, 1)
    for (int h = 0; h < 2; h++) factorize_half(&s->halves[h], A);
    *definite = false;
    for (int h = 0; h < 2; h++)
        if (s->halves[h].status) return half_error(&s->halves[h], error);
    if (!s->halves[0].definite || !s->halves[1].definite) return CIPC_OK;
    int m = 3 * s->separator_count;
    join(s);
    *definite = m == 0 || LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', m, s->schur, m) == 0;
    return CIPC_OK;
}

static bool solve_triangular(half *a, int system)
{
    size_t n = 3 * (size_t)a->matrix.n;
    cholmod_dense right = {.nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = a->values, .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE};
    if (!cholmod_solve2(system, a->factor, &right, NULL, &a->solution, NULL, &a->workspace_y, &a->workspace_e, &a->common)) return false;
    memcpy(a->values, a->solution->x, n * sizeof(double));
    return true;
}

/* L y = [b; 0]: the end of y is z with T z = -A3h Ahh^-1 b, so T z is what the half adds to the separator's right-hand side. */
static void forward(half *a, const double *b)
{
    const int *order = a->factor->Perm;
    int first = 3 * a->own, m = 3 * a->matrix.n - first;
    for (int k = 0; k < first; k++) a->values[k] = b[3 * a->nodes[order[k] / 3] + order[k] % 3];
    memset(a->values + first, 0, (size_t)m * sizeof(double));
    a->status = solve_triangular(a, CHOLMOD_L) ? CIPC_OK : CIPC_E_FACTORIZATION;
    cblas_dtrmv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, m, a->triangle, m, a->values + first, 1);
}

/* L^T x = [y; T^T x3]. */
static void backward(half *a, const double *joint, double *x)
{
    const int *order = a->factor->Perm;
    int first = 3 * a->own, m = 3 * a->matrix.n - first;
    for (int q = 0; q < m; q++) a->values[first + q] = joint[q];
    cblas_dtrmv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, m, a->triangle, m, a->values + first, 1);
    a->status = solve_triangular(a, CHOLMOD_Lt) ? CIPC_OK : CIPC_E_FACTORIZATION;
    for (int k = 0; k < first; k++) x[3 * a->nodes[order[k] / 3] + order[k] % 3] = a->values[k];
}

cipc_status cipc_split_factor_solve(cipc_split_factor *s, const double *b, double *x, int threads, cipc_error *error)
{
    int m = 3 * s->separator_count;
#pragma omp parallel for num_threads(at_once(s, threads)) schedule(static, 1)
    for (int h = 0; h < 2; h++) forward(&s->halves[h], b);
    for (int q = 0; q < m; q++) s->joint[q] = b[3 * s->separator[q / 3] + q % 3];
    for (int h = 0; h < 2; h++) {
        if (s->halves[h].status) return half_error(&s->halves[h], error);
        for (int q = 0; q < m; q++) s->joint[q] += s->halves[h].values[3 * s->halves[h].own + q];
    }
    if (m) LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', m, 1, s->schur, m, s->joint, m);
#pragma omp parallel for num_threads(at_once(s, threads)) schedule(static, 1)
    for (int h = 0; h < 2; h++) backward(&s->halves[h], s->joint, x);
    for (int h = 0; h < 2; h++)
        if (s->halves[h].status) return half_error(&s->halves[h], error);
    for (int q = 0; q < m; q++) x[3 * s->separator[q / 3] + q % 3] = s->joint[q];
    return CIPC_OK;
}

double cipc_split_factor_entries(const cipc_split_factor *s)
{
    double entries = 0;
    for (int h = 0; h < 2; h++)
        if (s->halves[h].factor) entries += (double)s->halves[h].factor->xsize;
    return entries;
}
