/* JUnit XML. */
#include "output/junit.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include "output/atomic_file.h"

/* Length of the UTF-8 sequence at the start of the text if it stands for a character that XML may have, or 0. (XML 1.0, 2.2: no control characters but tab and line ends, no surrogates,
 * not U+FFFE and U+FFFF, escaped or not.) */
static int character_length(const unsigned char *c)
{
    static const unsigned long least[5] = {0, 0, 0x80, 0x800, 0x10000}; /* shorter forms are no UTF-8 */
    if (c[0] < 0x80) {
        return c[0] >= 0x20 && c[0] != 0x7f ? 1 : 0;
    }
    const int length = c[0] >= 0xf0 && c[0] < 0xf8 ? 4 : c[0] >= 0xe0 && c[0] < 0xf0 ? 3 : c[0] >= 0xc0 && c[0] < 0xe0 ? 2 : 0;
    unsigned long code = length == 4 ? c[0] & 0x07u : length == 3 ? c[0] & 0x0fu : c[0] & 0x1fu;
    for (int i = 1; i < length; i++) {
        if ((c[i] & 0xc0) != 0x80) { /* the text's end too */
            return 0;
        }
        code = code << 6 | (c[i] & 0x3fu);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff, no_character = code == 0xfffe || code == 0xffff || code > 0x10ffff;
    return length > 0 && code >= least[length] && !surrogate && !no_character ? length : 0;
}

/* The text as the value of an attribute. */
static void put_text(FILE *stream, const char *text)
{
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0';) {
        const int length = character_length(c);
        switch (*c) {
        case '&': fputs("&amp;", stream); break;
        case '<': fputs("&lt;", stream); break;
        case '>': fputs("&gt;", stream); break;
        case '"': fputs("&quot;", stream); break;
        default: length > 0 ? (void)fwrite(c, 1, (size_t)length, stream) : (void)fputc('?', stream);
        }
        c += length > 0 ? length : 1;
    }
}

static void put_attribute(FILE *stream, const char *name, const char *text)
{
    fprintf(stream, " %s=\"", name);
    put_text(stream, text);
    fputc('"', stream);
}

static void put_counts(FILE *stream, const cipc_junit_case *cases, int count)
{
    int of[CIPC_JUNIT_OUTCOMES] = {0};
    for (int i = 0; i < count; i++) {
        of[cases[i].outcome]++;
    }
    fprintf(stream, " tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"%d\">\n", count, of[CIPC_JUNIT_FAILED], of[CIPC_JUNIT_ERROR], of[CIPC_JUNIT_SKIPPED]);
}

static void put_case(FILE *stream, const cipc_junit_case *c)
{
    static const char *const tags[CIPC_JUNIT_OUTCOMES] = {NULL, "failure", "error", "skipped"};
    fputs("    <testcase", stream);
    put_attribute(stream, "classname", c->suite);
    put_attribute(stream, "name", c->name);
    if (c->outcome == CIPC_JUNIT_PASSED) {
        fputs("/>\n", stream);
        return;
    }
    fprintf(stream, ">\n      <%s", tags[c->outcome]);
    put_attribute(stream, "message", c->message);
    fputs("/>\n    </testcase>\n", stream);
}

static int suite_length(const cipc_junit_case *cases, int count)
{
    int length = 0;
    while (length < count && strcmp(cases[length].suite, cases[0].suite) == 0) {
        length++;
    }
    return length;
}

cipc_status cipc_junit_write(const char *path, const cipc_junit_case *cases, int count, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites", file.stream);
    put_counts(file.stream, cases, count);
    for (int first = 0; first < count;) {
        const int length = suite_length(cases + first, count - first);
        fputs("  <testsuite", file.stream);
        put_attribute(file.stream, "name", cases[first].suite);
        put_counts(file.stream, cases + first, length);
        for (int i = first; i < first + length; i++) {
            put_case(file.stream, &cases[i]);
        }
        fputs("  </testsuite>\n", file.stream);
        first += length;
    }
    fputs("</testsuites>\n", file.stream);
    return cipc_atomic_close(&file, CIPC_OK, error);
}
