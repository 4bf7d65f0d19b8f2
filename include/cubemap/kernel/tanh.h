/* SPDX-License-Identifier: MIT
 *
 * tanh: u = tanh(c p) / tanh c. 0.97218 is the c of least maximum area error
 * over 512 x 512 pixel centres.
 *
 * As in tangent.h both directions are w plus w times a difference that vanishes at the edge, made of
 * the excess of tanh or atanh. c > 1 is beyond the excess' domain: tanh x = 2 t / (1 + t^2) with
 * t = tanh(x / 2), and atanh y = 2 atanh(y / (1 + Q)) with Q = sqrt(1 - y^2).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(tanh,
                 .identifier = "tanh",
                 .aliases = "",
                 .name = "hyperbolic tangent sigmoid",
                 .source = "Lambers 2020, section 4.8",
                 .family = CM_FAMILY_UNIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {{.name = "c",
                                .meaning = "strength of the sigmoid; towards 0 it is gnomonic",
                                .standard = 0.97218,
                                .low = 0.0,
                                .low_excluded = 1,
                                .high = 2.0}},
                 .bounds = {.round_trip = 2.8, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                            .relative = 6},
                 .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* T = tanh c. k0 = c^2; k1, k2: excess of tanh at the edge and c / T; k3 = T^2; k4, k5: excess of
 * atanh at the edge and T / c. For c > 1, the variant, k0 is (c / 2)^2, k1 and k4 belong to the half
 * argument, k5 is 2 T / c; k6 = 1 - T^2. */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_tanh_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL c = k.k0;
    k.variant = CM_SELECT(cm_less(CM_LIT(1.0), c), CM_LIT(1.0), CM_LIT(0.0));
    CM_REAL part = CM_SELECT(cm_less(CM_LIT(1.0), c), CM_LIT(0.5) * c, c);
    k.k0 = part * part;
    k.k1 = CM_NAME(cm_tanh_excess)(k.k0);
    CM_REAL value = part + part * k.k1; /* tanh of the part */
    if (CM_VARIANT(k))
    {
        CM_REAL square = value * value;
        CM_REAL sech = (CM_LIT(1.0) - square) / (CM_LIT(1.0) + square);
        k.k2 = (CM_LIT(1.0) + square) / (CM_LIT(1.0) + k.k1);
        k.k6 = sech * sech;
        k.k3 = CM_LIT(1.0) - k.k6;
        k.k4 = CM_NAME(cm_atanh_excess)((CM_LIT(1.0) - sech) / (CM_LIT(1.0) + sech));
        k.k5 = CM_LIT(2.0) / k.k2;
    }
    else
    {
        k.k5 = CM_LIT(1.0) + k.k1;
        k.k2 = CM_LIT(1.0) / k.k5;
        k.k3 = value * value;
        k.k4 = CM_NAME(cm_atanh_excess)(k.k3);
    }
    return k;
}

/* Both squares are taken from the edge, where an error of theirs counts most. */
CM_FN CM_REAL CM_NAME(cm_tanh_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL z = k.k0 - k.k0 * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w));
    CM_REAL excess = CM_NAME(cm_tanh_excess)(z);
    CM_REAL d = (excess - k.k1) * k.k2;
    if (CM_VARIANT(k))
    {
        CM_REAL f = CM_LIT(1.0) + excess;
        CM_REAL f1 = CM_LIT(1.0) + k.k1;
        CM_REAL t2 = z * (f * f); /* of tanh of half the argument */
        d = (d + (k.k0 * (f1 * f1) - t2)) / (CM_LIT(1.0) + t2);
    }
    return CM_NAME(cm_stretch_inside)(w, d);
}

CM_FN CM_REAL CM_NAME(cm_tanh_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_REAL d;
    if (CM_VARIANT(k))
    {
        CM_REAL rest = k.k3 * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)); /* root^2 - root1^2 */
        CM_REAL root = cm_sqrt(k.k6 + rest);
        CM_REAL root1 = cm_sqrt(k.k6);
        CM_REAL scale = CM_LIT(1.0) / (CM_LIT(1.0) + root);
        CM_REAL excess = CM_NAME(cm_atanh_excess)((CM_LIT(1.0) - root) * scale);
        d = (k.k5 * (excess - k.k4) - rest / (root + root1)) * scale;
    }
    else
    {
        CM_REAL z = k.k3 - k.k3 * ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w));
        d = (CM_NAME(cm_atanh_excess)(z) - k.k4) * k.k5;
    }
    return CM_NAME(cm_stretch_inside)(w, d);
}

CM_UNIVARIATE(cm_tanh_forward, cm_tanh_sigmoid, cm_tanh_inverse, cm_tanh_sigmoid_inverse)

/* (c / T)(1 - T^2 f^2), with 1 - T^2 f^2 = (1 - T^2) + T^2 (1 - f^2) */
CM_FN CM_REAL CM_NAME(cm_tanh_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(w);
    CM_REAL at_edge = CM_LIT(1.0) - k.k3;
    if (CM_VARIANT(k))
    {
        at_edge = k.k6;
    }
    return k.k2 * (at_edge + k.k3 * ((CM_LIT(1.0) - f) * (CM_LIT(1.0) + f)));
}

CM_UNIVARIATE_JACOBIAN(cm_tanh_jacobian, cm_tanh_slope)

#endif
