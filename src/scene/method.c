/* Which method takes the steps, and what it cannot do. */
#include "scene/method.h"

#include <stdio.h>

cipc_method scene_read_method(scene_reader *r, const scene_cursor *root)
{
    const char *names[CIPC_METHOD_COUNT + 1] = {NULL};
    for (int m = 0; m < CIPC_METHOD_COUNT; m++) names[m] = cipc_method_name((cipc_method)m);
    return (cipc_method)scene_choice(r, root, "method", "method", names, CIPC_METHOD_C_IPC);
}

static void refuse(scene_reader *r, const scene_cursor *cursor, const char *what, const char *remedy)
{
    if (r->status != CIPC_OK) return;
    scene_reject(r, cursor, CIPC_E_OUT_OF_RANGE, "%s", what);
    cipc_fail_remedy(&r->error, "%s", remedy);
}

static void check_implicit_body(scene_reader *r, const scene_cursor *body, const cipc_material *m)
{
    scene_cursor membrane = scene_member(body, "membrane"), model = scene_member(&membrane, "model");
    if (m->membrane == CIPC_MEMBRANE_SPRINGS)
        refuse(r, &model, "the method c-ipc knows no membrane of springs", "use \"neo-hookean\" or \"stvk\", or \"method\": \"asynchronous\"");
}

/* Of a fixed body no element is looked at. */
static void check_asynchronous_body(scene_reader *r, const scene_cursor *body, const cipc_body_description *description)
{
    const cipc_material *m = &description->material;
    if (description->fixed) return;
    scene_cursor limit = scene_member(body, "strain_limit"), membrane = scene_member(body, "membrane"), model = scene_member(&membrane, "model");
    scene_cursor damping = scene_member(body, "damping"), mass = scene_member(&damping, "mass");
    char remedy[sizeof r->error.remedy];
    snprintf(remedy, sizeof remedy, "--set bodies.%s.strain_limit=null takes it away", json_string_value(json_object_get(body->value, "name")));
    if (m->strain_limit > 0 || m->strain_lower_limit > 0) refuse(r, &limit, "the method asynchronous knows no strain limits", remedy);
    if (m->membrane == CIPC_MEMBRANE_ORTHOTROPIC)
        refuse(r, &model, "the method asynchronous knows no orthotropic membrane, which has strain limits of its own", "use \"neo-hookean\", \"stvk\" or \"springs\"");
    if (m->damping_mass > 0) refuse(r, &mass, "the method asynchronous knows no damping by mass", "leave it out; damping.stiffness is known");
}

static void check_implicit(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor loads = scene_member(root, "loads");
    if (scene->model->load_count > 0) refuse(r, &loads, "the method c-ipc knows no loads", "leave them out, or use \"method\": \"asynchronous\"");
}

static void check_asynchronous(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor quasistatic = scene_member(root, "quasistatic"), compat = scene_member(root, "compat");
    if (scene->options.quasistatic) refuse(r, &quasistatic, "the method asynchronous knows no quasistatic steps", "leave it out");
    if (scene->options.released) refuse(r, &compat, "the released code is of the method c-ipc, not asynchronous", "leave it out");
}

void scene_check_method(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, const cipc_scene *scene)
{
    scene_cursor list = scene_member(root, "bodies");
    const bool implicit = scene->method == CIPC_METHOD_C_IPC;
    if (implicit) check_implicit(r, root, scene);
    else check_asynchronous(r, root, scene);
    for (int i = 0; i < bodies->entry_count; i++) {
        scene_cursor body = scene_element(&list, (size_t)i);
        const cipc_body_description *description = &bodies->descriptions[bodies->entries[i].first];
        if (implicit) check_implicit_body(r, &body, &description->material);
        else check_asynchronous_body(r, &body, description);
    }
}
