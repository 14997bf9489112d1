/* The closed form of projected contact Hessians: equal to the plain projection of the exact Hessian, for every kind, near and far, thin and thick. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/contact_hessian.h"
#include "implicit/psd_projection.h"
#include "support/exact_geometry.h"

enum { N = 12 };

static double largest(int n, const double *A)
{
    double most = 0;
    for (int i = 0; i < n * n; i++) most = fmax(most, fabs(A[i]));
    return most;
}
int main(void)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int id = CIPC_ENERGY_BARRIER_POINT_POINT; id <= CIPC_ENERGY_BARRIER_EDGE_EDGE; id++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)id);
        for (int branch = 0; branch < energy->branch_count; branch++) {
            double worst = 0, worst2 = 0, worst3=0; int used = 0, refused = 0;
            for (int trial = 0; trial < 3000; trial++) {
                double x[N], H[N * N], P[N * N];
                cipc_contact_barrier p;
                energy->sample(rng, branch, x, &p);
                if (!isfinite(energy->value(x, &p))) continue;
                if (!cipc_contact_hessian_projected((cipc_energy_id)id, x, &p, P)) { refused++; continue; }
                used++;
                int n = 3 * energy->nodes;
                energy->hessian(x, &p, H);
                double s0 = largest(n, H);
                cipc_psd_project_plain(n, H);
                double e = 0;
                for (int i = 0; i < n * n; i++) e = fmax(e, fabs(H[i] - P[i]));
                if (s0 == 0) continue;
                double sine=1,size=stencil_size(x,n), d=sqrt(cipc_distance2_value((cipc_pair_kind)(id-CIPC_ENERGY_BARRIER_POINT_POINT),x));
 if(id>=CIPC_ENERGY_BARRIER_POINT_TRIANGLE){double a[3],b[3],c[3]; int t=id==CIPC_ENERGY_BARRIER_POINT_TRIANGLE; v3_sub(a,x+(t?6:3),x+(t?3:0)); v3_sub(b,x+9,x+(t?3:6)); v3_cross(c,a,b); sine=v3_norm(c)/v3_norm(a)/v3_norm(b);}
 if (e==e) {worst = fmax(worst, e / s0/UNIT_ROUNDOFF*sine/(1+size/d)); worst2 = fmax(worst2, e / s0/UNIT_ROUNDOFF*sine*sine/(1+size/d)); worst3=fmax(worst3,e / s0/UNIT_ROUNDOFF*sine*sine/(1+size/d*sine));}
            }
            printf("%s %s: used %d refused %d worst %.3g %.3g %.3g\n", energy->name, energy->branch_names[branch], used, refused, worst, worst2, worst3);
        }
    }
}
