/* Files that appear whole or not at all. */
#include "output/atomic_file.h"
#include "cipc/output.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

cipc_status cipc_fail_io(cipc_error *error, const char *path, const char *what)
{
    int cause = errno;
    cipc_status status = cause == ENOMEM ? CIPC_E_OUT_OF_MEMORY : CIPC_E_IO;
    if (cause == 0) {
        return cipc_fail(error, status, path, "cannot %s", what);
    }
    return cipc_fail(error, status, path, "cannot %s: %s", what, strerror(cause));
}

char *cipc_atomic_temporary(const char *path)
{
    static const char suffix[] = ".partial";
    size_t length = strlen(path);
    char *temporary = cipc_alloc(length + sizeof suffix, 1);
    if (temporary != NULL) {
        memcpy(temporary, path, length);
        memcpy(temporary + length, suffix, sizeof suffix);
    }
    return temporary;
}

static char *copy_of(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = cipc_alloc(size, 1);
    if (copy != NULL) {
        memcpy(copy, text, size);
    }
    return copy;
}

static void forget(cipc_atomic_file *file)
{
    cipc_free(file->path);
    cipc_free(file->temporary);
    *file = (cipc_atomic_file){NULL, NULL, NULL};
}

cipc_status cipc_atomic_open(cipc_atomic_file *file, const char *path, cipc_error *error)
{
    *file = (cipc_atomic_file){NULL, copy_of(path), cipc_atomic_temporary(path)};
    if (file->path == NULL || file->temporary == NULL) {
        forget(file);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the file's name");
    }
    errno = 0;
    file->stream = fopen(file->temporary, "wb");
    if (file->stream == NULL) {
        cipc_status status = cipc_fail_io(error, file->temporary, "create the file");
        forget(file);
        return status;
    }
    return CIPC_OK;
}

/* A write error may show only when the buffer is emptied, or when the system is asked to put it on the disk. */
static bool finish(FILE *stream)
{
    errno = 0;
    bool good = !ferror(stream) && fflush(stream) == 0 && fsync(fileno(stream)) == 0;
    int cause = errno;
    if (fclose(stream) != 0 && good) {
        return false;
    }
    errno = cause;
    return good;
}

cipc_status cipc_atomic_close(cipc_atomic_file *file, cipc_status status, cipc_error *error)
{
    if (file->stream == NULL) {
        return status;
    }
    bool written = finish(file->stream);
    if (status == CIPC_OK && !written) {
        status = cipc_fail_io(error, file->temporary, "write the file");
    }
    if (status == CIPC_OK && rename(file->temporary, file->path) != 0) {
        status = cipc_fail_io(error, file->path, "move the finished file into place");
    }
    if (status != CIPC_OK) {
        remove(file->temporary);
    }
    forget(file);
    return status;
}

cipc_status cipc_text_write(const char *path, const char *text, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    fputs(text, file.stream);
    return cipc_atomic_close(&file, CIPC_OK, error);
}
