/* Public collision queries (the format: query_files.h). */
#include "verify/query_files.h"

#include <glob.h>
#include <gmp.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROWS = 8, NUMBERS = 6, LINE_SIZE = 2048 };

void verify_public_queries_free(verify_public_queries *q)
{
    cipc_free(q->query);
    *q = (verify_public_queries){0};
}

static bool grow(verify_public_queries *q)
{
    if (q->count < q->capacity) return true;
    int capacity = q->capacity > 0 ? 2 * q->capacity : 1024;
    verify_public_query *query = cipc_realloc(q->query, (size_t)capacity, sizeof *query);
    if (query == NULL) return false;
    q->query = query;
    q->capacity = capacity;
    return true;
}

/* numerator/denominator as a double; false unless it is exactly one. */
static bool exact_double(const char *numerator, const char *denominator, mpq_t scratch, double *x)
{
    if (mpz_set_str(mpq_numref(scratch), numerator, 10) != 0 || mpz_set_str(mpq_denref(scratch), denominator, 10) != 0) return false;
    if (mpz_sgn(mpq_denref(scratch)) <= 0) return false;
    mpq_canonicalize(scratch);
    *x = mpq_get_d(scratch);
    if (!isfinite(*x)) return false;
    mpq_t back;
    mpq_init(back);
    mpq_set_d(back, *x);
    bool same = mpq_equal(back, scratch) != 0;
    mpq_clear(back);
    return same;
}

/* One row; false if it is not seven integers of which the first six make three doubles, the last 0 or 1. */
static bool parse_row(char *line, mpq_t scratch, double x[3], bool *hit)
{
    char *word[NUMBERS + 1], *rest = line;
    for (int i = 0; i <= NUMBERS; i++) {
        word[i] = strsep(&rest, ",");
        if (word[i] == NULL) return false;
    }
    if (rest != NULL || strlen(word[NUMBERS]) != 1 || (*word[NUMBERS] != '0' && *word[NUMBERS] != '1')) return false;
    *hit = *word[NUMBERS] == '1';
    for (int k = 0; k < 3; k++)
        if (!exact_double(word[2 * k], word[2 * k + 1], scratch, &x[k])) return false;
    return true;
}

static cipc_status read_rows(verify_public_queries *q, FILE *file, const char *path, cipc_pair_kind kind, mpq_t scratch, cipc_error *error)
{
    char line[LINE_SIZE], place[512];
    verify_public_query next = {.path = {.kind = kind, .to_end = true}};
    int row = 0, number = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        number++;
        snprintf(place, sizeof place, "%s:%d", path, number);
        line[strcspn(line, "\r\n")] = '\0';
        bool hit = false;
        double *x = row < 4 ? &next.path.x[3 * row] : &next.path.p[3 * (row - 4)];
        if (!parse_row(line, scratch, x, &hit)) {
            return cipc_fail(error, CIPC_E_BAD_QUERY, place, "not a row of three fractions that are doubles and a truth of 0 or 1");
        }
        if (row > 0 && hit != next.hit) return cipc_fail(error, CIPC_E_BAD_QUERY, place, "the truth differs from that of the query's first row");
        next.hit = hit;
        row = (row + 1) % ROWS;
        if (row != 0) continue;
        if (!grow(q)) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d queries", q->count);
        q->query[q->count++] = next;
    }
    if (ferror(file)) return cipc_fail(error, CIPC_E_IO, path, "cannot be read");
    if (row != 0) return cipc_fail(error, CIPC_E_BAD_QUERY, path, "ends within a query: %d of %d rows", row, ROWS);
    return CIPC_OK;
}

cipc_status verify_public_queries_read(verify_public_queries *q, const char *path, cipc_pair_kind kind, cipc_error *error)
{
    FILE *file = fopen(path, "r");
    if (file == NULL) return cipc_fail(error, CIPC_E_MISSING_FILE, path, "cannot be opened");
    mpq_t scratch;
    mpq_init(scratch);
    cipc_status status = read_rows(q, file, path, kind, scratch, error);
    mpq_clear(scratch);
    fclose(file);
    return status;
}

static cipc_status read_matching(verify_public_queries *q, const char *directory, const char *folder, cipc_pair_kind kind, cipc_error *error)
{
    char pattern[1024];
    glob_t files;
    snprintf(pattern, sizeof pattern, "%s/*/%s/*.csv", directory, folder);
    cipc_status status = CIPC_OK;
    int found = glob(pattern, 0, NULL, &files);
    if (found == GLOB_NOSPACE) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, directory, "no memory for the names of its files");
    if (found != 0) return cipc_fail(error, CIPC_E_MISSING_FILE, directory, "has no files */%s/*.csv", folder);
    for (size_t i = 0; i < files.gl_pathc && status == CIPC_OK; i++) status = verify_public_queries_read(q, files.gl_pathv[i], kind, error);
    globfree(&files);
    return status;
}

cipc_status verify_public_queries_read_all(verify_public_queries *q, const char *directory, cipc_error *error)
{
    cipc_status status = read_matching(q, directory, "vertex-face", CIPC_POINT_TRIANGLE, error);
    return status == CIPC_OK ? read_matching(q, directory, "edge-edge", CIPC_EDGE_EDGE, error) : status;
}
