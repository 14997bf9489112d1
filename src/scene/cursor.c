/* Walking down a JSON tree and writing down the way. */
#include "scene/cursor.h"

#include <stdio.h>
#include <string.h>

scene_cursor scene_root(json_t *value)
{
    return (scene_cursor){NULL, {NULL, 0}, value};
}

scene_cursor scene_member(const scene_cursor *object, const char *key)
{
    return (scene_cursor){object, {key, 0}, json_object_get(object->value, key)};
}

scene_cursor scene_element(const scene_cursor *array, size_t index)
{
    return (scene_cursor){array, {NULL, index}, json_array_get(array->value, index)};
}

static int depth_of(const scene_cursor *cursor)
{
    int depth = 0;
    for (; cursor->parent != NULL; cursor = cursor->parent) depth++;
    return depth;
}

int scene_cursor_steps(const scene_cursor *cursor, scene_step steps[SCENE_DEPTH])
{
    int depth = depth_of(cursor), count = depth < SCENE_DEPTH ? depth : SCENE_DEPTH;
    for (int i = depth - 1; i >= 0; i--, cursor = cursor->parent) {
        if (i < count) steps[i] = cursor->step;
    }
    return count;
}

/* Append one formatted step; what does not fit is cut off. */
static void append(char *text, size_t size, const char *mark, const char *step)
{
    size_t length = strlen(text);
    if (length < size) snprintf(text + length, size - length, "%s%s", mark, step);
}

static void append_index(char *text, size_t size, const char *mark, size_t index)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%zu", index);
    append(text, size, mark, digits);
}

void scene_cursor_path(const scene_cursor *cursor, char *text, size_t size)
{
    if (size > 0) text[0] = '\0';
    if (cursor->parent == NULL) return;
    scene_cursor_path(cursor->parent, text, size);
    const char *mark = text[0] != '\0' ? "." : "";
    const char *name = cursor->step.key != NULL ? cursor->step.key : json_string_value(json_object_get(cursor->value, "name"));
    if (name != NULL)
        append(text, size, mark, name);
    else
        append_index(text, size, mark, cursor->step.index);
}

void scene_cursor_address(const scene_cursor *cursor, char *text, size_t size)
{
    if (size > 0) text[0] = '\0';
    if (cursor->parent == NULL) return;
    scene_cursor_address(cursor->parent, text, size);
    if (cursor->step.key != NULL)
        append(text, size, SCENE_ADDRESS_MARK, cursor->step.key);
    else
        append_index(text, size, SCENE_ADDRESS_MARK, cursor->step.index);
}
