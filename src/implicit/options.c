/* Default options of the implicit integrator. */
#include "cipc/implicit.h"

cipc_implicit_options cipc_implicit_options_default(void)
{
    cipc_implicit_options options = {
        .time_step = 0.01,
        .integrator = {1, 1, 0},
        .newton_tolerance = 1e-3,
        .newton_norm = CIPC_NORM_MAX,
        .newton_iterations = 500,
        .line_search_halvings = 60,
        .friction_iterations = 1,
        .friction_cap = 50,
        .friction_velocity = 1e-3,
        .contact = cipc_contact_options_default(),
        .ccd = cipc_ccd_options_default(),
        .threads = 1,
    };
    return options;
}

const char *cipc_phase_name(cipc_phase phase)
{
    static const char *const names[CIPC_PHASE_COUNT] = {
#define CIPC_X(name, text) text,
        CIPC_PHASES(CIPC_X)
#undef CIPC_X
    };
    return phase >= 0 && phase < CIPC_PHASE_COUNT ? names[phase] : "unknown";
}
