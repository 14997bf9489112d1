/* Dotted paths into the JSON tree. What is set that way is remembered, so that errors can name the override instead of a line of the
 * file. */
#include "scene/overrides.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/nearest_name.h"

enum { KEY_SIZE = 128 };

/* The walk of one override down the tree. */
typedef struct walk {
    scene_reader *reader;
    scene_override record;
    json_t *node;  /* where the walk stands */
    bool creating; /* below something that the walk has made */
} walk;

static cipc_status fail(walk *w, cipc_status status, const char *what, const char *name, const char *nearest)
{
    if (w->reader->status != CIPC_OK) return w->reader->status;
    const char *hint = nearest != NULL ? "; the nearest is " : "";
    w->reader->status =
        cipc_fail(&w->reader->error, status, w->record.place, "%s '%.60s'%s%s", what, name, hint, nearest != NULL ? nearest : "");
    return w->reader->status;
}

static cipc_status fail_memory(walk *w)
{
    return fail(w, CIPC_E_OUT_OF_MEMORY, "no memory to set", w->record.path, NULL);
}

static void extend_address(walk *w, const char *step)
{
    size_t length = strlen(w->record.address);
    snprintf(w->record.address + length, sizeof w->record.address - length, "%s%.*s", SCENE_ADDRESS_MARK, KEY_SIZE, step);
}

/* Copy the first key of a path and return what follows it: NULL if it was the last one, or if it is empty or too long (*bad). */
static const char *first_key(const char *path, char key[KEY_SIZE], bool *bad)
{
    size_t length = strcspn(path, ".");
    *bad = length == 0 || length >= KEY_SIZE;
    if (*bad) return NULL;
    memcpy(key, path, length);
    key[length] = '\0';
    return path[length] == '.' ? path + length + 1 : NULL;
}

static bool is_index(const char *key)
{
    for (const char *c = key; *c != '\0'; c++) {
        if (!isdigit((unsigned char)*c)) return false;
    }
    return *key != '\0' && strlen(key) <= 9;
}

/* The element that a key stands for: its index, or its "name". Size of the array: none. */
static size_t find_element(const json_t *array, const char *key)
{
    size_t count = json_array_size(array);
    if (is_index(key)) {
        size_t index = (size_t)strtoul(key, NULL, 10);
        return index < count ? index : count;
    }
    for (size_t i = 0; i < count; i++) {
        const char *name = json_string_value(json_object_get(json_array_get(array, i), "name"));
        if (name != NULL && strcmp(name, key) == 0) return i;
    }
    return count;
}

static const char *nearest_element(const json_t *array, const char *key)
{
    const char *nearest = NULL;
    for (size_t i = 0; i < json_array_size(array); i++) {
        const char *name = json_string_value(json_object_get(json_array_get(array, i), "name"));
        if (name != NULL && (nearest == NULL || scene_edit_distance(key, name) < scene_edit_distance(key, nearest))) nearest = name;
    }
    return nearest;
}

static const char *nearest_member(json_t *object, const char *key)
{
    const char *nearest = NULL, *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        if (nearest == NULL || scene_edit_distance(key, name) < scene_edit_distance(key, nearest)) nearest = name;
    }
    return nearest;
}

static cipc_status choose_element(walk *w, const char *key, size_t *index)
{
    *index = find_element(w->node, key);
    if (*index == json_array_size(w->node)) return fail(w, CIPC_E_USAGE, "no element", key, nearest_element(w->node, key));
    char digits[24];
    snprintf(digits, sizeof digits, "%zu", *index);
    extend_address(w, digits);
    return CIPC_OK;
}

/* Go down one key; objects that are not there yet are made. */
static cipc_status descend(walk *w, const char *key)
{
    if (json_is_array(w->node)) {
        size_t index;
        cipc_status status = choose_element(w, key, &index);
        if (status == CIPC_OK) w->node = json_array_get(w->node, index);
        return status;
    }
    if (!json_is_object(w->node)) return fail(w, CIPC_E_USAGE, "neither an object nor an array to go down into at", key, NULL);
    json_t *next = json_object_get(w->node, key);
    if (!w->creating) extend_address(w, key);
    if (next == NULL) {
        next = json_object();
        if (next == NULL || json_object_set_new(w->node, key, next) != 0) return fail_memory(w);
        w->creating = true;
    }
    w->node = next;
    return CIPC_OK;
}

/* null takes a member away. One that is not there is a slip of the pen more often than not. */
static cipc_status take_away(walk *w, const char *key)
{
    if (json_object_get(w->node, key) == NULL) return fail(w, CIPC_E_USAGE, "no key to take away called", key, nearest_member(w->node, key));
    extend_address(w, key);
    json_object_del(w->node, key);
    return CIPC_OK;
}

/* Set the last key. Takes over the reference to value. */
static cipc_status assign(walk *w, const char *key, json_t *value)
{
    if (json_is_array(w->node)) {
        size_t index;
        cipc_status status = choose_element(w, key, &index);
        if (status == CIPC_OK) return json_array_set_new(w->node, index, value) == 0 ? CIPC_OK : fail_memory(w);
        json_decref(value);
        return status;
    }
    if (!json_is_object(w->node)) {
        json_decref(value);
        return fail(w, CIPC_E_USAGE, "neither an object nor an array to hold", key, NULL);
    }
    if (json_is_null(value)) return take_away(w, key); /* null has no references to count */
    if (!w->creating) extend_address(w, key);
    return json_object_set_new(w->node, key, value) == 0 ? CIPC_OK : fail_memory(w);
}

static cipc_status remember(walk *w)
{
    scene_reader *r = w->reader;
    scene_override *larger = cipc_realloc(r->overrides, (size_t)r->override_count + 1, sizeof *larger);
    if (larger == NULL) return fail_memory(w);
    r->overrides = larger;
    r->overrides[r->override_count++] = w->record;
    return CIPC_OK;
}

/* Set `path` of the tree to value (reference taken over); `place` is what errors about it will say. */
static cipc_status set_path(scene_reader *reader, const char *path, json_t *value, const char *place)
{
    walk w = {.reader = reader, .node = reader->root};
    snprintf(w.record.path, sizeof w.record.path, "%s", path);
    snprintf(w.record.place, sizeof w.record.place, "%s", place);
    if (value == NULL) return fail_memory(&w);
    for (const char *rest = path;;) {
        char key[KEY_SIZE];
        bool bad;
        rest = first_key(rest, key, &bad);
        cipc_status status = CIPC_OK;
        if (bad) {
            status = fail(&w, CIPC_E_USAGE, "an empty or overlong key in the path", path, NULL);
        } else if (rest == NULL) {
            status = assign(&w, key, value);
            return status == CIPC_OK ? remember(&w) : status;
        } else {
            status = descend(&w, key);
        }
        if (status != CIPC_OK) {
            json_decref(value);
            return status;
        }
    }
}

/* ---- --set ---- */

/* JSON where it reads as JSON, else a string: --set bodies.cloth.material=wool needs no quotes. Text that starts like an object, an array
 * or a quoted string must be one. NULL: rejected. */
static json_t *parse_value(scene_reader *reader, const char *text, const char *place)
{
    json_error_t parse_error;
    json_t *value = json_loads(text, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, &parse_error);
    if (value != NULL) return value;
    if (text[0] != '\0' && strchr("{[\"", text[0]) != NULL) {
        reader->status = cipc_fail(&reader->error, CIPC_E_SYNTAX, place, "%s", parse_error.text);
        return NULL;
    }
    value = json_string(text);
    if (value == NULL) reader->status = cipc_fail(&reader->error, CIPC_E_SYNTAX, place, "the value is not UTF-8 text");
    return value;
}

static cipc_status apply_text(scene_reader *reader, const char *text)
{
    char place[256], path[256];
    snprintf(place, sizeof place, "--set %s", text);
    const char *sign = strchr(text, '=');
    size_t length = sign != NULL ? (size_t)(sign - text) : 0;
    if (length == 0 || length >= sizeof path) {
        reader->status = cipc_fail(&reader->error, CIPC_E_USAGE, place, "must be PATH=VALUE");
        return reader->status;
    }
    memcpy(path, text, length);
    path[length] = '\0';
    if (strcmp(path, "sizes") == 0 || strncmp(path, "sizes.", 6) == 0) {
        reader->status = cipc_fail(&reader->error, CIPC_E_USAGE, place,
                                   "size blocks cannot be overridden: they are applied before; set the value itself");
        return reader->status;
    }
    json_t *value = parse_value(reader, sign + 1, place);
    return value != NULL ? set_path(reader, path, value, place) : reader->status;
}

/* ---- sizes ---- */

static const char *size_option(const char *text)
{
    static const char start[] = "size=";
    return strncmp(text, start, sizeof start - 1) == 0 ? text + sizeof start - 1 : NULL;
}

/* The names of an object's members but "comment", separated by commas. */
static void list_names(json_t *object, char *text, size_t size)
{
    const char *key;
    json_t *member;
    text[0] = '\0';
    json_object_foreach(object, key, member)
    {
        size_t length = strlen(text);
        if (strcmp(key, "comment") != 0) snprintf(text + length, size - length, "%s%s", length > 0 ? ", " : "", key);
    }
}

static cipc_status apply_block(scene_reader *reader, const scene_cursor *sizes, const char *size)
{
    scene_cursor block = scene_member(sizes, size);
    if (!json_is_object(block.value)) return scene_reject(reader, &block, CIPC_E_WRONG_TYPE, "must be an object of overrides");
    const char *path;
    json_t *value;
    json_object_foreach(block.value, path, value)
    {
        if (strcmp(path, "comment") == 0) continue;
        scene_cursor entry = scene_member(&block, path);
        char place[512];
        scene_place_text(reader, &entry, place, sizeof place);
        cipc_status status = set_path(reader, path, json_deep_copy(value), place);
        if (status != CIPC_OK) return status;
    }
    return CIPC_OK;
}

static cipc_status unknown_size(scene_reader *reader, const scene_cursor *sizes, const char *size, const char *option)
{
    char known[200], place[256];
    list_names(sizes->value, known, sizeof known);
    snprintf(place, sizeof place, "--set %s", option != NULL ? option : "");
    scene_cursor root = scene_root(reader->root);
    if (sizes->value == NULL)
        scene_reject(reader, &root, CIPC_E_USAGE, "size '%.40s' is asked for, but the scene has no sizes", size);
    else
        scene_reject(reader, sizes, CIPC_E_USAGE, "unknown size '%.40s'; known sizes: %s", size, known);
    if (option != NULL) snprintf(reader->error.place, sizeof reader->error.place, "%s", place);
    return reader->status;
}

static cipc_status apply_size(scene_reader *reader, int count, const char *const *overrides)
{
    scene_cursor root = scene_root(reader->root), sizes = scene_member(&root, "sizes");
    const char *option = NULL;
    for (int i = 0; i < count; i++) {
        if (size_option(overrides[i]) != NULL) option = overrides[i];
    }
    if (sizes.value == NULL) return option != NULL ? unknown_size(reader, &sizes, size_option(option), option) : CIPC_OK;
    if (!json_is_object(sizes.value)) return scene_reject(reader, &sizes, CIPC_E_WRONG_TYPE, "must be an object of named sizes");
    const char *size = option != NULL ? size_option(option) : scene_string(reader, &root, "size", "ci");
    if (reader->status != CIPC_OK) return reader->status;
    if (json_object_get(sizes.value, size) == NULL) return unknown_size(reader, &sizes, size, option);
    cipc_status status = apply_block(reader, &sizes, size);
    if (status == CIPC_OK) scene_set(reader, &root, "size", json_string(size));
    return reader->status;
}

cipc_status scene_apply_overrides(scene_reader *reader, int count, const char *const *overrides)
{
    cipc_status status = apply_size(reader, count, overrides);
    json_object_del(reader->root, "sizes");
    for (int i = 0; i < count && status == CIPC_OK; i++) {
        if (size_option(overrides[i]) == NULL) status = apply_text(reader, overrides[i]);
    }
    return status;
}
