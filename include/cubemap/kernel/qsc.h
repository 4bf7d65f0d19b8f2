/* SPDX-License-Identifier: MIT
 *
 * qsc: the quadrilateralized spherical cube, equal-area, with creases on the diagonals of a face;
 * slice.h is equal-area with smaller creases and less distortion.
 * The same mapping as Snyder's (1992) equal-area cube and as Rosca & Plonka's (2011).
 *
 * The printed formulas lose half the digits at the centre and all of them on the axes (acos of a
 * number near 1). Here the sector |p| >= |q| is written with t = q / p and r = sqrt(2 + t^2), and the
 * other by swapping. v / u depends on t alone: it is w = (12 / pi) a with the angle a that the papers
 * give as t = sin a / (cos a - 1/sqrt 2), which by half angles is
 *     tan(a / 2) = t (sqrt 2 - 1) / (r + sqrt 2).
 * Both directions of that are one polynomial, w = t + t (1 - t^2) G(t^2) and t = w - w (1 - w^2) H(w^2)
 * with G and H about 0.1, exact on the diagonal. research/elementary derives the coefficients.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(qsc,
        .identifier = "qsc",
        .aliases = "snyder rosca-plonka",
        .name = "quadrilateralized spherical cube",
        .source = "O'Neill & Laubscher 1976; Lambers 2020, eq. 1 (reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_C0,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_C0,
        .bounds = {.round_trip = 3.4, .plane_round_trip = 5, .forward = 3.5, .inverse = 3,
                   .relative = 7},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_qsc_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#if CM_REAL_BITS <= 64

/* G(z), z = t^2 */
CM_FN CM_REAL CM_NAME(cm_qsc_bend)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
#if CM_REAL_BITS == 64
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(-2.1961390716897265e-2), CM_LIT(1.0615000502962231e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-1.5967083492698208e-3), CM_LIT(5.6134091146451404e-3));
    CM_REAL c = cm_mad(t, CM_LIT(-1.5374729087981500e-4), CM_LIT(4.8470718603886863e-4));
    CM_REAL d = cm_mad(t, CM_LIT(-1.6882094828084027e-5), CM_LIT(5.0339179351028393e-5));
    CM_REAL e = cm_mad(t, CM_LIT(-2.0018762580562573e-6), CM_LIT(5.7691330580042528e-6));
    CM_REAL f = cm_mad(t, CM_LIT(-2.4827565409534262e-7), CM_LIT(7.0378811862275126e-7));
    CM_REAL g = cm_mad(t, CM_LIT(-3.6198443637375944e-8), CM_LIT(8.7303740353679913e-8));
    CM_REAL h = CM_LIT(1.5124334989133468e-8);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    return cm_mad(t4, cm_mad(t4, cm_mad(t4, g, e), c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(-2.19616350e-2), CM_LIT(1.06150009e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-1.59102294e-3), CM_LIT(5.61250607e-3));
    CM_REAL c = cm_mad(t, CM_LIT(-1.80117480e-4), CM_LIT(4.99413523e-4));
    a = cm_mad(t2, b, a);
    return a + (t2 * t2) * c;
#endif
}

/* H(z), z = w^2 */
CM_FN CM_REAL CM_NAME(cm_qsc_straighten)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
#if CM_REAL_BITS == 64
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(1.3217130243902243e-2), CM_LIT(1.1240240518902343e-1));
    CM_REAL b = cm_mad(t, CM_LIT(1.8293452638543057e-4), CM_LIT(1.5549437009784312e-3));
    CM_REAL c = cm_mad(t, CM_LIT(2.5319658366546534e-6), CM_LIT(2.1521708947467036e-5));
    CM_REAL d = cm_mad(t, CM_LIT(3.5043622173221922e-8), CM_LIT(2.9787809767612589e-7));
    CM_REAL e = cm_mad(t, CM_LIT(4.8915588924864857e-10), CM_LIT(4.1239776066890040e-9));
    CM_REAL f = CM_LIT(5.5457480779075641e-11);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    return cm_mad(t4, cm_mad(t4, e, c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(1.32171111e-2), CM_LIT(1.12402402e-1));
    CM_REAL b = cm_mad(t, CM_LIT(1.83491298e-4), CM_LIT(1.55509659e-3));
    CM_REAL c = CM_LIT(2.07460926e-5);
    a = cm_mad(t2, b, a);
    return a + (t2 * t2) * c;
#endif
}

/* w = v / u from t = q / p, in [0, 1] */
CM_FN CM_REAL CM_NAME(cm_qsc_across)(CM_REAL t)
{
    return cm_mad(t, ((CM_LIT(1.0) - t) * (CM_LIT(1.0) + t)) * CM_NAME(cm_qsc_bend)(t * t), t);
}

CM_FN CM_REAL CM_NAME(cm_qsc_across_inverse)(CM_REAL w)
{
    return w - w * (((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)) * CM_NAME(cm_qsc_straighten)(w * w));
}

#else /* the definition */

#define CM_QSC_SQRT2 CM_LIT(1.4142135623730950488016887242096980786)
#define CM_QSC_PI CM_LIT(3.14159265358979323846264338327950288420)

CM_FN CM_REAL CM_NAME(cm_qsc_across)(CM_REAL t)
{
    CM_REAL half_tan =
        t * (CM_QSC_SQRT2 - CM_LIT(1.0)) / (cm_sqrt(CM_LIT(2.0) + t * t) + CM_QSC_SQRT2);
    return CM_NAME(cm_atan)(half_tan) * (CM_LIT(24.0) / CM_QSC_PI);
}

CM_FN CM_REAL CM_NAME(cm_qsc_across_inverse)(CM_REAL w)
{
    CM_REAL angle = w * (CM_QSC_PI / CM_LIT(12.0));
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(angle);
    return CM_NAME(cm_sin_quarter)(angle) / (cosine - CM_LIT(0.5) * CM_QSC_SQRT2);
}

#endif

CM_FN CM_NAME(cm_uv) CM_NAME(cm_qsc_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_REAL t2 = t * t;
    CM_REAL r = cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL w = cm_sqrt((CM_LIT(1.0) + major * major) + minor * minor);
    /* u = p / sqrt(w (w + 1) / (r (r + 1))), where r^2 - w^2 = (1 - p^2)(1 + t^2), so that the quotient
     * is 1 - (r^2 - w^2)(r + w + 1) / ((r + w) r (r + 1)) */
    CM_REAL sum = r + w;
    CM_REAL difference = ((CM_LIT(1.0) - major) * (CM_LIT(1.0) + major)) * (CM_LIT(1.0) + t2);
    CM_REAL u =
        CM_NAME(cm_divide_by_root)(major, -CM_NAME(cm_quotient)(difference * (sum + CM_LIT(1.0)),
                                                                sum * (r * (r + CM_LIT(1.0)))));
    CM_REAL v = u * CM_NAME(cm_qsc_across)(t);
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(wide, u, v), p),
                               cm_copysign(CM_SELECT(wide, v, u), q));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_qsc_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_u = cm_abs(u);
    CM_REAL abs_v = cm_abs(v);
    CM_BOOL wide = cm_at_least(abs_u, abs_v);
    CM_REAL major = CM_SELECT(wide, abs_u, abs_v);
    CM_REAL minor = CM_SELECT(wide, abs_v, abs_u);
    CM_REAL t = CM_NAME(cm_qsc_across_inverse)(
        minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0)));
    CM_REAL t2 = t * t;
    /* with r^2 = 2 + t^2 and r1 = r + 1: e = (1 - u^2)(1 + t^2) / r1, where (1 + t^2) / r1 = r - 1, and
     * p = u g / (1 + e) with g = sqrt(1 + e / r1), as u minus what is missing. The division does not wait for the root */
    CM_REAL r = cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL r1 = r + CM_LIT(1.0);
    CM_REAL less = r - CM_LIT(1.0);
    CM_REAL e = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major) * less;
    CM_REAL over_r1 = less * (CM_LIT(1.0) / (CM_LIT(1.0) + t2));
    CM_REAL g1 = r1 * (CM_LIT(1.0) + cm_sqrt(CM_LIT(1.0) + e * over_r1));
    CM_REAL p =
        major - major * CM_NAME(cm_quotient)(e * (g1 - CM_LIT(1.0)), g1 * (CM_LIT(1.0) + e));
    CM_REAL q = p * t;
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, p, q), u),
                               cm_copysign(CM_SELECT(wide, q, p), v));
}

/* With s = u / p = sqrt(r (r + 1) / (w (w + 1))) and t, r, w as in forward, in the sector p >= q >= 0:
 *     u_q = s t delta / 2,  u_p = s ((w + 1) / w^2 - t^2 delta) / 2,
 *     delta = (1 - p^2)(r w + r + w) / ((r + w)(r w)^2),
 * where differences of the derivatives of r and w are multiplied out, so that delta vanishes exactly
 * on the edge. v / u is W(t), and as areas are equal, W' = (12 / pi) / (r (r + 1)):
 *     v_q = u_q W + s W',  v_p = u_p W - s t W'.
 * On a crease it is the matrix of the sector that forward chooses, |p| >= |q|; at the centre of a face,
 * where all sectors meet, it is that of the sector of u on its axis. v_p is a
 * difference, and small near that axis: accurate beside the other entries, not beside itself. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_qsc_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_REAL t2 = t * t;
    CM_REAL r = cm_sqrt(CM_LIT(2.0) + t2);
    CM_REAL w = cm_sqrt((CM_LIT(1.0) + major * major) + minor * minor);
    CM_REAL r1 = r + CM_LIT(1.0);
    CM_REAL w1 = w + CM_LIT(1.0);
    CM_REAL rr1 = r * r1;
    CM_REAL ww1 = w * w1;
    CM_REAL sum = r + w;
    /* one division for 1 / r, 1 / w and 1 / (r + w) */
    CM_REAL ww1_sum = ww1 * sum;
    CM_REAL inverse_all = CM_LIT(1.0) / (rr1 * ww1_sum);
    CM_REAL inverse_rr1 = inverse_all * ww1_sum;
    CM_REAL all_rr1 = inverse_all * rr1;
    CM_REAL inverse_ww1 = all_rr1 * sum;
    CM_REAL inverse_r = inverse_rr1 * r1;
    CM_REAL inverse_w = inverse_ww1 * w1;
    CM_REAL inverse_rw = inverse_r * inverse_w;

    CM_REAL s = cm_sqrt(rr1 * inverse_ww1);
    CM_REAL half_s = CM_LIT(0.5) * s;
    CM_REAL delta = ((CM_LIT(1.0) - major) * (CM_LIT(1.0) + major)) * (r * w + sum) *
                    (all_rr1 * ww1) * (inverse_rw * inverse_rw);
    CM_REAL u_minor = half_s * (t * delta);
    CM_REAL u_major = half_s * (w1 * (inverse_w * inverse_w) - t2 * delta);
    CM_REAL across = CM_NAME(cm_qsc_across)(t);
    CM_REAL turn =
        (s * inverse_rr1) * CM_LIT(3.81971863420548805845321032094034468883); /* 12 / pi */
    CM_REAL v_minor = u_minor * across + turn;
    CM_REAL v_major = u_major * across - t * turn;
    /* off the diagonal a sign for each of p and q */
    CM_REAL u_cross = cm_copysign(CM_LIT(1.0), p) * cm_copysign(u_minor, q);
    CM_REAL v_cross = (cm_copysign(CM_LIT(1.0), p) * cm_copysign(CM_LIT(1.0), q)) * v_major;
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(wide, u_major, v_minor), CM_SELECT(wide, u_cross, v_cross),
        CM_SELECT(wide, v_cross, u_cross), CM_SELECT(wide, v_minor, u_major));
}

#endif
