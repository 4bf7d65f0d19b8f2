/* SPDX-License-Identifier: MIT
 *
 * coupled: the algebraic sigmoid whose constant depends on the other coordinate,
 * p = u / sqrt(1 + (1 - u^2)(g0 + g1 v^2)), and q by swapping. Area error 0.25 % at most
 * (over 512 x 512 pixel centres), no crease. The recommended default.
 *
 * Forward: with X = p^2, Y = q^2, A = u^2, B = v^2 the inverse says
 * X (1 + (1 - A)(g0 + g1 B)) = A and the same with X, Y and A, B swapped. Both are bilinear in A and B,
 * and what is left is one quadratic equation, with the solution A = 2 alpha / R, B = 2 beta / R. No
 * function but the square root, so the result is the same wherever +, -, *, / and sqrt round
 * correctly and are not contracted.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(coupled,
        .identifier = "coupled",
        .aliases = "",
        .name = "coupled algebraic sigmoid, the recommended default",
        .source = "libcubemap 2026, docs/guide/mappings.md",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = g0, k1 = g1, k2 = K = 1 + g0, k3 = s = g0 + g1, k4 = 4 g1 / K, k5 = 2 g1 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_coupled_prepare)(CM_NAME(cm_constants) k)
{
    k.k0 = CM_LIT(0.9063);
    k.k1 = CM_LIT(-0.2559);
    k.k2 = CM_LIT(1.9063);
    k.k3 = CM_LIT(0.6504);
    k.k4 = CM_LIT(4.0) * k.k1 / k.k2;
    k.k5 = CM_LIT(2.0) * k.k1;
    return k;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_coupled_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL delta = cm_mad(cm_mad(k.k0, x, CM_LIT(1.0)), cm_mad(k.k0, y, CM_LIT(1.0)),
                           -((k.k1 * x) * (k.k1 * y)));
    CM_REAL alpha = k.k2 * x * cm_mad(k.k3, y, CM_LIT(1.0));
    CM_REAL beta = k.k2 * y * cm_mad(k.k3, x, CM_LIT(1.0));
    CM_REAL r = delta + cm_sqrt(cm_mad(k.k4, alpha * beta, delta * delta));
    CM_REAL g0r = k.k0 * r;
    CM_REAL n = cm_mad(k.k5, beta, g0r);
    CM_REAL m = cm_mad(k.k5, alpha, g0r);
    CM_REAL a = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    return CM_NAME(cm_make_uv)(CM_NAME(cm_times_root_of_ratio)(p, r + n, cm_mad(x, n, r), a * n),
                               CM_NAME(cm_times_root_of_ratio)(q, r + m, cm_mad(y, m, r), b * m));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_coupled_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL g = a * cm_mad(k.k1, v * v, k.k0);
    CM_REAL h = b * cm_mad(k.k1, u * u, k.k0);
    return CM_NAME(cm_make_pq)(CM_NAME(cm_divide_by_root)(u, g), CM_NAME(cm_divide_by_root)(v, h));
}

/* With G = g0 + g1 v^2, H = g0 + g1 u^2, g = 1 + (1 - u^2) G, h = 1 + (1 - v^2) H the inverse is
 * p = u g^(-1/2), q = v h^(-1/2), and p_u = (1 + G) g^(-3/2), p_v = -g1 u v (1 - u^2) g^(-3/2); that
 * matrix is inverted. Its determinant is far from 0. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_coupled_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v,
                                                        CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL capital_g = k.k0 + k.k1 * (v * v);
    CM_REAL capital_h = k.k0 + k.k1 * (u * u);
    CM_REAL g = CM_LIT(1.0) + a * capital_g;
    CM_REAL h = CM_LIT(1.0) + b * capital_h;
    CM_REAL cross = k.k1 * (u * v);
    CM_REAL cross_a = a * cross;
    CM_REAL cross_b = b * cross;
    CM_REAL g1 = CM_LIT(1.0) + capital_g;
    CM_REAL h1 = CM_LIT(1.0) + capital_h;
    CM_REAL scale = CM_LIT(1.0) / (g1 * h1 - cross_a * cross_b);
    CM_REAL g_power = (g * cm_sqrt(g)) * scale;
    CM_REAL h_power = (h * cm_sqrt(h)) * scale;
    return CM_NAME(cm_make_jacobian)(h1 * g_power, cross_a * h_power, cross_b * g_power,
                                     g1 * h_power);
}

#endif
