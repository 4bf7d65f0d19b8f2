/* SPDX-License-Identifier: MIT
 *
 * azimuthal:gnomonic: r = tan t / tan t0, great circles are straight lines: the picture of a camera without
 * distortion, cut to a disc.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(gnomonic,
             .identifier = "azimuthal:gnomonic",
             .aliases = "azimuthal:rectilinear",
             .name = "gnomonic projection",
             .source = "Snyder 1987, section 22",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 3,
             .parameter = {CM_PARAMETER_FOV(90.0, 179.0), CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 3, .plane_round_trip = 3.25, .forward = 3.5, .inverse = 2, .relative = 5})
/* clang-format on */
#else

/* k3 = tan t0, k4 = tan^2 t0, k5 = sin^2 t0 / 2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_gnomonic_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL part = k.k0 / CM_LIT(180.0); /* of a quarter turn, t0 */
    CM_BOOL wide = cm_less(CM_LIT(0.5), part);
    CM_REAL angle = CM_LIT(1.570796326794896619231321691639751442099) *
                    CM_SELECT(wide, CM_LIT(1.0) - part, part);
    CM_REAL tangent =
        CM_NAME(cm_sin_quarter)(angle) / (CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(angle));
    tangent = CM_SELECT(cm_equal(part, CM_LIT(0.5)), CM_LIT(1.0), tangent);
    k = CM_NAME(cm_azimuthal_prepare)(k);
    CM_REAL sine = CM_LIT(2.0) * (k.k0 * k.k1);
    k.k3 = CM_SELECT(wide, CM_LIT(1.0) / tangent, tangent);
    k.k4 = k.k3 * k.k3;
    k.k5 = CM_LIT(0.5) * (sine * sine);
    return k;
}

/* What is beyond the rim may be beyond the horizon, too; it is not the law's. */
CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_gnomonic_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL cosine = cm_max(t.cosine, CM_LIT(0.5) * k.k2);
    CM_REAL over = CM_LIT(1.0) / cosine;
    CM_NAME(cm_radius) r;
    r.ratio = (CM_LIT(2.0) * t.half_cosine) * (over / k.k3);
    r.rim = (t.margin * (cosine + k.k2)) * ((over * over) / k.k5);
    r.slope = (over * over) / k.k3;
    r.radius = CM_LIT(0.0);
    return r;
}

CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_gnomonic_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_UNUSED(rim);
    CM_NAME(cm_angle) r;
    r.cosine = CM_NAME(cm_inverse_root)(CM_LIT(1.0) + k.k4 * square);
    r.ratio = k.k3 * r.cosine;
    r.slope = k.k3 * (r.cosine * r.cosine);
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_gnomonic_project, cm_azimuthal_gnomonic_unproject,
               cm_azimuthal_gnomonic_gradients, cm_azimuthal_gnomonic_tangents,
               cm_azimuthal_gnomonic_radius, cm_azimuthal_gnomonic_angle)

#endif
