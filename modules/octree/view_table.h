/* SPDX-License-Identifier: MIT
 *
 * A view made ready for the loops: what its pixels say, and bounds of that.
 */
#ifndef MODULES_OCTREE_VIEW_TABLE_H
#define MODULES_OCTREE_VIEW_TABLE_H

#include <cubemap/depth.h>

#include "octree_object.h"

/* How far a hit reaches along a ray at most, in edges: on a grazing surface the tangent plane would let it go on. */
#define CM_REACH_MOST 8.0

/* Pixels are not where the voxel's centre is. Of what a plane changes from a pixel's centre to its corners, hits reach a part more, so
 * that walls are thin, and so many edges, for walls on the border of two voxels. What is in front of its part and edges is a miss.
 * Chosen by bench/octree: visible voxels that are occupied, crossed ones that are free, who is nearer where OctoMap disagrees. */
#define CM_HIT_ASIDE 0.6
#define CM_HIT_MORE 0.05
#define CM_FRONT_ASIDE 0.75
#define CM_FRONT_MORE 0.08

/* Slopes of noisy images are taken over more pixels. */
#define CM_APART 1
#define CM_APART_WITH_NOISE 4

/* Views of round cameras take least fronts in windows of 5 x 5 pixels, as many times one after the other as half a voxel's diagonal
 * needs for the nearest seen, but not more often. */
#define CM_AROUND_MOST 4

/* Rows of a view that are made one after the other: CM_BAND_ROWS of each plane, row r of each at cm_view_row. */
typedef struct cm_view_band
{
    float *memory;
    float *beyond;  /* a row that the picture does not have */
    float *inverse; /* 1 / depth */
    float *reach;   /* of hits of each pixel; front and back of the surface there */
    float *front;
    float *back;
    cm_break_planes heard; /* by pixels beside breaks; nothing is taken between views */
    uint16_t *is_break;    /* bits of runs of pixels */
} cm_view_band;

/* The images of a view and the memory of tables, kept from view to view. */
typedef struct cm_view_desk
{
    cm_view_table table;
    size_t stride; /* floats from row to row */
    uint32_t width;
    uint32_t height;
    void *memory;    /* of cells and images */
    float *least[2]; /* cells of two levels in turn, of the first in [1] */
    float *most[2];
    cm_pixel_rule *rule;
    uint32_t *word;          /* of colors, in rows as the rules' */
    cm_cube_bounds *windows; /* of all levels */
    float *packed;           /* the cleaned image, dense */
    uint8_t *too_near;  /* of its pixels, where all others without a depth are free; else NULL */
    cm_view_band *band; /* as many as threads have served */
    size_t bands;
    cm_pixel_gap *gap;
    int has_holes;    /* pixels that measured nothing */
    uint8_t *may_end; /* of runs of pixels, CM_BREAK_RUN each: 1 where ray_ends.h is to look */
    struct cm_ray_end *end;
    size_t end_room;
    float heed; /* half a voxel's diagonal in pixels at distance 1: so far pixels heed each other */
    float hides;    /* and no farther behind what they see */
    float greatest; /* of all that pixels say: nothing happens beyond */
    cm_rays *rays;  /* of the camera below, where needed */
    const cm_camera *rays_of;
} cm_view_desk;

void cm_view_desk_clear(cm_view_desk *desk);

/* Is this a camera whose pixels and points are joined by a division? */
int cm_camera_is_straight(const cm_camera_options *camera);

/* The cleaned image of a view, dense, depth or range as the view has it; *valid: how many pixels measured something. */
cm_status cm_view_desk_clean(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                             cm_pool *pool, size_t *valid);

/* After the rules of a row: pixels that measured what is too near say nothing, while those that measured nothing are free. */
void cm_view_desk_silence(const cm_view_desk *desk, size_t row, cm_pixel_rule *rule, float *least,
                          float *most);

/* How often windows of 5 x 5 pixels are to be taken for the cleaned image: pixels are 1 / focal_edges edges wide at distance 1. */
int cm_view_desk_around(const cm_view_desk *desk, double focal_edges);

/* All of a straight camera's view, after cm_view_desk_clean. Bands of rows are handed to the pool. */
cm_status cm_view_desk_fill(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                            cm_pool *pool);

/* Words of a view's colors, if it has any. */
void cm_view_desk_colors(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                         cm_pool *pool);

/* Floats from row to row of an image so wide; and those of an image of cells of the first level. */
static inline size_t cm_view_stride(uint32_t width)
{
    return ((size_t)width + 15) / 16 * 16 + 2 * CM_OCTREE_SLACK;
}

static inline size_t cm_view_cells(const cm_view_desk *desk)
{
    return desk->stride * ((desk->height + 1) / 2 + 2);
}

/* Memory of the windows of a picture whose width and height are there; and that of its cells, too, for a desk that has nothing
 * else. 0: none. */
int cm_view_windows_take(cm_view_desk *desk);
int cm_view_cells_take(cm_view_desk *desk);

/* Bounds in windows from those in cells of the first level, desk->least[1] and desk->most[1]. */
void cm_view_desk_windows(cm_view_desk *desk, const cm_octree_set *set, cm_pool *pool);

/* The same in parts, while cells are made. A row of these cells, or the row behind the last, is closed; windows of a row, when it and
 * the one below are closed; and when all of them are there, those of the other levels. */
void cm_view_windows_close(const cm_view_desk *desk, size_t row);
void cm_view_windows_row(const cm_view_desk *desk, const cm_octree_set *set, size_t row);
void cm_view_windows_above(cm_view_desk *desk, const cm_octree_set *set);

static inline size_t cm_view_row(const cm_view_desk *desk, size_t row)
{
    return (row & (CM_BAND_ROWS - 1)) * desk->stride;
}

/* As many bands at least. 0: no memory. */
int cm_view_bands_take(cm_view_desk *desk, size_t bands);
void cm_view_bands_clear(cm_view_desk *desk);

/* Pixels of a row that are breaks tell those of some rows of the band what they see. All fronts that it is told to are there. */
void cm_breaks_tell(const cm_view_desk *desk, const cm_octree_set *set, const cm_view_band *band,
                    size_t row, size_t first_row, size_t end_row);

/* Of a row whose rules are there: runs at the picture's border, too, have pixels whose rays may end in voxels that do not see them
 * (ray_ends.h). */
void cm_ray_ends_mark(const cm_view_desk *desk, size_t row);

#endif
