/* Methods of continuous collision detection compared on the same queries, each answer against the exact time of impact (docs/ccd.md). */
#ifndef CIPC_VERIFY_CCD_COMPARISON_H
#define CIPC_VERIFY_CCD_COMPARISON_H

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "verify/ccd_queries.h"
#include "verify/toi.h"

/* A method: the slackness of its options is replaced by each query's scale. */
typedef struct verify_ccd_method {
    const char *name;
    verify_ccd ccd;
    cipc_ccd_options options;
} verify_ccd_method;
enum { VERIFY_CCD_METHODS = 4 };
/* The solver's: certified (always the first), additive in the paper's order of tests, cubic, minimum-separation. */
void verify_ccd_own_methods(verify_ccd_method methods[VERIFY_CCD_METHODS]);

/* The truth about a query on [0, 1]. */
typedef struct verify_ccd_truth {
    cipc_exact_impact contact; /* when the distance first is the thickness */
    double reach;              /* when the gap first is `scale` of the first one, as far as a conservative method need go; 1: never */
} verify_ccd_truth;

/* What an answer is worth. Of these exactly one holds. */
typedef enum verify_ccd_worth {
    VERIFY_CCD_USABLE = 0, /* a safe step of some length */
    VERIFY_CCD_MISSED,     /* a contact, and none reported */
    VERIFY_CCD_UNSAFE,     /* a contact reported, and a step that reaches it or leads past it */
    VERIFY_CCD_ZERO,       /* no step where there is room */
    VERIFY_CCD_TINY,       /* a safe step of less than a thousandth of the way that there is */
    VERIFY_CCD_WORTHS
} verify_ccd_worth;
const char *verify_ccd_worth_name(verify_ccd_worth worth);
verify_ccd_worth verify_ccd_worth_of(const verify_ccd_truth *truth, const cipc_ccd_result *answer);

/* One method on all judged queries of a file. */
typedef struct verify_ccd_score {
    long worth[VERIFY_CCD_WORTHS]; /* add up to the queries judged */
    long early;                    /* a contact reported where there is none: safe, and counted above as what it is */
    long capped;                   /* ended by the cap of iterations */
    double median, percentile_1;   /* of returned time / exact time of contact, over contacts that were not missed; NAN: there are none */
    double mean_ns, median_ns;     /* a query, least of some repetitions, a clock call included */
} verify_ccd_score;

typedef struct verify_ccd_comparison {
    long queries, judged, contacts;
    long started_close, undecided; /* not judged: the distance is at most the thickness at the start; the oracle has met its cap */
    long thick;                    /* of those judged: with a thickness */
    verify_ccd_score scores[VERIFY_CCD_METHODS];
} verify_ccd_comparison;

/* count <= VERIFY_CCD_METHODS. CIPC_E_OUT_OF_MEMORY. */
cipc_status verify_ccd_compare(const verify_ccd_queries *queries, const verify_ccd_method *methods, int count, verify_ccd_comparison *comparison, cipc_error *error);

#endif
