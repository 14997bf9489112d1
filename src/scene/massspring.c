/* The block "mass_spring". Defaults are the integrator's own. */
#include "scene/massspring.h"

#include <limits.h>

static const scene_range below_one = {0, 1, false, true}, at_least_one = {1, INFINITY, false, true};

/* Names in the order of their enumerations. */
static const char *const too_long[] = {"divide", "refuse", NULL};
static const char *const structural_forms[] = {"linear", "tension", NULL};
static const char *const bending_forms[] = {"linear", "buckling", NULL};
static const char *const readings[] = {"project", "rest-length", NULL};
static const char *const bisections[] = {"plain", "improved", NULL};

static void read_bending(scene_reader *r, const scene_cursor *block, cipc_massspring_options *o)
{
    static const char *const keys[] = {"form", "stiffness", "buckling", NULL};
    scene_cursor bending = scene_object_member(r, block, "bending");
    if (!scene_is_object(r, &bending, keys)) return;
    o->bending_form = scene_choice(r, &bending, "form", "form of springs", bending_forms, 0) == 1 ? CIPC_SPRING_BUCKLING : CIPC_SPRING_LINEAR;
    o->bending_stiffness = scene_number(r, &bending, "stiffness", o->bending_stiffness, scene_not_negative);
    o->buckling = scene_number(r, &bending, "buckling", o->buckling, scene_not_negative);
}

static void read_deformation(scene_reader *r, const scene_cursor *block, cipc_massspring_options *o)
{
    static const char *const keys[] = {"bound", "reading", "sweeps", NULL};
    scene_cursor deformation = scene_object_member(r, block, "deformation");
    if (!scene_is_object(r, &deformation, keys)) return;
    o->deformation = scene_number(r, &deformation, "bound", o->deformation, below_one);
    o->reading = (cipc_deformation_reading)scene_choice(r, &deformation, "reading", "reading of the bound", readings, (int)o->reading);
    o->sweeps = scene_integer(r, &deformation, "sweeps", o->sweeps, 1, INT_MAX);
}

static void read_wind(scene_reader *r, const scene_cursor *block, cipc_massspring_options *o)
{
    static const char *const keys[] = {"velocity", "pressure", NULL};
    static const double calm[3] = {0, 0, 0};
    scene_cursor wind = scene_object_member(r, block, "wind");
    if (!scene_is_object(r, &wind, keys)) return;
    scene_vector(r, &wind, "velocity", calm, o->wind);
    o->wind_pressure = scene_number(r, &wind, "pressure", o->wind_pressure, scene_not_negative);
}

static void read_friction(scene_reader *r, const scene_cursor *block, cipc_massspring_options *o)
{
    static const char *const keys[] = {"law", "presliding", "breakaway", "damping_ratio", "band", NULL};
    const char *laws[CIPC_LAW_COUNT + 1] = {NULL};
    for (int l = 0; l < CIPC_LAW_COUNT; l++) laws[l] = cipc_friction_law_name((cipc_friction_law)l);
    scene_cursor friction = scene_object_member(r, block, "friction");
    if (!scene_is_object(r, &friction, keys)) return;
    o->law = (cipc_friction_law)scene_choice(r, &friction, "law", "law of friction", laws, (int)o->law);
    o->presliding = scene_number(r, &friction, "presliding", o->presliding, scene_positive);
    o->breakaway = scene_number(r, &friction, "breakaway", o->breakaway, at_least_one);
    o->damping_ratio = scene_number(r, &friction, "damping_ratio", o->damping_ratio, scene_not_negative);
    o->band = scene_number(r, &friction, "band", o->band, scene_positive);
}

static void read_self(scene_reader *r, const scene_cursor *block, cipc_massspring_options *o)
{
    static const char *const keys[] = {"distance", "friction", NULL};
    scene_cursor self = scene_object_member(r, block, "self"), distance;
    if (!scene_is_object(r, &self, keys)) return;
    o->self_distance = scene_number(r, &self, "distance", o->self_distance, scene_not_negative);
    o->self_friction = scene_number(r, &self, "friction", o->self_friction, scene_not_negative);
    if (r->status != CIPC_OK || !(o->self_distance > 0) || o->repulsion > 0) return;
    distance = scene_member(&self, "distance");
    scene_reject(r, &distance, CIPC_E_OUT_OF_RANGE, "cloth is kept apart from itself by repulsion, and there is none");
    cipc_fail_remedy(&r->error, "give mass_spring.repulsion, N/m, greater than 0");
}

void scene_read_massspring(scene_reader *r, const scene_cursor *root, double time_step, cipc_massspring_options *o)
{
    static const char *const keys[] = {"step", "too_long", "structural", "bending", "deformation", "wind", "bisection", "threshold", "repulsion", "friction", "self", NULL};
    *o = cipc_massspring_options_default();
    o->frame = time_step;
    scene_cursor block = scene_object_member(r, root, "mass_spring");
    if (!scene_is_object(r, &block, keys)) return;
    o->step = scene_number(r, &block, "step", o->step, scene_not_negative);
    o->refuse = scene_choice(r, &block, "too_long", "way with a step that is too long", too_long, 0) == 1;
    o->structural = scene_choice(r, &block, "structural", "form of springs", structural_forms, 0) == 1 ? CIPC_SPRING_TENSION : CIPC_SPRING_LINEAR;
    read_bending(r, &block, o);
    read_deformation(r, &block, o);
    read_wind(r, &block, o);
    o->bisection = (cipc_bisection_method)scene_choice(r, &block, "bisection", "bisection", bisections, (int)o->bisection);
    o->threshold = scene_number(r, &block, "threshold", o->threshold, scene_positive);
    o->repulsion = scene_number(r, &block, "repulsion", o->repulsion, scene_not_negative);
    read_friction(r, &block, o);
    read_self(r, &block, o);
}
