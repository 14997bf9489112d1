/* Rows of reports: counting, merging, judging. */
#include "verify/row.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void set_name(char name[VERIFY_NAME], const char *text) { snprintf(name, VERIFY_NAME, "%s", text); }

void verify_row_init(verify_row *row, const char *name)
{
    memset(row, 0, sizeof *row);
    set_name(row->name, name);
}

int verify_row_branch(verify_row *row, const char *name, double least_share)
{
    verify_counter *c = &row->counters[row->counter_count];
    set_name(c->name, name);
    c->least_share = least_share;
    return row->counter_count++;
}

int verify_row_counter(verify_row *row, const char *name) { return verify_row_branch(row, name, 0); }

int verify_row_forbid(verify_row *row, const char *name)
{
    int index = verify_row_counter(row, name);
    row->counters[index].forbidden = true;
    return index;
}

int verify_row_maximum(verify_row *row, const char *name, double limit)
{
    verify_maximum *m = &row->maxima[row->maximum_count];
    set_name(m->name, name);
    m->limit = limit;
    return row->maximum_count++;
}

int verify_row_histogram(verify_row *row, const char *name)
{
    set_name(row->histograms[row->histogram_count].name, name);
    return row->histogram_count++;
}

void verify_count(verify_row *row, int counter, long sample, const cipc_query *query)
{
    verify_counter *c = &row->counters[counter];
    c->count++;
    if (c->forbidden && query != NULL && (!c->has_query || sample < c->sample)) {
        c->has_query = true;
        c->sample = sample;
        c->query = *query;
    }
}

/* Does a come before b: larger, or as large and earlier? NaN is larger than anything. */
static bool comes_first(double a, long sample_a, double b, long sample_b)
{
    if (isnan(a) != isnan(b)) return isnan(a);
    return a > b || ((a == b || isnan(a)) && sample_a < sample_b);
}

void verify_measure(verify_row *row, int maximum, double value, long sample, const cipc_query *query)
{
    verify_maximum *m = &row->maxima[maximum];
    if (m->has_query && !comes_first(value, sample, m->value, m->sample)) return;
    m->value = value;
    m->sample = sample;
    m->has_query = true;
    m->query = *query;
}

void verify_ratio(verify_row *row, int histogram, double ratio)
{
    verify_histogram *h = &row->histograms[histogram];
    double place = ratio * (VERIFY_BINS / 2);
    int bin = !(place > 0) ? 0 : place >= VERIFY_BINS ? VERIFY_BINS - 1 : (int)place;
    h->bins[bin]++;
    h->total++;
}

static bool same_parts(const verify_row *a, const verify_row *b)
{
    bool same = strcmp(a->name, b->name) == 0 && a->counter_count == b->counter_count && a->maximum_count == b->maximum_count &&
                a->histogram_count == b->histogram_count;
    for (int i = 0; same && i < a->counter_count; i++) {
        const verify_counter *c = &a->counters[i], *d = &b->counters[i];
        same = strcmp(c->name, d->name) == 0 && c->forbidden == d->forbidden && c->least_share == d->least_share;
    }
    for (int i = 0; same && i < a->maximum_count; i++)
        same = strcmp(a->maxima[i].name, b->maxima[i].name) == 0 && a->maxima[i].limit == b->maxima[i].limit;
    for (int i = 0; same && i < a->histogram_count; i++) same = strcmp(a->histograms[i].name, b->histograms[i].name) == 0;
    return same;
}

bool verify_row_merge(verify_row *into, const verify_row *from)
{
    if (!same_parts(into, from)) return false;
    into->samples += from->samples;
    for (int i = 0; i < into->counter_count; i++) {
        verify_counter *c = &into->counters[i];
        const verify_counter *d = &from->counters[i];
        c->count += d->count;
        if (d->has_query && (!c->has_query || d->sample < c->sample)) {
            c->has_query = true;
            c->sample = d->sample;
            c->query = d->query;
        }
    }
    for (int i = 0; i < into->maximum_count; i++) {
        const verify_maximum *m = &from->maxima[i];
        if (m->has_query) verify_measure(into, i, m->value, m->sample, &m->query);
    }
    for (int i = 0; i < into->histogram_count; i++) {
        into->histograms[i].total += from->histograms[i].total;
        for (int b = 0; b < VERIFY_BINS; b++) into->histograms[i].bins[b] += from->histograms[i].bins[b];
    }
    return true;
}

double verify_percentile(const verify_histogram *h, double share)
{
    long wanted = (long)ceil(share * (double)h->total), seen = 0;
    if (h->total == 0) return NAN;
    for (int b = 0; b < VERIFY_BINS; b++) {
        seen += h->bins[b];
        if (seen >= wanted) return (double)b / (VERIFY_BINS / 2);
    }
    return NAN;
}

bool verify_row_failure(const verify_row *row, bool whole, char *text, size_t size)
{
    if (row->samples == 0 && whole) {
        snprintf(text, size, "%s: no sample was run", row->name);
        return true;
    }
    for (int i = 0; i < row->counter_count; i++) {
        const verify_counter *c = &row->counters[i];
        if (c->forbidden && c->count > 0) {
            snprintf(text, size, "%s: %s: %ld times, first in sample %ld", row->name, c->name, c->count, c->sample);
            return true;
        }
    }
    for (int i = 0; i < row->maximum_count; i++) {
        const verify_maximum *m = &row->maxima[i];
        if (m->has_query && !(m->value <= m->limit)) {
            snprintf(text, size, "%s: %s is %.3g, more than %.3g, in sample %ld", row->name, m->name, m->value, m->limit, m->sample);
            return true;
        }
    }
    for (int i = 0; whole && i < row->counter_count; i++) {
        const verify_counter *c = &row->counters[i];
        double least = floor(c->least_share * (double)row->samples);
        if (c->least_share > 0 && (double)c->count < (least > 1 ? least : 1)) {
            snprintf(text, size, "%s: branch %s was reached %ld times, at least %.0f are asked for", row->name, c->name, c->count, least > 1 ? least : 1);
            return true;
        }
    }
    return false;
}
