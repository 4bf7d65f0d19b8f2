/* SPDX-License-Identifier: MIT
 *
 * Pictures of a smooth scene on the sphere, for tests of filters.
 */
#ifndef TESTS_IMAGE_ROUND_SCENE_H
#define TESTS_IMAGE_ROUND_SCENE_H

#include <cubemap/image.h>

#include "tests/suite.h"

#define PICTURES_MOST 6

/* Waves of up to `waves` radians a radian, between 0 and 1. */
static inline double scene_at(const double d[3], double waves, uint32_t channel)
{
    static const double k[5][3] = {
        {0.9, 0.1, 0.2}, {-0.1, 0.9, 0.3}, {0.2, -0.2, 0.9}, {0.6, 0.4, -0.3}, {-0.4, 0.5, 0.6}};
    double sum = 0.0;
    for (int i = 0; i < 5; i++)
    {
        sum += cos(waves * (k[i][0] * d[0] + k[i][1] * d[1] + k[i][2] * d[2]) + i + channel);
    }
    return 0.5 + sum / 11.0;
}

static inline cm_surface *make_surface(const char *specification)
{
    cm_surface *surface = NULL;
    char message[200] = "";
    if (cm_surface_create(specification, NULL, &surface) != CM_OK)
    {
        cm_surface_check(specification, NULL, message, sizeof message);
    }
    ck_assert_msg(surface != NULL, "%s: %s", specification, message);
    return surface;
}

/* Pictures of a surface, all zeros. */
static inline void make_pictures(const cm_surface *surface, cm_pixel_type type, uint32_t channels,
                                 cm_image *pictures)
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        pictures[i] = (cm_image){.size = sizeof(cm_image),
                                 .type = type,
                                 .width = cm_surface_width(surface),
                                 .height = cm_surface_height(surface),
                                 .channels = channels};
        pictures[i].data =
            calloc((size_t)pictures[i].width * pictures[i].height, channels * cm_pixel_size(type));
        ck_assert_ptr_nonnull(pictures[i].data);
    }
}

static inline void free_pictures(const cm_surface *surface, cm_image *pictures)
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        free(pictures[i].data);
    }
}

static inline size_t picture_bytes(const cm_image *picture)
{
    return (size_t)picture->width * picture->height * picture->channels *
           cm_pixel_size(picture->type);
}

/* A number of a plane whose picture it is alone. */
static inline double number_at(const cm_image *pictures, size_t plane, size_t column, size_t row,
                               uint32_t channel)
{
    const cm_image *picture = &pictures[plane];
    const size_t i = (row * picture->width + column) * picture->channels + channel;
    return picture->type == CM_PIXEL_U8 ? ((const uint8_t *)picture->data)[i] / 255.0
                                        : (double)((const float *)picture->data)[i];
}

static inline void put_number(const cm_image *pictures, size_t plane, size_t column, size_t row,
                              uint32_t channel, double value)
{
    const cm_image *picture = &pictures[plane];
    const size_t i = (row * picture->width + column) * picture->channels + channel;
    if (picture->type == CM_PIXEL_U8)
    {
        ((uint8_t *)picture->data)[i] = (uint8_t)lrint(value * 255.0);
    }
    else
    {
        ((float *)picture->data)[i] = (float)value;
    }
}

/* The scene on a surface each of whose planes is a picture. What is no direction stays 0. */
static inline void paint(const cm_surface *surface, double waves, const cm_image *pictures)
{
    for (size_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (size_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            for (size_t column = 0; column < cm_surface_plane_width(surface); column++)
            {
                const uint8_t index = (uint8_t)plane;
                const double x = (double)column + 0.5, y = (double)row + 0.5;
                double d[3];
                cm_surface_directions(surface, 1, &index, &x, &y, &d[0], &d[1], &d[2]);
                for (uint32_t c = 0; c < pictures->channels && !isnan(d[0]); c++)
                {
                    put_number(pictures, plane, column, row, c, scene_at(d, waves, c));
                }
            }
        }
    }
}

/* Numbers from 0 to 1 without a pattern. */
static inline void paint_noise(const cm_surface *surface, const cm_image *pictures)
{
    uint32_t state = 1;
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        for (size_t row = 0; row < pictures->height; row++)
        {
            for (size_t column = 0; column < pictures->width; column++)
            {
                for (uint32_t c = 0; c < pictures->channels; c++)
                {
                    state = state * 1664525u + 1013904223u;
                    put_number(pictures, i, column, row, c, (state >> 8) * 0x1p-24);
                }
            }
        }
    }
}

static inline cm_plan *make_plan(const cm_surface *from, const cm_surface *to, cm_filter filter)
{
    cm_plan *plan = NULL;
    const cm_plan_options options = {.size = sizeof options, .filter = filter, .tolerance = -1.0};
    ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
    return plan;
}

/* Are all parts of a target the same for any number of threads, and alone as in the whole? */
static inline void check_same_bits(const char *from_name, const char *to_name, cm_filter filter)
{
    cm_surface *from = make_surface(from_name), *to = make_surface(to_name);
    cm_image source[PICTURES_MOST], one[PICTURES_MOST], other[PICTURES_MOST];
    cm_source *made = NULL;
    make_pictures(from, CM_PIXEL_FLOAT, 3, source);
    make_pictures(to, CM_PIXEL_FLOAT, 3, one);
    make_pictures(to, CM_PIXEL_FLOAT, 3, other);
    paint_noise(from, source);
    cm_plan *plan = make_plan(from, to, filter);
    ck_assert_int_eq(cm_resample(plan, source, one, (cm_rows){0}), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, source, CM_PIXEL_FLOAT, 3, &made), CM_OK);
    const uint32_t width = cm_surface_plane_width(to), height = cm_surface_plane_height(to);
    for (uint32_t plane = 0; plane < cm_surface_plane_count(to); plane++)
    {
        for (uint32_t half = 0; half < 2; half++)
        {
            const uint32_t first = half * (width / 3);
            const cm_rows rows = {plane, 0, height, first, half ? width - first : width / 3};
            ck_assert_int_eq(cm_resample_source(plan, made, other, rows, 2), CM_OK);
        }
    }
    for (size_t i = 0; i < cm_surface_picture_count(to); i++)
    {
        ck_assert_msg(memcmp(one[i].data, other[i].data, picture_bytes(&one[i])) == 0, "%s -> %s",
                      from_name, to_name);
    }
    cm_source_destroy(made);
    cm_plan_destroy(plan);
    free_pictures(from, source);
    free_pictures(to, one);
    free_pictures(to, other);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}

#endif
