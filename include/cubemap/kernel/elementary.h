/* SPDX-License-Identifier: MIT
 *
 * The elementary functions of the kernels, on the narrow domains that cube mappings need.
 *
 * Read once per backend, after dialect.h, so without an include guard; one text for double and for
 * float, with coefficients for each. research/elementary/minimax.sollya derives the coefficients,
 * tests/batch/test_elementary_accuracy.c measures the errors. Those stated here are the worst that it finds,
 * run with "full" and without contraction; fused multiply-adds lower nearly all of them.
 *
 * Common to all of them:
 *   - no branch, no table, no fused multiply-add needed;
 *   - the leading term is exact and the polynomial makes the rest, so that its rounding errors are
 *     scaled down by the smallness of that rest. Polynomials are evaluated by pairs, then fours,
 *     which keeps the chain of dependent operations short;
 *   - atan, tan, tanh and atanh are given by their excess E(x^2) = f(x) / x - 1, so that
 *     f(x) = x + x E(x^2): E is small, and a mapping that is f scaled to [-1, 1] is w plus w times a
 *     difference of two E, in which their rounding errors are scaled down again. E is z R(t) with
 *     t = z - m and m near the end of the domain: there E is greatest, and there R is its first
 *     coefficient and next to nothing more, so that only one rounding error of R counts;
 *   - odd functions give the same bits for -x but for the sign, are relatively accurate down to
 *     subnormals and keep the sign of zero (where the sum would turn -0 into +0, a select stands);
 *   - NaN gives NaN; a little outside its domain a function is less accurate, but harmless.
 * The worst error of an excess is that of x + x E(x^2), evaluated so.
 *
 * A compiler that is free to reassociate (-ffast-math, some shader compilers) may undo the
 * splitting in versine. What is left is a correct formula with a greater error.
 */

/* The excess of atan x for |x| <= 1, from z = x^2.
 * Worst error: double 0.96 ulp at 0x1.fed70c4da09dep-1, float 0.96 ulp at 0x1.e66dfp-1. */
CM_FN CM_REAL CM_NAME(cm_atan_excess)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.970703125);
#if CM_REAL_BITS == 64
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(-2.8379391739745751e-2), CM_LIT(7.3536042015448222e-2));
    CM_REAL b = cm_mad(t, CM_LIT(-4.9931015391609249e-3), CM_LIT(1.1674978453434726e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-9.8113810607287520e-4), CM_LIT(2.1923470929871578e-3));
    CM_REAL d = cm_mad(t, CM_LIT(-2.0245905559077454e-4), CM_LIT(4.4579480203439691e-4));
    CM_REAL e = cm_mad(t, CM_LIT(7.6629820600679345e-6), CM_LIT(1.0737976849495455e-4));
    CM_REAL f = cm_mad(t, CM_LIT(3.6407505556845077e-4), CM_LIT(1.8142338743792818e-4));
    CM_REAL g = cm_mad(t, CM_LIT(8.7426274843683388e-4), CM_LIT(6.6395129523001966e-4));
    CM_REAL h = cm_mad(t, CM_LIT(6.1846837401434093e-4), CM_LIT(8.6744468678561447e-4));
    CM_REAL i = cm_mad(t, CM_LIT(9.1754107276600447e-5), CM_LIT(3.0358792909335875e-4));
    CM_REAL j = CM_LIT(1.3225091314152730e-5);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    i = cm_mad(t2, j, i);
    CM_REAL r = cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, i, g), e), c), a);
    r = cm_mad(t, r, CM_LIT(-2.1673214455010723e-1));
#else
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(-2.83826403e-2), CM_LIT(7.35360682e-2));
    CM_REAL b = cm_mad(t, CM_LIT(-5.46732545e-3), CM_LIT(1.16101475e-2));
    CM_REAL c = cm_mad(t, CM_LIT(-4.33581043e-3), CM_LIT(4.73424647e-4));
    CM_REAL d = cm_mad(t, CM_LIT(-1.79362297e-3), CM_LIT(-3.01399198e-3));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    CM_REAL r = cm_mad(t4, c, a);
    r = cm_mad(t, r, CM_LIT(-2.16732144e-1));
#endif
    return z * r;
}

/* The excess of tan x for |x| <= pi / 4, from z = x^2.
 * Worst error: double 1.15 ulp at 0x1.921fb4f104f61p-1, float 1.16 ulp at 0x1.911cf6p-1. */
CM_FN CM_REAL CM_NAME(cm_tan_excess)(CM_REAL z)
{
#if CM_REAL_BITS == 64
    CM_REAL t = z - CM_LIT(0.595188140869140625);
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(1.2352544053200641e-1), CM_LIT(2.3145198120333721e-1));
    CM_REAL b = cm_mad(t, CM_LIT(3.5238242649749757e-2), CM_LIT(6.5973874046565933e-2));
    CM_REAL c = cm_mad(t, CM_LIT(1.0053166005775863e-2), CM_LIT(1.8821696168338880e-2));
    CM_REAL d = cm_mad(t, CM_LIT(2.8670818743095202e-3), CM_LIT(5.3695253065728088e-3));
    CM_REAL e = cm_mad(t, CM_LIT(8.0332455736978445e-4), CM_LIT(1.5273158228438068e-3));
    CM_REAL f = cm_mad(t, CM_LIT(1.7612480483089260e-4), CM_LIT(4.0248368725772624e-4));
    CM_REAL g = cm_mad(t, CM_LIT(9.7109579264302020e-6), CM_LIT(5.7038322524313956e-5));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    CM_REAL r = cm_mad(t4, cm_mad(t4, cm_mad(t4, g, e), c), a);
    r = cm_mad(t, r, CM_LIT(4.3788687902798390e-1));
#else
    CM_REAL t = z - CM_LIT(0.6103515625);
    CM_REAL t2 = t * t;
    CM_REAL a = cm_mad(t, CM_LIT(1.26562223e-1), CM_LIT(2.35243797e-1));
    CM_REAL b = cm_mad(t, CM_LIT(3.55633982e-2), CM_LIT(6.79713488e-2));
    CM_REAL c = cm_mad(t, CM_LIT(4.37629269e-3), CM_LIT(1.61159523e-2));
    CM_REAL r = cm_mad(t2, cm_mad(t2, c, b), a);
    r = cm_mad(t, r, CM_LIT(4.41425115e-1));
#endif
    return z * r;
}

/* sin x for |x| <= pi / 4.
 * Worst error: double 0.80 ulp at 0x1.921fb519aa713p-1, float 0.74 ulp at 0x1.753b44p-1. */
CM_FN CM_REAL CM_NAME(cm_sin_quarter)(CM_REAL x)
{
    CM_REAL z = x * x;
#if CM_REAL_BITS == 64
    CM_REAL z2 = z * z;
    CM_REAL a = cm_mad(z, CM_LIT(8.3333333333219239e-3), CM_LIT(-1.6666666666666630e-1));
    CM_REAL b = cm_mad(z, CM_LIT(2.7557313585037963e-6), CM_LIT(-1.9841269829464980e-4));
    CM_REAL c = cm_mad(z, CM_LIT(1.5895975168098640e-10), CM_LIT(-2.5050742816066740e-8));
    CM_REAL r = cm_mad(z2, cm_mad(z2, c, b), a);
#else
    CM_REAL r =
        cm_mad(z, cm_mad(z, CM_LIT(-1.95184548e-4), CM_LIT(8.33219010e-3)), CM_LIT(-1.66666552e-1));
#endif
    r = x + (x * z) * r;
    return CM_SELECT(cm_equal(x, CM_LIT(0.0)), x, r);
}

/* 1 - cos x for |x| <= pi / 4, relatively accurate near 0.
 * The leading term x^2 / 2 has no larger term to hide its rounding error, so x is split (Dekker)
 * into a head whose square is exact and a tail: x^2 = head^2 + (x - head) (x + head). Contraction
 * may make head = x, but then it also makes head^2 exact.
 * Worst error: double 1.00 ulp at 0x1.102d347ce68bcp-512, float 1.00 ulp at 0x1.802aaap-69.
 * These are results that are subnormal; elsewhere 0.70 and 0.71. */
CM_FN CM_REAL CM_NAME(cm_versine_quarter)(CM_REAL x)
{
    CM_REAL z = x * x;
#if CM_REAL_BITS == 64
    CM_REAL z2 = z * z;
    CM_REAL a = cm_mad(z, CM_LIT(1.3888888888881773e-3), CM_LIT(-4.1666666666666644e-2));
    CM_REAL b = cm_mad(z, CM_LIT(2.7557315705419162e-7), CM_LIT(-2.4801587294225240e-5));
    CM_REAL c = cm_mad(z, CM_LIT(1.1368855994000267e-11), CM_LIT(-2.0875904305974629e-9));
    CM_REAL r = cm_mad(z2, cm_mad(z2, c, b), a);
#else
    CM_REAL r =
        cm_mad(z, cm_mad(z, CM_LIT(-2.44675030e-5), CM_LIT(1.38876424e-3)), CM_LIT(-4.16666530e-2));
#endif
#if CM_REAL_BITS == 64
    CM_REAL wide = CM_LIT(134217729.0) * x; /* 2^27 + 1 */
#else
    CM_REAL wide = CM_LIT(4097.0) * x; /* 2^12 + 1 */
#endif
    CM_REAL head = wide - (wide - x);
    CM_REAL tail = (CM_LIT(0.5) * (x - head)) * (x + head);
    return (CM_LIT(0.5) * head) * head + (tail + (z * z) * r);
}

/* The excess of tanh x for |x| <= 1, from z = x^2.
 * Worst error: double 0.99 ulp at 0x1.cce2493840406p-1, float 1.03 ulp at 0x1.d34f0cp-1. */
CM_FN CM_REAL CM_NAME(cm_tanh_excess)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.9921875);
#if CM_REAL_BITS == 64
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(-1.9583036543589529e-2), CM_LIT(6.7900888791818256e-2));
    CM_REAL b = cm_mad(t, CM_LIT(-1.6355789702764104e-3), CM_LIT(5.6586970654115198e-3));
    CM_REAL c = cm_mad(t, CM_LIT(-1.3665104801355787e-4), CM_LIT(4.7276383488353320e-4));
    CM_REAL d = cm_mad(t, CM_LIT(-1.1376863148563170e-5), CM_LIT(3.9510376535426373e-5));
    CM_REAL e = cm_mad(t, CM_LIT(-7.3431364469256871e-7), CM_LIT(3.4114341838489117e-6));
    CM_REAL f = cm_mad(t, CM_LIT(2.3339545015527080e-7), CM_LIT(5.8772449732433837e-7));
    CM_REAL g = cm_mad(t, CM_LIT(8.3848936018678008e-8), CM_LIT(2.3625357103208460e-7));
    CM_REAL h = CM_LIT(2.1270509246966235e-8);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    CM_REAL r = cm_mad(t4, cm_mad(t4, cm_mad(t4, g, e), c), a);
    r = cm_mad(t, r, CM_LIT(-2.3893512717642365e-1));
#else
    CM_REAL t2 = t * t;
    CM_REAL a = cm_mad(t, CM_LIT(-1.95902716e-2), CM_LIT(6.79005757e-2));
    CM_REAL b = cm_mad(t, CM_LIT(-1.82227662e-3), CM_LIT(5.60368504e-3));
    CM_REAL c = cm_mad(t, CM_LIT(-3.58452002e-4), CM_LIT(1.67454986e-4));
    CM_REAL r = cm_mad(t2, cm_mad(t2, c, b), a);
    r = cm_mad(t, r, CM_LIT(-2.38935128e-1));
#endif
    return z * r;
}

/* The excess of atanh x for |x| <= 0.7616, just beyond tanh 1, from z = x^2.
 * R is a little over 1/2 where it matters; that half is added apart, which costs no rounding error.
 * About x = 0 the coefficients would grow to thousands and cancel each other; not so in t.
 * Worst error: double 1.20 ulp at 0x1.85ee497ae28e5p-1, float 1.19 ulp at 0x1.837dbap-1. */
CM_FN CM_REAL CM_NAME(cm_atanh_excess)(CM_REAL z)
{
    CM_REAL t = z - CM_LIT(0.536441802978515625);
#if CM_REAL_BITS == 64
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(8.2523338459036955e-1), CM_LIT(5.7657343660830951e-1));
    CM_REAL b = cm_mad(t, CM_LIT(2.2691194445230631), CM_LIT(1.3242477791777696));
    CM_REAL c = cm_mad(t, CM_LIT(7.4649938891012440), CM_LIT(4.0558150112148139));
    CM_REAL d = cm_mad(t, CM_LIT(2.6836737381473906e1), CM_LIT(1.4038324653682999e1));
    CM_REAL e = cm_mad(t, CM_LIT(1.0169080320642816e2), CM_LIT(5.1970996231060063e1));
    CM_REAL f = cm_mad(t, CM_LIT(3.9607570797247485e2), CM_LIT(2.0048988981705355e2));
    CM_REAL g = cm_mad(t, CM_LIT(1.4565517461662118e3), CM_LIT(7.7370584419182126e2));
    CM_REAL h = cm_mad(t, CM_LIT(3.9409735265071208e3), CM_LIT(2.5440033858251863e3));
    CM_REAL i = cm_mad(t, CM_LIT(5.4692890473417165e3), CM_LIT(5.1677988264764026e3));
    CM_REAL j = cm_mad(t, CM_LIT(2.5511524508381249e3), CM_LIT(4.4277575900743022e3));
    CM_REAL k = cm_mad(t, CM_LIT(1.5865019571371363e2), CM_LIT(9.2620294818447587e2));
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    e = cm_mad(t2, f, e);
    g = cm_mad(t2, h, g);
    i = cm_mad(t2, j, i);
    CM_REAL r = cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, cm_mad(t4, k, i), g), e), c), a);
    r = cm_mad(t, r, CM_LIT(1.2876751396072359e-2));
#else
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL a = cm_mad(t, CM_LIT(8.25255513e-1), CM_LIT(5.76573491e-1));
    CM_REAL b = cm_mad(t, CM_LIT(2.26225209), CM_LIT(1.32444394));
    CM_REAL c = cm_mad(t, CM_LIT(6.18823671), CM_LIT(3.90829182));
    CM_REAL d = cm_mad(t, CM_LIT(6.19873190), CM_LIT(7.70400238));
    CM_REAL e = CM_LIT(2.30680275);
    a = cm_mad(t2, b, a);
    c = cm_mad(t2, d, c);
    CM_REAL r = cm_mad(t4, cm_mad(t4, e, c), a);
    r = cm_mad(t, r, CM_LIT(1.28767435e-2));
#endif
    return cm_mad(z, r, CM_LIT(0.5) * z);
}

/* About 2 sin(asin(y) / 3), the root x in [0, 1] of 3 x - x^3 = 2 y, for 0 <= y <= 1, to start one
 * Newton step. s is sqrt(1 - y), with which x = y (1 + s K(s)) for an analytic K, so that one
 * polynomial serves both for small y and for the double root at y = 1.
 * Worst error relative to x, or to 1 - x: double 2^-28.9, float 2^-15. */
CM_FN CM_REAL CM_NAME(cm_trisect)(CM_REAL y, CM_REAL s)
{
#if CM_REAL_BITS == 64
    CM_REAL s2 = s * s;
    CM_REAL s4 = s2 * s2;
    CM_REAL a = cm_mad(s, CM_LIT(8.8888838074977872e-1), CM_LIT(-8.1649657929233455e-1));
    CM_REAL b = cm_mad(s, CM_LIT(8.7188581649925190e-1), CM_LIT(-8.5427093497103301e-1));
    CM_REAL c = cm_mad(s, CM_LIT(8.3113668481175507e-1), CM_LIT(-8.5658195319644093e-1));
    CM_REAL d = cm_mad(s, CM_LIT(4.4517318193693484e-1), CM_LIT(-7.1259759344228490e-1));
    CM_REAL e = cm_mad(s, CM_LIT(-2.5458945329634725e-1), CM_LIT(-5.2962152566214990e-2));
    CM_REAL f = cm_mad(s, CM_LIT(-1.5427319983404772e-1), CM_LIT(2.9844978273613970e-1));
    CM_REAL g = CM_LIT(3.2904685194952557e-2);
    a = cm_mad(s2, b, a);
    c = cm_mad(s2, d, c);
    e = cm_mad(s2, f, e);
    CM_REAL k = cm_mad(s4, cm_mad(s4, cm_mad(s4, g, e), c), a);
#else
    CM_REAL s2 = s * s;
    CM_REAL a = cm_mad(s, CM_LIT(8.86878431e-1), CM_LIT(-8.16472769e-1));
    CM_REAL b = cm_mad(s, CM_LIT(7.14204192e-1), CM_LIT(-8.25706780e-1));
    CM_REAL c = cm_mad(s, CM_LIT(1.24818668e-1), CM_LIT(-4.17035669e-1));
    CM_REAL k = cm_mad(s2, cm_mad(s2, c, b), a);
#endif
    return y * (CM_LIT(1.0) + s * k);
}
