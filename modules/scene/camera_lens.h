/* SPDX-License-Identifier: MIT
 *
 * The lens of a perspective camera: where the ray (a, b, 1) meets the picture's plane, in focal lengths, and how fast it
 * moves there. The model is OpenCV's (its documentation of calib3d, "Detailed Description"), with the products of a and b
 * collected:
 *
 *   R = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)          r2 = a^2 + b^2
 *   x = a (R + 2 g) + r2 (p2 + s1 + s2 r2)                                         g = p1 b + p2 a
 *   y = b (R + 2 g) + r2 (p1 + s3 + s4 r2)
 *
 * then the homography of a tilted sensor. Included by the loops of every instruction set, too.
 */
#ifndef MODULES_SCENE_CAMERA_LENS_H
#define MODULES_SCENE_CAMERA_LENS_H

#include <math.h>

/* fused where the set can: the build lets no compiler do so by itself */
#if defined(__FMA__) || defined(__aarch64__)
#define LENS_MAD(a, b, c) fma(a, b, c)
#else
#define LENS_MAD(a, b, c) ((a) * (b) + (c))
#endif

typedef struct cm_lens
{
    double k[6]; /* k1 to k6 */
    double p1_twice, p2_twice;
    double even[2], steep[2]; /* p2 + s1, p1 + s3; s2, s4 */
    double tilt[9];           /* the homography of the sensor by rows, and its inverse's multiple */
    double level[9];
    double tilt_size;      /* the determinant of tilt */
    double first, second;  /* R = 1 + first r2 + second r2^2 + ... */
    double fx, fy, cx, cy; /* pixels; pixel_centre plays no part here */
    double per_x, per_y;   /* 1 / fx, 1 / fy */
    double slack;          /* of an inverse's residual, in focal lengths */
    int is_plain;          /* no distortion at all */
    int is_tilted;
} cm_lens;

/* What the lens makes of a ray, before the tilt. */
typedef struct cm_lens_point
{
    double x, y;
    double x_by_a, x_by_b, y_by_a, y_by_b;
    double determinant; /* of these four */
    double divisor;     /* of R: beyond its zero is another branch */
} cm_lens_point;

static inline cm_lens_point cm_lens_at(const cm_lens *lens, double a, double b)
{
    const double *k = lens->k;
    const double r2 = LENS_MAD(a, a, b * b);
    const double above = LENS_MAD(LENS_MAD(LENS_MAD(k[2], r2, k[1]), r2, k[0]), r2, 1.0);
    const double below = LENS_MAD(LENS_MAD(LENS_MAD(k[5], r2, k[4]), r2, k[3]), r2, 1.0);
    const double above_slope = LENS_MAD(LENS_MAD(3.0 * k[2], r2, 2.0 * k[1]), r2, k[0]);
    const double below_slope = LENS_MAD(LENS_MAD(3.0 * k[5], r2, 2.0 * k[4]), r2, k[3]);
    const double inverse = 1.0 / below;
    const double radial = above * inverse;
    const double slope = 2.0 * inverse * (above_slope - radial * below_slope);
    const double scale = LENS_MAD(lens->p1_twice, b, LENS_MAD(lens->p2_twice, a, radial));
    const double bend_a = LENS_MAD(a, slope, lens->p2_twice); /* of scale, by a and by b */
    const double bend_b = LENS_MAD(b, slope, lens->p1_twice);
    const double even_x = LENS_MAD(lens->steep[0], r2, lens->even[0]);
    const double even_y = LENS_MAD(lens->steep[1], r2, lens->even[1]);
    const double rise_x = 2.0 * LENS_MAD(lens->steep[0], r2, even_x); /* of r2 even_x, by r2 */
    const double rise_y = 2.0 * LENS_MAD(lens->steep[1], r2, even_y);
    cm_lens_point at;
    at.x = LENS_MAD(a, scale, r2 * even_x);
    at.y = LENS_MAD(b, scale, r2 * even_y);
    at.x_by_a = LENS_MAD(a, bend_a, LENS_MAD(a, rise_x, scale));
    at.x_by_b = LENS_MAD(a, bend_b, b * rise_x);
    at.y_by_a = LENS_MAD(b, bend_a, a * rise_y);
    at.y_by_b = LENS_MAD(b, bend_b, LENS_MAD(b, rise_y, scale));
    /* x_by_a y_by_b - x_by_b y_by_a without what cancels, which is nearly all of it far from the axis */
    const double swell = LENS_MAD(a, bend_a + rise_x, LENS_MAD(b, bend_b + rise_y, scale));
    const double twist = LENS_MAD(lens->p2_twice, b, -(lens->p1_twice * a));
    at.determinant = LENS_MAD(scale, swell, twist * LENS_MAD(a, rise_y, -(b * rise_x)));
    at.divisor = below;
    return at;
}

/* The third coordinate of a point on the tilted sensor: 1 / that is its scale, and from 0 on nothing gets there. */
static inline double cm_lens_reach(const cm_lens *lens, double x, double y)
{
    return LENS_MAD(lens->tilt[6], x, LENS_MAD(lens->tilt[7], y, lens->tilt[8]));
}

/* Through a homography whose third coordinate is known. */
static inline double cm_lens_turn(const double row[3], double x, double y, double inverse)
{
    return LENS_MAD(row[0], x, LENS_MAD(row[1], y, row[2])) * inverse;
}

/* Positive where the map keeps its side: the least of what must not reach 0. NaN counts as no. */
static inline double cm_lens_sign_there(const cm_lens *lens, const cm_lens_point *at)
{
    const double reach = cm_lens_reach(lens, at->x, at->y);
    const double least = at->determinant < at->divisor ? at->determinant : at->divisor;
    const double sign = reach < least ? reach : least;
    return at->determinant > 0.0 && at->divisor > 0.0 && reach > 0.0 ? sign
           : sign < 0.0                                              ? sign
                                                                     : -1.0;
}

#endif
