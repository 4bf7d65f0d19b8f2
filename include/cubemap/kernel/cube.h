/* SPDX-License-Identifier: MIT
 *
 * cube: between directions and the gnomonic coordinates of the cube's faces, in the frame geo; other
 * frames follow by renumbering and by signs. Not a mapping: what most mappings stand on.
 */
#ifndef CM_DESCRIPTORS

/* A point of a face, and which. face is a whole number, 0.0 to 5.0, so that it is as wide as the
 * coordinates. */
CM_STRUCT(cm_face_point)
{
    CM_REAL face;
    CM_REAL a; /* p or u */
    CM_REAL b; /* q or v */
}
CM_STRUCT_END(cm_face_point)

CM_STRUCT(cm_xyz)
{
    CM_REAL x;
    CM_REAL y;
    CM_REAL z;
}
CM_STRUCT_END(cm_xyz)

/* The largest of |x|, |y|, |z|. */
CM_FN CM_REAL CM_NAME(cm_magnitude)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL yz = cm_max(cm_abs(y), cm_abs(z));
    return cm_max(cm_abs(x), yz);
}

/* Ties: the first of x, y, z with the largest magnitude wins. x, y, z finite and not all zero. */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_cube_project)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL ax = cm_abs(x);
    CM_REAL ay = cm_abs(y);
    CM_REAL az = cm_abs(z);
    CM_BOOL x_wins = cm_at_least(ax, cm_max(ay, az));
    CM_BOOL polar = cm_less(cm_max(ax, ay), az);
    CM_REAL sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_wins, x, CM_SELECT(polar, z, y)));
    CM_REAL turned = -(sign * x);
    CM_REAL major = CM_NAME(cm_magnitude)(x, y, z);
    CM_NAME(cm_face_point) r;
    r.face = CM_SELECT(polar, cm_mad(sign, CM_LIT(-0.5), CM_LIT(4.5)),
                       CM_SELECT(x_wins, CM_LIT(1.0), CM_LIT(2.0)) - sign);
    r.a = CM_SELECT(polar, y, CM_SELECT(x_wins, sign * y, turned)) / major;
    r.b = CM_SELECT(polar, turned, z) / major;
    return r;
}

/* The unit direction of gnomonic (p, q) on a face. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_cube_unproject)(CM_REAL face, CM_REAL p, CM_REAL q)
{
    CM_REAL major = CM_NAME(cm_inverse_root)(CM_LIT(1.0) + (p * p + q * q));
    CM_REAL a = p * major;
    CM_REAL b = q * major;
    /* faces 0 1 2 3 are +x +y -x -y, 4 5 are +z -z; the product changes its sign with that of the axis */
    CM_BOOL polar = cm_less(CM_LIT(3.5), face);
    CM_BOOL along_x = cm_equal(cm_abs(face - CM_LIT(1.0)), CM_LIT(1.0));
    CM_BOOL along_y = cm_equal(cm_abs(face - CM_LIT(2.0)), CM_LIT(1.0));
    CM_REAL sign = cm_copysign(CM_LIT(1.0),
                               (CM_LIT(1.5) - face) * (CM_LIT(3.5) - face) * (CM_LIT(4.5) - face));
    CM_REAL outward = sign * major;
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(along_x, outward, -(sign * CM_SELECT(polar, b, a)));
    r.y = CM_SELECT(along_y, outward, a * CM_SELECT(polar, CM_LIT(1.0), sign));
    r.z = CM_SELECT(polar, outward, b);
    return r;
}

#endif
