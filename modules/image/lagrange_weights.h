/* SPDX-License-Identifier: MIT
 *
 * Weights of values between pixels.
 */
#ifndef MODULES_IMAGE_LAGRANGE_WEIGHTS_H
#define MODULES_IMAGE_LAGRANGE_WEIGHTS_H

#define CM_LAGRANGE_MOST 6

/* Lagrange's weights of nodes 0, 1, ..., up to CM_LAGRANGE_MOST; exactly 0 and 1 at nodes. In line, so that loops over many places
 * become vectors. */
static inline void cm_lagrange_weights(double place, int count, double *weight)
{
    static const double inverse[CM_LAGRANGE_MOST] = {1.0,       1.0,        1.0 / 2.0,
                                                     1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0};
    double before[CM_LAGRANGE_MOST] = {1.0}, after = 1.0;
    for (int i = 1; i < count; i++)
    {
        before[i] = before[i - 1] * (place - (i - 1));
    }
    for (int i = count - 1; i >= 0; i--)
    {
        weight[i] = before[i] * after * inverse[i] * inverse[count - 1 - i];
        after *= i - place;
    }
}

#endif
