/* SPDX-License-Identifier: MIT
 *
 * azimuthal:mixture: Fong's mixture of the stereographic (beta = 0) and Lambert's (beta = 1) projection,
 * r = K sin(t / 2) / sqrt(cos^2(t / 2) + beta sin^2(t / 2)), K such that the rim is at t0. For the whole
 * sphere beta must not be 0.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(mixture,
             .identifier = "azimuthal:mixture",
             .aliases = "azimuthal:fong",
             .name = "Fong's mixture of stereographic and Lambert",
             .source = "Fong 2014; Lambers 2016, section 3.4 (denominator corrected)",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 5,
             .parameter = {CM_PARAMETER_FOV(180.0, 360.0),
                           CM_PARAMETER_BETA("0 for stereographic, 1 for Lambert's"), CM_PARAMETER_FULL,
                           CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 7, .plane_round_trip = 5, .forward = 4, .inverse = 3, .relative = 8.5})
/* clang-format on */
#else

/* k3 = beta, k4 = K^2, k5 = 1 / K^2, k6 = sin^2(t0 / 2) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_mixture_prepare)(CM_NAME(cm_constants) k)
{
    k.k3 = k.k1;
    k = CM_NAME(cm_azimuthal_prepare)(k);
    CM_BOOL hemisphere = cm_equal(k.k2, CM_LIT(0.0));
    k.k6 = CM_SELECT(hemisphere, CM_LIT(0.5), k.k0 * k.k0);
    k.k4 = CM_SELECT(hemisphere, CM_LIT(1.0), (k.k1 * k.k1) / k.k6) + k.k3;
    k.k5 = CM_LIT(1.0) / k.k4;
    return k;
}

CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_mixture_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL radicand =
        k.k5 * (t.half_cosine * t.half_cosine) + (k.k5 * k.k3) * (t.half_sine * t.half_sine);
    CM_NAME(cm_radius) r;
    r.ratio = CM_NAME(cm_inverse_root)(radicand);
    r.rim = t.margin / (radicand * (k.k4 * k.k6));
    r.slope = CM_LIT(0.5) * ((k.k5 * t.half_cosine) * (r.ratio / radicand));
    r.radius = CM_NAME(cm_azimuthal_radius)(r.rim);
    return r;
}

/* sin^2(t / 2) = r^2 / (K^2 + (1 - beta) r^2) */
CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_mixture_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL radicand = k.k4 + (CM_LIT(1.0) - k.k3) * square;
    CM_REAL over = CM_NAME(cm_inverse_root)(radicand);
    CM_REAL margin = ((k.k6 * k.k4) * rim) * (over * over);
    CM_REAL half_cosine = cm_sqrt(k.k1 * k.k1 + margin);
    CM_NAME(cm_angle) r;
    r.ratio = CM_LIT(2.0) * (over * half_cosine);
    r.cosine = k.k2 + CM_LIT(2.0) * margin;
    r.slope = ((CM_LIT(2.0) * k.k4) * over) / (radicand * half_cosine);
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_mixture_project, cm_azimuthal_mixture_unproject,
               cm_azimuthal_mixture_gradients, cm_azimuthal_mixture_tangents,
               cm_azimuthal_mixture_radius, cm_azimuthal_mixture_angle)

#endif
