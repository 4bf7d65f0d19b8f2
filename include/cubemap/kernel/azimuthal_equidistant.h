/* SPDX-License-Identifier: MIT
 *
 * azimuthal:equidistant: r = t / t0, as on the flag of the United Nations and as fisheye lenses are
 * meant to be. Radii are computed from the centre or from the rim, whichever is nearer.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(equidistant,
             .identifier = "azimuthal:equidistant",
             .aliases = "azimuthal:aeqd",
             .name = "azimuthal equidistant projection",
             .source = "Snyder 1987, section 25; Lambers 2016, section 3.5",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 4,
             .parameter = {CM_PARAMETER_FOV(180.0, 360.0), CM_PARAMETER_FULL, CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 7, .plane_round_trip = 5, .forward = 4, .inverse = 6, .relative = 8})
/* clang-format on */
#else

/* k3 = t0 / 2, k4 = sin t0, k5 = 2 / t0 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_equidistant_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL half_angle = k.k0 * CM_LIT(0.004363323129985823942309226921222153178);
    k = CM_NAME(cm_azimuthal_prepare)(k);
    k.k3 = half_angle;
    k.k4 = CM_LIT(2.0) * (k.k0 * k.k1);
    k.k5 = CM_LIT(1.0) / half_angle;
    return k;
}

/* sin((t0 - t) / 2) is m / (sin(t0 / 2) cos(t / 2) + cos(t0 / 2) sin(t / 2)). The outer half of the radii has
 * its angle from the rim; both angles are of a tangent of at most 1. */
CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_equidistant_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL none = CM_LIT(0.0);
    CM_REAL sum = k.k0 * t.half_cosine + k.k1 * t.half_sine; /* sin((t0 + t) / 2) */
    CM_REAL rest_sine = t.margin / CM_SELECT(cm_less(none, sum), sum, one);
    CM_REAL rest_cosine = k.k1 * t.half_cosine + k.k0 * t.half_sine;
    CM_BOOL outer = cm_less(rest_sine, t.half_sine);
    CM_REAL tangent =
        CM_SELECT(outer, rest_sine, t.half_sine) / CM_SELECT(outer, rest_cosine, t.half_cosine);
    CM_REAL excess = one + CM_NAME(cm_atan_excess)(tangent * tangent);
    CM_REAL from_rim = (k.k5 * tangent) * excess; /* 1 - r */
    CM_REAL inner_ratio = (k.k5 * excess) / t.half_cosine;
    CM_REAL inner_radius = inner_ratio * t.half_sine;
    CM_REAL rest = CM_SELECT(outer, from_rim, one - inner_radius);
    CM_NAME(cm_radius) r;
    r.ratio = CM_SELECT(outer, (one - from_rim) / t.half_sine, inner_ratio);
    r.rim = rest * CM_SELECT(outer, CM_LIT(2.0) - from_rim, one + inner_radius);
    r.slope = CM_LIT(0.5) * k.k5;
    return r;
}

/* From the rim: m = sin y sin(t0 - y) with y = (t0 - t) / 2. */
CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_equidistant_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL radius = cm_sqrt(square);
    CM_BOOL outer = cm_less(CM_LIT(0.25), square);
    CM_REAL y = k.k3 * CM_SELECT(outer, rim / (one + radius), radius);
    CM_REAL sine = CM_NAME(cm_sin_quarter)(y);
    CM_REAL versine = CM_NAME(cm_versine_quarter)(y);
    CM_REAL cosine = one - versine;
    CM_REAL half_sine = k.k0 * cosine - k.k1 * sine;
    CM_REAL half_cosine = CM_SELECT(outer, k.k1 * cosine + k.k0 * sine, cosine);
    /* beside the centre sin(t / 2) / r is t0 / 2, and the square may have lost its digits */
    CM_BOOL tiny = cm_less(square, CM_LIT(1.0e-30));
    CM_REAL inner_ratio = CM_SELECT(tiny, k.k3, sine / CM_SELECT(tiny, one, radius));
    CM_REAL sine_ratio = CM_SELECT(outer, half_sine / CM_SELECT(tiny, one, radius), inner_ratio);
    CM_REAL margin = sine * (k.k4 * cosine - k.k2 * sine);
    CM_NAME(cm_angle) r;
    r.ratio = CM_LIT(2.0) * (sine_ratio * half_cosine);
    r.cosine = CM_SELECT(outer, k.k2 + CM_LIT(2.0) * margin, one - CM_LIT(2.0) * (sine * sine));
    r.slope = CM_LIT(2.0) * k.k3;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_equidistant_project, cm_azimuthal_equidistant_unproject,
               cm_azimuthal_equidistant_gradients, cm_azimuthal_equidistant_tangents,
               cm_azimuthal_equidistant_radius, cm_azimuthal_equidistant_angle)

#endif
