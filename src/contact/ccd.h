/* CCD of one pair among many, by the method of the options. */
#ifndef CIPC_CONTACT_CCD_H
#define CIPC_CONTACT_CCD_H

#include "cipc/contact.h"

/* cipc_ccd with permission to give up, without a hit, once its result is known to be later than bound <= t_max. */
cipc_ccd_result contact_ccd_until(const cipc_stencil_path *path, double thickness, double t_max, double bound, const cipc_ccd_options *options);

#endif
