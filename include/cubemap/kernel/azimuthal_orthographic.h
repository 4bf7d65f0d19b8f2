/* SPDX-License-Identifier: MIT
 *
 * azimuthal:orthographic: r = sin t / sin t0, the view from infinitely far; of one hemisphere at most.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(orthographic,
             .identifier = "azimuthal:orthographic",
             .aliases = "azimuthal:ortho",
             .name = "orthographic projection",
             .source = "Snyder 1987, section 20",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 3,
             .parameter = {CM_PARAMETER_FOV(180.0, 180.0), CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 0, .plane_round_trip = 4.5, .forward = 3.5, .inverse = 1.5, .relative = 5.5})
/* clang-format on */
#else

/* k3 = sin t0, k4 = its square, k5 = cos^2 t0 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_orthographic_prepare)(CM_NAME(cm_constants) k)
{
    k = CM_NAME(cm_azimuthal_prepare)(k);
    k.k3 = CM_SELECT(cm_equal(k.k2, CM_LIT(0.0)), CM_LIT(1.0), CM_LIT(2.0) * (k.k0 * k.k1));
    k.k4 = k.k3 * k.k3;
    k.k5 = k.k2 * k.k2;
    return k;
}

CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_orthographic_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_NAME(cm_radius) r;
    r.ratio = (CM_LIT(2.0) * t.half_cosine) / k.k3;
    r.rim = (CM_LIT(2.0) * t.margin) * ((t.cosine + k.k2) / k.k4);
    r.slope = t.cosine / k.k3;
    r.radius = CM_NAME(cm_azimuthal_radius)(r.rim);
    return r;
}

CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_orthographic_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_UNUSED(square);
    CM_NAME(cm_angle) r;
    r.ratio = k.k3;
    r.cosine = cm_sqrt(k.k5 + k.k4 * rim);
    r.slope = k.k3 / r.cosine;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_orthographic_project, cm_azimuthal_orthographic_unproject,
               cm_azimuthal_orthographic_gradients, cm_azimuthal_orthographic_tangents,
               cm_azimuthal_orthographic_radius, cm_azimuthal_orthographic_angle)

#endif
