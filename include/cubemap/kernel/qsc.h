/* SPDX-License-Identifier: MIT
 *
 * qsc: the quadrilateralized spherical cube, equal-area, with creases on the diagonals of a face.
 * The same mapping as Snyder's (1992) equal-area cube and as Rosca & Plonka's (2011).
 *
 * The printed formulas lose half the digits at the centre and all of them on the axes (acos of a
 * number near 1). Here the sector |p| >= |q| is written with t = q / p and r = sqrt(2 + t^2), and the
 * other by swapping. The angle a in v = u (12 / pi) a, which the papers give as
 * t = sin a / (cos a - 1/sqrt 2), is by half angles
 *     tan(a / 2) = t (sqrt 2 - 1) / (r + sqrt 2),
 * and from the diagonal, b = pi/12 - a, with k = cot(pi/12) = 2 + sqrt 3,
 *     tan(b / 2) = (1 - t) / (k + t + r sqrt(2 k)).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(qsc,
        .aliases = "snyder rosca-plonka",
        .name = "quadrilateralized spherical cube",
        .source = "O'Neill & Laubscher 1976; Lambers 2020, eq. 1 (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_C0,
        .smooth_edge = CM_SMOOTH_C0,
        .bounds = {.round_trip = 4, .plane_round_trip = 6, .forward = 5, .inverse = 4,
                   .relative = 9})
/* clang-format on */
#else

#define CM_QSC_SQRT2 CM_LIT(1.4142135623730950488016887242096980786)
#define CM_QSC_K CM_LIT(3.7320508075688772935274463415058723669)       /* 2 + sqrt 3 */
#define CM_QSC_SQRT_2K CM_LIT(2.7320508075688772935274463415058723669) /* sqrt(2 k) = 1 + sqrt 3 */

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
    CM_REAL divisor = CM_SELECT(major > CM_LIT(0.0), major, CM_LIT(1.0));
    CM_REAL t = minor / divisor;
    CM_REAL t2 = t * t;
    CM_REAL r = cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL w = cm_sqrt((CM_LIT(1.0) + major * major) + minor * minor);
    /* u = p sqrt(r (r + 1) / (w (w + 1))), where r^2 - w^2 = (1 - p^2)(1 + t^2) */
    CM_REAL rest = ((CM_LIT(1.0) - major) * (CM_LIT(1.0) + major)) * (CM_LIT(1.0) + t2) *
                   (CM_LIT(1.0) + CM_LIT(1.0) / (r + w));
    CM_REAL u = CM_NAME(cm_scale_by_root)(major, w * (w + CM_LIT(1.0)), rest);
    CM_BOOL inner = t <= CM_LIT(0.5);
    CM_REAL above = CM_SELECT(inner, minor * (CM_QSC_SQRT2 - CM_LIT(1.0)), major - minor);
    CM_REAL below =
        CM_SELECT(inner, r + CM_QSC_SQRT2, (CM_QSC_K + t) + r * CM_QSC_SQRT_2K) * divisor;
    CM_REAL part = u * (CM_NAME(cm_atan_unit)(above / below) *
                        CM_LIT(7.6394372684109761169064206418806893777)); /* 24 / pi */
    CM_REAL v = CM_SELECT(inner, part, u - part);
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
    CM_REAL angle = CM_LIT(0.26179938779914943653855361527329190702) * /* pi / 12 */
                    (part / CM_SELECT(major > CM_LIT(0.0), major, CM_LIT(1.0)));
    CM_REAL sine = CM_NAME(cm_sin_quarter)(angle);
    CM_REAL versine = CM_NAME(cm_versine_quarter)(angle);
    /* t = sin a / (cos a - 1/sqrt 2); and 1 - t from the diagonal, as cos(pi/12) - 1/sqrt 2 is
     * sin(pi/12) */
    CM_REAL above = CM_SELECT(inner, sine,
                              (CM_QSC_K + CM_LIT(1.0)) * sine - (CM_QSC_K - CM_LIT(1.0)) * versine);
    CM_REAL below = CM_SELECT(inner, CM_LIT(0.29289321881345247559915563789515096072) - versine,
                              (CM_LIT(1.0) + sine) - CM_QSC_K * versine);
    CM_REAL ratio = above / below;
    CM_REAL t = CM_SELECT(inner, ratio, CM_LIT(1.0) - ratio);
    CM_REAL t2 = t * t;
    CM_REAL r1 = CM_LIT(1.0) + cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL inverse_r1 = CM_LIT(1.0) / r1;
    CM_REAL e = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major) * (CM_LIT(1.0) + t2) * inverse_r1;
    /* p = u g / (1 + e) with g = sqrt(1 + e / r1), as u minus what is missing */
    CM_REAL g1 = r1 * (CM_LIT(1.0) + cm_sqrt(CM_LIT(1.0) + e * inverse_r1));
    CM_REAL p = major - major * (e * (g1 - CM_LIT(1.0)) / (g1 * (CM_LIT(1.0) + e)));
    CM_REAL q = CM_SELECT(inner, p * ratio, p - p * ratio);
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, p, q), u),
                               cm_copysign(CM_SELECT(wide, q, p), v));
}

#endif
