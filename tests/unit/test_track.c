/* Tracks: a sequence of files, one frame each. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/track.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

/* Frames 7 and 8 of a triangle that rises by one, in a row of files of which the third has a vertex more and the fourth is not a mesh. */
static const char *const names[] = {"walk007.obj", "walk008.obj", "walk009.obj", "walk010.obj", "run7.obj"};
static const char *const texts[] = {"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n", "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 1 3 2\n",
                                    "v 0 2 0\nv 1 2 0\nv 0 2 1\nv 1 2 1\nf 1 3 2\nf 2 3 4\n", "v 0 0\n", "v 5 5 5\nv 6 5 5\nv 5 5 6\nf 1 3 2\n"};
enum { FILES = 5, BODY_NODES = 3 };

typedef struct trial {
    char *folder, *files[FILES], scene[600];
} trial;

static trial set_up(void)
{
    trial t = {.folder = make_folder()};
    for (int i = 0; i < FILES; i++) t.files[i] = write_file(t.folder, names[i], texts[i], strlen(texts[i]));
    snprintf(t.scene, sizeof t.scene, "%s/t.json", t.folder);
    return t;
}

static void tear_down(trial *t)
{
    for (int i = 0; i < FILES; i++) free(t->files[i]);
    remove_folder(t->folder);
}

static const int first_and_last[] = {0, 2};
static const scene_tracked two_nodes = {"body", BODY_NODES, first_and_last, 2};

static void test_frames(void **state)
{
    (void)state;
    trial t = set_up();
    cipc_track track;
    char files[PATH_MAX], folder[PATH_MAX];
    scene_reader r = reader_of("{\"files\": \"walk%03d.obj\", \"first\": 7, \"count\": 2, \"begin\": 1.5, \"interval\": 0.25, \"scale\": 2, "
                               "\"translate\": [0, 0, 3]}");
    r.path = t.scene;
    scene_cursor root = scene_root(r.root);
    for (int again = 0; again < 2; again++) { /* the second time with what the tree says then, from elsewhere */
        scene_read_track(&r, &root, &two_nodes, &track);
        if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
        assert_true(track.frame_count == 2 && track.begin == 1.5 && track.interval == 0.25);
        static const double want[12] = {0, 0, 3, 0, 0, 5, 0, 2, 3, 0, 2, 5};
        assert_memory_equal(track.frames, want, sizeof want);
        cipc_free(track.frames);
        r.path = "t.json";
    }
    assert_non_null(realpath(t.folder, folder));
    snprintf(files, sizeof files, "%.4000s/walk%%03d.obj", folder);
    assert_string_equal(json_string_value(json_object_get(r.root, "files")), files);
    scene_reader_free(&r);
    tear_down(&t);
}

/* Without a first number it is 1; the number needs no zeros. */
static void test_names_of_files(void **state)
{
    (void)state;
    trial t = set_up();
    cipc_track track;
    scene_reader r = reader_of("{\"files\": \"run%d.obj\", \"first\": 7, \"count\": 1, \"interval\": 1}");
    r.path = t.scene;
    scene_cursor root = scene_root(r.root);
    scene_read_track(&r, &root, &two_nodes, &track);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(track.frame_count == 1 && track.begin == 0 && track.frames[0] == 5);
    cipc_free(track.frames);
    json_object_del(r.root, "first");
    scene_read_track(&r, &root, &two_nodes, &track);
    assert_int_equal(r.status, CIPC_E_MISSING_FILE);
    if (strstr(r.error.what, "/run1.obj' cannot be opened") == NULL) fail_msg("%s", r.error.what);
    scene_reader_free(&r);
    tear_down(&t);
}

static void refuse(const char *text, cipc_status status, const char *column_and_path, const char *what)
{
    trial t = set_up();
    cipc_track track;
    char place[700];
    scene_reader r = reader_of(text);
    r.path = t.scene;
    scene_cursor root = scene_root(r.root);
    scene_read_track(&r, &root, &two_nodes, &track);
    snprintf(place, sizeof place, "%s:%s", t.scene, column_and_path);
    if (column_and_path[0] == '/') snprintf(place, sizeof place, "%s%s", t.folder, column_and_path); /* a line of a frame's file */
    assert_rejection(&r, status, place, what);
    assert_null(track.frames);
    assert_int_equal(track.frame_count, 0);
    scene_reader_free(&r);
    tear_down(&t);
}

static void test_frames_that_are_missing_or_other(void **state)
{
    (void)state;
    refuse("{\"files\": \"walk%03d.obj\", \"first\": 6, \"count\": 2, \"interval\": 1}", CIPC_E_MISSING_FILE, "1:2 files",
           "walk006.obj' cannot be opened");
    refuse("{\"files\": \"walk%03d.obj\", \"first\": 7, \"count\": 3, \"interval\": 1}", CIPC_E_BAD_MESH, "1:2 files",
           "walk009.obj' has 4 vertices, but body 'body' has 3 nodes");
    refuse("{\"files\": \"walk%03d.obj\", \"first\": 10, \"count\": 1, \"interval\": 1}", CIPC_E_BAD_MESH, "/walk010.obj:1", "2 coordinates");
}

static void test_rejections(void **state)
{
    (void)state;
    refuse("{}", CIPC_E_MISSING_KEY, "1:1 files", "missing");
    refuse("{\"files\": \"walk.obj\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number in its file name");
    refuse("{\"files\": \"walk%d_%d.obj\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number");
    refuse("{\"files\": \"walk%s.obj\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number");
    refuse("{\"files\": \"walk%0\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number");
    refuse("{\"files\": \"walk%\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number");
    refuse("{\"files\": \"walk%d/a.obj\", \"count\": 2, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:2 files", "must have one number");
    refuse("{\"files\": \"walk%d.obj\", \"interval\": 1}", CIPC_E_MISSING_KEY, "1:1 count", "missing");
    refuse("{\"files\": \"walk%d.obj\", \"count\": 0, \"interval\": 1}", CIPC_E_OUT_OF_RANGE, "1:25 count", "at least 1");
    refuse("{\"files\": \"walk%d.obj\", \"count\": 1}", CIPC_E_MISSING_KEY, "1:1 interval", "missing");
    refuse("{\"files\": \"walk%d.obj\", \"count\": 1, \"interval\": 0}", CIPC_E_OUT_OF_RANGE, "1:37 interval", "greater than 0");
    refuse("{\"files\": \"walk%d.obj\", \"count\": 1, \"interval\": 1, \"first\": -1}", CIPC_E_OUT_OF_RANGE, "1:52 first", "at least 0");
    refuse("{\"files\": \"walk%d.obj\", \"count\": 1, \"interval\": 1, \"scale\": 0}", CIPC_E_OUT_OF_RANGE, "1:52 scale", "greater than 0");
    refuse("{\"file\": \"walk%d.obj\"}", CIPC_E_UNKNOWN_KEY, "1:2 file", "'files'");
}

/* A folder may be called anything. */
static void test_marks_in_folders_are_no_numbers(void **state)
{
    (void)state;
    cipc_track track;
    scene_reader r = reader_of("{\"files\": \"/no%where/at%d/all%d.obj\", \"count\": 1, \"interval\": 1}");
    scene_cursor root = scene_root(r.root);
    scene_read_track(&r, &root, &two_nodes, &track);
    assert_rejection(&r, CIPC_E_MISSING_FILE, "t.json:1:2 files", "'/no%where/at%d/all1.obj' cannot be opened");
    scene_reader_free(&r);
}

static void test_no_memory(void **state)
{
    (void)state;
    trial t = set_up();
    long n = 1;
    for (;; n++) {
        cipc_track track;
        scene_reader r = reader_of("{\"files\": \"walk%03d.obj\", \"first\": 7, \"count\": 2, \"interval\": 0.25}");
        r.path = t.scene;
        scene_cursor root = scene_root(r.root);
        fail_allocation(n);
        scene_read_track(&r, &root, &two_nodes, &track);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(r.status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (failed) assert_null(track.frames);
        cipc_free(track.frames);
        scene_reader_free(&r);
        if (!failed) break;
    }
    assert_true(n > 4); /* the frames and each file's text and mesh */
    tear_down(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames),
        cmocka_unit_test(test_names_of_files),
        cmocka_unit_test(test_frames_that_are_missing_or_other),
        cmocka_unit_test(test_rejections),
        cmocka_unit_test(test_marks_in_folders_are_no_numbers),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
