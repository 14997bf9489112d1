/* cipc/verify.h - campaigns that hold the solver's functions against the oracle; conformance vectors, eval, judge.
 * Floor 7. Nothing here prints: reports go to a FILE that the caller gives. */
#ifndef CIPC_VERIFY_H
#define CIPC_VERIFY_H

#include <stdbool.h>
#include <stdio.h>
#include <jansson.h>
#include "cipc/base.h"
#include "cipc/energy.h"

/* One question to one function, as a line of the conformance protocol holds it (docs/conformance.md). Which members count depends on the function. */
typedef struct cipc_query {
    const char *fn;       /* "distance2_point_triangle", "toi_edge_edge", "intersect_edge_triangle", "energy/hinge_bending": a string of the function table */
    double x[18];         /* positions; toi: at t = 0 ("x0"); edge and triangle: the edge's first */
    double x1[12];        /* toi: positions at t = 1; or the displacements ("p") */
    bool displacement;    /* toi: x1 holds displacements */
    double thickness;     /* toi, potential: xi */
    double scale;         /* toi: s of the conservative gap */
    double params[CIPC_ENERGY_NUMBERS]; /* energies: the flat list of the registry's fields; potential: dhat, stiffness */
    double rest[18];      /* potential: rest positions */
} cipc_query;
/* The query as one JSON object {"id":id,"fn":...,...}, a new reference; NULL: out of memory. Numbers are %.17g, non-finite ones strings. */
json_t *cipc_query_json(const cipc_query *query, long id);

#endif
