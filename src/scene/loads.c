/* Loads: a force, shared evenly by the nodes of a body that it takes hold of, while a window of time is open. */
#include "scene/loads.h"

#include "scene/node_choice.h"

enum { LOADS_MAX = 100000 };

static void read_window(scene_reader *r, const scene_cursor *cursor, cipc_load *load)
{
    load->begin = scene_number(r, cursor, "begin", 0, scene_any);
    load->end = scene_time_or_never(r, cursor, "end");
    scene_cursor end = scene_member(cursor, "end");
    if (!(load->end > load->begin)) scene_reject(r, &end, CIPC_E_OUT_OF_RANGE, "is %g, but must be after the begin at %g", load->end, load->begin);
}

/* Three numbers; there is no force to fall back on. */
static void read_force(scene_reader *r, const scene_cursor *cursor, double force[3])
{
    scene_cursor member = scene_member(cursor, "force");
    scene_vector_at(r, &member, scene_any, force);
}

static void read_load(scene_reader *r, const scene_cursor *cursor, const scene_node_choice *choice, cipc_model *model)
{
    static const char *const keys[] = {"name", "body", "select", "force", "begin", "end", NULL};
    cipc_load load = {0};
    cipc_error error;
    if (!scene_is_object(r, cursor, keys)) return;
    if (json_object_get(cursor->value, "name") != NULL) scene_string(r, cursor, "name", NULL);
    scene_cursor name = scene_member(cursor, "body");
    const int body = scene_find_body(r, &name, choice->bodies);
    read_force(r, cursor, load.force);
    read_window(r, cursor, &load);
    if (r->status == CIPC_OK && choice->bodies->descriptions[body].fixed) scene_reject(r, &name, CIPC_E_OUT_OF_RANGE, "is fixed: no force moves it");
    load.nodes = scene_choose_nodes(choice, r, cursor, body, &load.node_count);
    for (int i = 0; i < load.node_count; i++) load.nodes[i] += model->bodies[body].first_node;
    for (int k = 0; k < 3 && load.node_count > 0; k++) load.force[k] /= load.node_count;
    if (r->status == CIPC_OK) scene_adopt(r, cursor, cipc_model_add_load(model, &load, &error), &error);
    cipc_free(load.nodes);
}

void scene_read_loads(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model)
{
    scene_node_choice choice;
    scene_cursor list = scene_array_member(r, root, "loads");
    if (!scene_is_array(r, &list, 0, LOADS_MAX) || !scene_node_choice_init(&choice, r, &list, bodies)) return;
    for (size_t i = 0; i < json_array_size(list.value) && r->status == CIPC_OK; i++) {
        scene_cursor load = scene_element(&list, i);
        read_load(r, &load, &choice, model);
    }
    scene_node_choice_free(&choice);
}
