/* cipc judge: a port's answers against vectors. */
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include "base/json_number.h"
#include "cli/conformance.h"
#include "output/atomic_file.h"
#include "output/junit.h"
#include "verify/conformance.h"

enum { KEY_PRECISION = 0x6001, KEY_JSON, KEY_JUNIT };

typedef struct request {
    const char *files[2], *json, *junit;
    int file_count;
    bool single, quiet;
} request;

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    switch (key) {
    case KEY_PRECISION: return cipc_take_precision(value, &r->single, error);
    case KEY_JSON: r->json = value; return CIPC_OK;
    case KEY_JUNIT: r->junit = value; return CIPC_OK;
    case 'q': r->quiet = true; return CIPC_OK;
    default:
        if (r->file_count == 2) return cipc_fail(error, CIPC_E_USAGE, "judge", "surplus argument '%s'", value);
        r->files[r->file_count++] = value;
        return CIPC_OK;
    }
}

static const struct argp_option options[] = {
    {"precision", KEY_PRECISION, "binary64|binary32", 0, "binary32: judge a port that computes in floats (default binary64)", 0},
    {"json", KEY_JSON, "FILE", 0, "Write the judgement as JSON too", 0},
    {"junit", KEY_JUNIT, "FILE", 0, "Write the verdicts as JUnit XML too, a case per function", 0},
    {"quiet", 'q', NULL, 0, "No table when all is well", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc judge",
    options,
    "[VECTORS [ANSWERS]]",
    "Judge answers against vectors: how far off, in units of the tolerance that the condition of each case allows; which times of impact are unsafe, "
    "which early. With one stream (default: standard input, or -) its lines hold both \"want\" and \"got\"."
    "\vExamples:\n"
    "  cipc vectors all | your-port | cipc judge\n"
    "  cipc judge vectors.jsonl answers.jsonl --json verdict.json\n\n"
    "Exit status: 0 all answers right; 2 the vectors cannot be used; 3 an answer is wrong, missing, unsafe, twice there or not readable.",
    take,
};

static cipc_status open_stream(const char *name, FILE **stream, cipc_error *error)
{
    *stream = strcmp(name, "-") == 0 ? stdin : fopen(name, "r");
    return *stream != NULL ? CIPC_OK : cipc_fail(error, CIPC_E_MISSING_FILE, name, "cannot be opened");
}

static void close_stream(FILE *stream)
{
    if (stream != NULL && stream != stdin) fclose(stream);
}

static void print_table(const verify_judgement *j)
{
    printf("%-32s %5s %8s %8s %10s %8s %8s %8s %9s\n", "function", "level", "answers", "failed", "worst", "at id", "early", "border", "toi/exact");
    for (int i = 0; i < j->count; i++) {
        const verify_score *s = &j->scores[i];
        printf("%-32s %5d %8ld %8ld %10.3g %8ld %8ld %8ld", s->fn, verify_function_level(s->fn), s->count, s->failed, s->worst, s->worst_id, s->early,
               s->other_feature);
        if (s->scored > 0) printf(" %9.4f", s->score / (double)s->scored);
        printf("\n");
    }
}

static json_t *judgement_json(const verify_judgement *j)
{
    json_t *object = json_object(), *functions = json_array();
    bool good = object != NULL && functions != NULL;
    for (int i = 0; i < j->count && good; i++) {
        const verify_score *s = &j->scores[i];
        json_t *entry = json_pack("{s:s, s:i, s:I, s:I, s:I, s:I, s:I}", "fn", s->fn, "level", verify_function_level(s->fn), "answers", (json_int_t)s->count, "failed",
                                  (json_int_t)s->failed, "early", (json_int_t)s->early, "border", (json_int_t)s->other_feature, "worst_id",
                                  (json_int_t)s->worst_id);
        cipc_json_put(entry, "worst", cipc_json_number(s->worst), &good);
        if (s->scored > 0) cipc_json_put(entry, "mean_toi_over_exact", cipc_json_number(s->score / (double)s->scored), &good);
        good = good && json_array_append_new(functions, entry) == 0;
    }
    cipc_json_put(object, "verdict", json_string(j->failures == 0 ? "passed" : "failed"), &good);
    cipc_json_put(object, "failures", json_integer(j->failures), &good);
    cipc_json_put(object, "answers", json_integer(j->answers), &good);
    cipc_json_put(object, "precision", json_string(j->precision == VERIFY_BINARY32 ? "binary32" : "binary64"), &good);
    cipc_json_put(object, "level", json_integer(verify_level_reached(j)), &good);
    cipc_json_put(object, "functions", functions, &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static cipc_status write_json(const char *path, const verify_judgement *j, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) return status;
    json_t *json = judgement_json(j);
    if (json == NULL) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the judgement");
    else if (json_dumpf(json, file.stream, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0 || fputc('\n', file.stream) == EOF)
        status = cipc_fail_io(error, path, "write the judgement");
    json_decref(json);
    return cipc_atomic_close(&file, status, error);
}

/* A case per function, and one for what is no answer to any: lines that cannot be read, ids that are unknown or stand twice. */
static cipc_status write_junit(const char *path, const verify_judgement *j, cipc_error *error)
{
    cipc_junit_case *cases = cipc_alloc((size_t)j->count + 1, sizeof *cases);
    if (cases == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the verdicts");
    long others = j->failures;
    for (int i = 0; i < j->count; i++) {
        const verify_score *s = &j->scores[i];
        cases[i] = (cipc_junit_case){.suite = "cipc judge", .name = s->fn, .outcome = s->failed > 0 ? CIPC_JUNIT_FAILED : CIPC_JUNIT_PASSED};
        snprintf(cases[i].message, sizeof cases[i].message, "%ld answers are wrong or missing; the worst is of id %ld", s->failed, s->worst_id);
        others -= s->failed;
    }
    cases[j->count] = (cipc_junit_case){.suite = "cipc judge", .name = "the stream", .outcome = others > 0 ? CIPC_JUNIT_FAILED : CIPC_JUNIT_PASSED};
    snprintf(cases[j->count].message, sizeof cases[j->count].message, "lines that are not there, are no answer, or answer no question: %ld", others);
    const cipc_status status = cipc_junit_write(path, cases, j->count + 1, error);
    cipc_free(cases);
    return status;
}

static int finish(const request *r, const verify_judgement *j)
{
    cipc_error error;
    if (!r->quiet || j->failures > 0) print_table(j);
    if (r->json != NULL && write_json(r->json, j, &error) != CIPC_OK) return cipc_say(&error);
    if (r->junit != NULL && write_junit(r->junit, j, &error) != CIPC_OK) return cipc_say(&error);
    const int level = verify_level_reached(j);
    printf("%ld answers, %ld failures", j->answers, j->failures);
    if (level >= 0) printf("; every function of level %d and below passed (%s)", level, j->precision == VERIFY_BINARY32 ? "binary32" : "binary64");
    printf("\n");
    if (j->failures == 0) return 0;
    cipc_fail(&error, CIPC_E_FAILED_VERDICT, "judge", "%ld failures", j->failures);
    cipc_fail_remedy(&error, "mend the answers named above");
    return cipc_say(&error);
}

int cipc_command_judge(int argc, char **argv)
{
    request r = {.file_count = 0};
    cipc_error error;
    bool answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &r, &answered, &error) != CIPC_OK) return cipc_say(&error);
    if (answered) return 0;
    const char *vectors_name = r.file_count > 0 ? r.files[0] : "-";
    FILE *vectors = NULL, *answers = NULL;
    verify_judgement j = {.precision = r.single ? VERIFY_BINARY32 : VERIFY_BINARY64, .complaints = stderr};
    cipc_status status = open_stream(vectors_name, &vectors, &error);
    if (status == CIPC_OK && r.file_count == 2) status = open_stream(r.files[1], &answers, &error);
    if (status == CIPC_OK && vectors == answers) status = cipc_fail(&error, CIPC_E_USAGE, "judge", "standard input cannot be both vectors and answers");
    if (status == CIPC_OK) {
        status = verify_judge_streams(vectors, strcmp(vectors_name, "-") == 0 ? "standard input" : vectors_name, answers,
                                      answers == stdin ? "standard input" : r.files[1], &j, &error);
    }
    const int exit_status = status == CIPC_OK ? finish(&r, &j) : cipc_junit_refused(r.junit, "cipc judge", &error, cipc_say(&error));
    close_stream(vectors);
    close_stream(answers);
    return exit_status;
}
