/* What this program was built with and runs on. */
#ifndef OUTPUT_VERSIONS_H
#define OUTPUT_VERSIONS_H

#include <jansson.h>

/* {"cipc": "0.1.0", "compiler": ..., "hdf5": ..., ...}; NULL: out of memory. */
json_t *cipc_versions(void);

#endif
