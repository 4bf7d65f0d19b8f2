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
             .bounds = {.round_trip = 7.6, .plane_round_trip = 5.5, .forward = 3.75, .inverse = 2.75, .relative = 8.5})
/* clang-format on */
#else

/* k3 = q0 = tan(t0 / 4), k4 = q0^2, k5 = 1 - q0^2, k6 = 1 / q0 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_breusing_prepare)(CM_NAME(cm_constants) k)
{
    k = CM_NAME(cm_azimuthal_prepare)(k);
    CM_BOOL hemisphere = cm_equal(k.k2, CM_LIT(0.0));
    CM_REAL sum = CM_LIT(1.0) + k.k1;
    CM_REAL root2_1 = CM_LIT(0.4142135623730950488016887242096980785697);
    CM_REAL root2_1_square = CM_LIT(0.1715728752538099023966225515806038428607);
    k.k3 = CM_SELECT(hemisphere, root2_1, k.k0 / sum);
    k.k4 = CM_SELECT(hemisphere, root2_1_square, k.k3 * k.k3);
    k.k5 = CM_SELECT(hemisphere, CM_LIT(2.0) * root2_1, CM_LIT(2.0) * k.k1 / sum);
    k.k6 = CM_SELECT(hemisphere, CM_LIT(2.0) + root2_1, sum / k.k0);
    return k;
}

/* With c = cos(t / 2) the square of tan(t / 4) is (1 - c) / (1 + c), and the difference of two of those is
 * 2 (c - c0) / ((1 + c) (1 + c0)), where c - c0 = m / (c + c0). */
CM_FN CM_NAME(cm_radius)
    CM_NAME(cm_azimuthal_breusing_radius)(CM_NAME(cm_colatitude) t, CM_NAME(cm_constants) k)
{
    CM_REAL one_more = CM_LIT(1.0) + t.half_cosine;
    CM_REAL sum = t.half_cosine + k.k1;
    sum = CM_SELECT(cm_less(CM_LIT(0.0), sum), sum, CM_LIT(1.0));
    CM_NAME(cm_radius) r;
    r.ratio = k.k6 / one_more;
    r.rim = ((CM_LIT(2.0) * k.k6) * t.margin) / ((k.k0 * sum) * one_more);
    r.slope = CM_LIT(0.5) * r.ratio;
    r.radius = CM_NAME(cm_azimuthal_radius)(r.rim);
    return r;
}

/* With q = tan(t / 4), A = 1 - q^2 and B = 2 q: sin t = 2 A B / (1 + q^2)^2, cos t = (A^2 - B^2) / (1 + q^2)^2, so
 * that an error of the divisor is one of the length alone. By the rim A^2 - B^2 is
 * (1 + q0^2)^2 cos t0 + q0^2 rim (2 (1 - q0^2) + 4 + q0^2 rim), which has the digits of a small cosine. */
CM_FN CM_NAME(cm_angle)
    CM_NAME(cm_azimuthal_breusing_angle)(CM_REAL square, CM_REAL rim, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL from_centre = k.k4 * square;
    CM_REAL from_rim = k.k4 * rim;
    CM_REAL over = one / (one + from_centre);
    CM_REAL over_square = over * over;
    CM_BOOL inner = cm_less(square, CM_LIT(0.36));
    CM_REAL a = CM_SELECT(inner, one - from_centre, k.k5 + from_rim);
    CM_REAL edge = ((one + k.k4) * (one + k.k4)) * k.k2;
    CM_REAL difference =
        CM_SELECT(inner, a * a - CM_LIT(4.0) * from_centre,
                  edge + from_rim * ((CM_LIT(4.0) + CM_LIT(2.0) * k.k5) + from_rim));
    CM_NAME(cm_angle) r;
    r.ratio = ((CM_LIT(4.0) * k.k3) * a) * over_square;
    r.cosine = difference * over_square;
    r.slope = (CM_LIT(4.0) * k.k3) * over;
    return r;
}

CM_LAW_KERNELS(cm_azimuthal_breusing_project, cm_azimuthal_breusing_unproject,
               cm_azimuthal_breusing_gradients, cm_azimuthal_breusing_tangents,
               cm_azimuthal_breusing_radius, cm_azimuthal_breusing_angle)

#endif
