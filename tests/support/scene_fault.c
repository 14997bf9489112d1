#include "support/scene_fault.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Where coefficients stand ------------------------------------------------------------------------------------------------ */

/* The coefficient owner[key], a number or an array of numbers, and whose it is. */
typedef void visitor(void *context, const char *kind, const char *whose, json_t *owner, const char *key);

static void visit_friction(json_t *root, visitor *visit, void *context)
{
    size_t i;
    json_t *entry;
    json_array_foreach(json_object_get(root, "friction"), i, entry)
    {
        json_t *between = json_object_get(entry, "between");
        char pair[SCENE_FAULT_NAME];
        snprintf(pair, sizeof pair, "%.30s and %.30s", json_string_value(json_array_get(between, 0)), json_string_value(json_array_get(between, 1)));
        visit(context, "friction", pair, entry, "mu");
    }
    json_array_foreach(json_object_get(root, "bodies"), i, entry)
    {
        visit(context, "friction", json_string_value(json_object_get(entry, "name")), entry, "friction");
    }
}

static void visit_moduli(json_t *root, visitor *visit, void *context)
{
    static const char *const places[][3] = {
        {"membrane", "membrane", "young"},           {"membrane", "membrane", "moduli"}, {"bending", "bending", "young"},
        {"strain limit", "strain_limit", "stiffness"}, {"young", NULL, "young"}, {"damping", "damping", "stiffness"},
    };
    size_t i;
    json_t *body;
    json_array_foreach(json_object_get(root, "bodies"), i, body)
    {
        for (size_t k = 0; !json_is_true(json_object_get(body, "fixed")) && k < sizeof places / sizeof places[0]; k++) {
            json_t *owner = places[k][1] != NULL ? json_object_get(body, places[k][1]) : body;
            visit(context, places[k][0], json_string_value(json_object_get(body, "name")), owner, places[k][2]);
        }
    }
}

static void visit_loads(json_t *root, visitor *visit, void *context)
{
    size_t i;
    json_t *load;
    json_array_foreach(json_object_get(root, "loads"), i, load)
    {
        visit(context, "load", json_string_value(json_object_get(load, "body")), load, "force");
    }
}

/* What the method asynchronous has of its own. */
static void visit_asynchronous(json_t *root, visitor *visit, void *context)
{
    static const char *const keys[] = {"thickness", "stiffness", "restitution"};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
        visit(context, keys[k], NULL, json_object_get(root, "asynchronous"), keys[k]);
    }
    visit_loads(root, visit, context);
}

/* And what mass-spring has. */
static void visit_massspring(json_t *root, visitor *visit, void *context)
{
    static const char *const places[][3] = {
        {"bending springs", "bending", "stiffness"}, {"bound", "deformation", "bound"}, {"wind", "wind", "pressure"}, {"wind velocity", "wind", "velocity"},
        {"presliding", "friction", "presliding"}, {"breakaway", "friction", "breakaway"}, {"damping ratio", "friction", "damping_ratio"}, {"band", "friction", "band"},
        {"repulsion", NULL, "repulsion"}, {"self distance", "self", "distance"}, {"self friction", "self", "friction"},
    };
    size_t i;
    json_t *collider, *settings = json_object_get(root, "mass_spring");
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        visit(context, places[k][0], NULL, places[k][1] != NULL ? json_object_get(settings, places[k][1]) : settings, places[k][2]);
    }
    json_array_foreach(json_object_get(root, "colliders"), i, collider)
    {
        visit(context, "friction", json_string_value(json_object_get(collider, "name")), collider, "friction");
    }
}

/* What contact is made of, and what else only the method has. */
static void visit_method(json_t *root, visitor *visit, void *context)
{
    const char *method = json_string_value(json_object_get(root, "method"));
    if (method != NULL && strcmp(method, "asynchronous") == 0) {
        visit_asynchronous(root, visit, context);
    } else if (method != NULL && strcmp(method, "mass-spring") == 0) {
        visit_massspring(root, visit, context);
    } else {
        visit(context, "dhat", NULL, json_object_get(root, "contact"), "dhat");
    }
}

static void visit_all(json_t *root, visitor *visit, void *context)
{
    size_t i;
    json_t *stitch;
    visit(context, "gravity", NULL, root, "gravity");
    visit_method(root, visit, context);
    visit_friction(root, visit, context);
    visit_moduli(root, visit, context);
    json_array_foreach(json_object_get(root, "stitches"), i, stitch)
    {
        visit(context, "stitches", NULL, stitch, "stiffness");
    }
}

/* Of several numbers the first that is not 0; 0: there is none. */
static double value_of(const json_t *coefficient)
{
    double value = json_number_value(coefficient);
    for (size_t i = 0; value == 0 && i < json_array_size(coefficient); i++) {
        value = json_number_value(json_array_get(coefficient, i));
    }
    return value;
}

/* ---- The list ---------------------------------------------------------------------------------------------------------------- */

typedef struct list {
    scene_fault *faults;
    int count;
} list;

static void add(void *context, const char *kind, const char *whose, json_t *owner, const char *key)
{
    list *l = context;
    const double value = value_of(json_object_get(owner, key));
    bool known = value == 0;
    for (int i = 0; i < l->count && i < SCENE_FAULTS; i++) {
        known = known || (strcmp(l->faults[i].kind, kind) == 0 && l->faults[i].value == value);
    }
    if (!known && l->count < SCENE_FAULTS) {
        scene_fault *fault = &l->faults[l->count];
        snprintf(fault->name, sizeof fault->name, "%s%s%s", kind, whose != NULL ? " of " : "", whose != NULL ? whose : "");
        fault->kind = kind;
        fault->value = value;
    }
    l->count += !known;
}

int scene_faults(const char *resolved, scene_fault faults[SCENE_FAULTS])
{
    list l = {faults, 0};
    json_t *root = json_loads(resolved, 0, NULL);
    if (root == NULL) {
        return -1;
    }
    visit_all(root, add, &l);
    json_decref(root);
    return l.count <= SCENE_FAULTS ? l.count : -1;
}

/* ---- Planting one ------------------------------------------------------------------------------------------------------------ */

typedef struct planting {
    const scene_fault *fault;
    double factor;
} planting;

/* Restitution cannot be above 1: there the fault is the other way. */
static double faulty(const planting *p, double value)
{
    const double wrong = p->factor * value;
    return strcmp(p->fault->kind, "restitution") == 0 && wrong > 1 ? value / p->factor : wrong;
}

static void plant(void *context, const char *kind, const char *whose, json_t *owner, const char *key)
{
    (void)whose;
    const planting *p = context;
    json_t *coefficient = json_object_get(owner, key);
    if (strcmp(kind, p->fault->kind) != 0 || value_of(coefficient) != p->fault->value) {
        return;
    }
    if (json_is_array(coefficient)) {
        for (size_t i = 0; i < json_array_size(coefficient); i++) {
            json_array_set_new(coefficient, i, json_real(faulty(p, json_number_value(json_array_get(coefficient, i)))));
        }
    } else {
        json_object_set_new(owner, key, json_real(faulty(p, p->fault->value)));
    }
}

bool scene_fault_write(const char *resolved, const scene_fault *fault, double factor, char path[SCENE_FAULT_PATH])
{
    planting p = {fault, factor};
    json_t *root = json_loads(resolved, 0, NULL);
    snprintf(path, SCENE_FAULT_PATH, "/tmp/cipc-fault-XXXXXX");
    const int file = mkstemp(path);
    bool good = root != NULL && file >= 0;
    if (good) {
        visit_all(root, plant, &p);
        good = json_dumpfd(root, file, JSON_REAL_PRECISION(17)) == 0;
    }
    if (file >= 0) {
        close(file);
    }
    json_decref(root);
    return good;
}
