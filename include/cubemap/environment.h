/* SPDX-License-Identifier: MIT
 *
 * Environments for renderers: spherical harmonics of the light around a point, irradiance, levels prefiltered by the
 * GGX distribution, and the table of the split sum. A part of the library cubemap-image.
 *
 *   faces       six square pictures of one size and type with 1 to 4 channels, linear light, by the numbers of the
 *               mapping's frame, the first row at v = first_row_v (frame.h). Any mapping to six faces
 *   coefficient of degree l and order m, -l <= m <= l, of channel c: coefficients[(l (l + 1) + m) channels + c]
 *   basis       real and orthonormal on the sphere, without the phase of Condon and Shortley: Y(1, 1) is
 *               sqrt(3 / (4 pi)) x, as Y(1, -1) is of y and Y(1, 0) of z. Orders m > 0 go with cos(m lon)
 *   roughness   perceptual, 0 to 1; the alpha of GGX is its square
 *   not finite  a pixel that is NaN or infinite spreads to all that it weighs in
 *   results     the same bits for any number of threads; outputs are untouched on failure
 *   threads     as in threads.h, 0 for all processors. An environment is constant after its creation
 *   example     cm_environment_create, then cm_environment_prefilter for each level: docs/guide/environments.md
 */
#ifndef CUBEMAP_ENVIRONMENT_H
#define CUBEMAP_ENVIRONMENT_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/image.h>
#include <cubemap/mapping.h>
#include <cubemap/orientation.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* No environment, and no set of coefficients, has more channels. */
#define CM_ENVIRONMENT_CHANNELS_MAX 4

/* No face is larger, in pixels. */
#define CM_ENVIRONMENT_SIZE_MAX 16384

/* ---- spherical harmonics ---- */

/* No degree is greater. */
#define CM_HARMONICS_DEGREE_MAX 2000

/* The coefficients of the degrees 0 to degree, one channel: (degree + 1)^2. */
CM_API size_t cm_harmonics_count(uint32_t degree);

/* The values of the basis in n directions of any length: value[i count + l (l + 1) + m] in direction i, where count is
 * cm_harmonics_count(degree). A direction that is zero or not finite gives NaN.
 * Errors: CM_ERROR_ARGUMENT (NULL where n > 0), CM_ERROR_RANGE (degree). */
CM_API cm_status cm_harmonics_basis(uint32_t degree, size_t n, const double *x, const double *y,
                                    const double *z, double *value);

/* The sum of coefficients times basis in n directions: value[i channels + c]. The like for what is no direction.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, channels). */
CM_API cm_status cm_harmonics_evaluate(uint32_t degree, uint32_t channels,
                                       const double *coefficients, size_t n, const double *x,
                                       const double *y, const double *z, double *value);

/* A factor for each degree, factor[0] to factor[degree].
 * The cosine lobe max(0, cos) as an operator: coefficients of radiance times these are those of irradiance, so that
 * radiance 1 gives irradiance pi (Ramamoorthi and Hanrahan 2001, eq. 8).
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree). */
CM_API cm_status cm_harmonics_cosine_lobe(uint32_t degree, double *factor);

/* The same for the lobe that cm_environment_prefilter has at a roughness from 0 to 1; radiance 1 stays 1.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, roughness). */
CM_API cm_status cm_harmonics_ggx_lobe(uint32_t degree, double roughness, double *factor);

/* What damps the higher degrees, so that the sum does not ring (Sloan 2008, "Windowing"). */
typedef enum cm_harmonics_window
{
    CM_WINDOW_NONE = 0,    /* 1 */
    CM_WINDOW_HANNING = 1, /* (1 + cos(pi l / width)) / 2 */
    CM_WINDOW_LANCZOS = 2  /* sin(pi l / width) / (pi l / width) */
} cm_harmonics_window;

/* The factors of a window, 0 from degree width on. width is any finite number above 0, degree + 1 say.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, width, window). */
CM_API cm_status cm_harmonics_window_factors(cm_harmonics_window window, double width,
                                             uint32_t degree, double *factor);

/* Multiply the coefficients of each degree by its factor.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, channels). */
CM_API cm_status cm_harmonics_scale(uint32_t degree, uint32_t channels, const double *factor,
                                    double *coefficients);

/* The coefficients of the function turned: its value in direction cm_rotate(rotation, d) is that of the given one in
 * d. to may be from.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, channels), CM_ERROR_ORIENTATION as cm_rotation_check,
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_harmonics_rotate(uint32_t degree, uint32_t channels,
                                     const cm_rotation *rotation, const double *from, double *to);

/* Coefficients as JSON text, ended by a zero byte: one object with the numbers "degree" and "channels", the texts
 * "index": "l(l+1)+m" and "basis": "real orthonormal without Condon-Shortley phase", and "coefficients", a list of
 * lists of channels numbers, which bring back the same doubles. *length is what the text has without its zero byte,
 * also when there is no room for it: so text may be NULL if size is 0.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, channels, a coefficient that is not finite), CM_ERROR_SPACE, which
 * sets *length. */
CM_API cm_status cm_harmonics_json(uint32_t degree, uint32_t channels, const double *coefficients,
                                   char *text, size_t size, size_t *length);

/* The sum in every pixel's centre, as faces of any mapping. to has as many channels as the coefficients.
 * Whole numbers are rounded and end at 0 and 1; NaN is 0 there.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree, channels, faces that are not as above), CM_ERROR_UNSUPPORTED (a
 * mapping that has not six faces). */
CM_API cm_status cm_harmonics_faces(uint32_t degree, uint32_t channels, const double *coefficients,
                                    const cm_mapping *mapping, unsigned threads,
                                    const cm_image to[6]);

/* ---- solid angles ---- */

/* The solid angles of the size times size pixels of a face, row by row, in steradians. All faces together have 4 pi.
 * From the spherical polygons of their outlines, so that it holds for every mapping; where outlines are great
 * circles, as those of univariate mappings are, but for rounding; single pixels are less exact where outlines bend
 * sharply, as around the middles of qsc's faces.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (face, size), CM_ERROR_UNSUPPORTED (a mapping that has not six faces),
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_texel_solid_angles(const cm_mapping *mapping, uint8_t face, uint32_t size,
                                       double *angle);

/* ---- environments ---- */

/* The light around a point with its pyramid of means, from cm_environment_create to cm_environment_destroy. */
typedef struct cm_environment cm_environment;

/* Faces are copied; the mapping must live as long as the environment. Each level of the pyramid has half the edge, down
 * to 1, and means weighted by solid angle. Takes 25 to 35 bytes a pixel. On success *environment is to be given to
 * cm_environment_destroy.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (faces that are not as above), CM_ERROR_UNSUPPORTED (a mapping that has not
 * six faces), CM_ERROR_MEMORY. */
CM_API cm_status cm_environment_create(const cm_mapping *mapping, const cm_image faces[6],
                                       unsigned threads, cm_environment **environment);

/* NULL is allowed. */
CM_API void cm_environment_destroy(cm_environment *environment);

/* The edge of a face in pixels, the channels, and the levels of the pyramid: level k has half the edge of level k -
 * 1, rounded up, and the last one has 1. */
CM_API uint32_t cm_environment_size(const cm_environment *environment);
CM_API uint32_t cm_environment_channels(const cm_environment *environment);
CM_API uint32_t cm_environment_level_count(const cm_environment *environment);

/* The coefficients up to a degree: the sum over all pixels of value, basis at the centre, and solid angle. It is
 * accurate as long as a pixel is small beside 180 degrees / degree.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (degree), CM_ERROR_MEMORY. */
CM_API cm_status cm_environment_project(const cm_environment *environment, uint32_t degree,
                                        unsigned threads, double *coefficients);

/* Irradiance in every pixel's centre, as faces of any mapping, from every pixel of the environment; it takes a time of
 * pixels times pixels. The fast way is cm_environment_project, cm_harmonics_cosine_lobe, cm_harmonics_scale and
 * cm_harmonics_faces. Types and errors as in cm_environment_prefilter. */
CM_API cm_status cm_environment_irradiance(const cm_environment *environment,
                                           const cm_mapping *mapping, unsigned threads,
                                           const cm_image to[6]);

/* How the mean over the lobe is taken. */
typedef enum cm_prefilter_method
{
    /* cells where the lobe is wide enough for the environment's pixels, else a spiral */
    CM_PREFILTER_AUTO = 0,
    /* pixels of all levels, weighted by the lobe in their centres and by solid angle: the coarser, the further they are
       from the lobe's middle. Sizes that are powers of 2 have the most levels for it */
    CM_PREFILTER_CELLS = 1,
    /* directions of equal weight on a golden spiral through the lobe, filtered */
    CM_PREFILTER_SPIRAL = 2,
    /* GGX normals at Hammersley's points, filtered (Karis 2013; Krivanek and Colbert 2008) */
    CM_PREFILTER_HAMMERSLEY = 3,
    /* the same, each the value in its direction */
    CM_PREFILTER_UNFILTERED = 4,
    /* every pixel of a level, weighted by the lobe in its centre and by its solid angle */
    CM_PREFILTER_ALL = 5
} cm_prefilter_method;

/* To be filled with zeros but for size, and for what is wanted. */
typedef struct cm_prefilter_options
{
    size_t size;                /* sizeof(cm_prefilter_options) */
    cm_prefilter_method method; /* of the mean */
    double
        coarseness; /* of cells: their edge over the distance in which the lobe changes, 1e-3 to 10; 0 for 0.15 */
    uint32_t samples; /* in the lobe, 1 to 65536; 0 for 256 */
    double blur;      /* of filtered samples: levels above the method's own choice, -16 to 16 */
    uint32_t level;   /* CM_PREFILTER_ALL: of the pyramid, 0 is the finest */
    uint32_t
        subdivision;  /* CM_PREFILTER_ALL: each pixel as n x n, interpolated; 1 to 16, 0 for 1 */
    unsigned threads; /* 0 for all processors */
} cm_prefilter_options;

/* A level for one roughness: in every pixel's centre n the mean of the environment over directions l, weighted by
 * D(h) max(0, n l), where h is half way between n and l, and D the distribution of GGX (Walter et al. 2007): the view
 * and the mirrored direction are taken as n (Karis 2013). Filtered samples are as large as their share of the lobe,
 * by the solid angles of the environment's mapping. At roughness 0 it is the environment, as large as the target's
 * pixel. options may be NULL. mapping, that of the target, need not be the environment's. to has as many channels as
 * the environment. Whole numbers are rounded and end at 0 and 1; NaN is 0 there.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (roughness, an option, faces that are not as above), CM_ERROR_UNSUPPORTED
 * (a mapping that has not six faces), CM_ERROR_MEMORY. */
CM_API cm_status cm_environment_prefilter(const cm_environment *environment, double roughness,
                                          const cm_prefilter_options *options,
                                          const cm_mapping *mapping, const cm_image to[6]);

/* ---- the other half of the split sum ---- */

/* How microfacets hide each other, after Smith. */
typedef enum cm_brdf_shadowing
{
    CM_BRDF_CORRELATED = 0, /* of both directions, by height (Heitz 2014, eq. 99) */
    CM_BRDF_SCHLICK = 1 /* the product of two of Schlick's terms with k = alpha / 2 (Karis 2013) */
} cm_brdf_shadowing;

/* The integral of the GGX reflection over all light is F0 scale + bias, by Schlick's Fresnel term with F0 at the normal
 * (Karis 2013). cosine is that of view and normal. */
typedef struct cm_brdf_terms
{
    double scale; /* of F0 */
    double bias;  /* beside it; scale + bias is what a surface with F0 = 1 reflects */
} cm_brdf_terms;

/* For a cosine and a roughness, both from 0 to 1, by Gauss-Legendre quadrature. At 0 each is the limit; where both
 * are, that of roughness.
 * Errors: CM_ERROR_ARGUMENT (NULL), CM_ERROR_RANGE (cosine, roughness, shadowing). */
CM_API cm_status cm_brdf_integrate(cm_brdf_shadowing shadowing, double cosine, double roughness,
                                   cm_brdf_terms *terms);

/* The table: column i is cosine (i + 0.5) / width, row j roughness (j + 0.5) / height. to has 2 channels, scale and
 * bias, or 3: then the third is 1 - scale - bias, the energy that single reflections lose at F0 = 1. Whole numbers
 * are rounded.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (shadowing, a picture with other channels or of no type). */
CM_API cm_status cm_brdf_table(cm_brdf_shadowing shadowing, unsigned threads, const cm_image *to);

/* What comes back after several reflections between the facets, as a factor of irradiance / pi, for F0 from 0 to 1
 * (Fdez-Aguera 2019, with the mean Fresnel term F0 + (1 - F0) / 21). At F0 = 1 it is all that the terms lack. NaN for
 * NULL. */
CM_API double cm_brdf_multiple(const cm_brdf_terms *terms, double f0);

#ifdef __cplusplus
}
#endif

#endif
