/* Wavefront OBJ: the lines that describe vertices, faces and lines, and no guessing about the others. */
#include <errno.h>
#include <stdlib.h>

#include "scene/mesh_formats.h"

/* "v x y z", possibly followed by a weight or a colour, which must be numbers too and are not used. */
static cipc_status read_vertex(scene_scan *scan, scene_parts *parts)
{
    static const char *const names[] = {"coordinate 1", "coordinate 2", "coordinate 3", "a weight or colour"};
    double x[4] = {0};
    int count = 0;
    for (scene_word word; scene_peek_word(scan, SCENE_SAME_LINE, &word); count++) {
        int k = count < 3 ? count : 3;
        cipc_status status = scene_expect_number(scan, SCENE_SAME_LINE, names[k], &x[k]);
        if (status != CIPC_OK) return status;
    }
    if (count < 3) return scene_scan_reject(scan, "a vertex of %d coordinates; 3 are needed", count);
    return scene_parts_add_node(parts, scan, x);
}

/* The first number of "7", "7/1", "7//3" or "7/1/3" as index from 0. Negative numbers count back from the last vertex read. */
static cipc_status read_corner(scene_scan *scan, const scene_parts *parts, const scene_word *word, long long *index)
{
    char *end;
    errno = 0;
    long long value = strtoll(word->text, &end, 10);
    if (end == word->text || !(end == word->text + word->length || *end == '/')) {
        return scene_scan_reject(scan, "'%.*s' is not a vertex index", scene_shown(word), word->text);
    }
    if (errno != 0 || value == 0) return scene_scan_reject(scan, "vertex index %.*s; vertices are counted from 1", scene_shown(word), word->text);
    if (value < -parts->node_count) return scene_scan_reject(scan, "vertex index %lld, but %lld vertices come before", value, parts->node_count);
    *index = value > 0 ? value - 1 : parts->node_count + value;
    return CIPC_OK;
}

/* The triangles of a face, as a fan, or the segments of a polyline. */
static cipc_status read_element(scene_scan *scan, scene_parts *parts, cipc_mesh_kind kind)
{
    bool face = kind == CIPC_MESH_TRIANGLES;
    int count = 0, least = scene_corners(kind);
    long long corner[3] = {0}; /* first, previous and this one */
    for (scene_word word; scene_next_word(scan, SCENE_SAME_LINE, &word); count++) {
        cipc_status status = read_corner(scan, parts, &word, &corner[2]);
        if (status == CIPC_OK && count + 1 >= least) status = scene_parts_add(parts, scan, scan->line, kind, face ? corner : corner + 1);
        if (status != CIPC_OK) return status;
        if (count == 0) corner[0] = corner[2];
        corner[1] = corner[2];
    }
    return count >= least ? CIPC_OK : scene_scan_reject(scan, "a %s of %d vertices; %d are needed", face ? "face" : "line", count, least);
}

/* Statements that say nothing about the mesh: texture, normals, groups, smoothing, materials, names. */
static bool is_ignored(const scene_word *word)
{
    static const char *const ignored[] = {"vt", "vn", "g", "o", "s", "p", "usemtl", "mtllib", NULL};
    for (const char *const *name = ignored; *name != NULL; name++) {
        if (scene_word_is(word, *name)) return true;
    }
    return word->text[0] == '#';
}

cipc_status scene_read_obj(scene_scan *scan, scene_parts *parts, bool segments)
{
    parts->one = "vertex";
    parts->many = "vertices";
    parts->first = 1;
    cipc_status status = CIPC_OK;
    for (scene_word word; status == CIPC_OK && scene_next_word(scan, SCENE_ANYWHERE, &word);) {
        if (scene_word_is(&word, "v"))
            status = read_vertex(scan, parts);
        else if (scene_word_is(&word, "f"))
            status = read_element(scan, parts, CIPC_MESH_TRIANGLES);
        else if (scene_word_is(&word, "l") || (segments && scene_word_is(&word, "s")))
            status = read_element(scan, parts, CIPC_MESH_SEGMENTS);
        else if (is_ignored(&word))
            scene_skip_line(scan);
        else
            status = scene_scan_reject(scan, "unknown statement '%.*s'", scene_shown(&word), word.text);
    }
    return status;
}
