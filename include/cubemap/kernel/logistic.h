/* SPDX-License-Identifier: MIT
 *
 * logistic: the logistic sigmoid scaled to [-1, 1], which is tanh (tanh.h) with half the c.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(logistic,
                 .identifier = "logistic",
                 .aliases = "",
                 .name = "logistic sigmoid",
                 .source = "Lambers 2020, section 4.8",
                 .family = CM_FAMILY_UNIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {{.name = "c",
                                .meaning = "strength of the sigmoid; towards 0 it is gnomonic",
                                .standard = 1.94437,
                                .low = 0.0,
                                .low_excluded = 1,
                                .high = 4.0}},
                 .bounds = {.round_trip = 2.8, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                            .relative = 6},
                 .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* those of tanh with c / 2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_logistic_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(0.5) * k.k0;
    return CM_NAME(cm_tanh_prepare)(k);
}

CM_UNIVARIATE(cm_logistic_forward, cm_tanh_sigmoid, cm_logistic_inverse, cm_tanh_sigmoid_inverse)

CM_UNIVARIATE_JACOBIAN(cm_logistic_jacobian, cm_tanh_slope)

#endif
