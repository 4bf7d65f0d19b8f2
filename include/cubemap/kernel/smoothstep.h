/* SPDX-License-Identifier: MIT
 *
 * smoothstep: u = p (3 - c^2 p^2) / (3 - c^2), the part of the smoothstep polynomial up to c.
 *
 * The inverse is p = 2 sin(asin(y) / 3) / c with y = (3c - c^3) u / 2 (a published code has a wrong
 * one); a polynomial for that starts one Newton step. The slope at the edge is 3 (1 - c^2) / (3 - c^2): towards c = 1 it vanishes there, and the
 * inverse magnifies the rounding of u without bound.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(smoothstep,
        .identifier = "smoothstep",
        .aliases = "",
        .name = "smoothstep sigmoid",
        .source = "Lambers 2020, section 4.8",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "strength of the sigmoid; towards 0 it is gnomonic, 1 has no slope "
                                  "at the edge",
                       .standard = 0.75086,
                       .low = 0.0,
                       .low_excluded = 1,
                       .high = 1.0}},
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = kappa = c^2 / (3 - c^2), k1 = 1 - 2 kappa, the slope at the edge; with y = k2 a as above,
 * 1 - y = k3 + k2 (1 - a); k4 = 1 / c */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_smoothstep_prepare)(CM_NAME(cm_constants) k)
{
    /* below 1e-9 the mapping is gnomonic to the last bit */
    CM_REAL c = cm_max(k.k0, CM_LIT(1.0e-9));
    CM_REAL e = CM_LIT(1.0) - c;
    CM_REAL below = CM_LIT(3.0) - c * c;
    k.k0 = c * c / below;
    k.k1 = CM_LIT(3.0) * e * (CM_LIT(1.0) + c) / below;
    k.k2 = CM_LIT(0.5) * c * below;
    k.k3 = CM_LIT(0.5) * (e * e) * (CM_LIT(2.0) + c);
    k.k4 = CM_LIT(1.0) / c;
    return k;
}

/* (3 - c^2 w^2) / (3 - c^2) = 1 + kappa (1 - w^2) */
CM_FN CM_REAL CM_NAME(cm_smoothstep_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_stretch)(w, k.k0 * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)));
}

/* One Newton step on p (1 + kappa (1 - p^2)) - a: the rest is all but exact, because a - p is. */
CM_FN CM_REAL CM_NAME(cm_smoothstep_step)(CM_REAL p, CM_REAL a, CM_NAME(cm_constants) k)
{
    CM_REAL b = k.k0 * ((CM_LIT(1.0) - p) * (CM_LIT(1.0) + p));
    CM_REAL rest = cm_mad(-p, b, a - p);
    CM_REAL slope = cm_mad(CM_LIT(3.0), b, k.k1);
    /* without a slope, at the edge for c = 1, there is no rest either */
    return p + rest / cm_max(slope, CM_LIT(1.0e-12));
}

CM_FN CM_REAL CM_NAME(cm_smoothstep_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL s = cm_sqrt(cm_mad(k.k2, CM_LIT(1.0) - a, k.k3));
    CM_REAL p = CM_NAME(cm_trisect)(k.k2 * a, s) * k.k4;
    p = CM_NAME(cm_smoothstep_step)(p, a, k);
#if CM_REAL_BITS > 64
    p = CM_NAME(cm_smoothstep_step)(p, a, k);
#endif
    return cm_copysign(CM_SELECT(cm_equal(a, CM_LIT(1.0)), CM_LIT(1.0), p), w);
}

CM_UNIVARIATE(cm_smoothstep_forward, cm_smoothstep_sigmoid, cm_smoothstep_inverse,
              cm_smoothstep_sigmoid_inverse)

/* 1 + kappa - 3 kappa w^2, from the edge, where it vanishes for c = 1 */
CM_FN CM_REAL CM_NAME(cm_smoothstep_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(f);
    return k.k1 + (CM_LIT(3.0) * k.k0) * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w));
}

CM_UNIVARIATE_JACOBIAN(cm_smoothstep_jacobian, cm_smoothstep_slope)

#endif
