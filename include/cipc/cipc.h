/* cipc/cipc.h - all of the library, for its users. The library's own files include the rooms they need, never this. */
#ifndef CIPC_CIPC_H
#define CIPC_CIPC_H

#include "cipc/base.h"
#include "cipc/geometry.h"
#include "cipc/model.h"
#include "cipc/energy.h"
#include "cipc/oracle.h"
#include "cipc/contact.h"
#include "cipc/implicit.h"
#include "cipc/asynchronous.h"
#include "cipc/massspring.h"
#include "cipc/invariant.h"
#include "cipc/scene.h"
#include "cipc/output.h"
#include "cipc/verify.h"

#endif
