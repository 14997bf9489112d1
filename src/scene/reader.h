/* Typed reading of a scene's JSON tree: every read checks type and range, writes the default into the tree where the key is absent (so
 * that the tree ends up as the resolved scene), and rejects with file, line, column and path. The first rejection sticks: reads after
 * it do nothing. */
#ifndef SCENE_READER_H
#define SCENE_READER_H

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "cipc/base.h"
#include "scene/cursor.h"

/* A value that did not come from where it seems to stand in the file: set by a size block or by --set. */
typedef struct scene_override {
    char address[512]; /* scene_cursor_address of what was replaced or created */
    char path[256];    /* as written */
    char place[512];   /* what an error says instead of the file's own line and column */
} scene_override;

typedef struct scene_reader {
    const char *path; /* of the scene file */
    const char *text; /* its text */
    size_t length;
    json_t *root; /* owned */
    int override_count;
    scene_override *overrides; /* owned; in the order applied */
    cipc_status status;
    cipc_error error;
} scene_reader;

void scene_reader_free(scene_reader *reader);

/* Where errors about the value under the cursor are said to be. */
void scene_place_text(const scene_reader *reader, const scene_cursor *cursor, char *text, size_t size);
/* Record an error at the cursor, unless there is one already. Returns the status that sticks. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
cipc_status
scene_reject(scene_reader *reader, const scene_cursor *cursor, cipc_status status, const char *format, ...);
/* The same for a lack of memory. */
cipc_status scene_reject_memory(scene_reader *reader, const scene_cursor *cursor);
/* What a function below the reader complains of (its place means nothing to the scene's author), said at the cursor. OK: nothing. */
cipc_status scene_adopt(scene_reader *reader, const scene_cursor *cursor, cipc_status status, const cipc_error *error);

/* Allowed numbers. Infinite bounds are never reached: JSON has no infinities. */
typedef struct scene_range {
    double lower, upper;
    bool lower_open, upper_open; /* the bound itself is not allowed */
} scene_range;
extern const scene_range scene_any, scene_positive, scene_not_negative;

/* Fallback of numbers and names that must be given. */
#define SCENE_REQUIRED_NUMBER ((double)NAN)
#define SCENE_REQUIRED        (-1)

/* Is the value an object with no other keys than these (NULL-terminated) and "comment"? */
bool scene_is_object(scene_reader *reader, const scene_cursor *cursor, const char *const *keys);
/* Is the value an array of minimum to maximum elements? */
bool scene_is_array(scene_reader *reader, const scene_cursor *cursor, size_t minimum, size_t maximum);
/* The member `key`, which is made an empty object or array if absent. */
scene_cursor scene_object_member(scene_reader *reader, const scene_cursor *object, const char *key);
scene_cursor scene_array_member(scene_reader *reader, const scene_cursor *object, const char *key);

/* The value under the cursor itself. On rejection a harmless value is returned (range's nearest end or 0). */
double scene_number_at(scene_reader *reader, const scene_cursor *cursor, scene_range range);
int scene_integer_at(scene_reader *reader, const scene_cursor *cursor, int lower, int upper);
void scene_vector_at(scene_reader *reader, const scene_cursor *cursor, scene_range range, double vector[3]);
const char *scene_string_at(scene_reader *reader, const scene_cursor *cursor);

/* Members of an object, with fallback. */
double scene_number(scene_reader *reader, const scene_cursor *object, const char *key, double fallback, scene_range range);
int scene_integer(scene_reader *reader, const scene_cursor *object, const char *key, int fallback, int lower, int upper);
bool scene_boolean(scene_reader *reader, const scene_cursor *object, const char *key, bool fallback);
void scene_vector(scene_reader *reader, const scene_cursor *object, const char *key, const double fallback[3], double vector[3]);
/* fallback NULL: required. Never returns NULL (rejected: ""). The text lives as long as the tree. */
const char *scene_string(scene_reader *reader, const scene_cursor *object, const char *key, const char *fallback);
/* One of the names (NULL-terminated); returns its index; fallback SCENE_REQUIRED: must be given. Rejected: 0. `kind` names what is
 * chosen. */
int scene_choice(scene_reader *reader, const scene_cursor *object, const char *key, const char *kind, const char *const *names,
                 int fallback);
/* Time that may be "never" (INFINITY); absent: never. */
double scene_time_or_never(scene_reader *reader, const scene_cursor *object, const char *key);
/* Replace a member of the tree by a new value, whose reference is taken over (NULL: no memory). */
void scene_set(scene_reader *reader, const scene_cursor *object, const char *key, json_t *value);

#endif
