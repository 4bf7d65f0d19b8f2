/* SPDX-License-Identifier: MIT
 *
 * One resolution of a source: its planes, and what is beyond their edges.
 */
#ifndef MODULES_IMAGE_LEVEL_OBJECT_H
#define MODULES_IMAGE_LEVEL_OBJECT_H

#include "filter_set.h"
#include "sample_set.h"
#include "surface_object.h"
#include "values.h"

/* A plane: pixels of the caller as they are stored, or pixels of our own that can be mixed. */
typedef struct cm_level_plane
{
    const unsigned char *pixels; /* the first one */
    ptrdiff_t row_stride;        /* bytes */
    ptrdiff_t pixel_stride;
    const unsigned char *end; /* of what may be read */
    unsigned char
        *skirt; /* what is beyond the edges: rows above, rows below, columns to the left and to the
                                 right; pixels that can be mixed. NULL: own pixels go on by themselves */
} cm_level_plane;

typedef struct cm_level
{
    const cm_values *values;
    const cm_sample_set *set; /* of pictures */
    uint32_t planes;
    uint32_t width;
    uint32_t height;
    uint32_t channels; /* that are mixed */
    size_t pixel_size; /* of what is mixed, in bytes */
    int is_bytes;      /* are bytes mixed, and not floats? */
    int is_stored; /* are pixels as they are stored? Then a window is loaded, unless nothing need be done */
    int is_plain;         /* is what is stored mixed as it is? */
    int32_t reach;        /* pixels beyond the edges */
    struct cm_gaps *gaps; /* of planes that have gaps, else NULL */
    cm_level_plane plane[CM_PLANES_MAX];
} cm_level;

/* Memory of a thread for windows that are put together. */
typedef struct cm_scratch
{
    unsigned char *bytes;
    size_t size;
} cm_scratch;

/* A level of pictures as they are stored, with room for what is beyond the edges, which is filled from inside.
 * `memory` is told what has been read of the pictures, which may be in files. is_bytes asks for bytes; pictures must then
 * have bytes whose values can be mixed as they are. What it allocates cm_level_free frees. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_level_of_pictures(const cm_surface *surface, const cm_image *pictures,
                               const cm_values *values, const cm_sample_set *set, int is_bytes,
                               int32_t reach, const cm_memory *memory, unsigned threads,
                               cm_level *level);

void cm_level_free(cm_level *level);

/* Points of a polynomial each way between which values are interpolated, at most. */
#define CM_LEVEL_POINTS 6

/* Pixels of a row inside the plane, as they are mixed, those of gaps as they are stored. */
void cm_level_load(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t count, unsigned char *to);

/* The value at (x, y) of polynomials through points x points pixels from (left, top), all inside the plane. */
void cm_level_mix(const cm_level *level, unsigned plane, int32_t left, int32_t top, double x,
                  double y, unsigned points, unsigned char *to);

/* Does a square of count x count pixels from (left, top) of a square plane have some on either side of a diagonal? That is
 * where creases are, which polynomials do not go across. */
static inline int cm_level_is_across(uint32_t width, int32_t left, int32_t top, unsigned count)
{
    const int32_t last = (int32_t)count - 1;
    const int32_t down = left - top;
    const int32_t up = left + top + 1 - (int32_t)width;
    return (down < last && down > -last) || (up < 0 && up > -2 * last);
}

/* The sums of a pixel's channels as a pixel that can be mixed. */
void cm_level_put(const cm_level *level, const float *sum, unsigned char *to);

/* The pixel of a plane's skirt; (column, row) is beyond an edge. */
unsigned char *cm_level_skirt_pixel(const cm_level *level, unsigned plane, int32_t column,
                                    int32_t row);

/* What is beyond the edges of a level whose planes are laid and have room for it (level_skirt.c). */
void cm_level_fill_skirt(const cm_level *level, const cm_surface *surface, const cm_memory *memory,
                         unsigned threads);

/* Are these pixels in memory as samplers take them? */
int cm_level_there(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t width, int32_t height);

/* The window whose first pixel is the plane's at (column, row), of pixels that are there. */
void cm_level_own(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                  cm_window *window);

/* Pixels of a row, which may be up to reach beyond the edges, as they are mixed. */
void cm_level_row(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t width,
                  unsigned char *to);

/* Room for so many bytes, with zeros where it is new. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_scratch_room(cm_scratch *scratch, size_t size);

/* The pixels from (column, row), which may be up to reach beyond the edges, width x height of them. CM_OK or
 * CM_ERROR_MEMORY. */
cm_status cm_level_window(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                          int32_t width, int32_t height, cm_scratch *scratch, cm_window *window);

/* ---- rows of floats: level_read.c ---- */

/* How the pixels of a level of floats are read. */
typedef struct cm_level_reader
{
    const cm_level *level;
    cm_converter *convert; /* of what is inside and dense; NULL: by cm_level_row */
    float scale;
    int32_t period; /* columns after which they come again; 0: never */
} cm_level_reader;

cm_level_reader cm_level_reader_of(const cm_level *level, const cm_surface *surface,
                                   const cm_sample_set *set);

/* count pixels of a row, one beside the other. They may be up to the level's reach beyond the edges, and as far as they
 * like where columns come again. */
void cm_level_read(const cm_level_reader *reader, unsigned plane, int32_t column, int32_t row,
                   int32_t count, float *to);

/* Such pixels as they are stored, if they are inside, dense, and numbers that need no more than a scale; else NULL. */
const void *cm_level_stored(const cm_level_reader *reader, unsigned plane, int32_t column,
                            int32_t row, int32_t count);

/* What cm_level_read has as whole numbers, of which `one` is 1. desk has room for them as floats. */
void cm_level_read_whole(const cm_level_reader *reader, const cm_filter_set *set, unsigned plane,
                         int32_t column, int32_t row, int32_t count, float one, float *desk,
                         int16_t *to);

/* ---- planes with gaps: level_gaps.c ----
 *
 * What filters find beside the map, without a change of the caller's picture. Pixels whose centres are off the map, but near
 * it, have the values of the sphere where it goes on; where nothing is there, that of the nearest pixel. */

/* Of a level: which pixels are on the map, and the values of those near it that are not. */
typedef struct cm_gaps
{
    size_t words;     /* of a row */
    uint64_t *on_map; /* rows of bits, plane by plane */
    size_t
        *first; /* of a row's filled pixels in column and pixels, and the end of the last row's */
    int32_t *column; /* grows in a row */
    unsigned char *pixels;
} cm_gaps;

/* For a level whose planes are laid; what it allocates cm_gaps_free frees. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_gaps_create(const cm_level *level, const cm_surface *surface, unsigned threads,
                         cm_gaps **gaps);

/* NULL is allowed. */
void cm_gaps_free(cm_gaps *gaps);

/* The values of n pixels, inside the plane or beyond its edges, that are off the map; zeros where it is not near. */
void cm_gaps_values(const cm_level *level, const cm_gaps *gaps, const cm_surface *surface,
                    unsigned plane, size_t n, const int32_t *column, int32_t row,
                    unsigned char *to);

/* Is this pixel, which may be anywhere, one of the map's? */
int cm_gaps_have(const cm_level *level, const cm_gaps *gaps, unsigned plane, int32_t column,
                 int32_t row);

/* Is any pixel off the map among these, all of them inside the plane? */
int cm_gaps_touch(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t width,
                  int32_t height);

/* Puts the filled ones among count pixels of a row over what is there, and 0 over all others off the map. */
void cm_gaps_put(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t count,
                 unsigned char *to);

#endif
