/* The conformance kit: inputs with right answers, our own answers, and the judge (SPEC V.8; docs/conformance.md). */
#ifndef CIPC_VERIFY_CONFORMANCE_H
#define CIPC_VERIFY_CONFORMANCE_H

#include <gsl/gsl_rng.h>
#include "verify/query.h"

/* Draw a query of the function; single: all its numbers are exactly floats. */
void verify_draw_query(const char *fn, gsl_rng *rng, long sample, bool single, cipc_query *query);
/* The right answer by the oracle, a new reference: what "want" holds; NULL: undecided, infeasible, or out of memory. */
json_t *verify_truth(const cipc_query *query);
/* The solver's answer, a new reference: what "got" holds; NULL: out of memory. */
json_t *verify_answer(const cipc_query *query);

/* Unit roundoff that a port is judged by. */
typedef enum verify_precision { VERIFY_BINARY64, VERIFY_BINARY32 } verify_precision;

/* One answer judged. ratio: the largest error over its tolerance. */
typedef struct verify_verdict {
    bool failed;
    char reason[160]; /* of a failure */
    double ratio;
    bool early, other_feature; /* counted, not failed */
    bool scored;               /* a time of impact: */
    double score;              /* returned / exact */
} verify_verdict;
/* want and got of a query of function fn. A want that cannot be read is a failure too. */
verify_verdict verify_judge(const char *fn, const json_t *want, const json_t *got, verify_precision precision);

/* What was found of one function. */
typedef struct verify_score {
    const char *fn;
    long count, failed, early, other_feature;
    double worst;
    long worst_id;
    long scored; /* times of impact, and the sum of returned / exact */
    double score;
} verify_score;

/* The judgement of streams of answers. */
typedef struct verify_judgement {
    verify_precision precision;
    int count;
    verify_score scores[VERIFY_FUNCTION_LIMIT];
    long answers, failures;
    FILE *complaints; /* a line each; the first ones only */
} verify_judgement;

/* vectors: lines with "want"; answers: lines with "got", or NULL: `vectors` has both. CIPC_OK however many failures there are; CIPC_E_BAD_QUERY: the vectors
 * themselves cannot be used; CIPC_E_OUT_OF_MEMORY. Names are for messages. */
cipc_status verify_judge_streams(FILE *vectors, const char *vectors_name, FILE *answers, const char *answers_name, verify_judgement *judgement, cipc_error *error);
/* The highest level all of whose functions were asked and passed; -1: none. */
int verify_level_reached(const verify_judgement *judgement);

#endif
