/* SPDX-License-Identifier: MIT
 *
 * gnomonic: the cube map of graphics hardware; the face is not warped at all.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(gnomonic,
        .identifier = "gnomonic",
        .aliases = "tsc standard",
        .name = "gnomonic, the standard cube map",
        .source = "Greene 1986, Environment Mapping; Calabretta & Greisen 2002, TSC",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 1.4, .plane_round_trip = 1.5, .forward = 0.5, .inverse = 2.3,
                   .relative = 3.5})
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_gnomonic_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_gnomonic_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_make_uv)(p, q);
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_gnomonic_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_make_pq)(u, v);
}

CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_gnomonic_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v,
                                                         CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_UNUSED(k);
    return CM_NAME(cm_make_jacobian)(CM_LIT(1.0), CM_LIT(0.0), CM_LIT(0.0), CM_LIT(1.0));
}

#endif
