/* Additive CCD of one pair among many. */
#ifndef CIPC_CONTACT_ADDITIVE_CCD_H
#define CIPC_CONTACT_ADDITIVE_CCD_H

#include "cipc/contact.h"

/* cipc_additive_ccd with permission to give up, without a hit, once its result is known to be later than bound <= t_max. A hit at or before
 * the bound is the same as without the bound: the bound saves time, t_max decides. (docs/theory/contact.md section 5) */
cipc_ccd_result cipc_additive_ccd_until(cipc_pair_kind kind, const double *x, const double *p, double thickness, double t_max, double bound,
                                        const cipc_ccd_options *options);

#endif
