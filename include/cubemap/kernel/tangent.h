/* SPDX-License-Identifier: MIT
 *
 * tangent: u = atan(c p) / atan c. With c = 1 the adjusted spherical cube (ASC) and the equi-angular
 * cube map (EAC) of video; c = 1.1823 is Zucker & Higashi's least area RMSE, 1.19705 the least
 * maximum area error; c = 1 / sqrt 2 is the equi-edge grid of the atmosphere model FV3, whose points are
 * equally far apart on the great circles of the edges.
 *
 * Both directions are w plus w times a difference that vanishes at the edge, made of the excess E of
 * atan or tan (elementary.h): with E1 that of the edge,
 *     atan(c w) / atan c = w (1 + E) / (1 + E1) = w + w (E - E1) / (1 + E1), E = E(c^2 w^2).
 * c > 1 is beyond the excess' domain and takes half the angle, atan x = 2 atan(x / (1 + S)) with
 * S = sqrt(1 + x^2), and tan x = 2 t / (1 - t^2) with t = tan(x / 2); then the two terms of the
 * difference have the same sign, so that nothing cancels.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(tangent,
                 .identifier = "tangent",
                 .aliases = "asc:c=1 eac:c=1 zucker:c=1.1823 "
                            "equi-edge:c=0.70710678118654752",
                 .name = "tangent adjustment",
                 .source = "Ronchi, Iacono, Paolucci 1996 (c = 1); Zucker & Higashi 2018; Lambers 2020, eq. 2",
                 .family = CM_FAMILY_UNIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {{.name = "c",
                                .meaning = "tangent of the angle that the edge stands for; 1 is equi-angular",
                                .standard = 1.0,
                                .low = 0.0,
                                .low_excluded = 1,
                                .high = 4.0}},
                 .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                            .relative = 6},
                 .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = c^2; k1, k2: E1 of atan and c / alpha; k3 = alpha^2; k4, k5: E1 of tan and alpha / c. For
 * c > 1, the variant, k1 is E of half the angle, k2 twice that; k3 is (alpha / 2)^2, k4 E of that. */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_tangent_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL c = k.k0;
    k.k0 = c * c;
    k.variant = CM_SELECT(cm_less(CM_LIT(1.0), c), CM_LIT(1.0), CM_LIT(0.0));
    if (!CM_VARIANT(k))
    {
        k.k1 = CM_NAME(cm_atan_excess)(k.k0);
        k.k5 = CM_LIT(1.0) + k.k1;
        k.k2 = CM_LIT(1.0) / k.k5;
        CM_REAL angle = c + c * k.k1;
        k.k3 = angle * angle;
    }
    else
    {
        CM_REAL root = cm_sqrt(CM_LIT(1.0) + k.k0);
        CM_REAL half_tan = c / (CM_LIT(1.0) + root);
        k.k1 = CM_NAME(cm_atan_excess)((root - CM_LIT(1.0)) / (root + CM_LIT(1.0)));
        CM_REAL half_angle = half_tan + half_tan * k.k1;
        k.k2 = c / half_angle;
        k.k3 = half_angle * half_angle;
        k.k5 = CM_LIT(2.0) / k.k2;
    }
    k.k4 = CM_NAME(cm_tan_excess)(k.k3);
    return k;
}

CM_FN CM_REAL CM_NAME(cm_tangent_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL z = k.k0 * (w * w);
    CM_REAL d;
    if (!CM_VARIANT(k))
    {
        d = (CM_NAME(cm_atan_excess)(z) - k.k1) * k.k2;
    }
    else
    {
        CM_REAL root = cm_sqrt(CM_LIT(1.0) + z);
        CM_REAL root1 = cm_sqrt(CM_LIT(1.0) + k.k0);
        CM_REAL scale = CM_LIT(1.0) / (CM_LIT(1.0) + root);
        CM_REAL excess = CM_NAME(cm_atan_excess)((root - CM_LIT(1.0)) * scale);
        CM_REAL rest = k.k0 * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)); /* root1^2 - root^2 */
        d = (k.k2 * (excess - k.k1) + rest / (root + root1)) * scale;
    }
    return CM_NAME(cm_stretch_inside)(w, d);
}

/* c > 1: for the outer quarter from the edge, where the slope is steep,
 * tan(alpha - d) / c = 1 - (1 + 1 / c^2) c tan d / (1 + c tan d). */
CM_FN CM_REAL CM_NAME(cm_tangent_steep_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL a = cm_abs(w);
    CM_REAL b = CM_LIT(1.0) - a;
    CM_BOOL outer = cm_less(b, CM_LIT(0.25));
    CM_REAL z = k.k3 * CM_SELECT(outer, CM_LIT(4.0) * (b * b), w * w);
    CM_REAL excess = CM_NAME(cm_tan_excess)(z);
    CM_REAL f = CM_LIT(1.0) + excess;
    CM_REAL f1 = CM_LIT(1.0) + k.k4;
    CM_REAL t2 = z * (f * f); /* of the tangent of half the angle */
    CM_REAL rest = (excess - k.k4) * k.k5 + (t2 - k.k3 * (f1 * f1));
    CM_REAL ct = b * ((CM_LIT(2.0) * k.k0 / k.k2) * f); /* c tan d */
    CM_REAL above = CM_SELECT(outer, ct, rest);
    CM_REAL below = CM_SELECT(outer, CM_LIT(1.0) + ct, CM_LIT(1.0) - t2);
    CM_REAL ratio = above / below;
    CM_REAL from_edge = CM_LIT(1.0) - (CM_LIT(1.0) + CM_LIT(1.0) / k.k0) * ratio;
    return cm_copysign(CM_SELECT(outer, from_edge, a + a * ratio), w);
}

CM_FN CM_REAL CM_NAME(cm_tangent_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    if (CM_VARIANT(k))
    {
        return CM_NAME(cm_tangent_steep_inverse)(w, k);
    }
    CM_REAL excess = CM_NAME(cm_tan_excess)(k.k3 * (w * w));
    return CM_NAME(cm_stretch_inside)(w, (excess - k.k4) * k.k5);
}

CM_UNIVARIATE(cm_tangent_forward, cm_tangent_sigmoid, cm_tangent_inverse,
              cm_tangent_sigmoid_inverse)

/* (c / alpha) / (1 + c^2 w^2) */
CM_FN CM_REAL CM_NAME(cm_tangent_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(f);
    CM_REAL scale = k.k2;
    if (CM_VARIANT(k))
    {
        scale = CM_LIT(0.5) * k.k2;
    }
    return scale / (CM_LIT(1.0) + k.k0 * (w * w));
}

CM_UNIVARIATE_JACOBIAN(cm_tangent_jacobian, cm_tangent_slope)

#endif
