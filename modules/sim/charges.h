/* SPDX-License-Identifier: MIT
 *
 * From the light of cells to the electrons of readout circuits.
 */
#ifndef CUBEMAP_SIM_CHARGES_H
#define CUBEMAP_SIM_CHARGES_H

#include "tof_picture.h"

/* Electrons of both circuits of every pixel in so many phase images from a phase on, one after the other in charge_a and
 * charge_b, without noise and before anything is full. The picture's waves from picture_wave on are those of the series. offset
 * is the pixels' own phase, radians; NULL: 0. Returns whether there is a charge that no float holds. */
int charges_of_phases(const tof_set *set, const tof_sensor *sensor, const tof_picture *picture,
                      size_t picture_wave, int series, int phase, int count, const float *offset,
                      cm_pool *pool, float *charge_a, float *charge_b);

/* Shot and read noise of one phase image: by numbers of seed, view, pixel and the number of the image. */
void charges_add_noise(const tof_sensor *sensor, const cm_tof_options *options, int image,
                       cm_pool *pool, float *charge_a, float *charge_b);

/* What is more than the full well, or than a float holds, is cut, and flagged. */
void charges_fill(const tof_sensor *sensor, cm_pool *pool, float *charge, uint8_t *flags);

/* The pixels' own phase offsets. */
void charges_offsets(const tof_sensor *sensor, const cm_tof_options *options, cm_pool *pool,
                     float *offset);

#endif
