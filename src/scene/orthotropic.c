/* Orthotropic cloth (SPEC C.3): moduli and limits of a fabric, or given as numbers, and the directions of its yarns. */
#include "scene/orthotropic.h"

#include <string.h>

#include "base/vector.h"
#include "scene/lists.h"
#include "scene/transform.h"

static const scene_range factor_range = {0, 1e12, true, false}; /* keeps the product finite */

bool scene_is_orthotropic(const scene_cursor *membrane)
{
    const char *model = json_string_value(json_object_get(membrane->value, "model"));
    return model != NULL && strcmp(model, "orthotropic") == 0;
}

const scene_fabric *scene_read_fabric(scene_reader *r, const scene_cursor *membrane)
{
    int count;
    const scene_fabric *table = scene_fabrics(&count);
    if (json_object_get(membrane->value, "fabric") == NULL) return NULL;
    int chosen = scene_choice(r, membrane, "fabric", "fabric", scene_fabric_names(), SCENE_REQUIRED);
    return r->status == CIPC_OK ? &table[chosen] : NULL;
}

/* The factor multiplies the fabric's moduli; nothing else could it multiply without being ignored or said twice. */
static double read_factor(scene_reader *r, const scene_cursor *membrane, const scene_fabric *fabric)
{
    scene_cursor factor = scene_member(membrane, "factor");
    if (factor.value == NULL) return 1;
    if (fabric == NULL) scene_reject(r, &factor, CIPC_E_MISSING_KEY, "multiplies the moduli of a fabric, but there is no 'fabric'");
    if (json_object_get(membrane->value, "moduli") != NULL)
        scene_reject(r, &factor, CIPC_E_OUT_OF_RANGE, "cannot stand beside membrane.moduli, which says the moduli themselves");
    return scene_number_at(r, &factor, factor_range);
}

/* Convex at rest: a11, a22, G12 > 0 and a12^2 < a11 a22. */
static void read_moduli(scene_reader *r, const scene_cursor *membrane, double moduli[4])
{
    scene_numbers(r, membrane, "moduli", 4, scene_any, moduli);
    scene_cursor member = scene_member(membrane, "moduli");
    for (size_t k = 0; k < 4; k++) {
        scene_cursor element = scene_element(&member, k);
        if (k != 1) scene_number_at(r, &element, scene_positive);
    }
    if (!(moduli[1] * moduli[1] < moduli[0] * moduli[2]))
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "a12^2 = %g must be less than a11 a22 = %g, or the cloth is unstable at rest",
                     moduli[1] * moduli[1], moduli[0] * moduli[2]);
}

/* The weft is across the warp unless it is given; then the two must span the cloth. */
static void read_directions(scene_reader *r, const scene_cursor *membrane, cipc_orthotropic_material *m)
{
    static const double x_axis[3] = {1, 0, 0};
    double normal[3];
    scene_read_axis(r, membrane, "warp", x_axis, m->warp);
    memset(m->weft, 0, sizeof m->weft);
    scene_cursor weft = scene_member(membrane, "weft");
    if (weft.value == NULL) return;
    scene_read_axis(r, membrane, "weft", x_axis, m->weft);
    v3_cross(normal, m->warp, m->weft);
    if (!(v3_norm(normal) > 0)) scene_reject(r, &weft, CIPC_E_OUT_OF_RANGE, "is along the warp");
}

void scene_read_orthotropic(scene_reader *r, const scene_cursor *membrane, const scene_fabric *fabric, cipc_orthotropic_material *m)
{
    static const char *const keys[] = {"model", "fabric", "factor", "moduli", "limits", "warp", "weft", NULL};
    if (!scene_is_object(r, membrane, keys)) return;
    double factor = read_factor(r, membrane, fabric);
    if (fabric != NULL && json_object_get(membrane->value, "moduli") == NULL) {
        const double *a = fabric->moduli;
        scene_set(r, membrane, "moduli", json_pack("[ffff]", factor * a[0], factor * a[1], factor * a[2], factor * a[3]));
    }
    if (fabric != NULL && json_object_get(membrane->value, "limits") == NULL)
        scene_set(r, membrane, "limits", json_pack("[fff]", fabric->limits[0], fabric->limits[1], fabric->limits[2]));
    read_moduli(r, membrane, m->moduli);
    scene_numbers(r, membrane, "limits", 3, scene_positive, m->limits);
    read_directions(r, membrane, m);
    if (r->status != CIPC_OK) return;
    json_object_del(membrane->value, "fabric");
    json_object_del(membrane->value, "factor");
}
