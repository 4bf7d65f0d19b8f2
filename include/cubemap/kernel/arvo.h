/* SPDX-License-Identifier: MIT
 *
 * arvo: Arvo's equal-area map of the cube's faces, u = unicube's function of p, and of the strip that has
 * this p the share below q,
 *     v = q sqrt(2 + p^2) / sqrt(1 + p^2 + q^2).
 * It is torn along four of the twelve edges, by up to 0.037 in u and v, and cannot be otherwise: along
 * the edges p = +-1 of a face it is v = q sqrt 3 / sqrt(2 + q^2), along the edges q = +-1 unicube, and of
 * the three directions of edges, each of which both of its neighbours must agree about, no two may be
 * alike. So it is for sampling, not for images. Which four is a matter of the frame, as u and v are the
 * frame's: in geo and fits those of top and bottom with right and left, parallel to the x axis; in gl
 * those of +y and -y with +x and -x, parallel to the z axis. In s2 there are six.
 *
 * With sin(pi u / 6) = p / sqrt(2 + 2 p^2) the printed inverse's cos(pi u / 3) is 1 / (1 + p^2).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_ASYMMETRIC(arvo,
        .identifier = "arvo",
        .aliases = "",
        .name = "Arvo's equal-area map, for sampling: torn along four of the twelve edges",
        .source = "Arvo 2001, Stratified sampling of 2-manifolds; Zucker & Higashi 2018 (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_TORN,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_arvo_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_arvo_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_REAL h = -CM_NAME(cm_quotient)(b, cm_mad(p, p, CM_LIT(2.0)));
    return CM_NAME(cm_make_uv)(CM_NAME(cm_unicube_sigmoid)(p, k), CM_NAME(cm_divide_by_root)(q, h));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_arvo_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL p = CM_NAME(cm_unicube_sigmoid_inverse)(u, k);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL h = CM_NAME(cm_quotient)(b, cm_mad(p, p, CM_LIT(1.0)));
    return CM_NAME(cm_make_pq)(p, CM_NAME(cm_divide_by_root)(v, h));
}

/* With h = sqrt(2 + p^2), n = sqrt(1 + p^2 + q^2): v_p = -p q (1 - q^2) / (h n^3),
 * v_q = h (1 + p^2) / n^3. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_arvo_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(v);
    CM_REAL x1 = CM_LIT(1.0) + p * p;
    CM_REAL square = x1 + q * q;
    CM_REAL h_square = CM_LIT(1.0) + x1;
    CM_REAL h = cm_sqrt(h_square);
    CM_REAL scale = CM_LIT(1.0) / (h * (square * cm_sqrt(square)));
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    return CM_NAME(cm_make_jacobian)(CM_NAME(cm_unicube_slope)(p, u, k), CM_LIT(0.0),
                                     -((p * q) * (b * scale)), (h_square * x1) * scale);
}

#endif
