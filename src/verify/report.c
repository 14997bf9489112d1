/* Tables and verdicts of campaigns. */
#include "verify/report.h"

#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "verify/query.h"

enum { CAMPAIGN_LIMIT = 8 };

void verify_report_free(verify_report *report)
{
    for (int i = 0; i < report->campaign_count; i++) cipc_free(report->campaigns[i].rows);
    report->campaign_count = 0;
}

verify_row *verify_report_add(verify_report *report, const char *name, int row_count)
{
    if (report->campaign_count == CAMPAIGN_LIMIT) return NULL;
    verify_row *rows = cipc_alloc((size_t)row_count, sizeof *rows);
    if (rows == NULL) return NULL;
    struct verify_campaign_rows *c = &report->campaigns[report->campaign_count++];
    snprintf(c->name, sizeof c->name, "%s", name);
    c->row_count = row_count;
    c->rows = rows;
    return rows;
}

bool verify_report_whole(const verify_report *report)
{
    return report->shards >= 64 ? ~report->shards_done == 0 : report->shards_done == (1ULL << report->shards) - 1;
}

int verify_report_failures(const verify_report *report, FILE *stream)
{
    char text[256];
    int failures = report->campaign_count == 0;
    bool whole = verify_report_whole(report);
    for (int c = 0; c < report->campaign_count; c++) {
        for (int r = 0; r < report->campaigns[c].row_count; r++) {
            if (!verify_row_failure(&report->campaigns[c].rows[r], whole, text, sizeof text)) continue;
            failures++;
            if (stream != NULL) fprintf(stream, "FAILED %s: %s\n", report->campaigns[c].name, text);
        }
    }
    return failures;
}

static void print_row(const verify_row *row, FILE *stream)
{
    char place[96];
    fprintf(stream, "  %s: %ld samples\n", row->name, row->samples);
    for (int i = 0; i < row->maximum_count; i++) {
        const verify_maximum *m = &row->maxima[i];
        if (!m->has_query) continue;
        if (isfinite(m->limit)) snprintf(place, sizeof place, "(at most %.3g; worst in sample %ld)", m->limit, m->sample);
        else snprintf(place, sizeof place, "(sample %ld)", m->sample);
        fprintf(stream, "    %-46s %12.4g  %s\n", m->name, m->value, place);
    }
    for (int i = 0; i < row->histogram_count; i++) {
        const verify_histogram *h = &row->histograms[i];
        if (h->total == 0) continue;
        fprintf(stream, "    %-46s median %.3f, 1st percentile %.3f (%ld)\n", h->name, verify_percentile(h, 0.5), verify_percentile(h, 0.01), h->total);
    }
    for (int i = 0; i < row->counter_count; i++) {
        const verify_counter *c = &row->counters[i];
        if (c->count == 0 && !c->forbidden && c->least_share == 0) continue;
        fprintf(stream, "    %-46s %12ld%s\n", c->name, c->count, c->forbidden ? "  (none allowed)" : "");
    }
}

void verify_report_print(const verify_report *report, FILE *stream)
{
    for (int c = 0; c < report->campaign_count; c++) {
        fprintf(stream, "%s\n", report->campaigns[c].name);
        for (int r = 0; r < report->campaigns[c].row_count; r++) print_row(&report->campaigns[c].rows[r], stream);
    }
}

/* --- JSON --- */

static json_t *counter_json(const verify_counter *c)
{
    json_t *object = json_object();
    bool good = object != NULL;
    cipc_json_put(object, "name", json_string(c->name), &good);
    cipc_json_put(object, "count", json_integer(c->count), &good);
    if (c->forbidden) cipc_json_put(object, "forbidden", json_true(), &good);
    if (c->least_share > 0) cipc_json_put(object, "least_share", cipc_json_number(c->least_share), &good);
    if (c->has_query) {
        cipc_json_put(object, "sample", json_integer(c->sample), &good);
        cipc_json_put(object, "query", cipc_query_json(&c->query, c->sample), &good);
    }
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static json_t *maximum_json(const verify_maximum *m)
{
    json_t *object = json_object();
    bool good = object != NULL;
    cipc_json_put(object, "name", json_string(m->name), &good);
    cipc_json_put(object, "limit", cipc_json_number(m->limit), &good);
    if (m->has_query) {
        cipc_json_put(object, "value", cipc_json_number(m->value), &good);
        cipc_json_put(object, "sample", json_integer(m->sample), &good);
        cipc_json_put(object, "query", cipc_query_json(&m->query, m->sample), &good);
    }
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static json_t *histogram_json(const verify_histogram *h)
{
    json_t *object = json_object(), *bins = json_array();
    bool good = object != NULL && bins != NULL;
    for (int b = 0; good && b < VERIFY_BINS; b++) good = json_array_append_new(bins, json_integer(h->bins[b])) == 0;
    cipc_json_put(object, "name", json_string(h->name), &good);
    cipc_json_put(object, "median", cipc_json_number(verify_percentile(h, 0.5)), &good);
    cipc_json_put(object, "percentile_1", cipc_json_number(verify_percentile(h, 0.01)), &good);
    cipc_json_put(object, "bins", bins, &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static void append(json_t *array, json_t *value, bool *good) { *good = *good && value != NULL && json_array_append_new(array, value) == 0; }

static json_t *row_json(const verify_row *row, bool whole)
{
    char text[256];
    json_t *object = json_object(), *counters = json_array(), *maxima = json_array(), *histograms = json_array();
    bool good = object != NULL && counters != NULL && maxima != NULL && histograms != NULL;
    for (int i = 0; i < row->counter_count; i++) append(counters, counter_json(&row->counters[i]), &good);
    for (int i = 0; i < row->maximum_count; i++) append(maxima, maximum_json(&row->maxima[i]), &good);
    for (int i = 0; i < row->histogram_count; i++) append(histograms, histogram_json(&row->histograms[i]), &good);
    cipc_json_put(object, "name", json_string(row->name), &good);
    cipc_json_put(object, "samples", json_integer(row->samples), &good);
    cipc_json_put(object, "counters", counters, &good);
    cipc_json_put(object, "maxima", maxima, &good);
    cipc_json_put(object, "histograms", histograms, &good);
    if (verify_row_failure(row, whole, text, sizeof text)) cipc_json_put(object, "failure", json_string(text), &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

json_t *verify_report_json(const verify_report *report, json_t *versions)
{
    json_t *object = json_object(), *campaigns = json_array(), *done = json_array();
    bool good = object != NULL && campaigns != NULL && done != NULL, whole = verify_report_whole(report);
    for (int s = 0; s < report->shards; s++)
        if (report->shards_done >> s & 1) append(done, json_integer(s + 1), &good);
    for (int c = 0; c < report->campaign_count; c++) {
        json_t *campaign = json_object(), *rows = json_array();
        good = good && campaign != NULL && rows != NULL;
        for (int r = 0; r < report->campaigns[c].row_count; r++) append(rows, row_json(&report->campaigns[c].rows[r], whole), &good);
        cipc_json_put(campaign, "campaign", json_string(report->campaigns[c].name), &good);
        cipc_json_put(campaign, "rows", rows, &good);
        append(campaigns, campaign, &good);
    }
    cipc_json_put(object, "verdict", json_string(verify_report_failures(report, NULL) == 0 ? "passed" : "failed"), &good);
    cipc_json_put(object, "seed", json_integer((json_int_t)report->seed), &good);
    cipc_json_put(object, "samples", json_integer(report->samples), &good);
    cipc_json_put(object, "shards", json_integer(report->shards), &good);
    cipc_json_put(object, "shards_done", done, &good);
    cipc_json_put(object, "seconds", cipc_json_number(report->seconds), &good);
    cipc_json_put(object, "versions", versions, &good);
    cipc_json_put(object, "campaigns", campaigns, &good);
    if (!good) json_decref(object);
    return good ? object : NULL;
}

static bool write_line(const cipc_query *query, long id, long sample, const char *campaign, const char *row, const char *what, double value, FILE *stream)
{
    json_t *line = cipc_query_json(query, id);
    bool good = line != NULL;
    cipc_json_put(line, "sample", json_integer(sample), &good);
    cipc_json_put(line, "campaign", json_string(campaign), &good);
    cipc_json_put(line, "row", json_string(row), &good);
    cipc_json_put(line, "because", json_string(what), &good);
    cipc_json_put(line, "value", cipc_json_number(value), &good);
    good = good && json_dumpf(line, stream, CIPC_JSON_FORMAT | JSON_COMPACT) == 0 && fputc('\n', stream) != EOF;
    json_decref(line);
    return good;
}

cipc_status verify_report_worst(const verify_report *report, FILE *stream, cipc_error *error)
{
    bool good = true;
    long id = 0;
    for (int c = 0; c < report->campaign_count; c++) {
        const char *campaign = report->campaigns[c].name;
        for (int r = 0; r < report->campaigns[c].row_count; r++) {
            const verify_row *row = &report->campaigns[c].rows[r];
            for (int i = 0; i < row->maximum_count; i++) {
                const verify_maximum *m = &row->maxima[i];
                if (m->has_query) good = good && write_line(&m->query, ++id, m->sample, campaign, row->name, m->name, m->value, stream);
            }
            for (int i = 0; i < row->counter_count; i++) {
                const verify_counter *k = &row->counters[i];
                if (k->has_query) good = good && write_line(&k->query, ++id, k->sample, campaign, row->name, k->name, (double)k->count, stream);
            }
        }
    }
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_IO, "worst cases", "cannot be written");
}
