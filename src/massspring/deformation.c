/* The bound on the deformation of springs (SPEC B.2; docs/theory/massspring_springs.md (11)-(13)). */
#include "massspring/deformation.h"

#include "base/vector.h"

static double length_of(const int ends[2], const double *x, double along[3])
{
    v3_sub(along, x + 3 * (size_t)ends[1], x + 3 * (size_t)ends[0]);
    return v3_norm(along);
}

double massspring_deformation_of(const cipc_spring *spring, const int ends[2], const double *x)
{
    double along[3];
    return fabs(length_of(ends, x, along) - spring->length) / spring->length;
}

double cipc_deformation_greatest(const cipc_spring *springs, const int (*ends)[2], int count, const double *x)
{
    double greatest = 0;
    for (int i = 0; i < count; i++) greatest = max2(greatest, massspring_deformation_of(&springs[i], ends[i], x));
    return greatest;
}

/* The nearest length within the bound. */
static double allowed_length(double d, double r, double bound) { return min2(max2(r, d * (1 - bound)), d * (1 + bound)); }

static void move(const massspring_ends_moved *m, int node, double by, const double along[3])
{
    if (!(m->inverse_mass[node] > 0)) return; /* not even by a zero, which may have a sign */
    v3_axpy(m->x + 3 * (size_t)node, by, along);
    if (m->rate > 0) v3_axpy(m->v + 3 * (size_t)node, by * m->rate, along);
}

bool massspring_project_spring(const massspring_ends_moved *m, const cipc_spring *s, const int ends[2], double bound)
{
    double along[3];
    const double r = length_of(ends, m->x, along), w0 = m->inverse_mass[ends[0]], w1 = m->inverse_mass[ends[1]];
    const double excess = r - allowed_length(s->length, r, bound);
    if (excess == 0) return false;
    if (!(r > 0) || !(w0 + w1 > 0)) return true;
    const double part = excess / (r * (w0 + w1)); /* `along` is not of unit length */
    move(m, ends[0], part * w0, along);
    move(m, ends[1], -part * w1, along);
    return true;
}

int cipc_deformation_project(const cipc_spring *springs, const int (*ends)[2], int count, double bound, double tolerance, int sweeps, const double *inverse_mass, double dt, double *x,
                             double *v, double *greatest)
{
    const massspring_ends_moved m = {inverse_mass, dt > 0 ? 1 / dt : 0, x, v};
    int done = 0;
    double most = cipc_deformation_greatest(springs, ends, count, x);
    while (done < sweeps && !(most <= bound * (1 + tolerance))) {
        for (int i = 0; i < count; i++) { /* to and fro: a correction is carried on in both directions */
            const int s = done % 2 == 0 ? i : count - 1 - i;
            massspring_project_spring(&m, &springs[s], ends[s], bound);
        }
        done++;
        most = cipc_deformation_greatest(springs, ends, count, x);
    }
    if (greatest) *greatest = most;
    return done;
}

int cipc_deformation_adjust(cipc_spring *springs, const int (*ends)[2], int count, double bound, const double *x)
{
    int adjusted = 0;
    double along[3];
    for (int i = 0; i < count; i++) {
        const double r = length_of(ends[i], x, along), d = springs[i].length;
        if (allowed_length(d, r, bound) == r || !(r > 0)) continue; /* a spring of no length keeps its own: d = 0 would deform without end */
        springs[i].length = r / (r > d ? 1 + bound : 1 - bound);
        adjusted++;
    }
    return adjusted;
}
