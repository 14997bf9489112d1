/* XDMF 3: tells ParaView where in the HDF5 file the frames are. One uniform grid per frame in a temporal collection. */
#include "cipc/output.h"
#include "output/atomic_file.h"

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

/* Frame `frame` of a dataset [frames][nodes][3]: start, stride and count of the slab, then the dataset as a whole. */
static void write_slab(FILE *out, const char *h5_name, const char *dataset, int frame, int frame_count, int node_count)
{
    fprintf(out, "          <DataItem ItemType=\"HyperSlab\" Dimensions=\"%d 3\">\n", node_count);
    fprintf(out, "            <DataItem Format=\"XML\" NumberType=\"Int\" Dimensions=\"3 3\">%d 0 0  1 1 1  1 %d 3</DataItem>\n", frame,
            node_count);
    fprintf(out, "            <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%d %d 3\">", frame_count,
            node_count);
    write_escaped(out, h5_name);
    fprintf(out, ":/%s</DataItem>\n          </DataItem>\n", dataset);
}

static void write_grid(FILE *out, const char *h5_name, const cipc_model *model, int frame, int frame_count, double time)
{
    fprintf(out, "      <Grid Name=\"frame %d\" GridType=\"Uniform\">\n        <Time Value=\"%.17g\"/>\n", frame,
            isfinite(time) ? time : frame);
    fprintf(out, "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"%d\">\n          ", model->triangle_count);
    write_item(out, h5_name, "/topology/triangles", "Int", 4, model->triangle_count, 3);
    fputs("        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n", out);
    write_slab(out, h5_name, "positions", frame, frame_count, model->node_count);
    fputs("        </Geometry>\n        <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">\n", out);
    write_slab(out, h5_name, "velocities", frame, frame_count, model->node_count);
    fputs("        </Attribute>\n        <Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">\n          ", out);
    write_item(out, h5_name, "/topology/triangle_body", "Int", 4, model->triangle_count, 1);
    fputs("        </Attribute>\n      </Grid>\n", out);
}

cipc_status cipc_xdmf_write(const char *path, const char *h5_name, const cipc_model *model, int frame_count, const double *times,
                            cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    FILE *out = file.stream;
    fputs("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
          "    <Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", out);
    for (int i = 0; i < frame_count; i++) {
        write_grid(out, h5_name, model, i, frame_count, times[i]);
    }
    fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", out);
    return cipc_atomic_close(&file, CIPC_OK, error);
}
