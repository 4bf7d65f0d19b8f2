/* SPDX-License-Identifier: MIT
 *
 * difference: with t = u^2 / (1 - u^2), w = v^2 / (1 - v^2), x = p^2 / (1 - p^2), y = q^2 / (1 - q^2),
 *     x = kappa t (1 + l1 t + l2 w) / (1 + l1 (t + w)), and y by swapping,
 * so that x - y = kappa (t - w). Low anisotropy, smooth but at the eight corners of the cube.
 *
 * Forward: at fixed x - y that is one quadratic equation in t + w. The determinant of (x, y) by (t, w) is
 * kappa^2 (1 + (l2 - l1) z) with 0 <= z < 1 / l1, so it is positive for all kappa, l1, l2 > 0, which need
 * no relation. Both directions are multiplied out by the distances from the edges, 1 - p^2 and so on, so
 * that nothing is infinite at an edge; what is left is 0 / 0 at a corner. No function but the square root.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(difference,
        .identifier = "difference",
        .aliases = "",
        .name = "difference of squared tangents, low anisotropy",
        .source = "libcubemap 2026, docs/guide/new-mappings.md",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_C0,
        .parameter_count = 3,
        .parameter = {{.name = "kappa",
                       .meaning = "square of dp / du at the centre of a face",
                       .standard = 0.5916038587343118,
                       .low = 0.3,
                       .high = 1.0},
                      {.name = "l1",
                       .meaning = "kappa l2 / l1 is the square of dp / du amid an edge",
                       .standard = 0.2673678011834392,
                       .low = 0.125,
                       .high = 0.4},
                      {.name = "l2",
                       .meaning = "with l2 = l1 it is algebraic with c^2 = 1 / kappa - 1",
                       .standard = 0.4121738584515696,
                       .low = 0.2,
                       .high = 0.8}},
        .presets = "mild:kappa=0.5397097196288356,l1=0.1719858275482514,l2=0.2296337469790219 "
                   "balanced:kappa=0.5916038587343118,l1=0.2673678011834392,l2=0.4121738584515696 "
                   "isotropic:kappa=0.6435186283061214,l1=0.369772453776693,l2=0.6433367683885691",
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2.5, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = l1, k1 = l2, k2 = 1 / kappa, k3 = 1 / kappa - 1, k4 = l1 / kappa - l2, k5 = l1 / (kappa (l1 + l2)),
 * k6 = 1 / 2 - k5 */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_difference_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL kappa = k.k0;
    k.k0 = k.k1;
    k.k1 = k.k2;
    k.k2 = CM_LIT(1.0) / kappa;
    k.k3 = (CM_LIT(1.0) - kappa) / kappa;
    k.k4 = (k.k0 - kappa * k.k1) / kappa;
    k.k5 = k.k0 / (kappa * (k.k0 + k.k1));
    k.k6 = CM_LIT(0.5) - k.k5;
    return k;
}

/* With e = (1 - p^2)(1 - q^2), below = e (1 + l1 (t + w)) / kappa, and above_p + below is
 * e (1 + l1 t + l2 w), above_q the same with t and w swapped. */
CM_STRUCT(cm_difference_terms)
{
    CM_REAL below;
    CM_REAL above_p;
    CM_REAL above_q;
}
CM_STRUCT_END(cm_difference_terms)

/* From xs = e x, ys = e y. With C = l1 (x + y) / kappa - 1 the root is
 * (l1 + l2)(t + w) = C + sqrt(C^2 + ...), where what stands below the square root is written as a sum of
 * what is not negative. It is 0 at a corner, where the terms are any that are finite. */
CM_FN CM_NAME(cm_difference_terms)
    CM_NAME(cm_difference_solve)(CM_REAL xs, CM_REAL ys, CM_REAL e, CM_NAME(cm_constants) k)
{
    CM_REAL sum = xs + ys;
    CM_REAL difference = xs - ys;
    CM_REAL l1 = k.k0 * k.k2;
    CM_REAL l2 = k.k1 * k.k2;
    CM_REAL ends = cm_mad(l2 * l2, difference * difference, (CM_LIT(4.0) * (l1 * l1)) * (xs * ys));
    CM_REAL radicand = cm_mad(e, cm_mad(CM_LIT(2.0) * l2, sum, e), ends);
    CM_REAL root =
        CM_NAME(cm_root)(CM_SELECT(cm_less(CM_LIT(0.0), radicand), radicand, CM_LIT(1.0)));
    CM_REAL scaled = cm_mad(l1, sum, root - e);
    CM_REAL mean = cm_mad(k.k6, scaled, -(k.k3 * e));
    CM_REAL bias = CM_LIT(0.5) * (l2 - l1);
    CM_NAME(cm_difference_terms) r;
    r.below = cm_mad(k.k5, scaled, k.k2 * e);
    r.above_p = cm_mad(-bias, difference, mean);
    r.above_q = cm_mad(bias, difference, mean);
    return r;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_difference_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_NAME(cm_difference_terms) r =
        CM_NAME(cm_difference_solve)((p * p) * b, (q * q) * a, a * b, k);
    return CM_NAME(cm_make_uv)(
        CM_NAME(cm_divide_by_root)(p, CM_NAME(cm_quotient)(a * r.above_p, r.below)),
        CM_NAME(cm_divide_by_root)(q, CM_NAME(cm_quotient)(b * r.above_q, r.below)));
}

/* p = u / sqrt(1 + a (d / n - 1)), where n = a b + l1 A b + l2 B a, d = (a b + l1 (A b + B a)) / kappa and
 * A = u^2, a = 1 - A, B = v^2, b = 1 - B. */
CM_FN CM_REAL CM_NAME(cm_difference_ratio)(CM_REAL a, CM_REAL own, CM_REAL other, CM_REAL ab,
                                           CM_NAME(cm_constants) k)
{
    CM_REAL part = cm_mad(k.k0, own, ab);
    CM_REAL n = cm_mad(k.k1, other, part);
    return CM_NAME(cm_quotient)(a * cm_mad(k.k4, other, k.k3 * part),
                                CM_SELECT(cm_less(CM_LIT(0.0), n), n, CM_LIT(1.0)));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_difference_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL ab = a * b;
    CM_REAL u_part = (u * u) * b;
    CM_REAL v_part = (v * v) * a;
    return CM_NAME(cm_make_pq)(
        CM_NAME(cm_divide_by_root)(u, CM_NAME(cm_difference_ratio)(a, u_part, v_part, ab, k)),
        CM_NAME(cm_divide_by_root)(v, CM_NAME(cm_difference_ratio)(b, v_part, u_part, ab, k)));
}

/* With m = l2 - l1, alpha = t (1 + l1 t) / (1 + l1 (t + w))^2, beta the same of w, and
 * delta = 1 + m (alpha + beta), the matrix of (t, w) by (x, y) is
 *     (1 + m alpha, -m alpha; -m beta, 1 + m beta) / (kappa delta).
 * By (p, q), with g = x / t, h = y / w and z = p^2 + (1 - p^2) g, which is (p / u)^2, all is finite at the
 * edges. At a corner it depends on where one comes from; there it is the limit along the diagonal. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_difference_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                           CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL a = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_BOOL corner = cm_equal(a + b, CM_LIT(0.0));
    CM_REAL from_p = CM_SELECT(corner, CM_LIT(1.0), a);
    CM_REAL from_q = CM_SELECT(corner, CM_LIT(1.0), b);
    CM_NAME(cm_difference_terms) r = CM_NAME(cm_difference_solve)(x * from_q, y * from_p, a * b, k);
    CM_REAL scale = CM_LIT(1.0) / r.below;
    CM_REAL g = CM_LIT(1.0) + r.above_p * scale;
    CM_REAL h = CM_LIT(1.0) + r.above_q * scale;
    CM_REAL gg = g * g;
    CM_REAL hh = h * h;
    CM_REAL p_part = a * g + k.k0 * x;
    CM_REAL q_part = b * h + k.k0 * y;
    CM_REAL m = k.k1 - k.k0;
    CM_REAL near_p = from_p * (scale * k.k2);
    CM_REAL near_q = from_q * (scale * k.k2);
    CM_REAL p_cross = m * (near_p * near_p) * p_part;
    CM_REAL q_cross = m * (near_q * near_q) * q_part;
    /* m alpha g^2 and m beta h^2 */
    CM_REAL alpha = m * (near_q * near_q) * p_part * x;
    CM_REAL beta = m * (near_p * near_p) * q_part * y;
    CM_REAL gghh = gg * hh;
    CM_REAL factor = k.k2 * gghh / (gghh + (alpha * hh + beta * gg));
    CM_REAL z_p = x + a * g;
    CM_REAL z_q = y + b * h;
    CM_REAL p_power = factor / (z_p * cm_sqrt(z_p));
    CM_REAL q_power = factor / (z_q * cm_sqrt(z_q));
    return CM_NAME(cm_make_jacobian)((gg + alpha) * p_power, -(p * q * p_cross * p_power),
                                     -(p * q * q_cross * q_power), (hh + beta) * q_power);
}

#endif
