/* SPDX-License-Identifier: MIT
 *
 * The loops of drawing, once for each instruction set.
 */
#ifndef MODULES_SCENE_RASTER_SET_H
#define MODULES_SCENE_RASTER_SET_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Pictures have so many more columns and rows in memory, which are drawn into and never read. */
#define CM_RASTER_SLACK 4

/* Discs that are made ready together. */
#define CM_DISC_BLOCK 256

/* Columns and rows of pictures into which discs are drawn by blocks, as floats and int32_t hold them. */
#define CM_DISC_PIXELS_MOST 1048576

/* A pixel is one number: the bits of its nearness above those of ~id. So the larger one is nearer, or as near with a smaller
 * id; 0 is nothing. Pixels lie in quads, two columns by two rows: a small disc meets few lines of the cache. */
#define CM_RASTER_EMPTY INT64_C(0)

/* Where a pixel is; stride is that of two rows. */
static inline size_t cm_raster_place(size_t stride, size_t column, size_t row)
{
    return (row >> 1) * stride + 4 * (column >> 1) + 2 * (row & 1) + (column & 1);
}

static inline int64_t cm_raster_key(float nearness, uint32_t id)
{
    uint32_t bits;
    memcpy(&bits, &nearness, sizeof bits);
    return (int64_t)((uint64_t)bits << 32 | (uint32_t)~id);
}

static inline float cm_raster_nearness(int64_t key)
{
    const uint32_t bits = (uint32_t)((uint64_t)key >> 32);
    float nearness;
    memcpy(&nearness, &bits, sizeof nearness);
    return nearness;
}

static inline uint32_t cm_raster_id(int64_t key)
{
    return ~(uint32_t)((uint64_t)key & UINT32_MAX);
}

/* Rays of pixels beside each other. */
typedef struct cm_raster_rays
{
    const double *x;
    const double *y; /* NULL: y_all, and z is 1 */
    const double *z;
    double y_all;
} cm_raster_rays;

/* Pixels beside each other, and what is drawn there. */
typedef struct cm_raster_pixels
{
    int64_t *row;  /* its first pixel */
    size_t column; /* from which on */
    float near_most;
    uint32_t own; /* id */
} cm_raster_pixels;

/* A triangle: what is on the inner side of three planes through the camera's centre. */
typedef struct cm_raster_triangle
{
    double corner[3][3]; /* directions of corners, counter-clockwise for who sees their front */
    double edge[3][3];   /* normals of the planes */
    double slack[3];     /* so far from 0 signs are sure */
    double plane[3];     /* nearness is that times the ray */
    double least, most;  /* nearness is between these */
} cm_raster_triangle;

/* A disc. */
typedef struct cm_raster_disc
{
    double centre[3];
    double plane[3]; /* as of triangles */
    double square;   /* of the radius */
    double distance; /* of the centre, and the sine and cosine of the cone around the disc; */
    double sine;     /* 2: all directions */
    double cosine;
} cm_raster_disc;

/* A plain camera, and its pose. */
typedef struct cm_disc_view
{
    double rotation[9];
    double position[3];
    double fx, fy, cx, cy; /* of pixels whose centres are whole numbers */
    float width, height;
    float near_most;
    const float *column_x; /* rays of columns */
    const float *row_y;    /* and of rows */
    size_t stride;
    int64_t *key;
} cm_disc_view;

/* Discs in the camera's axes and in its picture. */
typedef struct cm_disc_block
{
    float centre[3][CM_DISC_BLOCK];
    float plane[3][CM_DISC_BLOCK];
    float square[CM_DISC_BLOCK];
    int32_t first_column[CM_DISC_BLOCK];
    int32_t last_column[CM_DISC_BLOCK];
    int32_t first_row[CM_DISC_BLOCK];
    int32_t last_row[CM_DISC_BLOCK];
    int32_t is_boxed[CM_DISC_BLOCK]; /* not 0: it is seen, and what is above is all of it */
    int32_t is_odd
        [CM_DISC_BLOCK]; /* not 0: there is no box, since it may reach behind the camera, or floats do not hold it */
} cm_disc_block;

typedef struct cm_raster_set
{
    const char *name; /* first: as in options.h */
    void (*triangle_row)(size_t n, const cm_raster_rays *rays, const cm_raster_triangle *shape,
                         const cm_raster_pixels *pixels);
    void (*disc_row)(size_t n, const cm_raster_rays *rays, const cm_raster_disc *shape,
                     const cm_raster_pixels *pixels);
    /* n discs from arrays: centre, normal, radius. */
    void (*discs_place)(size_t n, const float *const from[7], const cm_disc_view *view,
                        cm_disc_block *block);
    /* Those that have boxes, in rows first to last - 1. */
    void (*discs_draw)(size_t n, const cm_disc_view *view, const cm_disc_block *block, size_t first,
                       size_t last, uint32_t id);
    /* What is seen in n pixels from the first of a row on: 1 / nearness, NaN where nothing is. Each may be NULL. */
    void (*read_row)(size_t n, const int64_t *row, float *depth, uint32_t *id);
} cm_raster_set;

extern const cm_raster_set cm_raster_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_raster_set cm_raster_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_raster_set cm_raster_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_raster_set cm_raster_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_raster_set cm_raster_neon;
#endif

/* As cm_depth_set_find. */
const cm_raster_set *cm_raster_set_find(const char *name);

#endif
