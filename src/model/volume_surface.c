/* The surface of tetrahedra. */
#include "model/mesh_topology.h"

#include <stdlib.h>
#include <string.h>

/* A face with its nodes in ascending order, to be found again, and as it is seen from outside. */
typedef struct face {
    int sorted[3], outward[3];
    int place; /* 4 * tetrahedron + face */
} face;

/* The face opposite to each node, anticlockwise from outside if the tetrahedron has positive volume. */
static const int face_nodes[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

static void sort3(int v[3])
{
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (v[k] > v[k + 1]) {
                int swap = v[k];
                v[k] = v[k + 1];
                v[k + 1] = swap;
            }
}

static int compare_faces(const void *a, const void *b)
{
    const face *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->sorted[k] != q->sorted[k]) return p->sorted[k] < q->sorted[k] ? -1 : 1;
    return (p->place > q->place) - (p->place < q->place);
}

static int compare_places(const void *a, const void *b)
{
    const face *p = a, *q = b;
    return (p->place > q->place) - (p->place < q->place);
}

static void fill_faces(const int (*tetrahedra)[4], int count, face *faces)
{
    for (int t = 0; t < count; t++)
        for (int f = 0; f < 4; f++) {
            face *made = &faces[4 * t + f];
            for (int k = 0; k < 3; k++) made->outward[k] = made->sorted[k] = tetrahedra[t][face_nodes[f][k]];
            sort3(made->sorted);
            made->place = 4 * t + f;
        }
    qsort(faces, 4 * (size_t)count, sizeof *faces, compare_faces);
}

/* Keep the faces that stand alone, at the front; -1 if one is there three times. */
static int keep_single(face *faces, int count)
{
    int kept = 0;
    for (int i = 0, j; i < count; i = j) {
        for (j = i + 1; j < count && memcmp(faces[i].sorted, faces[j].sorted, sizeof faces[i].sorted) == 0; j++) continue;
        if (j - i > 2) return -1;
        if (j - i == 1) faces[kept++] = faces[i];
    }
    return kept;
}

cipc_status cipc_volume_surface(const int (*tetrahedra)[4], int count, const char *body, int (**surface)[3], int *face_count, cipc_error *error)
{
    face *faces = cipc_alloc(4 * (size_t)count, sizeof *faces);
    *surface = NULL;
    if (!faces) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, body, "no memory for the surface of %d tetrahedra", count);
    fill_faces(tetrahedra, count, faces);
    *face_count = keep_single(faces, 4 * count);
    cipc_status status = CIPC_OK;
    if (*face_count < 0) {
        status = cipc_fail(error, CIPC_E_BAD_MESH, body, "a face belongs to more than two tetrahedra");
    } else {
        qsort(faces, (size_t)*face_count, sizeof *faces, compare_places);
        *surface = cipc_alloc((size_t)*face_count, sizeof **surface);
        if (!*surface) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, body, "no memory for the surface of %d tetrahedra", count);
        for (int i = 0; !status && i < *face_count; i++) memcpy((*surface)[i], faces[i].outward, sizeof faces[i].outward);
    }
    cipc_free(faces);
    return status;
}
