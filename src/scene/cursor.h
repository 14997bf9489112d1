/* A place in a scene's JSON tree that knows its way from the root: what an error needs to say where it is. */
#ifndef SCENE_CURSOR_H
#define SCENE_CURSOR_H

#include <jansson.h>
#include <stddef.h>

#include "scene/json_place.h"

/* Cursors live on the stack of the functions that walk down the tree; a child points to its parent's cursor. */
typedef struct scene_cursor {
    const struct scene_cursor *parent; /* NULL: the whole scene */
    scene_step step;                   /* from the parent */
    json_t *value;                     /* borrowed; NULL: the parent has no such member */
} scene_cursor;

enum { SCENE_DEPTH = 16 }; /* deeper than any path of the format */

scene_cursor scene_root(json_t *value);
scene_cursor scene_member(const scene_cursor *object, const char *key);
scene_cursor scene_element(const scene_cursor *array, size_t index);

/* The steps from the root; returns how many (at most SCENE_DEPTH). */
int scene_cursor_steps(const scene_cursor *cursor, scene_step steps[SCENE_DEPTH]);
/* As people write it: "bodies.cloth.thickness", elements by their "name" if they have one, else by index. "" for the root. */
void scene_cursor_path(const scene_cursor *cursor, char *text, size_t size);
/* As programs compare it: elements always by index, each step preceded by SCENE_ADDRESS_MARK. */
void scene_cursor_address(const scene_cursor *cursor, char *text, size_t size);
#define SCENE_ADDRESS_MARK "\x1f"

#endif
