/* One pair's continuous collision detection by the method of the options. */
#include "contact/ccd.h"

#include "contact/additive_ccd.h"
#include "contact/certified_ccd.h"

static cipc_ccd_result additive(const cipc_stencil_path *path, double xi, double t_max, double bound, const cipc_ccd_options *options)
{
    double p[12];
    for (int i = 0; i < 3 * cipc_pair_nodes(path->kind); i++) p[i] = path->to_end ? path->p[i] - path->x[i] : path->p[i];
    return cipc_additive_ccd_until(path->kind, path->x, p, xi, t_max, bound, options);
}

cipc_ccd_result contact_ccd_until(const cipc_stencil_path *path, double xi, double t_max, double bound, const cipc_ccd_options *options)
{
    switch (options->method) {
    case CIPC_CCD_ADDITIVE: return additive(path, xi, t_max, bound, options);
    case CIPC_CCD_CUBIC: return cipc_cubic_ccd(path, xi, t_max, options);
    case CIPC_CCD_MINIMUM_SEPARATION: return cipc_minimum_separation_ccd(path, xi, t_max, options);
    default: return contact_certified_ccd_until(path, xi, t_max, bound, options);
    }
}

cipc_ccd_result cipc_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options)
{
    return contact_ccd_until(path, thickness, t_max, t_max, options);
}
