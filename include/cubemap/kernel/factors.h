/* SPDX-License-Identifier: MIT
 *
 * Multiplication by a factor near 1, as the factor's difference from 1: rounded less than a product
 * with the factor itself, and exact where the difference vanishes, which is the edge of a face. The
 * sign of zero is kept, which w + w d loses for w = -0, d < 0.
 */
#ifndef CM_DESCRIPTORS

/* w (1 + d), d > -1 */
CM_FN CM_REAL CM_NAME(cm_stretch)(CM_REAL w, CM_REAL d)
{
    return cm_copysign(w + w * d, w);
}

/* The same for a d that vanishes at |w| = 1 but for rounding errors, which differ between compilers:
 * exact there nevertheless. */
CM_FN CM_REAL CM_NAME(cm_stretch_inside)(CM_REAL w, CM_REAL d)
{
    return cm_copysign(CM_SELECT(cm_equal(cm_abs(w), CM_LIT(1.0)), CM_LIT(1.0), cm_abs(w + w * d)), w);
}

/* w sqrt((a + d) / a); a > 0, a + d > 0 */
CM_FN CM_REAL CM_NAME(cm_scale_by_root)(CM_REAL w, CM_REAL a, CM_REAL d)
{
    return CM_NAME(cm_stretch)(w, d / (a + cm_sqrt(a * (a + d))));
}

/* w / sqrt(1 + h); h > -1 */
CM_FN CM_REAL CM_NAME(cm_divide_by_root)(CM_REAL w, CM_REAL h)
{
    CM_REAL radicand = CM_LIT(1.0) + h;
    return CM_NAME(cm_stretch)(w, -(h / (radicand + cm_sqrt(radicand))));
}

#endif
