/* cipc verify: campaigns of the solver's functions against the oracle. */
#include "cli/command.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "cli/interrupt.h"
#include "cli/simulation.h"
#include "output/atomic_file.h"
#include "output/junit.h"
#include "output/versions.h"
#include "scene/nearest_name.h"
#include "verify/public_queries.h"
#include "verify/report.h"

enum { KEY_SAMPLES = 0x3001, KEY_SEED, KEY_JSON, KEY_SHARD, KEY_MERGE, KEY_THREADS, KEY_DATA, KEY_WORST, KEY_JUNIT, MOST_SHARDS = 64, MOST_THREADS = 1024, MOST_FILES = 64 };

static const verify_campaign *const campaigns[] = {&verify_derivatives, &verify_distance, &verify_toi, &verify_energies, &verify_intersection};
enum { CAMPAIGN_COUNT = sizeof campaigns / sizeof campaigns[0] };

typedef struct request {
    const char *campaign, *json, *junit, *worst, *data;
    const char *files[MOST_FILES]; /* operands; the files to merge if `merge` */
    int file_count;
    long samples, seed, shard, shards, threads;
    bool merge, quiet;
} request;

/* "K/N". */
static cipc_status take_shard(request *r, const char *value, cipc_error *error)
{
    char *slash = strchr(value, '/');
    if (slash == NULL) {
        cipc_fail(error, CIPC_E_USAGE, "--shard", "'%s' is not of the form K/N", value);
        return cipc_fail_remedy(error, "give --shard 1/4, --shard 2/4 and so on");
    }
    char first[32];
    snprintf(first, sizeof first, "%.*s", (int)(slash - value), value);
    cipc_status status = cipc_parse_integer("--shard", slash + 1, 1, MOST_SHARDS, &r->shards, error);
    return status == CIPC_OK ? cipc_parse_integer("--shard", first, 1, r->shards, &r->shard, error) : status;
}

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    switch (key) {
    case 0:
        if (r->file_count == MOST_FILES) return cipc_fail(error, CIPC_E_USAGE, "verify", "more than %d operands", MOST_FILES);
        r->files[r->file_count++] = value;
        return CIPC_OK;
    case KEY_SAMPLES: return cipc_parse_integer("--samples", value, 1, 1000000000, &r->samples, error);
    case KEY_SEED: return cipc_parse_integer("--seed", value, 0, LONG_MAX, &r->seed, error);
    case KEY_JSON: r->json = value; return CIPC_OK;
    case KEY_JUNIT: r->junit = value; return CIPC_OK;
    case KEY_SHARD: return take_shard(r, value, error);
    case KEY_MERGE: r->merge = true; return CIPC_OK;
    case KEY_THREADS: return cipc_parse_integer("--threads", value, 1, MOST_THREADS, &r->threads, error);
    case KEY_DATA: r->data = value; return CIPC_OK;
    case KEY_WORST: r->worst = value; return CIPC_OK;
    default: r->quiet = true; return CIPC_OK; /* 'q' */
    }
}

static const struct argp_option options[] = {
    {"samples", KEY_SAMPLES, "N", 0, "Samples (default 20000); each row of a campaign takes a fixed share of N", 0},
    {"seed", KEY_SEED, "S", 0, "Seed of all samples (default 1): sample i is the same whatever the shards and threads", 0},
    {"json", KEY_JSON, "FILE", 0, "Write the report as JSON too", 0},
    {"junit", KEY_JUNIT, "FILE", 0, "Write the verdicts as JUnit XML too, a case per row of a campaign", 0},
    {"worst", KEY_WORST, "FILE", 0, "Write the worst cases as queries, a line each, which cipc eval replays", 0},
    {"data", KEY_DATA, "DIR", 0, "Run the public collision queries in DIR too (campaign toi)", 0},
    {"shard", KEY_SHARD, "K/N", 0, "Run the K-th of N parts only; --merge joins their reports", 0},
    {"merge", KEY_MERGE, NULL, 0, "Join the reports named instead of running anything", 0},
    {"threads", KEY_THREADS, "N", 0, "Number of threads (default 1)", 0},
    {"quiet", 'q', NULL, 0, "No progress line, and no table when all is well", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc verify",
    options,
    "[derivatives|distance|toi|energies|intersection|all]\n--merge REPORT.json...",
    "Hold the solver's functions against exact and MPFR arithmetic on many random and adversarial samples, and print for each what was "
    "found: worst errors, unsafe and missed answers, how often each branch was reached."
    "\vExamples:\n"
    "  cipc verify toi --samples 1000000 --threads 2 --json toi.json\n"
    "  parallel cipc verify all --samples 10000000 --shard {}/64 --quiet --json part{}.json ::: $(seq 64)\n"
    "  cipc verify --merge part*.json --json whole.json\n\n"
    "Exit status: 0 nothing failed; 1 stopped or out of memory; 2 bad usage or bad input; 3 a function failed.",
    take,
};

static bool show_progress(void *context, const char *campaign, const char *row, double share)
{
    const request *r = context;
    if (cipc_interrupt_seen()) return true;
    if (!r->quiet && isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K%s: %s: %.0f %%", campaign, row, 100 * share);
    return false;
}

static cipc_status run_campaign(const verify_campaign *campaign, const request *r, verify_report *report, cipc_error *error)
{
    const verify_run run = {.seed = (unsigned long)r->seed, .samples = r->samples, .shard = (int)r->shard, .shards = (int)r->shards,
                            .threads = (int)r->threads, .progress = show_progress, .progress_context = (void *)(size_t)r};
    verify_row *rows = verify_report_add(report, campaign->name, campaign->row_count);
    if (rows == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, campaign->name, "no memory for its rows");
    cipc_status status = CIPC_OK;
    for (int i = 0; i < campaign->row_count && status == CIPC_OK; i++) status = verify_run_row(campaign, i, &run, &rows[i], error);
    return status;
}

/* Which campaigns are asked for; -1: all. */
static cipc_status find_campaign(const request *r, int *index, cipc_error *error)
{
    const char *names[CAMPAIGN_COUNT + 1] = {"all"}, *asked = r->file_count > 0 ? r->files[0] : "all";
    *index = -1;
    if (r->file_count > 1) return cipc_fail(error, CIPC_E_USAGE, "verify", "surplus argument '%s': one campaign, or all", r->files[1]);
    for (int i = 0; i < CAMPAIGN_COUNT; i++) {
        names[i + 1] = campaigns[i]->name;
        if (strcmp(asked, campaigns[i]->name) == 0) *index = i;
    }
    if (*index >= 0 || strcmp(asked, "all") == 0) return CIPC_OK;
    cipc_fail(error, CIPC_E_USAGE, "verify", "unknown campaign '%s'", asked);
    return cipc_fail_remedy(error, "the nearest one is %s; see cipc verify --help", scene_nearest_name(asked, names, CAMPAIGN_COUNT + 1));
}

static cipc_status run_all(const request *r, verify_report *report, cipc_error *error)
{
    int only = -1;
    cipc_status status = find_campaign(r, &only, error);
    report->seed = (unsigned long)r->seed;
    report->samples = r->samples;
    report->shards = (int)r->shards;
    report->shards_done = 1ULL << (r->shard - 1);
    const double begin = cipc_clock();
    for (int i = 0; i < CAMPAIGN_COUNT && status == CIPC_OK; i++)
        if (only < 0 || only == i) status = run_campaign(campaigns[i], r, report, error);
    if (status == CIPC_OK && r->data != NULL) status = verify_public_campaign(r->data, (int)r->shard, (int)r->shards, report, error);
    report->seconds = cipc_clock() - begin;
    if (!r->quiet && isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
    return status;
}

static cipc_status merge_all(const request *r, verify_report *report, cipc_error *error)
{
    cipc_status status = r->file_count > 0 ? CIPC_OK : cipc_fail(error, CIPC_E_USAGE, "--merge", "no report is named");
    for (int i = 0; i < r->file_count && status == CIPC_OK; i++) {
        json_error_t found;
        json_t *from = json_load_file(r->files[i], JSON_REJECT_DUPLICATES, &found);
        if (from == NULL) {
            char place[512];
            snprintf(place, sizeof place, "%s:%d:%d", r->files[i], found.line, found.column);
            status = cipc_fail(error, access(r->files[i], R_OK) == 0 ? CIPC_E_BAD_QUERY : CIPC_E_MISSING_FILE, place, "%s", found.text);
        } else {
            status = verify_report_merge(report, from, r->files[i], error);
        }
        json_decref(from);
    }
    if (status == CIPC_OK && !verify_report_whole(report)) {
        status = cipc_fail(error, CIPC_E_BAD_QUERY, "--merge", "not all of the %d shards are there", report->shards);
        cipc_fail_remedy(error, "name a report of each shard");
    }
    return status;
}

static cipc_status write_json(const char *path, const verify_report *report, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) return status;
    json_t *json = verify_report_json(report, cipc_versions());
    if (json == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the report");
    } else if (json_dumpf(json, file.stream, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0 || fputc('\n', file.stream) == EOF) {
        status = cipc_fail_io(error, path, "write the report");
    }
    json_decref(json);
    return cipc_atomic_close(&file, status, error);
}

/* A case per row. */
static cipc_status write_junit(const char *path, const verify_report *report, cipc_error *error)
{
    const bool whole = verify_report_whole(report);
    int count = 0;
    for (int c = 0; c < report->campaign_count; c++) count += report->campaigns[c].row_count;
    cipc_junit_case *cases = cipc_alloc((size_t)count + 1, sizeof *cases);
    if (cases == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the verdicts");
    cipc_junit_case *next = cases;
    for (int c = 0; c < report->campaign_count; c++) {
        for (int i = 0; i < report->campaigns[c].row_count; i++, next++) {
            const verify_row *row = &report->campaigns[c].rows[i];
            *next = (cipc_junit_case){.suite = report->campaigns[c].name, .name = row->name};
            if (verify_row_failure(row, whole, next->message, sizeof next->message)) next->outcome = CIPC_JUNIT_FAILED;
        }
    }
    if (count == 0) { /* a merged report may have none: that is a failure, as it is in the exit status */
        cases[count++] = (cipc_junit_case){.suite = "cipc verify", .name = "the report", .outcome = CIPC_JUNIT_FAILED, .message = "has no row"};
    }
    const cipc_status status = cipc_junit_write(path, cases, count, error);
    cipc_free(cases);
    return status;
}

static cipc_status write_worst(const char *path, const verify_report *report, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    return status == CIPC_OK ? cipc_atomic_close(&file, verify_report_worst(report, file.stream, error), error) : status;
}

static int finish(const request *r, const verify_report *report)
{
    cipc_error error;
    cipc_status status = CIPC_OK;
    const int failures = verify_report_failures(report, NULL);
    if (!r->quiet || failures > 0) verify_report_print(report, stdout);
    if (r->json != NULL) status = write_json(r->json, report, &error);
    if (status == CIPC_OK && r->junit != NULL) status = write_junit(r->junit, report, &error);
    if (status == CIPC_OK && r->worst != NULL) status = write_worst(r->worst, report, &error);
    if (status != CIPC_OK) return cipc_say(&error);
    verify_report_failures(report, stdout);
    printf("seed %lu, %ld samples, %.1f s: %s\n", report->seed, report->samples, report->seconds,
           failures == 0 ? "nothing failed" : "FAILED");
    if (failures == 0) return 0;
    cipc_fail(&error, CIPC_E_FAILED_VERDICT, "verify", "%d rows failed", failures);
    return cipc_say(&error);
}

int cipc_command_verify(int argc, char **argv)
{
    request r = {.samples = 20000, .seed = 1, .shard = 1, .shards = 1, .threads = 1};
    cipc_error error;
    bool answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &r, &answered, &error) != CIPC_OK) return cipc_say(&error);
    if (answered) return 0;
    verify_report report = {0};
    cipc_interrupt_hold();
    cipc_status status = r.merge ? merge_all(&r, &report, &error) : run_all(&r, &report, &error);
    const int exit_status = status == CIPC_OK ? finish(&r, &report) : cipc_junit_refused(r.junit, "cipc verify", &error, cipc_say(&error));
    verify_report_free(&report);
    return exit_status;
}
