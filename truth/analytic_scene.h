/* SPDX-License-Identifier: MIT
 *
 * Scenes on the sphere that formulas give, in three channels: what a picture is made from, and what the pictures that
 * come of it are compared with. There are two, and their values are in [SCENE_LOWEST, SCENE_HIGHEST]:
 *
 *   waves   a sum of plane waves cos(k . d + phase) in the unit direction d. Along a great circle the harmonics of each
 *           are Bessel functions (Jacobi and Anger), which vanish beyond |k|: no period is shorter than 2 pi / |k|
 *   plate   a zone plate: rings around an axis, at the angle t from it with f + g t cycles a radian
 */
#ifndef TRUTH_ANALYTIC_SCENE_H
#define TRUTH_ANALYTIC_SCENE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SCENE_LOWEST 0.02
#define SCENE_HIGHEST 0.98
#define SCENE_MEAN 0.5
#define SCENE_AMPLITUDE 0.48

enum
{
    SCENE_WAVES = 16,
    SCENE_CHANNELS = 3
};

/* One plane wave: its phase grows by k . d turns, and each channel has so much of its cosine and of its sine. */
typedef struct scene_wave
{
    double k[3];
    double cosine[SCENE_CHANNELS];
    double sine[SCENE_CHANNELS];
} scene_wave;

typedef struct analytic_scene
{
    int is_plate;
    scene_wave wave[SCENE_WAVES];
    double axis[3];   /* of the plate, a unit vector */
    double frequency; /* of the plate on its axis, cycles a radian */
    double growth;    /* of the frequency, cycles a radian each radian */
} analytic_scene;

/* Waves of equal amplitude, in random directions, each period longer than the one before by the same factor: from
 * shortest, in radians of a great circle, to 16 times that. The same seed makes the same scene; 0 is taken as 1. */
analytic_scene scene_waves(double shortest, unsigned seed);

/* A zone plate around an axis of any length; the frequency on the axis in cycles a radian, and its growth. */
analytic_scene scene_zone_plate(const double axis[3], double frequency, double growth);

/* The values in n unit directions, SCENE_CHANNELS for each, one beside the other. */
void scene_values(const analytic_scene *scene, size_t n, const double *x, const double *y,
                  const double *z, double *values);

/* How far the rings of a plate have come in a direction, in cycles, and the angle from its axis. */
double scene_cycles(const analytic_scene *scene, const double direction[3], double *angle);

#ifdef __cplusplus
}
#endif

#endif
