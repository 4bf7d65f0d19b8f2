/* SPDX-License-Identifier: MIT
 *
 * slice: slice and dice with its apex at the cube's corner, exactly equal-area. Each face is cut into
 * eight triangles by its axes and diagonals; in each a great circle from the corner V through the point
 * P meets the opposite side, which is on an axis, in D. The map keeps D's share of that side's area and
 * divides V'D' as areas want it:
 *     v = 1 - t,  u = 1 - t g,  t = sin(VP / 2) / sin(VD / 2),
 *     g = the area between D, V and the edge over that of the triangle, pi / 12.
 * Edges of the cube are no creases (C1); the axes of a face are creases of up to 3.985 degrees, by which a
 * great circle that crosses at a right angle bends, its diagonals of up to 2.630.
 *
 * Here the triangle is 0 <= q <= p <= 1, the others follow by signs and by swapping, and D is given by
 *     x = (1 - p) / s,  s = 1 + p - 2 q,
 * the tangent of the angle between D and the middle of the cube's edge: D = (1 + x, 1 - x, 0) / (2 mu)
 * with mu = sqrt((1 + x^2) / 2). What depends on x alone is
 *     g = (24 / pi) atan((sqrt 3 - sqrt 2) x / (1 + sqrt(1 + x^2))),
 * of which both directions are one polynomial, as in qsc.h: g = x + x (1 - x^2) G(x^2) and
 * x = g - g (1 - g^2) H(g^2), exact on the edge and on the diagonal; and so are 1 - g = (1 - x)(...) and
 * 1 - x, which are what is small at the axes. With n = sqrt(1 + p^2 + q^2), k = 1 / sqrt 3,
 *     t = s sqrt(mu (mu + k) / (n (n + (1 + p + q) k))),
 * and 1 - t^2 is q times a sum of positive terms. research/elementary derives the coefficients.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(slice,
        .identifier = "slice",
        .aliases = "slice-and-dice",
        .name = "slice and dice from the cube's corners, the recommended equal-area mapping",
        .source = "van Leeuwen & Strebe 2006, apex at the vertex (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_C0,
        .smooth_edge = CM_SMOOTH_C1,
        .smooth_corner = CM_SMOOTH_C0,
        .bounds = {.round_trip = 5.5, .plane_round_trip = 6, .forward = 4.5, .inverse = 3,
                   .relative = 14},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_slice_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#define CM_SLICE_ROOT3 CM_LIT(1.73205080756887729352744634150587236694)
#define CM_SLICE_K CM_LIT(0.577350269189625764509148780501957455648) /* 1 / sqrt 3 */

/* A number from 0 to 1 and what is missing to 1, each relatively accurate. */
CM_STRUCT(cm_slice_parts)
{
    CM_REAL x;
    CM_REAL y;
}
CM_STRUCT_END(cm_slice_parts)

CM_FN CM_NAME(cm_slice_parts) CM_NAME(cm_make_slice_parts)(CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_slice_parts) r;
    r.x = x;
    r.y = y;
    return r;
}

#if CM_REAL_BITS <= 64

/* G(z), z = x^2 */
CM_FN CM_REAL CM_NAME(cm_slice_bend)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
#if CM_REAL_BITS == 64
    CM_REAL a = cm_mad(t, CM_LIT(-6.0317676950205928e-2), CM_LIT(1.7542985770005973e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-1.2158645420923320e-2), CM_LIT(2.5663410531830709e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-3.2502513598701823e-3), CM_LIT(6.1494035691719712e-3));
    CM_REAL d = cm_mad(t, CM_LIT(-9.9114365191692224e-4), CM_LIT(1.7733959875979345e-3));
    CM_REAL e = cm_mad(t, CM_LIT(-3.2640530171715451e-4), CM_LIT(5.6447921118513633e-4));
    CM_REAL f = cm_mad(t, CM_LIT(-1.1300749343847819e-4), CM_LIT(1.9113368552410882e-4));
    CM_REAL g = cm_mad(t, CM_LIT(-4.0993210605144820e-5), CM_LIT(6.7268911439388935e-5));
    CM_REAL h = cm_mad(t, CM_LIT(-1.3433277720155172e-5), CM_LIT(2.5614797281089794e-5));
    CM_REAL i = cm_mad(t, CM_LIT(-8.7346212154095385e-6), CM_LIT(6.4346950007933337e-6));
    CM_REAL j = CM_LIT(7.0687015756700878e-6);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    i = cm_mad(t2, j, i);
    return cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, i, g), e), c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(-6.03173785e-2), CM_LIT(1.75429851e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-1.21715264e-2), CM_LIT(2.56644674e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-3.11335339e-3), CM_LIT(6.11790270e-3));
    CM_REAL d = cm_mad(t, CM_LIT(-1.45213492e-3), CM_LIT(2.03072978e-3));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    return cm_mad(t4, c, a);
#endif
}

/* H(z), z = g^2 */
CM_FN CM_REAL CM_NAME(cm_slice_straighten)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
#if CM_REAL_BITS == 64
    CM_REAL a = cm_mad(t, CM_LIT(3.8554095289978239e-2), CM_LIT(1.9384306942711096e-1));
    CM_REAL b = cm_mad(t, CM_LIT(1.5256342474574800e-3), CM_LIT(7.6693782524240818e-3));
    CM_REAL c = cm_mad(t, CM_LIT(6.0371366665186225e-5), CM_LIT(3.0348742868772693e-4));
    CM_REAL d = cm_mad(t, CM_LIT(2.3889440536989565e-6), CM_LIT(1.2009412486547485e-5));
    CM_REAL e = cm_mad(t, CM_LIT(9.4656264199428748e-8), CM_LIT(4.7510237343485342e-7));
    CM_REAL f = cm_mad(t, CM_LIT(3.6117642471194801e-9), CM_LIT(1.9313004401906324e-8));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    return cm_mad(t4, cm_mad(t4, e, c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(3.85540500e-2), CM_LIT(1.93843067e-1));
    CM_REAL b = cm_mad(t, CM_LIT(1.52654981e-3), CM_LIT(7.66915828e-3));
    CM_REAL c = cm_mad(t, CM_LIT(5.72875797e-5), CM_LIT(3.06985225e-4));
    a = cm_mad(t2, b, a);
    return cm_mad(t4, c, a);
#endif
}

/* The same, of g: 1 - k / mu, the versine of the angle between the corner and D */
CM_FN CM_REAL CM_NAME(cm_slice_versine)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
#if CM_REAL_BITS == 64
    CM_REAL a = cm_mad(t, CM_LIT(2.3786214695479124e-1), CM_LIT(3.1184274774896975e-1));
    CM_REAL b = cm_mad(t, CM_LIT(5.1091005976647190e-3), CM_LIT(-3.4876569701525362e-2));
    CM_REAL c = cm_mad(t, CM_LIT(1.0964272846344754e-4), CM_LIT(-7.4844897633322062e-4));
    CM_REAL d = cm_mad(t, CM_LIT(2.3529642186845265e-6), CM_LIT(-1.6061924917073243e-5));
    CM_REAL e = cm_mad(t, CM_LIT(5.0488222584904467e-8), CM_LIT(-3.4465928511582547e-7));
    CM_REAL f = cm_mad(t, CM_LIT(1.1042267297843246e-9), CM_LIT(-7.5174845396801230e-9));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    return cm_mad(t4, cm_mad(t4, e, c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(2.37862155e-1), CM_LIT(3.11842740e-1));
    CM_REAL b = cm_mad(t, CM_LIT(5.10892412e-3), CM_LIT(-3.48760001e-2));
    CM_REAL c = cm_mad(t, CM_LIT(1.10828274e-4), CM_LIT(-7.54509761e-4));
    a = cm_mad(t2, b, a);
    return cm_mad(t4, c, a);
#endif
}

/* g and 1 - g from x and y = 1 - x */
CM_FN CM_NAME(cm_slice_parts) CM_NAME(cm_slice_share)(CM_REAL x, CM_REAL y)
{
    CM_REAL bend = (CM_LIT(1.0) + x) * CM_NAME(cm_slice_bend)(x * x);
    return CM_NAME(cm_make_slice_parts)(cm_mad(x, y * bend, x), cm_mad(y, -(x * bend), y));
}

/* x and 1 - x from g and f = 1 - g */
CM_FN CM_NAME(cm_slice_parts) CM_NAME(cm_slice_place)(CM_REAL g, CM_REAL f)
{
    CM_REAL straight = (CM_LIT(1.0) + g) * CM_NAME(cm_slice_straighten)(g * g);
    return CM_NAME(cm_make_slice_parts)(cm_mad(g, -(f * straight), g), cm_mad(f, g * straight, f));
}

#else /* the definition; of 1 - g and 1 - x by the differences of angles */

#define CM_SLICE_TAN (CM_SLICE_ROOT3 - cm_sqrt(CM_LIT(2.0)))
#define CM_SLICE_TAN8 (cm_sqrt(CM_LIT(2.0)) - CM_LIT(1.0)) /* tan(pi / 8) */
#define CM_SLICE_24 (CM_LIT(24.0) / CM_LIT(3.14159265358979323846264338327950288420))

CM_FN CM_NAME(cm_slice_parts) CM_NAME(cm_slice_share)(CM_REAL x, CM_REAL y)
{
    CM_REAL d = y / (CM_LIT(1.0) + x);
    CM_REAL h = x / (CM_LIT(1.0) + cm_sqrt(CM_LIT(1.0) + x * x));
    CM_REAL other = d / (CM_LIT(1.0) + cm_sqrt(CM_LIT(1.0) + d * d));
    CM_REAL ratio = (CM_LIT(1.0) + CM_SLICE_TAN8 * h) /
                    (CM_LIT(1.0) + CM_SLICE_TAN8 * CM_SLICE_TAN * CM_SLICE_TAN * h);
    return CM_NAME(cm_make_slice_parts)(CM_SLICE_24 * CM_NAME(cm_atan)(CM_SLICE_TAN * h),
                                        CM_SLICE_24 *
                                            CM_NAME(cm_atan)(CM_SLICE_TAN * other * ratio));
}

CM_FN CM_REAL CM_NAME(cm_slice_tan)(CM_REAL part)
{
    CM_REAL angle = part / CM_SLICE_24;
    return CM_NAME(cm_sin_quarter)(angle) / (CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(angle));
}

CM_FN CM_NAME(cm_slice_parts) CM_NAME(cm_slice_place)(CM_REAL g, CM_REAL f)
{
    CM_REAL tan8 = CM_SLICE_TAN8;
    CM_REAL square = CM_SLICE_TAN * CM_SLICE_TAN;
    CM_REAL h = CM_NAME(cm_slice_tan)(g) / CM_SLICE_TAN;
    CM_REAL tan_f = CM_NAME(cm_slice_tan)(f);
    CM_REAL other =
        tan_f * (CM_LIT(1.0) + tan8 * tan8 * square) /
        (CM_SLICE_TAN * (CM_LIT(1.0) + tan8 * tan8) - tan_f * tan8 * (CM_LIT(1.0) - square));
    CM_REAL d = CM_LIT(2.0) * other / (CM_LIT(1.0) - other * other);
    return CM_NAME(cm_make_slice_parts)(CM_LIT(2.0) * h / (CM_LIT(1.0) - h * h),
                                        CM_LIT(2.0) * d / (CM_LIT(1.0) + d));
}

CM_FN CM_REAL CM_NAME(cm_slice_versine)(CM_REAL z)
{
    CM_REAL x = CM_NAME(cm_slice_place)(cm_sqrt(z), CM_LIT(1.0) - cm_sqrt(z)).x;
    return CM_LIT(1.0) - CM_SLICE_K / cm_sqrt(CM_LIT(0.5) + CM_LIT(0.5) * (x * x));
}

#endif

/* Two roots beside n and two divisions. s and 1 / s are 1 at the corner, where t is 0. */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_slice_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL across = major - minor;
    CM_REAL s = (CM_LIT(1.0) - minor) + across;
    CM_REAL n = CM_NAME(cm_root)((CM_LIT(1.0) + major * major) + minor * minor);
    CM_REAL n_square = n * (n + CM_SLICE_K * (CM_LIT(1.0) + (major + minor)));
    CM_REAL s_safe = CM_SELECT(cm_less(CM_LIT(0.0), s), s, CM_LIT(1.0));
    CM_REAL inverse = CM_LIT(1.0) / (s_safe * n_square);
    CM_REAL inverse_s = inverse * n_square;
    CM_REAL inverse_n = inverse * s_safe;
    CM_REAL x = (CM_LIT(1.0) - major) * inverse_s;
    CM_NAME(cm_slice_parts)
    part = CM_NAME(cm_slice_share)(x, CM_LIT(2.0) * (across * inverse_s));
    CM_REAL mu = CM_NAME(cm_root)(cm_mad(x, CM_LIT(0.5) * x, CM_LIT(0.5)));
    CM_REAL t = s * CM_NAME(cm_root)((mu * (mu + CM_SLICE_K)) * inverse_n);
    /* 1 - t^2 = (e + sqrt(3) q n + k s e / (n + s mu)) / (n (n + ...)), e = q (2 + 2 p - q) */
    CM_REAL sum = cm_mad(s, mu, n);
    CM_REAL e = (CM_LIT(2.0) - minor) + CM_LIT(2.0) * major;
    CM_REAL rest = cm_mad(e, cm_mad(CM_SLICE_K, s, sum), (CM_SLICE_ROOT3 * n) * sum) * inverse_n;
    CM_REAL small = CM_NAME(cm_quotient)(minor * rest, sum * (CM_LIT(1.0) + t));
    CM_REAL v = CM_SELECT(cm_less(t, CM_LIT(0.5)), CM_LIT(1.0) - t, small);
    CM_REAL u =
        CM_SELECT(cm_less(x, CM_LIT(0.5)), cm_mad(-t, part.x, CM_LIT(1.0)), cm_mad(t, part.y, v));
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(wide, u, v), p),
                               cm_copysign(CM_SELECT(wide, v, u), q));
}

/* P = a V + b D in length, with E = 1 - k / mu, T = t^2:
 *     a = k (1 - T)(2 - (1 + T) E),  b = t w ((1 - T E) r + (1 - E) t w) / (2 mu),
 *     r = sqrt(2 - E),  w = sqrt(2 - T E),
 *     q = a / (a + b (1 + x)),  1 - p = 2 b x / (a + b (1 + x)),  p = q + b (1 - x) / (...),
 * from the sines of VP and PD, where 1 - T = v (2 - v) has been taken out. */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_slice_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_u = cm_abs(u);
    CM_REAL abs_v = cm_abs(v);
    CM_BOOL wide = cm_at_least(abs_u, abs_v);
    CM_REAL major = CM_SELECT(wide, abs_u, abs_v);
    CM_REAL minor = CM_SELECT(wide, abs_v, abs_u);
    CM_REAL t = CM_LIT(1.0) - minor;
    CM_REAL inverse_t = CM_LIT(1.0) / CM_SELECT(cm_less(CM_LIT(0.0), t), t, CM_LIT(1.0));
    CM_REAL g = (CM_LIT(1.0) - major) * inverse_t;
    CM_NAME(cm_slice_parts) part = CM_NAME(cm_slice_place)(g, (major - minor) * inverse_t);
    CM_REAL e = CM_NAME(cm_slice_versine)(g * g);
    CM_REAL t_square = t * t;
    CM_REAL t_square_e = t_square * e;
    CM_REAL e1 = CM_LIT(1.0) - e; /* k / mu */
    CM_REAL r = CM_NAME(cm_root)(CM_LIT(2.0) - e);
    CM_REAL tw = t * CM_NAME(cm_root)(CM_LIT(2.0) - t_square_e);
    CM_REAL a = (minor * (CM_LIT(2.0) - minor)) * ((CM_LIT(2.0) - e) - t_square_e);
    /* b and a without their factor k */
    CM_REAL b = (CM_LIT(1.5) * e1) * (tw * cm_mad(e1, tw, r - r * t_square_e));
    CM_REAL b_x1 = cm_mad(b, part.x, b);
    CM_REAL inverse = CM_LIT(1.0) / (a + b_x1);
    CM_REAL q =
        CM_SELECT(cm_less(t, CM_LIT(0.5)), cm_mad(-b_x1, inverse, CM_LIT(1.0)), a * inverse);
    CM_REAL p = CM_SELECT(cm_less(g, CM_LIT(0.5)),
                          cm_mad(CM_LIT(-2.0) * (b * part.x), inverse, CM_LIT(1.0)),
                          cm_mad(b * part.y, inverse, q));
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, p, q), u),
                               cm_copysign(CM_SELECT(wide, q, p), v));
}

/* With c = T0 sqrt 3 / (1 + 3 x^2), T0 = t / s, N = n (n + ...), in the triangle q <= p:
 *     v_p = c (N (x - q y / 2) / n^3 - x (1 + x)(mu + k) / (2 mu^2)),
 *     v_q = c (N ((1 + x) / 2 + p y / 2) / n^3 + x^2 (mu + k) / mu^2),
 *     u_p = g v_p + (1 + x) T0 g',  u_q = g v_q - 2 x T0 g',  T0 g' = (2 sqrt 3 / pi) / sqrt(N mu (mu + k)),
 * y = 1 - x. On a crease it is the matrix of the triangle that forward chooses: |p| >= |q|, the signs of
 * zeros counting; at the centre of a face and at its corners, where it depends on the direction, that of
 * the axis of u, and of the edge of u. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_slice_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL s = (CM_LIT(1.0) - minor) + (major - minor);
    CM_REAL x = (CM_LIT(1.0) - major) / CM_SELECT(cm_less(CM_LIT(0.0), s), s, CM_LIT(1.0));
    CM_REAL y = CM_LIT(1.0) - x;
    CM_REAL x1 = CM_LIT(1.0) + x;
    CM_REAL square = (CM_LIT(1.0) + major * major) + minor * minor;
    CM_REAL n = cm_sqrt(square);
    CM_REAL n_square = n * (n + CM_SLICE_K * (CM_LIT(1.0) + (major + minor)));
    CM_REAL mu_square = CM_LIT(0.5) + CM_LIT(0.5) * (x * x);
    CM_REAL mu = cm_sqrt(mu_square);
    CM_REAL mu_k = mu * (mu + CM_SLICE_K);
    CM_REAL root = cm_sqrt(n_square * mu_k);
    /* one division for 1 / n^3, 1 / mu^2, 1 / root and that of c */
    CM_REAL n_cube = square * n;
    CM_REAL cubes = n_cube * mu_square;
    CM_REAL three = CM_LIT(1.0) + CM_LIT(3.0) * (x * x);
    CM_REAL inverse = CM_LIT(1.0) / ((cubes * three) * root);
    CM_REAL turn = CM_LIT(1.10265779084358409902265299662593888279) * /* 2 sqrt 3 / pi */
                   (inverse * (cubes * three));
    CM_REAL c = (CM_SLICE_ROOT3 * mu_k) * inverse;
    CM_REAL at_n = (c * mu_square) * n_square;
    CM_REAL at_mu = (c * n_cube) * (mu + CM_SLICE_K);
    CM_REAL half_y = CM_LIT(0.5) * y;
    CM_REAL v_major = at_n * (x - minor * half_y) - at_mu * (CM_LIT(0.5) * (x * x1));
    CM_REAL v_minor = at_n * (CM_LIT(0.5) * x1 + major * half_y) + at_mu * (x * x);
    CM_REAL g = CM_NAME(cm_slice_share)(x, y).x;
    CM_REAL u_major = g * v_major + x1 * turn;
    CM_REAL u_minor = g * v_minor - (CM_LIT(2.0) * x) * turn;
    /* off the diagonal a sign for each of p and q */
    CM_REAL sign = cm_copysign(CM_LIT(1.0), p) * cm_copysign(CM_LIT(1.0), q);
    CM_REAL u_cross = sign * u_minor;
    CM_REAL v_cross = sign * v_major;
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(wide, u_major, v_minor), CM_SELECT(wide, u_cross, v_cross),
        CM_SELECT(wide, v_cross, u_cross), CM_SELECT(wide, v_minor, u_major));
}

#endif
