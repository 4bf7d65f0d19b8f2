/* SPDX-License-Identifier: MIT
 *
 * qsc: the quadrilateralized spherical cube, equal-area, with creases on the diagonals of a face.
 * The same mapping as Snyder's (1992) equal-area cube and as Rosca & Plonka's (2011).
 *
 * The printed formulas lose half the digits at the centre and all of them on the axes (acos of a
 * number near 1). Here the sector |p| >= |q| is written with t = q / p, and the other by swapping.
 */
#ifdef CM_DESCRIPTORS
CM_WARP(qsc,
        .aliases = "snyder rosca-plonka",
        .name = "quadrilateralized spherical cube",
        .source = "O'Neill & Laubscher 1976; Lambers 2020, eq. 1 (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_C0,
        .smooth_edge = CM_SMOOTH_C0)
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_qsc_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_qsc_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = abs_p >= abs_q;
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL t = minor / CM_SELECT(major > CM_LIT(0.0), major, CM_LIT(1.0));
    CM_REAL t2 = t * t;
    CM_REAL r = cm_sqrt((CM_LIT(1.0) + CM_LIT(1.0)) + t2);
    /* in the order of r above, so that w = r and u = 1 exactly on the edge, major = 1 */
    CM_REAL w = cm_sqrt((CM_LIT(1.0) + major * major) + minor * minor);
    CM_REAL u = major * cm_sqrt((r * (r + CM_LIT(1.0))) / (w * (w + CM_LIT(1.0))));
    CM_REAL angle = CM_NAME(cm_atan_unit)(t * (CM_LIT(1.0) + t2) /
                                          ((r + CM_LIT(1.0)) * (r + t2)));
    /* 12 / pi */
    CM_REAL v = cm_min(u * (angle * CM_LIT(3.8197186342054880584532103209403)), u);
    v = CM_SELECT(t >= CM_LIT(1.0), u, v);
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(wide, u, v), p),
                               cm_copysign(CM_SELECT(wide, v, u), q));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_qsc_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_u = cm_abs(u);
    CM_REAL abs_v = cm_abs(v);
    CM_BOOL wide = abs_u >= abs_v;
    CM_REAL major = CM_SELECT(wide, abs_u, abs_v);
    CM_REAL minor = CM_SELECT(wide, abs_v, abs_u);
    /* the angle from the axis, or in the outer half from the diagonal, where t = 1 exactly */
    CM_BOOL inner = minor + minor <= major;
    CM_REAL part = CM_SELECT(inner, minor, major - minor);
    CM_REAL angle = CM_LIT(0.26179938779914943653855361527329) * /* pi / 12 */
                    (part / CM_SELECT(major > CM_LIT(0.0), major, CM_LIT(1.0)));
    CM_REAL sine = CM_NAME(cm_sin_quarter)(angle);
    CM_REAL versine = CM_NAME(cm_versine_quarter)(angle);
    /* t = sin a / (cos a - 1/sqrt 2); and the same at pi / 12 - angle, by
     * cos(pi/12) - 1/sqrt 2 = sin(pi/12), with cot(pi/12) = 2 + sqrt 3 */
    CM_REAL cotangent = CM_LIT(3.7320508075688772935274463415059);
    CM_REAL above = CM_SELECT(inner, sine, (CM_LIT(1.0) - versine) - cotangent * sine);
    CM_REAL below = CM_SELECT(inner, CM_LIT(0.29289321881345247559915563789515) - versine,
                              (CM_LIT(1.0) + sine) - cotangent * versine);
    CM_REAL t = cm_min(above / below, CM_LIT(1.0));
    CM_REAL t2 = t * t;
    CM_REAL r1 = CM_LIT(1.0) + cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL e = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major) * ((CM_LIT(1.0) + t2) / r1);
    CM_REAL p = major * cm_sqrt(CM_LIT(1.0) + e / r1) / (CM_LIT(1.0) + e);
    CM_REAL q = p * t;
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, p, q), u),
                               cm_copysign(CM_SELECT(wide, q, p), v));
}

#endif
