/* Words of a text file one after the other, with the line that each stands on: what the mesh formats of Gmsh and VTK are made of. */
#ifndef SCENE_TOKEN_READER_H
#define SCENE_TOKEN_READER_H

#include <stdbool.h>

#include "cipc/base.h"

typedef struct token_reader {
    const char *path;
    char *text;       /* owned */
    const char *at;
    int line;
    const char *word; /* the last one read, and its length; not terminated */
    int length;
    cipc_status status; /* the first error; later calls do nothing */
    cipc_error *error, own;
} token_reader;

/* Read the file. Call scene_token_reader_close in any case. */
cipc_status scene_token_reader_open(token_reader *r, const char *path, cipc_error *error);
void scene_token_reader_close(token_reader *r);

/* The next word; false at the end of the file (no error) or after an error. */
bool scene_token_next(token_reader *r);
bool scene_token_is(const token_reader *r, const char *word);
/* Skip to the next line. */
void scene_token_skip_line(token_reader *r);
/* The next word as a finite number, or as an integer in [lower, upper]; 0 and an error if it is none. `what` is named in the message. */
double scene_token_number(token_reader *r, const char *what);
long long scene_token_integer(token_reader *r, const char *what, long long lower, long long upper);
/* An error at the present line. */
cipc_status scene_token_reject(token_reader *r, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

#endif
