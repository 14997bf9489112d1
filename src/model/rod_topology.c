/* Joints of rods: every two segments that share a node bend against each other (SPEC C.6). */
#include "model/mesh_topology.h"

#include <stdlib.h>

/* One end of a segment: the node there, and the other node. */
typedef struct segment_end {
    int node, other;
} segment_end;

static int compare_ends(const void *a, const void *b)
{
    const segment_end *p = a, *q = b;
    if (p->node != q->node) return p->node < q->node ? -1 : 1;
    return (p->other > q->other) - (p->other < q->other);
}

static void fill_ends(const cipc_model *m, segment_end *ends)
{
    for (int i = 0; i < m->segment_count; i++) {
        const int *v = m->edges[m->first_segment + i];
        ends[2 * i] = (segment_end){v[0], v[1]};
        ends[2 * i + 1] = (segment_end){v[1], v[0]};
    }
    qsort(ends, 2 * (size_t)m->segment_count, sizeof *ends, compare_ends);
}

/* The pairs among ends i..j-1, which are all at one node: counted, and written if there is where to. */
static int pair_up(const segment_end *ends, int i, int j, int (*joints)[3])
{
    int count = 0;
    for (int a = i; a < j; a++)
        for (int b = a + 1; b < j; b++, count++) {
            if (!joints) continue;
            joints[count][0] = ends[a].other;
            joints[count][1] = ends[a].node;
            joints[count][2] = ends[b].other;
        }
    return count;
}

static int all_pairs(const segment_end *ends, int end_count, int (*joints)[3])
{
    int count = 0;
    for (int i = 0, j; i < end_count; i = j) {
        for (j = i + 1; j < end_count && ends[j].node == ends[i].node; j++) continue;
        count += pair_up(ends, i, j, joints ? joints + count : NULL);
    }
    return count;
}

cipc_status cipc_rod_topology(cipc_model *m, cipc_error *error)
{
    segment_end *ends = cipc_alloc(2 * (size_t)m->segment_count, sizeof *ends);
    if (ends) {
        fill_ends(m, ends);
        m->joint_count = all_pairs(ends, 2 * m->segment_count, NULL);
        m->joints = cipc_alloc((size_t)m->joint_count, sizeof *m->joints);
        if (m->joints) (void)all_pairs(ends, 2 * m->segment_count, m->joints);
    }
    cipc_free(ends);
    return m->joints ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for the joints of %d segments", m->segment_count);
}
