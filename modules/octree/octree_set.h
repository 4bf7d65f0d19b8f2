/* SPDX-License-Identifier: MIT
 *
 * The loops of an update, once for each instruction set, all with the same bits: no operation is fused, quotients are true
 * ones, and what a pixel is depends on the place of a voxel's centre alone.
 */
#ifndef MODULES_OCTREE_OCTREE_SET_H
#define MODULES_OCTREE_OCTREE_SET_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "round_loops.h"

/* Rows of images have so many floats before their beginning and behind their end that can be read. */
#define CM_OCTREE_SLACK 16

/* What a pixel says of a voxel whose centre falls on it at Z, depth or range: a hit if |Z - depth| <= reach, a miss if
 * Z < depth - front. reach and front are the upper halves of floats, that of front upper. depth is NaN where nothing is
 * said; reach is negative where nothing is hit. */
typedef struct cm_pixel_rule
{
    float depth;
    uint32_t reach_front;
} cm_pixel_rule;

/* A bit of reach_front, the sign of a front above 0: the pixel has a gap, and what lies in it is a miss, too. It may be
 * empty. */
#define CM_RULE_HAS_GAP 0x80000000u

/* The upper half of a number not below 0, rounded up. */
static inline uint32_t cm_upper_half(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits + 0xffffu) & 0xffff0000u;
}

static inline float cm_from_upper_half(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Between what a nearer surface hides and the pixel's own: depths. */
typedef struct cm_pixel_gap
{
    float from;
    float to;
} cm_pixel_gap;

/* Pixels beside a break are no farther from it. */
#define CM_BREAK_RADIUS 8

/* Runs of so many pixels of a row are worked on together. */
#define CM_BREAK_RUN 16

/* Rows of a band of a view that are made one after the other and forgotten soon, so that they stay near: a power of two of them, as
 * many as lie between the first and the last that a pixel has to do with. Row r of each plane begins so many rows after its first. */
#define CM_BAND_ROWS 32

/* What is told in a band: planes of rows that are `stride` apart. Of runs of pixels that were not told anything yet only is_taken
 * is known, which is 0. */
typedef struct cm_break_planes
{
    size_t stride;
    const float *front; /* of the surface of each pixel */
    float *own_front;   /* of it and those that join it */
    float *near_front;  /* of all surfaces in front of it; infinite: none */
    float *near_back;   /* voxels that are farther do not reach them */
    uint8_t *is_taken;  /* of runs, in rows that are stride / CM_BREAK_RUN apart */
} cm_break_planes;

/* A pixel at a break tells pixels around it what it sees. */
typedef struct cm_break_teller
{
    size_t column;
    size_t row;
    size_t width;     /* of the picture */
    size_t first_row; /* that may hear it: no farther than the radius */
    size_t end_row;
    float front; /* of its surface */
    float back;
    float heed;   /* so far pixels at distance 1 heed each other */
    float hides;  /* and no farther behind what they see */
    float radius; /* in pixels, whole ones */
} cm_break_teller;

/* A row of a band whose pixels have heard all, in memory that has room for whole runs. */
typedef struct cm_ruled_row
{
    const float *depth; /* clean */
    const float *reach;
    const float *front;
    const float *own_front; /* of runs that are taken */
    const float *near_front;
    const float *near_back;
    uint8_t *is_taken; /* 0 after it */
    uint8_t
        *may_end; /* of runs: 1 if it is taken or steep: of four pixels one reaches most_reach */
    cm_pixel_rule *rule;
    cm_pixel_gap *gap;
    float far; /* what is farther is no hit */
    float
        free_far; /* what pixels without a measurement are free up to, NaN: nothing is said of them */
    float most_reach; /* no hit reaches more, but for noise */
} cm_ruled_row;

/* What is nearer than least is missed, what is farther than most is not touched; with a little room for rounding. */
typedef struct cm_cube_bounds
{
    float least;
    float most;
} cm_cube_bounds;

/* Least and greatest of what pixels say within windows of 2 x 2 cells of 2^level pixels, at each cell: what is nearer than
 * least is missed by all, what is farther than most is touched by none. Levels begin at 1: few cubes are so far that windows of
 * pixels would say more. */
typedef struct cm_window_level
{
    uint32_t width;
    uint32_t height;
    cm_cube_bounds *bounds;
} cm_window_level;

#define CM_WINDOW_LEVELS 32

/* A view, as the loops have it. Places in its picture are columns and rows from the centre of the first pixel. */
typedef struct cm_view_table
{
    uint32_t width;
    uint32_t height;
    uint32_t stride; /* of rules, from row to row */
    float focal[2];  /* pixels along rows and columns */
    float centre[2]; /* the principal point */
    float near;      /* what is nearer is not seen */
    /* columns and rows: pixels at distance 1 that a voxel's centre may be before the first and behind
     * the last while its corners are still in the picture */
    float beside[2][2];
    float axes[3][3]; /* the camera's, in the world's */
    float half;       /* of a voxel's edge */
    float widest;     /* the greater focal length */
    const cm_pixel_rule *rule;
    const cm_pixel_gap *gap; /* in rows as rules; of pixels that have one */
    int levels;
    cm_window_level level[CM_WINDOW_LEVELS];
    const cm_cube_bounds
        *window; /* of all levels: where each begins, and how far its rows are apart */
    uint32_t first_window[CM_WINDOW_LEVELS];
    uint32_t window_row[CM_WINDOW_LEVELS];
} cm_view_table;

/* Where the camera is: so many edges aside of the lower corner of the voxel it is in. */
typedef struct cm_eye
{
    float aside[3];
    float ray
        [3]
        [3]; /* edges along the world's axes: a column, a row, and straight ahead, at distance 1 */
    float step
        [3]
        [3]; /* columns times Z, rows times Z, and Z, of an edge along each of the world's axes */
} cm_eye;

/* Rays that end farther from the camera, in edges, are not looked at: floats have no places of voxels there. */
#define CM_CELLS_AWAY 4194304.0f

/* Voxels that the rays of a run of pixels end in, from that of the camera. */
typedef struct cm_ended_run
{
    int32_t cell[3][CM_BREAK_RUN];
} cm_ended_run;

/* What is known of a cube of voxel centres. */
typedef enum cm_cube_class
{
    CM_CUBE_OUTSIDE = 0, /* nothing happens in it */
    CM_CUBE_FREE = 1,    /* all of it is missed */
    CM_CUBE_BAND = 2,    /* perhaps not, and all of it falls on the picture */
    CM_CUBE_PART = 3,    /* perhaps not */
    CM_CUBE_FRONT = 4,   /* what of it falls on the picture is missed, and nothing is hit */
    CM_CUBE_UNKNOWN = 5  /* not told here; no loop says so */
} cm_cube_class;

/* Offsets of the cells' centres of a block from that of its first voxel, in the camera's axes; those of each detail. */
typedef struct cm_cell_offsets
{
    float x[512];
    float y[512];
    float z[512];
} cm_cell_offsets;

#define CM_BLOCK_GROUPS 8

/* 64 cells of a block, and what happens to them. */
typedef struct cm_visited_group
{
    const float *first; /* the centre of the block's first voxel, in the camera's axes */
    const float *x;     /* offsets from there */
    const float *y;
    const float *z;
    float scale;           /* edges that cells are wide */
    int is_inside;         /* 1: all fall on the picture */
    int is_front;          /* 1: all are in front of what their pixels say */
    cm_cube_bounds bounds; /* of the pixels that they fall on */
    uint64_t *hits;        /* bits */
    uint64_t *misses;
    int32_t *pixel; /* 64: the rules' indices of those that are hit, perhaps of others */
} cm_visited_group;

/* A row of a depth image and its surroundings: 1 / depth, NaN where nothing was measured. */
typedef struct cm_rule_row
{
    const float *depth; /* clean */
    const float *at;    /* 1 / depth of this row, `apart` above and below */
    const float *above;
    float *below;
    const float *
        next; /* depth of the row below, of which 1 / depth is found, too; NULL: there is none, or it is there */
    uint32_t apart;     /* pixels between those that slopes are found by */
    float column_place; /* of the first column from the principal point */
    float row_place;
    float step; /* 1 / apart */
    float focal[2];
    float axes[3][3]; /* columns are of the world's axes in the camera */
    float half;       /* an edge */
    /* of what a plane changes from a pixel's centre to its corners, what hits reach more */
    float hit_aside;
    float hit_more;    /* and added to that */
    float front_aside; /* the same of what is not missed */
    float front_more;
    float relative;       /* times depth, added, too: the sensor's noise */
    float most;           /* no hit reaches more, but for noise */
    float front_relative; /* times depth: what noise adds to the front */
    float far;            /* what is farther is no hit, and free up to here */
    /* what pixels without a measurement are free up to; NaN: nothing is said of them */
    float free_far;
    float bend;          /* depths that differ by more from a plane show a bend, */
    float bend_relative; /* and times depth: what noise adds */
} cm_rule_row;

#define CM_MIX_MULTIPLE 16

/* What hits do to colors. */
typedef struct cm_hit_colors
{
    const uint32_t *word; /* of pixels */
    /* of a hit's color in its voxel's, in 65536ths, where alpha was that before; 0: it is not occupied even now */
    uint32_t part_of[256];
} cm_hit_colors;

/* Where a point is, in edges from the tree's lower corner, by which it is told which voxel it lies in. */
#define CM_PLACE_OF(world, centre, edge, middle) (((world) - (centre)) / (edge) + (middle))

/* Points that are asked together; coordinates of a voxel in a word, x lowest; and the word of what is of no voxel. */
#define CM_POINTS_TOGETHER 64
#define CM_PLACE_BITS 21
#define CM_NO_PLACE UINT64_MAX

/* Which points are of a map's voxels. */
typedef struct cm_point_grid
{
    double origin[3];
    double least; /* the square of the distance from there: what is nearer or farther is of none */
    double most;
    double centre[3];
    double edge;
    double middle;   /* edges from the lower corner to the centre */
    double first[3]; /* voxels of the map */
    double beyond[3];
} cm_point_grid;

typedef struct cm_octree_set
{
    const char *name; /* first: as in options.h */
    /* 1 / depth. */
    void (*invert)(size_t n, const float *depth, float *inverse);
    /* How far a hit reaches around each depth; depth less reach and noise: what is nearer is in front of the surface; depth with
     * both. Where nothing was measured they are free_far and infinite. Bits of runs: where the surface bends. n is whole runs. */
    void (*reaches)(size_t n, const cm_rule_row *row, float *reach, float *front, float *back,
                    uint16_t *is_break);
    /* And where a neighbour sees something behind the pixel, apart from it; fronts of the row above, of this and of the one below. */
    void (*breaks)(size_t n, const float *const front[3], const float *back, uint16_t *is_break);
    /* To those around it that see something behind the teller: fronts of surfaces that join theirs; of surfaces in front, and up to
     * where voxels reach those. Runs within the radius are taken. */
    void (*tell)(const cm_break_teller *teller, const cm_break_planes *to);
    /* Rules and bounds of a row; front_of: the least front that each pixel heeds; free_far: what pixels without a measurement are free up to, NaN: nothing is said of them. */
    void (*rules)(size_t n, const float *depth, const float *reach, const float *front_of,
                  float far, float free_far, cm_pixel_rule *rule, float *least, float *most);
    /* The same, and gaps, of a row of a band or two, and bounds in the cells of 2 x 2 pixels that are theirs. Pixels without a front
     * measured what is too near: nothing is said of them. */
    void (*band_rules)(size_t width, const cm_ruled_row *row, int rows, float *least, float *most);
    /* Words of colors (region.h) of pixels that are `apart` bytes from each other. */
    void (*words)(size_t n, const uint8_t *rgb, ptrdiff_t apart, uint32_t *word);
    /* Cells of twice the size from two rows of cells; n of the new ones. */
    void (*halve)(size_t n, const float *const least_of[2], const float *const most_of[2],
                  float *least, float *most);
    /* Windows of 2 x 2 cells from two rows: n of them. */
    void (*windows)(size_t n, const float *const least_of[2], const float *const most_of[2],
                    cm_cube_bounds *bounds);
    /* Classes of n cubes with centres x, y, z in the camera's axes, all with the half lengths of a box along those axes; and, if
     * bounds is not NULL, of each that may be something else than outside and free, bounds of what its pixels say. Arrays have
     * room for a multiple of 16. */
    void (*classify)(const cm_view_table *view, size_t n, const float *x, const float *y,
                     const float *z, const float half[3], uint8_t *class_of,
                     cm_cube_bounds *bounds);
    /* The same of what is measured from `near` to `far` of each cube, where that is not Z; what is no farther than `nearest` is not
     * seen. All cubes are in front of the picture. */
    void (*classify_between)(const cm_view_table *view, size_t n, const float *x, const float *y,
                             const float *z, const float half[3], const float *near,
                             const float *far, float nearest, uint8_t *class_of,
                             cm_cube_bounds *bounds);
    /* What happens to the cells of up to CM_BLOCK_GROUPS groups. */
    void (*visit)(const cm_view_table *view, size_t n, const cm_visited_group *group);
    /* Bits of a run of pixels, from a column on, that hit something while the voxel that their ray ends in is not hit by the pixel its
     * centre falls on. Pixels behind the end of the row may have bits, too. */
    uint32_t (*lost_ends)(const cm_view_table *view, const cm_eye *eye, uint32_t column,
                          uint32_t row, cm_ended_run *run);
    /* Colors of groups of up to 64 cells after hits by pixels, mixed as cm_color_blend; alpha: before them. Returns 1 if any
     * changed. */
    int (*color)(const cm_hit_colors *hit, size_t groups, const uint8_t *alpha,
                 const uint64_t *hits, const int32_t (*pixel)[64], uint32_t *color);
    /* Alphas of groups of 64 after hits and misses: saturating. Those that nothing happens in stay as they are. Returns 1 if any
     * changed. */
    int (*count)(size_t groups, uint8_t *alpha, const uint64_t *hits, const uint64_t *misses,
                 uint8_t hit, uint8_t miss, uint8_t low, uint8_t high);
    /* Voxels of CM_POINTS_TOGETHER points. place[-1] is that before the first. Returns bits of those that are in a voxel, and not in
     * that of the point before. */
    uint64_t (*places)(const cm_point_grid *grid, const float *xyz, uint64_t *place);
    /* Of cameras that are not straight, as round_loops.inc has them. */
    void (*round_reaches)(size_t n, const cm_round_row *row, float *reach, float *front);
    void (*round_least)(size_t n, size_t count, size_t apart, const float *from, float *to);
    void (*round_ends)(size_t n, const cm_round_rays *rays, size_t first, int32_t *x, int32_t *y,
                       int32_t *z);
    uint64_t (*round_eights)(const cm_round_terms *terms, const cm_round_group *group,
                             cm_round_cells *to);
    void (*round_ask)(const cm_round_picture *picture, size_t n, const double *column,
                      const double *row, float scale, float *value, int32_t *pixel,
                      uint64_t hits[8], uint64_t misses[8]);
} cm_octree_set;

extern const cm_octree_set cm_octree_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_octree_set cm_octree_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_octree_set cm_octree_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_octree_set cm_octree_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_octree_set cm_octree_neon;
#endif

/* The set of that name, the scalar one if this build has none. */
const cm_octree_set *cm_octree_set_find(const char *name);

#endif
