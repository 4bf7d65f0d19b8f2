/* SPDX-License-Identifier: MIT
 *
 * Six faces of floats with light of a formula: what tests of environments share.
 */
#ifndef TESTS_IMAGE_PAINTED_FACES_H
#define TESTS_IMAGE_PAINTED_FACES_H

#include <cubemap/environment.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

/* Six faces of floats. */
typedef struct faces
{
    cm_image image[6];
    float *value;
} faces;

static inline faces make_faces(uint32_t size, uint32_t channels)
{
    faces f;
    const size_t count = (size_t)size * size * channels;
    f.value = calloc(6 * count, sizeof *f.value);
    ck_assert_ptr_nonnull(f.value);
    for (size_t i = 0; i < 6; i++)
    {
        f.image[i] = (cm_image){
            sizeof(cm_image), f.value + i * count, CM_PIXEL_FLOAT, size, size, channels, 0, 0};
    }
    return f;
}

/* The direction of a pixel's centre, rows as pictures have them. */
static inline void direction_of(const cm_mapping *mapping, uint32_t size, size_t face, size_t row,
                                size_t column, double direction[3])
{
    const double down = cm_mapping_frame(mapping)->first_row_v;
    const double uv[2] = {(2.0 * (double)column + 1.0) / size - 1.0,
                          down * (1.0 - (2.0 * (double)row + 1.0) / size)};
    cm_inverse(mapping, (uint8_t)face, uv, direction);
}

typedef double (*light)(const double direction[3], uint32_t channel);

static inline faces paint(const cm_mapping *mapping, uint32_t size, uint32_t channels, light value)
{
    faces f = make_faces(size, channels);
    for (size_t i = 0; i < (size_t)6 * size * size; i++)
    {
        double direction[3];
        direction_of(mapping, size, i / size / size, i / size % size, i % size, direction);
        for (uint32_t c = 0; c < channels; c++)
        {
            f.value[i * channels + c] = (float)value(direction, c);
        }
    }
    return f;
}

static inline cm_environment *make_environment(const cm_mapping *mapping, const faces *f)
{
    cm_environment *environment = NULL;
    ck_assert_int_eq(cm_environment_create(mapping, f->image, 2, &environment), CM_OK);
    return environment;
}

static inline double constant(const double direction[3], uint32_t channel)
{
    (void)direction;
    return channel + 0.7;
}

/* Smooth, of degree 3, and above 0. */
static inline double smooth(const double d[3], uint32_t channel)
{
    return 2.0 + d[0] * (0.5 + channel) + 0.3 * d[1] * d[2] - 0.4 * d[0] * d[1] * d[2];
}

/* A sky with a small sun. */
static inline double sky(const double d[3], uint32_t channel)
{
    const double sun = 0.6 * d[0] + 0.48 * d[1] + 0.64 * d[2];
    return 1.0 + 0.5 * d[2] + 0.2 * sin(9.0 * d[0] + channel) + 60.0 * exp(300.0 * (sun - 1.0));
}

/* Every mapping, each in one of the frames. */
static inline void for_each_mapping(void (*check)(const cm_mapping *))
{
    for (size_t i = 0; i < cube_count(); i++)
    {
        cm_mapping *mapping =
            make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(i % cm_frame_count()));
        check(mapping);
        cm_mapping_destroy(mapping);
    }
}

/* From the mirror to the widest lobe; 1e-20 is a mirror but for rounding. */
static const double all_roughness[] = {0.0, 1e-20, 0.01, 0.1, 0.3, 0.6, 1.0};

#endif
