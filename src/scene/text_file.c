/* Reading a file block by block: its size is not trusted beforehand (it may be a pipe). */
#include "scene/text_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { FIRST_BLOCK = 1 << 16 };
static const size_t longest = (size_t)1 << 30;

static cipc_status read_blocks(FILE *file, const char *path, char **text, size_t *length, cipc_error *error)
{
    size_t capacity = 0;
    for (;;) {
        if (capacity - *length < 2) {
            capacity = capacity == 0 ? FIRST_BLOCK : 2 * capacity;
            char *larger = cipc_realloc(*text, capacity, 1);
            if (larger == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for %zu bytes", capacity);
            *text = larger;
        }
        size_t count = fread(*text + *length, 1, capacity - *length - 1, file);
        *length += count;
        (*text)[*length] = '\0';
        if (ferror(file)) return cipc_fail(error, CIPC_E_MISSING_FILE, path, "cannot be read: %s", strerror(errno));
        if (*length > longest) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, path, "longer than %zu bytes", longest);
        if (count == 0) return CIPC_OK;
    }
}

cipc_status scene_read_text(const char *path, char **text, size_t *length, cipc_error *error)
{
    *text = NULL;
    *length = 0;
    FILE *file = fopen(path, "rb");
    if (file == NULL) return cipc_fail(error, CIPC_E_MISSING_FILE, path, "cannot be opened: %s", strerror(errno));
    cipc_status status = read_blocks(file, path, text, length, error);
    fclose(file);
    if (status == CIPC_OK) return status;
    cipc_free(*text);
    *text = NULL;
    return status;
}
