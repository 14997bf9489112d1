#include "support/mesh_files.h"

#include <stdarg.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh_formats.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

cipc_status try_mesh(const char *name, const char *text, size_t length, cipc_mesh_kind kind, cipc_mesh *mesh, cipc_error *error, char *path)
{
    char *folder = make_folder(), *file = write_file(folder, name, text, length);
    cipc_status status = cipc_mesh_read(mesh, file, kind, error);
    if (path != NULL) snprintf(path, 600, "%s", file);
    free(file);
    remove_folder(folder);
    return status;
}

cipc_mesh accept_mesh(const char *name, const char *text, cipc_mesh_kind kind)
{
    cipc_mesh mesh;
    cipc_error error;
    if (try_mesh(name, text, strlen(text), kind, &mesh, &error, NULL) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    return mesh;
}

static void assert_empty(const cipc_mesh *mesh)
{
    assert_null(mesh->nodes);
    assert_null(mesh->triangles);
    assert_null(mesh->segments);
    assert_null(mesh->tetrahedra);
    assert_int_equal(mesh->node_count + mesh->triangle_count + mesh->segment_count + mesh->tetrahedron_count, 0);
}

void reject_mesh(const char *name, const char *text, cipc_mesh_kind kind, cipc_status status, const char *what)
{
    marked_text marked = take_mark(text);
    cipc_mesh mesh;
    cipc_error error;
    char path[600], place[640];
    cipc_status found = try_mesh(name, marked.text, strlen(marked.text), kind, &mesh, &error, path);
    if (found == CIPC_OK) fail_msg("accepted, but '%s' was expected of:\n%s", what, text);
    if (marked.line > 0)
        snprintf(place, sizeof place, "%s:%d", path, marked.line);
    else
        snprintf(place, sizeof place, "%s", path);
    free(marked.text);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    if (strcmp(error.place, place) != 0) fail_msg("\"%s\" at %s, not at %s", error.what, error.place, place);
    assert_int_equal(found, status);
    assert_int_equal(error.status, status);
    assert_null(strchr(error.what, '\n'));
    assert_empty(&mesh);
}

static void assert_indices(const int *indices, int count, int nodes)
{
    for (int i = 0; i < count; i++) assert_true(indices[i] >= 0 && indices[i] < nodes);
}

/* Read what a text has become: sound or refused. */
static cipc_status survive(const char *name, const char *text, size_t length, cipc_mesh_kind kind)
{
    cipc_mesh mesh;
    cipc_error error;
    char *copy = malloc(length + 1); /* of its own length, so that sanitizers see a read beyond its end */
    memcpy(copy, text, length);
    copy[length] = '\0';
    cipc_status status = scene_read_mesh_text(&mesh, name, copy, length, kind, &error);
    free(copy);
    if (status != CIPC_OK) {
        assert_true(status == CIPC_E_BAD_MESH || status == CIPC_E_OUT_OF_RANGE);
        assert_memory_equal(error.place, name, strlen(name));
        assert_true(error.what[0] != '\0' && strchr(error.what, '\n') == NULL);
        assert_empty(&mesh);
        return status;
    }
    assert_true(mesh.node_count > 0);
    assert_indices((const int *)mesh.triangles, 3 * mesh.triangle_count, mesh.node_count);
    assert_indices((const int *)mesh.segments, 2 * mesh.segment_count, mesh.node_count);
    assert_indices((const int *)mesh.tetrahedra, 4 * mesh.tetrahedron_count, mesh.node_count);
    cipc_mesh_free(&mesh);
    return CIPC_OK;
}

static void cut_off_everywhere(const char *name, const char *text, cipc_mesh_kind kind, size_t needed)
{
    for (size_t length = 0; length <= strlen(text); length++) {
        for (int k = 0; k < 4; k++) {
            cipc_status status = survive(name, text, length, (cipc_mesh_kind)k);
            if (k == (int)kind && length <= needed && status == CIPC_OK) fail_msg("accepted the first %zu bytes of %s", length, text);
            if (k == (int)kind && length == strlen(text)) assert_int_equal(status, CIPC_OK);
        }
    }
}

static void replace_everywhere(const char *name, const char *text, cipc_mesh_kind kind)
{
    static const char others[] = {'0', '9', '-', ' ', '\n', 'x', '$', '.', '\0', '\x80'};
    size_t length = strlen(text);
    char *changed = strdup(text);
    for (size_t i = 0; i < length; i++) {
        for (size_t k = 0; k < sizeof others; k++) {
            changed[i] = others[k];
            survive(name, changed, length, kind);
        }
        changed[i] = text[i];
    }
    free(changed);
}

void maim_mesh_file(const char *name, const char *text, cipc_mesh_kind kind, size_t needed)
{
    cut_off_everywhere(name, text, kind, needed);
    replace_everywhere(name, text, kind);
}

void starve_mesh_file(const char *name, const char *text, cipc_mesh_kind kind)
{
    char *folder = make_folder(), *path = write_file(folder, name, text, strlen(text));
    for (long n = 1;; n++) {
        cipc_mesh mesh;
        cipc_error error;
        fail_allocation(n);
        cipc_status status = cipc_mesh_read(&mesh, path, kind, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        if (!failed) {
            assert_int_equal(status, CIPC_OK);
            assert_true(n > 3);
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_empty(&mesh);
    }
    free(path);
    remove_folder(folder);
}
