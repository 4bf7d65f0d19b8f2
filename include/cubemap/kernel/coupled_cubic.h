/* SPDX-License-Identifier: MIT
 *
 * coupled-cubic: coupled with a cubic polynomial in place of its linear one,
 *     p = u / sqrt(1 + (1 - u^2) C(u^2, v^2)), and q by swapping.
 * Two sets of coefficients, both analytic on a face: minimax is equal-area to 1e-5, low has less anisotropy
 * and is equal-area to 1e-3.
 *
 * Forward: with A = u^2, B = v^2, X = p^2, Y = q^2 the inverse says A - X = X (1 - A) C(A, B) and the same
 * swapped. Newton's method solves that from A = X (1 + S) / (1 + X S) with a cubic S(X, Y), which is within
 * 3e-4. What u needs of A and B is C alone, and the last step gives that without another evaluation.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(coupled_cubic,
                 .identifier = "coupled-cubic",
                 .aliases = "",
                 .name = "coupled with a cubic, equal-area to 1e-5",
                 .source = "libcubemap 2026, docs/guide/new-mappings.md",
                 .family = CM_FAMILY_BIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {{.name = "low",
                                .meaning = "1 for low anisotropy, 0 for the least error of area",
                                .standard = 0.0,
                                .low = 0.0,
                                .high = 1.0,
                                .whole = 1}},
                 .presets = "minimax:low=0 low:low=1",
                 .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                            .relative = 6},
                 .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* the variant is low */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_coupled_cubic_prepare)(CM_NAME(cm_constants) k)
{
    k.variant = k.k0;
    return k;
}

/* C(x, y) and its derivatives. */
CM_STRUCT(cm_cubic_value)
{
    CM_REAL c;
    CM_REAL c_x;
    CM_REAL c_y;
}
CM_STRUCT_END(cm_cubic_value)

/* the coefficient of minimax, that of low */
#define CM_CUBIC(minimax, low) (CM_VARIANT(k) ? CM_LIT(low) : CM_LIT(minimax))

/* that of C at x^i y^j */
#define CM_CUBIC_C00 CM_CUBIC(0.9098405570800077, 0.9098006918074089)
#define CM_CUBIC_C01 CM_CUBIC(-0.25200055403364013, -0.014440177096706407)
#define CM_CUBIC_C02 CM_CUBIC(-0.006793837188228254, -0.2720293715475414)
#define CM_CUBIC_C03 CM_CUBIC(0.0008166993710041565, -0.1771184441854385)
#define CM_CUBIC_C10 CM_CUBIC(-0.0059273537070956865, -0.08026548265473071)
#define CM_CUBIC_C11 CM_CUBIC(-0.014339236092076473, 0.2831352712420821)
#define CM_CUBIC_C12 CM_CUBIC(0.01804629142667412, -0.0534646441472911)
#define CM_CUBIC_C20 CM_CUBIC(-0.0005138041978771193, -0.05543463202145572)
#define CM_CUBIC_C21 CM_CUBIC(0.00034920776357544, 0.10009575372450351)
#define CM_CUBIC_C30 CM_CUBIC(-1.5703108476876904e-05, 0.00845018826557409)

/* that of S */
#define CM_CUBIC_S00 CM_CUBIC(0.9087823574290569, 0.9072758743528356)
#define CM_CUBIC_S01 CM_CUBIC(-0.4548865435557068, -0.02264122036958613)
#define CM_CUBIC_S02 CM_CUBIC(0.2845562602542851, -0.8099400762148176)
#define CM_CUBIC_S03 CM_CUBIC(-0.08686420147559268, 0.37443284253097187)
#define CM_CUBIC_S10 CM_CUBIC(-0.007742106291603962, -0.14431472034097603)
#define CM_CUBIC_S11 CM_CUBIC(0.02508236784635487, 0.6921296509626185)
#define CM_CUBIC_S12 CM_CUBIC(-0.020995988198228163, -0.33108682865100997)
#define CM_CUBIC_S20 CM_CUBIC(0.0025078010671352458, 0.020206043824844675)
#define CM_CUBIC_S21 CM_CUBIC(-0.0011762852034773244, -0.02582252303996939)
#define CM_CUBIC_S30 CM_CUBIC(-0.000889443441838271, -0.012840638155452295)

CM_FN CM_NAME(cm_cubic_value)
    CM_NAME(cm_cubic_evaluate)(CM_REAL x, CM_REAL y, CM_NAME(cm_constants) k)
{
    CM_REAL c30 = CM_CUBIC_C30;
    CM_REAL c21 = CM_CUBIC_C21;
    CM_REAL c12 = CM_CUBIC_C12;
    CM_REAL c03 = CM_CUBIC_C03;
    CM_REAL c20 = CM_CUBIC_C20;
    CM_REAL c10 = CM_CUBIC_C10;
    CM_REAL c11 = CM_CUBIC_C11;
    CM_REAL row0 = cm_mad(x, cm_mad(x, cm_mad(x, c30, c20), c10), CM_CUBIC_C00);
    CM_REAL row1 = cm_mad(x, cm_mad(x, c21, c11), CM_CUBIC_C01);
    CM_REAL row2 = cm_mad(x, c12, CM_CUBIC_C02);
    CM_REAL slope0 = cm_mad(x, cm_mad(x, CM_LIT(3.0) * c30, CM_LIT(2.0) * c20), c10);
    CM_REAL slope1 = cm_mad(x, CM_LIT(2.0) * c21, c11);
    CM_NAME(cm_cubic_value) r;
    r.c = cm_mad(y, cm_mad(y, cm_mad(y, c03, row2), row1), row0);
    r.c_x = cm_mad(y, cm_mad(y, c12, slope1), slope0);
    r.c_y = cm_mad(y, cm_mad(y, CM_LIT(3.0) * c03, CM_LIT(2.0) * row2), row1);
    return r;
}

/* u^2 from S */
CM_FN CM_REAL CM_NAME(cm_cubic_first)(CM_REAL x, CM_REAL s)
{
    CM_REAL xs = x * s;
    return CM_NAME(cm_quotient)(x + xs, CM_LIT(1.0) + xs);
}

/* The first approximation of u^2. */
CM_FN CM_REAL CM_NAME(cm_cubic_start)(CM_REAL x, CM_REAL y, CM_NAME(cm_constants) k)
{
    CM_REAL row0 =
        cm_mad(x, cm_mad(x, cm_mad(x, CM_CUBIC_S30, CM_CUBIC_S20), CM_CUBIC_S10), CM_CUBIC_S00);
    CM_REAL row1 = cm_mad(x, cm_mad(x, CM_CUBIC_S21, CM_CUBIC_S11), CM_CUBIC_S01);
    CM_REAL row2 = cm_mad(x, CM_CUBIC_S12, CM_CUBIC_S02);
    return CM_NAME(cm_cubic_first)(x,
                                   cm_mad(y, cm_mad(y, cm_mad(y, CM_CUBIC_S03, row2), row1), row0));
}

/* u^2 and v^2, and there C(u^2, v^2) and C(v^2, u^2), to first order. */
CM_STRUCT(cm_cubic_step)
{
    CM_REAL a;
    CM_REAL b;
    CM_REAL c;
    CM_REAL d;
}
CM_STRUCT_END(cm_cubic_step)

/* One Newton step from (a, b), where C is f, and with a and b swapped g. What C is does not matter here and
 * below: coupled-lean has another. */
CM_FN CM_NAME(cm_cubic_step)
    CM_NAME(cm_cubic_solve)(CM_REAL x, CM_REAL y, CM_REAL a, CM_REAL b, CM_NAME(cm_cubic_value) f,
                            CM_NAME(cm_cubic_value) g)
{
    CM_REAL x1 = x * (CM_LIT(1.0) - a);
    CM_REAL y1 = y * (CM_LIT(1.0) - b);
    CM_REAL f_rest = cm_mad(x1, f.c, x - a);
    CM_REAL g_rest = cm_mad(y1, g.c, y - b);
    CM_REAL f_a = cm_mad(x, f.c, cm_mad(-x1, f.c_x, CM_LIT(1.0)));
    CM_REAL g_b = cm_mad(y, g.c, cm_mad(-y1, g.c_x, CM_LIT(1.0)));
    CM_REAL f_b = x1 * f.c_y;
    CM_REAL g_a = y1 * g.c_y;
    CM_REAL determinant = f_a * g_b - f_b * g_a;
    CM_REAL a_step = CM_NAME(cm_quotient)(cm_mad(f_rest, g_b, g_rest * f_b), determinant);
    CM_REAL b_step = CM_NAME(cm_quotient)(cm_mad(g_rest, f_a, f_rest * g_a), determinant);
    CM_NAME(cm_cubic_step) r;
    r.a = a + a_step;
    r.b = b + b_step;
    r.c = cm_mad(f.c_x, a_step, cm_mad(f.c_y, b_step, f.c));
    r.d = cm_mad(g.c_x, b_step, cm_mad(g.c_y, a_step, g.c));
    return r;
}

/* u = p sqrt((1 + C) / (1 + X C)), v likewise */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_cubic_finish)(CM_REAL p, CM_REAL q, CM_NAME(cm_cubic_step) r)
{
    CM_REAL a = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL b = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    return CM_NAME(cm_make_uv)(
        CM_NAME(cm_divide_by_root)(p, -CM_NAME(cm_quotient)(a * r.c, CM_LIT(1.0) + r.c)),
        CM_NAME(cm_divide_by_root)(q, -CM_NAME(cm_quotient)(b * r.d, CM_LIT(1.0) + r.d)));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_cubic_unwarp)(CM_REAL u, CM_REAL v, CM_REAL c, CM_REAL d)
{
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    return CM_NAME(cm_make_pq)(CM_NAME(cm_divide_by_root)(u, a * c),
                               CM_NAME(cm_divide_by_root)(v, b * d));
}

CM_FN CM_NAME(cm_cubic_step)
    CM_NAME(cm_cubic_newton)(CM_REAL x, CM_REAL y, CM_REAL a, CM_REAL b, CM_NAME(cm_constants) k)
{
    return CM_NAME(cm_cubic_solve)(x, y, a, b, CM_NAME(cm_cubic_evaluate)(a, b, k),
                                   CM_NAME(cm_cubic_evaluate)(b, a, k));
}

CM_FN CM_NAME(cm_uv)
    CM_NAME(cm_coupled_cubic_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_NAME(cm_cubic_step) r = CM_NAME(cm_cubic_newton)(x, y, CM_NAME(cm_cubic_start)(x, y, k),
                                                        CM_NAME(cm_cubic_start)(y, x, k), k);
#if CM_REAL_BITS >= 64
    r = CM_NAME(cm_cubic_newton)(x, y, r.a, r.b, k);
#endif
#if CM_REAL_BITS > 64
    r = CM_NAME(cm_cubic_newton)(x, y, r.a, r.b, k);
    r = CM_NAME(cm_cubic_newton)(x, y, r.a, r.b, k);
#endif
    return CM_NAME(cm_cubic_finish)(p, q, r);
}

CM_FN CM_NAME(cm_pq)
    CM_NAME(cm_coupled_cubic_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL x = u * u;
    CM_REAL y = v * v;
    return CM_NAME(cm_cubic_unwarp)(u, v, CM_NAME(cm_cubic_evaluate)(x, y, k).c,
                                    CM_NAME(cm_cubic_evaluate)(y, x, k).c);
}

/* As in coupled: with g = 1 + (1 - u^2) C and C_u, C_v the derivatives of C by u^2 and v^2,
 * p_u = (1 + C - u^2 (1 - u^2) C_u) g^(-3/2), p_v = -u v (1 - u^2) C_v g^(-3/2), and that matrix is
 * inverted. Its determinant is far from 0. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_cubic_matrix)(CM_REAL u, CM_REAL v, CM_NAME(cm_cubic_value) c,
                                                    CM_NAME(cm_cubic_value) d)
{
    CM_REAL x = u * u;
    CM_REAL y = v * v;
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL g = CM_LIT(1.0) + a * c.c;
    CM_REAL h = CM_LIT(1.0) + b * d.c;
    CM_REAL cross_a = (u * v) * (a * c.c_y);
    CM_REAL cross_b = (u * v) * (b * d.c_y);
    CM_REAL own_a = CM_LIT(1.0) + (c.c - (x * a) * c.c_x);
    CM_REAL own_b = CM_LIT(1.0) + (d.c - (y * b) * d.c_x);
    CM_REAL scale = CM_LIT(1.0) / (own_a * own_b - cross_a * cross_b);
    CM_REAL g_power = (g * cm_sqrt(g)) * scale;
    CM_REAL h_power = (h * cm_sqrt(h)) * scale;
    return CM_NAME(cm_make_jacobian)(own_b * g_power, cross_a * h_power, cross_b * g_power,
                                     own_a * h_power);
}

CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_coupled_cubic_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                              CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    return CM_NAME(cm_cubic_matrix)(u, v, CM_NAME(cm_cubic_evaluate)(u * u, v * v, k),
                                    CM_NAME(cm_cubic_evaluate)(v * v, u * u, k));
}

#endif
