/* Words and numbers of a text, one after the other, with the line for messages. */
#ifndef SCENE_TEXT_SCAN_H
#define SCENE_TEXT_SCAN_H

#include <stdbool.h>

#include "cipc/base.h"

typedef struct scene_scan {
    const char *path;  /* for messages */
    const char *at;    /* what comes next; the text ends with '\0' */
    int line;          /* of the word read last, from 1 */
    cipc_error *error; /* not NULL */
} scene_scan;

/* A word: up to the next white space. Shown in messages with "%.*s", scene_shown(&word), word.text. */
typedef struct scene_word {
    const char *text;
    int length;
} scene_word;
int scene_shown(const scene_word *word); /* its length, or that of its first 40 bytes */
bool scene_word_is(const scene_word *word, const char *text);

/* How far a word may be away. */
typedef enum scene_reach { SCENE_ANYWHERE, SCENE_SAME_LINE } scene_reach;

/* The next word; false if there is none within reach. */
bool scene_next_word(scene_scan *scan, scene_reach reach, scene_word *word);
/* The same word again next time. */
bool scene_peek_word(scene_scan *scan, scene_reach reach, scene_word *word);
void scene_skip_line(scene_scan *scan);

/* The next word must be there and be a finite number, a whole number, or one from 0 to a limit (OUT_OF_RANGE otherwise). `what` says in messages what is expected. */
cipc_status scene_expect_word(scene_scan *scan, scene_reach reach, const char *what, scene_word *word);
cipc_status scene_expect_number(scene_scan *scan, scene_reach reach, const char *what, double *value);
cipc_status scene_expect_integer(scene_scan *scan, scene_reach reach, const char *what, long long *value);
cipc_status scene_expect_count(scene_scan *scan, scene_reach reach, const char *what, long long limit, long long *value);
/* Before entry `index` of `count`, called `entries`: fails if the file ends or a section's mark or name follows ('$' or a capital), which means that more was announced than is
 * there. */
cipc_status scene_expect_entry(scene_scan *scan, const char *entries, long long index, long long count);
/* Nothing more on the line. */
cipc_status scene_expect_line_end(scene_scan *scan, const char *what);

/* Fail with BAD_MESH, or another status, at "file:line" of the word read last, or at another line; line 0: at the file as a whole. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
cipc_status scene_scan_reject(scene_scan *scan, const char *format, ...);
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
cipc_status scene_scan_reject_at(scene_scan *scan, int line, cipc_status status, const char *format, ...);

#endif
