/* SPDX-License-Identifier: MIT
 *
 * s2: the quadratic projection of the S2 geometry library, p = u (2 + |u|) / 3, and u =
 * 3 p / (1 + sqrt(1 + 3 |p|)); here each is w plus a correction that vanishes at the edge, so that
 * the edge is exact and the rounding of the correction counts less.
 *
 * Below it stand the library's own formulas, rounding by rounding. Only cells whose numbers are to be its own need
 * them (cell_grid.h).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(s2,
        .identifier = "s2",
        .aliases = "s2-quadratic",
        .name = "S2's quadratic projection",
        .source = "S2 geometry library, s2coords.h, S2_QUADRATIC_PROJECTION",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_C1,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_s2_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

CM_FN CM_REAL CM_NAME(cm_s2_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL a = cm_abs(w);
    CM_REAL root = CM_NAME(cm_root)(cm_mad(CM_LIT(3.0), a, CM_LIT(1.0)));
    return CM_NAME(cm_stretch)(w, (CM_LIT(1.0) - a) / ((CM_LIT(1.0) + a) + root));
}

CM_FN CM_REAL CM_NAME(cm_s2_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_stretch)(w, (cm_abs(w) - CM_LIT(1.0)) / CM_LIT(3.0));
}

CM_UNIVARIATE(cm_s2_forward, cm_s2_sigmoid, cm_s2_inverse, cm_s2_sigmoid_inverse)

/* of the inverse it is 2 (1 + |f|) / 3 */
CM_FN CM_REAL CM_NAME(cm_s2_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(w);
    CM_UNUSED(k);
    return CM_LIT(1.5) / (CM_LIT(1.0) + cm_abs(f));
}

CM_UNIVARIATE_JACOBIAN(cm_s2_jacobian, cm_s2_slope)

/* ---- As the S2 library rounds, s2coords.h: nothing here is to be fused ---- */

/* UVtoST: from p to (u + 1) / 2. */
CM_FN CM_REAL CM_NAME(cm_s2_library_part)(CM_REAL p)
{
    CM_REAL root = CM_LIT(0.5) * cm_sqrt(CM_LIT(1.0) + CM_LIT(3.0) * cm_abs(p));
    return CM_SELECT(cm_less(p, CM_LIT(0.0)), CM_LIT(1.0) - root, root);
}

/* STtoUV: from (u + 1) / 2 to p. */
CM_FN CM_REAL CM_NAME(cm_s2_library_slant)(CM_REAL part)
{
    CM_BOOL low = cm_less(part, CM_LIT(0.5));
    CM_REAL w = CM_SELECT(low, CM_LIT(1.0) - part, part);
    CM_REAL slant = CM_LIT(0.333333333333333333333) * (CM_LIT(4.0) * w * w - CM_LIT(1.0));
    return CM_SELECT(low, -slant, slant);
}

/* XYZtoFaceUV, with the library's numbers of faces; then UVtoST. Ties: the last of x, y, z with the largest
 * magnitude wins. x, y, z finite and not all zero. */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_s2_library_project)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL ax = cm_abs(x);
    CM_REAL ay = cm_abs(y);
    CM_BOOL z_wins = cm_at_least(cm_abs(z), cm_max(ax, ay));
    CM_BOOL x_loses = cm_at_least(ay, ax);
    CM_REAL major = CM_SELECT(z_wins, z, CM_SELECT(x_loses, y, x));
    CM_REAL axis = CM_SELECT(z_wins, CM_LIT(2.0), CM_SELECT(x_loses, CM_LIT(1.0), CM_LIT(0.0)));
    CM_BOOL behind = cm_less(major, CM_LIT(0.0));
    CM_REAL a = CM_SELECT(z_wins, -x, CM_SELECT(x_loses, -x, y)) / major;
    CM_REAL b = CM_SELECT(z_wins, -y, z) / major;
    CM_NAME(cm_face_point) r;
    r.face = axis + CM_SELECT(behind, CM_LIT(3.0), CM_LIT(0.0));
    r.a = CM_NAME(cm_s2_library_part)(CM_SELECT(behind, b, a));
    r.b = CM_NAME(cm_s2_library_part)(CM_SELECT(behind, a, b));
    return r;
}

/* STtoUV and FaceUVtoXYZ: a direction that is as long as the face is far. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_s2_library_unproject)(CM_REAL face, CM_REAL part_u, CM_REAL part_v)
{
    CM_REAL u = CM_NAME(cm_s2_library_slant)(part_u);
    CM_REAL v = CM_NAME(cm_s2_library_slant)(part_v);
    CM_BOOL behind = cm_less(CM_LIT(2.5), face);
    CM_REAL axis = face - CM_SELECT(behind, CM_LIT(3.0), CM_LIT(0.0));
    CM_REAL outward = CM_SELECT(behind, CM_LIT(-1.0), CM_LIT(1.0));
    CM_REAL a = CM_SELECT(behind, -v, u);
    CM_REAL b = CM_SELECT(behind, -u, v);
    CM_BOOL along_x = cm_less(axis, CM_LIT(0.5));
    CM_BOOL along_z = cm_less(CM_LIT(1.5), axis);
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(along_x, outward, -a);
    r.y = CM_SELECT(along_z, -b, CM_SELECT(along_x, a, outward));
    r.z = CM_SELECT(along_z, outward, b);
    return r;
}

/* Vector3::Normalize. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_s2_library_normalise)(CM_NAME(cm_xyz) d)
{
    CM_REAL scale = CM_LIT(1.0) / cm_sqrt((d.x * d.x + d.y * d.y) + d.z * d.z);
    CM_NAME(cm_xyz) r;
    r.x = d.x * scale;
    r.y = d.y * scale;
    r.z = d.z * scale;
    return r;
}

#endif
