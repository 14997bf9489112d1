/* JSON lines with places for messages. */
#include "verify/json_lines.h"

#include <string.h>

void verify_lines_init(verify_lines *lines, FILE *stream, const char *name) { *lines = (verify_lines){.stream = stream, .name = name}; }

void verify_lines_free(verify_lines *lines)
{
    cipc_free(lines->text);
    lines->text = NULL;
}

/* Read a line of any length into text, without its newline. 1: a whole line; 0: the end; -1: out of memory; -2: the newline is missing; -3: it holds a NUL byte. */
static int read_line(verify_lines *lines)
{
    size_t used = 0;
    bool nul = false;
    for (int c = fgetc(lines->stream); c != EOF; c = fgetc(lines->stream)) {
        if (used + 2 > lines->size) {
            size_t size = lines->size > 0 ? 2 * lines->size : 4096;
            char *text = cipc_realloc(lines->text, size, 1);
            if (text == NULL) return -1;
            lines->text = text;
            lines->size = size;
        }
        if (c == '\n') {
            lines->text[used] = '\0';
            return nul ? -3 : 1;
        }
        nul = nul || c == '\0';
        lines->text[used++] = (char)c;
    }
    return used == 0 ? 0 : -2;
}

cipc_status verify_lines_next(verify_lines *lines, json_t **object, cipc_error *error)
{
    *object = NULL;
    for (;;) {
        int got = read_line(lines);
        if (got == 0) return ferror(lines->stream) ? cipc_fail(error, CIPC_E_IO, lines->name, "cannot be read") : CIPC_OK;
        lines->number++;
        snprintf(lines->place, sizeof lines->place, "%s:%ld", lines->name, lines->number);
        if (got == -1) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, lines->place, "no memory for a line");
        if (got == -3) return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "holds a NUL byte");
        if (got == -2) return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "the stream ends in the middle of a line");
        if (lines->text[strspn(lines->text, " \t\r")] != '\0') break;
    }
    json_error_t found;
    *object = json_loads(lines->text, JSON_REJECT_DUPLICATES, &found);
    if (*object == NULL) return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "is not JSON: %s", found.text);
    if (json_is_object(*object)) return CIPC_OK;
    json_decref(*object);
    *object = NULL;
    return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "is not a JSON object");
}

cipc_status verify_line_head(const verify_lines *lines, const json_t *object, long *id, const char **fn, cipc_error *error)
{
    const json_t *number = json_object_get(object, "id");
    const char *name = json_string_value(json_object_get(object, "fn"));
    if (!json_is_integer(number)) return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "field \"id\" is missing or no whole number");
    *id = (long)json_integer_value(number);
    if (name == NULL) return cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "id %ld: field \"fn\" is missing or no text", *id);
    *fn = verify_function_name(name);
    if (*fn != NULL) return CIPC_OK;
    cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "id %ld: unknown function '%.60s'", *id, name);
    return cipc_fail_remedy(error, "cipc vectors --list names the functions");
}
