/* SPDX-License-Identifier: MIT
 *
 * Multiplication by a factor near 1, as the factor's difference from 1: rounded less than a product
 * with the factor itself, and exact where the difference vanishes, which is the edge of a face. The
 * sign of zero is kept, which w + w d loses for w = -0, d < 0.
 */
#ifndef CM_DESCRIPTORS

/* w (1 + d), d > -1; with CM_STRETCH_NONE_ZERO no w is 0, so that the sum has its sign. */
CM_FN CM_REAL CM_NAME(cm_stretch)(CM_REAL w, CM_REAL d)
{
#ifdef CM_STRETCH_NONE_ZERO
    return cm_mad(w, d, w);
#else
    return cm_copysign(cm_mad(w, d, w), w);
#endif
}

/* The same for a d that vanishes at |w| = 1 but for rounding errors, which differ between compilers:
 * exact there nevertheless, and never beyond 1. */
CM_FN CM_REAL CM_NAME(cm_stretch_inside)(CM_REAL w, CM_REAL d)
{
    CM_REAL stretched = cm_abs(cm_mad(w, d, w));
#if CM_REAL_BITS <= 64 /* more digits are for differences, whose steps go beyond */
    stretched = cm_min(CM_LIT(1.0), stretched);
#endif
    return cm_copysign(CM_SELECT(cm_equal(cm_abs(w), CM_LIT(1.0)), CM_LIT(1.0), stretched), w);
}

/* 1 / sqrt(1 + h) - 1; h > -1. Where the dialect has CM_ROUGH_INVERSE_ROOT(x), 1 / sqrt(x) to half the
 * digits, in which 1 / x is its square without rounding, two corrections by
 * e = 1 - (1 + h) y^2 = (1 - y^2) - h y^2 are cheaper than a root and a division, and more accurate. */
CM_FN CM_REAL CM_NAME(cm_inverse_root_excess)(CM_REAL h)
{
    CM_REAL radicand = CM_LIT(1.0) + h;
#ifdef CM_ROUGH_INVERSE_ROOT
    CM_REAL y = CM_ROUGH_INVERSE_ROOT(radicand);
    CM_REAL square = y * y;
    CM_REAL e = cm_mad(-h, square, CM_LIT(1.0) - square);
    return cm_mad(y * e, cm_mad(e, CM_LIT(0.375), CM_LIT(0.5)), y - CM_LIT(1.0));
#else
    return -(h / (radicand + cm_sqrt(radicand)));
#endif
}

/* 1 / sqrt(x), x > 0 */
CM_FN CM_REAL CM_NAME(cm_inverse_root)(CM_REAL x)
{
#ifdef CM_ROUGH_INVERSE_ROOT
    CM_REAL y = CM_ROUGH_INVERSE_ROOT(x);
    CM_REAL e = cm_mad(-x, y * y, CM_LIT(1.0));
    return cm_mad(y * e, cm_mad(e, CM_LIT(0.375), CM_LIT(0.5)), y);
#else
    return CM_LIT(1.0) / cm_sqrt(x);
#endif
}

/* sqrt(x), x > 0, for kernels that divide so much that the divider is what they wait for */
CM_FN CM_REAL CM_NAME(cm_root)(CM_REAL x)
{
#ifdef CM_ROUGH_INVERSE_ROOT
    CM_REAL y = CM_ROUGH_INVERSE_ROOT(x);
    CM_REAL root = x * y;
    CM_REAL e = cm_mad(-root, y, CM_LIT(1.0));
    return cm_mad(root * e, cm_mad(e, CM_LIT(0.375), CM_LIT(0.5)), root);
#else
    return cm_sqrt(x);
#endif
}

/* n / d for a d from 2^-60 to 2^60, as a term of something greater: where the dialect has
 * CM_ROUGH_INVERSE(x), 1 / x to 14 bits, it is that and Newton's method, and the last bit may be another
 * than that of a division. */
CM_FN CM_REAL CM_NAME(cm_quotient)(CM_REAL n, CM_REAL d)
{
#ifdef CM_ROUGH_INVERSE
    CM_REAL y = CM_ROUGH_INVERSE(d);
#if CM_REAL_BITS == 64
    y = cm_mad(y, cm_mad(-d, y, CM_LIT(1.0)), y);
#endif
    CM_REAL q = n * y;
    return cm_mad(q, cm_mad(-d, y, CM_LIT(1.0)), q);
#else
    return n / d;
#endif
}

/* (4 / pi) atan t for |t| <= 1: t (1 + E) / (1 + E1), where 1 + E1 = pi / 4 */
CM_FN CM_REAL CM_NAME(cm_eighth_turns)(CM_REAL t)
{
    CM_REAL excess =
        CM_NAME(cm_atan_excess)(t * t) + CM_LIT(0.21460183660255169038433915418012427895);
    return CM_NAME(cm_stretch_inside)(t, excess * CM_LIT(1.27323954473516268615107010698011489628));
}

/* tan((pi / 4) w) for |w| <= 1 */
CM_FN CM_REAL CM_NAME(cm_slope_of_eighth_turns)(CM_REAL w)
{
    CM_REAL excess =
        CM_NAME(cm_tan_excess)(CM_LIT(0.6168502750680849136771556874922594459571) * (w * w)) -
        CM_LIT(0.2732395447351626861510701069801148962757);
    return CM_NAME(cm_stretch_inside)(w,
                                      excess * CM_LIT(0.7853981633974483096156608458198757210493));
}

/* w / sqrt(1 + h); h > -1 */
CM_FN CM_REAL CM_NAME(cm_divide_by_root)(CM_REAL w, CM_REAL h)
{
    return CM_NAME(cm_stretch)(w, CM_NAME(cm_inverse_root_excess)(h));
}

/* w sqrt(n / m) for n, m > 0 and n - m = d, which vanishes at the edge: with s = sqrt(n m) the root of the ratio is
 * n / s = 1 + n d / (s (n + s)), which divides once. By the divider in all sets: its rounding is that of the excess alone,
 * while that of a root of n m by multiplications would be of the whole. */
CM_FN CM_REAL CM_NAME(cm_times_root_of_ratio)(CM_REAL w, CM_REAL n, CM_REAL m, CM_REAL d)
{
    CM_REAL s = cm_sqrt(n * m);
    return CM_NAME(cm_stretch)(w, (n * d) / (s * (n + s)));
}

#endif
