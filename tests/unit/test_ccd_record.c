/* The record of CCD queries: the very queries of a run, in order; a sample spread over the whole run, whatever the number of threads; a file that is whole or the
 * old one. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cipc/output.h"
#include "support/failing_memory.h"
#include "support/sample_run.h"
#include "support/sheet_scene.h"
#include "verify/json_lines.h"

enum { STEPS = 4, ALL = 1000000, MOST_LINES = 100000 };

static int all_allocations_succeed(void **state)
{
    (void)state;
    fail_allocation(0);
    return 0;
}

/* A sheet falls on a fixed one, both with some thickness. */
static void make_scene(sheet_scene *scene, int threads)
{
    const double corner[3] = {0, 0.03, 0}, under[3] = {-0.5, 0, -0.5}, u[3] = {1, 0, 0}, v[3] = {0, 0, 1}, u2[3] = {2, 0, 0}, v2[3] = {0, 0, 2}, speed[3] = {0, -1, 0};
    sheet_scene_init(scene);
    scene->gravity[1] = -9.81;
    scene->options.threads = threads;
    scene->options.contact.dhat = 5e-3;
    cipc_body_description *cloth = sheet_add_grid(scene, "cloth", corner, u, v, 4, 4);
    cloth->offset = 2e-3;
    sheet_set_velocity(cloth, speed);
    sheet_add_grid(scene, "ground", under, u2, v2, 3, 3)->fixed = true;
    sheet_scene_build(scene);
}

/* All queries of a run, told by a watch of our own. */
typedef struct listener {
    const cipc_model *model;
    cipc_ccd_record *record;
    long candidates, queries;
    int searches;
} listener;

static void listen(void *context, const cipc_ccd_search *search)
{
    listener *l = context;
    long total = cipc_candidates_count(search->candidates);
    for (long i = 0; i < total; i++) {
        cipc_stencil_path asked;
        double xi;
        l->queries += cipc_candidates_query(l->model, search->candidates, i, search->x, search->p, search->t_max, search->options, &asked, &xi);
    }
    l->candidates += total;
    l->searches++;
    cipc_ccd_record_search(l->record, search);
}

/* Run the scene and record at most `limit` queries to the file. */
static listener run(const path *file, int threads, long limit)
{
    sheet_scene scene;
    make_scene(&scene, threads);
    listener l = {.model = scene.model};
    assert_int_equal(cipc_ccd_record_open(&l.record, file->text, scene.model, limit, NULL), CIPC_OK);
    cipc_stepper_set_ccd_watch(scene.stepper, listen, &l);
    sheet_steps(&scene, STEPS);
    assert_true(cipc_ccd_record_count(l.record) <= limit);
    assert_int_equal(cipc_ccd_record_close(l.record, NULL), CIPC_OK);
    sheet_scene_free(&scene);
    return l;
}

typedef struct lines {
    long count;
    long *id;
    char **text; /* of each line without its "one_in" */
    long one_in;
    long of_step[STEPS + 1];
} lines;

/* Every line a query that the protocol's own reader takes. */
static lines read_lines(const path *file)
{
    lines l = {.id = calloc(MOST_LINES, sizeof *l.id), .text = calloc(MOST_LINES, sizeof *l.text)};
    verify_lines reader;
    json_t *object = NULL;
    FILE *stream = fopen(file->text, "r");
    assert_true(stream != NULL && l.id != NULL && l.text != NULL);
    verify_lines_init(&reader, stream, file->text);
    while (verify_lines_next(&reader, &object, NULL) == CIPC_OK && object != NULL) {
        const char *fn;
        cipc_query query;
        assert_true(l.count < MOST_LINES);
        assert_int_equal(verify_line_head(&reader, object, &l.id[l.count], &fn, NULL), CIPC_OK);
        assert_int_equal(verify_query_parse(object, fn, "", &query, NULL), CIPC_OK);
        assert_true(query.displacement && query.scale == 0.1 && strncmp(fn, "toi_", 4) == 0);
        json_int_t step = json_integer_value(json_object_get(object, "step"));
        assert_true(step >= 1 && step <= STEPS);
        l.of_step[step]++;
        l.one_in = (long)json_integer_value(json_object_get(object, "one_in"));
        json_object_del(object, "one_in");
        l.text[l.count++] = json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(17));
        json_decref(object);
        object = NULL;
    }
    assert_true(feof(stream));
    fclose(stream);
    verify_lines_free(&reader);
    return l;
}

static void free_lines(lines *l)
{
    for (long i = 0; i < l->count; i++) free(l->text[i]);
    free(l->text);
    free(l->id);
}

static void test_all_of_a_run_in_order(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "all.jsonl");
    listener l = run(&file, 1, ALL);
    lines all = read_lines(&file);
    assert_true(l.searches > STEPS && l.queries > 1000 && l.queries < l.candidates);
    assert_int_equal(all.count, l.queries);
    assert_int_equal(all.one_in, 1);
    for (long i = 0; i < all.count; i++) assert_true(all.id[i] > (i ? all.id[i - 1] : -1) && all.id[i] < l.candidates);
    for (int step = 1; step <= STEPS; step++) assert_true(all.of_step[step] > 0);
    free_lines(&all);
    folder_remove(&folder);
}

/* A limit takes a part of the same lines: of `one_in` ordinals about one, at most the limit, from every step in about its share. */
static void test_limit(void **state)
{
    (void)state;
    const path folder = folder_make(), whole = path_in(&folder, "all.jsonl"), part = path_in(&folder, "part.jsonl");
    listener l = run(&whole, 1, ALL);
    run(&part, 1, l.queries / 3);
    lines all = read_lines(&whole), some = read_lines(&part);
    assert_true(some.one_in == 4);
    for (int step = 1; step <= STEPS; step++) { /* a binomial sample of a quarter: within five standard deviations, sqrt(3/4 mean), and one query */
        double mean = (double)all.of_step[step] / 4, deviation = fabs((double)some.of_step[step] - mean);
        assert_true(deviation <= 5 * sqrt(0.75 * mean) + 1);
    }
    long at = 0;
    for (long i = 0; i < some.count; i++) {
        while (at < all.count && all.id[at] < some.id[i]) at++;
        assert_true(at < all.count && all.id[at] == some.id[i]);
        assert_string_equal(all.text[at], some.text[i]);
    }
    free_lines(&all);
    free_lines(&some);
    run(&part, 1, 1);
    some = read_lines(&part);
    assert_true(some.count <= 1 && (some.count == 0 || some.one_in > 64));
    free_lines(&some);
    folder_remove(&folder);
}

/* Threads change neither the file nor, as with the record itself, the result. */
static void test_threads_and_result(void **state)
{
    (void)state;
    const path folder = folder_make(), first = path_in(&folder, "1.jsonl"), other = path_in(&folder, "n.jsonl");
    listener l = run(&first, 1, 500);
    size_t size, size_again;
    char *bytes = file_read(&first, &size);
    assert_true(size > 1000);
    for (int threads = 2; threads <= 3; threads++) {
        listener again = run(&other, threads, 500);
        assert_true(again.queries == l.queries && again.searches == l.searches);
        char *bytes_again = file_read(&other, &size_again);
        assert_int_equal(size, size_again);
        assert_memory_equal(bytes, bytes_again, size);
        free(bytes_again);
    }
    free(bytes);
    sheet_scene with, without;
    make_scene(&with, 1);
    make_scene(&without, 1);
    cipc_ccd_record *record;
    assert_int_equal(cipc_ccd_record_open(&record, other.text, with.model, 100, NULL), CIPC_OK);
    cipc_stepper_set_ccd_watch(with.stepper, cipc_ccd_record_search, record);
    sheet_steps(&with, STEPS);
    sheet_steps(&without, STEPS);
    assert_true(cipc_ccd_record_count(record) > 0);
    assert_true(sheet_same_bits(with.state->position, without.state->position, 3 * with.model->node_count));
    cipc_ccd_record_discard(record);
    sheet_scene_free(&with);
    sheet_scene_free(&without);
    folder_remove(&folder);
}

/* One search of a made-up path, everything falling, cut at t_max. */
static void search_once(cipc_ccd_record *record, const sheet_scene *scene, double t_max)
{
    cipc_broad_phase *broad_phase;
    cipc_candidates candidates = {0};
    cipc_ccd_options options = cipc_ccd_options_default();
    double p[3 * 64] = {0};
    assert_true(scene->model->node_count <= 64);
    for (int i = 0; i < scene->model->node_count; i++) p[3 * i + 1] = i < 25 ? -0.07 : 0;
    assert_int_equal(cipc_broad_phase_create(&broad_phase, scene->model, NULL), CIPC_OK);
    assert_int_equal(cipc_broad_phase_find(broad_phase, scene->model, scene->state->position, p, 1, 0, NULL, 1, &candidates, NULL), CIPC_OK);
    cipc_ccd_search search = {.candidates = &candidates, .x = scene->state->position, .p = p, .t_max = t_max, .step = 0, .options = &options};
    cipc_ccd_record_search(record, &search);
    cipc_candidates_free(&candidates);
    cipc_broad_phase_destroy(broad_phase);
}

static void test_cut_path_and_thickness(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "cut.jsonl");
    for (int cut = 0; cut < 2; cut++) {
        sheet_scene scene;
        make_scene(&scene, 1);
        cipc_ccd_record *record;
        assert_int_equal(cipc_ccd_record_open(&record, file.text, scene.model, 100000, NULL), CIPC_OK);
        search_once(record, &scene, cut ? 0.75 : 1);
        assert_true(cipc_ccd_record_count(record) > 10);
        assert_int_equal(cipc_ccd_record_close(record, NULL), CIPC_OK);
        lines l = read_lines(&file);
        json_t *line = json_loads(l.text[0], 0, NULL), *p = json_object_get(line, "p");
        assert_true(json_number_value(json_array_get(p, 1)) == (cut ? 0.75 : 1) * -0.07 || json_number_value(json_array_get(p, 4)) == (cut ? 0.75 : 1) * -0.07);
        assert_true(json_number_value(json_object_get(line, "thickness")) == 1e-3); /* half of the cloth's, and none of the ground's */
        json_decref(line);
        free_lines(&l);
        sheet_scene_free(&scene);
    }
    folder_remove(&folder);
}

static void assert_content(const path *file, const char *expected)
{
    char *bytes = file_read(file, NULL);
    assert_string_equal(bytes, expected);
    free(bytes);
}

static void test_whole_or_the_old_one(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "a.jsonl"), partial = path_in(&folder, "a.jsonl.partial");
    sheet_scene scene;
    make_scene(&scene, 1);
    cipc_ccd_record *record;
    cipc_error error;
    file_write(&file, "old", 3);
    assert_int_equal(cipc_ccd_record_open(&record, file.text, scene.model, 100, &error), CIPC_OK);
    search_once(record, &scene, 1);
    assert_content(&file, "old");
    cipc_ccd_record_discard(record);
    assert_content(&file, "old");
    assert_false(file_exists(&partial));
    assert_int_equal(symlink("/dev/full", partial.text), 0);
    assert_int_equal(cipc_ccd_record_open(&record, file.text, scene.model, 100, &error), CIPC_OK);
    search_once(record, &scene, 1);
    assert_int_equal(cipc_ccd_record_close(record, &error), CIPC_E_IO);
    assert_non_null(strstr(error.what, "No space left"));
    assert_content(&file, "old");
    assert_int_equal(cipc_ccd_record_close(NULL, &error), CIPC_OK);
    cipc_ccd_record_discard(NULL);
    sheet_scene_free(&scene);
    folder_remove(&folder);
}

static void test_refusals(void **state)
{
    (void)state;
    const path folder = folder_make(), absent = path_in(&folder, "absent/a.jsonl"), file = path_in(&folder, "a.jsonl");
    sheet_scene scene;
    make_scene(&scene, 1);
    cipc_ccd_record *record;
    cipc_error error;
    assert_int_equal(cipc_ccd_record_open(&record, folder.text, scene.model, 100, &error), CIPC_E_IO);
    assert_non_null(strstr(error.what, "it is a folder"));
    assert_null(record);
    assert_int_equal(cipc_ccd_record_open(&record, absent.text, scene.model, 100, &error), CIPC_E_IO);
    assert_non_null(strstr(error.place, "absent"));
    long tried = 0;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_ccd_record_open(&record, file.text, scene.model, 100, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(record);
        assert_false(file_exists(&file));
        tried = n;
    }
    fail_allocation(0);
    assert_true(tried >= 4);
    cipc_ccd_record_discard(record);
    sheet_scene_free(&scene);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_all_of_a_run_in_order, all_allocations_succeed), cmocka_unit_test_teardown(test_limit, all_allocations_succeed),
        cmocka_unit_test_teardown(test_threads_and_result, all_allocations_succeed),    cmocka_unit_test_teardown(test_cut_path_and_thickness, all_allocations_succeed),
        cmocka_unit_test_teardown(test_whole_or_the_old_one, all_allocations_succeed),  cmocka_unit_test_teardown(test_refusals, all_allocations_succeed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
