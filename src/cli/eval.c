/* cipc eval: the solver's own answers to queries on standard input. */
#include "cli/command.h"

#include <stdio.h>
#include "base/json_number.h"
#include "cli/conformance.h"
#include "cli/interrupt.h"
#include "verify/conformance.h"
#include "verify/json_lines.h"

enum { KEY_BRIEF = 0x5001 };

typedef struct request {
    const char *fn; /* NULL: any */
    bool named, brief;
} request;

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    if (key == KEY_BRIEF) {
        r->brief = true;
        return CIPC_OK;
    }
    if (r->named) return cipc_fail(error, CIPC_E_USAGE, "eval", "surplus argument '%s'", value);
    r->named = true;
    return cipc_take_function("eval", value, &r->fn, error);
}

static const struct argp_option options[] = {
    {"brief", KEY_BRIEF, NULL, 0, "Answer with id, fn and got alone instead of passing the whole query on", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc eval",
    options,
    "[FUNCTION|all]",
    "Read queries, JSON lines, from standard input and write them to standard output with the solver's answer in \"got\". A query needs no \"want\"."
    "\vExamples:\n"
    "  cipc vectors toi_edge_edge | cipc eval | cipc judge\n"
    "  cipc eval < worst.jsonl",
    take,
};

static cipc_status answer_line(const request *r, const verify_lines *lines, json_t *object, cipc_error *error)
{
    long id;
    const char *fn;
    cipc_query query;
    cipc_status status = verify_line_head(lines, object, &id, &fn, error);
    if (status == CIPC_OK && r->fn != NULL && r->fn != fn) {
        status = cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "id %ld asks %s, not %s", id, fn, r->fn);
    }
    if (status == CIPC_OK) status = verify_query_parse(object, fn, lines->place, &query, error);
    if (status != CIPC_OK) return status;
    json_t *line = r->brief ? json_pack("{s:I, s:s}", "id", (json_int_t)id, "fn", fn) : json_incref(object);
    bool good = line != NULL;
    cipc_json_put(line, "got", verify_answer(&query), &good);
    status = good ? cipc_write_line(line, error) : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, lines->place, "no memory for an answer");
    json_decref(line);
    return status;
}

static cipc_status answer_all(const request *r, cipc_error *error)
{
    verify_lines lines;
    json_t *object = NULL;
    verify_lines_init(&lines, stdin, "standard input");
    cipc_status status = verify_lines_next(&lines, &object, error);
    while (status == CIPC_OK && object != NULL) {
        status = answer_line(r, &lines, object, error);
        json_decref(object);
        object = NULL;
        if (status == CIPC_OK && cipc_interrupt_seen()) status = cipc_fail(error, CIPC_E_NO_PROGRESS, "eval", "interrupted by a signal");
        if (status == CIPC_OK) status = verify_lines_next(&lines, &object, error);
    }
    if (status == CIPC_OK && lines.number == 0) status = cipc_fail(error, CIPC_E_BAD_QUERY, "standard input", "is empty: there is no query");
    verify_lines_free(&lines);
    return status;
}

int cipc_command_eval(int argc, char **argv)
{
    request r = {.named = false};
    cipc_error error;
    bool answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &r, &answered, &error) != CIPC_OK) return cipc_say(&error);
    if (answered) return 0;
    cipc_interrupt_hold();
    return answer_all(&r, &error) == CIPC_OK ? 0 : cipc_say(&error);
}
