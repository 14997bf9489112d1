/* Words and numbers of a text. */
#include "scene/text_scan.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SHOWN_MAX = 40 };

int scene_shown(const scene_word *word)
{
    return word->length < SHOWN_MAX ? word->length : SHOWN_MAX;
}

bool scene_word_is(const scene_word *word, const char *text)
{
    return strlen(text) == (size_t)word->length && memcmp(word->text, text, (size_t)word->length) == 0;
}

/* The end of a long path tells more than its beginning. */
static cipc_status reject_v(scene_scan *scan, int line, cipc_status status, const char *format, va_list arguments)
{
    char place[sizeof scan->error->place], what[256];
    size_t length = strlen(scan->path), longest = sizeof place - 16;
    const char *path = length > longest ? scan->path + length - longest : scan->path;
    if (line > 0)
        snprintf(place, sizeof place, "%s:%d", path, line);
    else
        snprintf(place, sizeof place, "%s", path);
    vsnprintf(what, sizeof what, format, arguments);
    return cipc_fail(scan->error, status, place, "%s", what);
}

cipc_status scene_scan_reject(scene_scan *scan, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    cipc_status status = reject_v(scan, scan->line, CIPC_E_BAD_MESH, format, arguments);
    va_end(arguments);
    return status;
}

cipc_status scene_scan_reject_at(scene_scan *scan, int line, cipc_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    reject_v(scan, line, status, format, arguments);
    va_end(arguments);
    return status;
}

bool scene_next_word(scene_scan *scan, scene_reach reach, scene_word *word)
{
    for (; isspace((unsigned char)*scan->at); scan->at++) {
        if (*scan->at != '\n') continue;
        if (reach == SCENE_SAME_LINE) return false;
        scan->line++;
    }
    *word = (scene_word){scan->at, 0};
    while (word->length < 1 << 30 && *scan->at != '\0' && !isspace((unsigned char)*scan->at)) {
        scan->at++;
        word->length++;
    }
    return word->length > 0;
}

bool scene_peek_word(scene_scan *scan, scene_reach reach, scene_word *word)
{
    scene_scan ahead = *scan;
    return scene_next_word(&ahead, reach, word);
}

void scene_skip_line(scene_scan *scan)
{
    const char *end = strchr(scan->at, '\n');
    scan->at = end != NULL ? end : scan->at + strlen(scan->at);
}

cipc_status scene_expect_word(scene_scan *scan, scene_reach reach, const char *what, scene_word *word)
{
    if (scene_next_word(scan, reach, word)) return CIPC_OK;
    return scene_scan_reject(scan, "the %s ends where %s is expected", *scan->at == '\0' ? "file" : "line", what);
}

cipc_status scene_expect_number(scene_scan *scan, scene_reach reach, const char *what, double *value)
{
    scene_word word;
    cipc_status status = scene_expect_word(scan, reach, what, &word);
    if (status != CIPC_OK) return status;
    char *end;
    *value = strtod(word.text, &end);
    if (end != word.text + word.length) {
        return scene_scan_reject(scan, "'%.*s' is not a number; %s is expected", scene_shown(&word), word.text, what);
    }
    if (!isfinite(*value)) return scene_scan_reject(scan, "%s is not a finite number", what);
    return CIPC_OK;
}

cipc_status scene_expect_integer(scene_scan *scan, scene_reach reach, const char *what, long long *value)
{
    scene_word word;
    cipc_status status = scene_expect_word(scan, reach, what, &word);
    if (status != CIPC_OK) return status;
    char *end;
    errno = 0;
    *value = strtoll(word.text, &end, 10);
    if (end != word.text + word.length || errno != 0) {
        return scene_scan_reject(scan, "'%.*s' is not a whole number%s; %s is expected", scene_shown(&word), word.text, errno != 0 ? " of 64 bits" : "", what);
    }
    return CIPC_OK;
}

cipc_status scene_expect_count(scene_scan *scan, scene_reach reach, const char *what, long long limit, long long *value)
{
    cipc_status status = scene_expect_integer(scan, reach, what, value);
    if (status != CIPC_OK || (*value >= 0 && *value <= limit)) return status;
    return scene_scan_reject_at(scan, scan->line, CIPC_E_OUT_OF_RANGE, "%s is %lld; 0 to %lld are allowed", what, *value, limit);
}

cipc_status scene_expect_entry(scene_scan *scan, const char *entries, long long index, long long count)
{
    scene_word word;
    if (!scene_peek_word(scan, SCENE_ANYWHERE, &word)) return scene_scan_reject(scan, "the file ends after %lld of %lld %s", index, count, entries);
    if (word.text[0] != '$' && !(word.text[0] >= 'A' && word.text[0] <= 'Z')) return CIPC_OK;
    scene_next_word(scan, SCENE_ANYWHERE, &word);
    return scene_scan_reject(scan, "'%.*s' after %lld of %lld %s", scene_shown(&word), word.text, index, count, entries);
}

cipc_status scene_expect_line_end(scene_scan *scan, const char *what)
{
    scene_word word;
    if (!scene_next_word(scan, SCENE_SAME_LINE, &word)) return CIPC_OK;
    return scene_scan_reject(scan, "'%.*s' after %s", scene_shown(&word), word.text, what);
}
