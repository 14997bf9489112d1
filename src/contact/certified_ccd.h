/* Certified CCD of one pair among many. */
#ifndef CIPC_CONTACT_CERTIFIED_CCD_H
#define CIPC_CONTACT_CERTIFIED_CCD_H

#include "cipc/contact.h"

/* cipc_certified_ccd with permission to give up, with FREE, once its result is known to be later than bound <= t_max (as cipc_additive_ccd_until). */
cipc_ccd_result contact_certified_ccd_until(const cipc_stencil_path *path, double thickness, double t_max, double bound, const cipc_ccd_options *options);

#endif
