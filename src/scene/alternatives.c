/* Choosing by the presence of a key. */
#include "scene/alternatives.h"

#include <stdio.h>
#include <string.h>

void scene_list_names(const char *const *names, char *text, size_t size)
{
    if (size > 0) text[0] = '\0';
    for (int i = 0; names[i] != NULL; i++) {
        size_t length = strlen(text);
        if (length < size) snprintf(text + length, size - length, "%s%s", i > 0 ? ", " : "", names[i]);
    }
}

int scene_one_of(scene_reader *r, const scene_cursor *object, const char *const *keys)
{
    int ways = 0, way = -1;
    char known[200];
    for (int i = 0; keys[i] != NULL; i++) {
        if (json_object_get(object->value, keys[i]) == NULL) continue;
        ways++;
        way = i;
    }
    if (ways == 1) return way;
    scene_list_names(keys, known, sizeof known);
    if (ways == 0)
        scene_reject(r, object, CIPC_E_MISSING_KEY, "needs one of %s", known);
    else
        scene_reject(r, object, CIPC_E_OUT_OF_RANGE, "has %d of %s, but must have one", ways, known);
    return -1;
}
