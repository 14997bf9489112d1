/* The version, in one place: the Makefile reads it from here. */
#include "cipc/base.h"

const char *cipc_version(void)
{
    return "0.1.0";
}
