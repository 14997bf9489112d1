/* cipc vectors: inputs with right answers, a JSON line each. */
#include "cli/command.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include "base/json_number.h"
#include "cli/conformance.h"
#include "cli/interrupt.h"
#include "verify/conformance.h"
#include "verify/json_lines.h"

enum { KEY_COUNT = 0x4001, KEY_SEED, KEY_LIST, KEY_PRECISION, KEY_FROM, MOST_TRIES = 100 };

typedef struct request {
    const char *fn; /* NULL: all */
    const char *from; /* queries to answer instead of drawing any */
    bool named, list, single;
    long count, seed;
} request;

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    switch (key) {
    case KEY_COUNT: return cipc_parse_integer("--count", value, 1, 100000000, &r->count, error);
    case KEY_SEED: return cipc_parse_integer("--seed", value, 0, LONG_MAX, &r->seed, error);
    case KEY_LIST: r->list = true; return CIPC_OK;
    case KEY_FROM: r->from = value; return CIPC_OK;
    case KEY_PRECISION: return cipc_take_precision(value, &r->single, error);
    default:
        if (r->named) return cipc_fail(error, CIPC_E_USAGE, "vectors", "surplus argument '%s'", value);
        r->named = true;
        return cipc_take_function("vectors", value, &r->fn, error);
    }
}

static const struct argp_option options[] = {
    {"count", KEY_COUNT, "N", 0, "Vectors per function (default 100)", 0},
    {"seed", KEY_SEED, "S", 0, "Seed (default 1); the same seed gives the same vectors", 0},
    {"list", KEY_LIST, NULL, 0, "List the functions with their levels, and leave", 0},
    {"from", KEY_FROM, "FILE", 0, "Take the queries of FILE (-: standard input) instead of drawing any, and put the right answers in; other fields stay", 0},
    {"precision", KEY_PRECISION, "binary64|binary32", 0, "binary32: inputs that are exactly floats (default binary64)", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc vectors",
    options,
    "[FUNCTION|all]",
    "Write random and adversarial inputs of a function with right answers from exact and 512-bit arithmetic to standard output: JSON lines that "
    "any port can read."
    "\vExamples:\n"
    "  cipc vectors distance2_edge_edge --count 1000 | your-port | cipc judge\n"
    "  cipc vectors all | cipc eval | cipc judge\n"
    "  cipc vectors --from my-queries.jsonl > my-vectors.jsonl\n"
    "docs/conformance.md has every field.",
    take,
};

static cipc_status out_of_memory(const char *fn, cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, fn, "no memory for a vector"); }

/* One vector; inputs that the oracle cannot answer (infeasible after rounding to floats, say) are drawn anew. */
static cipc_status write_vector(const char *fn, gsl_rng *rng, long sample, bool single, long id, long of, cipc_error *error)
{
    cipc_query query;
    json_t *want = NULL;
    for (int i = 0; i < MOST_TRIES && want == NULL; i++) {
        verify_draw_query(fn, rng, sample, single, &query);
        want = verify_truth(&query);
    }
    if (want == NULL) return cipc_fail(error, CIPC_E_INDETERMINATE, fn, "no answer is known to %d inputs in a row", MOST_TRIES);
    json_t *line = cipc_query_json(&query, id);
    bool good = line != NULL;
    cipc_json_put(line, "of", json_integer(of), &good);
    cipc_json_put(line, "want", want, &good);
    cipc_status status = good ? cipc_write_line(line, error) : out_of_memory(fn, error);
    json_decref(line);
    return status;
}

static cipc_status write_all(const request *r, cipc_error *error)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    cipc_status status = rng != NULL ? CIPC_OK : out_of_memory("vectors", error);
    long id = 1, of = r->fn != NULL ? r->count : r->count * verify_function_count();
    for (int f = 0; f < verify_function_count() && status == CIPC_OK; f++) {
        const char *fn = verify_function_at(f);
        if (r->fn != NULL && r->fn != fn) continue;
        gsl_rng_set(rng, (unsigned long)r->seed + 1000003UL * (unsigned long)f);
        for (long i = 0; i < r->count && status == CIPC_OK; i++) {
            status = write_vector(fn, rng, i, r->single, id++, of, error);
            if (status == CIPC_OK && cipc_interrupt_seen()) status = cipc_fail(error, CIPC_E_NO_PROGRESS, "vectors", "interrupted by a signal");
        }
    }
    if (rng != NULL) gsl_rng_free(rng);
    return status;
}

/* The right answer to one query that somebody else has written. */
static cipc_status answer_line(const verify_lines *lines, json_t *object, cipc_error *error)
{
    long id;
    const char *fn;
    cipc_query query;
    cipc_status status = verify_line_head(lines, object, &id, &fn, error);
    if (status == CIPC_OK) status = verify_query_parse(object, fn, lines->place, &query, error);
    if (status != CIPC_OK) return status;
    json_t *want = verify_truth(&query);
    if (want == NULL) return cipc_fail(error, CIPC_E_INDETERMINATE, lines->place, "id %ld: no answer is known: the function is not defined there", id);
    bool good = true;
    json_object_del(object, "want"); /* the new one comes last */
    cipc_json_put(object, "want", want, &good);
    return good ? cipc_write_line(object, error) : out_of_memory(fn, error);
}

static cipc_status answer_file(const char *name, cipc_error *error)
{
    FILE *stream = strcmp(name, "-") == 0 ? stdin : fopen(name, "r");
    if (stream == NULL) return cipc_fail(error, CIPC_E_MISSING_FILE, name, "cannot be opened");
    verify_lines lines;
    json_t *object = NULL;
    verify_lines_init(&lines, stream, stream == stdin ? "standard input" : name);
    cipc_status status = verify_lines_next(&lines, &object, error);
    while (status == CIPC_OK && object != NULL) {
        status = answer_line(&lines, object, error);
        json_decref(object);
        object = NULL;
        if (status == CIPC_OK) status = verify_lines_next(&lines, &object, error);
    }
    if (status == CIPC_OK && lines.number == 0) status = cipc_fail(error, CIPC_E_BAD_QUERY, lines.name, "is empty: there is no query");
    verify_lines_free(&lines);
    if (stream != stdin) fclose(stream);
    return status;
}

int cipc_command_vectors(int argc, char **argv)
{
    request r = {.count = 100, .seed = 1};
    cipc_error error;
    bool answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &r, &answered, &error) != CIPC_OK) return cipc_say(&error);
    if (answered) return 0;
    if (r.list) {
        for (int f = 0; f < verify_function_count(); f++) printf("%d  %s\n", verify_function_level(verify_function_at(f)), verify_function_at(f));
        return 0;
    }
    if (r.from != NULL && r.named) {
        cipc_fail(&error, CIPC_E_USAGE, "vectors", "a function and --from at once");
        cipc_fail_remedy(&error, "the queries of the file name their functions");
        return cipc_say(&error);
    }
    if (!r.named && r.from == NULL) {
        cipc_fail(&error, CIPC_E_USAGE, "vectors", "no function is named");
        cipc_fail_remedy(&error, "name one of cipc vectors --list, or all");
        return cipc_say(&error);
    }
    cipc_interrupt_hold();
    const cipc_status status = r.from != NULL ? answer_file(r.from, &error) : write_all(&r, &error);
    return status == CIPC_OK ? 0 : cipc_say(&error);
}
