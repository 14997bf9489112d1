/* The names of the methods. */
#include "cipc/base.h"

const char *cipc_method_name(cipc_method method)
{
    static const char *const names[CIPC_METHOD_COUNT] = {
#define CIPC_X(name, text) text,
        CIPC_METHODS(CIPC_X)
#undef CIPC_X
    };
    return (unsigned)method < CIPC_METHOD_COUNT ? names[method] : "unknown";
}
