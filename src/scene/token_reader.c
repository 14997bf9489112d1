/* Words of a text file. */
#include "scene/token_reader.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/text_file.h"

enum { SHOWN = 40 }; /* of a word in a message */

cipc_status scene_token_reject(token_reader *r, const char *format, ...)
{
    char place[sizeof r->error->place], what[256];
    if (r->status != CIPC_OK) return r->status;
    size_t length = strlen(r->path), longest = sizeof place - 16;
    snprintf(place, sizeof place, "%s:%d", length > longest ? r->path + length - longest : r->path, r->line);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    r->status = cipc_fail(r->error, CIPC_E_BAD_MESH, place, "%s", what);
    return r->status;
}

cipc_status scene_token_reader_open(token_reader *r, const char *path, cipc_error *error)
{
    size_t length = 0;
    *r = (token_reader){.path = path, .line = 1, .word = ""};
    r->error = error != NULL ? error : &r->own;
    r->status = scene_read_text(path, &r->text, &length, r->error);
    if (r->status != CIPC_OK) return r->status;
    r->at = r->text;
    if (strlen(r->text) != length) return scene_token_reject(r, "a binary file is not read: save it as ASCII");
    return CIPC_OK;
}

void scene_token_reader_close(token_reader *r)
{
    cipc_free(r->text);
    r->text = NULL;
}

bool scene_token_next(token_reader *r)
{
    if (r->status != CIPC_OK) return false;
    for (; isspace((unsigned char)*r->at); r->at++) r->line += *r->at == '\n';
    r->word = r->at;
    while (*r->at != '\0' && !isspace((unsigned char)*r->at)) r->at++;
    r->length = (int)(r->at - r->word);
    return r->length > 0;
}

bool scene_token_is(const token_reader *r, const char *word) { return (size_t)r->length == strlen(word) && memcmp(r->word, word, (size_t)r->length) == 0; }

void scene_token_skip_line(token_reader *r)
{
    if (r->status != CIPC_OK) return;
    while (*r->at != '\0' && *r->at != '\n') r->at++;
}

static bool next_of(token_reader *r, const char *what)
{
    if (r->status != CIPC_OK) return false;
    if (scene_token_next(r)) return true;
    scene_token_reject(r, "the file ends where %s should be", what);
    return false;
}

static void reject_word(token_reader *r, const char *what) { scene_token_reject(r, "'%.*s' is not %s", r->length < SHOWN ? r->length : SHOWN, r->word, what); }

double scene_token_number(token_reader *r, const char *what)
{
    char *end;
    if (!next_of(r, what)) return 0;
    double value = strtod(r->word, &end);
    if (end == r->at && isfinite(value)) return value;
    reject_word(r, what);
    return 0;
}

long long scene_token_integer(token_reader *r, const char *what, long long lower, long long upper)
{
    char *end;
    if (!next_of(r, what)) return lower;
    errno = 0;
    long long value = strtoll(r->word, &end, 10);
    if (end == r->at && errno == 0 && value >= lower && value <= upper) return value;
    if (end == r->at) scene_token_reject(r, "%s is %.*s, but must be between %lld and %lld", what, r->length < SHOWN ? r->length : SHOWN, r->word, lower, upper);
    else reject_word(r, what);
    return lower;
}
