/* SPDX-License-Identifier: MIT
 *
 * azimuthal:lambert: Lambert's azimuthal equal-area projection, r = sin(t / 2) / sin(t0 / 2); as a law of
 * lenses it is called equisolid.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(lambert,
             .identifier = "azimuthal:lambert",
             .aliases = "azimuthal:laea azimuthal:equisolid azimuthal:equal-area",
             .name = "Lambert's azimuthal equal-area projection",
             .source = "Lambert 1772; Snyder 1987, section 24; Lambers 2016, section 3.1",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .properties = CM_EQUAL_AREA,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 4,
             .parameter = {CM_PARAMETER_FOV(180.0, 360.0), CM_PARAMETER_FULL, CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 6, .plane_round_trip = 4, .forward = 3, .inverse = 2.5, .relative = 6})
/* clang-format on */
#else

/* k3 = sin^2(t0 / 2) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_lambert_prepare)(CM_NAME(cm_constants) k)
{
    k = CM_NAME(cm_azimuthal_prepare)(k);
    k.k3 = CM_SELECT(cm_equal(k.k2, CM_LIT(0.0)), CM_LIT(0.5), k.k0 * k.k0);
    return k;
}

CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_lambert_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_NAME(cm_radius) r;
    r.ratio = CM_LIT(1.0) / k.k0;
    r.rim = t.margin / k.k3;
    r.slope = (CM_LIT(0.5) * t.half_cosine) * r.ratio;
    r.radius = CM_NAME(cm_azimuthal_radius)(r.rim);
    return r;
}

CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_lambert_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_UNUSED(square);
    CM_REAL margin = k.k3 * rim;
    CM_REAL half_cosine = cm_sqrt(k.k1 * k.k1 + margin);
    CM_NAME(cm_angle) r;
    r.ratio = (CM_LIT(2.0) * k.k0) * half_cosine;
    r.cosine = k.k2 + CM_LIT(2.0) * margin;
    r.slope = (CM_LIT(2.0) * k.k0) / half_cosine;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_lambert_project, cm_azimuthal_lambert_unproject,
               cm_azimuthal_lambert_gradients, cm_azimuthal_lambert_tangents,
               cm_azimuthal_lambert_radius, cm_azimuthal_lambert_angle)

#endif
