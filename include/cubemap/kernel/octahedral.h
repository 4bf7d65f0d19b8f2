/* SPDX-License-Identifier: MIT
 *
 * octahedral: the sphere projected from its centre to the octahedron, whose upper half is the middle square,
 * on its corner, and whose lower half is folded out to the four triangles around it. What two faces of the
 * cube's are to the axes, the octants are to those of the directions: u grows with x, v with y.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SPHERE(octahedral,
          .identifier = "octahedral",
          .aliases = "oct",
          .name = "octahedron on one square",
          .source = "Meyer et al. 2010; Cigolle et al. 2014",
          .kind = CM_KIND_LAYOUT,
          .family = CM_FAMILY_HYBRID,
          .smooth_face = CM_SMOOTH_C0,
          .bounds = {.round_trip = 7, .plane_round_trip = 3, .forward = 3, .inverse = 3, .relative = 5})
/* clang-format on */
#else

/* no parameters */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_octahedral_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

/* 1 - |u| - |v|, exact but for one rounding. */
CM_FN CM_REAL CM_NAME(cm_octahedral_height)(CM_REAL u, CM_REAL v)
{
    CM_REAL greater = cm_max(cm_abs(u), cm_abs(v));
    CM_REAL smaller = cm_min(cm_abs(u), cm_abs(v));
    CM_REAL s = CM_LIT(1.0) - greater;
    CM_REAL rest = (CM_LIT(1.0) - s) - greater;
    return (s - smaller) + rest;
}

/* A point of the upper half for one of the lower: both coordinates mirrored at |u| + |v| = 1. */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_octahedral_fold)(CM_BOOL lower, CM_REAL u, CM_REAL v)
{
    return CM_NAME(cm_make_uv)(
        cm_copysign(CM_SELECT(lower, CM_LIT(1.0) - cm_abs(v), cm_abs(u)), u),
        cm_copysign(CM_SELECT(lower, CM_LIT(1.0) - cm_abs(u), cm_abs(v)), v));
}

/* |u| of |x| as part and |y| as other, or |v| the other way round: part / sum, and of the lower half
 * 1 - other / sum. */
CM_FN CM_REAL CM_NAME(cm_octahedral_place)(CM_BOOL lower, CM_REAL part, CM_REAL other,
                                           CM_REAL height, CM_REAL sum)
{
    /* 1 - other / sum is the more accurate where that is not small */
    CM_BOOL mirrored = cm_both(lower, cm_less(other + other, sum));
    CM_REAL q = CM_SELECT(mirrored, other, CM_SELECT(lower, part + height, part)) / sum;
    return cm_min(CM_LIT(1.0), CM_SELECT(mirrored, CM_LIT(1.0) - q, q));
}

/* (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_octahedral_project)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    CM_REAL ax = cm_abs(x * scale);
    CM_REAL ay = cm_abs(y * scale);
    CM_REAL az = cm_abs(z * scale);
    /* the sum as if rounded once: each coordinate has the error of it */
    CM_REAL first = ax + ay;
    CM_REAL y_part = first - ax;
    CM_REAL first_rest = (ax - (first - y_part)) + (ay - y_part);
    CM_REAL whole = first + az;
    CM_REAL z_part = whole - first;
    CM_REAL whole_rest = (first - (whole - z_part)) + (az - z_part);
    CM_REAL sum = whole + (first_rest + whole_rest);
    CM_BOOL lower = cm_less(z, CM_LIT(0.0));
    CM_NAME(cm_face_point) r;
    r.face = CM_LIT(0.0);
    r.a = cm_copysign(CM_NAME(cm_octahedral_place)(lower, ax, ay, az, sum), x);
    r.b = cm_copysign(CM_NAME(cm_octahedral_place)(lower, ay, ax, az, sum), y);
    return r;
}

CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_octahedral_unproject)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_UNUSED(face);
    CM_REAL z = CM_NAME(cm_octahedral_height)(u, v);
    CM_NAME(cm_uv) p = CM_NAME(cm_octahedral_fold)(cm_less(z, CM_LIT(0.0)), u, v);
    CM_REAL scale = CM_NAME(cm_inverse_root)((p.u * p.u + p.v * p.v) + z * z);
    CM_NAME(cm_xyz) r;
    r.x = p.u * scale;
    r.y = p.v * scale;
    r.z = z * scale;
    return r;
}

/* What a fold makes of derivatives of |u| and |v|, of one variable each; signs are those of x and y. */
CM_FN CM_NAME(cm_uv)
    CM_NAME(cm_octahedral_turn)(CM_BOOL lower, CM_REAL sign_x, CM_REAL sign_y, CM_REAL a, CM_REAL b)
{
    return CM_NAME(cm_make_uv)(sign_x * CM_SELECT(lower, -b, a), sign_y * CM_SELECT(lower, -a, b));
}

/* Of |x| / s and |y| / s with s = |x| + |y| + |z|, at unit length. */
CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_octahedral_gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    x = x * scale;
    y = y * scale;
    z = z * scale;
    CM_REAL ax = cm_abs(x);
    CM_REAL ay = cm_abs(y);
    CM_REAL az = cm_abs(z);
    CM_REAL sum = (ax + ay) + az;
    CM_REAL over = cm_sqrt((x * x + y * y) + z * z) / (sum * sum);
    CM_REAL sign_x = cm_copysign(CM_LIT(1.0), x);
    CM_REAL sign_y = cm_copysign(CM_LIT(1.0), y);
    CM_BOOL lower = cm_less(z, CM_LIT(0.0));
    CM_REAL sign_z = CM_SELECT(lower, CM_LIT(-1.0), CM_LIT(1.0));
    CM_REAL ax_over = ax * over;
    CM_REAL ay_over = ay * over;
    CM_NAME(cm_uv) by_x = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_x * ((ay + az) * over), -(sign_x * ay_over));
    CM_NAME(cm_uv) by_y = CM_NAME(cm_octahedral_turn)(lower, sign_x, sign_y, -(sign_y * ax_over),
                                                      sign_y * ((ax + az) * over));
    CM_NAME(cm_uv) by_z = CM_NAME(cm_octahedral_turn)(lower, sign_x, sign_y, -(sign_z * ax_over),
                                                      -(sign_z * ay_over));
    CM_NAME(cm_gradients) g;
    g.a_x = by_x.u;
    g.a_y = by_y.u;
    g.a_z = by_z.u;
    g.b_x = by_x.v;
    g.b_y = by_y.v;
    g.b_z = by_z.v;
    return g;
}

/* A derivative of the point p of the octahedron's face, of length 1 / scale, is turned into one of p / |p|. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_octahedral_tangent)(CM_NAME(cm_xyz) d, CM_REAL scale, CM_NAME(cm_xyz) by)
{
    CM_REAL along = (d.x * by.x + d.y * by.y) + d.z * by.z;
    CM_NAME(cm_xyz) r;
    r.x = (by.x - d.x * along) * scale;
    r.y = (by.y - d.y * along) * scale;
    r.z = (by.z - d.z * along) * scale;
    return r;
}

CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_octahedral_tangents)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL none = CM_LIT(0.0);
    CM_REAL z = CM_NAME(cm_octahedral_height)(u, v);
    CM_BOOL lower = cm_less(z, none);
    CM_NAME(cm_uv) p = CM_NAME(cm_octahedral_fold)(lower, u, v);
    CM_REAL scale = CM_NAME(cm_inverse_root)((p.u * p.u + p.v * p.v) + z * z);
    CM_NAME(cm_xyz) d = CM_NAME(cm_octahedral_unproject)(face, u, v, k);
    CM_REAL sign_u = cm_copysign(CM_LIT(1.0), u);
    CM_REAL sign_v = cm_copysign(CM_LIT(1.0), v);
    CM_REAL turn = -(sign_u * sign_v);
    CM_NAME(cm_xyz) by_u;
    by_u.x = CM_SELECT(lower, none, CM_LIT(1.0));
    by_u.y = CM_SELECT(lower, turn, none);
    by_u.z = -sign_u;
    CM_NAME(cm_xyz) by_v;
    by_v.x = CM_SELECT(lower, turn, none);
    by_v.y = CM_SELECT(lower, none, CM_LIT(1.0));
    by_v.z = -sign_v;
    by_u = CM_NAME(cm_octahedral_tangent)(d, scale, by_u);
    by_v = CM_NAME(cm_octahedral_tangent)(d, scale, by_v);
    CM_NAME(cm_tangents) t;
    t.x_a = by_u.x;
    t.y_a = by_u.y;
    t.z_a = by_u.z;
    t.x_b = by_v.x;
    t.y_b = by_v.y;
    t.z_b = by_v.z;
    return t;
}

#endif
