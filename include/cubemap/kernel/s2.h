/* SPDX-License-Identifier: MIT
 *
 * s2: the quadratic projection of the S2 geometry library, p = u (2 + |u|) / 3, and u =
 * 3 p / (1 + sqrt(1 + 3 |p|)); here each is w plus a correction that vanishes at the edge, so that
 * the edge is exact and the rounding of the correction counts less.
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

#endif
