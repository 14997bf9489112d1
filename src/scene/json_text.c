/* A small JSON printer: jansson's own puts every element of an array on a line of its own and prints 0.04 as 0.040000000000000001. */
#include "scene/json_text.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/base.h"

typedef struct printer {
    char *text;
    size_t length, capacity;
    bool failed;
} printer;

static void put(printer *p, const char *text, size_t length)
{
    if (p->failed) return;
    if (p->length + length + 1 > p->capacity) {
        size_t capacity = 2 * (p->length + length + 1);
        char *larger = cipc_realloc(p->text, capacity, 1);
        if (larger == NULL) {
            p->failed = true;
            return;
        }
        p->text = larger;
        p->capacity = capacity;
    }
    memcpy(p->text + p->length, text, length);
    p->length += length;
    p->text[p->length] = '\0';
}

static void put_text(printer *p, const char *text)
{
    put(p, text, strlen(text));
}

static void put_line(printer *p, int indent)
{
    put_text(p, "\n");
    for (int i = 0; i < indent; i++) put_text(p, "  ");
}

/* A real always shows that it is one ("1.0"), so that -0.0 does not come back as the integer 0. */
static void put_real(printer *p, double value)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    put_text(p, text);
    if (strpbrk(text, ".e") == NULL) put_text(p, ".0");
}

static int put_callback(const char *buffer, size_t size, void *data)
{
    put(data, buffer, size);
    return 0;
}

/* Strings, integers, true, false and null are as jansson prints them. */
static void put_scalar(printer *p, json_t *value)
{
    if (json_is_real(value)) {
        put_real(p, json_real_value(value));
    } else if (json_dump_callback(value, put_callback, p, JSON_ENCODE_ANY) != 0) {
        p->failed = true;
    }
}

static bool is_flat(json_t *array)
{
    for (size_t i = 0; i < json_array_size(array); i++) {
        json_t *element = json_array_get(array, i);
        if (json_is_object(element) || json_is_array(element)) return false;
    }
    return true;
}

static void put_value(printer *p, json_t *value, int indent);

static void put_array(printer *p, json_t *array, int indent)
{
    bool flat = is_flat(array);
    put_text(p, "[");
    for (size_t i = 0; i < json_array_size(array); i++) {
        if (i > 0) put_text(p, flat ? ", " : ",");
        if (!flat) put_line(p, indent + 1);
        put_value(p, json_array_get(array, i), indent + 1);
    }
    if (!flat) put_line(p, indent);
    put_text(p, "]");
}

static void put_object(printer *p, json_t *object, int indent)
{
    if (json_object_size(object) == 0) {
        put_text(p, "{}");
        return;
    }
    put_text(p, "{");
    const char *key;
    json_t *member;
    bool first = true;
    json_object_foreach(object, key, member)
    {
        if (!first) put_text(p, ",");
        first = false;
        put_line(p, indent + 1);
        json_t *name = json_string(key);
        if (name == NULL)
            p->failed = true;
        else
            put_scalar(p, name);
        json_decref(name);
        put_text(p, ": ");
        put_value(p, member, indent + 1);
    }
    put_line(p, indent);
    put_text(p, "}");
}

static void put_value(printer *p, json_t *value, int indent)
{
    if (json_is_object(value))
        put_object(p, value, indent);
    else if (json_is_array(value))
        put_array(p, value, indent);
    else
        put_scalar(p, value);
}

char *scene_json_text(json_t *value)
{
    printer p = {0};
    put_value(&p, value, 0);
    put_text(&p, "\n");
    if (!p.failed) return p.text;
    cipc_free(p.text);
    return NULL;
}
