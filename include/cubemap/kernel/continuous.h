/* SPDX-License-Identifier: MIT
 *
 * continuous: u = atan(p / sqrt 2) / atan(1 / sqrt 2), v = atan(q k) / atan k with
 * k = 1 / sqrt(1 + p^2): each coordinate is the tangent adjustment (tangent.h), with c = 1 / sqrt 2
 * for u and c = k(p) for v. The two coordinates are not alike: swapping p and q does not swap u and
 * v, except on the edges.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(continuous,
        .aliases = "",
        .name = "continuous cube",
        .source = "Grimm & Niebruegge 2007, Continuous cube mapping; Lambers 2020, eq. 4 (misprint "
                  "corrected)",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0)
/* clang-format on */
#else

/* those of tangent with c = 1 / sqrt 2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_continuous_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(0.70710678118654752440084436210485);
    return CM_NAME(cm_tangent_prepare)(k);
}

/* those of tangent with c = k(p) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_continuous_across)(CM_REAL p, CM_NAME(cm_constants) k)
{
    CM_REAL root = cm_sqrt(CM_LIT(1.0) + p * p);
    k.k0 = CM_LIT(1.0) / root;
    k.k3 = k.k0 + root;
    k.k1 = CM_NAME(cm_atan_unit)(k.k0);
    k.k2 = CM_LIT(1.0) / k.k1;
    return k;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_continuous_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_NAME(cm_constants) across = CM_NAME(cm_continuous_across)(p, k);
    return CM_NAME(cm_make_uv)(CM_NAME(cm_tangent_sigmoid)(p, k),
                               CM_NAME(cm_tangent_sigmoid)(q, across));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_continuous_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL p = CM_NAME(cm_tangent_sigmoid_inverse)(u, k);
    CM_NAME(cm_constants) across = CM_NAME(cm_continuous_across)(p, k);
    return CM_NAME(cm_make_pq)(p, CM_NAME(cm_tangent_sigmoid_inverse)(v, across));
}

#endif
