/* SPDX-License-Identifier: MIT
 *
 * What the suites of depth images share: a camera, and an image with all that can be in one.
 */
#ifndef TESTS_SCENE_ROUGH_IMAGE_H
#define TESTS_SCENE_ROUGH_IMAGE_H

#include <cubemap/depth.h>

#include <float.h>

#include "tests/suite.h"

enum
{
    WIDTH = 645, /* no multiple of a vector's width, nor of 2 */
    HEIGHT = 483,
    PIXELS = WIDTH * HEIGHT
};

static const cm_camera_options plain = {.size = sizeof plain,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .fx = 525.0,
                                        .fy = 520.0,
                                        .cx = 319.5,
                                        .cy = 239.5};

static inline cm_camera *camera_of(const cm_camera_options *options)
{
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(options, &camera), CM_OK);
    return camera;
}

static inline cm_rays *rays_of(const cm_camera_options *options, const char *instructions)
{
    cm_camera *camera = camera_of(options);
    cm_rays *rays = NULL;
    ck_assert_int_eq(cm_rays_create(camera, instructions, &rays), CM_OK);
    cm_camera_destroy(camera);
    return rays;
}

static inline float *floats(size_t count)
{
    float *made = calloc(count, sizeof *made);
    ck_assert_ptr_nonnull(made);
    return made;
}

/* The same numbers everywhere. */
static inline uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Two surfaces with noise and holes, and one value that is far beyond all others. */
static inline float *rough_image(size_t pixels, size_t width)
{
    uint32_t state = 7;
    float *image = floats(pixels);
    for (size_t i = 0; i < pixels; i++)
    {
        const float step = i % width > width / 2 ? 0.7f : 0.0f;
        image[i] = 2.0f + step + (float)(next_random(&state) % 1000) * 2e-5f;
        image[i] = next_random(&state) % 50 == 0 ? NAN : image[i];
        image[i] = next_random(&state) % 500 == 0 ? -1.0f : image[i];
        image[i] = next_random(&state) % 500 == 0 ? INFINITY : image[i];
        image[i] = next_random(&state) % 500 == 0 ? 0.0f : image[i];
    }
    image[pixels / 3] = 1.7e7f;
    return image;
}

static inline int is_measured(float value)
{
    return value > 0.0f && value <= FLT_MAX;
}

#endif
