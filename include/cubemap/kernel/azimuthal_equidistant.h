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
             .bounds = {.round_trip = 8, .plane_round_trip = 5.5, .forward = 4, .inverse = 4, .relative = 10})
/* clang-format on */
#else

/* k3 = t0 / 2, k4 = sin t0, k5 = 2 / t0, k6 = cot(t0 / 2) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_equidistant_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL half_angle = k.k0 * CM_LIT(0.004363323129985823942309226921222153178);
    k = CM_NAME(cm_azimuthal_prepare)(k);
    CM_BOOL hemisphere = cm_equal(k.k2, CM_LIT(0.0));
    CM_REAL eighth_turn = CM_LIT(0.7853981633974483096156608458198757210493);
    k.k3 = CM_SELECT(hemisphere, eighth_turn, half_angle);
    k.k4 = CM_SELECT(hemisphere, CM_LIT(1.0), CM_LIT(2.0) * (k.k0 * k.k1));
    k.k5 = CM_SELECT(hemisphere, CM_LIT(1.273239544735162686151070106980114896276),
                     CM_LIT(1.0) / half_angle);
    k.k6 = k.k1 / k.k0;
    return k;
}

/* tan((t0 - t) / 2) is m / (sin((t0 + t) / 2) cos((t0 - t) / 2)). The outer half of the radii has its angle from the
 * rim; both angles are of a tangent of at most 1. */
CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_equidistant_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL none = CM_LIT(0.0);
    CM_REAL square = CM_SELECT(cm_equal(k.k2, none), CM_LIT(0.5), k.k0 * k.k0);
    CM_REAL below =
        (t.half_cosine + k.k6 * t.half_sine) * (square * (k.k6 * t.half_cosine + t.half_sine));
    /* the inner one is the better up to r = 0.6, where its tangent is not too great for that */
    CM_REAL most = CM_SELECT(cm_less(k.k2, none), one, CM_LIT(0.7));
    CM_BOOL outer = cm_at_least(most * (t.half_sine * below), t.margin * t.half_cosine);
    below = CM_SELECT(cm_less(none, below), below, one);
    CM_REAL tangent =
        CM_SELECT(outer, t.margin, t.half_sine) / CM_SELECT(outer, below, t.half_cosine);
    CM_REAL excess = one + CM_NAME(cm_atan_excess)(tangent * tangent);
    CM_REAL from_rim = (k.k5 * tangent) * excess; /* 1 - r */
    CM_REAL inner_ratio = (k.k5 * excess) / t.half_cosine;
    CM_REAL inner_radius = inner_ratio * t.half_sine;
    CM_REAL rest = CM_SELECT(outer, from_rim, one - inner_radius);
    CM_NAME(cm_radius) r;
    r.ratio = CM_SELECT(outer, (one - from_rim) / t.half_sine, inner_ratio);
    r.rim = rest * CM_SELECT(outer, CM_LIT(2.0) - from_rim, one + inner_radius);
    r.slope = CM_LIT(0.5) * k.k5;
    r.radius = CM_SELECT(outer, one - from_rim, none);
    return r;
}

/* The inner part has y = t / 2 from r, the outer one y = (t0 - t) / 2 from the rim; sin t and cos t are those of 2 y,
 * or of t0 - 2 y. */
CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_equidistant_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL radius = cm_sqrt(square);
    /* y is at most an eighth of a turn; of hemispheres both are as accurate at r = 0.6 */
    CM_REAL most = CM_SELECT(cm_less(k.k2, CM_LIT(0.0)), CM_LIT(0.25), CM_LIT(0.36));
    CM_BOOL outer = cm_less(most, square);
    CM_REAL y = k.k3 * CM_SELECT(outer, rim / (one + radius), radius);
    CM_REAL half_sine = CM_NAME(cm_sin_quarter)(y);
    CM_REAL half_cosine = one - CM_NAME(cm_versine_quarter)(y);
    CM_REAL sine = CM_LIT(2.0) * (half_sine * half_cosine);
    CM_REAL cosine = one - CM_LIT(2.0) * (half_sine * half_sine);
    /* beside the centre sin t / r is t0, and the square may have lost its digits */
    CM_BOOL tiny = cm_less(square, CM_LIT(1.0e-30));
    CM_REAL ratio =
        CM_SELECT(outer, k.k4 * cosine - k.k2 * sine, sine) / CM_SELECT(tiny, one, radius);
    CM_NAME(cm_angle) r;
    r.ratio = CM_SELECT(tiny, CM_LIT(2.0) * k.k3, ratio);
    r.cosine = CM_SELECT(outer, k.k2 * cosine + k.k4 * sine, cosine);
    r.slope = CM_LIT(2.0) * k.k3;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_equidistant_project, cm_azimuthal_equidistant_unproject,
               cm_azimuthal_equidistant_gradients, cm_azimuthal_equidistant_tangents,
               cm_azimuthal_equidistant_radius, cm_azimuthal_equidistant_angle)

#endif
