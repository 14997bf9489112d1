/* Gmsh's mesh files, ASCII, versions 2.2 and 4.1 (the MSH chapter of Gmsh's manual). A row of a section stands on a line of its own, as Gmsh writes it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"
#include "scene/mesh_formats.h"

/* Nodes are named by tags, any positive numbers in any order. */
typedef struct node_tag {
    long long tag;
    int node, line;
} node_tag;

typedef struct gmsh_reader {
    scene_scan *scan;
    scene_parts *parts;
    bool blocks; /* 4.1: rows come in blocks */
    bool has_nodes, has_elements;
    node_tag *tags;
    long long tag_count, tag_capacity;
} gmsh_reader;

static const long long elements_max = 8LL * SCENE_TETRAHEDRA_MAX; /* of all types, with those that are not read */

static cipc_status expect(gmsh_reader *r, const char *text)
{
    scene_word word;
    cipc_status status = scene_expect_word(r->scan, SCENE_ANYWHERE, text, &word);
    if (status != CIPC_OK || scene_word_is(&word, text)) return status;
    return scene_scan_reject(r->scan, "'%.*s' where %s is expected", scene_shown(&word), word.text, text);
}

static cipc_status read_format(gmsh_reader *r)
{
    scene_word version;
    long long binary, size;
    cipc_status status = expect(r, "$MeshFormat");
    if (status == CIPC_OK) status = scene_expect_word(r->scan, SCENE_ANYWHERE, "a version", &version);
    if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "0 for ASCII", &binary);
    if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "the size of a number", &size);
    if (status != CIPC_OK) return status;
    r->blocks = scene_word_is(&version, "4.1");
    if (!r->blocks && !scene_word_is(&version, "2.2")) {
        return scene_scan_reject(r->scan, "version %.*s is not read; 2.2 and 4.1 are", scene_shown(&version), version.text);
    }
    if (binary != 0) return scene_scan_reject(r->scan, "binary Gmsh is not read: save as ASCII");
    return expect(r, "$EndMeshFormat");
}

static cipc_status add_tag(gmsh_reader *r, long long tag)
{
    cipc_status status = scene_grow(r->scan, &r->tags, r->tag_count, &r->tag_capacity, sizeof *r->tags);
    if (status != CIPC_OK) return status;
    if (tag < 1) return scene_scan_reject(r->scan, "node tag %lld; tags are positive", tag);
    r->tags[r->tag_count] = (node_tag){tag, (int)r->tag_count, r->scan->line};
    r->tag_count++;
    return CIPC_OK;
}

/* x y z; in a parametric block followed by the node's parameters on its curve or surface, which are not used. */
static cipc_status read_position(gmsh_reader *r, scene_reach reach, bool parametric)
{
    double x[3];
    cipc_status status = CIPC_OK;
    for (int k = 0; k < 3 && status == CIPC_OK; k++) status = scene_expect_number(r->scan, k == 0 ? reach : SCENE_SAME_LINE, "a coordinate", &x[k]);
    if (status == CIPC_OK && !parametric) status = scene_expect_line_end(r->scan, "three coordinates");
    if (status == CIPC_OK && parametric) scene_skip_line(r->scan);
    return status == CIPC_OK ? scene_parts_add_node(r->parts, r->scan, x) : status;
}

/* 2.2: tag x y z. */
static cipc_status read_node_rows(gmsh_reader *r, long long count)
{
    cipc_status status = CIPC_OK;
    for (long long i = 0; i < count && status == CIPC_OK; i++) {
        long long tag;
        status = scene_expect_entry(r->scan, "nodes", i, count);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "a node's tag", &tag);
        if (status == CIPC_OK) status = add_tag(r, tag);
        if (status == CIPC_OK) status = read_position(r, SCENE_SAME_LINE, false);
    }
    return status;
}

/* The head of a block of 4.1: dimension and tag of its entity, a third number, rows in it. `left`: rows announced and not yet read. */
static cipc_status read_block_head(gmsh_reader *r, const char *third, long long left, long long *third_value, long long *rows)
{
    long long entity[2];
    cipc_status status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "an entity's dimension", &entity[0]);
    if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "an entity's tag", &entity[1]);
    if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, third, third_value);
    if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "the rows of a block", rows);
    if (status == CIPC_OK) status = scene_expect_line_end(r->scan, "the head of a block");
    if (status != CIPC_OK || (*rows >= 0 && *rows <= left)) return status;
    return scene_scan_reject(r->scan, "a block of %lld rows, but %lld are left of those announced", *rows, left);
}

/* 4.1: the tags of a block, then its positions. */
static cipc_status read_node_block(gmsh_reader *r, long long *left)
{
    long long parametric, rows, tag;
    cipc_status status = read_block_head(r, "0 or 1 for parameters", *left, &parametric, &rows);
    for (long long i = 0; status == CIPC_OK && i < rows; i++) {
        status = scene_expect_entry(r->scan, "tags", i, rows);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "a node's tag", &tag);
        if (status == CIPC_OK) status = add_tag(r, tag);
    }
    for (long long i = 0; status == CIPC_OK && i < rows; i++) {
        status = scene_expect_entry(r->scan, "positions", i, rows);
        if (status == CIPC_OK) status = read_position(r, SCENE_ANYWHERE, parametric != 0);
    }
    if (status == CIPC_OK) *left -= rows;
    return status;
}

typedef struct element_type {
    int number;
    cipc_mesh_kind kind;
} element_type;

static const element_type *find_type(long long number)
{
    static const element_type types[] = {{1, CIPC_MESH_SEGMENTS}, {2, CIPC_MESH_TRIANGLES}, {4, CIPC_MESH_TETRAHEDRA}, {15, CIPC_MESH_NODES}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (types[i].number == number) return &types[i];
    }
    return NULL;
}

/* The nodes that end a row, as tags for now: $Elements may come before $Nodes. */
static cipc_status read_corners(gmsh_reader *r, long long number)
{
    const element_type *type = find_type(number);
    if (type == NULL) {
        char what[32];
        snprintf(what, sizeof what, "type %lld", number);
        scene_parts_skip(r->parts, what, 1);
        scene_skip_line(r->scan);
        return CIPC_OK;
    }
    long long corners[4];
    cipc_status status = CIPC_OK;
    for (int k = 0; k < scene_corners(type->kind) && status == CIPC_OK; k++) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "a node's tag", &corners[k]);
    if (status == CIPC_OK) status = scene_expect_line_end(r->scan, "an element's last node");
    return status == CIPC_OK ? scene_parts_add(r->parts, r->scan, r->scan->line, type->kind, corners) : status;
}

/* 2.2: tag type count-of-labels labels... nodes... */
static cipc_status read_element_rows(gmsh_reader *r, long long count)
{
    cipc_status status = CIPC_OK;
    for (long long i = 0; i < count && status == CIPC_OK; i++) {
        long long tag, type, labels, label;
        status = scene_expect_entry(r->scan, "elements", i, count);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "an element's tag", &tag);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "an element's type", &type);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "the number of labels", &labels);
        for (long long k = 0; status == CIPC_OK && k < labels; k++) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "a label", &label);
        if (status == CIPC_OK) status = read_corners(r, type);
    }
    return status;
}

/* 4.1: tag nodes... */
static cipc_status read_element_block(gmsh_reader *r, long long *left)
{
    long long type, rows, tag;
    cipc_status status = read_block_head(r, "an element type", *left, &type, &rows);
    for (long long i = 0; status == CIPC_OK && i < rows; i++) {
        status = scene_expect_entry(r->scan, "elements", i, rows);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "an element's tag", &tag);
        if (status == CIPC_OK) status = read_corners(r, type);
    }
    if (status == CIPC_OK) *left -= rows;
    return status;
}

/* The head of a section: "count", or in 4.1 "blocks count smallest-tag largest-tag". */
static cipc_status read_section_head(gmsh_reader *r, const char *what, long long limit, long long *blocks, long long *count)
{
    long long tag;
    cipc_status status = CIPC_OK;
    if (r->blocks) status = scene_expect_count(r->scan, SCENE_ANYWHERE, "the number of blocks", limit, blocks);
    if (status == CIPC_OK) status = scene_expect_count(r->scan, r->blocks ? SCENE_SAME_LINE : SCENE_ANYWHERE, what, limit, count);
    for (int k = 0; r->blocks && k < 2 && status == CIPC_OK; k++) status = scene_expect_integer(r->scan, SCENE_SAME_LINE, "a tag", &tag);
    return status == CIPC_OK ? scene_expect_line_end(r->scan, "the head of a section") : status;
}

static cipc_status read_nodes(gmsh_reader *r)
{
    if (r->has_nodes) return scene_scan_reject(r->scan, "a second $Nodes");
    r->has_nodes = true;
    long long blocks, count;
    cipc_status status = read_section_head(r, "the number of nodes", SCENE_NODES_MAX, &blocks, &count);
    if (status == CIPC_OK && !r->blocks) status = read_node_rows(r, count);
    for (long long b = 0; r->blocks && status == CIPC_OK && b < blocks; b++) {
        status = scene_expect_entry(r->scan, "blocks", b, blocks);
        if (status == CIPC_OK) status = read_node_block(r, &count);
    }
    if (status == CIPC_OK && r->blocks && count > 0) status = scene_scan_reject(r->scan, "the blocks have %lld nodes fewer than announced", count);
    return status == CIPC_OK ? expect(r, "$EndNodes") : status;
}

static cipc_status read_elements(gmsh_reader *r)
{
    if (r->has_elements) return scene_scan_reject(r->scan, "a second $Elements");
    r->has_elements = true;
    long long blocks, count;
    cipc_status status = read_section_head(r, "the number of elements", elements_max, &blocks, &count);
    if (status == CIPC_OK && !r->blocks) status = read_element_rows(r, count);
    for (long long b = 0; r->blocks && status == CIPC_OK && b < blocks; b++) {
        status = scene_expect_entry(r->scan, "blocks", b, blocks);
        if (status == CIPC_OK) status = read_element_block(r, &count);
    }
    if (status == CIPC_OK && r->blocks && count > 0) status = scene_scan_reject(r->scan, "the blocks have %lld elements fewer than announced", count);
    return status == CIPC_OK ? expect(r, "$EndElements") : status;
}

/* Of $Name up to $EndName, wherever it stands at the beginning of a line. */
static cipc_status skip_section(gmsh_reader *r, const scene_word *name)
{
    int line = r->scan->line;
    scene_skip_line(r->scan);
    for (scene_word word; scene_next_word(r->scan, SCENE_ANYWHERE, &word); scene_skip_line(r->scan)) {
        bool ends = word.length == name->length + 3 && memcmp(word.text, "$End", 4) == 0 && memcmp(word.text + 4, name->text + 1, (size_t)name->length - 1) == 0;
        if (ends) return CIPC_OK;
    }
    return scene_scan_reject_at(r->scan, line, CIPC_E_BAD_MESH, "the file ends inside %.*s", scene_shown(name), name->text);
}

static cipc_status read_section(gmsh_reader *r, const scene_word *name)
{
    if (scene_word_is(name, "$Nodes")) return read_nodes(r);
    if (scene_word_is(name, "$Elements")) return read_elements(r);
    if (name->text[0] == '$' && !(name->length >= 4 && memcmp(name->text, "$End", 4) == 0)) return skip_section(r, name);
    return scene_scan_reject(r->scan, "'%.*s' where a section should begin", scene_shown(name), name->text);
}

static int compare_tags(const void *a, const void *b)
{
    const node_tag *p = a, *q = b;
    return p->tag != q->tag ? (p->tag < q->tag ? -1 : 1) : p->line - q->line;
}

/* Gmsh writes tags in order, so that sorting is rarely needed. */
static cipc_status sort_tags(gmsh_reader *r)
{
    bool sorted = true;
    for (long long i = 1; i < r->tag_count; i++) sorted = sorted && r->tags[i - 1].tag < r->tags[i].tag;
    if (sorted) return CIPC_OK;
    qsort(r->tags, (size_t)r->tag_count, sizeof *r->tags, compare_tags);
    for (long long i = 1; i < r->tag_count; i++) {
        if (r->tags[i - 1].tag == r->tags[i].tag) {
            return scene_scan_reject_at(r->scan, r->tags[i].line, CIPC_E_BAD_MESH, "node tag %lld is taken by line %d", r->tags[i].tag, r->tags[i - 1].line);
        }
    }
    return CIPC_OK;
}

static int compare_tag(const void *key, const void *entry)
{
    long long tag = *(const long long *)key, other = ((const node_tag *)entry)->tag;
    return tag < other ? -1 : tag > other;
}

static cipc_status resolve_tags(gmsh_reader *r)
{
    cipc_status status = sort_tags(r);
    int corners = scene_corners(r->parts->kind);
    for (long long i = 0; status == CIPC_OK && i < corners * r->parts->element_count; i++) {
        long long *corner = &r->parts->corners[i];
        const node_tag *found = r->tag_count > 0 ? bsearch(corner, r->tags, (size_t)r->tag_count, sizeof *r->tags, compare_tag) : NULL;
        if (found == NULL) return scene_scan_reject_at(r->scan, r->parts->lines[i / corners], CIPC_E_BAD_MESH, "node tag %lld is not in $Nodes", *corner);
        *corner = found->node;
    }
    return status;
}

cipc_status scene_read_gmsh(scene_scan *scan, scene_parts *parts)
{
    gmsh_reader r = {.scan = scan, .parts = parts};
    cipc_status status = read_format(&r);
    for (scene_word name; status == CIPC_OK && scene_next_word(scan, SCENE_ANYWHERE, &name);) status = read_section(&r, &name);
    if (status == CIPC_OK && !r.has_nodes) status = scene_scan_reject_at(scan, 0, CIPC_E_BAD_MESH, "it has no $Nodes");
    if (status == CIPC_OK) status = resolve_tags(&r);
    cipc_free(r.tags);
    return status;
}
