/* SPDX-License-Identifier: MIT
 *
 * HEALPix pixels (Gorski et al. 2005): which one a point is in, where its centre, corners and neighbours are; both
 * numberings, and maps of other resolutions.
 *
 * The sphere is 12 squares, the base pixels, of nside by nside pixels of equal area, whose centres lie on 4 nside - 1
 * rings of constant latitude. In the order RING pixels are numbered from ring to ring, from north to south, and in a
 * ring towards greater longitudes, from longitude 0 on; nside is any number from 1 to 2^29. In the order NESTED, where
 * nside is a power of two, they are numbered in each base pixel by the bits of its two coordinates in turn, so that the
 * four parts of pixel p are 4 p to 4 p + 3 of 2 nside. Numbers are those of all HEALPix software, and so is longitude:
 * 0 is where the base pixels 0 and 3 meet; the mapping "healpix" is the same projection 45 degrees further.
 *
 * theta is the colatitude, from 0 at the north pole to pi, phi the longitude, lon and lat are longitude and latitude;
 * radians. Directions have any length. Bad are NaN, infinite and zero directions, NaN and infinite angles, theta outside
 * [0, pi], lat outside [-pi/2, pi/2], and numbers of no pixel: a function for one returns CM_ERROR_PIXEL and leaves its
 * output as it is; in arrays they give CM_HEALPIX_NO_PIXEL or NaN. Pointers must not be NULL unless it says so.
 *
 * An object is constant, and any number of threads may use it; nothing allocates but cm_healpix_create.
 * docs/guide/healpix.md tells of borders and orders, docs/measured/accuracy.md and costs.md of bounds and times.
 */
#ifndef CUBEMAP_HEALPIX_H
#define CUBEMAP_HEALPIX_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/options.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CM_HEALPIX_NSIDE_MAX 536870912 /* 2^29 */
#define CM_HEALPIX_NO_PIXEL (-1)       /* the number of no pixel */
#define CM_HEALPIX_UNSEEN (-1.6375e30) /* what maps of HEALPix have where they know nothing */

/* How pixels are numbered. */
typedef enum cm_healpix_order
{
    CM_HEALPIX_RING = 0,  /* from ring to ring */
    CM_HEALPIX_NESTED = 1 /* by quarters of base pixels */
} cm_healpix_order;

/* A resolution and an order. */
typedef struct cm_healpix cm_healpix;

/* Is there such a resolution in this order? CM_OK; CM_ERROR_ARGUMENT if order is none; CM_ERROR_PIXEL if nside
 * is outside 1 to CM_HEALPIX_NSIDE_MAX or, in NESTED, no power of two. On failure one line is written to
 * message, unless it is NULL, cut to message_size bytes with a zero byte at its end. */
CM_API cm_status cm_healpix_check(int64_t nside, cm_healpix_order order, char *message,
                                  size_t message_size);

/* Of the options the instruction set counts; NULL for none. Errors: those of cm_healpix_check;
 * CM_ERROR_ARGUMENT if healpix is NULL or size or tier of the options is none; CM_ERROR_INSTRUCTIONS;
 * CM_ERROR_MEMORY. To be destroyed by cm_healpix_destroy, which may be given NULL. */
CM_API cm_status cm_healpix_create(int64_t nside, cm_healpix_order order, const cm_options *options,
                                   cm_healpix **healpix);
CM_API void cm_healpix_destroy(cm_healpix *healpix);

/* What it was made from, the instruction set that it computes with, and how many pixels and rings there are. */
CM_API int64_t cm_healpix_nside(const cm_healpix *healpix);
CM_API cm_healpix_order cm_healpix_order_of(const cm_healpix *healpix);
CM_API const char *cm_healpix_instructions(const cm_healpix *healpix);
CM_API int64_t cm_healpix_pixel_count(const cm_healpix *healpix); /* 12 nside^2 */
CM_API int64_t cm_healpix_ring_count(const cm_healpix *healpix);  /* 4 nside - 1 */

/* ---- One point: CM_OK or CM_ERROR_PIXEL ---- */

CM_API cm_status cm_healpix_pixel_from_direction(const cm_healpix *healpix,
                                                 const double direction[3], int64_t *pixel);
CM_API cm_status cm_healpix_pixel_from_angles(const cm_healpix *healpix, double theta, double phi,
                                              int64_t *pixel);
CM_API cm_status cm_healpix_pixel_from_lonlat(const cm_healpix *healpix, double lon, double lat,
                                              int64_t *pixel);

/* The centre: a unit direction; theta in (0, pi), phi in [0, 2 pi); lon in [-pi, pi), lat. */
CM_API cm_status cm_healpix_direction_from_pixel(const cm_healpix *healpix, int64_t pixel,
                                                 double direction[3]);
CM_API cm_status cm_healpix_angles_from_pixel(const cm_healpix *healpix, int64_t pixel,
                                              double *theta, double *phi);
CM_API cm_status cm_healpix_lonlat_from_pixel(const cm_healpix *healpix, int64_t pixel,
                                              double lonlat[2]);

/* The same pixel's number in the other order, whatever the order of the object is. CM_ERROR_PIXEL also if
 * nside is no power of two. */
CM_API cm_status cm_healpix_nested_from_ring(const cm_healpix *healpix, int64_t ring,
                                             int64_t *nested);
CM_API cm_status cm_healpix_ring_from_nested(const cm_healpix *healpix, int64_t nested,
                                             int64_t *ring);

/* ---- n points, by vectors: the same bits as one by one, wherever a point stands ----
 *
 * Outputs must not overlap inputs, but for the two last ones, whose pixels may be written over themselves.
 * Those return CM_OK, or CM_ERROR_PIXEL, with nothing written, if nside is no power of two. */

CM_API void cm_healpix_pixel_from_direction_array(const cm_healpix *healpix, size_t n,
                                                  const double *x, const double *y, const double *z,
                                                  int64_t *pixel);
CM_API void cm_healpix_pixel_from_angles_array(const cm_healpix *healpix, size_t n,
                                               const double *theta, const double *phi,
                                               int64_t *pixel);
CM_API void cm_healpix_pixel_from_lonlat_array(const cm_healpix *healpix, size_t n,
                                               const double *lon, const double *lat,
                                               int64_t *pixel);
CM_API void cm_healpix_direction_from_pixel_array(const cm_healpix *healpix, size_t n,
                                                  const int64_t *pixel, double *x, double *y,
                                                  double *z);
CM_API void cm_healpix_angles_from_pixel_array(const cm_healpix *healpix, size_t n,
                                               const int64_t *pixel, double *theta, double *phi);
CM_API void cm_healpix_lonlat_from_pixel_array(const cm_healpix *healpix, size_t n,
                                               const int64_t *pixel, double *lon, double *lat);
CM_API cm_status cm_healpix_nested_from_ring_array(const cm_healpix *healpix, size_t n,
                                                   const int64_t *ring, int64_t *nested);
CM_API cm_status cm_healpix_ring_from_nested_array(const cm_healpix *healpix, size_t n,
                                                   const int64_t *nested, int64_t *ring);

/* ---- Around a pixel ---- */

/* The pixels that touch it, in the order south-west, west, north-west, north, north-east, east, south-east,
 * south (that of healpix_cxx), CM_HEALPIX_NO_PIXEL where there is none: at eight corners of base pixels only
 * three meet. At nside 1 a pixel may be its neighbour's neighbour twice; it is named once for each side and
 * corner. CM_OK or CM_ERROR_PIXEL. */
CM_API cm_status cm_healpix_neighbours(const cm_healpix *healpix, int64_t pixel,
                                       int64_t neighbour[8]);

/* 4 steps points of its boundary as unit directions, from the north corner by the west, south and east corner;
 * steps, 1 to 2^20, points a side, at equal distances in the plane of the projection; with 1 the corners. The
 * order is that of healpix_cxx's boundaries. x, y and z have room for 4 steps numbers. CM_OK,
 * CM_ERROR_ARGUMENT (steps) or CM_ERROR_PIXEL. */
CM_API cm_status cm_healpix_boundary(const cm_healpix *healpix, int64_t pixel, size_t steps,
                                     double *x, double *y, double *z);

/* ---- Rings ---- */

/* size must be sizeof(cm_healpix_ring) before the call. */
typedef struct cm_healpix_ring
{
    size_t size;    /* sizeof(cm_healpix_ring) */
    int64_t ring;   /* 1 at the north pole to 4 nside - 1 */
    int64_t first;  /* the RING number of its first pixel */
    int64_t count;  /* of its pixels */
    double z;       /* cos theta of their centres */
    double rho;     /* sin theta, relatively accurate at the poles */
    int is_shifted; /* is the first centre half a pixel from longitude 0, else on it? */
} cm_healpix_ring;

/* CM_OK; CM_ERROR_ARGUMENT (size); CM_ERROR_PIXEL if there is no such ring. */
CM_API cm_status cm_healpix_ring_info(const cm_healpix *healpix, int64_t ring,
                                      cm_healpix_ring *info);

/* The ring that a pixel, in the order of the object, is on, and its index there, from 0. CM_OK or
 * CM_ERROR_PIXEL. */
CM_API cm_status cm_healpix_ring_from_pixel(const cm_healpix *healpix, int64_t pixel, int64_t *ring,
                                            int64_t *index);

/* ---- Maps ---- */

/* To be filled with zeros but for size, which is sizeof(cm_healpix_regrade_options), and for what is
 * wanted. */
typedef struct cm_healpix_regrade_options
{
    size_t size;        /* sizeof(cm_healpix_regrade_options) */
    int is_pessimistic; /* is a pixel with any bad part bad, instead of one with only bad parts? */
    double
        power; /* the result is divided by (nside of from / nside of to)^power: 0 for means, -2 for
                           sums, of counts */
    int bad_is_nan; /* do bad pixels of the result become NaN instead of CM_HEALPIX_UNSEEN? */
} cm_healpix_regrade_options;

/* A map of another resolution or order, as healpy's ud_grade: a pixel becomes the mean of the good ones among
 * its parts, or is given to all its parts. map has as many numbers as from has pixels, in its order, result as
 * to has; they must not overlap. Bad are NaN, infinities and what is within 1e-5, relative, of
 * CM_HEALPIX_UNSEEN. Sums are made in double. options NULL: none.
 * Both nside must be powers of two, or the same (then in any order that it has). CM_OK; CM_ERROR_ARGUMENT if a
 * pointer other than options is NULL, size is none or power is not finite; CM_ERROR_PIXEL (nside). */
CM_API cm_status cm_healpix_regrade(const cm_healpix *from, const double *map, const cm_healpix *to,
                                    double *result, const cm_healpix_regrade_options *options);
CM_API cm_status cm_healpix_regrade_f32(const cm_healpix *from, const float *map,
                                        const cm_healpix *to, float *result,
                                        const cm_healpix_regrade_options *options);

#ifdef __cplusplus
}
#endif

#endif
