/* SPDX-License-Identifier: MIT
 *
 * Pictures of a smooth scene for tests of resampling.
 */
#ifndef TESTS_IMAGE_DRAWN_SCENE_H
#define TESTS_IMAGE_DRAWN_SCENE_H

#include "tests/suite.h"

#include <cubemap/image.h>

/* The pictures of a surface in memory of their own. */
typedef struct pictures
{
    cm_surface *surface;
    size_t bytes; /* of each */
    cm_image image[6];
} pictures;

/* A surface that must be good, with pictures whose bytes are all `filling`. */
pictures make_pictures(const char *specification, const cm_rotation *rotation, cm_pixel_type type,
                       uint32_t channels, int filling);
void free_pictures(pictures *made);

/* A channel of the scene in a direction of unit length: from 0.1 to 0.9, with no wave shorter than 0.15 rad. */
float scene_value(const double direction[3], uint32_t channel);

/* Writes the scene into each pixel that has a direction. */
void draw_scene(pictures *on);

/* A channel of a pixel, whole numbers from 0 to 1. */
double channel_at(const cm_image *image, uint32_t column, uint32_t row, uint32_t channel);

/* The root of the mean square of what differs from the scene, over all pixels that have a direction which source shows. */
double deviation(const pictures *from, const pictures *on);

/* Resamples; the plan must be good. */
void resample(const pictures *from, pictures *to, const cm_plan_options *options, unsigned threads);

#endif
