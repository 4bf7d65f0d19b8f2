/* SPDX-License-Identifier: MIT
 *
 * Polynomials of a length r by Bernstein's coefficients, which bound them (Lane and Riesenfeld, Bounds on a polynomial, 1981).
 * Lengths are counted by t = r / (1 + r), which is below 1: coefficients up to infinity are those of powers divided by
 * binomials.
 */
#ifndef MODULES_SCENE_BERNSTEIN_H
#define MODULES_SCENE_BERNSTEIN_H

#include <stddef.h>
#include <string.h>

#define CM_BERNSTEIN_DEGREE 22
#define CM_BERNSTEIN_COEFFICIENTS (CM_BERNSTEIN_DEGREE + 1)

/* Parts of lengths t, and what is left of 1. */
typedef struct cm_span
{
    double t[2], rest[2];
} cm_span;

/* Powers to Bernstein's coefficients up to infinity. */
static inline void cm_bernstein_from_powers(double *of, int degree)
{
    double choices = 1.0;
    for (int k = 0; k <= degree; k++)
    {
        of[k] /= choices;
        choices = choices * (degree - k) / (k + 1);
    }
}

/* De Casteljau: what is from 0 to t of the whole stays. */
static inline void cm_bernstein_keep_left(double *of, int degree, double t, double rest)
{
    double left[CM_BERNSTEIN_COEFFICIENTS];
    for (int j = 0; j < degree; j++)
    {
        left[j] = of[0];
        for (int i = 0; i < degree - j; i++)
        {
            of[i] = rest * of[i] + t * of[i + 1];
        }
    }
    left[degree] = of[0];
    memcpy(of, left, ((size_t)degree + 1) * sizeof *of);
}

/* The same with t = 1/2: the half before goes to left, the other stays. What is halved is halved at the end, which no rounding
 * sees. */
static inline void cm_bernstein_halve(double *of, int degree, double *left)
{
    double share = 1.0;
    for (int j = 0; j < degree; j++)
    {
        left[j] = share * of[0];
        for (int i = 0; i < degree - j; i++)
        {
            of[i] += of[i + 1];
        }
        of[degree - j] *= share;
        share *= 0.5;
    }
    left[degree] = of[0] *= share;
}

/* A span's halves. */
static inline void cm_halve_span(const cm_span *whole, cm_span *left, cm_span *right)
{
    const double t = 0.5 * (whole->t[0] + whole->t[1]);
    const double rest = 0.5 * (whole->rest[0] + whole->rest[1]);
    const cm_span one = {{whole->t[0], t}, {whole->rest[0], rest}};
    const cm_span next = {{t, whole->t[1]}, {rest, whole->rest[1]}};
    *left = one;
    *right = next;
}

/* How often coefficients change their sign: so many zeros there are at most, and one if it is one. */
static inline int cm_bernstein_changes(const double *of, int degree)
{
    int changes = of[0] > 0.0 ? 0 : 1;
    int is_below = of[0] <= 0.0;
    for (int k = 1; k <= degree; k++)
    {
        const int turns = is_below ? of[k] > 0.0 : of[k] < 0.0;
        changes += turns;
        is_below ^= turns;
    }
    return changes;
}

#endif
