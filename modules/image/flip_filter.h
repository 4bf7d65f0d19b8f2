/* SPDX-License-Identifier: MIT
 *
 * The filters of FLIP, each a sum of products of filters along the axes: what the eye cannot see apart, and what it
 * sees as edges and points.
 */
#ifndef IMAGE_FLIP_FILTER_H
#define IMAGE_FLIP_FILTER_H

#include <stddef.h>

/* The radius at 1000 pixels per degree, the most. */
enum
{
    CM_FLIP_RADIUS_MAX = 136
};

/* Half of a filter: k[0] in the middle, k[j] at j pixels to one side. */
typedef double cm_flip_half[CM_FLIP_RADIUS_MAX + 1];

typedef struct cm_flip_filters
{
    size_t radius;         /* of the ones for colours */
    size_t feature_radius; /* not above radius */
    cm_flip_half luminance;
    cm_flip_half red_green;
    cm_flip_half blue_yellow[2]; /* the filter is the sum of both, each with itself */
    cm_flip_half blur;           /* a Gaussian, the sum of all is 1 */
    cm_flip_half edge;           /* its derivative: odd, the sum of one half is 1 */
    cm_flip_half
        point; /* its second derivative: those above 0 and those below have the sums 1 and -1 */
} cm_flip_filters;

/* pixels_per_degree is from 0.01 to 1000. */
void cm_flip_make_filters(double pixels_per_degree, cm_flip_filters *filters);

#endif
