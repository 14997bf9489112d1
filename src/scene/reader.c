/* Typed reading with a sticky error. Every message is one clause: what stands there, what was expected. */
#include "scene/reader.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/nearest_name.h"

const scene_range scene_any = {-INFINITY, INFINITY, true, true};
const scene_range scene_positive = {0, INFINITY, true, true};
const scene_range scene_not_negative = {0, INFINITY, false, true};

void scene_reader_free(scene_reader *reader)
{
    json_decref(reader->root);
    cipc_free(reader->overrides);
    *reader = (scene_reader){0};
}

/* ---- places and errors ---- */

static bool is_inside(const char *address, const char *outer)
{
    size_t length = strlen(outer);
    return strncmp(address, outer, length) == 0 && (address[length] == '\0' || address[length] == SCENE_ADDRESS_MARK[0]);
}

/* The last override that set this value or something around it. */
static const scene_override *override_of(const scene_reader *reader, const scene_cursor *cursor)
{
    char address[sizeof reader->overrides->address];
    scene_cursor_address(cursor, address, sizeof address);
    for (int i = reader->override_count - 1; i >= 0; i--) {
        if (is_inside(address, reader->overrides[i].address)) return &reader->overrides[i];
    }
    return NULL;
}

/* A long file name keeps its end: line, column and path behind it must not be cut off. */
static const char *shortened(const char *path)
{
    enum { LONGEST = 200 };
    size_t length = strlen(path);
    return length > LONGEST ? path + length - LONGEST : path;
}

void scene_place_text(const scene_reader *reader, const scene_cursor *cursor, char *text, size_t size)
{
    char path[256];
    scene_cursor_path(cursor, path, sizeof path);
    const scene_override *override = override_of(reader, cursor);
    if (override != NULL) {
        bool exact = strcmp(path, override->path) == 0;
        snprintf(text, size, "%s%s%s", override->place, exact ? "" : " ", exact ? "" : path);
        return;
    }
    scene_step steps[SCENE_DEPTH];
    int count = scene_cursor_steps(cursor, steps);
    scene_place place = scene_find_place(reader->text, reader->length, steps, count);
    snprintf(text, size, "%s:%d:%d%s%s", shortened(reader->path), place.line, place.column, path[0] != '\0' ? " " : "", path);
}

cipc_status scene_reject(scene_reader *reader, const scene_cursor *cursor, cipc_status status, const char *format, ...)
{
    if (reader->status != CIPC_OK) return reader->status;
    char place[sizeof reader->error.place], what[sizeof reader->error.what];
    scene_place_text(reader, cursor, place, sizeof place);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    reader->status = cipc_fail(&reader->error, status, place, "%s", what);
    return reader->status;
}

cipc_status scene_reject_memory(scene_reader *reader, const scene_cursor *cursor)
{
    return scene_reject(reader, cursor, CIPC_E_OUT_OF_MEMORY, "no memory for this part of the scene");
}

cipc_status scene_adopt(scene_reader *reader, const scene_cursor *cursor, cipc_status status, const cipc_error *error)
{
    return status == CIPC_OK ? reader->status : scene_reject(reader, cursor, status, "%s", error->what);
}

static const char *type_name(const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "an array";
    case JSON_STRING:
        return "a string";
    case JSON_INTEGER:
        return "an integer";
    case JSON_REAL:
        return "a real number";
    case JSON_TRUE:
    case JSON_FALSE:
        return "a boolean";
    default:
        return "null";
    }
}

/* Is there a value of the wanted type? If not: MISSING_KEY or WRONG_TYPE. */
static bool expect(scene_reader *reader, const scene_cursor *cursor, bool right, const char *wanted)
{
    if (reader->status != CIPC_OK) return false;
    if (right) return true;
    if (cursor->value == NULL)
        scene_reject(reader, cursor, CIPC_E_MISSING_KEY, "required, but missing: %s", wanted);
    else
        scene_reject(reader, cursor, CIPC_E_WRONG_TYPE, "must be %s, but is %s", wanted, type_name(cursor->value));
    return false;
}

/* ---- objects and arrays ---- */

static int count_names(const char *const *names)
{
    int count = 0;
    while (names[count] != NULL) count++;
    return count;
}

static bool is_listed(const char *name, const char *const *names)
{
    for (; *names != NULL; names++) {
        if (strcmp(name, *names) == 0) return true;
    }
    return false;
}

static void check_key(scene_reader *reader, const scene_cursor *object, const char *key, const char *const *keys)
{
    scene_cursor member = scene_member(object, key);
    if (strcmp(key, "comment") == 0) {
        expect(reader, &member, json_is_string(member.value), "a string");
    } else if (!is_listed(key, keys)) {
        scene_reject(reader, &member, CIPC_E_UNKNOWN_KEY, "unknown key '%.60s'; the nearest known key is '%s'", key,
                     scene_nearest_name(key, keys, count_names(keys)));
    }
}

bool scene_is_object(scene_reader *reader, const scene_cursor *cursor, const char *const *keys)
{
    if (!expect(reader, cursor, json_is_object(cursor->value), "an object")) return false;
    const char *key;
    json_t *member;
    json_object_foreach(cursor->value, key, member) check_key(reader, cursor, key, keys);
    return reader->status == CIPC_OK;
}

bool scene_is_array(scene_reader *reader, const scene_cursor *cursor, size_t minimum, size_t maximum)
{
    if (!expect(reader, cursor, json_is_array(cursor->value), "an array")) return false;
    size_t count = json_array_size(cursor->value);
    if (count >= minimum && count <= maximum) return true;
    if (minimum == maximum)
        scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "has %zu elements, but must have %zu", count, minimum);
    else if (count < minimum)
        scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "has %zu elements, but must have at least %zu", count, minimum);
    else
        scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "has %zu elements, but must have at most %zu", count, maximum);
    return false;
}

void scene_set(scene_reader *reader, const scene_cursor *object, const char *key, json_t *value)
{
    if (reader->status != CIPC_OK) {
        json_decref(value);
    } else if (value == NULL || json_object_set_new(object->value, key, value) != 0) {
        scene_reject_memory(reader, object);
    }
}

scene_cursor scene_object_member(scene_reader *reader, const scene_cursor *object, const char *key)
{
    if (reader->status == CIPC_OK && json_object_get(object->value, key) == NULL) scene_set(reader, object, key, json_object());
    return scene_member(object, key);
}

scene_cursor scene_array_member(scene_reader *reader, const scene_cursor *object, const char *key)
{
    if (reader->status == CIPC_OK && json_object_get(object->value, key) == NULL) scene_set(reader, object, key, json_array());
    return scene_member(object, key);
}

/* ---- values under the cursor ---- */

static bool in_range(double value, scene_range range)
{
    bool low = range.lower_open ? value > range.lower : value >= range.lower;
    bool high = range.upper_open ? value < range.upper : value <= range.upper;
    return low && high;
}

static void describe_range(scene_range range, char *text, size_t size)
{
    bool low = isfinite(range.lower), high = isfinite(range.upper);
    const char *above = range.lower_open ? "greater than" : "at least", *below = range.upper_open ? "less than" : "at most";
    if (low && high)
        snprintf(text, size, "%s %.17g and %s %.17g", above, range.lower, below, range.upper);
    else if (low)
        snprintf(text, size, "%s %.17g", above, range.lower);
    else if (high)
        snprintf(text, size, "%s %.17g", below, range.upper);
    else
        snprintf(text, size, "finite");
}

double scene_number_at(scene_reader *reader, const scene_cursor *cursor, scene_range range)
{
    if (!expect(reader, cursor, json_is_number(cursor->value), "a number")) return 0;
    double value = json_number_value(cursor->value);
    if (in_range(value, range)) return value;
    char allowed[80];
    describe_range(range, allowed, sizeof allowed);
    scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "is %.17g, but must be %s", value, allowed);
    return 0;
}

int scene_integer_at(scene_reader *reader, const scene_cursor *cursor, int lower, int upper)
{
    if (!expect(reader, cursor, json_is_integer(cursor->value), "an integer")) return 0;
    json_int_t value = json_integer_value(cursor->value);
    if (value >= lower && value <= upper) return (int)value;
    if (upper == INT_MAX)
        scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "is %lld, but must be at least %d", (long long)value, lower);
    else
        scene_reject(reader, cursor, CIPC_E_OUT_OF_RANGE, "is %lld, but must be at least %d and at most %d", (long long)value, lower,
                     upper);
    return 0;
}

void scene_vector_at(scene_reader *reader, const scene_cursor *cursor, scene_range range, double vector[3])
{
    for (int k = 0; k < 3; k++) vector[k] = 0;
    if (!expect(reader, cursor, json_is_array(cursor->value), "an array of 3 numbers")) return;
    if (!scene_is_array(reader, cursor, 3, 3)) return;
    for (size_t k = 0; k < 3; k++) {
        scene_cursor element = scene_element(cursor, k);
        vector[k] = scene_number_at(reader, &element, range);
    }
}

const char *scene_string_at(scene_reader *reader, const scene_cursor *cursor)
{
    return expect(reader, cursor, json_is_string(cursor->value), "a string") ? json_string_value(cursor->value) : "";
}

/* ---- members ---- */

/* The member; if it is absent and there is a fallback, the fallback is put in its place. Takes over the reference. */
static scene_cursor member_or(scene_reader *reader, const scene_cursor *object, const char *key, bool has_fallback, json_t *fallback)
{
    if (has_fallback && reader->status == CIPC_OK && json_object_get(object->value, key) == NULL)
        scene_set(reader, object, key, fallback);
    else
        json_decref(fallback);
    return scene_member(object, key);
}

double scene_number(scene_reader *reader, const scene_cursor *object, const char *key, double fallback, scene_range range)
{
    bool has_fallback = !isnan(fallback);
    scene_cursor member = member_or(reader, object, key, has_fallback, has_fallback ? json_real(fallback) : NULL);
    return scene_number_at(reader, &member, range);
}

int scene_integer(scene_reader *reader, const scene_cursor *object, const char *key, int fallback, int lower, int upper)
{
    scene_cursor member = member_or(reader, object, key, fallback != SCENE_REQUIRED, json_integer(fallback));
    return scene_integer_at(reader, &member, lower, upper);
}

bool scene_boolean(scene_reader *reader, const scene_cursor *object, const char *key, bool fallback)
{
    scene_cursor member = member_or(reader, object, key, true, json_boolean(fallback));
    return expect(reader, &member, json_is_boolean(member.value), "true or false") && json_is_true(member.value);
}

void scene_vector(scene_reader *reader, const scene_cursor *object, const char *key, const double fallback[3], double vector[3])
{
    scene_cursor member = member_or(reader, object, key, true, json_pack("[fff]", fallback[0], fallback[1], fallback[2]));
    scene_vector_at(reader, &member, scene_any, vector);
}

const char *scene_string(scene_reader *reader, const scene_cursor *object, const char *key, const char *fallback)
{
    scene_cursor member = member_or(reader, object, key, fallback != NULL, fallback != NULL ? json_string(fallback) : NULL);
    return scene_string_at(reader, &member);
}

int scene_choice(scene_reader *reader, const scene_cursor *object, const char *key, const char *kind, const char *const *names,
                 int fallback)
{
    const char *name = scene_string(reader, object, key, fallback != SCENE_REQUIRED ? names[fallback] : NULL);
    for (int i = 0; names[i] != NULL; i++) {
        if (strcmp(name, names[i]) == 0) return i;
    }
    scene_cursor member = scene_member(object, key);
    scene_reject(reader, &member, CIPC_E_OUT_OF_RANGE, "unknown %s '%.60s'; the nearest known one is '%s'", kind, name,
                 scene_nearest_name(name, names, count_names(names)));
    return 0;
}

double scene_time_or_never(scene_reader *reader, const scene_cursor *object, const char *key)
{
    scene_cursor member = member_or(reader, object, key, true, json_string("never"));
    if (json_is_string(member.value) && strcmp(json_string_value(member.value), "never") == 0) return INFINITY;
    if (!expect(reader, &member, json_is_number(member.value), "a number or \"never\"")) return INFINITY;
    return scene_number_at(reader, &member, scene_any);
}
