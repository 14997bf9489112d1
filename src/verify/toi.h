/* The functions that the campaign "toi" tests and compares: the context of verify_toi. */
#ifndef CIPC_VERIFY_TOI_H
#define CIPC_VERIFY_TOI_H

#include "cipc/contact.h"
#include "verify/campaign.h"

typedef cipc_ccd_result (*verify_ccd)(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options);
typedef struct verify_toi_subject {
    verify_ccd ccd; /* under test */
} verify_toi_subject;

/* Judge one query of row `row` of the campaign; the query is noted where something is wrong. */
void verify_toi_judge(const cipc_stencil_path *path, double xi, long sample, verify_row *row, const verify_toi_subject *subject);
/* Parts of such a row. */
void verify_toi_describe(verify_row *row, const char *name, double least_hits);

#endif
