/* A named material, times its factors, unless a number is given. */
#include "scene/shell_material.h"

#include <math.h>

#include "scene/materials.h"

static const char *const models[] = {"none", "neo-hookean", "stvk", NULL}; /* in the order of cipc_membrane_model */
static const char *const constants[] = {"plate", "cipc", NULL};            /* in the order of cipc_hinge_constant */
static const double activation_default = 1;                                /* shat: every stretched triangle (SPEC C.2) */
static const double strain_stiffness_default = 1e3;                        /* kappa_s, Pa (SPEC C.2) */
static const scene_range poisson_range = {-1, 0.5, true, false};
static const scene_range factor_range = {0, 1e12, false, false}; /* keeps the product finite */

/* The named material; NULL if none is named. */
static const scene_material *read_name(scene_reader *r, const scene_cursor *body)
{
    int count;
    const scene_material *table = scene_materials(&count);
    if (json_object_get(body->value, "material") == NULL) return NULL;
    int chosen = scene_choice(r, body, "material", "material", scene_material_names(), SCENE_REQUIRED);
    return r->status == CIPC_OK ? &table[chosen] : NULL;
}

/* A factor multiplies a named material's modulus: without one, or beside a modulus given as a number, it would be ignored. */
static double read_factor(scene_reader *r, const scene_cursor *body, const char *key, const char *part, const scene_material *named)
{
    scene_cursor factor = scene_member(body, key);
    if (factor.value == NULL) return 1;
    if (named == NULL)
        scene_reject(r, &factor, CIPC_E_MISSING_KEY, "multiplies the modulus of a named material, but there is no 'material'");
    if (json_object_get(json_object_get(body->value, part), "young") != NULL) {
        scene_reject(r, &factor, CIPC_E_OUT_OF_RANGE, "cannot stand beside %s.young, which says the modulus itself", part);
    }
    return scene_number_at(r, &factor, factor_range);
}

static void read_membrane(scene_reader *r, const scene_cursor *body, const scene_material *named, bool optional, cipc_material *m)
{
    static const char *const keys[] = {"model", "young", "poisson", NULL};
    double factor = read_factor(r, body, "membrane_factor", "membrane", named);
    scene_cursor membrane = scene_member(body, "membrane");
    bool absent = membrane.value == NULL && named == NULL;
    if (absent && !optional)
        scene_reject(r, &membrane, CIPC_E_MISSING_KEY, "required where no material is named: {\"young\": ..., \"poisson\": ...}");
    membrane = scene_object_member(r, body, "membrane");
    if (!scene_is_object(r, &membrane, keys)) return;
    m->membrane = (cipc_membrane_model)scene_choice(r, &membrane, "model", "membrane model", models,
                                                    absent ? CIPC_MEMBRANE_NONE : CIPC_MEMBRANE_NEO_HOOKEAN);
    double none = m->membrane == CIPC_MEMBRANE_NONE ? 0 : SCENE_REQUIRED_NUMBER;
    double young = named != NULL ? factor * named->young : none, poisson = named != NULL ? named->poisson : none;
    m->membrane_young = scene_number(r, &membrane, "young", young, m->membrane == CIPC_MEMBRANE_NONE ? scene_not_negative : scene_positive);
    m->membrane_poisson = scene_number(r, &membrane, "poisson", poisson, poisson_range);
}

static void read_bending(scene_reader *r, const scene_cursor *body, const scene_material *named, const scene_material_defaults *defaults,
                         cipc_material *m)
{
    static const char *const keys[] = {"young", "poisson", "constant", NULL};
    double factor = read_factor(r, body, "bending_factor", "bending", named);
    scene_cursor bending = scene_member(body, "bending");
    bool absent = bending.value == NULL && named == NULL;
    if (absent && !defaults->optional)
        scene_reject(r, &bending, CIPC_E_MISSING_KEY, "required where no material is named: {\"young\": ..., \"poisson\": ...}");
    bending = scene_object_member(r, body, "bending");
    if (!scene_is_object(r, &bending, keys)) return;
    double young = named != NULL ? factor * named->young : absent ? 0 : SCENE_REQUIRED_NUMBER;
    m->bending_young = scene_number(r, &bending, "young", young, scene_not_negative);
    double poisson = named != NULL ? named->poisson : m->bending_young > 0 ? SCENE_REQUIRED_NUMBER : 0;
    m->bending_poisson = scene_number(r, &bending, "poisson", poisson, poisson_range);
    m->hinge_constant = (cipc_hinge_constant)scene_choice(r, &bending, "constant", "hinge constant", constants,
                                                          defaults->released ? CIPC_HINGE_CIPC : CIPC_HINGE_PLATE);
}

/* false: none; "material": the named material's; an object: its own numbers. */
static void read_strain_limit(scene_reader *r, const scene_cursor *body, const scene_material *named, cipc_material *m)
{
    static const char *const keys[] = {"limit", "activation", "stiffness", NULL};
    scene_cursor limit = scene_member(body, "strain_limit");
    if (limit.value == NULL) scene_set(r, body, "strain_limit", json_false());
    if (limit.value == NULL || json_is_false(limit.value)) return;
    if (json_is_string(limit.value)) {
        static const char *const names[] = {"material", NULL};
        scene_choice(r, body, "strain_limit", "strain limit", names, 0);
        if (named == NULL) scene_reject(r, &limit, CIPC_E_MISSING_KEY, "takes the limit of a named material, but there is no 'material'");
        scene_set(r, body, "strain_limit", json_object());
        limit = scene_member(body, "strain_limit");
    } else if (!json_is_object(limit.value)) {
        scene_reject(r, &limit, CIPC_E_WRONG_TYPE, "must be an object, \"material\" or false");
    }
    if (!scene_is_object(r, &limit, keys)) return;
    m->strain_limit = scene_number(r, &limit, "limit", named != NULL ? named->strain_limit : SCENE_REQUIRED_NUMBER,
                                   (scene_range){1, INFINITY, true, true});
    m->strain_activation = scene_number(r, &limit, "activation", activation_default, (scene_range){1, m->strain_limit, false, true});
    m->strain_stiffness = scene_number(r, &limit, "stiffness", strain_stiffness_default, scene_positive);
}

/* What has been turned into numbers leaves the tree, so that reading the resolved scene multiplies nothing twice. */
static void forget_name(const scene_cursor *body)
{
    json_object_del(body->value, "material");
    json_object_del(body->value, "membrane_factor");
    json_object_del(body->value, "bending_factor");
}

void scene_read_material(scene_reader *r, const scene_cursor *body, const scene_material_defaults *defaults, cipc_material *m)
{
    *m = (cipc_material){0};
    const scene_material *named = read_name(r, body);
    double density = defaults->optional ? defaults->density : SCENE_REQUIRED_NUMBER;
    double thickness = defaults->optional ? defaults->thickness : SCENE_REQUIRED_NUMBER;
    m->density = scene_number(r, body, "density", named != NULL ? named->density : density, scene_positive);
    m->thickness = scene_number(r, body, "thickness", named != NULL ? named->thickness : thickness, scene_positive);
    read_membrane(r, body, named, defaults->optional, m);
    read_bending(r, body, named, defaults, m);
    read_strain_limit(r, body, named, m);
    if (r->status == CIPC_OK) forget_name(body);
}
