/* SPDX-License-Identifier: MIT
 *
 * Values of an environment between texels and between levels: bilinear on two levels, linear between them. The borders
 * make it continuous across edges, and spare every test for them.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_LOOKUP_H
#define MODULES_IMAGE_ENVIRONMENT_LOOKUP_H

#include "environment_angles.h"
#include "environment_levels.h"

/* Adds weight times the value of a level at u, v of a face. */
static inline void cm_level_add(const cm_level *level, uint8_t face, float u, float v, float weight,
                                float sum[CM_TEXEL])
{
    const float half = 0.5F * (float)level->size;
    /* the border begins at 0, so that this is from 0.5 to size + 0.5 */
    const float column = (u + 1.0F) * half + 0.5F;
    const float row = (v + 1.0F) * half + 0.5F;
    const int32_t i = (int32_t)column;
    const int32_t j = (int32_t)row;
    const float right = column - (float)i;
    const float up = row - (float)j;
    const size_t width = (size_t)level->size + 2;
    const float *low = level->texels + ((face * width + (size_t)j) * width + (size_t)i) * CM_TEXEL;
    const float *high = low + width * CM_TEXEL;
    const float a = weight * (1.0F - up) * (1.0F - right);
    const float b = weight * (1.0F - up) * right;
    const float c = weight * up * (1.0F - right);
    const float d = weight * up * right;
    for (size_t k = 0; k < CM_TEXEL; k++)
    {
        sum[k] += (a * low[k] + b * low[CM_TEXEL + k]) + (c * high[k] + d * high[CM_TEXEL + k]);
    }
}

/* The same at a level between 0 and the last, which may be a fraction. */
static inline void cm_environment_add(const cm_environment *environment, uint8_t face, float u,
                                      float v, float at, float weight, float sum[CM_TEXEL])
{
    const float last = (float)(environment->level_count - 1);
    const float in = at > 0.0F ? (at < last ? at : last) : 0.0F;
    const uint32_t whole = (uint32_t)in;
    const float more = in - (float)whole;
    cm_level_add(&environment->level[whole], face, u, v, weight * (1.0F - more), sum);
    if (more > 0.0F)
    {
        cm_level_add(&environment->level[whole + 1], face, u, v, weight * more, sum);
    }
}

/* An entry of a table of cm_angle_edges_make. */
static inline float cm_edge_at(const float *edge, int is_one_face, uint8_t face, float u, float v)
{
    const int32_t last = CM_DENSITY_SIZE - 1;
    const int32_t i = (int32_t)((u + 1.0F) * (0.5F * CM_DENSITY_SIZE));
    const int32_t j = (int32_t)((v + 1.0F) * (0.5F * CM_DENSITY_SIZE));
    const int32_t at = (j < last ? j : last) * CM_DENSITY_SIZE + (i < last ? i : last);
    return edge[(is_one_face ? 0 : (int32_t)face * CM_DENSITY_SIZE * CM_DENSITY_SIZE) + at];
}

#endif
