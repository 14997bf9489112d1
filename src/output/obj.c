/* Wavefront OBJ: every number with the 17 digits that give the same double back. Triangles are faces, segments lines, particles points. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "output/particle_nodes.h"

#include <ctype.h>

/* A group name is one word. */
static void write_group_name(FILE *out, const char *name)
{
    for (const char *c = name; *c != '\0'; c++) {
        fputc(isspace((unsigned char)*c) ? '_' : *c, out);
    }
}

static void write_body(FILE *out, const cipc_model *model, const cipc_body *body)
{
    fputs("g ", out);
    write_group_name(out, body->name);
    fputc('\n', out);
    for (int t = body->first_triangle; t < body->first_triangle + body->triangle_count; t++) {
        const int *v = model->triangles[t];
        fprintf(out, "f %d %d %d\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
    for (int i = body->first_segment; i < body->first_segment + body->segment_count; i++) {
        const int *v = model->edges[model->first_segment + i];
        fprintf(out, "l %d %d\n", v[0] + 1, v[1] + 1);
    }
    for (int n = body->first_node; n < body->first_node + body->node_count && body->kind == CIPC_BODY_PARTICLES; n++) {
        fprintf(out, "p %d\n", n + 1);
    }
}

cipc_status cipc_obj_write(const char *path, const cipc_model *model, const double *position, cipc_error *error)
{
    cipc_atomic_file file;
    cipc_status status = cipc_atomic_open(&file, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    FILE *out = file.stream;
    fprintf(out, "# cipc %s: %d nodes, %d triangles, %d segments, %d particles, metres\n", cipc_version(), model->node_count,
            model->triangle_count, model->segment_count, cipc_particle_count(model));
    for (int i = 0; i < model->node_count; i++) {
        fprintf(out, "v %.17g %.17g %.17g\n", position[3 * i], position[3 * i + 1], position[3 * i + 2]);
    }
    for (int b = 0; b < model->body_count; b++) {
        write_body(out, model, &model->bodies[b]);
    }
    return cipc_atomic_close(&file, CIPC_OK, error);
}
