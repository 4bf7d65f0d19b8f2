/* SPDX-License-Identifier: MIT
 *
 * BRDFs: what part of the light from one direction a surface scatters to another. Of the library cubemap-sim.
 *
 *   unit      per steradian, of one wavelength: that of the camera's light
 *   angles    from the surface's normal, on the side where both directions are; elsewhere a BRDF is 0
 *   scale     the reflectance of a primitive's material multiplies its BRDF
 *   threads   a BRDF is constant after its creation
 */
#ifndef CUBEMAP_BRDF_H
#define CUBEMAP_BRDF_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>
#include <cubemap/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Lambert's: 1 / pi. CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_MEMORY. */
CM_API cm_status cm_brdf_create_lambert(cm_brdf **brdf);

/* Cook and Torrance's (1982), with Beckmann's distribution of facets, their masking by V-grooves, and Fresnel's
 * reflection from eta + i absorption. To be filled with zeros but for size and what is wanted. */
typedef struct cm_cook_torrance
{
    size_t size;       /* sizeof(cm_cook_torrance) */
    double diffuse;    /* 0..1: the part that Lambert's law scatters */
    double specular;   /* 0..1: the part of facets; both together are at most 1 */
    double roughness;  /* root mean square of the facets' slope, 0.01..1 */
    double eta;        /* index of refraction, above 0; aluminium in near infrared: 2.8 */
    double absorption; /* its imaginary part, 0 or more; aluminium there: 8.45 */
} cm_cook_torrance;

/* CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_brdf_create_cook_torrance(const cm_cook_torrance *options, cm_brdf **brdf);

/* One measured value. */
typedef struct cm_brdf_sample
{
    double theta_in;  /* radians, of the light's direction */
    double theta_out; /* radians, of the detector's */
    double azimuth;   /* radians, between both around the normal */
    double value;     /* per steradian, 0 or more */
} cm_brdf_sample;

/* What a gonioreflectometer's angles mean (Bulczak, Lambers and Kolb 2018, eq. 15): alpha turns the sample, beta the
 * detector, gamma raises the normal; radians. */
CM_API void cm_brdf_goniometer(double alpha, double beta, double gamma, cm_brdf_sample *sample);

/* A table of n isotropic measurements in any order; each holds for light that goes the other way, too. Between them, and in
 * their gaps (beside the light's direction, at grazing angles), values are means weighted by the inverse of the angles'
 * distance to the power 5 (2018, eqs. 16 and 17), of those up to twice as far as the nearest one, tabulated once. What
 * measurements say of energy is not mended: they may scatter more than all light.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, n 0); CM_ERROR_RANGE (a sample that is not finite, beyond a right angle, or below 0);
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_brdf_create_measured(size_t n, const cm_brdf_sample *sample, cm_brdf **brdf);

/* NULL is allowed. */
CM_API void cm_brdf_destroy(cm_brdf *brdf);

/* Per steradian, for directions of length 1 away from the surface; NULL is Lambert's. */
CM_API double cm_brdf_value(const cm_brdf *brdf, const double normal[3], const double in[3],
                            const double out[3]);

/* The part of light from one direction that is scattered to all, of an angle from 0 to a right one; 0 of others. */
CM_API double cm_brdf_albedo(const cm_brdf *brdf, double theta_in);

/* A direction to continue a path in, of a density near brdf times cosine, and that density per steradian. Two of u are
 * for the direction, the third one chooses a lobe, all in [0, 1). Returns brdf times cosine by density; 0 where the path ends. */
CM_API double cm_brdf_sample_direction(const cm_brdf *brdf, const double normal[3],
                                       const double out[3], const double u[3], double in[3],
                                       double *density);

/* The density of such a direction, per steradian. */
CM_API double cm_brdf_density(const cm_brdf *brdf, const double normal[3], const double in[3],
                              const double out[3]);

#ifdef __cplusplus
}
#endif

#endif
