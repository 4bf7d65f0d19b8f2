/* SPDX-License-Identifier: MIT
 *
 * azimuthal:breusing: Breusing's harmonic mean of the equal-area and the conformal radius,
 * r = tan(t / 4) / tan(t0 / 4).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_AZIMUTHAL(breusing,
             .identifier = "azimuthal:breusing",
             .aliases = "azimuthal:harmonic-mean",
             .name = "Breusing's harmonic mean projection",
             .source = "Young 1920; Lambers 2016, section 3.3",
             .kind = CM_KIND_AZIMUTHAL,
             .family = CM_FAMILY_HYBRID,
             .smooth_face = CM_SMOOTH_ANALYTIC,
             .parameter_count = 4,
             .parameter = {CM_PARAMETER_FOV(180.0, 360.0), CM_PARAMETER_FULL, CM_PARAMETERS_CENTRE},
             .bounds = {.round_trip = 7, .plane_round_trip = 5, .forward = 4, .inverse = 7, .relative = 8})
/* clang-format on */
#else

/* k3 = q0 = tan(t0 / 4), k4 = q0^2, k5 = 1 - q0^2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_breusing_prepare)(CM_NAME(cm_constants) k)
{
    k = CM_NAME(cm_azimuthal_prepare)(k);
    CM_REAL sum = CM_LIT(1.0) + k.k1;
    k.k3 = k.k0 / sum;
    k.k4 = k.k3 * k.k3;
    k.k5 = CM_LIT(2.0) * k.k1 / sum;
    return k;
}

/* With c = cos(t / 2) the square of tan(t / 4) is (1 - c) / (1 + c), and the difference of two of those is
 * 2 (c - c0) / ((1 + c) (1 + c0)), where c - c0 = m / (c + c0). */
CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_breusing_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL over = CM_LIT(1.0) / (k.k3 * (CM_LIT(1.0) + t.half_cosine));
    CM_REAL sum = t.half_cosine + k.k1;
    CM_REAL apart = t.margin / CM_SELECT(cm_less(CM_LIT(0.0), sum), sum, CM_LIT(1.0));
    CM_NAME(cm_radius) r;
    r.ratio = over;
    r.rim = (CM_LIT(2.0) * over) * (apart / (k.k3 * (CM_LIT(1.0) + k.k1)));
    r.slope = CM_LIT(0.5) * over;
    return r;
}

CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_breusing_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL over = CM_LIT(1.0) / (CM_LIT(1.0) + k.k4 * square);
    CM_REAL half_cosine = (k.k5 + k.k4 * rim) * over;
    CM_REAL sine_ratio = (CM_LIT(2.0) * k.k3) * over;             /* sin(t / 2) / r */
    CM_REAL apart = (k.k4 * rim) * ((CM_LIT(1.0) + k.k1) * over); /* cos(t / 2) - cos(t0 / 2) */
    CM_REAL sine_square = (sine_ratio * sine_ratio) * square;
    /* beyond the equator both ways end alike; up to it the second has the digits of the cosine */
    CM_REAL most = CM_SELECT(cm_less(k.k2, CM_LIT(0.0)), CM_LIT(0.5), CM_LIT(0.25));
    CM_NAME(cm_angle) r;
    r.ratio = CM_LIT(2.0) * (sine_ratio * half_cosine);
    r.cosine = CM_SELECT(cm_less(sine_square, most), CM_LIT(1.0) - CM_LIT(2.0) * sine_square,
                         k.k2 + CM_LIT(2.0) * (apart * (half_cosine + k.k1)));
    r.slope = CM_LIT(2.0) * sine_ratio;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_breusing_project, cm_azimuthal_breusing_unproject,
               cm_azimuthal_breusing_gradients, cm_azimuthal_breusing_tangents,
               cm_azimuthal_breusing_radius, cm_azimuthal_breusing_angle)

#endif
