/* Figures of the claims: what a test measured against what the claim asks for. The tests assert them; `make claims` makes docs/claims.md of them. */
#ifndef SUPPORT_CLAIM_H
#define SUPPORT_CLAIM_H

/* How a measured figure has to lie to its threshold. */
typedef enum claim_relation { CLAIM_LESS, CLAIM_AT_MOST, CLAIM_MORE, CLAIM_AT_LEAST, CLAIM_EQUAL } claim_relation;

/* Fails the test unless `measured` lies so to `threshold`; NaN never does. With CIPC_CLAIMS=FILE in the environment, first appends the figure to that file as a line of JSON: claim
 * ("C8", or "C8 coupled" for a row of its own), figure, measured, unit ("1": none), relation (<, <=, >, >=, =), threshold; 17 significant digits. ci/claims.json names the same figure
 * with the same relation and threshold, or the claim fails. Within a test program a claim's figure is reported once: report the worst of a loop. */
void claim_figure(const char *claim, const char *figure, double measured, const char *unit, claim_relation relation, double threshold);

/* The same for low < measured < high; the line has "low" and "high" and the relation "within". */
void claim_within(const char *claim, const char *figure, double measured, const char *unit, double low, double high);

#endif
