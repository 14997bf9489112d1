/* Scenes written as text in the test itself. A '@' in the text marks the place where the error is to be: it is taken out before use. */
#ifndef SUPPORT_SCENE_TRIAL_H
#define SUPPORT_SCENE_TRIAL_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Text without its mark (malloc'd), and the line and column of the mark (0, 0: no mark). */
typedef struct marked_text {
    char *text;
    int line, column;
} marked_text;
marked_text take_mark(const char *text);

/* A new folder for files of a test, and a file in it. The caller removes them with remove_folder(). Paths are malloc'd. */
char *make_folder(void);
char *write_file(const char *folder, const char *name, const char *text, size_t length);
void remove_folder(char *folder);

/* A scene around one body: `root` is put among the scene's members, `body` among the body's (each empty or ending with a comma). */
char *scene_around(const char *root, const char *body);

/* Load a scene's text; override may be NULL. */
cipc_status try_scene(const char *text, const char *override, cipc_scene **scene, cipc_error *error);
/* The text is a good scene. */
cipc_scene *accept_scene(const char *text, const char *override);
/* Loading fails with this status, at the mark (or, without a mark, at any place that contains `path`), with this path, and with a text that
 * contains `what`; and the message is one line. */
void reject_scene(const char *text, const char *override, cipc_status status, const char *path, const char *what);
/* The same, for scene_around(root, body); the text is freed. */
void reject_around(const char *root, const char *body, cipc_status status, const char *path, const char *what);

/* A reader over a JSON text (which must outlive it), for tests of single readers; file name "t.json". */
scene_reader reader_of(const char *text);
/* The reader has rejected: status, whole place and part of the text. Clears the error. */
void assert_rejection(scene_reader *reader, cipc_status status, const char *place, const char *what);

#endif
