/* Pairs that the monitors leave out. */
#include "invariant/exemptions.h"

#include <stdlib.h>
#include <string.h>

static int compare_keys(const void *left, const void *right)
{
    const long long *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static long long key_of(const cipc_model *m, int a, int b)
{
    return a < b ? (long long)a * m->node_count + b : (long long)b * m->node_count + a;
}

bool invariant_exemptions_init(invariant_exemptions *e, const cipc_model *model)
{
    *e = (invariant_exemptions){.model = model, .any = model->stitch_count > 0};
    for (int i = 0; model->pair_apart != NULL && i < model->body_count * model->body_count; i++) { e->any = e->any || model->pair_apart[i]; }
    e->sewn = cipc_alloc(2 * (size_t)model->stitch_count, sizeof *e->sewn);
    if (e->sewn == NULL) { return false; }
    for (int i = 0; i < model->stitch_count; i++) {
        const int *n = model->stitches[i].nodes;
        for (int end = 1; end < 3; end++) { e->sewn[e->sewn_count++] = key_of(model, n[0], n[end]); }
    }
    qsort(e->sewn, (size_t)e->sewn_count, sizeof *e->sewn, compare_keys);
    return true;
}

void invariant_exemptions_free(invariant_exemptions *e)
{
    cipc_free(e->sewn);
    memset(e, 0, sizeof *e);
}

static bool is_sewn(const invariant_exemptions *e, int a, int b)
{
    const long long key = key_of(e->model, a, b);
    return bsearch(&key, e->sewn, (size_t)e->sewn_count, sizeof key, compare_keys) != NULL;
}

bool invariant_exempt(const invariant_exemptions *e, const int *a, int count_a, const int *b, int count_b)
{
    const cipc_model *m = e->model;
    if (!e->any) { return false; }
    if (m->pair_apart != NULL && m->pair_apart[m->node_body[a[0]] * m->body_count + m->node_body[b[0]]]) { return true; }
    for (int i = 0; e->sewn_count > 0 && i < count_a; i++) {
        for (int k = 0; k < count_b; k++) {
            if (is_sewn(e, a[i], b[k])) { return true; }
        }
    }
    return false;
}
