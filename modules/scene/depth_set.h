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

/* Rows that are read in vectors have so many floats before their beginning and behind their end. */
#define CM_DEPTH_SLACK 16

/* A row of rays. What is NULL is 1. */
typedef struct cm_ray_row
{
    const float *x;
    const float *y; /* NULL: y_all for all of the row */
    const float *z;
    float y_all;
} cm_ray_row;

/* A row of depths, or of ranges for rays of length 1, and those above and below it: NaN where nothing is measured, and before
 * and behind, by CM_DEPTH_SLACK. Rays have that slack, too. */
typedef struct cm_map_rows
{
    const float *depth[3]; /* above, at, below */
    cm_ray_row ray[3];
    float gap;
    /* Where ray->y is NULL: from one ray to the next, and -1 where one of these is negative, else 1. */
    float step_x, step_y;
    float side;
} cm_map_rows;

/* Weights are 2 to the power of place[row][column] - scale d^2. */
typedef struct cm_smooth_weights
{
    float place[CM_SMOOTH_WIDTH][CM_SMOOTH_WIDTH];
    float scale;
} cm_smooth_weights;

/* Rows around one that is smoothed, FLT_MAX where nothing is measured, and before and behind by CM_DEPTH_SLACK. Weights of
 * pairs, CM_SMOOTH_WIDTH rows of them that are `stride` apart, with 0 before: own[down][k] are of pixels of the row and those
 * down rows below and k - CM_SMOOTH_REACH to the right. Before they are, they are those of the row `down` above. */
typedef struct cm_smooth_rows
{
    const float *value[CM_SMOOTH_WIDTH];
    float *own[CM_SMOOTH_REACH + 1];
    size_t stride;
    float *sum; /* of weighted differences from the row's pixels, and of weights */
    float *weight;
} cm_smooth_rows;

typedef struct cm_depth_set
{
    const char *name; /* first: as in options.h */
    /* Times the length of rays whose z is 1, or divided by it. */
    void (*to_range)(size_t n, const cm_ray_row *ray, const float *from, float *to);
    void (*from_range)(size_t n, const cm_ray_row *ray, const float *from, float *to);
    /* What is measured, and NaN; or FLT_MAX. */
    void (*clean)(size_t n, const float *from, float *to);
    void (*fill)(size_t n, const float *from, float *to);
    /* Clean values times rays; and normals, too. */
    void (*vertices)(size_t n, const cm_ray_row *ray, const float *depth, float *const vertex[3]);
    void (*maps)(size_t n, const cm_map_rows *rows, float *const vertex[3], float *const normal[3]);
    /* Of perspective cameras by z and n_z; of others by the range and the ray. */
    void (*radii)(size_t n, const float *z, const float *normal_z, float side, float *radius);
    void (*radii_all_round)(size_t n, const float *range, const float *side,
                            const float *const vertex[3], const float *const normal[3],
                            float *radius);
    /* The weights of a row with the one that is `down` below; all sums of a row, whose own weights are made, too; and what
     * comes out. */
    void (*weigh)(size_t n, const cm_smooth_rows *rows, const cm_smooth_weights *weights,
                  size_t down);
    void (*smooth)(size_t n, const cm_smooth_rows *rows, const cm_smooth_weights *weights);
    void (*divide)(size_t n, const float *value, const float *sum, const float *weight, float *to);
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
