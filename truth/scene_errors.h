/* SPDX-License-Identifier: MIT
 *
 * How far pictures are from the scene that they show: signal to noise by regions, the worst error and where it is, and
 * what is left of a zone plate.
 */
#ifndef TRUTH_SCENE_ERRORS_H
#define TRUTH_SCENE_ERRORS_H

#include "analytic_scene.h"
#include "scene_surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a channel of a pixel is; 255, or 65535, is 1. */
typedef enum scene_type
{
    SCENE_U8,
    SCENE_U16,
    SCENE_FLOAT
} scene_type;

/* The pictures of a surface, of SCENE_CHANNELS channels one beside the other. */
typedef struct scene_pictures
{
    scene_type type;
    size_t row_bytes;   /* from a pixel to the one below it; 0: rows are dense */
    void *const *plane; /* the first pixel of each plane */
} scene_pictures;

/* Fill the pictures with the scene at the centres of pixels, whole numbers rounded; 0 where the surface shows nothing.
 * 0 if there is no memory, else 1. */
int scene_fill(const analytic_scene *scene, const scene_surface *surface,
               const scene_pictures *pictures);

/* Of one region. */
typedef struct scene_error
{
    size_t count;      /* values that were compared, three a pixel */
    size_t missing;    /* values that are NaN; they count nowhere else */
    double square_sum; /* of the errors */
    double worst;      /* the largest error's magnitude, and where it is */
    size_t plane;
    size_t row;
    size_t column;
    size_t channel;
} scene_error;

typedef struct scene_errors
{
    scene_error region[SCENE_REGIONS];
} scene_errors;

/* Compare pictures with the scene. 0 if there is no memory, else 1. */
int scene_measure(const analytic_scene *scene, const scene_surface *surface,
                  const scene_pictures *pictures, scene_errors *errors);

/* The peak signal to noise ratio in dB, of the peak 1; infinite if there is no error, NaN if nothing was compared. */
double scene_decibels(const scene_error *error);

/* What pictures have of a zone plate, over the pixels where the rings go by from low to high cycles a pixel. Cycles are
 * counted along the gradient, pixels along their rows and columns; pixels of the first four rings of pixels around the
 * axis are left out. */
typedef struct scene_response
{
    size_t count; /* pixels */
    double
        deviation; /* the root mean square of values less SCENE_MEAN, in units of the plate's amplitude */
    double gain; /* how much of the plate's rings is there: 1 is all, 0 none */
} scene_response;

/* 0 if there is no memory, else 1. The scene must be a plate. */
int scene_measure_plate(const analytic_scene *scene, const scene_surface *surface,
                        const scene_pictures *pictures, double low, double high,
                        scene_response *response);

#ifdef __cplusplus
}
#endif

#endif
