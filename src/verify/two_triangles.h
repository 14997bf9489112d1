/* "potential/two_triangles": the assembled barrier potential of two triangles (docs/conformance.md). x and rest: 18 numbers, a0 a1 a2 b0 b1 b2. */
#ifndef CIPC_VERIFY_TWO_TRIANGLES_H
#define CIPC_VERIFY_TWO_TRIANGLES_H

#include <gsl/gsl_rng.h>
#include "verify/query.h"
#include "verify/stencils.h"

enum { VERIFY_TWO_TRIANGLES_NUMBERS = 18, VERIFY_DHAT = 0, VERIFY_STIFFNESS = 1 }; /* places in cipc_query.params */

void verify_two_triangles_draw(gsl_rng *rng, cipc_query *query);
/* "value", "gradient", "hessian"; *good: false if memory ran out or the rest triangles have no area. */
json_t *verify_two_triangles_answer(const cipc_query *query, bool *good);
/* The same with tolerances, and "border". false: undecided or infeasible. */
bool verify_two_triangles_truth(const cipc_query *query, json_t *want);

#endif
