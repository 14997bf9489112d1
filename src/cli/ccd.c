/* cipc ccd: methods of continuous collision detection compared on recorded queries. */
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include "base/json_number.h"
#include "output/atomic_file.h"
#include "output/versions.h"
#include "verify/ccd_comparison.h"

enum { KEY_JSON = 0x7001, MOST_FILES = 64 };

typedef struct request {
    const char *json;
    const char *files[MOST_FILES];
    int file_count;
} request;

/* What was found in each file. */
typedef struct result {
    const request *request;
    verify_ccd_method methods[VERIFY_CCD_METHODS];
    verify_ccd_comparison files[MOST_FILES];
} result;

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    if (key == KEY_JSON) {
        r->json = value;
        return CIPC_OK;
    }
    if (r->file_count == MOST_FILES) return cipc_fail(error, CIPC_E_USAGE, "ccd", "more than %d files", MOST_FILES);
    r->files[r->file_count++] = value;
    return CIPC_OK;
}

static const struct argp_option options[] = {
    {"json", KEY_JSON, "FILE", 0, "Write the comparison as JSON too", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc ccd",
    options,
    "QUERIES.jsonl...",
    "Compare methods of continuous collision detection - certified and plain additive, floating-point roots of the coplanarity cubic, and such roots "
    "with a minimum separation - on recorded queries, each answer against the exact time of impact: usable steps, missed contacts, unsafe steps, steps of zero and tiny ones, time."
    "\vExample:\n"
    "  cipc run tests/scenes/drape.json -o drape --record-ccd drape.jsonl\n"
    "  cipc ccd drape.jsonl\n\n"
    "Exit status: 0 the certified method is safe on all of them and makes a step wherever there is room; 1 out of memory, or a file could not be written; "
    "2 bad usage or bad input; 3 it is not. What the other methods do is no verdict.",
    take,
};

static cipc_status compare_file(result *r, int index, cipc_error *error)
{
    const char *path = r->request->files[index];
    FILE *stream = fopen(path, "r");
    if (stream == NULL) {
        cipc_fail(error, CIPC_E_MISSING_FILE, path, "cannot be opened");
        return cipc_fail_remedy(error, "name a file of cipc run --record-ccd");
    }
    verify_ccd_queries queries = {0};
    cipc_status status = verify_ccd_queries_read(&queries, stream, path, error);
    fclose(stream);
    if (status == CIPC_OK) status = verify_ccd_compare(&queries, r->methods, VERIFY_CCD_METHODS, &r->files[index], error);
    verify_ccd_queries_free(&queries);
    return status;
}

/* --- for people --- */

/* "out/drape.jsonl" -> "drape". */
static void short_name(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(name, size, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name) *dot = '\0';
}

static void print_ratio(double value)
{
    if (isnan(value)) printf(" %6s", "-");
    else printf(" %6.3f", value);
}

static void print_table(const result *r)
{
    char name[64];
    printf("%-20s %8s %8s  %-18s %8s %7s %7s %7s %7s %7s %6s %6s %9s %8s\n", "file", "queries", "contacts", "method", "usable", "missed", "unsafe", "zero", "tiny",
           "early", "median", "1 %", "mean ns", "median");
    for (int f = 0; f < r->request->file_count; f++) {
        const verify_ccd_comparison *c = &r->files[f];
        short_name(r->request->files[f], name, sizeof name);
        for (int m = 0; m < VERIFY_CCD_METHODS; m++) {
            const verify_ccd_score *s = &c->scores[m];
            if (m == 0) printf("%-20s %8ld %8ld", name, c->judged, c->contacts);
            else printf("%-20s %8s %8s", "", "", "");
            printf("  %-18s %8ld %7ld %7ld %7ld %7ld %7ld", r->methods[m].name, s->worth[VERIFY_CCD_USABLE], s->worth[VERIFY_CCD_MISSED], s->worth[VERIFY_CCD_UNSAFE],
                   s->worth[VERIFY_CCD_ZERO], s->worth[VERIFY_CCD_TINY], s->early);
            print_ratio(s->median);
            print_ratio(s->percentile_1);
            printf(" %9.0f %8.0f\n", s->mean_ns, s->median_ns);
        }
        if (c->started_close > 0) printf("%-20s %ld more queries start in contact: nothing is asked of them\n", "", c->started_close);
        if (c->undecided > 0) printf("%-20s %ld more queries are undecided by the exact arithmetic\n", "", c->undecided);
    }
}

/* --- for machines --- */

static json_t *score_json(const verify_ccd_method *method, const verify_ccd_score *s)
{
    json_t *object = json_object();
    bool good = object != NULL;
    cipc_json_put(object, "method", json_string(method->name), &good);
    for (int w = 0; w < VERIFY_CCD_WORTHS; w++) cipc_json_put(object, verify_ccd_worth_name((verify_ccd_worth)w), json_integer(s->worth[w]), &good);
    cipc_json_put(object, "early", json_integer(s->early), &good);
    cipc_json_put(object, "capped", json_integer(s->capped), &good);
    cipc_json_put(object, "median_toi_over_exact", cipc_json_number(s->median), &good);
    cipc_json_put(object, "percentile_1_toi_over_exact", cipc_json_number(s->percentile_1), &good);
    cipc_json_put(object, "mean_ns", cipc_json_number(s->mean_ns), &good);
    cipc_json_put(object, "median_ns", cipc_json_number(s->median_ns), &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static json_t *file_json(const result *r, int index)
{
    const verify_ccd_comparison *c = &r->files[index];
    json_t *object = json_object(), *methods = json_array();
    bool good = object != NULL && methods != NULL;
    for (int m = 0; m < VERIFY_CCD_METHODS && good; m++) good = json_array_append_new(methods, score_json(&r->methods[m], &c->scores[m])) == 0;
    cipc_json_put(object, "file", json_string(r->request->files[index]), &good);
    cipc_json_put(object, "queries", json_integer(c->queries), &good);
    cipc_json_put(object, "judged", json_integer(c->judged), &good);
    cipc_json_put(object, "contacts", json_integer(c->contacts), &good);
    cipc_json_put(object, "with_thickness", json_integer(c->thick), &good);
    cipc_json_put(object, "started_in_contact", json_integer(c->started_close), &good);
    cipc_json_put(object, "undecided", json_integer(c->undecided), &good);
    cipc_json_put(object, "methods", methods, &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static json_t *result_json(const result *r, bool failed)
{
    json_t *object = json_object(), *files = json_array();
    bool good = object != NULL && files != NULL;
    for (int f = 0; f < r->request->file_count && good; f++) good = json_array_append_new(files, file_json(r, f)) == 0;
    cipc_json_put(object, "verdict", json_string(failed ? "failed" : "passed"), &good);
    cipc_json_put(object, "files", files, &good);
    cipc_json_put(object, "versions", cipc_versions(), &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static cipc_status write_json(const result *r, bool failed, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, r->request->json, error);
    if (status != CIPC_OK) return status;
    json_t *json = result_json(r, failed);
    if (json == NULL) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, r->request->json, "no memory for the comparison");
    else if (json_dumpf(json, file.stream, JSON_INDENT(1) | CIPC_JSON_FORMAT) != 0 || fputc('\n', file.stream) == EOF)
        status = cipc_fail_io(error, r->request->json, "write the comparison");
    json_decref(json);
    return cipc_atomic_close(&file, status, error);
}

/* Answers of the certified method, the first, that break its promise. */
static long broken_promises(const result *r)
{
    long count = 0;
    for (int f = 0; f < r->request->file_count; f++) {
        const long *worth = r->files[f].scores[0].worth;
        count += worth[VERIFY_CCD_MISSED] + worth[VERIFY_CCD_UNSAFE] + worth[VERIFY_CCD_ZERO] + r->files[f].undecided;
    }
    return count;
}

static int finish(const result *r)
{
    cipc_error error;
    const long broken = broken_promises(r);
    print_table(r);
    if (r->request->json != NULL && write_json(r, broken > 0, &error) != CIPC_OK) return cipc_say(&error);
    if (broken == 0) return 0;
    cipc_fail(&error, CIPC_E_FAILED_VERDICT, "ccd", "the certified method failed, or the oracle could not decide, on %ld queries", broken);
    cipc_fail_remedy(&error, "please report the file: cipc vectors --from FILE, cipc eval and cipc judge name the queries");
    return cipc_say(&error);
}

int cipc_command_ccd(int argc, char **argv)
{
    request r = {.json = NULL};
    cipc_error error;
    bool answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &r, &answered, &error) != CIPC_OK) return cipc_say(&error);
    if (answered) return 0;
    if (r.file_count == 0) {
        cipc_fail(&error, CIPC_E_USAGE, "ccd", "no file of queries is named");
        cipc_fail_remedy(&error, "cipc run SCENE.json --record-ccd FILE records one");
        return cipc_say(&error);
    }
    result found = {.request = &r};
    verify_ccd_own_methods(found.methods);
    cipc_status status = CIPC_OK;
    for (int f = 0; f < r.file_count && status == CIPC_OK; f++) status = compare_file(&found, f, &error);
    return status == CIPC_OK ? finish(&found) : cipc_say(&error);
}
