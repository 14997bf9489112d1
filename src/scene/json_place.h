/* Where a value stands in a JSON text: jansson tells line and column of syntax errors only. */
#ifndef SCENE_JSON_PLACE_H
#define SCENE_JSON_PLACE_H

#include <stddef.h>

/* One step down a JSON value: the member `key` of an object or, if key is NULL, the element `index` of an array. */
typedef struct scene_step {
    const char *key;
    size_t index;
} scene_step;

typedef struct scene_place {
    int line, column; /* from 1; a column is a Unicode character */
    int matched;      /* how many of the steps the text has */
} scene_place;

/* Follow the steps through a valid JSON text of `length` bytes as far as they go. The place is that of the key (of a member) or of the
 * value (of an element, and of the whole text) at the last step that matched: a missing key is thus placed at the object that lacks it.
 * Keys written with escapes (\u0061) are not recognised: the place is then that of the object around them. Never reads past the text. */
scene_place scene_find_place(const char *text, size_t length, const scene_step *steps, int step_count);

#endif
