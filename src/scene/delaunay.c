/* Delaunay triangulation by qhull's reentrant library. */
#include "scene/delaunay.h"

#include <libqhull_r/qhull_ra.h>
#include <stdbool.h>
#include <stdio.h>

static const char place[] = "delaunay";

static double twice_area(const double *points, const int t[3])
{
    const double *a = points + 2 * t[0], *b = points + 2 * t[1], *c = points + 2 * t[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* The three points of a facet; false if it is not a triangle of the given points (qhull adds one at infinity). */
static bool corners_of(qhT *qh, facetT *facet, int count, int t[3])
{
    vertexT *vertex, **vertexp;
    int corners = 0;
    FOREACHvertex_(facet->vertices)
    {
        int id = qh_pointid(qh, vertex->point);
        if (corners == 3 || id < 0 || id >= count) return false;
        t[corners++] = id;
    }
    return corners == 3;
}

static void collect(qhT *qh, const double *points, int count, double smallest_area, int (*triangles)[3], int *triangle_count)
{
    facetT *facet;
    *triangle_count = 0;
    FORALLfacets
    {
        int t[3];
        if (facet->upperdelaunay || *triangle_count == 2 * count || !corners_of(qh, facet, count, t)) continue;
        double area = 0.5 * twice_area(points, t);
        if (!(fabs(area) > smallest_area)) continue;
        int *out = triangles[(*triangle_count)++];
        out[0] = t[0];
        out[1] = area > 0 ? t[1] : t[2];
        out[2] = area > 0 ? t[2] : t[1];
    }
}

/* Qt: triangles only; Qbb, Qz: for points on a circle and for large coordinates; Pp: no remarks on precision. */
cipc_status scene_delaunay(double *points, int count, double smallest_area, int (*triangles)[3], int *triangle_count, cipc_error *error)
{
    static const char command[] = "qhull d Qt Qbb Qz Pp";
    qhT data, *qh = &data;
    char flags[sizeof command];
    *triangle_count = 0;
    FILE *silence = fopen("/dev/null", "w"); /* qhull reports its errors to a file, and to stderr if there is none */
    if (silence == NULL) return cipc_fail(error, CIPC_E_IO, "/dev/null", "cannot be opened");
    snprintf(flags, sizeof flags, "%s", command);
    qh_zero(qh, silence);
    int exit_code = count < 3 ? qh_ERRinput : qh_new_qhull(qh, 2, count, points, False, flags, silence, silence);
    if (exit_code == qh_ERRnone) collect(qh, points, count, smallest_area, triangles, triangle_count);
    int long_memory, total;
    qh_freeqhull(qh, !qh_ALL);
    qh_memfreeshort(qh, &long_memory, &total);
    fclose(silence);
    if (exit_code == qh_ERRmem) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory to triangulate %d points", count);
    return exit_code == qh_ERRnone ? CIPC_OK : cipc_fail(error, CIPC_E_BAD_MESH, place, "%d points that have no triangulation", count);
}
