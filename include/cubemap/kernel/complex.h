/* SPDX-License-Identifier: MIT
 *
 * complex: numbers of two parts, for the conformal mappings.
 */
#ifndef CM_DESCRIPTORS

CM_STRUCT(cm_complex)
{
    CM_REAL re;
    CM_REAL im;
}
CM_STRUCT_END(cm_complex)

CM_FN CM_NAME(cm_complex) CM_NAME(cm_make_complex)(CM_REAL re, CM_REAL im)
{
    CM_NAME(cm_complex) r;
    r.re = re;
    r.im = im;
    return r;
}

CM_FN CM_NAME(cm_complex) CM_NAME(cm_complex_multiply)(CM_NAME(cm_complex) a, CM_NAME(cm_complex) b)
{
    return CM_NAME(cm_make_complex)(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

CM_FN CM_NAME(cm_complex) CM_NAME(cm_complex_square)(CM_NAME(cm_complex) a)
{
    return CM_NAME(cm_make_complex)((a.re - a.im) * (a.re + a.im), CM_LIT(2.0) * (a.re * a.im));
}

/* The root with a positive real part, of a number that has one that is not negative; not 0. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_complex_root)(CM_NAME(cm_complex) a)
{
    CM_REAL length = cm_sqrt(a.re * a.re + a.im * a.im);
    CM_REAL re = cm_sqrt(CM_LIT(0.5) * (length + a.re));
    return CM_NAME(cm_make_complex)(re, CM_LIT(0.5) * (a.im / re));
}

/* 1 / a */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_complex_inverse)(CM_NAME(cm_complex) a)
{
    CM_REAL scale = CM_LIT(1.0) / (a.re * a.re + a.im * a.im);
    return CM_NAME(cm_make_complex)(a.re * scale, -(a.im * scale));
}

#endif
