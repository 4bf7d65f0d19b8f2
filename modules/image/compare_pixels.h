/* SPDX-License-Identifier: MIT
 *
 * Two pictures that are compared: what their pixels are as numbers, and whether they can be compared at all.
 */
#ifndef IMAGE_COMPARE_PIXELS_H
#define IMAGE_COMPARE_PIXELS_H

#include <cubemap/compare.h>

/* Pictures whose strides are known; weights counts if has_weights. */
typedef struct cm_compare_pair
{
    cm_image reference;
    cm_image picture;
    cm_image weights;
    int has_weights;
} cm_compare_pair;

/* The options that hold: *given, or those that stand for NULL. 0 if they are none. */
int cm_compare_options_of(const cm_compare_options *given, cm_compare_options *options);

/* Is that a picture? *image is a copy with strides that are not 0. */
cm_status cm_compare_image(const cm_image *given, cm_image *image);

/* A pair of pictures of one size, and weights that may be NULL, each of them finite and not negative. */
cm_status cm_compare_pair_of(const cm_image *reference, const cm_image *picture,
                             const cm_image *weights, cm_compare_pair *pair);

/* A map of floats of the picture's size. */
cm_status cm_compare_map(const cm_image *given, const cm_image *like, cm_image *map);

/* What a measure with windows is given, checked: its pair, its options, and its map, unless that is NULL. */
typedef struct cm_compare_request
{
    cm_compare_pair pair;
    cm_compare_options options;
    cm_image map;
    const cm_image *map_wanted; /* &map, or NULL */
} cm_compare_request;

cm_status cm_compare_request_of(const cm_image *reference, const cm_image *picture,
                                const cm_compare_options *options, const cm_map_figures *figures,
                                const cm_image *map, cm_compare_request *request);

/* Are these whole numbers, which stand for 0 to 1? */
int cm_compare_is_whole(cm_pixel_type type);

/* One channel of count pixels of a row, from a column on. The strides of image must be known. */
void cm_compare_read(const cm_image *image, uint64_t row, uint32_t column, size_t count,
                     uint32_t channel, double *values);

/* As before, the other way round. Whole numbers are rounded to the nearest, from 0 to 1; NaN is 0 there. */
void cm_compare_write(const cm_image *image, uint64_t row, uint32_t column, size_t count,
                      uint32_t channel, const double *values);

/* Weights of count pixels of a row. */
void cm_compare_read_weights(const cm_compare_pair *pair, uint64_t row, uint32_t column,
                             size_t count, double *weights);

#endif
