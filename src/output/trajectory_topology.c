/* The parts of a trajectory file that never change: the mesh, the bodies and the scene. */
#include "output/particle_nodes.h"
#include "output/trajectory_file.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A row of /topology/bodies. */
typedef struct body_row {
    char name[CIPC_NAME_SIZE];
    int32_t kind, first_node, node_count, first_triangle, triangle_count, first_segment, segment_count;
    int32_t first_tetrahedron, tetrahedron_count, fixed;
    double offset, thickness, strain_limit;
} body_row;

/* A kind is a number with a name, so that whoever reads the file needs no table of ours. */
static hid_t kind_type(void)
{
    static const struct { const char *name; int32_t value; } kinds[] = {
        {"shell", CIPC_BODY_SHELL}, {"rods", CIPC_BODY_RODS}, {"particles", CIPC_BODY_PARTICLES}, {"volume", CIPC_BODY_VOLUME}};
    hid_t type = H5Tenum_create(H5T_NATIVE_INT32);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        H5Tenum_insert(type, kinds[i].name, &kinds[i].value);
    }
    return type;
}

static hid_t body_row_type(void)
{
    static const struct { const char *name; size_t offset; } integers[] = {
        {"first_node", offsetof(body_row, first_node)},
        {"node_count", offsetof(body_row, node_count)},
        {"first_triangle", offsetof(body_row, first_triangle)},
        {"triangle_count", offsetof(body_row, triangle_count)},
        {"first_segment", offsetof(body_row, first_segment)},
        {"segment_count", offsetof(body_row, segment_count)},
        {"first_tetrahedron", offsetof(body_row, first_tetrahedron)},
        {"tetrahedron_count", offsetof(body_row, tetrahedron_count)},
        {"fixed", offsetof(body_row, fixed)},
    };
    hid_t row = H5Tcreate(H5T_COMPOUND, sizeof(body_row)), name = H5Tcopy(H5T_C_S1), kind = kind_type();
    H5Tset_size(name, CIPC_NAME_SIZE);
    H5Tset_cset(name, H5T_CSET_UTF8);
    H5Tinsert(row, "name", offsetof(body_row, name), name);
    H5Tinsert(row, "kind", offsetof(body_row, kind), kind);
    for (size_t i = 0; i < sizeof integers / sizeof integers[0]; i++) {
        H5Tinsert(row, integers[i].name, integers[i].offset, H5T_NATIVE_INT32);
    }
    H5Tinsert(row, "offset", offsetof(body_row, offset), H5T_NATIVE_DOUBLE);
    H5Tinsert(row, "thickness", offsetof(body_row, thickness), H5T_NATIVE_DOUBLE);
    H5Tinsert(row, "strain_limit", offsetof(body_row, strain_limit), H5T_NATIVE_DOUBLE);
    H5Tclose(kind);
    H5Tclose(name);
    return row;
}

/* NULL: out of memory. The rows are zeroed first, so that the bytes after a name are the same in every file. */
static body_row *body_rows(const cipc_model *model)
{
    body_row *rows = cipc_alloc((size_t)model->body_count, sizeof *rows);
    for (int b = 0; rows != NULL && b < model->body_count; b++) {
        const cipc_body *body = &model->bodies[b];
        memcpy(rows[b].name, body->name, strnlen(body->name, CIPC_NAME_SIZE - 1));
        rows[b].kind = (int32_t)body->kind;
        rows[b].first_node = body->first_node;
        rows[b].node_count = body->node_count;
        rows[b].first_triangle = body->first_triangle;
        rows[b].triangle_count = body->triangle_count;
        rows[b].first_segment = body->first_segment;
        rows[b].segment_count = body->segment_count;
        rows[b].first_tetrahedron = body->first_tetrahedron;
        rows[b].tetrahedron_count = body->tetrahedron_count;
        rows[b].fixed = body->fixed;
        rows[b].offset = body->offset;
        rows[b].thickness = body->material.thickness;
        rows[b].strain_limit = body->material.strain_limit;
    }
    return rows;
}

/* One array of the topology: where it is, what it is, how long. */
typedef struct part {
    const char *path;
    hid_t memory_type, file_type;
    hsize_t rows;
    int columns; /* 0: the dataset has rank 1 */
    size_t element_size;
    const void *values;
} part;

enum { PART_COUNT = 9 };

/* All parts of a model; what the model itself does not have in this form is kept here. */
typedef struct topology {
    hid_t row_type;
    body_row *rows;
    int *particles;
    part parts[PART_COUNT];
} topology;

static void list_parts(topology *t, const cipc_model *model)
{
    const hsize_t nodes = (hsize_t)model->node_count, bodies = (hsize_t)model->body_count;
    const hsize_t triangles = (hsize_t)model->triangle_count, edges = (hsize_t)model->edge_count;
    const hsize_t segments = (hsize_t)model->segment_count, tetrahedra = (hsize_t)model->tetrahedron_count;
    const hsize_t particles = (hsize_t)cipc_particle_count(model);
    const part list[PART_COUNT] = {
        {"topology/triangles", H5T_NATIVE_INT, H5T_STD_I32LE, triangles, 3, sizeof(int), model->triangles},
        {"topology/triangle_body", H5T_NATIVE_INT, H5T_STD_I32LE, triangles, 0, sizeof(int), model->triangle_body},
        {"topology/edges", H5T_NATIVE_INT, H5T_STD_I32LE, edges, 2, sizeof(int), model->edges},
        {"topology/segments", H5T_NATIVE_INT, H5T_STD_I32LE, segments, 2, sizeof(int), model->edges + model->first_segment},
        {"topology/particles", H5T_NATIVE_INT, H5T_STD_I32LE, particles, 0, sizeof(int), t->particles},
        {"topology/tetrahedra", H5T_NATIVE_INT, H5T_STD_I32LE, tetrahedra, 4, sizeof(int), model->tetrahedra},
        {"topology/node_body", H5T_NATIVE_INT, H5T_STD_I32LE, nodes, 0, sizeof(int), model->node_body},
        {"topology/rest", H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, nodes, 3, sizeof(double), model->rest},
        {"topology/bodies", t->row_type, t->row_type, bodies, 0, sizeof(body_row), t->rows},
    };
    memcpy(t->parts, list, sizeof list);
}

static void topology_free(topology *t)
{
    if (t->row_type >= 0) {
        H5Tclose(t->row_type);
    }
    cipc_free(t->rows);
    cipc_free(t->particles);
}

/* False: out of memory; there is nothing to free then. */
static bool topology_of(topology *t, const cipc_model *model)
{
    *t = (topology){.row_type = -1, .rows = body_rows(model), .particles = cipc_particle_nodes(model)};
    if (t->rows == NULL || t->particles == NULL) {
        topology_free(t);
        return false;
    }
    t->row_type = body_row_type();
    list_parts(t, model);
    return true;
}

static bool write_dataset(hid_t file, const char *path, hid_t memory_type, hid_t file_type, hid_t space, const void *values)
{
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(creation, false);
    hid_t dataset = H5Dcreate(file, path, file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    bool good = dataset >= 0 && (H5Sget_simple_extent_npoints(space) == 0 ||
                                 H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    if (dataset >= 0) {
        good = H5Dclose(dataset) >= 0 && good;
    }
    H5Pclose(creation);
    return good;
}

static bool write_part(hid_t file, const part *p)
{
    const hsize_t dims[2] = {p->rows, (hsize_t)p->columns};
    hid_t space = H5Screate_simple(p->columns > 0 ? 2 : 1, dims, NULL);
    bool good = write_dataset(file, p->path, p->memory_type, p->file_type, space, p->values);
    H5Sclose(space);
    return good;
}

static bool write_scene(hid_t file, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text) + 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    bool good = write_dataset(file, "scene", type, type, space, text);
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

static bool make_group(hid_t file, const char *name)
{
    hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(creation, false);
    hid_t group = H5Gcreate(file, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    return group >= 0 && H5Gclose(group) >= 0;
}

bool cipc_trajectory_topology_write(hid_t file, const cipc_model *model, const char *scene_json)
{
    topology t;
    if (!topology_of(&t, model)) {
        return false;
    }
    bool good = make_group(file, "topology") && write_scene(file, scene_json);
    for (int i = 0; i < PART_COUNT && good; i++) {
        good = write_part(file, &t.parts[i]);
    }
    topology_free(&t);
    return good;
}

bool cipc_trajectory_topology_copy(hid_t from, hid_t to)
{
    return H5Ocopy(from, "topology", to, "topology", H5P_DEFAULT, H5P_DEFAULT) >= 0 &&
           H5Ocopy(from, "scene", to, "scene", H5P_DEFAULT, H5P_DEFAULT) >= 0;
}

/* Has the dataset the part's extents and, bit by bit, its values? */
static bool part_matches(hid_t file, const part *p)
{
    const size_t elements = (size_t)p->rows * (size_t)(p->columns > 0 ? p->columns : 1);
    hid_t dataset = H5Dopen(file, p->path, H5P_DEFAULT);
    hid_t space = dataset >= 0 ? H5Dget_space(dataset) : -1;
    void *values = cipc_alloc(elements, p->element_size);
    hsize_t dims[2] = {0, 0};
    bool same = space >= 0 && values != NULL && H5Sget_simple_extent_ndims(space) == (p->columns > 0 ? 2 : 1) &&
                H5Sget_simple_extent_dims(space, dims, NULL) >= 0 && dims[0] == p->rows && dims[1] == (hsize_t)p->columns;
    if (same && elements > 0) {
        same = H5Dread(dataset, p->memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0 &&
               memcmp(values, p->values, elements * p->element_size) == 0;
    }
    cipc_free(values);
    if (space >= 0) {
        H5Sclose(space);
    }
    if (dataset >= 0) {
        H5Dclose(dataset);
    }
    return same;
}

bool cipc_trajectory_topology_matches(hid_t file, const cipc_model *model)
{
    topology t;
    if (!topology_of(&t, model)) {
        return false;
    }
    bool same = true;
    for (int i = 0; i < PART_COUNT && same; i++) {
        same = part_matches(file, &t.parts[i]);
    }
    topology_free(&t);
    return same;
}

char *cipc_trajectory_scene_read(hid_t file)
{
    hid_t dataset = H5Dopen(file, "scene", H5P_DEFAULT);
    if (dataset < 0) {
        return NULL;
    }
    hid_t type = H5Dget_type(dataset);
    char *text = NULL;
    if (H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type)) {
        text = cipc_alloc(H5Tget_size(type) + 1, 1);
    }
    if (text != NULL && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0) {
        cipc_free(text);
        text = NULL;
    }
    H5Tclose(type);
    H5Dclose(dataset);
    return text;
}
