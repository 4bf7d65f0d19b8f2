/* SPDX-License-Identifier: MIT
 *
 * algebraic: u = p sqrt((1 + c^2) / (1 + c^2 p^2)), the survey's recommendation.
 *
 * c = 0.87 has the lowest maximum area error of the univariate sigmoids, 11.7 % over 512 x 512 pixel
 * centres. The slope at the edge, by which the inverse magnifies rounding, is 1 / (1 + c^2).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(algebraic,
        .identifier = "algebraic",
        .aliases = "",
        .name = "algebraic sigmoid",
        .source = "Lambers 2020, Survey of cube mapping methods, eq. 7",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .parameter_count = 1,
        .parameter = {{.name = "c",
                       .meaning = "strength of the sigmoid; 0 is gnomonic",
                       .standard = 0.87,
                       .low = 0.0,
                       .high = 2.0}},
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = c^2, k1 = -c^2 / (1 + c^2) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_algebraic_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = k.k0 * k.k0;
    k.k1 = -(k.k0 / (CM_LIT(1.0) + k.k0));
    return k;
}

/* Both directions are w / sqrt(1 + g (1 - w^2)), in which the edge is exact: p = u / sqrt(1 + c^2 -
 * c^2 u^2) with g = c^2, and u = p / sqrt((1 + c^2 p^2) / (1 + c^2)) with g = -c^2 / (1 + c^2). */
CM_FN CM_REAL CM_NAME(cm_algebraic_curve)(CM_REAL w, CM_REAL g)
{
    return CM_NAME(cm_divide_by_root)(w, g * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)));
}

CM_FN CM_REAL CM_NAME(cm_algebraic_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_algebraic_curve)(w, k.k1);
}

CM_FN CM_REAL CM_NAME(cm_algebraic_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_algebraic_curve)(w, k.k0);
}

CM_UNIVARIATE(cm_algebraic_forward, cm_algebraic_sigmoid, cm_algebraic_inverse,
              cm_algebraic_sigmoid_inverse)

/* p = u / sqrt h with h = 1 + c^2 (1 - u^2), so that the slope is h^(3/2) / (1 + c^2): no division,
 * because 1 / (1 + c^2) = 1 + k1. */
CM_FN CM_REAL CM_NAME(cm_algebraic_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(w);
    CM_REAL h = CM_LIT(1.0) + k.k0 * ((CM_LIT(1.0) - f) * (CM_LIT(1.0) + f));
    return (CM_LIT(1.0) + k.k1) * (h * cm_sqrt(h));
}

CM_UNIVARIATE_JACOBIAN(cm_algebraic_jacobian, cm_algebraic_slope)

#endif
