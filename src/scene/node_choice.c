/* Choosing nodes of the scene's bodies: the boxes that a selection may be relative to, and the selection. */
#include "scene/node_choice.h"

bool scene_node_choice_init(scene_node_choice *choice, scene_reader *r, const scene_cursor *cursor, const scene_bodies *bodies)
{
    *choice = (scene_node_choice){bodies, cipc_alloc((size_t)bodies->count, sizeof *choice->so_far)};
    if (choice->so_far == NULL) {
        scene_reject_memory(r, cursor);
        return false;
    }
    for (int b = 0; b < bodies->count; b++) {
        const cipc_body_description *d = &bodies->descriptions[b];
        choice->so_far[b] = scene_box_of(d->position, d->node_count);
        if (b > 0) choice->so_far[b] = scene_box_around(&choice->so_far[b - 1], &choice->so_far[b]);
    }
    return true;
}

void scene_node_choice_free(scene_node_choice *choice)
{
    cipc_free(choice->so_far);
}

int *scene_choose_nodes(const scene_node_choice *choice, scene_reader *r, const scene_cursor *entry, int body, int *count)
{
    const cipc_body_description *d = &choice->bodies->descriptions[body];
    const scene_selectable nodes = {d->position, d->node_count, choice->so_far[body], choice->so_far[choice->bodies->count - 1]};
    scene_cursor select = scene_member(entry, "select");
    *count = 0;
    if (select.value == NULL) scene_reject(r, &select, CIPC_E_MISSING_KEY, "required, but missing: one of box, nodes, nearest, ring, all");
    if (r->status != CIPC_OK) return NULL;
    int *chosen = cipc_alloc((size_t)d->node_count, sizeof *chosen);
    if (chosen == NULL)
        scene_reject_memory(r, entry);
    else
        *count = scene_select_nodes(r, &select, &nodes, chosen);
    if (r->status == CIPC_OK) return chosen;
    cipc_free(chosen);
    *count = 0;
    return NULL;
}
