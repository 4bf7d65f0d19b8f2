/* SPDX-License-Identifier: MIT
 *
 * unicube: u = (6 / pi) asin(p / sqrt(2 p^2 + 2)) = (6 / pi) atan(p / h), h = sqrt(2 + p^2).
 *
 * In the outer half the angle is taken from the edge: tan(pi/6 - atan(p/h)) =
 * 2 (1 - p^2) / ((h + sqrt3 p)(sqrt3 h + p)); and back,
 * p = (1 - sqrt3 T) / sqrt(1 + T (2 sqrt3 - T)) with T = tan((1 - u) pi/6).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(unicube,
        .aliases = "",
        .name = "unicube",
        .source = "Ho, Wan, Leung, Lam, Wong 2011, Unicube for dynamic environment mapping; "
                  "Lambers 2020, eq. 5",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0)
/* clang-format on */
#else

/* k0 = sqrt 3, k1 = pi / 6 - 1 / 2, k2 = 2 - 6 / pi, k3 = sqrt 2: to multiply by a power of two and
 * by the small rest rounds half as much */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_unicube_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(1.7320508075688772935274463415059);
    k.k1 = CM_LIT(0.02359877559829887307710723054658);
    k.k2 = CM_LIT(0.0901406828972559707733948395298);
    k.k3 = CM_LIT(1.4142135623730950488016887242097);
    return k;
}

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL h = cm_sqrt(CM_LIT(2.0) + a * a);
    CM_BOOL inner = a <= CM_LIT(0.5);
    CM_REAL above = CM_SELECT(inner, a, CM_LIT(2.0) * (CM_LIT(1.0) - a) * (CM_LIT(1.0) + a));
    CM_REAL below = CM_SELECT(inner, h, (h + k.k0 * a) * (k.k0 * h + a));
    CM_REAL angle = CM_NAME(cm_atan_unit)(above / below);
    CM_REAL part = CM_LIT(2.0) * angle - k.k2 * angle;
    return cm_copysign(CM_SELECT(inner, part, CM_LIT(1.0) - part), w);
}

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_BOOL inner = a <= CM_LIT(0.5);
    CM_REAL part = CM_SELECT(inner, a, CM_LIT(1.0) - a);
    CM_REAL t = CM_NAME(cm_tan_quarter)(CM_LIT(0.5) * part + k.k1 * part);
    CM_REAL above = CM_SELECT(inner, k.k3 * t, CM_LIT(1.0) - k.k0 * t);
    CM_REAL below = CM_SELECT(inner, (CM_LIT(1.0) - t) * (CM_LIT(1.0) + t),
                              CM_LIT(1.0) + t * (CM_LIT(2.0) * k.k0 - t));
    return cm_copysign(above / cm_sqrt(below), w);
}

CM_UNIVARIATE(cm_unicube_forward, cm_unicube_sigmoid, cm_unicube_inverse,
              cm_unicube_sigmoid_inverse)

#endif
