/* A named material or fabric, times its factors, unless a number is given. */
#include "scene/shell_material.h"

#include <math.h>

#include "scene/materials.h"
#include "scene/orthotropic.h"

static const char *const models[] = {"none", "neo-hookean", "stvk", "orthotropic", "springs", NULL}; /* in the order of cipc_membrane_model */
static const char *const constants[] = {"plate", "cipc", NULL};                           /* in the order of cipc_hinge_constant */
static const double activation_default = 1;         /* shat: every stretched triangle (SPEC C.2) */
static const double strain_stiffness_default = 1e3; /* kappa_s, Pa (SPEC C.2) */
static const scene_range poisson_range = {-1, 0.5, true, false};
static const double springs_poisson = 1.0 / 3; /* of a lattice of springs, whatever their stiffness (SPEC A.8) */

/* What the scene names, and what that stands for; SCENE_REQUIRED_NUMBER where it says nothing. */
typedef struct base {
    const char *name; /* NULL: nothing is named */
    const scene_fabric *fabric;
    double density, thickness, young, poisson, bending_young, bending_poisson, strain_limit;
} base;

static base base_of_material(const scene_material *m)
{
    return (base){m->name, NULL, m->density, m->thickness, m->young, m->poisson, m->young, m->poisson, m->strain_limit};
}

/* Bending takes the shear modulus and no transverse contraction, as the release does (SPEC C.3). */
static base base_of_fabric(const scene_fabric *f)
{
    return (base){f->name, f, f->density, f->thickness, NAN, NAN, f->moduli[3], 0, NAN};
}

static base read_base(scene_reader *r, const scene_cursor *body)
{
    int count;
    const scene_material *table = scene_materials(&count);
    base found = {NULL, NULL, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    scene_cursor membrane = scene_member(body, "membrane");
    const scene_fabric *fabric = scene_is_orthotropic(&membrane) ? scene_read_fabric(r, &membrane) : NULL;
    if (fabric != NULL) found = base_of_fabric(fabric);
    if (json_object_get(body->value, "material") == NULL) return found;
    scene_cursor member = scene_member(body, "material");
    if (fabric != NULL) scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "cannot stand beside membrane.fabric: a shell is made of one of them");
    int chosen = scene_choice(r, body, "material", "material", scene_material_names(), SCENE_REQUIRED);
    return r->status == CIPC_OK ? base_of_material(&table[chosen]) : found;
}

static void read_isotropic(scene_reader *r, const scene_cursor *membrane, const base *named, double factor, bool absent, cipc_material *m)
{
    static const char *const keys[] = {"model", "young", "poisson", NULL};
    m->membrane = (cipc_membrane_model)scene_choice(r, membrane, "model", "membrane model", models,
                                                    absent ? CIPC_MEMBRANE_NONE : CIPC_MEMBRANE_NEO_HOOKEAN);
    if (!scene_is_object(r, membrane, keys)) return;
    bool none = m->membrane == CIPC_MEMBRANE_NONE, nothing = none && named->name == NULL;
    m->membrane_young =
        scene_number(r, membrane, "young", nothing ? 0 : factor * named->young, none ? scene_not_negative : scene_positive);
    const bool springs = m->membrane == CIPC_MEMBRANE_SPRINGS;
    m->membrane_poisson = scene_number(r, membrane, "poisson", nothing ? 0 : springs ? springs_poisson : named->poisson, poisson_range);
    scene_cursor poisson = scene_member(membrane, "poisson");
    if (springs && m->membrane_poisson != springs_poisson)
        scene_reject(r, &poisson, CIPC_E_OUT_OF_RANGE, "is %g, but springs make it 1/3: leave it out", m->membrane_poisson);
}

static void read_membrane(scene_reader *r, const scene_cursor *body, const base *named, bool optional, cipc_material *m)
{
    static const char *const keys[] = {"model", "young", "poisson", "fabric", "factor", "moduli", "limits", "warp", "weft", NULL};
    double factor = scene_read_factor(r, body, "membrane_factor", "membrane", named->name);
    scene_cursor membrane = scene_member(body, "membrane"), member = scene_member(body, "membrane_factor");
    bool absent = membrane.value == NULL && named->name == NULL;
    if (absent && !optional)
        scene_reject(r, &membrane, CIPC_E_MISSING_KEY, "required where no material is named: {\"young\": ..., \"poisson\": ...}");
    membrane = scene_object_member(r, body, "membrane");
    if (!scene_is_object(r, &membrane, keys)) return;
    if (!scene_is_orthotropic(&membrane)) {
        read_isotropic(r, &membrane, named, factor, absent, m);
        return;
    }
    if (member.value != NULL)
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "multiplies Young's modulus, which an orthotropic membrane has not; use membrane.factor");
    m->membrane = CIPC_MEMBRANE_ORTHOTROPIC;
    scene_read_orthotropic(r, &membrane, named->fabric, &m->orthotropic);
}

static void read_bending(scene_reader *r, const scene_cursor *body, const base *named, const scene_material_defaults *defaults,
                         cipc_material *m)
{
    static const char *const keys[] = {"young", "poisson", "constant", NULL};
    double factor = scene_read_factor(r, body, "bending_factor", "bending", named->name);
    scene_cursor bending = scene_member(body, "bending");
    bool absent = bending.value == NULL && named->name == NULL;
    if (absent && !defaults->optional)
        scene_reject(r, &bending, CIPC_E_MISSING_KEY, "required where no material is named: {\"young\": ..., \"poisson\": ...}");
    bending = scene_object_member(r, body, "bending");
    if (!scene_is_object(r, &bending, keys)) return;
    m->bending_young = scene_number(r, &bending, "young", absent ? 0 : factor * named->bending_young, scene_not_negative);
    bool needless = named->name == NULL && !(m->bending_young > 0);
    m->bending_poisson = scene_number(r, &bending, "poisson", needless ? 0 : named->bending_poisson, poisson_range);
    m->hinge_constant = (cipc_hinge_constant)scene_choice(r, &bending, "constant", "hinge constant", constants,
                                                          defaults->released ? CIPC_HINGE_CIPC : CIPC_HINGE_PLATE);
}

/* The limit of compression; 0: none. Without it an activation would be ignored. */
static void read_lower_limit(scene_reader *r, const scene_cursor *limit, cipc_material *m)
{
    m->strain_lower_limit = scene_number(r, limit, "lower", 0, (scene_range){0, 1, false, true});
    scene_cursor activation = scene_member(limit, "lower_activation");
    if (m->strain_lower_limit > 0)
        m->strain_lower_activation =
            scene_number(r, limit, "lower_activation", activation_default, (scene_range){m->strain_lower_limit, 1, true, false});
    else if (activation.value != NULL)
        scene_reject(r, &activation, CIPC_E_MISSING_KEY, "is where the limit 'lower' begins to act, but there is no 'lower'");
}

/* The object's own numbers. Where only a lower limit is given, extension is free. */
static void read_limits(scene_reader *r, const scene_cursor *limit, const base *named, cipc_material *m)
{
    static const char *const keys[] = {"limit", "activation", "stiffness", "lower", "lower_activation", NULL};
    if (!scene_is_object(r, limit, keys)) return;
    read_lower_limit(r, limit, m);
    bool given = json_object_get(limit->value, "limit") != NULL || !isnan(named->strain_limit);
    scene_cursor activation = scene_member(limit, "activation");
    if (given || !(m->strain_lower_limit > 0)) {
        m->strain_limit = scene_number(r, limit, "limit", named->strain_limit, (scene_range){1, INFINITY, true, true});
        m->strain_activation = scene_number(r, limit, "activation", activation_default, (scene_range){1, m->strain_limit, false, true});
    } else if (activation.value != NULL) {
        scene_reject(r, &activation, CIPC_E_MISSING_KEY, "is where 'limit' begins to act, but there is no 'limit'");
    }
    m->strain_stiffness = scene_number(r, limit, "stiffness", strain_stiffness_default, scene_positive);
}

/* false: none; "material": the named material's; an object: its own numbers. */
static void read_strain_limit(scene_reader *r, const scene_cursor *body, const base *named, cipc_material *m)
{
    scene_cursor limit = scene_member(body, "strain_limit");
    if (limit.value == NULL) scene_set(r, body, "strain_limit", json_false());
    if (limit.value == NULL || json_is_false(limit.value)) return;
    if (json_is_string(limit.value)) {
        static const char *const names[] = {"material", NULL};
        scene_choice(r, body, "strain_limit", "strain limit", names, 0);
        if (isnan(named->strain_limit))
            scene_reject(r, &limit, CIPC_E_MISSING_KEY, "takes the limit of a named material, but there is no 'material'");
        scene_set(r, body, "strain_limit", json_object());
        limit = scene_member(body, "strain_limit");
    } else if (!json_is_object(limit.value)) {
        scene_reject(r, &limit, CIPC_E_WRONG_TYPE, "must be an object, \"material\" or false");
    }
    read_limits(r, &limit, named, m);
}

/* What has been turned into numbers leaves the tree, so that reading the resolved scene multiplies nothing twice. */
static void forget_name(const scene_cursor *body)
{
    json_object_del(body->value, "material");
    json_object_del(body->value, "membrane_factor");
    json_object_del(body->value, "bending_factor");
}

void scene_read_shell_material(scene_reader *r, const scene_cursor *body, const scene_material_defaults *defaults, cipc_material *m)
{
    const base named = read_base(r, body);
    bool fallback = named.name == NULL && defaults->optional;
    scene_read_density(r, body, "thickness", fallback ? defaults->density : named.density,
                       fallback ? defaults->thickness : named.thickness, m);
    read_membrane(r, body, &named, defaults->optional, m);
    read_bending(r, body, &named, defaults, m);
    read_strain_limit(r, body, &named, m);
    if (r->status == CIPC_OK) forget_name(body);
}
