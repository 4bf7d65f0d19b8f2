/* SPDX-License-Identifier: MIT
 *
 * azimuthal:stereographic: r = tan(t / 2) / tan(t0 / 2), conformal.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(stereographic,
             .identifier = "azimuthal:stereographic",
             .aliases = "azimuthal:stere azimuthal:conformal",
             .name = "stereographic projection",
             .source = "Snyder 1987, section 21; Lambers 2016, section 3.2",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .properties = CM_CONFORMAL,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 3,
             .parameter = {CM_PARAMETER_FOV(180.0, 359.0), CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 6, .plane_round_trip = 4.5, .forward = 3.25, .inverse = 2, .relative = 5.5})
/* clang-format on */
#else

/* k3 = tan(t0 / 2), k4 = sin^2(t0 / 2), k5 = its square of the tangent */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_stereographic_prepare)(CM_NAME(cm_constants) k)
{
    k = CM_NAME(cm_azimuthal_prepare)(k);
    k.k3 = k.k0 / k.k1;
    k.k4 = CM_SELECT(cm_equal(k.k2, CM_LIT(0.0)), CM_LIT(0.5), k.k0 * k.k0);
    k.k5 = k.k3 * k.k3;
    return k;
}

CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_stereographic_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL square = t.half_cosine * t.half_cosine;
    CM_NAME(cm_radius) r;
    r.ratio = CM_LIT(1.0) / (k.k3 * t.half_cosine);
    r.rim = t.margin / (k.k4 * square);
    r.slope = CM_LIT(0.5) / (k.k3 * square);
    r.radius = CM_NAME(cm_azimuthal_radius)(r.rim);
    return r;
}

/* cos^2(t / 2) = 1 / (1 + tan^2(t / 2)) */
CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_stereographic_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL half_cosine_square = CM_LIT(1.0) / (CM_LIT(1.0) + k.k5 * square);
    CM_NAME(cm_angle) r;
    r.ratio = (CM_LIT(2.0) * k.k3) * half_cosine_square;
    r.cosine = k.k2 + (CM_LIT(2.0) * k.k4) * (rim * half_cosine_square);
    r.slope = r.ratio;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_stereographic_project, cm_azimuthal_stereographic_unproject,
               cm_azimuthal_stereographic_gradients, cm_azimuthal_stereographic_tangents,
               cm_azimuthal_stereographic_radius, cm_azimuthal_stereographic_angle)

#endif
