/* Status codes and error text: the one list CIPC_DIAGNOSTICS turned into names, remedies and exit statuses. */
#include "cipc/base.h"

#include <stdarg.h>
#include <stdio.h>

typedef struct diagnostic {
    cipc_status status;
    const char *name;
    const char *remedy;
} diagnostic;

static const diagnostic diagnostics[] = {
    {CIPC_OK, "OK", "nothing to mend"},
#define CIPC_X(name, number, remedy) {CIPC_E_##name, #name, remedy},
    CIPC_DIAGNOSTICS(CIPC_X)
#undef CIPC_X
};

enum { DIAGNOSTIC_COUNT = sizeof diagnostics / sizeof diagnostics[0] };

/* NULL for a number that is not in the list. */
static const diagnostic *find(cipc_status status)
{
    for (int i = 0; i < DIAGNOSTIC_COUNT; i++) {
        if (diagnostics[i].status == status) {
            return &diagnostics[i];
        }
    }
    return NULL;
}

const char *cipc_status_name(cipc_status status)
{
    const diagnostic *row = find(status);
    return row != NULL ? row->name : "UNKNOWN";
}

const char *cipc_status_remedy(cipc_status status)
{
    const diagnostic *row = find(status);
    return row != NULL ? row->remedy : "report this number: it is not in the list of diagnostics";
}

int cipc_status_exit(cipc_status status)
{
    return find(status) != NULL ? (int)status / 1000 : 1;
}

/* ASCII control characters only: bytes from 0x80 on are parts of UTF-8 sequences in file names. */
static void make_one_line(char *text)
{
    for (char *c = text; *c != '\0'; c++) {
        unsigned char byte = (unsigned char)*c;
        if (byte < 0x20 || byte == 0x7f) {
            *c = ' ';
        }
    }
}

static void copy_text(char *target, size_t size, const char *source)
{
    snprintf(target, size, "%s", source != NULL ? source : "");
    make_one_line(target);
}

cipc_status cipc_fail(cipc_error *error, cipc_status status, const char *place, const char *format, ...)
{
    if (error == NULL) {
        return status;
    }
    /* The arguments may point into *error itself (an error wrapped by another): write the text aside first. */
    char what[sizeof error->what];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    char where[sizeof error->place];
    copy_text(where, sizeof where, place);

    error->status = status;
    copy_text(error->place, sizeof error->place, where);
    copy_text(error->what, sizeof error->what, what);
    copy_text(error->remedy, sizeof error->remedy, cipc_status_remedy(status));
    return status;
}

cipc_status cipc_fail_remedy(cipc_error *error, const char *format, ...)
{
    if (error == NULL) {
        return CIPC_OK;
    }
    char remedy[sizeof error->remedy];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(remedy, sizeof remedy, format, arguments);
    va_end(arguments);
    copy_text(error->remedy, sizeof error->remedy, remedy);
    return error->status;
}
