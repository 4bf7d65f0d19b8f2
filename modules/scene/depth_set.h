/* SPDX-License-Identifier: MIT
 *
 * The loops over rows of depth images, once for each instruction set.
 */
#ifndef MODULES_SCENE_DEPTH_SET_H
#define MODULES_SCENE_DEPTH_SET_H

#include <stddef.h>

/* The bilateral filter reads so many pixels beyond the one in the middle. */
#define CM_SMOOTH_REACH 3
#define CM_SMOOTH_WIDTH (2 * CM_SMOOTH_REACH + 1)

/* Rows that are read in vectors have so many floats behind their end. */
#define CM_DEPTH_SLACK 16

/* A row of rays. What is NULL is 1. */
typedef struct cm_ray_row
{
    const float *x;
    const float *y; /* NULL: y_all for all of the row */
    const float *z;
    float y_all;
} cm_ray_row;

/* A row of an image and of its vertices, and the rows above and below it: NULL where there is none. */
typedef struct cm_normal_rows
{
    const float *image[3];     /* above, at, below */
    const float *vertex[3][3]; /* above, at, below; x, y, z */
    float gap;
} cm_normal_rows;

/* Weights are 2 to the power of place[row][column] - scale d^2. */
typedef struct cm_smooth_weights
{
    float place[CM_SMOOTH_WIDTH][CM_SMOOTH_WIDTH];
    float scale;
} cm_smooth_weights;

typedef struct cm_depth_set
{
    const char *name; /* as in options.h */
    /* Times the length of rays whose z is 1, or divided by it. */
    void (*to_range)(size_t n, const cm_ray_row *ray, const float *from, float *to);
    void (*from_range)(size_t n, const cm_ray_row *ray, const float *from, float *to);
    /* Values times rays. */
    void (*vertices)(size_t n, const cm_ray_row *ray, const float *image, float *const vertex[3]);
    void (*normals)(size_t n, const cm_normal_rows *rows, float *const normal[3]);
    /* Of perspective cameras by z and n_z; of others by the range and the ray. */
    void (*radii)(size_t n, const float *z, const float *normal_z, float side, float *radius);
    void (*radii_all_round)(size_t n, const float *range, const float *side,
                            const float *const vertex[3], const float *const normal[3],
                            float *radius);
    /* A row of n pixels from rows, FLT_MAX where nothing is measured, that begin CM_SMOOTH_REACH before it and have
     * CM_DEPTH_SLACK behind. */
    void (*smooth)(size_t n, const float *const rows[CM_SMOOTH_WIDTH],
                   const cm_smooth_weights *weights, float *to);
    /* n pixels from two rows of 2 n. */
    void (*halve)(size_t n, const float *above, const float *below, float gap, float *to);
    /* n cells from two rows of 2 n pixels, or of 2 n cells. */
    void (*bound_pixels)(size_t n, const float *above, const float *below, float *least,
                         float *most);
    void (*bound_cells)(size_t n, const float *const least_of[2], const float *const most_of[2],
                        float *least, float *most);
} cm_depth_set;

extern const cm_depth_set cm_depth_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_depth_set cm_depth_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_depth_set cm_depth_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_depth_set cm_depth_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_depth_set cm_depth_neon;
#endif

/* The set of that name, or what the environment or the machine says if it is NULL; NULL if this machine lacks it. */
const cm_depth_set *cm_depth_set_find(const char *name);

#endif
