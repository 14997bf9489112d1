/* What is sewn together, and which primitives meet at all. */
#include "cipc/model.h"

#include <math.h>
#include <stdlib.h>

static int compare_links(const void *a, const void *b)
{
    const int *p = a, *q = b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

static cipc_status check_stitch(const cipc_model *m, const cipc_stitching *s, cipc_error *error)
{
    for (int k = 0; k < 3; k++)
        if (s->nodes[k] < 0 || s->nodes[k] >= m->node_count)
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "stitches", "node %d does not exist; the model has %d", s->nodes[k], m->node_count);
    if (s->nodes[0] == s->nodes[1] || s->nodes[0] == s->nodes[2])
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "stitches", "node %d is sewn to itself", s->nodes[0]);
    if (!(s->ratio >= 0 && s->ratio <= 1)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "stitches", "ratio = %g is not in [0, 1]", s->ratio);
    if (!(s->stiffness > 0 && isfinite(s->stiffness)))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "stitches", "stiffness = %g is out of range", s->stiffness);
    return CIPC_OK;
}

/* Both orders of (node, end) for both ends. */
static void add_links(cipc_model *m, const cipc_stitching *s)
{
    for (int k = 1; k < 3; k++) {
        int pairs[2][2] = {{s->nodes[0], s->nodes[k]}, {s->nodes[k], s->nodes[0]}};
        for (int i = 0; i < 2; i++, m->link_count++)
            for (int j = 0; j < 2; j++) m->links[m->link_count][j] = pairs[i][j];
    }
}

cipc_status cipc_model_add_stitches(cipc_model *m, const cipc_stitching *stitches, int count, cipc_error *error)
{
    for (int i = 0; i < count; i++) {
        cipc_status status = check_stitch(m, &stitches[i], error);
        if (status) return status;
    }
    cipc_stitching *grown = cipc_realloc(m->stitches, (size_t)m->stitch_count + (size_t)count, sizeof *grown);
    if (grown) m->stitches = grown;
    int(*links)[2] = cipc_realloc(m->links, (size_t)m->link_count + 4 * (size_t)count, sizeof *links);
    if (links) m->links = links;
    if (!grown || !links) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stitches", "no memory for %d stitches", count);
    for (int i = 0; i < count; i++) {
        m->stitches[m->stitch_count++] = stitches[i];
        add_links(m, &stitches[i]);
    }
    qsort(m->links, (size_t)m->link_count, sizeof *m->links, compare_links);
    return CIPC_OK;
}

static bool is_linked(const cipc_model *m, int a, int b)
{
    const int wanted[2] = {a, b};
    return bsearch(wanted, m->links, (size_t)m->link_count, sizeof *m->links, compare_links) != NULL;
}

bool cipc_model_meet(const cipc_model *m, const int *a, int count_a, const int *b, int count_b)
{
    if (m->pair_apart && m->pair_apart[m->node_body[a[0]] * m->body_count + m->node_body[b[0]]]) return false;
    for (int i = 0; i < count_a; i++)
        for (int k = 0; k < count_b; k++)
            if (a[i] == b[k] || (m->link_count > 0 && is_linked(m, a[i], b[k]))) return false;
    return true;
}
