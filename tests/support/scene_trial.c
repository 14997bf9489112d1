#include "support/scene_trial.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

marked_text take_mark(const char *text)
{
    marked_text marked = {strdup(text), 0, 0};
    assert_non_null(marked.text);
    char *mark = strchr(marked.text, '@');
    if (mark == NULL) return marked;
    marked.line = marked.column = 1;
    for (char *c = marked.text; c < mark; c++) {
        marked.column = *c == '\n' ? 1 : marked.column + 1;
        marked.line += *c == '\n';
    }
    memmove(mark, mark + 1, strlen(mark));
    return marked;
}

char *make_folder(void)
{
    const char *base = getenv("TMPDIR");
    char path[512];
    snprintf(path, sizeof path, "%s/cipc-test-XXXXXX", base != NULL ? base : "/tmp");
    assert_non_null(mkdtemp(path));
    return strdup(path);
}

char *write_file(const char *folder, const char *name, const char *text, size_t length)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    return strdup(path);
}

void remove_folder(char *folder)
{
    DIR *entries = opendir(folder);
    assert_non_null(entries);
    for (struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        char path[1024];
        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        unlink(path);
    }
    closedir(entries);
    assert_int_equal(rmdir(folder), 0);
    free(folder);
}

char *scene_around(const char *root, const char *body)
{
    static const char format[] =
        "{\n  \"time_step\": 0.01, \"steps\": 2, %s\n  \"bodies\": [{\n    %s\n"
        "    \"name\": \"cloth\", \"density\": 100, \"thickness\": 1e-3,\n"
        "    \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [2, 2]}},\n"
        "    \"membrane\": {\"young\": 1e4, \"poisson\": 0.3}, \"bending\": {\"young\": 1e4, \"poisson\": 0.3}\n  }]\n}\n";
    size_t size = sizeof format + strlen(root) + strlen(body);
    char *text = malloc(size);
    assert_non_null(text);
    snprintf(text, size, format, root, body);
    return text;
}

static cipc_status load(const char *folder, const char *text, const char *override, cipc_scene **scene, cipc_error *error, char **path)
{
    *path = write_file(folder, "scene.json", text, strlen(text));
    return cipc_scene_load(scene, *path, override != NULL, &override, error);
}

cipc_status try_scene(const char *text, const char *override, cipc_scene **scene, cipc_error *error)
{
    char *folder = make_folder(), *path;
    cipc_status status = load(folder, text, override, scene, error, &path);
    free(path);
    remove_folder(folder);
    return status;
}

cipc_scene *accept_scene(const char *text, const char *override)
{
    cipc_scene *scene;
    cipc_error error;
    cipc_status status = try_scene(text, override, &scene, &error);
    if (status != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    return scene;
}

static void assert_contains(const char *text, const char *part)
{
    if (strstr(text, part) == NULL) fail_msg("\"%s\" does not contain \"%s\"", text, part);
}

static void assert_one_line(const cipc_error *error)
{
    assert_null(strchr(error->place, '\n'));
    assert_null(strchr(error->what, '\n'));
    assert_null(strchr(error->remedy, '\n'));
    assert_true(error->what[0] != '\0' && error->remedy[0] != '\0');
}

void reject_scene(const char *text, const char *override, cipc_status status, const char *path, const char *what)
{
    marked_text marked = take_mark(text);
    char *folder = make_folder(), *file, place[600];
    cipc_scene *scene = NULL;
    cipc_error error = {0};
    cipc_status found = load(folder, marked.text, override, &scene, &error, &file);
    if (found != status) fail_msg("status %d instead of %d: %s: %s", (int)found, (int)status, error.place, error.what);
    assert_null(scene);
    assert_int_equal(error.status, status);
    assert_int_equal(cipc_status_exit(status), 2);
    assert_one_line(&error);
    assert_contains(error.what, what);
    snprintf(place, sizeof place, "%s:%d:%d%s%s", file, marked.line, marked.column, path[0] != '\0' ? " " : "", path);
    if (marked.line > 0)
        assert_string_equal(error.place, place);
    else
        assert_contains(error.place, path);
    free(file);
    free(marked.text);
    remove_folder(folder);
}

void reject_around(const char *root, const char *body, cipc_status status, const char *path, const char *what)
{
    char *text = scene_around(root, body);
    reject_scene(text, NULL, status, path, what);
    free(text);
}

scene_reader reader_of(const char *text)
{
    scene_reader reader = {.path = "t.json", .text = text, .length = strlen(text), .root = json_loads(text, JSON_REJECT_DUPLICATES, NULL)};
    assert_non_null(reader.root);
    return reader;
}

void assert_rejection(scene_reader *reader, cipc_status status, const char *place, const char *what)
{
    assert_int_equal(reader->status, status);
    assert_int_equal(reader->error.status, status);
    assert_string_equal(reader->error.place, place);
    assert_one_line(&reader->error);
    assert_contains(reader->error.what, what);
    reader->status = CIPC_OK;
    reader->error = (cipc_error){0};
}
