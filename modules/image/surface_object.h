/* SPDX-License-Identifier: MIT
 *
 * What a surface is inside: planes of pixels, each a part of the sphere in one piece, and where they stand in pictures.
 */
#ifndef MODULES_IMAGE_SURFACE_OBJECT_H
#define MODULES_IMAGE_SURFACE_OBJECT_H

#include "filter_set.h"

#include <cubemap/image.h>

/* No surface has more planes: the twelve squares of HEALPix. */
#define CM_PLANES_MAX 12

/* Room for a specification that is written out. */
#define CM_SURFACE_TEXT 512

/* No kind keeps more. */
#define CM_SURFACE_NUMBERS 16

/* How a plane's picture is turned in a picture of several: its rows and columns are exchanged first, then mirrored. */
#define CM_TURN_EXCHANGED 1u
#define CM_TURN_COLUMNS 2u /* columns count from the right */
#define CM_TURN_ROWS 4u    /* rows count from the bottom */

/* Edges that are poles, if rows are evenly apart in latitude and columns are all around. */
#define CM_POLE_UPPER 1u
#define CM_POLE_LOWER 2u

/* Where in which picture a plane stands. */
typedef struct cm_placement
{
    uint32_t picture;
    uint32_t column; /* of the upper left pixel */
    uint32_t row;
    unsigned turn; /* CM_TURN_... */
} cm_placement;

/* What a kind of surface does. Directions are in the surface's own axes here, and of unit length where they are given
 * out. Arrays have n elements. */
typedef struct cm_surface_methods
{
    /* Positions on one plane to directions; NaN where there is none. Positions may be beyond the plane's edges
     * by some pixels if can_go_beyond is true: the plane goes on there, smoothly, along the sphere. */
    void (*directions)(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z);
    /* Directions to positions; CM_NO_FACE and NaN where there is none. Results may overwrite arguments. */
    void (*positions)(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row);
    int can_go_beyond;
    /* Have these positions a direction? For surfaces with gaps; NULL: directions tell. */
    void (*covers)(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                   const double *row, uint8_t *covered);
} cm_surface_methods;

struct cm_surface
{
    const cm_surface_methods *methods;
    char specification[CM_SURFACE_TEXT];
    uint32_t planes;
    uint32_t width; /* of a plane */
    uint32_t height;
    uint32_t pictures;
    uint32_t picture_width;
    uint32_t picture_height;
    cm_placement placement[CM_PLANES_MAX];
    double period;                     /* pixels after which columns come again; 0: they do not */
    unsigned poles;                    /* CM_POLE_... */
    int creased;                       /* are there lines inside a plane where derivatives jump? */
    int has_gaps;                      /* are there positions on planes without a direction? */
    int is_turned;                     /* does rotation turn? */
    cm_rotation rotation;              /* the surface's axes in those of the Earth */
    cm_mapping *mapping;               /* of faces, else NULL */
    cm_frame frame;                    /* of a cube's faces */
    double number[CM_SURFACE_NUMBERS]; /* what the kind keeps */
};

/* Another surface of the same kind, size and rotation. */
cm_status cm_surface_copy(const cm_surface *surface, cm_surface **copy);

/* Positions to directions of the Earth, on one plane and not beyond its edges unless the kind goes on there. */
void cm_surface_own_directions(const cm_surface *surface, unsigned plane, size_t n,
                               const double *column, const double *row, double *x, double *y,
                               double *z);

/* Positions to directions of the Earth, on one plane, where directions may be asked some pixels beyond the edges:
 * where the kind itself does not go on, they are extrapolated from inside (surface_beyond.c), the faster if places one
 * after the other are on a line that leaves the plane across an edge. No result may overwrite a place. */
void cm_surface_directions_beyond(const cm_surface *surface, unsigned plane, size_t n,
                                  const double *column, const double *row, double *x, double *y,
                                  double *z);

/* Pixels along an edge that are asked for together, and the points that the directions beyond them are made of. */
#define CM_EDGE_RUN 64
#define CM_EDGE_NODES CM_NODES

typedef enum cm_edge
{
    CM_EDGE_LEFT,
    CM_EDGE_RIGHT,
    CM_EDGE_UPPER,
    CM_EDGE_LOWER
} cm_edge;

typedef struct cm_edge_run
{
    size_t count;
    double node[3][CM_EDGE_NODES * CM_EDGE_RUN]; /* rows along the edge, from the edge inwards */
} cm_edge_run;

/* What lies beyond `count` pixels along an edge, from pixel `begin` of it on; 0 if cm_surface_directions_beyond must be asked,
 * which has other polynomials for some. */
int cm_surface_edge_nodes(const cm_surface *surface, unsigned plane, cm_edge edge, int32_t begin,
                          size_t count, cm_edge_run *run);

/* Directions of the centres of those `away` pixels beyond the last, from 0 on: the same numbers as
 * cm_surface_directions_beyond has. */
void cm_surface_edge_directions(const cm_edge_run *run, const cm_filter_set *set, int32_t away,
                                double *x, double *y, double *z);

/* 1 for positions on the plane that have a direction, else 0. */
void cm_surface_covers(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, uint8_t *covered);

/* Places on a map, and places off it that are some pixels away. */
typedef struct cm_rim_places
{
    double *inner_column;
    double *inner_row;
    double *column;
    double *row;
} cm_rim_places;

/* Directions of the Earth with which the map goes on at places off it (surface_rim.c). */
void cm_surface_continue(const cm_surface *surface, unsigned plane, size_t n,
                         const cm_rim_places *at, double *x, double *y, double *z);

/* The same where pixels are that wide and high, in the surface's own: the points of extrapolation are so far apart. */
void cm_surface_directions_spaced(const cm_surface *surface, unsigned plane,
                                  const double spacing[2], size_t n, const double *column,
                                  const double *row, double *x, double *y, double *z);

/* Where the pixels of a row beyond an edge lie, if columns come again: each is the pixel so many columns further of that
 * row. Pixels are that wide and high. 0 if they are no pixels. */
int cm_surface_same_row(const cm_surface *surface, const double spacing[2], int32_t row,
                        int32_t *further, int32_t *same);

/* Directions of the Earth to positions. Results may overwrite arguments. */
void cm_surface_find(const cm_surface *surface, size_t n, const double *x, const double *y,
                     const double *z, uint8_t *plane, double *column, double *row);

/* The position in its picture of a plane's pixel. */
void cm_placement_pixel(const cm_surface *surface, unsigned plane, uint32_t column, uint32_t row,
                        uint32_t *picture_column, uint32_t *picture_row);

#endif
