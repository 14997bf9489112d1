/* The order in which a patch tree holds the primitives of a model: neighbours at rest stay near one another, so consecutive primitives
 * make compact patches. */
#include "invariant/rest_order.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "cipc/base.h"

/* Cells along each axis of the Morton curve: 2^10, so that three indices make 30 bits. */
enum { CURVE_BITS = 10, BODY_SHIFT = 3 * CURVE_BITS, FIXED_SHIFT = 62 };

typedef struct keyed_item {
    uint64_t key;
    int item;
} keyed_item;

/* Bounding box at rest of a body. */
typedef struct rest_box {
    double lo[3], hi[3];
} rest_box;

static int compare_items(const void *left, const void *right)
{
    const keyed_item *a = left, *b = right;
    if (a->key != b->key) { return a->key < b->key ? -1 : 1; }
    return (a->item > b->item) - (a->item < b->item);
}

static void measure_bodies(rest_box *boxes, const cipc_model *m)
{
    for (int b = 0; b < m->body_count; b++) { boxes[b] = (rest_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}; }
    for (int i = 0; i < m->node_count; i++) {
        rest_box *box = &boxes[m->node_body[i]];
        for (int k = 0; k < 3; k++) {
            double v = m->rest[3 * (size_t)i + (size_t)k];
            box->lo[k] = v < box->lo[k] ? v : box->lo[k];
            box->hi[k] = v > box->hi[k] ? v : box->hi[k];
        }
    }
}

/* The bits of the three cell indices interleaved: place along the Morton curve. */
static uint64_t morton(const uint32_t cell[3])
{
    uint64_t code = 0;
    for (int bit = CURVE_BITS - 1; bit >= 0; bit--) {
        for (int k = 0; k < 3; k++) { code = code << 1 | (cell[k] >> bit & 1); }
    }
    return code;
}

/* Cells are cubes: the body's longest side is divided. */
static uint64_t curve_place(const rest_box *box, const double centre[3])
{
    double longest = 0;
    for (int k = 0; k < 3; k++) { longest = fmax(longest, box->hi[k] - box->lo[k]); }
    uint32_t cell[3];
    for (int k = 0; k < 3; k++) {
        double t = longest > 0 ? (centre[k] - box->lo[k]) / longest : 0;
        double index = t * (1 << CURVE_BITS);
        cell[k] = (uint32_t)(index > 0 ? fmin(index, (1 << CURVE_BITS) - 1) : 0);
    }
    return morton(cell);
}

static uint64_t key_of(const cipc_model *m, const rest_box *boxes, const int *nodes, int size, const bool *fixed)
{
    double centre[3] = {0, 0, 0};
    uint64_t all_fixed = 1;
    for (int i = 0; i < size; i++) {
        all_fixed = fixed[nodes[i]] ? all_fixed : 0;
        for (int k = 0; k < 3; k++) { centre[k] += m->rest[3 * (size_t)nodes[i] + (size_t)k] / size; }
    }
    int body = m->node_body[nodes[0]];
    return all_fixed << FIXED_SHIFT | (uint64_t)body << BODY_SHIFT | curve_place(&boxes[body], centre);
}

bool cipc_rest_order(int *order, const cipc_model *model, const int *nodes, int size, int count, const bool *fixed)
{
    keyed_item *items = cipc_alloc((size_t)count, sizeof *items);
    rest_box *boxes = cipc_alloc((size_t)model->body_count, sizeof *boxes);
    bool ok = items != NULL && boxes != NULL;
    if (ok) {
        measure_bodies(boxes, model);
        for (int i = 0; i < count; i++) { items[i] = (keyed_item){key_of(model, boxes, &nodes[(size_t)size * (size_t)i], size, fixed), i}; }
        qsort(items, (size_t)count, sizeof *items, compare_items);
        for (int i = 0; i < count; i++) { order[i] = items[i].item; }
    }
    cipc_free(items);
    cipc_free(boxes);
    return ok;
}
