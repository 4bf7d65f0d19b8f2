/* SPDX-License-Identifier: MIT
 *
 * HiPS, "Hierarchical Progressive Surveys", version 1.0 of the IVOA: which pixels of a HEALPix surface are which tile, how
 * they lie in it, what the files are called, and the text of "properties". Files are the caller's.
 *
 *   tile        pixel number `number` of order `order` in NESTED; width x width pixels, those of the order
 *               order + log2(width)
 *   surface     "healpix" of image.h, with a plane of width 2^order pixels for each base pixel
 *   inside      the upper left pixel of a tile's PNG or JPEG is its southernmost one; rows go down towards east, columns
 *               right towards west. Rows of FITS are from the lowest: its first pixel is the easternmost one
 *   axes        of the Earth as in image.h are hips_frame's: x towards longitude 0; who has others turns the surface
 *   example     cm_hips_place(3, 5, 512, &place): render the window of place.plane that place tells, into an image
 *               `window`; cm_hips_tile(&window, &tile); write the picture `tile` as cm_hips_tile_path(3, 5, "png", path)
 */
#ifndef CUBEMAP_MODULES_IMAGE_HIPS_H
#define CUBEMAP_MODULES_IMAGE_HIPS_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* No order of a pixel is greater: nside 2^29. */
#define CM_HIPS_ORDER_MOST 29

/* Room for a path. */
#define CM_HIPS_PATH 80

/* Where a tile is. */
typedef struct cm_hips_window
{
    uint32_t plane;  /* the base pixel, 0 to 11 */
    uint32_t column; /* of the plane: the left one of the tile's */
    uint32_t row;    /* of the plane, from its upper edge: the upper one */
    uint32_t width;  /* of the tile: so many columns and rows */
    uint32_t planes; /* pixels along the edge of a plane */
} cm_hips_window;

/* What "properties" says; texts without line ends, NULL for what is not said. */
typedef struct cm_hips_properties
{
    size_t size;             /* sizeof(cm_hips_properties) */
    const char *creator_did; /* "ivo://AUTHORITY/NAME"; needed */
    const char *title;       /* obs_title; needed */
    const char
        *frame; /* hips_frame: "equatorial", "galactic", "ecliptic", or of a planet; needed */
    const char *tile_format; /* "png", "jpeg", "fits", more than one apart by a blank; needed */
    const char *release;     /* hips_release_date: "2026-11-23T12:00Z"; needed */
    const char *status;      /* hips_status; NULL: "public master clonableOnce" */
    const char *copyright;   /* obs_copyright */
    const char *builder;     /* hips_builder: what wrote it */
    uint32_t order;          /* the greatest order of tiles */
    uint32_t order_least;    /* the least one */
    uint32_t tile_width;     /* pixels, a power of two */
} cm_hips_properties;

/* Where tile `number` of an order lies. CM_ERROR_ARGUMENT: NULL, or width is no power of two; CM_ERROR_RANGE: the order is
 * too great for this width or for pictures; CM_ERROR_PIXEL: no such tile. */
cm_status cm_hips_place(uint32_t order, uint64_t number, uint32_t width, cm_hips_window *window);

/* A square part of a plane, as cm_hips_place has it, as a tile, rows from the top as in PNG and JPEG: the same pixels with
 * other strides, so that nothing is copied. CM_ERROR_ARGUMENT: NULL, or no square. */
cm_status cm_hips_tile(const cm_image *window, cm_image *tile);

/* "Norder3/Dir0/Npix5.png", of the format "png", "jpg" or "fits". CM_ERROR_PIXEL: no such tile; CM_ERROR_ARGUMENT: NULL,
 * or another format. */
cm_status cm_hips_tile_path(uint32_t order, uint64_t number, const char *format,
                            char path[CM_HIPS_PATH]);

/* "Norder3/Allsky.png": the same for the preview of an order. CM_ERROR_RANGE: an order above 29. */
cm_status cm_hips_preview_path(uint32_t order, const char *format, char path[CM_HIPS_PATH]);

/* The preview of an order has its tiles in rows, from left to right and from the top: so many in a row, and so many rows.
 * Tile `number` is at column number % columns and row number / columns. CM_ERROR_ARGUMENT; CM_ERROR_RANGE: an order above
 * 13. */
cm_status cm_hips_preview(uint32_t order, uint32_t *columns, uint32_t *rows);

/* The text of the file "properties", lines ended by "\n", to room bytes with a zero byte at its end; *length is without
 * it. CM_ERROR_ARGUMENT: NULL, what is needed is missing, or control characters; CM_ERROR_RANGE: orders or width;
 * CM_ERROR_SPACE: no room, and *length says what is needed. */
cm_status cm_hips_write_properties(const cm_hips_properties *properties, size_t room, char *text,
                                   size_t *length);

/* A tile as a FITS file of one picture of one channel: 8 bits, floats, or 16 bits with BZERO; rows are turned, keywords
 * ORDER and NPIX are written. tile is as cm_hips_tile gives it. CM_ERROR_ARGUMENT: NULL, no square, more channels or
 * another type; CM_ERROR_PIXEL; CM_ERROR_MEMORY; CM_ERROR_UNSUPPORTED: the stream took no more. */
cm_status cm_hips_write_fits(const cm_image_stream *stream, uint32_t order, uint64_t number,
                             const cm_image *tile, char *message);

#ifdef __cplusplus
}
#endif

#endif
