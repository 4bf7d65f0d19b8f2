/* SPDX-License-Identifier: MIT
 *
 * corner: keeps rays from a face's corner, between two algebraic sigmoids. With
 *     x = (1 - p^2) / (1 + c1 p^2),  t = (1 + c2) (1 - u^2) / (1 + c2 (1 - u^2)),
 * which are 1 on the middle line and 0 on the edge, y and w the same of q and v, A = 1 - t, B = 1 - w it is
 *     (x, y) = (t, w) L / (L + (l2 - l1) A B),  L = 1 + l1 (A + B).
 *
 * Along a ray that is one quadratic equation. Its right side grows along each ray, for
 * 1 + (l2 - l1) z > 0 with 0 <= z <= 1 / (1 + l1), so that all c1, c2 > -1 and l1, l2 >= 0 are invertible and
 * need no relation. With l1 = l2 it is algebraic, 1 + c^2 = (1 + c1) (1 + c2). Analytic on the whole
 * face, its corners too. No function but the square root.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(corner,
        .identifier = "corner",
        .aliases = "",
        .name = "rays from the corners between two algebraic sigmoids",
        .source = "libcubemap 2026, docs/guide/new-mappings.md",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .parameter_count = 4,
        .parameter = {{.name = "c1",
                       .meaning = "of the sigmoid of p and q",
                       .standard = -0.7843960514016151,
                       .low = -0.85,
                       .high = -0.5},
                      {.name = "c2",
                       .meaning = "of that of u and v; dp / du at an edge's middle is (1 + c1)(1 + c2)",
                       .standard = 7.206457850248514,
                       .low = 2.0,
                       .high = 8.0},
                      {.name = "l1",
                       .meaning = "strength along rays, of a coordinate itself",
                       .standard = 1.56584381120113,
                       .low = 0.5,
                       .high = 3.0},
                      {.name = "l2",
                       .meaning = "the same of the other coordinate; l2 = l1 is algebraic",
                       .standard = 1.999763507550025,
                       .low = 0.5,
                       .high = 3.0}},
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 3, .inverse = 3,
                   .relative = 7},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* k0 = 1 + c1, k1 = c2, k2 = l1, k3 = l2, k4 = K - 1, k5 = K l1 - l2, k6 = 1 + l1 + l2, where
 * K = (1 + c1) (1 + c2) */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_corner_prepare)(CM_NAME(cm_constants) k)
{
    k.k4 = k.k0 + k.k1 + k.k0 * k.k1;
    k.k0 = CM_LIT(1.0) + k.k0;
    k.k5 = (k.k2 - k.k3) + k.k4 * k.k2;
    k.k6 = CM_LIT(1.0) + (k.k2 + k.k3);
    return k;
}

/* 1 + c1 p^2 is a sum of what is not negative, too, 1 + c1 - c1 (1 - p^2), as c1 < 0. Multiplied out by
 * f = (1 + c1 p^2)(1 + c1 q^2), with r = the sum of (1 + c1) p^2 (1 + c1 q^2) and its
 * swap, 2 f - r = s, which is f (x + y), and e = f (x - y): what stands below the square root is a sum of
 * what is not negative, R is the root, and
 *     (p / u)^2 = 1 + (1 - p^2)(n / d - 1),  n = (1 + l1 + l2)(R + f + l1 r + (l2 - l1) e),
 *     d = K ((1 + 2 l1) R + f + l2 s + 2 l1 (1 + l1) r). */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_corner_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL a = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_REAL own = k.k2 * (CM_LIT(1.0) + k.k2);
    CM_REAL f_p = cm_mad(CM_LIT(1.0) - k.k0, a, k.k0);
    CM_REAL f_q = cm_mad(CM_LIT(1.0) - k.k0, b, k.k0);
    CM_REAL f = f_p * f_q;
    CM_REAL r_p = (k.k0 * x) * f_q;
    CM_REAL r_q = (k.k0 * y) * f_p;
    CM_REAL r = r_p + r_q;
    CM_REAL s = CM_LIT(2.0) * f - r;
    CM_REAL e = k.k0 * (y - x);
    CM_REAL ends = cm_mad((k.k3 * (CM_LIT(1.0) + k.k3)) * e, e, (CM_LIT(4.0) * own) * (r_p * r_q));
    CM_REAL root = CM_NAME(cm_root)(cm_mad(k.k3 * s, r, cm_mad(f, f, ends)));
    CM_REAL root_part = CM_LIT(1.0) + CM_LIT(2.0) * k.k2;
    CM_REAL capital_k = CM_LIT(1.0) + k.k4;
    CM_REAL d =
        capital_k * cm_mad(root_part, root, cm_mad(k.k3, s, cm_mad(CM_LIT(2.0) * own, r, f)));
    CM_REAL rest = cm_mad(k.k6 - capital_k * root_part, root,
                          cm_mad(k.k6 - capital_k * (CM_LIT(1.0) + CM_LIT(2.0) * k.k3), f,
                                 (k.k6 * k.k2 - capital_k * (CM_LIT(2.0) * own - k.k3)) * r));
    CM_REAL turn = k.k6 * (k.k3 - k.k2);
    return CM_NAME(cm_make_uv)(
        CM_NAME(cm_divide_by_root)(p, CM_NAME(cm_quotient)(a * cm_mad(turn, e, rest), d)),
        CM_NAME(cm_divide_by_root)(q, CM_NAME(cm_quotient)(b * cm_mad(-turn, e, rest), d)));
}

/* p = u / sqrt(1 + a (d / n - 1)), where with A = u^2 (1 + c2 b), B its swap and
 * E = (1 + c2 a)(1 + c2 b): n = E + l1 A + l2 B, d = K (E + l1 (A + B)); a = 1 - u^2, b = 1 - v^2 */
CM_FN CM_REAL CM_NAME(cm_corner_ratio)(CM_REAL a, CM_REAL own, CM_REAL other, CM_REAL e,
                                       CM_NAME(cm_constants) k)
{
    CM_REAL part = cm_mad(k.k2, own, e);
    return CM_NAME(cm_quotient)(a * cm_mad(k.k5, other, k.k4 * part), cm_mad(k.k3, other, part));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_corner_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL e_u = cm_mad(k.k1, a, CM_LIT(1.0));
    CM_REAL e_v = cm_mad(k.k1, b, CM_LIT(1.0));
    CM_REAL e = e_u * e_v;
    CM_REAL u_part = (u * u) * e_v;
    CM_REAL v_part = (v * v) * e_u;
    return CM_NAME(cm_make_pq)(
        CM_NAME(cm_divide_by_root)(u, CM_NAME(cm_corner_ratio)(a, u_part, v_part, e, k)),
        CM_NAME(cm_divide_by_root)(v, CM_NAME(cm_corner_ratio)(b, v_part, u_part, e, k)));
}

/* With m = l2 - l1, G = L + m A B and H = L G + m (t B (1 + l1 B) + w A (1 + l1 A)), which is far from 0,
 * the matrix of (t, w) by (x, y) is
 *     (L G + m w A (1 + l1 A), -m t A (1 + l1 A); -m w B (1 + l1 B), L G + m t B (1 + l1 B)) G / (L H). */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_corner_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL c2 = CM_LIT(1.0) + k.k1;
    CM_REAL e_u = CM_LIT(1.0) + k.k1 * a;
    CM_REAL e_v = CM_LIT(1.0) + k.k1 * b;
    CM_REAL capital_a = (u * u) / e_u;
    CM_REAL capital_b = (v * v) / e_v;
    CM_REAL m = k.k3 - k.k2;
    CM_REAL l = CM_LIT(1.0) + k.k2 * (capital_a + capital_b);
    CM_REAL lg = l * (l + m * (capital_a * capital_b));
    CM_REAL m_a = m * (CM_LIT(1.0) + k.k2 * capital_a);
    CM_REAL m_b = m * (CM_LIT(1.0) + k.k2 * capital_b);
    CM_REAL t_part = (c2 * a / e_u) * capital_b * m_b;
    CM_REAL w_part = (c2 * b / e_v) * capital_a * m_a;
    CM_REAL factor = k.k0 * lg / (l * l * (lg + (t_part + w_part)));
    /* z is (p / u)^2; from it and 1 - p^2 follows a, which 1 - u^2 gives less accurately beside an edge */
    CM_REAL kl = (CM_LIT(1.0) + k.k4) * l;
    CM_REAL n = l + m * capital_b;
    CM_REAL o = l + m * capital_a;
    CM_REAL z_p = u * u + a * (kl / n);
    CM_REAL z_q = v * v + b * (kl / o);
    CM_REAL a_p = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b_q = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_REAL from_p = a_p * (z_p * n / kl);
    CM_REAL from_q = b_q * (z_q * o / kl);
    CM_REAL f_p = k.k0 + (CM_LIT(1.0) - k.k0) * a_p;
    CM_REAL f_q = k.k0 + (CM_LIT(1.0) - k.k0) * b_q;
    CM_REAL x_scale = factor / (f_p * f_p);
    CM_REAL y_scale = factor / (f_q * f_q);
    return CM_NAME(cm_make_jacobian)(((e_u * e_u) / c2) * (lg + w_part) * x_scale / cm_sqrt(z_p),
                                     -(u * q * (from_p * m_a) * y_scale),
                                     -(p * v * (from_q * m_b) * x_scale),
                                     ((e_v * e_v) / c2) * (lg + t_part) * y_scale / cm_sqrt(z_q));
}

#endif
