#include "support/claim.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/json_number.h"

static const char *const signs[] = {"<", "<=", ">", ">=", "="};

static bool holds(double measured, claim_relation relation, double threshold)
{
    switch (relation) {
    case CLAIM_LESS: return measured < threshold;
    case CLAIM_AT_MOST: return measured <= threshold;
    case CLAIM_MORE: return measured > threshold;
    case CLAIM_AT_LEAST: return measured >= threshold;
    case CLAIM_EQUAL: return measured == threshold;
    }
    return false;
}

/* Takes the line over. */
static void append(json_t *line)
{
    const char *path = getenv("CIPC_CLAIMS");
    if (path != NULL) {
        FILE *file = fopen(path, "a");
        if (file == NULL) fail_msg("cannot append to %s", path);
        if (line == NULL || json_dumpf(line, file, JSON_COMPACT | CIPC_JSON_FORMAT) != 0 || fputc('\n', file) == EOF || fclose(file) != 0) fail_msg("cannot write to %s", path);
    }
    json_decref(line);
}

void claim_figure(const char *claim, const char *figure, double measured, const char *unit, claim_relation relation, double threshold)
{
    append(json_pack("{s:s, s:s, s:o, s:s, s:s, s:o}", "claim", claim, "figure", figure, "measured", cipc_json_number(measured), "unit", unit, "relation", signs[relation], "threshold",
                     cipc_json_number(threshold)));
    if (!holds(measured, relation, threshold)) fail_msg("claim %s: %s is %.17g, asked for: %s %.17g", claim, figure, measured, signs[relation], threshold);
}

void claim_within(const char *claim, const char *figure, double measured, const char *unit, double low, double high)
{
    append(json_pack("{s:s, s:s, s:o, s:s, s:s, s:o, s:o}", "claim", claim, "figure", figure, "measured", cipc_json_number(measured), "unit", unit, "relation", "within", "low",
                     cipc_json_number(low), "high", cipc_json_number(high)));
    if (!(measured > low && measured < high)) fail_msg("claim %s: %s is %.17g, not between %.17g and %.17g", claim, figure, measured, low, high);
}
