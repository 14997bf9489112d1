/* Does a closed edge meet a closed triangle? Exact, by orientation signs only. SPEC V.5 M1; docs/theory/distance.md section 9. */
#include "cipc/geometry.h"

/* Do the closed intervals [a0, a1] and [b0, b1], ends in any order, meet? */
static bool intervals_meet(double a0, double a1, double b0, double b1)
{
    double a_low = a0 < a1 ? a0 : a1, a_high = a0 < a1 ? a1 : a0;
    double b_low = b0 < b1 ? b0 : b1, b_high = b0 < b1 ? b1 : b0;
    return a_low <= b_high && b_low <= a_high;
}

/* Do the boxes of two segments meet, leaving out coordinate `axis` (-1: none)? */
static bool boxes_meet(const double *a0, const double *a1, const double *b0, const double *b1, int axis)
{
    for (int k = 0; k < 3; k++)
        if (k != axis && !intervals_meet(a0[k], a1[k], b0[k], b1[k])) return false;
    return true;
}

/* Point p, known to be collinear with the segment in the projection that drops `axis`: is it on the segment there? */
static bool on_segment(const double *p, const double *e0, const double *e1, int axis)
{
    return boxes_meet(p, p, e0, e1, axis);
}

/* Segments in the plane that drops `axis`; either may be a point. */
static bool segments_meet_in_plane(const double *a0, const double *a1, const double *b0, const double *b1, int axis)
{
    int b0_side = cipc_orient2d(a0, a1, b0, axis), b1_side = cipc_orient2d(a0, a1, b1, axis);
    int a0_side = cipc_orient2d(b0, b1, a0, axis), a1_side = cipc_orient2d(b0, b1, a1, axis);
    if (b0_side * b1_side < 0 && a0_side * a1_side < 0) return true;
    if (b0_side == 0 && on_segment(b0, a0, a1, axis)) return true;
    if (b1_side == 0 && on_segment(b1, a0, a1, axis)) return true;
    if (a0_side == 0 && on_segment(a0, b0, b1, axis)) return true;
    return a1_side == 0 && on_segment(a1, b0, b1, axis);
}

/* A coordinate to drop so that the triangle keeps its area, or -1 if the three points are collinear. */
static int axis_with_area(const double *a, const double *b, const double *c)
{
    for (int axis = 0; axis < 3; axis++)
        if (cipc_orient2d(a, b, c, axis) != 0) return axis;
    return -1;
}

/* Segments in space; either may be a point. They meet only if they are coplanar, and then the projection along an axis in which some
 * three of the four points keep their area maps their common plane one to one. */
static bool segments_meet(const double *a0, const double *a1, const double *b0, const double *b1)
{
    if (!boxes_meet(a0, a1, b0, b1, -1)) return false;
    if (cipc_orient3d(a0, a1, b0, b1) != 0) return false;
    int axis = axis_with_area(a0, a1, b0);
    if (axis < 0) axis = axis_with_area(a0, a1, b1);
    if (axis < 0) axis = axis_with_area(b0, b1, a0);
    if (axis < 0) axis = axis_with_area(b0, b1, a1);
    if (axis < 0) return true; /* all on one line, where boxes that meet are segments that meet */
    return segments_meet_in_plane(a0, a1, b0, b1, axis);
}

/* Are three signs free of contradiction, that is, not both positive and negative? */
static bool same_side(int s0, int s1, int s2)
{
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

static bool point_in_triangle_in_plane(const double *p, const double *t0, const double *t1, const double *t2, int axis)
{
    return same_side(cipc_orient2d(t0, t1, p, axis), cipc_orient2d(t1, t2, p, axis), cipc_orient2d(t2, t0, p, axis));
}

/* Edge in the plane of a triangle that keeps its area when `axis` is dropped. */
static bool coplanar_meet(const double *e0, const double *e1, const double *t0, const double *t1, const double *t2, int axis)
{
    return point_in_triangle_in_plane(e0, t0, t1, t2, axis) || segments_meet_in_plane(e0, e1, t0, t1, axis) ||
           segments_meet_in_plane(e0, e1, t1, t2, axis) || segments_meet_in_plane(e0, e1, t2, t0, axis);
}

bool cipc_edge_triangle_intersect(const double edge[6], const double triangle[9])
{
    const double *e0 = edge, *e1 = edge + 3, *t0 = triangle, *t1 = triangle + 3, *t2 = triangle + 6;
    int e0_side = cipc_orient3d(t0, t1, t2, e0), e1_side = cipc_orient3d(t0, t1, t2, e1);
    if (e0_side * e1_side > 0) return false;
    if (e0_side != 0 || e1_side != 0) /* one point of the edge is in the plane; its barycentric coordinates have these signs */
        return same_side(cipc_orient3d(e0, e1, t0, t1), cipc_orient3d(e0, e1, t1, t2), cipc_orient3d(e0, e1, t2, t0));
    int axis = axis_with_area(t0, t1, t2);
    if (axis >= 0) return coplanar_meet(e0, e1, t0, t1, t2, axis);
    return segments_meet(e0, e1, t0, t1) || segments_meet(e0, e1, t1, t2) || segments_meet(e0, e1, t2, t0);
}
