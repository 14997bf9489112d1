/* A pair in contact as JSON. */
#ifndef OUTPUT_CONTACT_PLACE_H
#define OUTPUT_CONTACT_PLACE_H

#include <jansson.h>
#include <stdbool.h>
#include "cipc/asynchronous.h"

/* null: there is none. */
json_t *cipc_contact_place_object(const cipc_contact_place *place, bool *good);
/* The way back; null, or anything but such an object: none. */
cipc_contact_place cipc_contact_place_of(const json_t *object);

#endif
