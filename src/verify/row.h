/* One row of a campaign's report: what a function under test did on its samples. Everything in it can be merged: counts add up, maxima and histograms join, so
 * shards and threads together give what one run would. */
#ifndef CIPC_VERIFY_ROW_H
#define CIPC_VERIFY_ROW_H

#include "cipc/verify.h"

enum { VERIFY_NAME = 48, VERIFY_COUNTERS = 24, VERIFY_MAXIMA = 6, VERIFY_BRANCHES = 32, VERIFY_BINS = 128 };

/* How often something happened. forbidden: once is a failure. branch: fewer than least_share of all samples is a failure. */
typedef struct verify_counter {
    char name[VERIFY_NAME];
    long count;
    bool forbidden;
    double least_share;
    bool has_query; /* of a forbidden one: the first sample in which it happened */
    long sample;
    cipc_query query;
} verify_counter;

/* The largest of some error, and where it occurred. Above the limit is a failure; limit INFINITY: for information. */
typedef struct verify_maximum {
    char name[VERIFY_NAME];
    double value, limit;
    bool has_query;
    long sample;
    cipc_query query;
} verify_maximum;

/* Ratios in [0, 2], for medians and percentiles. */
typedef struct verify_histogram {
    char name[VERIFY_NAME];
    long bins[VERIFY_BINS], total;
} verify_histogram;

typedef struct verify_row {
    char name[VERIFY_NAME];
    long samples;
    int counter_count, maximum_count, histogram_count;
    verify_counter counters[VERIFY_COUNTERS];
    verify_maximum maxima[VERIFY_MAXIMA];
    verify_histogram histograms[2];
} verify_row;

/* Set up a row, in the order in which its parts are declared; each returns the part's index. */
void verify_row_init(verify_row *row, const char *name);
int verify_row_counter(verify_row *row, const char *name);
int verify_row_forbid(verify_row *row, const char *name);
int verify_row_branch(verify_row *row, const char *name, double least_share);
int verify_row_maximum(verify_row *row, const char *name, double limit);
int verify_row_histogram(verify_row *row, const char *name);

/* Note what a sample did. query may be NULL. */
void verify_count(verify_row *row, int counter, long sample, const cipc_query *query);
void verify_measure(verify_row *row, int maximum, double value, long sample, const cipc_query *query);
void verify_ratio(verify_row *row, int histogram, double ratio);

/* into += from; both have the same parts. False: they have not. */
bool verify_row_merge(verify_row *into, const verify_row *from);
/* The value below which `share` of the histogram lies (the lower border of its bin). NAN if it is empty. */
double verify_percentile(const verify_histogram *histogram, double share);
/* The first thing that fails, in words, or false. whole: the row holds all samples, so that minima count. */
bool verify_row_failure(const verify_row *row, bool whole, char *text, size_t size);

#endif
