/* SPDX-License-Identifier: MIT
 *
 * Grids: a mapping on an ellipsoid, as one object. A point goes from geographic longitude and latitude, or from the
 * normal there, to an auxiliary latitude, which makes it a point of a sphere; that is rotated into the base cube, or
 * whatever the mapping has, and mapped to a face; and back.
 *
 * With the authalic latitude and an equal-area mapping, equal areas on a face are equal areas on the ellipsoid; with
 * the conformal latitude and a conformal mapping the whole is conformal.
 *
 * Conventions of every function here, besides those of mapping.h:
 *   normal      the direction of the ellipsoid's normal at a point, (cos lat cos lon, cos lat sin lon,
 *               sin lat) with geographic latitude: three finite numbers, not all zero, of any length
 *   lon, lat    geographic, radians; lon any finite number, lat in [-pi/2, pi/2], up to 1e-9 beyond which is
 *               taken as the pole. Inverse gives lon in [-pi, pi]
 *   arrays      may be NULL if n is 0; an output may be the same array as an input
 *   threads     a grid is constant after its creation: any number of threads may use one. Only creation allocates
 *
 * docs/guide/grids.md shows their use, docs/measured/accuracy.md and costs.md have bounds and times.
 */
#ifndef CUBEMAP_GRID_H
#define CUBEMAP_GRID_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/distortion.h>
#include <cubemap/ellipsoid.h>
#include <cubemap/export.h>
#include <cubemap/latitude.h>
#include <cubemap/mapping.h>
#include <cubemap/options.h>
#include <cubemap/orientation.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A grid, from cm_grid_create to cm_grid_destroy. */
typedef struct cm_grid cm_grid;

/* To be filled with zeros but for size, which is sizeof(cm_grid_options), and for what is wanted. All is
 * copied. */
typedef struct cm_grid_options
{
    size_t size;                   /* sizeof(cm_grid_options) */
    const char *mapping;           /* a specification; NULL: CM_MAPPING_RECOMMENDED */
    const cm_frame *frame;         /* NULL: geo */
    const cm_ellipsoid *ellipsoid; /* NULL: WGS84 */
    /* NULL: conformal for conformal mappings, authalic for all others */
    const cm_latitude *latitude;
    double tolerance;            /* of the latitude, radians, as in latitude.h; 0: full double */
    const cm_rotation *rotation; /* of the cube, orientation.h; NULL: none */
    const cm_options *options;   /* of the mapping, options.h; NULL: none */
} cm_grid_options;

/* options NULL means all standard: the recommended mapping on WGS84.
 * Errors: those of cm_mapping_create_with and of cm_latitude_conversion_create; CM_ERROR_ARGUMENT (grid NULL,
 * size), CM_ERROR_ORIENTATION; CM_ERROR_UNSUPPORTED for mappings between disc and square. */
CM_API cm_status cm_grid_create(const cm_grid_options *options, cm_grid **grid);

/* NULL is allowed. */
CM_API void cm_grid_destroy(cm_grid *grid);

/* What the grid was made from; pointers live as long as the grid. rotation is the identity if there was
 * none. */
CM_API const cm_mapping *cm_grid_mapping(const cm_grid *grid);
CM_API const cm_ellipsoid *cm_grid_ellipsoid(const cm_grid *grid);
CM_API cm_latitude cm_grid_latitude(const cm_grid *grid);
CM_API const cm_rotation *cm_grid_rotation(const cm_grid *grid);

/* One point; forward returns the face. A result may overwrite the argument. */
CM_API uint8_t cm_grid_forward_lonlat(const cm_grid *grid, double lon, double lat, double uv[2]);
CM_API void cm_grid_inverse_lonlat(const cm_grid *grid, uint8_t face, const double uv[2],
                                   double lonlat[2]);
CM_API uint8_t cm_grid_forward(const cm_grid *grid, const double normal[3], double uv[2]);
CM_API void cm_grid_inverse(const cm_grid *grid, uint8_t face, const double uv[2],
                            double normal[3]);

/* n points. */
CM_API void cm_grid_forward_lonlat_array(const cm_grid *grid, size_t n, const double *lon,
                                         const double *lat, uint8_t *face, double *u, double *v);
CM_API void cm_grid_inverse_lonlat_array(const cm_grid *grid, size_t n, const uint8_t *face,
                                         const double *u, const double *v, double *lon,
                                         double *lat);
CM_API void cm_grid_forward_array(const cm_grid *grid, size_t n, const double *x, const double *y,
                                  const double *z, uint8_t *face, double *u, double *v);
CM_API void cm_grid_inverse_array(const cm_grid *grid, size_t n, const uint8_t *face,
                                  const double *u, const double *v, double *x, double *y,
                                  double *z);

/* Without the mapping: normals to directions of the mapping's sphere (auxiliary latitude, rotated), which are what
 * cm_forward takes, and back. */
CM_API void cm_grid_to_sphere(const cm_grid *grid, const double normal[3], double direction[3]);
CM_API void cm_grid_from_sphere(const cm_grid *grid, const double direction[3], double normal[3]);
CM_API void cm_grid_to_sphere_array(const cm_grid *grid, size_t n, const double *x, const double *y,
                                    const double *z, double *to_x, double *to_y, double *to_z);
CM_API void cm_grid_from_sphere_array(const cm_grid *grid, size_t n, const double *x,
                                      const double *y, const double *z, double *to_x, double *to_y,
                                      double *to_z);

/* Square metres of the ellipsoid per du dv at a point of a face, for one point and for n; NaN where the inverse is,
 * and infinite, 0 or NaN where the mapping is singular (distortion.h). Its integral over all faces is the
 * ellipsoid's surface. */
CM_API double cm_grid_area_element(const cm_grid *grid, uint8_t face, const double uv[2]);
CM_API void cm_grid_area_element_array(const cm_grid *grid, size_t n, const uint8_t *face,
                                       const double *u, const double *v, double *area);

/* Tissot's indicatrix and the texel at the point of a normal and at a point of a face, as cm_forward_distortion and
 * cm_inverse_distortion (distortion.h), from the surface of the ellipsoid with equatorial radius 1 instead of
 * the unit sphere. (Dimitrijevic et al. 2020 have theirs so.) */
CM_API void cm_grid_forward_distortion(const cm_grid *grid, const double normal[3],
                                       cm_distortion *distortion);
CM_API void cm_grid_inverse_distortion(const cm_grid *grid, uint8_t face, const double uv[2],
                                       cm_distortion *distortion);

#ifdef __cplusplus
}
#endif

#endif
