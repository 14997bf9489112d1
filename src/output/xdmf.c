/* XDMF 3: tells ParaView where in the HDF5 file the frames are. A temporal collection of frames; a frame is a uniform grid of triangles,
 * segments or particles, or, where there are several of these, a spatial collection of such grids, which ParaView shows as blocks: so the
 * segments alone can be given tubes, the particles spheres. Tetrahedra are left out: their surface is among the triangles, and what is
 * inside would hide behind it. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "output/particle_nodes.h"

#include <math.h>

/* The five characters that XML reserves; control characters are not allowed in XML at all. */
static void write_escaped(FILE *out, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        switch (*c) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        case '\'': fputs("&apos;", out); break;
        default: fputc((unsigned char)*c < 0x20 ? ' ' : *c, out);
        }
    }
}

static void write_item(FILE *out, const char *h5_name, const char *path, const char *type, int precision, int rows, int columns)
{
    fprintf(out, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%d", type, precision, rows);
    if (columns > 1) {
        fprintf(out, " %d", columns);
    }
    fputs("\">", out);
    write_escaped(out, h5_name);
    fprintf(out, ":%s</DataItem>\n", path);
}

/* Frame `frame` of a dataset [frames][nodes][3]. ParaView has two libraries for XDMF, and no one way to name a slab serves both: the older (its
 * "XDMF Reader") knows the item HyperSlab, the newer ("Xdmf3 Reader") passes over it where geometry is wanted, but takes a selection
 * start:stride:count:extents behind the dataset's name. The item here is both. The newer library compares words to the letter, so it sees
 * an HDF item with a selection; the older folds case, so it sees a function that returns its argument, the slab. */
static void write_slab(FILE *out, const char *h5_name, const char *dataset, int frame, int frame_count, int node_count)
{
    fputs("          <DataItem ItemType=\"function\" Function=\"$0\" Format=\"HDF\" ", out);
    fprintf(out, "NumberType=\"Float\" Precision=\"8\" Dimensions=\"%d 3\">", node_count);
    write_escaped(out, h5_name);
    fprintf(out, ":/%s|%d 0 0:1 1 1:1 %d 3:%d %d 3\n", dataset, frame, node_count, frame_count, node_count);
    fprintf(out, "            <DataItem ItemType=\"HyperSlab\" Dimensions=\"%d 3\">\n", node_count);
    fputs("              <DataItem Format=\"XML\" NumberType=\"Int\" Dimensions=\"3 3\">", out);
    fprintf(out, "%d 0 0  1 1 1  1 %d 3</DataItem>\n", frame, node_count);
    fputs("              <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" ", out);
    fprintf(out, "Dimensions=\"%d %d 3\">", frame_count, node_count);
    write_escaped(out, h5_name);
    fprintf(out, ":/%s</DataItem>\n            </DataItem>\n          </DataItem>\n", dataset);
}

/* The cells of one sort: all elements of `nodes` nodes. */
typedef struct sort {
    const char *name, *topology; /* of the grid; the attributes of XDMF's Topology that say what it is */
    const char *path;            /* of the dataset [count][nodes] */
    int count, nodes;
} sort;

enum { SORT_COUNT = 3 };

/* The sorts that the model has, in sorts[]; returns how many. */
static int list_sorts(const cipc_model *model, sort sorts[SORT_COUNT])
{
    const sort all[SORT_COUNT] = {
        {"triangles", "TopologyType=\"Triangle\"", "/topology/triangles", model->triangle_count, 3},
        {"segments", "TopologyType=\"Polyline\" NodesPerElement=\"2\"", "/topology/segments", model->segment_count, 2},
        {"particles", "TopologyType=\"Polyvertex\" NodesPerElement=\"1\"", "/topology/particles", cipc_particle_count(model), 1},
    };
    int count = 0;
    for (int i = 0; i < SORT_COUNT; i++) {
        if (all[i].count > 0) {
            sorts[count++] = all[i];
        }
    }
    return count;
}

/* What the whole document is of. */
typedef struct document {
    FILE *out;
    const char *h5_name;
    int node_count, frame_count;
    int sort_count;
    sort sorts[SORT_COUNT];
} document;

static void write_time(const document *d, int frame, double time)
{
    fprintf(d->out, "        <Time Value=\"%.17g\"/>\n", isfinite(time) ? time : frame);
}

/* `body` is given at the nodes: all nodes of a cell are of one body, and one array serves all sorts. */
static void write_cells(const document *d, const sort *s, int frame)
{
    fprintf(d->out, "        <Topology %s NumberOfElements=\"%d\">\n          ", s->topology, s->count);
    write_item(d->out, d->h5_name, s->path, "Int", 4, s->count, s->nodes);
    fputs("        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n", d->out);
    write_slab(d->out, d->h5_name, "positions", frame, d->frame_count, d->node_count);
    fputs("        </Geometry>\n        <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">\n", d->out);
    write_slab(d->out, d->h5_name, "velocities", frame, d->frame_count, d->node_count);
    fputs("        </Attribute>\n        <Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Node\">\n          ", d->out);
    write_item(d->out, d->h5_name, "/topology/node_body", "Int", 4, d->node_count, 1);
    fputs("        </Attribute>\n", d->out);
}

static void write_frame(const document *d, int frame, double time)
{
    const bool lone = d->sort_count == 1;
    fprintf(d->out, "      <Grid Name=\"frame %d\" %s>\n", frame,
            lone ? "GridType=\"Uniform\"" : "GridType=\"Collection\" CollectionType=\"Spatial\"");
    write_time(d, frame, time);
    for (int i = 0; i < d->sort_count; i++) {
        if (!lone) {
            fprintf(d->out, "      <Grid Name=\"%s\" GridType=\"Uniform\">\n", d->sorts[i].name);
        }
        write_cells(d, &d->sorts[i], frame);
        if (!lone) {
            fputs("      </Grid>\n", d->out);
        }
    }
    fputs("      </Grid>\n", d->out);
}

cipc_status cipc_xdmf_write(const char *path, const char *h5_name, const cipc_model *model, int frame_count, const double *times,
                            cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    document d = {.out = file.stream, .h5_name = h5_name, .node_count = model->node_count, .frame_count = frame_count};
    d.sort_count = list_sorts(model, d.sorts);
    fputs("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
          "    <Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", d.out);
    for (int i = 0; i < frame_count; i++) {
        write_frame(&d, i, times[i]);
    }
    fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", d.out);
    return cipc_atomic_close(&file, CIPC_OK, error);
}
