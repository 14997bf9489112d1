/* What a body must be before a model is made of it. */
#ifndef CIPC_MODEL_BODY_CHECK_H
#define CIPC_MODEL_BODY_CHECK_H

#include "cipc/model.h"

/* CIPC_E_OUT_OF_RANGE or CIPC_E_BAD_MESH with the body's name as the place. */
cipc_status cipc_body_check(const cipc_body_description *body, cipc_error *error);

/* Are all these numbers finite? NULL: yes. */
bool cipc_numbers_finite(const double *values, int count);

#endif
