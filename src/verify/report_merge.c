/* Reports read back from JSON, and joined: shards of one campaign that ran elsewhere. */
#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "verify/query.h"
#include "verify/report.h"

static cipc_status refuse(const char *file, cipc_error *error, const char *what)
{
    return cipc_fail(error, CIPC_E_BAD_QUERY, file, "is not a report to merge: %s", what);
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text != NULL ? text : "";
}

static long integer_of(const json_t *object, const char *key) { return (long)json_integer_value(json_object_get(object, key)); }

/* The query of a counter or a maximum. */
static bool read_query(const json_t *object, cipc_query *query, bool *has_query, long *sample)
{
    const json_t *value = json_object_get(object, "query");
    *has_query = value != NULL;
    if (value == NULL) return true;
    const char *fn = verify_function_name(text_of(value, "fn"));
    *sample = integer_of(object, "sample");
    return fn != NULL && verify_query_parse(value, fn, "query", query, NULL) == CIPC_OK;
}

static bool read_row(const json_t *object, verify_row *row)
{
    const json_t *counters = json_object_get(object, "counters"), *maxima = json_object_get(object, "maxima"), *histograms = json_object_get(object, "histograms");
    size_t i;
    const json_t *item;
    bool good = json_array_size(counters) <= VERIFY_COUNTERS && json_array_size(maxima) <= VERIFY_MAXIMA && json_array_size(histograms) <= 2;
    verify_row_init(row, text_of(object, "name"));
    row->samples = integer_of(object, "samples");
    for (i = 0; good && i < json_array_size(counters); i++) {
        item = json_array_get(counters, i);
        verify_counter *c = &row->counters[verify_row_branch(row, text_of(item, "name"), json_number_value(json_object_get(item, "least_share")))];
        c->forbidden = json_is_true(json_object_get(item, "forbidden"));
        c->count = integer_of(item, "count");
        good = read_query(item, &c->query, &c->has_query, &c->sample);
    }
    for (i = 0; good && i < json_array_size(maxima); i++) {
        item = json_array_get(maxima, i);
        verify_maximum *m = &row->maxima[verify_row_maximum(row, text_of(item, "name"), cipc_json_double(json_object_get(item, "limit")))];
        m->value = cipc_json_double(json_object_get(item, "value"));
        good = read_query(item, &m->query, &m->has_query, &m->sample);
    }
    for (i = 0; good && i < json_array_size(histograms); i++) {
        item = json_array_get(histograms, i);
        verify_histogram *h = &row->histograms[verify_row_histogram(row, text_of(item, "name"))];
        const json_t *bins = json_object_get(item, "bins");
        good = json_array_size(bins) == VERIFY_BINS;
        for (size_t b = 0; good && b < VERIFY_BINS; b++) {
            h->bins[b] = (long)json_integer_value(json_array_get(bins, b));
            h->total += h->bins[b];
        }
    }
    return good && row->name[0] != '\0' && row->samples >= 0;
}

static bool read_campaign(const json_t *object, verify_report *report)
{
    const json_t *rows = json_object_get(object, "rows");
    size_t count = json_array_size(rows);
    if (count == 0 || count > 1000) return false;
    verify_row *row = verify_report_add(report, text_of(object, "campaign"), (int)count);
    bool good = row != NULL;
    for (size_t r = 0; good && r < count; r++) good = read_row(json_array_get(rows, r), &row[r]);
    return good;
}

static cipc_status read_report(const json_t *from, const char *file, verify_report *report, cipc_error *error)
{
    const json_t *campaigns = json_object_get(from, "campaigns"), *done = json_object_get(from, "shards_done"), *seconds = json_object_get(from, "seconds");
    if (!json_is_object(from) || json_array_size(campaigns) == 0) return refuse(file, error, "it has no campaigns");
    report->seed = (unsigned long)json_integer_value(json_object_get(from, "seed"));
    report->samples = integer_of(from, "samples");
    report->shards = (int)integer_of(from, "shards");
    report->seconds = json_number_value(seconds);
    if (report->shards < 1 || report->shards > 64) return refuse(file, error, "\"shards\" is not a number from 1 to 64");
    for (size_t i = 0; i < json_array_size(done); i++) {
        json_int_t shard = json_integer_value(json_array_get(done, i));
        if (shard < 1 || shard > report->shards) return refuse(file, error, "\"shards_done\" names a shard that there is not");
        report->shards_done |= 1ULL << (shard - 1);
    }
    for (size_t i = 0; i < json_array_size(campaigns); i++)
        if (!read_campaign(json_array_get(campaigns, i), report)) return refuse(file, error, "a campaign or a row of it is malformed");
    return CIPC_OK;
}

static cipc_status join(verify_report *into, const verify_report *from, const char *file, cipc_error *error)
{
    if (into->seed != from->seed || into->samples != from->samples || into->shards != from->shards) {
        return refuse(file, error, "its seed, number of samples or number of shards is another");
    }
    if (into->shards_done & from->shards_done) return refuse(file, error, "a shard of it is there already");
    bool same = into->campaign_count == from->campaign_count;
    for (int c = 0; same && c < into->campaign_count; c++) {
        same = strcmp(into->campaigns[c].name, from->campaigns[c].name) == 0 && into->campaigns[c].row_count == from->campaigns[c].row_count;
        for (int r = 0; same && r < into->campaigns[c].row_count; r++) same = verify_row_merge(&into->campaigns[c].rows[r], &from->campaigns[c].rows[r]);
    }
    if (!same) return refuse(file, error, "its campaigns or rows are others");
    into->shards_done |= from->shards_done;
    into->seconds += from->seconds;
    return CIPC_OK;
}

cipc_status verify_report_merge(verify_report *into, const json_t *from, const char *file, cipc_error *error)
{
    verify_report *read = cipc_alloc(1, sizeof *read);
    if (read == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, file, "no memory for a report");
    cipc_status status = read_report(from, file, read, error);
    if (status == CIPC_OK && into->campaign_count == 0) {
        *into = *read;
        read->campaign_count = 0; /* the rows have another owner now */
    } else if (status == CIPC_OK) {
        status = join(into, read, file, error);
    }
    verify_report_free(read);
    cipc_free(read);
    return status;
}
