/* Streams of answers against streams of vectors: every vector must have one answer, and every answer a vector. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "verify/conformance.h"
#include "verify/json_lines.h"

enum { COMPLAINTS = 20 };

/* What is known of a vector until its answer comes. */
typedef struct pending {
    long id;
    const char *fn;
    json_t *want;
    bool answered;
} pending;

typedef struct table {
    pending *item;
    long count, capacity;
    long of; /* how many lines a stream says it has; 0: it does not */
} table;

static void table_free(table *t)
{
    for (long i = 0; i < t->count; i++) json_decref(t->item[i].want);
    cipc_free(t->item);
}

static bool table_add(table *t, long id, const char *fn, json_t *want)
{
    if (t->count == t->capacity) {
        long capacity = t->capacity > 0 ? 2 * t->capacity : 1024;
        pending *item = cipc_realloc(t->item, (size_t)capacity, sizeof *item);
        if (item == NULL) return false;
        t->item = item;
        t->capacity = capacity;
    }
    t->item[t->count++] = (pending){.id = id, .fn = fn, .want = json_incref(want)};
    return true;
}

static int by_id(const void *a, const void *b)
{
    long x = ((const pending *)a)->id, y = ((const pending *)b)->id;
    return (x > y) - (x < y);
}

static pending *table_find(const table *t, long id)
{
    const pending key = {.id = id};
    return t->count > 0 ? bsearch(&key, t->item, (size_t)t->count, sizeof key, by_id) : NULL;
}

static void complain(verify_judgement *j, const char *place, const char *text)
{
    j->failures++;
    if (j->complaints == NULL || j->failures > COMPLAINTS) return;
    fprintf(j->complaints, "%s: %s\n", place, text);
    if (j->failures == COMPLAINTS) fprintf(j->complaints, "(further failures are counted, not printed)\n");
}

static verify_score *score_of(verify_judgement *j, const char *fn)
{
    int i = 0;
    while (i < j->count && j->scores[i].fn != fn) i++;
    if (i == j->count) j->scores[j->count++] = (verify_score){.fn = fn};
    return &j->scores[i];
}

static void score(verify_judgement *j, const char *place, long id, const char *fn, const json_t *want, const json_t *got)
{
    char text[320];
    verify_verdict v = verify_judge(fn, want, got, j->precision);
    verify_score *s = score_of(j, fn);
    j->answers++;
    s->count++;
    s->early += v.early;
    s->other_feature += v.other_feature;
    s->failed += v.failed;
    s->scored += v.scored;
    s->score += v.scored ? v.score : 0;
    if (v.ratio > s->worst || s->count == 1) {
        s->worst = v.ratio;
        s->worst_id = id;
    }
    if (!v.failed) return;
    snprintf(text, sizeof text, "id %ld, %s: %s", id, fn, v.reason);
    complain(j, place, text);
}

/* Vectors into the table, by id. */
static cipc_status read_vectors(FILE *stream, const char *name, table *t, cipc_error *error)
{
    verify_lines lines;
    json_t *object = NULL;
    long id;
    const char *fn;
    verify_lines_init(&lines, stream, name);
    cipc_status status = verify_lines_next(&lines, &object, error);
    while (status == CIPC_OK && object != NULL) {
        status = verify_line_head(&lines, object, &id, &fn, error);
        if (status == CIPC_OK && !table_add(t, id, fn, json_object_get(object, "want"))) {
            status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, lines.place, "no memory for the vectors");
        }
        json_decref(object);
        object = NULL;
        if (status == CIPC_OK) status = verify_lines_next(&lines, &object, error);
    }
    verify_lines_free(&lines);
    if (status != CIPC_OK) return status;
    if (t->count == 0) return cipc_fail(error, CIPC_E_BAD_QUERY, name, "has no vectors");
    qsort(t->item, (size_t)t->count, sizeof *t->item, by_id);
    for (long i = 1; i < t->count; i++)
        if (t->item[i].id == t->item[i - 1].id) return cipc_fail(error, CIPC_E_BAD_QUERY, name, "id %ld stands twice", t->item[i].id);
    return CIPC_OK;
}

/* One line of the answers. */
static void take_answer(verify_judgement *j, const verify_lines *lines, const json_t *object, table *t)
{
    cipc_error error;
    long id;
    const char *fn;
    char text[160];
    if (verify_line_head(lines, object, &id, &fn, &error) != CIPC_OK) {
        complain(j, lines->place, error.what);
        return;
    }
    pending *vector = table_find(t, id);
    if (vector == NULL || vector->answered || vector->fn != fn) {
        const char *what = vector == NULL ? "no vector has this id" : vector->answered ? "this id was answered before" : "the vector of this id is of another function";
        snprintf(text, sizeof text, "id %ld: %s", id, what);
        complain(j, lines->place, text);
        return;
    }
    vector->answered = true;
    score(j, lines->place, id, fn, vector->want, json_object_get(object, "got"));
}

/* A stream that has both: ids are kept to find those that stand twice. */
static cipc_status take_line_of_both(verify_judgement *j, const verify_lines *lines, const json_t *object, table *seen, cipc_error *error)
{
    cipc_error found;
    long id;
    const char *fn;
    if (verify_line_head(lines, object, &id, &fn, &found) != CIPC_OK) {
        complain(j, lines->place, found.what);
        return CIPC_OK;
    }
    const json_t *of = json_object_get(object, "of");
    seen->of = json_is_integer(of) ? (long)json_integer_value(of) : seen->of;
    if (!table_add(seen, id, fn, NULL)) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, lines->place, "no memory for the ids");
    score(j, lines->place, id, fn, json_object_get(object, "want"), json_object_get(object, "got"));
    return CIPC_OK;
}

static void find_twins(verify_judgement *j, const char *name, table *seen)
{
    char text[96];
    if (seen->count < seen->of) {
        snprintf(text, sizeof text, "the stream has %ld of the %ld answers that it says it has", seen->count, seen->of);
        complain(j, name, text);
    }
    if (seen->count == 0) return;
    qsort(seen->item, (size_t)seen->count, sizeof *seen->item, by_id);
    for (long i = 1; i < seen->count; i++) {
        if (seen->item[i].id != seen->item[i - 1].id) continue;
        snprintf(text, sizeof text, "id %ld stands twice", seen->item[i].id);
        complain(j, name, text);
    }
}

static void find_unanswered(verify_judgement *j, const char *name, const table *t)
{
    char text[96];
    for (long i = 0; i < t->count; i++) {
        if (t->item[i].answered) continue;
        snprintf(text, sizeof text, "id %ld, %s: there is no answer", t->item[i].id, t->item[i].fn);
        complain(j, name, text);
        score_of(j, t->item[i].fn)->failed++;
    }
}

/* All lines; one that is no JSON is a failure, and ends a stream that is cut off. */
static cipc_status read_answers(FILE *stream, const char *name, bool both, table *t, verify_judgement *j, cipc_error *error)
{
    verify_lines lines;
    cipc_error found;
    verify_lines_init(&lines, stream, name);
    cipc_status status = CIPC_OK;
    for (bool more = true; more && status == CIPC_OK;) {
        json_t *object = NULL;
        cipc_status read = verify_lines_next(&lines, &object, &found);
        if (read == CIPC_E_BAD_QUERY) {
            complain(j, found.place, found.what);
        } else if (read != CIPC_OK) {
            status = read;
            if (error != NULL) *error = found;
        } else if (object == NULL) {
            more = false;
        } else if (both) {
            status = take_line_of_both(j, &lines, object, t, error);
        } else {
            take_answer(j, &lines, object, t);
        }
        json_decref(object);
    }
    verify_lines_free(&lines);
    return status;
}

cipc_status verify_judge_streams(FILE *vectors, const char *vectors_name, FILE *answers, const char *answers_name, verify_judgement *j, cipc_error *error)
{
    table t = {0};
    cipc_status status = answers != NULL ? read_vectors(vectors, vectors_name, &t, error) : CIPC_OK;
    const char *name = answers != NULL ? answers_name : vectors_name;
    if (status == CIPC_OK) status = read_answers(answers != NULL ? answers : vectors, name, answers == NULL, &t, j, error);
    if (status == CIPC_OK && answers != NULL) find_unanswered(j, name, &t);
    if (status == CIPC_OK && answers == NULL) find_twins(j, name, &t);
    if (status == CIPC_OK && j->answers == 0) complain(j, name, "there is no answer to judge");
    table_free(&t);
    return status;
}

int verify_level_reached(const verify_judgement *j)
{
    int level = -1;
    for (int l = 0; l <= VERIFY_HIGHEST_LEVEL; l++) {
        for (int f = 0; f < verify_function_count(); f++) {
            const char *fn = verify_function_at(f);
            if (verify_function_level(fn) != l) continue;
            bool passed = false;
            for (int i = 0; i < j->count; i++) passed = passed || (j->scores[i].fn == fn && j->scores[i].count > 0 && j->scores[i].failed == 0);
            if (!passed) return level;
        }
        level = l;
    }
    return level;
}
