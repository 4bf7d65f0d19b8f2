/* SPDX-License-Identifier: MIT
 *
 * What comes through places of the picture: rays, what they meet, and the light of that.
 */
#ifndef CUBEMAP_SIM_SHADE_H
#define CUBEMAP_SIM_SHADE_H

#include "lamp.h"
#include "sensor.h"
#include "tof_world.h"

#define SHADE_LAMPS 64

/* Everything that a picture at one time needs. */
typedef struct tof_scenery
{
    const tof_instant *instant;
    const tof_set *set;
    const tof_sensor *sensor;
    const cm_tof_options *options;
    cm_pose camera;
    tof_lamp lamp[SHADE_LAMPS];
    size_t lamps;
    const tof_virtual_lights *virtual_lights; /* NULL: none */
    const tof_sky *sky;                       /* NULL: no environment */
    tof_waves waves;                          /* of this picture */
} tof_scenery;

/* What came through each place, before the lens; room for TOF_BLOCK each. */
typedef struct tof_light_block
{
    tof_block rays; /* in the world, of one origin, and what they met; infinitely far: nothing */
    double total[TOF_BLOCK];
    double real[SENSOR_WAVES][TOF_BLOCK];
    double imaginary[SENSOR_WAVES][TOF_BLOCK];
    double ambient[TOF_BLOCK];     /* if there are surroundings */
    double direct_real[TOF_BLOCK]; /* of the first wave, without scattered light; if there is any */
    double direct_imaginary[TOF_BLOCK];
    double lens
        [TOF_BLOCK]; /* lets so much pass: cos^4 of the angle from the optical axis; 1 without one */
    uint32_t id[TOF_BLOCK];
    uint64_t shadows[TOF_BLOCK]; /* bits of lamps that do not shine there */
} tof_light_block;

/* n places, up to TOF_BLOCK; number are numbers for random ones. */
cm_status tof_shade(const tof_scenery *scenery, size_t n, const double *column, const double *row,
                    const uint32_t *number, tof_light_block *light);

#endif
