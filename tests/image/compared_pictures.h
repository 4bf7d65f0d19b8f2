/* SPDX-License-Identifier: MIT
 *
 * Pictures that are compared, and the measures with windows: what tests of comparisons share.
 */
#ifndef TESTS_IMAGE_COMPARED_PICTURES_H
#define TESTS_IMAGE_COMPARED_PICTURES_H

#include <cubemap/compare.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

#define NOT_A_NUMBER ((float)NAN)
#define INFINITE ((float)INFINITY)

static inline cm_image image_of(void *data, cm_pixel_type type, size_t width, size_t height,
                                uint32_t channels)
{
    return (cm_image){.size = sizeof(cm_image),
                      .data = data,
                      .type = type,
                      .width = (uint32_t)width,
                      .height = (uint32_t)height,
                      .channels = channels};
}

static inline cm_image floats(float *data, size_t width, size_t height, uint32_t channels)
{
    return image_of(data, CM_PIXEL_FLOAT, width, height, channels);
}

static inline cm_compare_options standard(void)
{
    return (cm_compare_options){.size = sizeof(cm_compare_options)};
}

static inline cm_error_figures no_figures(void)
{
    return (cm_error_figures){.size = sizeof(cm_error_figures)};
}

static inline cm_map_figures no_map(void)
{
    return (cm_map_figures){.size = sizeof(cm_map_figures)};
}

/* The next of numbers from 0 to 1 that look random. */
static inline float next_number(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777215.0f;
}

/* Waves with some noise, from 0 to 1, and the same with other noise and a moved edge. */
static inline void make_pictures(size_t width, size_t height, size_t channels, float *one,
                                 float *other)
{
    uint32_t state = 7;
    for (size_t i = 0; i < width * height; i++)
    {
        const double x = (double)(i % width);
        const double y = (double)(i / width);
        for (size_t c = 0; c < channels; c++)
        {
            const double wave = 0.5 + 0.3 * sin(0.31 * x + 0.2 * (double)c) * cos(0.17 * y);
            const double step = x > 0.6 * (double)width ? 0.15 : 0.0;
            const double moved = x > 0.6 * (double)width + 2 ? 0.15 : 0.0;
            one[i * channels + c] =
                (float)(wave + step + 0.05 * ((double)next_number(&state) - 0.5));
            other[i * channels + c] =
                (float)(wave + moved + 0.05 * ((double)next_number(&state) - 0.5));
        }
    }
}

static inline float *room(size_t count)
{
    float *const made = malloc(count * sizeof *made);
    ck_assert_ptr_nonnull(made);
    return made;
}

static inline void expect_near(double value, double expected, double tolerance, const char *what)
{
    REQUIRE(fabs(value - expected) <= tolerance, "%s: %.17g, not %.17g", what, value, expected);
}

/* ---- measures with windows ---- */

typedef cm_status (*windowed)(const cm_image *, const cm_image *, const cm_compare_options *,
                              cm_map_figures *, const cm_image *);

static inline cm_status ssim(const cm_image *reference, const cm_image *picture,
                             const cm_compare_options *options, cm_map_figures *figures,
                             const cm_image *map)
{
    return cm_ssim(reference, picture, options, figures, map, NULL);
}

static const windowed measures[] = {ssim, cm_flip, cm_flip_hdr};

enum
{
    MEASURES = 3
};

#endif
