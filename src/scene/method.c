/* Which method takes the steps, and what it cannot do. */
#include "scene/method.h"

#include <math.h>
#include <stdio.h>

#include "scene/body_kind.h"

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
        refuse(r, &model, "the method c-ipc knows no membrane of springs", "use \"neo-hookean\" or \"stvk\", or another method");
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

/* The integrator knows the springs of shells, and what the block "mass_spring" says of them. */
static void check_massspring_body(scene_reader *r, const scene_cursor *body, const cipc_body_description *description)
{
    const cipc_material *m = &description->material;
    if (description->fixed) return;
    scene_cursor limit = scene_member(body, "strain_limit"), membrane = scene_member(body, "membrane"), model = scene_member(&membrane, "model");
    scene_cursor damping = scene_member(body, "damping"), mass = scene_member(&damping, "mass"), mesh = scene_member(body, scene_kind_key(description->kind));
    const char *name = json_string_value(json_object_get(body->value, "name"));
    char remedy[sizeof r->error.remedy];
    if (description->kind != CIPC_BODY_SHELL)
        refuse(r, &mesh, "the method mass-spring moves shells, and nothing else", "make it \"fixed\": true, or use another method");
    snprintf(remedy, sizeof remedy, "--set bodies.%s.strain_limit=null takes it away; mass_spring.deformation.bound limits springs", name);
    if (fmax(m->strain_limit, m->strain_lower_limit) > 0) refuse(r, &limit, "the method mass-spring knows no strain limits", remedy);
    snprintf(remedy, sizeof remedy, "--set bodies.%s.membrane.model=springs", name);
    if (m->membrane != CIPC_MEMBRANE_SPRINGS) refuse(r, membrane.value == NULL ? &mesh : &model, "the method mass-spring moves shells whose membrane is springs", remedy);
    if (m->damping_mass > 0) refuse(r, &mass, "the method mass-spring knows no damping by mass", "leave it out; damping.stiffness is known");
}

static bool is_empty(const scene_cursor *list) { return json_array_size(list->value) == 0; }

static void check_no_colliders(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor colliders = scene_member(root, "colliders");
    if (scene->collider_count > 0) refuse(r, &colliders, "colliders are of the method mass-spring", "leave them out, or use \"method\": \"mass-spring\"; fixed bodies stand in the way in every other");
}

static void check_implicit(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor loads = scene_member(root, "loads");
    if (scene->model->load_count > 0) refuse(r, &loads, "the method c-ipc knows no loads", "leave them out, or use \"method\": \"asynchronous\"");
    check_no_colliders(r, root, scene);
}

/* Kinds of steps that only the method c-ipc has. */
static void check_steps(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor quasistatic = scene_member(root, "quasistatic"), compat = scene_member(root, "compat");
    const char *name = cipc_method_name(scene->method);
    char what[128];
    snprintf(what, sizeof what, "the method %s knows no quasistatic steps", name);
    if (scene->options.quasistatic) refuse(r, &quasistatic, what, "leave it out");
    snprintf(what, sizeof what, "the released code is of the method c-ipc, not %s", name);
    if (scene->options.released) refuse(r, &compat, what, "leave it out");
}

static void check_massspring(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    scene_cursor loads = scene_member(root, "loads"), stitches = scene_member(root, "stitches"), friction = scene_member(root, "friction");
    check_steps(r, root, scene);
    if (!is_empty(&loads)) refuse(r, &loads, "the method mass-spring knows no loads", "leave them out; mass_spring.wind is known");
    if (!is_empty(&stitches)) refuse(r, &stitches, "the method mass-spring knows no stitches", "leave them out, or use another method");
    if (!is_empty(&friction))
        refuse(r, &friction, "the method mass-spring knows no friction between two bodies", "give each collider its friction, and cloth on itself mass_spring.self.friction");
}

static void check_whole(scene_reader *r, const scene_cursor *root, const cipc_scene *scene)
{
    if (scene->method == CIPC_METHOD_C_IPC) check_implicit(r, root, scene);
    if (scene->method == CIPC_METHOD_MASS_SPRING) check_massspring(r, root, scene);
    if (scene->method != CIPC_METHOD_ASYNCHRONOUS) return;
    check_steps(r, root, scene);
    check_no_colliders(r, root, scene);
}

static void check_body(scene_reader *r, const scene_cursor *body, const cipc_body_description *description, cipc_method method)
{
    if (method == CIPC_METHOD_C_IPC) check_implicit_body(r, body, &description->material);
    if (method == CIPC_METHOD_ASYNCHRONOUS) check_asynchronous_body(r, body, description);
    if (method == CIPC_METHOD_MASS_SPRING) check_massspring_body(r, body, description);
}

void scene_check_method(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, const cipc_scene *scene)
{
    scene_cursor list = scene_member(root, "bodies");
    check_whole(r, root, scene);
    for (int i = 0; i < bodies->entry_count; i++) {
        scene_cursor body = scene_element(&list, (size_t)i);
        check_body(r, &body, &bodies->descriptions[bodies->entries[i].first], scene->method);
    }
}
