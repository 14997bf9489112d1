/* Options and the words for what happens. */
#include "cipc/asynchronous.h"

const double cipc_quantiles[CIPC_QUANTILES] = {0, 0.05, 0.25, 0.5, 0.75, 0.95, 1};

cipc_asynchronous_options cipc_asynchronous_options_default(void)
{
    return (cipc_asynchronous_options){
        .frame = 0.04, .thickness = 1e-3, .layer_factor = 0.025, .element_factor = 0.5, .clocks = CIPC_CLOCKS_NESTED, .event_limit = 200000000,
    };
}

const char *cipc_event_name(cipc_event_kind kind)
{
    static const char *const names[] = {
#define CIPC_X(name, text) text,
        CIPC_EVENTS(CIPC_X)
#undef CIPC_X
    };
    return kind >= 0 && kind < CIPC_EVENT_COUNT ? names[kind] : "unknown";
}

const char *cipc_asynchronous_phase_name(cipc_asynchronous_phase phase)
{
    static const char *const names[] = {
#define CIPC_X(name, text) text,
        CIPC_ASYNCHRONOUS_PHASES(CIPC_X)
#undef CIPC_X
    };
    return phase >= 0 && phase < CIPC_ASYNCHRONOUS_PHASE_COUNT ? names[phase] : "unknown";
}
