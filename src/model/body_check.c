/* Material numbers, indices and sizes at rest of a body: what its elements need to have masses and inverse rest shapes. */
#include "model/body_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "model/measures.h"

/* One number that must be in a range. */
typedef struct number_check {
    const char *name;
    double value;
    bool good;
} number_check;

static cipc_status check_numbers(const number_check *checks, size_t count, const char *body, cipc_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (!checks[i].good || !isfinite(checks[i].value))
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, body, "%s = %g is out of range", checks[i].name, checks[i].value);
    return CIPC_OK;
}

static cipc_status check_common(const cipc_body_description *d, cipc_error *error)
{
    const cipc_material *m = &d->material;
    const number_check checks[] = {
        {"density", m->density, m->density > 0},
        {"thickness", m->thickness, d->kind == CIPC_BODY_VOLUME ? m->thickness >= 0 : m->thickness > 0},
        {"offset", d->offset, d->offset >= 0},
        {"friction", d->friction, d->friction >= 0},
        {"damping.stiffness", m->damping_stiffness, m->damping_stiffness >= 0},
        {"damping.mass", m->damping_mass, m->damping_mass >= 0},
        {"bending.young", m->bending_young, m->bending_young >= 0},
    };
    return check_numbers(checks, sizeof checks / sizeof *checks, d->name, error);
}

static cipc_status check_shell(const cipc_body_description *d, cipc_error *error)
{
    const cipc_material *m = &d->material;
    bool isotropic = m->membrane == CIPC_MEMBRANE_NEO_HOOKEAN || m->membrane == CIPC_MEMBRANE_STVK || m->membrane == CIPC_MEMBRANE_SPRINGS;
    const number_check checks[] = {
        {"membrane.young", m->membrane_young, !isotropic || m->membrane_young > 0},
        {"membrane.poisson", m->membrane_poisson, !isotropic || (m->membrane_poisson > -1 && m->membrane_poisson < 1)},
        {"bending.poisson", m->bending_poisson, m->bending_poisson > -1 && m->bending_poisson < 1},
        {"strain_limit.limit", m->strain_limit, m->strain_limit == 0 || m->strain_limit > 1},
        {"strain_limit.activation", m->strain_activation,
         m->strain_limit == 0 || (m->strain_activation >= 1 && m->strain_activation < m->strain_limit)},
        {"strain_limit.stiffness", m->strain_stiffness, (m->strain_limit == 0 && m->strain_lower_limit == 0) || m->strain_stiffness > 0},
        {"strain_limit.lower", m->strain_lower_limit, m->strain_lower_limit >= 0 && m->strain_lower_limit < 1},
        {"strain_limit.lower_activation", m->strain_lower_activation,
         m->strain_lower_limit == 0 || (m->strain_lower_activation > m->strain_lower_limit && m->strain_lower_activation <= 1)},
    };
    return check_numbers(checks, sizeof checks / sizeof *checks, d->name, error);
}

/* The moduli must make a convex energy at rest: a11 a22 > a12^2. */
static cipc_status check_orthotropic(const cipc_body_description *d, cipc_error *error)
{
    const cipc_orthotropic_material *m = &d->material.orthotropic;
    const number_check checks[] = {
        {"membrane.moduli[0]", m->moduli[0], m->moduli[0] > 0},
        {"membrane.moduli[1]", m->moduli[1], m->moduli[1] * m->moduli[1] < m->moduli[0] * m->moduli[2]},
        {"membrane.moduli[2]", m->moduli[2], m->moduli[2] > 0},
        {"membrane.moduli[3]", m->moduli[3], m->moduli[3] > 0},
        {"membrane.limits[0]", m->limits[0], m->limits[0] > 0},
        {"membrane.limits[1]", m->limits[1], m->limits[1] > 0},
        {"membrane.limits[2]", m->limits[2], m->limits[2] > 0},
    };
    if (d->material.membrane != CIPC_MEMBRANE_ORTHOTROPIC) return CIPC_OK;
    if (!cipc_numbers_finite(m->warp, 3) || !cipc_numbers_finite(m->weft, 3))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, d->name, "the direction of warp or weft is not finite");
    return check_numbers(checks, sizeof checks / sizeof *checks, d->name, error);
}

/* Directions this near to the normal of a triangle (sine of the angle to it) have no direction in its plane that doubles could tell. */
static const double least_sine = 1e-9;

static bool lies_across(const double direction[3], const double normal[3])
{
    double r[3];
    v3_cross(r, direction, normal);
    return v3_norm(r) <= least_sine * v3_norm(direction) * v3_norm(normal);
}

/* Warp and weft are carried into the plane of each rest triangle, and must have one there. After the triangles have been checked. */
static cipc_status check_yarns(const cipc_body_description *d, cipc_error *error)
{
    const cipc_orthotropic_material *m = &d->material.orthotropic;
    bool weft = v3_norm2(m->weft) > 0;
    if (d->kind != CIPC_BODY_SHELL || d->material.membrane != CIPC_MEMBRANE_ORTHOTROPIC) return CIPC_OK;
    for (int t = 0; t < d->triangle_count; t++) {
        const int *v = d->triangles[t];
        double e1[3], e2[3], n[3];
        v3_sub(e1, d->rest + 3 * v[1], d->rest + 3 * v[0]);
        v3_sub(e2, d->rest + 3 * v[2], d->rest + 3 * v[0]);
        v3_cross(n, e1, e2);
        if (lies_across(m->warp, n) || (weft && lies_across(m->weft, n)))
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, d->name, "membrane.%s is at right angles to triangle %d (%d %d %d), where it has no direction",
                             lies_across(m->warp, n) ? "warp" : "weft", t, v[0], v[1], v[2]);
    }
    return CIPC_OK;
}

static cipc_status check_solid(const cipc_body_description *d, cipc_error *error)
{
    const cipc_material *m = &d->material;
    bool volume = d->kind == CIPC_BODY_VOLUME;
    const number_check checks[] = {
        {"young", m->young, volume && !d->fixed ? m->young > 0 : m->young >= 0},
        {"poisson", m->poisson, !volume || (m->poisson > -1 && m->poisson < 0.5)},
    };
    return check_numbers(checks, sizeof checks / sizeof *checks, d->name, error);
}

static cipc_status check_material(const cipc_body_description *d, cipc_error *error)
{
    cipc_status status = check_common(d, error);
    if (status) return status;
    if (d->kind != CIPC_BODY_SHELL) return d->kind == CIPC_BODY_PARTICLES ? CIPC_OK : check_solid(d, error);
    status = check_shell(d, error);
    return status ? status : check_orthotropic(d, error);
}

bool cipc_numbers_finite(const double *values, int count)
{
    for (int i = 0; values && i < count; i++)
        if (!isfinite(values[i])) return false;
    return true;
}

static const char *const element_names[] = {"segment", "triangle", "tetrahedron"};

/* Length, area or volume at rest of an element of 2, 3 or 4 nodes. */
static double size_at_rest(const double *rest, const int *v, int nodes)
{
    const double *a = rest + 3 * v[0], *b = rest + 3 * v[1];
    if (nodes == 2) return cipc_segment_length(a, b);
    if (nodes == 3) return cipc_triangle_area(a, b, rest + 3 * v[2]);
    return cipc_tetrahedron_volume(a, b, rest + 3 * v[2], rest + 3 * v[3]);
}

static cipc_status check_element(const cipc_body_description *d, int element, const int *v, int nodes, bool *used, cipc_error *error)
{
    const char *name = element_names[nodes - 2];
    for (int k = 0; k < nodes; k++)
        if (v[k] < 0 || v[k] >= d->node_count)
            return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "%s %d has node index %d, but the mesh has %d nodes", name, element, v[k], d->node_count);
    for (int k = 0; k < nodes; k++) {
        used[v[k]] = true;
        for (int l = 0; l < k; l++)
            if (v[k] == v[l]) return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "%s %d repeats a node (%d)", name, element, v[k]);
    }
    double size = size_at_rest(d->rest, v, nodes);
    if (size > 0) return CIPC_OK;
    if (nodes == 3) return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "triangle %d (%d %d %d) has no area", element, v[0], v[1], v[2]);
    if (nodes == 2) return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "segment %d (%d %d) has no length", element, v[0], v[1]);
    return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "tetrahedron %d (%d %d %d %d) has volume %g; its fourth node must lie where the first three are seen anticlockwise",
                     element, v[0], v[1], v[2], v[3], size);
}

/* Every element, and that every node is part of one (particles: nodes alone). */
static cipc_status check_elements(const cipc_body_description *d, int count, const int *elements, int nodes, cipc_error *error)
{
    bool *used = cipc_alloc((size_t)d->node_count, sizeof *used);
    if (!used) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, d->name, "no memory for %d nodes", d->node_count);
    cipc_status status = CIPC_OK;
    for (int i = 0; i < count && !status; i++) status = check_element(d, i, elements + (size_t)nodes * (size_t)i, nodes, used, error);
    for (int i = 0; i < d->node_count && !status; i++)
        if (!used[i]) status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "node %d belongs to no %s", i, element_names[nodes - 2]);
    cipc_free(used);
    return status;
}

static int compare_pairs(const void *a, const void *b)
{
    const int *p = a, *q = b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

/* A segment given twice would count twice in every energy and contact. */
static cipc_status check_segments_differ(const cipc_body_description *d, cipc_error *error)
{
    int(*sorted)[2] = cipc_alloc((size_t)d->segment_count, sizeof *sorted);
    if (!sorted) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, d->name, "no memory for %d segments", d->segment_count);
    for (int i = 0; i < d->segment_count; i++) {
        const int *v = d->segments[i];
        sorted[i][0] = v[0] < v[1] ? v[0] : v[1];
        sorted[i][1] = v[0] < v[1] ? v[1] : v[0];
    }
    qsort(sorted, (size_t)d->segment_count, sizeof *sorted, compare_pairs);
    cipc_status status = CIPC_OK;
    for (int i = 1; i < d->segment_count && !status; i++)
        if (compare_pairs(sorted[i - 1], sorted[i]) == 0)
            status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "the segment of nodes %d and %d is given twice", sorted[i][0], sorted[i][1]);
    cipc_free(sorted);
    return status;
}

static cipc_status check_mesh(const cipc_body_description *d, cipc_error *error)
{
    const int count[] = {d->triangle_count, d->segment_count, 0, d->tetrahedron_count}, size[] = {3, 2, 1, 4};
    const int *const elements[] = {(const int *)d->triangles, (const int *)d->segments, NULL, (const int *)d->tetrahedra};
    bool particles = d->kind == CIPC_BODY_PARTICLES;
    if (d->node_count < 1 || (!particles && count[d->kind] < 1))
        return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "the mesh has %d nodes and %d %s", d->node_count, count[d->kind],
                         particles ? "elements" : d->kind == CIPC_BODY_SHELL ? "triangles" : d->kind == CIPC_BODY_RODS ? "segments" : "tetrahedra");
    if (!cipc_numbers_finite(d->rest, 3 * d->node_count) || !cipc_numbers_finite(d->position, 3 * d->node_count) || !cipc_numbers_finite(d->velocity, 3 * d->node_count))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, d->name, "a node's position or velocity is not finite");
    if (particles) return CIPC_OK;
    cipc_status status = check_elements(d, count[d->kind], elements[d->kind], size[d->kind], error);
    return status || d->kind != CIPC_BODY_RODS ? status : check_segments_differ(d, error);
}

cipc_status cipc_body_check(const cipc_body_description *d, cipc_error *error)
{
    cipc_status status = check_material(d, error);
    if (!status) status = check_mesh(d, error);
    return status ? status : check_yarns(d, error);
}
