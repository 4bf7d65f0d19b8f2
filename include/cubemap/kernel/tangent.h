/* SPDX-License-Identifier: MIT
 *
 * tangent: u = atan(c p) / atan c. With c = 1 the adjusted spherical cube (ASC) and the equi-angular
 * cube map (EAC) of video; c = 1.1823 is Zucker & Higashi's least area RMSE, 1.19705 the least
 * maximum area error.
 *
 * Both directions work from the nearer of 0 and the edge, by tan(alpha - d) =
 * (c - tan d) / (1 + c tan d), so that the edge is exact and no angle exceeds alpha / 2. Divided by c
 * that is 1 - (c + 1/c) tan d / (1 + c tan d), in which the rounding of the second term counts less.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(tangent,
        .aliases = "asc:c=1 eac:c=1 zucker:c=1.1823",
        .name = "tangent adjustment",
        .source = "Ronchi, Iacono, Paolucci 1996 (c = 1); Zucker & Higashi 2018; Lambers 2020, eq. 2",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "tangent of the angle that the edge stands for; 1 is equi-angular",
                       .standard = 1.0,
                       .low = 0.0,
                       .low_excluded = 1,
                       .high = 4.0}})
/* clang-format on */
#else

/* alpha = atan c for any c in [0, 4] */
CM_FN CM_REAL CM_NAME(cm_tangent_angle)(CM_REAL c)
{
    return CM_LIT(2.0) * CM_NAME(cm_atan_unit)(c / (CM_LIT(1.0) + cm_sqrt(CM_LIT(1.0) + c * c)));
}

/* k0 = c, k1 = alpha = atan c, k2 = 1 / alpha, k3 = c + 1 / c */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_tangent_prepare)(CM_NAME(cm_constants) k)
{
    /* below 1e-9 the mapping is gnomonic to the last bit, and 1 / c must stay finite */
    k.k0 = cm_max(k.k0, CM_LIT(1.0e-9));
    k.k1 = CM_NAME(cm_tangent_angle)(k.k0);
    k.k2 = CM_LIT(1.0) / k.k1;
    k.k3 = k.k0 + CM_LIT(1.0) / k.k0;
    return k;
}

CM_FN CM_REAL CM_NAME(cm_tangent_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL from_zero = k.k0 * a;
    CM_REAL from_edge = k.k0 * (CM_LIT(1.0) - a) / (CM_LIT(1.0) + k.k0 * from_zero);
    CM_BOOL inner = from_zero <= from_edge;
    CM_REAL part = CM_NAME(cm_atan_unit)(CM_SELECT(inner, from_zero, from_edge)) * k.k2;
    return cm_copysign(CM_SELECT(inner, part, CM_LIT(1.0) - part), w);
}

CM_FN CM_REAL CM_NAME(cm_tangent_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_BOOL inner = a <= CM_LIT(0.5);
    CM_REAL t = CM_NAME(cm_tan_quarter)(k.k1 * CM_SELECT(inner, a, CM_LIT(1.0) - a));
    CM_REAL above = CM_SELECT(inner, t, t * k.k3);
    CM_REAL below = CM_SELECT(inner, k.k0, CM_LIT(1.0) + k.k0 * t);
    CM_REAL part = above / below;
    return cm_copysign(CM_SELECT(inner, part, CM_LIT(1.0) - part), w);
}

CM_UNIVARIATE(cm_tangent_forward, cm_tangent_sigmoid, cm_tangent_inverse,
              cm_tangent_sigmoid_inverse)

#endif
