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

/* The vector with these components along the axes of a face: outward and those of p and q. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_cube_from_axes)(CM_REAL face, CM_REAL outward, CM_REAL a, CM_REAL b)
{
    /* faces 0 1 2 3 are +x +y -x -y, 4 5 are +z -z; the product changes its sign with that of the axis */
    CM_BOOL polar = cm_less(CM_LIT(3.5), face);
    CM_BOOL along_x = cm_equal(cm_abs(face - CM_LIT(1.0)), CM_LIT(1.0));
    CM_BOOL along_y = cm_equal(cm_abs(face - CM_LIT(2.0)), CM_LIT(1.0));
    CM_REAL sign = cm_copysign(CM_LIT(1.0),
                               (CM_LIT(1.5) - face) * (CM_LIT(3.5) - face) * (CM_LIT(4.5) - face));
    CM_REAL along = sign * outward;
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(along_x, along, -(sign * CM_SELECT(polar, b, a)));
    r.y = CM_SELECT(along_y, along, a * CM_SELECT(polar, CM_LIT(1.0), sign));
    r.z = CM_SELECT(polar, along, b);
    return r;
}

/* The component along a face's outward axis of the unit direction of gnomonic (p, q). */
CM_FN CM_REAL CM_NAME(cm_cube_outward)(CM_REAL p, CM_REAL q)
{
    return CM_NAME(cm_inverse_root)(CM_LIT(1.0) + (p * p + q * q));
}

/* The unit direction of gnomonic (p, q) on a face. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_cube_unproject)(CM_REAL face, CM_REAL p, CM_REAL q)
{
    CM_REAL outward = CM_NAME(cm_cube_outward)(p, q);
    return CM_NAME(cm_cube_from_axes)(face, outward, p * outward, q * outward);
}

/* The derivatives of a unit direction by the coordinates a, b of a face (p, q or u, v). */
CM_STRUCT(cm_tangents)
{
    CM_REAL x_a;
    CM_REAL y_a;
    CM_REAL z_a;
    CM_REAL x_b;
    CM_REAL y_b;
    CM_REAL z_b;
}
CM_STRUCT_END(cm_tangents)

/* The derivatives of the coordinates a, b of a face (p, q or u, v) by a direction of unit length; they
 * are orthogonal to it, so that the length of a gradient is the change per radian. */
CM_STRUCT(cm_gradients)
{
    CM_REAL a_x;
    CM_REAL a_y;
    CM_REAL a_z;
    CM_REAL b_x;
    CM_REAL b_y;
    CM_REAL b_z;
}
CM_STRUCT_END(cm_gradients)

/* The derivatives of cm_cube_unproject by (p, q), which stand as a and b. */
CM_FN CM_NAME(cm_tangents) CM_NAME(cm_cube_tangents)(CM_REAL face, CM_REAL p, CM_REAL q)
{
    CM_REAL x = CM_LIT(1.0) + p * p;
    CM_REAL y = CM_LIT(1.0) + q * q;
    CM_REAL square = x + q * q; /* of the length of (1, p, q) */
    CM_REAL cube = CM_LIT(1.0) / (square * cm_sqrt(square));
    CM_REAL cross = -((p * q) * cube);
    CM_NAME(cm_xyz) by_p = CM_NAME(cm_cube_from_axes)(face, -(p * cube), y * cube, cross);
    CM_NAME(cm_xyz) by_q = CM_NAME(cm_cube_from_axes)(face, -(q * cube), cross, x * cube);
    CM_NAME(cm_tangents) r;
    r.x_a = by_p.x;
    r.y_a = by_p.y;
    r.z_a = by_p.z;
    r.x_b = by_q.x;
    r.y_b = by_q.y;
    r.z_b = by_q.z;
    return r;
}

/* The derivatives of p and q, which stand as a and b, on the face that cm_cube_project chooses. They are
 * those at the direction scaled to unit length, however long x, y, z is. */
CM_FN CM_NAME(cm_gradients) CM_NAME(cm_cube_gradients)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_NAME(cm_face_point) at = CM_NAME(cm_cube_project)(x, y, z);
    CM_REAL p = at.a;
    CM_REAL q = at.b;
    CM_REAL length = cm_sqrt((CM_LIT(1.0) + p * p) + q * q); /* of (1, p, q) */
    CM_REAL none = CM_LIT(0.0);
    CM_NAME(cm_xyz) of_p = CM_NAME(cm_cube_from_axes)(at.face, -(p * length), length, none);
    CM_NAME(cm_xyz) of_q = CM_NAME(cm_cube_from_axes)(at.face, -(q * length), none, length);
    CM_NAME(cm_gradients) r;
    r.a_x = of_p.x;
    r.a_y = of_p.y;
    r.a_z = of_p.z;
    r.b_x = of_q.x;
    r.b_y = of_q.y;
    r.b_z = of_q.z;
    return r;
}

#endif
