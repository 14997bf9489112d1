/* Cairo surfaces as PNG files. */
#include "output/png.h"
#include "output/atomic_file.h"

static cairo_status_t write_bytes(void *stream, const unsigned char *bytes, unsigned length)
{
    return fwrite(bytes, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

cipc_status cipc_png_write(const char *path, cairo_surface_t *surface, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    cairo_status_t drawn = cairo_surface_write_to_png_stream(surface, write_bytes, file.stream);
    if (drawn == CAIRO_STATUS_NO_MEMORY) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory to draw the picture");
    } else if (drawn != CAIRO_STATUS_SUCCESS) {
        status = cipc_fail(error, CIPC_E_IO, path, "cannot write the picture: %s", cairo_status_to_string(drawn));
    }
    return cipc_atomic_close(&file, status, error);
}
