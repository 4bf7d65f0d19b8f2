/* SPDX-License-Identifier: MIT
 *
 * conformal: the conformal cube, which keeps angles everywhere but at the eight corners, where three
 * right angles of the map meet 360 degrees of the sphere. Analytic on the faces and across their edges.
 *
 * zeta = (p + i q) / (1 + n), n = sqrt(1 + p^2 + q^2), is the stereographic projection from a face's
 * centre, and z = u + i v is an integral (Schwarz and Christoffel),
 *     dz / dzeta = k0 (1 + 14 zeta^4 + zeta^8)^(-1/4);
 * about a corner, with its stereographic coordinate w, real on an edge, and with the complex distance
 * z_c = (1 - v) / 2 + i (1 - u) / 2 from the corner in the map, it is
 *     dz_c / dw = C (w (1 - w^3) (1 + w^3 / 8))^(-1/4).
 * So z = zeta F(zeta^4), z_c = w^(3/4) B(w^3), zeta = z G(z^4), w = z_c^(4/3) D(z_c^4) with power series of
 * real coefficients. All is done in the octant p >= q >= 0, in two zones: within 28 degrees of the corner,
 * and elsewhere. The papers halve the way to the corner; here the middle of the edge counts as centre, so
 * that the whole axis q = 0 does, on which v then vanishes without a difference. What that costs in
 * convergence, a variable of forward's series that is no power gives back, and coefficients that are made
 * for the zones alone (research/mappings/conformal-series). As a point is in one zone, its coefficients are selected
 * and there is one evaluation; a point alone takes the way of its zone (dialect.h).
 *
 * Of forward, the rounding of p and q beside a corner comes out magnified without bound, as w^(3/4):
 * by 2^13 in double at most, as p and q cannot be nearer to 1 than an ulp.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_UNDERFLOW(conformal,
        .identifier = "conformal",
        .aliases = "rancic lee-cube",
        .name = "conformal cube",
        .source = "Lee 1976; Rancic, Purser, Mesinger 1996, appendix B (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_CONFORMAL,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_ANALYTIC,
        .smooth_corner = CM_SMOOTH_C0,
        .bounds = {.round_trip = 5.5, .plane_round_trip = 8192, .forward = 4.5, .inverse = 4,
                   .relative = 16},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_conformal_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#define CM_CONFORMAL_SQRT3 CM_LIT(1.7320508075688772935274463415058723670)
#define CM_CONFORMAL_INVERSE_SQRT3 CM_LIT(0.57735026918962576450914878050195745565)

CM_FN CM_NAME(cm_complex)
    CM_NAME(cm_conformal_select)(CM_ZONE corner, CM_NAME(cm_complex) a, CM_NAME(cm_complex) b)
{
    return CM_NAME(cm_make_complex)(CM_IN_ZONE(corner, a.re, b.re), CM_IN_ZONE(corner, a.im, b.im));
}

/* The root of an a with a.re >= 0, from |a|. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_root)(CM_NAME(cm_complex) a, CM_REAL modulus)
{
    CM_REAL real = CM_NAME(cm_root)(CM_LIT(0.5) * (modulus + a.re));
    return CM_NAME(cm_make_complex)(real, CM_NAME(cm_quotient)(CM_LIT(0.5) * a.im, real));
}

/* A sum of a_k x^k with real a_k at a complex x, of which one coefficient after the other is added from the
 * last on: b_k = a_k + 2 Re(x) b_(k+1) - |x|^2 b_(k+2), two multiplications each, and the sum is
 * b_0 - conj(x) b_1. Its imaginary part is Im(x) b_1, as accurate as Im(x). */
CM_STRUCT(cm_conformal_sum)
{
    CM_REAL twice;
    CM_REAL minus_square;
    CM_REAL last;
    CM_REAL before;
}
CM_STRUCT_END(cm_conformal_sum)

/* with the last coefficient, of the centre's zone: that of the corner has fewer, and begins with 0 */
CM_FN CM_NAME(cm_conformal_sum)
    CM_NAME(cm_conformal_begin)(CM_NAME(cm_complex) x, CM_ZONE corner, CM_REAL at_centre)
{
    CM_NAME(cm_conformal_sum) b;
    b.twice = CM_LIT(2.0) * x.re;
    b.minus_square = -cm_mad(x.re, x.re, x.im * x.im);
    b.last = CM_IN_ZONE(corner, CM_LIT(0.0), at_centre);
    b.before = CM_LIT(0.0);
    return b;
}

CM_FN CM_NAME(cm_conformal_sum)
    CM_NAME(cm_conformal_term)(CM_NAME(cm_conformal_sum) b, CM_ZONE corner, CM_REAL at_corner,
                               CM_REAL at_centre)
{
    CM_REAL a = CM_IN_ZONE(corner, at_corner, at_centre);
    CM_REAL next = cm_mad(b.twice, b.last, cm_mad(b.minus_square, b.before, a));
    b.before = b.last;
    b.last = next;
    return b;
}

/* with a_0 */
CM_FN CM_NAME(cm_complex)
    CM_NAME(cm_conformal_end)(CM_NAME(cm_conformal_sum) b, CM_REAL first, CM_NAME(cm_complex) x)
{
    return CM_NAME(cm_make_complex)(first + cm_mad(x.re, b.last, b.minus_square * b.before),
                                    x.im * b.last);
}

/* ---- Forward ---- */

/* the variable of the centre's zone is (s - shift) / (s + pole), s = zeta^4 */
#define CM_CONFORMAL_SHIFT CM_LIT(0.0125)
#define CM_CONFORMAL_POLE CM_LIT(0.175)

#if CM_REAL_BITS <= 64

/* F(s) - 2 from the variable of the centre's zone, or -2 B(w^3) from w^3 */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_forward_sum)(CM_ZONE corner, CM_NAME(cm_complex) x)
{
#if CM_REAL_BITS == 64
    CM_NAME(cm_conformal_sum) b =
        CM_NAME(cm_conformal_begin)(x, corner, CM_LIT(-3.5301706306461124e-2));
    if (CM_OUTSIDE_ZONE(corner))
    {
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(3.1406354599196759e-3));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-3.5958105842181243e-2));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-2.0184747144157709e-3));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-3.7057139601975952e-2));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-7.328383306140445e-3));
    }
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-2.4960360556899995e-3),
                                   CM_LIT(-4.0581269502832169e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-3.0500622918975661e-3),
                                   CM_LIT(-1.3327623039884622e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-3.8281111440543046e-3),
                                   CM_LIT(-4.7879371925687985e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-4.970491199287527e-3),
                                   CM_LIT(-2.1227607257412047e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-6.7565173227014461e-3),
                                   CM_LIT(-6.2776846613013043e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-9.8071528560366732e-3),
                                   CM_LIT(-3.3904583226376169e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-1.5725428442405797e-2),
                                   CM_LIT(-9.9648147389337047e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-3.0413141859634557e-2),
                                   CM_LIT(-6.1536613892446333e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-7.9369442056988044e-2),
                                   CM_LIT(-2.8844324061609298e-1));
    return CM_NAME(cm_conformal_end)(
        b, CM_IN_ZONE(corner, CM_LIT(-1.8141586755882982), CM_LIT(4.3859144818194689e-1)), x);
#else
    CM_NAME(cm_conformal_sum) b = CM_NAME(cm_conformal_begin)(x, corner, CM_LIT(-2.35547644e-2));
    if (CM_OUTSIDE_ZONE(corner))
    {
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-6.19817122e-2));
    }
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-9.81155393e-3), CM_LIT(-3.38675597e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-1.57254353e-2), CM_LIT(-9.96485455e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-3.04131419e-2), CM_LIT(-6.1536343e-2));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-7.93694421e-2), CM_LIT(-2.88443235e-1));
    return CM_NAME(cm_conformal_end)(
        b, CM_IN_ZONE(corner, CM_LIT(-1.81415868), CM_LIT(4.38591448e-1)), x);
#endif
}

#else /* the power series: (1 + alpha x + beta x^2)^(-1/4), integrated term by term */

CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_forward_sum)(CM_ZONE corner, CM_NAME(cm_complex) x)
{
    CM_REAL scale = CM_IN_ZONE(corner, CM_LIT(-1.3606190066912236182756960794010114889),
                               CM_LIT(2.4589161211916530669900713824564418560)); /* -2 C, k0 */
    CM_REAL alpha = CM_IN_ZONE(corner, CM_LIT(-0.875), CM_LIT(14.0));
    CM_REAL beta = CM_IN_ZONE(corner, CM_LIT(-0.125), CM_LIT(1.0));
    CM_REAL step = CM_IN_ZONE(corner, CM_LIT(3.0), CM_LIT(4.0));
    CM_REAL order = CM_IN_ZONE(corner, CM_LIT(0.75), CM_LIT(1.0)); /* of the integral */
    CM_REAL left = CM_LIT(1.0) - x.re;
    CM_REAL inverse = CM_LIT(1.0) / (left * left + x.im * x.im);
    CM_NAME(cm_complex) s = CM_NAME(cm_complex_multiply)(
        CM_NAME(cm_make_complex)(CM_CONFORMAL_SHIFT + CM_CONFORMAL_POLE * x.re,
                                 CM_CONFORMAL_POLE * x.im),
        CM_NAME(cm_make_complex)(left * inverse, x.im * inverse));
    s = CM_NAME(cm_conformal_select)(corner, x, s);
    CM_NAME(cm_complex) power = CM_NAME(cm_make_complex)(CM_LIT(1.0), CM_LIT(0.0));
    CM_NAME(cm_complex) sum = CM_NAME(cm_make_complex)(CM_LIT(0.0), CM_LIT(0.0));
    CM_REAL c = CM_LIT(1.0);
    CM_REAL before = CM_LIT(0.0);
    CM_REAL k = CM_LIT(0.0);
    for (int i = 0; i < 100; i++)
    {
        sum.re += power.re * (c / order);
        sum.im += power.im * (c / order);
        power = CM_NAME(cm_complex_multiply)(power, s);
        CM_REAL next = -(alpha * (k + CM_LIT(0.25)) * c + beta * (k - CM_LIT(0.5)) * before) /
                       (k + CM_LIT(1.0));
        before = c;
        c = next;
        k += CM_LIT(1.0);
        order += step;
    }
    sum.re = sum.re * scale - CM_IN_ZONE(corner, CM_LIT(0.0), CM_LIT(2.0));
    return CM_NAME(cm_make_complex)(sum.re, sum.im * scale);
}

#endif

/* w^(3/4), of which the modulus is at least that of a point half an ulp from the corner; where w is 0, on
 * the edge, no one looks. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_power)(CM_NAME(cm_complex) w)
{
#if CM_REAL_BITS > 64
    CM_REAL tiny = CM_LIT(1e-80);
#elif CM_REAL_BITS == 64
    CM_REAL tiny = CM_LIT(1e-34);
#else
    CM_REAL tiny = CM_LIT(1e-16);
#endif
    CM_REAL modulus = CM_NAME(cm_root)(cm_max(cm_mad(w.re, w.re, w.im * w.im), tiny));
    CM_NAME(cm_complex) root = CM_NAME(cm_conformal_root)(w, modulus);
    return CM_NAME(cm_conformal_root)(CM_NAME(cm_complex_multiply)(w, root),
                                      modulus * CM_NAME(cm_root)(modulus));
}

/* sqrt(1 + p^2 + q^2) */
CM_FN CM_REAL CM_NAME(cm_conformal_length)(CM_REAL p, CM_REAL q)
{
    return CM_NAME(cm_root)(CM_LIT(1.0) + cm_mad(p, p, q * q));
}

/* The component towards the corner, which is that length at it. */
CM_FN CM_REAL CM_NAME(cm_conformal_along)(CM_REAL p, CM_REAL q)
{
    return ((CM_LIT(1.0) + p) + q) * CM_CONFORMAL_INVERSE_SQRT3;
}

/* for 0 <= q <= p */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_conformal_octant_zone)(CM_ZONE corner, CM_REAL p, CM_REAL q)
{
    CM_REAL square = cm_mad(p, p, q * q);
    CM_REAL n = CM_NAME(cm_conformal_length)(p, q);
    CM_REAL along = CM_NAME(cm_conformal_along)(p, q);
    /* one division for both zones: by n + along for w, and for zeta and the variable */
    CM_NAME(cm_complex) fourth =
        CM_NAME(cm_complex_square)(CM_NAME(cm_complex_square)(CM_NAME(cm_make_complex)(p, q)));
    CM_REAL m = CM_LIT(1.0) + n;
    CM_REAL m4 = (m * m) * (m * m);
    CM_REAL below = cm_mad(m4, CM_CONFORMAL_POLE, fourth.re);
    CM_REAL below_square = cm_mad(below, below, fourth.im * fourth.im);
    CM_REAL inverse = CM_LIT(1.0) / CM_IN_ZONE(corner, n + along, m * below_square);
    CM_REAL inverse_m = inverse * below_square;
    CM_REAL inverse_below = inverse * m;
    CM_NAME(cm_complex) w = CM_NAME(cm_make_complex)(
        (((CM_LIT(1.0) - q) + (p - q)) * CM_CONFORMAL_INVERSE_SQRT3) * inverse,
        (CM_LIT(1.0) - p) * inverse);
    CM_NAME(cm_complex) x = CM_NAME(cm_make_complex)(
        cm_mad(cm_mad(m4, -CM_CONFORMAL_SHIFT, fourth.re), below, fourth.im * fourth.im) *
            inverse_below,
        (m4 * (CM_CONFORMAL_SHIFT + CM_CONFORMAL_POLE)) * fourth.im * inverse_below);
    x = CM_NAME(cm_conformal_select)(
        corner, CM_NAME(cm_complex_multiply)(CM_NAME(cm_complex_square)(w), w), x);
    CM_NAME(cm_complex) sum = CM_NAME(cm_conformal_forward_sum)(corner, x);
    /* z = (p + i q)(1 + (F - 1 - n) / (1 + n)), as n - 1 = (p^2 + q^2) / (1 + n) */
    CM_NAME(cm_complex) factor =
        CM_NAME(cm_make_complex)((sum.re - square * inverse_m) * inverse_m, sum.im * inverse_m);
    CM_NAME(cm_complex) d = CM_NAME(cm_complex_multiply)(
        CM_NAME(cm_conformal_select)(corner, CM_NAME(cm_conformal_power)(w),
                                     CM_NAME(cm_make_complex)(p, q)),
        CM_NAME(cm_conformal_select)(corner, sum, factor));
    CM_REAL u = CM_IN_ZONE(corner, CM_LIT(1.0), p) + CM_IN_ZONE(corner, d.im, d.re);
    CM_REAL v = CM_IN_ZONE(corner, CM_LIT(1.0), q) + CM_IN_ZONE(corner, d.re, d.im);
    u = CM_SELECT(cm_equal(p, CM_LIT(1.0)), p, cm_min(CM_LIT(1.0), u));
    return CM_NAME(cm_make_uv)(u, CM_SELECT(cm_equal(p, q), u, v));
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_conformal_octant)(CM_REAL p, CM_REAL q)
{
    /* the cosine of the angle from the corner */
    CM_BOOL corner = cm_less(CM_NAME(cm_conformal_length)(p, q) * CM_LIT(0.9074),
                             CM_NAME(cm_conformal_along)(p, q));
    return CM_BY_ZONE(corner, CM_NAME(cm_conformal_octant_zone), p, q);
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_conformal_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_NAME(cm_uv) r =
        CM_NAME(cm_conformal_octant)(CM_SELECT(wide, abs_p, abs_q), CM_SELECT(wide, abs_q, abs_p));
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(wide, r.u, r.v), p),
                               cm_copysign(CM_SELECT(wide, r.v, r.u), q));
}

/* ---- Jacobian ---- */

/* (1 + 14 zeta^4 + zeta^8)^(-1/4). With P = p + i q, P^2 = A + i B, m = 1 + n and t = 2 - sqrt 3 the
 * polynomial is the product of t m^2 + i P^2, t m^2 - i P^2, m^2 + i t P^2 and m^2 - i t P^2, over
 * t^2 m^8. The first vanishes at the corner: its real part, t m^2 - B, is made of a = 1 - p, b = 1 - q and
 * d = sqrt 3 - n. At the corner itself it is that of a point an ulp beside. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_slope)(CM_REAL p, CM_REAL q, CM_REAL n)
{
#if CM_REAL_BITS > 64
    CM_REAL tiny = CM_LIT(1e-34);
#elif CM_REAL_BITS == 64
    CM_REAL tiny = CM_LIT(1.1102230246251565e-16);
#else
    CM_REAL tiny = CM_LIT(5.9604645e-8);
#endif
    CM_REAL t = CM_LIT(0.26794919243112270647255365849412763306);
    CM_REAL a = CM_LIT(1.0) - p;
    CM_REAL b = CM_LIT(1.0) - q;
    CM_REAL d = (a * (CM_LIT(1.0) + p) + b * (CM_LIT(1.0) + q)) / (n + CM_CONFORMAL_SQRT3);
    CM_REAL beside = CM_LIT(2.0) * ((a + b) - a * b) -
                     (t * d) * (CM_LIT(2.0) + CM_LIT(2.0) * CM_CONFORMAL_SQRT3 - d);
    beside = cm_max(beside, tiny);
    CM_REAL m = CM_LIT(1.0) + n;
    CM_REAL m2 = m * m;
    CM_REAL real = (p - q) * (p + q); /* A */
    CM_REAL imaginary = CM_LIT(2.0) * p * q;
    CM_REAL both = CM_LIT(2.0) * (real * imaginary);
    CM_NAME(cm_complex) product = CM_NAME(cm_complex_multiply)(
        CM_NAME(cm_make_complex)(beside * (t * m2 + imaginary) + real * real, both),
        CM_NAME(cm_make_complex)(m2 * m2 + (t * t) * ((real - imaginary) * (real + imaginary)),
                                 (t * t) * both));
    CM_REAL scale = CM_LIT(1.0) / ((t * m2) * (m2 * m2) * (t * m2));
    product.re = product.re * scale;
    product.im = product.im * scale;
    CM_REAL modulus = cm_sqrt(product.re * product.re + product.im * product.im);
    CM_REAL root = cm_sqrt(modulus);
    CM_NAME(cm_complex) fourth = CM_NAME(cm_conformal_root)(
        CM_NAME(cm_conformal_root)(CM_NAME(cm_make_complex)(product.re, -product.im), modulus),
        root);
    return CM_NAME(cm_make_complex)(fourth.re / root, fourth.im / root);
}

/* dz / dp = k0 slope dzeta / dp with dzeta / dp = (1 - zeta p / n) / (1 + n), and for q
 * (i - zeta q / n) / (1 + n), in the octant 0 <= q <= p. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_conformal_octant_jacobian)(CM_REAL p, CM_REAL q)
{
    CM_REAL n = cm_sqrt((CM_LIT(1.0) + p * p) + q * q);
    CM_REAL m = CM_LIT(1.0) + n;
    CM_REAL scale = CM_LIT(1.0) / (m * (n * m));
    CM_REAL nm = n * m;
    CM_NAME(cm_complex) slope = CM_NAME(cm_conformal_slope)(p, q, n);
    slope.re = slope.re * (scale * CM_LIT(2.4589161211916530669900713824564418560)); /* k0 */
    slope.im = slope.im * (scale * CM_LIT(2.4589161211916530669900713824564418560));
    CM_REAL cross = -(p * q);
    CM_NAME(cm_complex) by_p =
        CM_NAME(cm_complex_multiply)(slope, CM_NAME(cm_make_complex)(nm - p * p, cross));
    CM_NAME(cm_complex) by_q =
        CM_NAME(cm_complex_multiply)(slope, CM_NAME(cm_make_complex)(cross, nm - q * q));
    return CM_NAME(cm_make_jacobian)(by_p.re, by_q.re, by_p.im, by_q.im);
}

/* At the corners, where it is infinite, that of a point an ulp beside them. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_conformal_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                          CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_NAME(cm_jacobian) j = CM_NAME(cm_conformal_octant_jacobian)(CM_SELECT(wide, abs_p, abs_q),
                                                                   CM_SELECT(wide, abs_q, abs_p));
    /* off the diagonal a sign for each of p and q */
    CM_REAL sign = cm_copysign(CM_LIT(1.0), p) * cm_copysign(CM_LIT(1.0), q);
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(wide, j.u_p, j.v_q), sign * CM_SELECT(wide, j.u_q, j.v_p),
        sign * CM_SELECT(wide, j.v_p, j.u_q), CM_SELECT(wide, j.v_q, j.u_p));
}

/* ---- Inverse ---- */

/* 1 - 2 G(z^4), or D(z_c^4) */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_inverse_sum)(CM_ZONE corner, CM_NAME(cm_complex) x)
{
#if CM_REAL_BITS >= 64
    CM_NAME(cm_conformal_sum) b =
        CM_NAME(cm_conformal_begin)(x, corner, CM_LIT(3.4617459115121631e-15));
    if (CM_OUTSIDE_ZONE(corner))
    {
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-4.1100613804822669e-14));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(2.8815452752936259e-13));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-1.6129418151703708e-12));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(8.2330842037818149e-12));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-4.0993775298643973e-11));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(2.0542941297539589e-10));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-1.0504077853771953e-9));
    }
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-6.7083924836925097e-4),
                                   CM_LIT(5.5245952106600601e-9));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-9.132876999908829e-4),
                                   CM_LIT(-3.0134673513450042e-8));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-1.3050401040048272e-3),
                                   CM_LIT(1.7242757848330865e-7));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-1.9839242592405759e-3),
                                   CM_LIT(-1.0533356239820197e-6));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-3.3515531408537724e-3),
                                   CM_LIT(7.076025802760853e-6));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-5.9849936658378068e-3),
                                   CM_LIT(-5.5421786707113448e-5));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-2.2778347386447365e-2),
                                   CM_LIT(5.6296098743891948e-4));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-9.8131551251846997e-2),
                                   CM_LIT(-1.557433328562802e-2));
    return CM_NAME(cm_conformal_end)(
        b, CM_IN_ZONE(corner, CM_LIT(1.1388668914555421), CM_LIT(1.8663349971012866e-1)), x);
#else
    CM_NAME(cm_conformal_sum) b = CM_NAME(cm_conformal_begin)(x, corner, CM_LIT(1.01883747e-7));
    if (CM_OUTSIDE_ZONE(corner))
    {
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(-9.47644384e-7));
        b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(0.0), CM_LIT(6.9753036e-6));
    }
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-5.98536118e-3), CM_LIT(-5.53602509e-5));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-2.27783482e-2), CM_LIT(5.62939093e-4));
    b = CM_NAME(cm_conformal_term)(b, corner, CM_LIT(-9.81315513e-2), CM_LIT(-1.55743296e-2));
    return CM_NAME(cm_conformal_end)(b, CM_IN_ZONE(corner, CM_LIT(1.13886689), CM_LIT(1.866335e-1)),
                                     x);
#endif
}

/* One step towards x^(-1/3) from y, to the third power of the error. */
CM_FN CM_REAL CM_NAME(cm_conformal_cube_step)(CM_REAL x, CM_REAL y)
{
    CM_REAL e = cm_mad(-x, (y * y) * y, CM_LIT(1.0));
    return cm_mad(y * e,
                  cm_mad(e, CM_LIT(0.22222222222222222222222222222222222222),
                         CM_LIT(0.33333333333333333333333333333333333333)),
                  y);
}

/* x^(1/3) to an ulp for 2^-57 <= x <= 1. x is brought between 1/8 and 1 by powers of 8, for a polynomial
 * that is x^(-1/3) to 0.7 % (in float 2 %). */
CM_FN CM_REAL CM_NAME(cm_conformal_cube_root)(CM_REAL x)
{
    CM_REAL scale = CM_LIT(1.0);
    CM_REAL scaled = x;
    CM_BOOL small;
#if CM_REAL_BITS > 64
    small = cm_less(scaled, CM_LIT(3.5527136788005009e-15)); /* 2^-48 */
    scaled = CM_SELECT(small, scaled * CM_LIT(281474976710656.0), scaled);
    scale = CM_SELECT(small, CM_LIT(65536.0), scale);
#endif
#if CM_REAL_BITS >= 64
    small = cm_less(scaled, CM_LIT(5.9604644775390625e-8)); /* 2^-24 */
    scaled = CM_SELECT(small, scaled * CM_LIT(16777216.0), scaled);
    scale = CM_SELECT(small, scale * CM_LIT(256.0), scale);
#endif
    small = cm_less(scaled, CM_LIT(0.000244140625)); /* 2^-12 */
    scaled = CM_SELECT(small, scaled * CM_LIT(4096.0), scaled);
    scale = CM_SELECT(small, scale * CM_LIT(16.0), scale);
    small = cm_less(scaled, CM_LIT(0.015625));
    scaled = CM_SELECT(small, scaled * CM_LIT(64.0), scaled);
    scale = CM_SELECT(small, scale * CM_LIT(4.0), scale);
    small = cm_less(scaled, CM_LIT(0.125));
    scaled = CM_SELECT(small, scaled * CM_LIT(8.0), scaled);
    scale = CM_SELECT(small, scale * CM_LIT(2.0), scale);
#if CM_REAL_BITS >= 64
    CM_REAL y = CM_LIT(4.7320859808413733);
    y = cm_mad(scaled, y, CM_LIT(-1.3157514060277796e+1));
    y = cm_mad(scaled, y, CM_LIT(1.3781876596452947e+1));
    y = cm_mad(scaled, y, CM_LIT(-7.0223640058979781));
    y = cm_mad(scaled, y, CM_LIT(2.6726560852131861));
#else
    CM_REAL y = CM_LIT(-2.58686931);
    y = cm_mad(scaled, y, CM_LIT(5.83540608));
    y = cm_mad(scaled, y, CM_LIT(-4.7366916));
    y = cm_mad(scaled, y, CM_LIT(2.47179997));
#endif
    y = CM_NAME(cm_conformal_cube_step)(scaled, y);
#if CM_REAL_BITS >= 64
    y = CM_NAME(cm_conformal_cube_step)(scaled, y);
#endif
#if CM_REAL_BITS > 64
    y = CM_NAME(cm_conformal_cube_step)(scaled, y);
#endif
    CM_REAL inverse = scale * y;
    CM_REAL square = inverse * inverse;
    CM_REAL root = x * square;
    /* the rounding errors of all that, and in float what the last step left, by one of Newton's steps */
    return cm_mad(cm_mad(-root, root * root, x),
                  square * CM_LIT(0.33333333333333333333333333333333333333), root);
}

/* z^(4/3) for z.re >= z.im >= 0: with r = z.im / z.re it is z.re^(4/3) (1 + i r)^(4/3), and the latter
 * 1 + r^2 C + i r S with C and S polynomials in r^2 / (2 + r^2). */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_inverse_power)(CM_NAME(cm_complex) z)
{
    CM_REAL re = cm_max(z.re, CM_LIT(6.9388939039072284e-18)); /* 2^-57, at the corner itself */
    CM_REAL size = re * CM_NAME(cm_conformal_cube_root)(re);
    CM_REAL r = CM_NAME(cm_quotient)(z.im, re);
    CM_REAL square = r * r;
    CM_REAL y = CM_NAME(cm_quotient)(square, CM_LIT(2.0) + square);
#if CM_REAL_BITS >= 64
    CM_REAL even = CM_LIT(3.4566075505424196e-2);
    even = cm_mad(y, even, CM_LIT(-5.572091723030466e-2));
    even = cm_mad(y, even, CM_LIT(5.3272881671730489e-2));
    even = cm_mad(y, even, CM_LIT(-2.5300819847448688e-2));
    even = cm_mad(y, even, CM_LIT(1.3258833490196308e-2));
    even = cm_mad(y, even, CM_LIT(3.5216054519907502e-4));
    even = cm_mad(y, even, CM_LIT(4.2294054301817935e-3));
    even = cm_mad(y, even, CM_LIT(3.8476713462763896e-3));
    even = cm_mad(y, even, CM_LIT(4.9736645672316873e-3));
    even = cm_mad(y, even, CM_LIT(5.301777630967314e-3));
    even = cm_mad(y, even, CM_LIT(7.2855821608339592e-3));
    even = cm_mad(y, even, CM_LIT(7.9059672132418716e-3));
    even = cm_mad(y, even, CM_LIT(1.2836796574733329e-2));
    even = cm_mad(y, even, CM_LIT(1.4327084285767866e-2));
    even = cm_mad(y, even, CM_LIT(4.115226337448627e-2));
    even = cm_mad(y, even, CM_LIT(-2.2222222222222222e-1));
    CM_REAL odd = CM_LIT(2.8590598928323518e-1);
    odd = cm_mad(y, odd, CM_LIT(-4.687287878985247e-1));
    odd = cm_mad(y, odd, CM_LIT(4.4447577157615759e-1));
    odd = cm_mad(y, odd, CM_LIT(-2.1680163042751917e-1));
    odd = cm_mad(y, odd, CM_LIT(1.0610179664069948e-1));
    odd = cm_mad(y, odd, CM_LIT(-2.9863097285834061e-3));
    odd = cm_mad(y, odd, CM_LIT(2.6219001300192347e-2));
    odd = cm_mad(y, odd, CM_LIT(2.2773997671711724e-2));
    odd = cm_mad(y, odd, CM_LIT(2.6155447068964622e-2));
    odd = cm_mad(y, odd, CM_LIT(2.839443965370829e-2));
    odd = cm_mad(y, odd, CM_LIT(3.2994505004056469e-2));
    odd = cm_mad(y, odd, CM_LIT(3.6845726330586079e-2));
    odd = cm_mad(y, odd, CM_LIT(4.6740842486837325e-2));
    odd = cm_mad(y, odd, CM_LIT(5.4869684497917468e-2));
    odd = cm_mad(y, odd, CM_LIT(9.876543209877116e-2));
    odd = cm_mad(y, odd, CM_LIT(1.3333333333333333));
#else
    CM_REAL even = CM_LIT(1.74583068e-2);
    even = cm_mad(y, even, CM_LIT(3.87434177e-4));
    even = cm_mad(y, even, CM_LIT(9.66113196e-3));
    even = cm_mad(y, even, CM_LIT(1.26160902e-2));
    even = cm_mad(y, even, CM_LIT(1.43400724e-2));
    even = cm_mad(y, even, CM_LIT(4.11519789e-2));
    even = cm_mad(y, even, CM_LIT(-2.22222221e-1));
    CM_REAL odd = CM_LIT(1.06419445e-1);
    odd = cm_mad(y, odd, CM_LIT(-2.75644665e-2));
    odd = cm_mad(y, odd, CM_LIT(5.09779092e-2));
    odd = cm_mad(y, odd, CM_LIT(3.37878214e-2));
    odd = cm_mad(y, odd, CM_LIT(4.70170485e-2));
    odd = cm_mad(y, odd, CM_LIT(5.48575721e-2));
    odd = cm_mad(y, odd, CM_LIT(9.87656334e-2));
    odd = cm_mad(y, odd, CM_LIT(1.33333333));
#endif
    return CM_NAME(cm_make_complex)(cm_mad(size, square * even, size), size * (r * odd));
}

/* from the corner in the map: see above */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_conformal_from_corner)(CM_REAL u, CM_REAL v)
{
    return CM_NAME(cm_make_complex)(CM_LIT(0.5) * (CM_LIT(1.0) - v),
                                    CM_LIT(0.5) * (CM_LIT(1.0) - u));
}

/* for 0 <= v <= u */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_conformal_octant_inverse_zone)(CM_ZONE corner, CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_complex) z = CM_NAME(cm_make_complex)(u, v);
    CM_NAME(cm_complex) z_c = CM_NAME(cm_conformal_from_corner)(u, v);
    CM_NAME(cm_complex) square =
        CM_NAME(cm_complex_square)(CM_NAME(cm_conformal_select)(corner, z_c, z));
    CM_NAME(cm_complex) sum =
        CM_NAME(cm_conformal_inverse_sum)(corner, CM_NAME(cm_complex_square)(square));
    /* corner: 1 - p and 1 - q over y; sqrt 3 times the imaginary part of w */
    CM_NAME(cm_complex) w =
        CM_NAME(cm_complex_multiply)(CM_NAME(cm_conformal_inverse_power)(z_c), sum);
    CM_REAL rise = CM_CONFORMAL_SQRT3 * w.im;
    CM_REAL half_square = CM_LIT(0.5) * cm_mad(w.re, w.re, w.im * w.im);
    CM_REAL y = CM_LIT(1.0) + ((w.re + rise) - half_square);
    /* centre: p + i q = z (1 + (|zeta|^2 - sum) / (1 - |zeta|^2)), zeta = z (1 - sum) / 2 */
    CM_REAL rest = CM_LIT(1.0) - sum.re;
    CM_REAL zeta_square =
        (CM_LIT(0.25) * cm_mad(u, u, v * v)) * cm_mad(rest, rest, sum.im * sum.im);
    CM_NAME(cm_complex) d =
        CM_NAME(cm_complex_multiply)(z, CM_NAME(cm_make_complex)(zeta_square - sum.re, -sum.im));
    CM_REAL inverse = CM_LIT(1.0) / CM_IN_ZONE(corner, y, CM_LIT(1.0) - zeta_square);
    CM_REAL p = cm_mad(CM_IN_ZONE(corner, CM_LIT(-2.0) * rise, d.re), inverse,
                       CM_IN_ZONE(corner, CM_LIT(1.0), u));
    CM_REAL q = cm_mad(CM_IN_ZONE(corner, cm_mad(CM_LIT(-3.0), w.re, -rise), d.im), inverse,
                       CM_IN_ZONE(corner, CM_LIT(1.0), v));
    p = CM_SELECT(cm_equal(u, CM_LIT(1.0)), u, cm_min(CM_LIT(1.0), p));
    return CM_NAME(cm_make_pq)(p, CM_SELECT(cm_equal(u, v), p, q));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_conformal_octant_inverse)(CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_complex) z_c = CM_NAME(cm_conformal_from_corner)(u, v);
    CM_BOOL corner = cm_less(cm_mad(z_c.re, z_c.re, z_c.im * z_c.im), CM_LIT(0.1225));
    return CM_BY_ZONE(corner, CM_NAME(cm_conformal_octant_inverse_zone), u, v);
}

#if CM_REAL_BITS > 64

/* One Newton step; the octant's border stays. */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_conformal_newton)(CM_NAME(cm_pq) at, CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_uv) f = CM_NAME(cm_conformal_octant)(at.p, at.q);
    CM_NAME(cm_jacobian) j = CM_NAME(cm_conformal_octant_jacobian)(at.p, at.q);
    CM_REAL scale = CM_LIT(1.0) / CM_NAME(cm_jacobian_determinant)(j);
    CM_REAL p = at.p + (j.v_q * (u - f.u) - j.u_q * (v - f.v)) * scale;
    CM_REAL q = at.q + (j.u_p * (v - f.v) - j.v_p * (u - f.u)) * scale;
    p = CM_SELECT(cm_equal(u, CM_LIT(1.0)), u, cm_min(CM_LIT(1.0), p));
    return CM_NAME(cm_make_pq)(p, CM_SELECT(cm_equal(u, v), p, q));
}

#endif

CM_FN CM_NAME(cm_pq) CM_NAME(cm_conformal_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_u = cm_abs(u);
    CM_REAL abs_v = cm_abs(v);
    CM_BOOL wide = cm_at_least(abs_u, abs_v);
    CM_REAL major = CM_SELECT(wide, abs_u, abs_v);
    CM_REAL minor = CM_SELECT(wide, abs_v, abs_u);
    CM_NAME(cm_pq) r = CM_NAME(cm_conformal_octant_inverse)(major, minor);
#if CM_REAL_BITS > 64
    r = CM_NAME(cm_conformal_newton)(r, major, minor);
    r = CM_NAME(cm_conformal_newton)(r, major, minor);
#endif
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, r.p, r.q), u),
                               cm_copysign(CM_SELECT(wide, r.q, r.p), v));
}

#endif
