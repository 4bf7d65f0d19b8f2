/* SPDX-License-Identifier: MIT
 *
 * outerra: the spherical cube of the Outerra engine. The two sides of a texel are within 0.6 % of
 * each other everywhere (0.994 to 1.006; their angle varies). Its forward direction has no closed
 * form.
 *
 * Inverse: p = u / Z, q = v / Z with Z = 1 + M (1 - u^2)(1 - v^2). Forward: u = p Z, v = q Z, where
 * e = Z - 1 solves e = M (1 - p^2 Z^2)(1 - q^2 Z^2). The paper's Newton iteration works on Z and on
 * sqrt(1 - x^2 - y^2), which costs digits; this one works on e, with 1 - p^2 Z^2 as
 * (1 - p^2) - p^2 e (2 + e), which is exact where p = 1.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(outerra,
        .identifier = "outerra",
        .aliases = "osc",
        .name = "Outerra spherical cube",
        .source = "Kemen & Hrabcak 2014; Dimitrijevic, Lambers, Rancic 2016, section 4.3",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = M = (sqrt 2 - 1) / 2 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_outerra_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(0.20710678118654752440084436210484903928);
    return k;
}

/* One Newton step on e - M a b, where a = 1 - p^2 Z^2 and b = 1 - q^2 Z^2. x = p^2, y = q^2,
 * a0 = 1 - p^2, b0 = 1 - q^2. */
CM_FN CM_REAL CM_NAME(cm_outerra_step)(CM_REAL e, CM_REAL x, CM_REAL y, CM_REAL a0, CM_REAL b0,
                                       CM_REAL m)
{
    CM_REAL z1 = e * (CM_LIT(2.0) + e); /* Z^2 - 1 */
    CM_REAL a = cm_mad(-x, z1, a0);
    CM_REAL b = cm_mad(-y, z1, b0);
    CM_REAL slope = cm_mad(CM_LIT(2.0) * m * (CM_LIT(1.0) + e), x * b + y * a, CM_LIT(1.0));
    return e - cm_mad(-m, a * b, e) / slope;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_outerra_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL a0 = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b0 = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    /* The first step, from e = 0, leaves 9e-4; the next ones 5e-8, 1e-16 and rounding. */
    CM_REAL e = k.k0 * (a0 * b0) / (CM_LIT(1.0) + CM_LIT(2.0) * k.k0 * (x * b0 + y * a0));
    e = CM_NAME(cm_outerra_step)(e, x, y, a0, b0, k.k0);
    e = CM_NAME(cm_outerra_step)(e, x, y, a0, b0, k.k0);
#if CM_REAL_BITS >= 64
    e = CM_NAME(cm_outerra_step)(e, x, y, a0, b0, k.k0);
#endif
#if CM_REAL_BITS > 64
    e = CM_NAME(cm_outerra_step)(e, x, y, a0, b0, k.k0);
#endif
    return CM_NAME(cm_make_uv)(CM_NAME(cm_stretch)(p, e), CM_NAME(cm_stretch)(q, e));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_outerra_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL z = cm_mad(k.k0, a * b, CM_LIT(1.0));
    return CM_NAME(cm_make_pq)(u / z, v / z);
}

/* The inverse's is (I - w g / Z) / Z with the column w = (u, v) and the row g of Z's derivatives; that
 * of rank one is inverted in closed form, Z (I + w g / (Z - g w)). All terms of the denominator are
 * positive. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_outerra_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v,
                                                        CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL m2 = CM_LIT(2.0) * k.k0;
    CM_REAL z = CM_LIT(1.0) + k.k0 * (a * b);
    CM_REAL along_u = m2 * ((u * u) * b); /* minus u Z_u */
    CM_REAL along_v = m2 * ((v * v) * a);
    CM_REAL scale = z / (z + (along_u + along_v));
    CM_REAL cross = (m2 * (u * v)) * scale;
    return CM_NAME(cm_make_jacobian)((z + along_v) * scale, -(a * cross), -(b * cross),
                                     (z + along_u) * scale);
}

#endif
