/* Lagged friction data of a contact (SPEC D.6; docs/theory/contact.md (24), (25)). */
#include "cipc/contact.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static void normalize(double v[3])
{
    double length = v3_norm(v);
    for (int k = 0; k < 3; k++) v[k] /= length;
}

/* Second tangent: first x direction of the contact, both of unit length. */
static void second_tangent(double basis[6], const double direction[3])
{
    v3_cross(basis + 3, basis, direction);
    normalize(basis + 3);
}

/* (25): orthonormal tangents of the contact plane. The first is along an edge where there is one, so that it does not jump with the contact's
 * direction; `closest` is the vector between the closest points. */
static void tangent_basis(cipc_pair_kind kind, const double *y, const double closest[3], double basis[6])
{
    double direction[3], e[3];
    v3_copy(direction, closest);
    if (kind == CIPC_POINT_POINT) {
        /* across the closest vector and the coordinate axis that it is least along */
        int axis = 0;
        for (int k = 1; k < 3; k++)
            if (fabs(closest[k]) < fabs(closest[axis])) axis = k;
        double unit[3] = {0, 0, 0};
        unit[axis] = 1;
        v3_cross(basis, closest, unit);
    } else if (kind == CIPC_POINT_EDGE) {
        v3_sub(basis, y + 6, y + 3);
    } else if (kind == CIPC_POINT_TRIANGLE) {
        v3_sub(basis, y + 6, y + 3);
        v3_sub(e, y + 9, y + 3);
        v3_cross(direction, basis, e);
    } else {
        v3_sub(basis, y + 3, y);
        v3_sub(e, y + 9, y + 6);
        v3_cross(direction, basis, e);
    }
    normalize(basis);
    second_tangent(basis, direction);
}

static cipc_pair_kind kind_of(const cipc_contact *contact)
{
    static const cipc_pair_kind kinds[] = {CIPC_POINT_POINT, CIPC_POINT_EDGE, CIPC_POINT_TRIANGLE, CIPC_EDGE_EDGE};
    return kinds[contact->energy - CIPC_ENERGY_BARRIER_POINT_POINT];
}

bool cipc_friction_from_contact(cipc_friction *friction, const cipc_contact *contact, const double *x, const double *start, double mu, double eps)
{
    if (contact->barrier.mollifier_eps > 0 || !(mu > 0)) return false;
    memset(friction, 0, sizeof *friction);
    double y[12] = {0}, b[3], closest[3] = {0, 0, 0};
    for (int i = 0; i < contact->count; i++) {
        v3_copy(y + 3 * i, x + 3 * contact->nodes[i]);
        v3_copy(friction->start + 3 * i, start + 3 * contact->nodes[i]);
    }
    cipc_pair_kind kind = kind_of(contact);
    const cipc_contact_barrier *barrier = &contact->barrier;
    double d2 = cipc_distance2_value(kind, y), xi = barrier->offset;
    cipc_barrier(d2 - xi * xi, barrier->dhat * (2 * xi + barrier->dhat), b);
    /* (24): lambda = -kappa dB/dd = -kappa w b'(D) 2 d (SPEC C.4) */
    double lambda = -barrier->stiffness * barrier->weight * b[1] * 2 * sqrt(d2);
    if (!(lambda > 0)) return false;
    friction->coefficient = mu * lambda;
    friction->eps = eps;
    cipc_closest_weights(kind, y, friction->weights);
    /* The weights sum to 0: relative to the first node nothing is lost far from the origin. */
    for (int i = 1; i < contact->count; i++) {
        double r[3];
        v3_sub(r, y + 3 * i, y);
        v3_axpy(closest, friction->weights[i], r);
    }
    tangent_basis(kind, y, closest, friction->basis);
    return true;
}
