/* Exactly one of several keys: how a scene chooses between ways of saying a thing. */
#ifndef SCENE_ALTERNATIVES_H
#define SCENE_ALTERNATIVES_H

#include "scene/reader.h"

/* Which of the keys (NULL-terminated) the object has; -1 and a rejection unless it has exactly one. Other keys are not looked at. */
int scene_one_of(scene_reader *reader, const scene_cursor *object, const char *const *keys);
/* Names with commas between them, in `text`; what does not fit is cut off. */
void scene_list_names(const char *const *names, char *text, size_t size);

#endif
