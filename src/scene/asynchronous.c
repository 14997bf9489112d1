/* The block "asynchronous". Defaults are the integrator's own, but for those that the rest of the scene says. */
#include "scene/asynchronous.h"

enum { EVENTS_MAX = 2000000000 };
static const scene_range fraction = {0, 1, true, false}, unit = {0, 1, false, false};

void scene_read_asynchronous(scene_reader *r, const scene_cursor *root, const cipc_implicit_options *implicit, cipc_asynchronous_options *o)
{
    static const char *const keys[] = {"thickness", "stiffness", "layer_factor", "element_factor", "gravity_step", "script_step", "restitution", "clocks", "events", NULL};
    static const char *const clocks[] = {"nested", "own", NULL}; /* in the order of cipc_clocks */
    *o = cipc_asynchronous_options_default();
    o->frame = implicit->time_step;
    scene_cursor block = scene_object_member(r, root, "asynchronous");
    if (!scene_is_object(r, &block, keys)) return;
    o->thickness = scene_number(r, &block, "thickness", implicit->contact.dhat, scene_positive);
    o->stiffness = scene_number(r, &block, "stiffness", o->stiffness, scene_not_negative);
    o->layer_factor = scene_number(r, &block, "layer_factor", o->layer_factor, fraction);
    o->element_factor = scene_number(r, &block, "element_factor", o->element_factor, fraction);
    o->gravity_step = scene_number(r, &block, "gravity_step", o->gravity_step, scene_not_negative);
    o->script_step = scene_number(r, &block, "script_step", o->script_step, scene_not_negative);
    o->restitution = scene_number(r, &block, "restitution", o->restitution, unit);
    o->clocks = (cipc_clocks)scene_choice(r, &block, "clocks", "kind of clocks", clocks, (int)o->clocks);
    o->event_limit = scene_integer(r, &block, "events", (int)o->event_limit, 1, EVENTS_MAX);
}
