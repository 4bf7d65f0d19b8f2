/* SPDX-License-Identifier: MIT
 *
 * everitt: u = p (c + (1 - c) |p|). Slope c at the centre and 2 - c at the edge.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(everitt,
        .identifier = "everitt",
        .aliases = "",
        .name = "Everitt's quadratic",
        .source = "Everitt 2016, projection; Zucker & Higashi 2018 (c); Lambers 2020, eq. 6",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_C1,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "slope at the centre; 1 is gnomonic",
                       .standard = 1.4511,
                       .low = 0.5,
                       .high = 1.8}},
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_INVERSE)
/* clang-format on */
#else

/* k1 = c - 1, k2 = 2 (c - 1), k3 = 2 - c, k4 = (2 - c)^2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_everitt_prepare)(CM_NAME(cm_constants) k)
{
    k.k1 = k.k0 - CM_LIT(1.0);
    k.k2 = CM_LIT(2.0) * k.k1;
    k.k3 = CM_LIT(2.0) - k.k0;
    k.k4 = k.k3 * k.k3;
    return k;
}

CM_FN CM_REAL CM_NAME(cm_everitt_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_stretch)(w, k.k1 * (CM_LIT(1.0) - cm_abs(w)));
}

/* 2 w / (c + S), S = sqrt(c^2 - 4 (c - 1) |w|), as w minus what is missing: with
 * e = 2 (c - 1)(1 - |w|) that is w - w e / (2 - c + e + S), S^2 = (2 - c)^2 + 2 e */
CM_FN CM_REAL CM_NAME(cm_everitt_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL e = k.k2 * (CM_LIT(1.0) - cm_abs(w));
    return CM_NAME(cm_stretch)(
        w, -(e / ((k.k3 + e) + CM_NAME(cm_root)(cm_mad(CM_LIT(2.0), e, k.k4)))));
}

CM_UNIVARIATE(cm_everitt_forward, cm_everitt_sigmoid, cm_everitt_inverse,
              cm_everitt_sigmoid_inverse)

/* c - 2 (c - 1) |w|, from the edge, where it may be small */
CM_FN CM_REAL CM_NAME(cm_everitt_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(f);
    return k.k3 + k.k2 * (CM_LIT(1.0) - cm_abs(w));
}

CM_UNIVARIATE_JACOBIAN(cm_everitt_jacobian, cm_everitt_slope)

#endif
