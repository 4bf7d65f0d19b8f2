/* SPDX-License-Identifier: MIT
 *
 * smoothstep: u = p (3 - c^2 p^2) / (3 - c^2), the part of the smoothstep polynomial up to c.
 *
 * The inverse is p = 2 sin(asin(y) / 3) / c with y = (3c - c^3) u / 2 (a published code has a wrong
 * one). The slope at the edge is 3 (1 - c^2) / (3 - c^2): towards c = 1 it vanishes there, and the
 * inverse magnifies the rounding of u without bound.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(smoothstep,
        .aliases = "",
        .name = "smoothstep sigmoid",
        .source = "Lambers 2020, section 4.8",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "strength of the sigmoid; towards 0 it is gnomonic, 1 has no slope "
                                  "at the edge",
                       .standard = 0.75086,
                       .low = 0.0,
                       .low_excluded = 1,
                       .high = 1.0}},
        .bounds = {.round_trip = 2.8, .plane_round_trip = 4, .forward = 2, .inverse = 4,
                   .relative = 6})
/* clang-format on */
#else

/* k0 = c, k1 = c^2, k2 = 1 / (3 - c^2), k3 = c (3 - c^2) / 2, k4 = 3 - c^2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_smoothstep_prepare)(CM_NAME(cm_constants) k)
{
    /* below 1e-9 the mapping is gnomonic to the last bit */
    k.k0 = cm_max(k.k0, CM_LIT(1.0e-9));
    k.k1 = k.k0 * k.k0;
    k.k4 = CM_LIT(3.0) - k.k1;
    k.k2 = CM_LIT(1.0) / k.k4;
    k.k3 = CM_LIT(0.5) * k.k0 * k.k4;
    return k;
}

/* (3 - c^2 w^2) / (3 - c^2) = 1 + c^2 (1 - w^2) / (3 - c^2) */
CM_FN CM_REAL CM_NAME(cm_smoothstep_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_stretch)(w, (k.k1 * k.k2) * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)));
}

CM_FN CM_REAL CM_NAME(cm_smoothstep_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL root = CM_NAME(cm_trisect)(k.k3 * a) / k.k0;
    return cm_copysign(CM_SELECT(a == CM_LIT(1.0), CM_LIT(1.0), cm_min(CM_LIT(1.0), root)), w);
}

CM_UNIVARIATE(cm_smoothstep_forward, cm_smoothstep_sigmoid, cm_smoothstep_inverse,
              cm_smoothstep_sigmoid_inverse)

#endif
