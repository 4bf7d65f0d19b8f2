/* SPDX-License-Identifier: MIT
 *
 * tanh: u = tanh(c p) / tanh c. 0.97218 is the c of least maximum area error
 * over 512 x 512 pixel centres.
 *
 * As in tangent.h both directions work from the nearer of 0 and the edge, here by
 * tanh(c - d) / T = 1 - (1/T - T) tanh d / (1 - T tanh d), T = tanh c.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(tanh,
        .aliases = "",
        .name = "hyperbolic tangent sigmoid",
        .source = "Lambers 2020, section 4.8",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "strength of the sigmoid; towards 0 it is gnomonic",
                       .standard = 0.97218,
                       .low = 0.0,
                       .low_excluded = 1,
                       .high = 2.0}})
/* clang-format on */
#else

/* k0 = c, k1 = T = tanh c, k2 = 1 / T - T, k3 = 1 - T^2, k4 = T^2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_tanh_prepare)(CM_NAME(cm_constants) k)
{
    /* below 1e-9 the mapping is gnomonic to the last bit, and 1 / T must stay finite */
    k.k0 = cm_max(k.k0, CM_LIT(1.0e-9));
    CM_REAL half_tanh = CM_NAME(cm_tanh_unit)(CM_LIT(0.5) * k.k0);
    CM_REAL square = half_tanh * half_tanh;
    CM_REAL sech = (CM_LIT(1.0) - square) / (CM_LIT(1.0) + square);
    k.k1 = CM_LIT(2.0) * half_tanh / (CM_LIT(1.0) + square);
    k.k3 = sech * sech;
    k.k2 = k.k3 / k.k1;
    k.k4 = k.k1 * k.k1;
    return k;
}

CM_FN CM_REAL CM_NAME(cm_tanh_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_BOOL inner = a <= CM_LIT(0.5);
    CM_REAL t = CM_NAME(cm_tanh_unit)(k.k0 * CM_SELECT(inner, a, CM_LIT(1.0) - a));
    CM_REAL above = CM_SELECT(inner, t, t * k.k2);
    CM_REAL below = CM_SELECT(inner, k.k1, CM_LIT(1.0) - t * k.k1);
    CM_REAL part = above / below;
    return cm_copysign(CM_SELECT(inner, part, CM_LIT(1.0) - part), w);
}

CM_FN CM_REAL CM_NAME(cm_tanh_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL b = CM_LIT(1.0) - a;
    CM_REAL from_zero = k.k1 * a;
    CM_REAL from_edge = k.k1 * b / (k.k3 + k.k4 * b);
    CM_BOOL inner = from_zero <= from_edge;
    CM_REAL part = CM_NAME(cm_atanh_part)(CM_SELECT(inner, from_zero, from_edge)) / k.k0;
    return cm_copysign(CM_SELECT(inner, part, CM_LIT(1.0) - part), w);
}

CM_UNIVARIATE(cm_tanh_forward, cm_tanh_sigmoid, cm_tanh_inverse, cm_tanh_sigmoid_inverse)

#endif
