/* A scanner that follows a path through JSON text and keeps no tree. */
#include "scene/json_place.h"

#include <stdbool.h>
#include <string.h>

/* What is left of the text. */
typedef struct scanner {
    const char *at, *end;
} scanner;

static bool looking_at(const scanner *s, char c)
{
    return s->at < s->end && *s->at == c;
}

static void skip_space(scanner *s)
{
    while (s->at < s->end && strchr(" \t\r\n", *s->at) != NULL && *s->at != '\0') s->at++;
}

static void skip_string(scanner *s)
{
    s->at++;
    while (s->at < s->end && *s->at != '"') s->at += *s->at == '\\' && s->at + 1 < s->end ? 2 : 1;
    if (s->at < s->end) s->at++;
}

static bool ends_scalar(char c)
{
    return c == ',' || c == ']' || c == '}' || c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Brackets are counted rather than recursed into, so that a deep text cannot exhaust the stack. */
static void skip_value(scanner *s)
{
    long depth = 0;
    do {
        if (s->at >= s->end) return;
        char c = *s->at;
        if (c == '"') {
            skip_string(s);
        } else if (c == '{' || c == '[') {
            depth++;
            s->at++;
        } else if (c == '}' || c == ']') {
            depth--;
            s->at++;
        } else if (depth > 0) {
            s->at++;
        } else {
            while (s->at < s->end && !ends_scalar(*s->at)) s->at++;
        }
    } while (depth > 0);
}

/* After a member or an element: true if another one follows. */
static bool skip_comma(scanner *s)
{
    skip_space(s);
    if (!looking_at(s, ',')) return false;
    s->at++;
    skip_space(s);
    return true;
}

/* From an object to the value of its member `key`; *key_at is where the key stands. */
static bool enter_member(scanner *s, const char *key, const char **key_at)
{
    if (!looking_at(s, '{')) return false;
    size_t length = strlen(key);
    s->at++;
    skip_space(s);
    while (looking_at(s, '"')) {
        const char *start = s->at;
        skip_string(s);
        bool same = (size_t)(s->at - start) == length + 2 && memcmp(start + 1, key, length) == 0;
        skip_space(s);
        if (!looking_at(s, ':')) return false;
        s->at++;
        skip_space(s);
        if (same) {
            *key_at = start;
            return true;
        }
        skip_value(s);
        if (!skip_comma(s)) return false;
    }
    return false;
}

/* From an array to its element `index`. */
static bool enter_element(scanner *s, size_t index)
{
    if (!looking_at(s, '[')) return false;
    s->at++;
    skip_space(s);
    if (looking_at(s, ']')) return false;
    for (size_t i = 0; i < index; i++) {
        skip_value(s);
        if (!skip_comma(s)) return false;
    }
    return s->at < s->end;
}

/* UTF-8: every byte that does not continue a character starts one. */
static bool starts_character(char c)
{
    return ((unsigned char)c & 0xC0) != 0x80;
}

static void count_lines(scene_place *place, const char *text, const char *at)
{
    place->line = 1;
    place->column = 1;
    for (const char *c = text; c < at; c++) {
        if (*c == '\n') {
            place->line++;
            place->column = 1;
        } else if (starts_character(*c)) {
            place->column++;
        }
    }
}

scene_place scene_find_place(const char *text, size_t length, const scene_step *steps, int step_count)
{
    scene_place place = {1, 1, 0};
    scanner s = {text, text + length};
    skip_space(&s);
    const char *at = s.at;
    while (place.matched < step_count) {
        const scene_step *step = &steps[place.matched];
        const char *here = NULL;
        if (!(step->key != NULL ? enter_member(&s, step->key, &here) : enter_element(&s, step->index))) break;
        at = here != NULL ? here : s.at;
        place.matched++;
    }
    count_lines(&place, text, at);
    return place;
}
