/* The queries that a run puts to CCD, as JSON lines. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "base/json_number.h"

#include <errno.h>
#include <math.h>
#include <sys/stat.h>

typedef struct kept_query {
    long ordinal;
    int step;
    cipc_stencil_path path;
    double thickness, scale;
} kept_query;

struct cipc_ccd_record {
    const cipc_model *model;
    cipc_atomic_file file;
    kept_query *kept;
    long count, limit;
    long candidates;   /* seen so far: the ordinal of the next one */
    int halvings;      /* one in 2^halvings is kept */
};

/* Bits of a number mixed so that neighbours differ in every one (splitmix64): every n-th of a list instead could be the same places of a regular mesh again
 * and again. */
static unsigned long mix(unsigned long h)
{
    h += 0x9e3779b97f4a7c15UL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9UL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebUL;
    return h ^ (h >> 31);
}

static bool is_sampled(const cipc_ccd_record *r, long ordinal)
{
    return (mix((unsigned long)ordinal) & ((1UL << r->halvings) - 1)) == 0;
}

cipc_status cipc_ccd_record_open(cipc_ccd_record **record, const char *path, const cipc_model *model, long limit, cipc_error *error)
{
    struct stat found;
    *record = NULL;
    if (stat(path, &found) == 0 && S_ISDIR(found.st_mode)) {
        return cipc_fail(error, CIPC_E_IO, path, "cannot record CCD queries there: it is a folder");
    }
    cipc_ccd_record *r = cipc_alloc(1, sizeof *r);
    kept_query *kept = cipc_alloc((size_t)limit, sizeof *kept);
    if (r == NULL || kept == NULL) {
        cipc_free(r);
        cipc_free(kept);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for %ld CCD queries", limit);
    }
    cipc_status status = cipc_atomic_open(&r->file, path, error);
    if (status != CIPC_OK) {
        cipc_free(r);
        cipc_free(kept);
        return status;
    }
    r->model = model;
    r->kept = kept;
    r->limit = limit;
    *record = r;
    return CIPC_OK;
}

long cipc_ccd_record_count(const cipc_ccd_record *r)
{
    return r->count;
}

/* Make room: halve the sample until something goes. A limit of 1 may take several halvings. */
static void thin_out(cipc_ccd_record *r)
{
    while (r->count == r->limit && r->halvings < 62) {
        r->halvings++;
        long left = 0;
        for (long i = 0; i < r->count; i++) {
            if (is_sampled(r, r->kept[i].ordinal)) { r->kept[left++] = r->kept[i]; }
        }
        r->count = left;
    }
}

/* The query over t in [0, 1]: of a path cut at t_max, the part that is asked about. */
static void cut_at(cipc_stencil_path *path, double t_max)
{
    for (int i = 0; t_max < 1 && i < 12; i++) { path->p[i] *= t_max; }
}

static bool is_finite(const cipc_stencil_path *path)
{
    bool finite = true;
    for (int i = 0; i < 12; i++) { finite = finite && isfinite(path->x[i]) && isfinite(path->p[i]); }
    return finite;
}

static void keep(cipc_ccd_record *r, const kept_query *query)
{
    if (r->count == r->limit) { thin_out(r); }
    if (r->count < r->limit && is_sampled(r, query->ordinal)) { r->kept[r->count++] = *query; }
}

void cipc_ccd_record_search(void *context, const cipc_ccd_search *search)
{
    cipc_ccd_record *r = context;
    const long total = cipc_candidates_count(search->candidates);
    for (long i = 0; i < total; i++) {
        kept_query query = {.ordinal = r->candidates++, .step = search->step, .scale = search->options->slackness};
        if (!is_sampled(r, query.ordinal)) { continue; }
        if (!cipc_candidates_query(r->model, search->candidates, i, search->x, search->p, search->t_max, search->options, &query.path, &query.thickness)) {
            continue;
        }
        cut_at(&query.path, search->t_max);
        if (is_finite(&query.path)) { keep(r, &query); }
    }
}

/* ---- Writing -------------------------------------------------------------------------------------------------------------- */

static json_t *numbers(const double *values, int count)
{
    json_t *array = json_array();
    bool good = array != NULL;
    for (int i = 0; good && i < count; i++) { good = json_array_append_new(array, cipc_json_number(values[i])) == 0; }
    if (!good) { json_decref(array); }
    return good ? array : NULL;
}

static json_t *line_of(const cipc_ccd_record *r, const kept_query *q)
{
    const int n = 3 * cipc_pair_nodes(q->path.kind);
    json_t *line = json_object();
    bool good = line != NULL;
    cipc_json_put(line, "id", json_integer(q->ordinal), &good);
    cipc_json_put(line, "fn", json_sprintf("toi_%s", cipc_pair_name(q->path.kind)), &good);
    cipc_json_put(line, "x0", numbers(q->path.x, n), &good);
    cipc_json_put(line, "p", numbers(q->path.p, n), &good);
    cipc_json_put(line, "thickness", cipc_json_number(q->thickness), &good);
    cipc_json_put(line, "scale", cipc_json_number(q->scale), &good);
    cipc_json_put(line, "step", json_integer(q->step + 1), &good);
    cipc_json_put(line, "one_in", json_integer((json_int_t)1 << r->halvings), &good);
    if (!good) { json_decref(line); }
    return good ? line : NULL;
}

static cipc_status write_lines(const cipc_ccd_record *r, cipc_error *error)
{
    for (long i = 0; i < r->count; i++) {
        json_t *line = line_of(r, &r->kept[i]);
        if (line == NULL) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, r->file.path, "no memory for a line"); }
        errno = 0;
        const bool written = json_dumpf(line, r->file.stream, JSON_COMPACT | CIPC_JSON_FORMAT) == 0 && fputc('\n', r->file.stream) != EOF;
        json_decref(line);
        if (!written) { return cipc_fail_io(error, r->file.path, "write a CCD query"); }
    }
    return CIPC_OK;
}

static void release(cipc_ccd_record *r)
{
    cipc_free(r->kept);
    cipc_free(r);
}

cipc_status cipc_ccd_record_close(cipc_ccd_record *r, cipc_error *error)
{
    if (r == NULL) { return CIPC_OK; }
    cipc_status status = cipc_atomic_close(&r->file, write_lines(r, error), error);
    release(r);
    return status;
}

void cipc_ccd_record_discard(cipc_ccd_record *r)
{
    if (r == NULL) { return; }
    cipc_atomic_close(&r->file, CIPC_E_IO, NULL); /* any status but CIPC_OK: nothing is moved into place */
    release(r);
}
