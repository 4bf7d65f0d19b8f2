/* SPDX-License-Identifier: MIT
 *
 * unicube: u = (6 / pi) asin(p / sqrt(2 p^2 + 2)) = (6 / pi) atan(p / sqrt(2 + p^2)).
 *
 * It has no parameter, so one polynomial serves for the whole of it: u = p + p (1 - p^2) G(p^2) and
 * p = u - u (1 - u^2) H(u^2), with G between 0.22 and 0.35 and H between 0.26 and 0.41. The edge is
 * exact and only the last addition rounds by more than a third of a unit. research/elementary derives
 * the coefficients.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(unicube,
        .identifier = "unicube",
        .aliases = "",
        .name = "unicube",
        .source = "Ho, Wan, Leung, Lam, Wong 2011, Unicube for dynamic environment mapping; "
                  "Lambers 2020, eq. 5",
        .family = CM_FAMILY_UNIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_unicube_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#if CM_REAL_BITS <= 64

/* G(z), z = p^2 */
CM_FN CM_REAL CM_NAME(cm_unicube_bend)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
#if CM_REAL_BITS == 64
    CM_REAL a = cm_mad(t, CM_LIT(-1.1778167129379338e-1), CM_LIT(2.7168354136262074e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-3.0797344880222659e-2), CM_LIT(5.8261380592083398e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-9.6237413835044087e-3), CM_LIT(1.6968938963746981e-2));
    CM_REAL d = cm_mad(t, CM_LIT(-3.2851713073876734e-3), CM_LIT(5.5763323133892579e-3));
    CM_REAL e = cm_mad(t, CM_LIT(-1.1833388405424446e-3), CM_LIT(1.9611103989126879e-3));
    CM_REAL f = cm_mad(t, CM_LIT(-4.4201278187316819e-4), CM_LIT(7.2044989310751672e-4));
    CM_REAL g = cm_mad(t, CM_LIT(-1.6840764702206765e-4), CM_LIT(2.7250687874662250e-4));
    CM_REAL h = cm_mad(t, CM_LIT(-6.9937436515507759e-5), CM_LIT(1.0716565404654928e-4));
    CM_REAL i = cm_mad(t, CM_LIT(-1.6700537380384999e-5), CM_LIT(3.5928286536470256e-5));
    CM_REAL j = cm_mad(t, CM_LIT(-2.2409534941600882e-5), CM_LIT(2.7045440570039705e-5));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    i = cm_mad(t2, j, i);
    return cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, i, g), e), c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(-1.17781609e-1), CM_LIT(2.71683544e-1));
    CM_REAL b = cm_mad(t, CM_LIT(-3.08026671e-2), CM_LIT(5.82597181e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-9.52239987e-3), CM_LIT(1.70118995e-2));
    CM_REAL d = cm_mad(t, CM_LIT(-3.92929278e-3), CM_LIT(5.21856360e-3));
    CM_REAL e = CM_LIT(3.01940669e-3);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    return cm_mad(t4, cm_mad(t4, e, c), a);
#endif
}

/* H(z), z = u^2 */
CM_FN CM_REAL CM_NAME(cm_unicube_straighten)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.5);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
#if CM_REAL_BITS == 64
    CM_REAL a = cm_mad(t, CM_LIT(1.3836223333971626e-1), CM_LIT(3.1536753327833095e-1));
    CM_REAL b = cm_mad(t, CM_LIT(3.3610460148880306e-2), CM_LIT(6.6695390038284924e-2));
    CM_REAL c = cm_mad(t, CM_LIT(9.1401920585696371e-3), CM_LIT(1.7379893982607593e-2));
    CM_REAL d = cm_mad(t, CM_LIT(2.6123606797748152e-3), CM_LIT(4.8647057878032883e-3));
    CM_REAL e = cm_mad(t, CM_LIT(7.6806729442564217e-4), CM_LIT(1.4125869742764917e-3));
    CM_REAL f = cm_mad(t, CM_LIT(2.2993750385405672e-4), CM_LIT(4.1949810776781488e-4));
    CM_REAL g = cm_mad(t, CM_LIT(7.0127980368376257e-5), CM_LIT(1.2654681355533915e-4));
    CM_REAL h = cm_mad(t, CM_LIT(1.9956130688734791e-5), CM_LIT(3.8420883014899591e-5));
    CM_REAL i = cm_mad(t, CM_LIT(9.4125680152173495e-6), CM_LIT(1.1848711392640434e-5));
    CM_REAL j = CM_LIT(4.5207743489113512e-6);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    i = cm_mad(t2, j, i);
    return cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, i, g), e), c), a);
#else
    CM_REAL a = cm_mad(t, CM_LIT(1.38362184e-1), CM_LIT(3.15367520e-1));
    CM_REAL b = cm_mad(t, CM_LIT(3.36141698e-2), CM_LIT(6.66959360e-2));
    CM_REAL c = cm_mad(t, CM_LIT(9.07299947e-3), CM_LIT(1.73681751e-2));
    CM_REAL d = cm_mad(t, CM_LIT(3.02888104e-3), CM_LIT(4.92856419e-3));
    CM_REAL e = CM_LIT(1.41706225e-3);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    return cm_mad(t4, cm_mad(t4, e, c), a);
#endif
}

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_stretch)(w, ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)) *
                                      CM_NAME(cm_unicube_bend)(w * w));
}

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_stretch)(w, ((w - CM_LIT(1.0)) * (CM_LIT(1.0) + w)) *
                                      CM_NAME(cm_unicube_straighten)(w * w));
}

#else /* the definition */

#define CM_UNICUBE_PI CM_LIT(3.14159265358979323846264338327950288)

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    return CM_NAME(cm_atan)(w / cm_sqrt(CM_LIT(2.0) + w * w)) * (CM_LIT(6.0) / CM_UNICUBE_PI);
}

CM_FN CM_REAL CM_NAME(cm_unicube_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL sine = CM_NAME(cm_sin_quarter)(w * (CM_UNICUBE_PI / CM_LIT(6.0)));
    return sine * cm_sqrt(CM_LIT(2.0) / ((CM_LIT(1.0) - CM_LIT(2.0) * (sine * sine))));
}

#endif

CM_UNIVARIATE(cm_unicube_forward, cm_unicube_sigmoid, cm_unicube_inverse,
              cm_unicube_sigmoid_inverse)

/* (6 / pi) / ((1 + w^2) sqrt(2 + w^2)) */
CM_FN CM_REAL CM_NAME(cm_unicube_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    CM_UNUSED(f);
    CM_UNUSED(k);
    CM_REAL z = w * w;
    return CM_LIT(1.90985931710274402922660516047017234442) /
           ((CM_LIT(1.0) + z) * cm_sqrt(CM_LIT(2.0) + z));
}

CM_UNIVARIATE_JACOBIAN(cm_unicube_jacobian, cm_unicube_slope)

#endif
