/* Wavefront OBJ: the lines that describe a surface, and no guessing about the others. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"
#include "scene/text_file.h"

/* Reading goes over the text twice: first to count, then to fill. */
typedef struct obj_reader {
    const char *path;
    int line;
    cipc_mesh *mesh; /* NULL while counting */
    cipc_mesh_kind kind;
    long long nodes, triangles; /* triangles: elements of the kind */
    cipc_error *error;
} obj_reader;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static cipc_status
reject(obj_reader *r, const char *format, ...)
{
    char place[sizeof r->error->place], what[256];
    size_t length = strlen(r->path), longest = sizeof place - 16;
    snprintf(place, sizeof place, "%s:%d", length > longest ? r->path + length - longest : r->path, r->line);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return cipc_fail(r->error, CIPC_E_BAD_MESH, place, "%s", what);
}

static const char *skip_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t' || *at == '\r') at++;
    return at;
}

static int word_length(const char *at)
{
    int length = 0;
    while (at[length] != '\0' && !isspace((unsigned char)at[length])) length++;
    return length;
}

/* "v x y z", possibly followed by a weight or a colour, which must be numbers too and are not used. */
static cipc_status read_vertex(obj_reader *r, const char *at)
{
    int count = 0;
    for (at = skip_blanks(at); *at != '\0'; at = skip_blanks(at), count++) {
        char *end;
        double value = strtod(at, &end);
        if (end == at || (*end != '\0' && !isspace((unsigned char)*end))) {
            return reject(r, "'%.*s' is not a number", word_length(at) < 40 ? word_length(at) : 40, at);
        }
        if (!isfinite(value)) return reject(r, "coordinate %d is not a finite number", count + 1);
        if (count < 3 && r->mesh != NULL) r->mesh->nodes[3 * r->nodes + count] = value;
        at = end;
    }
    if (count < 3) return reject(r, "a vertex of %d coordinates; 3 are needed", count);
    r->nodes++;
    return CIPC_OK;
}

/* The first number of "7", "7/1", "7//3" or "7/1/3" as index from 0. Negative numbers count back from the last vertex read. */
static cipc_status read_corner(obj_reader *r, const char *at, int *index)
{
    char *end;
    errno = 0;
    long value = strtol(at, &end, 10);
    bool ends = *end == '\0' || isspace((unsigned char)*end) || *end == '/';
    if (end == at || !ends) return reject(r, "'%.*s' is not a vertex index", word_length(at) < 40 ? word_length(at) : 40, at);
    if (r->mesh == NULL) return CIPC_OK;
    long count = r->mesh->node_count, found = value > 0 ? value - 1 : (long)r->nodes + value;
    if (errno != 0 || value == 0 || found < 0 || found >= count) {
        return reject(r, "vertex index %ld, but the file has %ld vertices, counted from 1", value, count);
    }
    *index = (int)found;
    return CIPC_OK;
}

static cipc_status add_triangle(obj_reader *r, int a, int b, int c)
{
    if (r->mesh != NULL) {
        if (a == b || b == c || c == a) return reject(r, "a face that names a vertex twice");
        int *triangle = r->mesh->triangles[r->triangles];
        triangle[0] = a;
        triangle[1] = b;
        triangle[2] = c;
    }
    r->triangles++;
    return CIPC_OK;
}

/* A line a b c ... becomes the segments (a b), (b c), ... */
static cipc_status read_polyline(obj_reader *r, const char *at)
{
    int previous = 0, corner = 0, count = 0;
    for (at = skip_blanks(at); *at != '\0'; at = skip_blanks(at + word_length(at)), count++) {
        cipc_status status = read_corner(r, at, &corner);
        if (status != CIPC_OK) return status;
        if (count > 0 && r->mesh != NULL) {
            if (previous == corner) return reject(r, "a line that names a vertex twice in a row");
            int *segment = r->mesh->segments[r->triangles];
            segment[0] = previous;
            segment[1] = corner;
        }
        r->triangles += count > 0;
        previous = corner;
    }
    return count >= 2 ? CIPC_OK : reject(r, "a line of %d vertices; 2 are needed", count);
}

/* A polygon a b c d ... becomes the fan (a b c), (a c d), ... */
static cipc_status read_face(obj_reader *r, const char *at)
{
    int first = 0, previous = 0, corner = 0, count = 0;
    for (at = skip_blanks(at); *at != '\0'; at = skip_blanks(at + word_length(at)), count++) {
        cipc_status status = read_corner(r, at, &corner);
        if (status == CIPC_OK && count >= 2) status = add_triangle(r, first, previous, corner);
        if (status != CIPC_OK) return status;
        if (count == 0) first = corner;
        previous = corner;
    }
    return count >= 3 ? CIPC_OK : reject(r, "a face of %d vertices; 3 are needed", count);
}

/* Statements that say nothing about the surface: texture, normals, groups, smoothing, materials, names. */
static bool is_ignored(const char *word, int length)
{
    static const char *const ignored[] = {"vt", "vn", "g", "o", "s", "usemtl", "mtllib", NULL};
    for (const char *const *name = ignored; *name != NULL; name++) {
        if ((int)strlen(*name) == length && memcmp(word, *name, (size_t)length) == 0) return true;
    }
    return false;
}

static cipc_status read_line(obj_reader *r, const char *line)
{
    const char *word = skip_blanks(line);
    int length = word_length(word);
    if (length == 0 || *word == '#') return CIPC_OK;
    if (length == 1 && *word == 'v') return read_vertex(r, word + 1);
    if (length == 1 && *word == 'f') return r->kind == CIPC_MESH_TRIANGLES ? read_face(r, word + 1) : CIPC_OK;
    /* The released code's .seg files say s where OBJ says l. */
    if (length == 1 && (*word == 'l' || (*word == 's' && r->kind == CIPC_MESH_SEGMENTS))) return r->kind == CIPC_MESH_SEGMENTS ? read_polyline(r, word + 1) : CIPC_OK;
    if (length == 1 && *word == 'p') return CIPC_OK;
    if (is_ignored(word, length)) return CIPC_OK;
    return reject(r, "unknown statement '%.*s'", length < 40 ? length : 40, word);
}

/* Lines are cut in place: '\n' becomes '\0' while its line is read. The text ends with '\0'. */
static cipc_status read_lines(obj_reader *r, char *text)
{
    r->line = 0;
    r->nodes = 0;
    r->triangles = 0;
    for (char *line = text; line != NULL;) {
        char *end = strchr(line, '\n');
        if (end != NULL) *end = '\0';
        r->line++;
        cipc_status status = read_line(r, line);
        if (end != NULL) *end = '\n';
        if (status != CIPC_OK) return status;
        line = end != NULL ? end + 1 : NULL;
    }
    return CIPC_OK;
}

static cipc_status read_text(obj_reader *r, cipc_mesh *mesh, char *text, size_t length)
{
    if (strlen(text) != length) return cipc_fail(r->error, CIPC_E_BAD_MESH, r->path, "not a text file: it has a zero byte");
    cipc_status status = read_lines(r, text);
    if (status != CIPC_OK) return status;
    if (r->nodes == 0 || (r->triangles == 0 && r->kind != CIPC_MESH_NODES)) {
        const char *elements = r->kind == CIPC_MESH_SEGMENTS ? "lines" : "triangles";
        return cipc_fail(r->error, CIPC_E_BAD_MESH, r->path, "an empty mesh: %lld vertices and %lld %s", r->nodes, r->triangles, elements);
    }
    status = scene_mesh_allocate_kind(mesh, r->kind, r->nodes, r->triangles, r->path, r->error);
    if (status != CIPC_OK) return status;
    r->mesh = mesh;
    return read_lines(r, text);
}

cipc_status scene_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_error own;
    obj_reader r = {.path = path, .kind = kind, .error = error != NULL ? error : &own};
    char *text = NULL;
    size_t length = 0;
    cipc_status status = scene_read_text(path, &text, &length, r.error);
    if (status == CIPC_OK) status = read_text(&r, mesh, text, length);
    if (status != CIPC_OK) cipc_mesh_free(mesh);
    cipc_free(text);
    return status;
}

cipc_status cipc_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_error *error) { return scene_mesh_read_obj(mesh, path, CIPC_MESH_TRIANGLES, error); }
