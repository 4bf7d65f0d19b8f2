/* SPDX-License-Identifier: MIT
 *
 * tissot: distortion at a point, from the derivatives there. Tissot's indicatrix is the ellipse that the
 * map makes of an infinitesimal circle of the sphere; its semi-axes a >= b are the singular values of the
 * derivative from the tangent plane to the map (Tissot 1881; Snyder 1987, pp. 20-26).
 *
 * With A, B, C the products of the gradients of u and v (A = grad u . grad u, B = grad u . grad v,
 * C = grad v . grad v), a^2 and b^2 are the eigenvalues of [A B; B C]. Their sum is A + C, the root of their
 * product s = |grad u x grad v|, and their difference e = hypot(A - C, 2 B), so that
 *     a + b = sqrt(A + C + 2 s),  a - b = e / (a + b),  b = s / a:
 * no difference of nearly equal numbers but those in A - C, which is as small as it is where a map is
 * nearly isotropic. Of the angles a half and a quarter are computed, as arc tangents of -1 to 1: with
 * tan(w / 4) = (a - b) / (a + b + 2 sqrt(s)) the maximum angular deformation
 * w = 2 asin((a - b) / (a + b)) is accurate for all a and b, where the arc sine loses half the digits as
 * a / b grows.
 */
#ifndef CM_DESCRIPTORS

CM_STRUCT(cm_indicatrix)
{
    CM_REAL major;       /* a: per radian */
    CM_REAL minor;       /* b */
    CM_REAL orientation; /* of the major axis: from +u towards +v, radians */
    CM_REAL scale;       /* s = a b */
    CM_REAL deformation; /* w, radians */
    CM_REAL area;        /* D_A = s / (6 / pi) */
    CM_REAL isotropy;    /* D_I = a / b */
    CM_REAL
    texel_aspect; /* of the lengths on the sphere of du and dv (Dimitrijevic et al. 2016, eq. 3.4) */
    CM_REAL texel_area; /* their product over du dv */
}
CM_STRUCT_END(cm_indicatrix)

/* atan t for 0 <= t <= 1, or -1 <= t <= 0 */
CM_FN CM_REAL CM_NAME(cm_atan_unit)(CM_REAL t)
{
    return cm_mad(t, CM_NAME(cm_atan_excess)(t * t), t);
}

/* Half of the angle whose cosine and sine are as x and y: of the major axis, if x = A - C, y = 2 B. In
 * (-pi/2, pi/2]; 0 for 0, 0. radius = hypot(x, y). */
CM_FN CM_REAL CM_NAME(cm_half_angle)(CM_REAL x, CM_REAL y, CM_REAL radius)
{
    CM_REAL below = radius + cm_abs(x);
    CM_BOOL none = cm_equal(below, CM_LIT(0.0));
    CM_REAL t = CM_SELECT(none, CM_LIT(0.0), y / CM_SELECT(none, CM_LIT(1.0), below));
    CM_REAL angle = CM_NAME(cm_atan_unit)(t);
    CM_REAL quarter =
        CM_SELECT(cm_less(y, CM_LIT(0.0)), CM_LIT(-1.5707963267948966), CM_LIT(1.5707963267948966));
    return CM_SELECT(cm_less(x, CM_LIT(0.0)), quarter - angle, angle);
}

/* From A, B, C, s and 1 / s. */
CM_FN CM_NAME(cm_indicatrix) CM_NAME(cm_make_indicatrix)(CM_REAL uu, CM_REAL uv, CM_REAL vv,
                                                         CM_REAL scale, CM_REAL inverse_scale)
{
    CM_REAL across = CM_LIT(2.0) * uv;
    CM_REAL apart = uu - vv;
    CM_REAL squares_apart = cm_sqrt(cm_mad(apart, apart, across * across));
    CM_REAL sum = cm_sqrt(uu + vv + CM_LIT(2.0) * scale);
    CM_REAL difference = squares_apart / sum;
    CM_REAL turn = difference / (sum + CM_LIT(2.0) * cm_sqrt(scale));
    CM_NAME(cm_indicatrix) r;
    r.major = CM_LIT(0.5) * (sum + difference);
    r.minor = cm_min(scale / r.major, r.major); /* not above it by rounding */
    r.scale = scale;
    r.area = scale * CM_LIT(0.52359877559829887);
    r.isotropy = r.major * r.major * inverse_scale;
    r.isotropy = CM_SELECT(cm_less(r.isotropy, CM_LIT(1.0)), CM_LIT(1.0), r.isotropy);
    r.deformation = CM_LIT(4.0) * CM_NAME(cm_atan_unit)(turn);
    r.orientation = CM_NAME(cm_half_angle)(apart, across, squares_apart);
    /* the columns of the inverse of the derivative are as long as the other row, over s */
    r.texel_aspect = cm_sqrt(vv / uu);
    r.texel_area = cm_sqrt(uu * vv) * (inverse_scale * inverse_scale);
    return r;
}

/* From the gradients of u and v by the unit direction, which are orthogonal to it. */
CM_FN CM_NAME(cm_indicatrix) CM_NAME(cm_indicatrix_of_gradients)(CM_NAME(cm_gradients) g)
{
    CM_REAL x = g.a_y * g.b_z - g.a_z * g.b_y;
    CM_REAL y = g.a_z * g.b_x - g.a_x * g.b_z;
    CM_REAL z = g.a_x * g.b_y - g.a_y * g.b_x;
    CM_REAL scale = cm_sqrt(x * x + y * y + z * z);
    return CM_NAME(cm_make_indicatrix)(g.a_x * g.a_x + g.a_y * g.a_y + g.a_z * g.a_z,
                                       g.a_x * g.b_x + g.a_y * g.b_y + g.a_z * g.b_z,
                                       g.b_x * g.b_x + g.b_y * g.b_y + g.b_z * g.b_z, scale,
                                       CM_LIT(1.0) / scale);
}

/* From the derivatives of the unit direction by u and v: their products are the inverse matrix. */
CM_FN CM_NAME(cm_indicatrix) CM_NAME(cm_indicatrix_of_tangents)(CM_NAME(cm_tangents) t)
{
    CM_REAL x = t.y_a * t.z_b - t.z_a * t.y_b;
    CM_REAL y = t.z_a * t.x_b - t.x_a * t.z_b;
    CM_REAL z = t.x_a * t.y_b - t.y_a * t.x_b;
    CM_REAL inverse_scale = cm_sqrt(x * x + y * y + z * z);
    CM_REAL scale = CM_LIT(1.0) / inverse_scale;
    CM_REAL square = scale * scale;
    return CM_NAME(cm_make_indicatrix)((t.x_b * t.x_b + t.y_b * t.y_b + t.z_b * t.z_b) * square,
                                       -((t.x_a * t.x_b + t.y_a * t.y_b + t.z_a * t.z_b) * square),
                                       (t.x_a * t.x_a + t.y_a * t.y_a + t.z_a * t.z_a) * square,
                                       scale, inverse_scale);
}

#endif
