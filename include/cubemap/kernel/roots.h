/* SPDX-License-Identifier: MIT
 *
 * Multiplication and division by a square root near 1, as the factor's difference from 1: exact where
 * that vanishes, which is the edge of a face, and rounded less everywhere. One square root and one
 * division, as if written plainly.
 */
#ifndef CM_DESCRIPTORS

/* w sqrt((a + d) / a) = w + w d / (a + sqrt(a (a + d))); a > 0, a + d > 0 */
CM_FN CM_REAL CM_NAME(cm_scale_by_root)(CM_REAL w, CM_REAL a, CM_REAL d)
{
    return w + w * (d / (a + cm_sqrt(a * (a + d))));
}

/* w / sqrt(1 + h) = w - w h / (1 + h + sqrt(1 + h)); h > -1 */
CM_FN CM_REAL CM_NAME(cm_divide_by_root)(CM_REAL w, CM_REAL h)
{
    CM_REAL radicand = CM_LIT(1.0) + h;
    return w - w * (h / (radicand + cm_sqrt(radicand)));
}

#endif
