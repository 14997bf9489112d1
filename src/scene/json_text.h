/* JSON value -> text that reads well and reads back to the same numbers. */
#ifndef SCENE_JSON_TEXT_H
#define SCENE_JSON_TEXT_H

#include <jansson.h>

/* Objects one member a line, arrays of scalars on one line, reals with the fewest digits (15 to 17) that read back to the same double.
 * The text ends with a newline; free with cipc_free. NULL: no memory. */
char *scene_json_text(json_t *value);

#endif
