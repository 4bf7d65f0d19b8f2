/* SPDX-License-Identifier: MIT
 *
 * continuous: u = atan(p / sqrt 2) / atan(1 / sqrt 2), v = atan(q k) / atan k with
 * k = 1 / sqrt(1 + p^2): each coordinate is the tangent adjustment (tangent.h), with c = 1 / sqrt 2
 * for u and c = k(p) for v. The two coordinates are not alike: swapping p and q does not swap u and
 * v, except on the edges.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_ASYMMETRIC(continuous,
        .identifier = "continuous",
        .aliases = "",
        .name = "continuous cube",
        .source = "Grimm & Niebruegge 2007, Continuous cube mapping; Lambers 2020, eq. 4 (misprint "
                  "corrected)",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* those of tangent with c = 1 / sqrt 2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_continuous_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(0.70710678118654752440084436210484903928);
    return CM_NAME(cm_tangent_prepare)(k);
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_continuous_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL square = CM_LIT(1.0) / (CM_LIT(1.0) + p * p); /* of k(p) */
    CM_REAL edge = CM_NAME(cm_atan_excess)(square);
    CM_REAL excess = CM_NAME(cm_atan_excess)(square * (q * q));
    return CM_NAME(cm_make_uv)(
        CM_NAME(cm_tangent_sigmoid)(p, k),
        CM_NAME(cm_stretch_inside)(q, CM_NAME(cm_quotient)(excess - edge, CM_LIT(1.0) + edge)));
}

/* q = tan(alpha v) / k(p), where alpha / k(p) = 1 + E1 of atan and 1 / that is 1 + E1 of tan */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_continuous_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL p = CM_NAME(cm_tangent_sigmoid_inverse)(u, k);
    CM_REAL square = CM_LIT(1.0) / (CM_LIT(1.0) + p * p);
    CM_REAL edge = CM_NAME(cm_atan_excess)(square);
    CM_REAL ratio = CM_LIT(1.0) + edge;
    CM_REAL excess = CM_NAME(cm_tan_excess)(square * (ratio * ratio) * (v * v));
    return CM_NAME(cm_make_pq)(p, CM_NAME(cm_stretch_inside)(v, edge + ratio * excess));
}

/* u by p as in tangent.h. With s = 1 + p^2 and 1 + E1 = atan k / k,
 *     v_q = s / ((s + q^2)(1 + E1)),
 *     v_p = -p ((q - v) s + q (1 - q v)) / ((1 + E1)(s + q^2)(s + 1)),
 * where 1 - q v is taken from the edge; there v_p vanishes. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_continuous_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                           CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_REAL s = CM_LIT(1.0) + p * p;
    CM_REAL s1 = s + CM_LIT(1.0); /* 2 (1 + c^2 p^2) */
    CM_REAL ratio = CM_LIT(1.0) + CM_NAME(cm_atan_excess)(CM_LIT(1.0) / s);
    CM_REAL below = (s + q * q) * ratio;
    CM_REAL inverse_all = CM_LIT(1.0) / (below * s1);
    CM_REAL abs_q = cm_abs(q);
    CM_REAL from_edge = (CM_LIT(1.0) - abs_q) + abs_q * (CM_LIT(1.0) - cm_abs(v));
    return CM_NAME(cm_make_jacobian)((CM_LIT(2.0) * k.k2) * (inverse_all * below), CM_LIT(0.0),
                                     -((p * ((q - v) * s + q * from_edge)) * inverse_all),
                                     s * (inverse_all * s1));
}

#endif
