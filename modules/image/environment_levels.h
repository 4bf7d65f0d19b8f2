/* SPDX-License-Identifier: MIT
 *
 * The pyramid behind an environment.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_LEVELS_H
#define MODULES_IMAGE_ENVIRONMENT_LEVELS_H

#include <cubemap/environment.h>

/* Levels of 16384 down to 1, and one to spare. */
#define CM_LEVELS_MAX 16

/* Channels of a texel in memory, whatever the environment has: the others are 0. */
#define CM_TEXEL 4

/* One level: rows go up with v, and around each face is a border of one texel, which belongs to its neighbours. */
typedef struct cm_level
{
    uint32_t size;
    float *texels; /* 6 faces of (size + 2)^2 texels */
    double *angle; /* solid angles, cm_angle_faces faces of size^2 */
} cm_level;

struct cm_environment
{
    const cm_mapping *mapping;
    uint32_t channels;
    uint32_t level_count;
    cm_level level[CM_LEVELS_MAX];
    float *edge; /* cm_angle_edges_make of level 0 */
};

/* The solid angles of a face's texels on a level. */
static inline const double *cm_level_angles(const cm_environment *environment,
                                            const cm_level *level, size_t face)
{
    const int is_one = cm_mapping_describe(environment->mapping)->family != CM_FAMILY_HYBRID;
    return level->angle + (is_one ? 0 : face) * level->size * level->size;
}

/* A texel; row and column count from 0 inside the face, -1 and size are the border. */
static inline float *cm_level_texel(const cm_level *level, size_t face, ptrdiff_t row,
                                    ptrdiff_t column)
{
    const ptrdiff_t width = (ptrdiff_t)level->size + 2;
    return level->texels + (((ptrdiff_t)face * width + row + 1) * width + column + 1) * CM_TEXEL;
}

/* The border of a level, from its own texels. */
void cm_level_fill_border(const cm_mapping *mapping, const cm_level *level);

#endif
