/* SPDX-License-Identifier: MIT
 *
 * The light of all cells of a sensor, and how it is found with as few samples as a scene needs.
 */
#ifndef CUBEMAP_SIM_TOF_PICTURE_H
#define CUBEMAP_SIM_TOF_PICTURE_H

#include "shade.h"

/* Sums over cells' samples of weight times light; waves x cells where there are several. */
typedef struct tof_sums
{
    double *total;
    double *ambient;
    double *real;
    double *imaginary;
    double *direct_real;
    double *direct_imaginary;
} tof_sums;

/* What the middle of each cell sees. */
typedef struct tof_picture
{
    size_t cells;
    size_t waves; /* most that there is room for */
    tof_sums sum;
    tof_sums centre; /* of the middles alone; where samples are several */
    uint32_t *id;
    double *range;
    float *normal[3];
    uint64_t *shadows;
    uint8_t *needs_samples; /* and then: cells that do not */
    uint8_t *smooth;
    uint8_t *flags; /* CM_TOF_FLYING, CM_TOF_MOTION */
    int watches;    /* 1: for motion */
    uint64_t rays;
    uint64_t oversampled;
} tof_picture;

/* Bytes; 0: more than there can be. */
size_t picture_size(const tof_sensor *sensor, const cm_tof_options *options);

/* In memory of that size, for doubles; sums are 0. */
void picture_create(const tof_sensor *sensor, const cm_tof_options *options, cm_pool *pool,
                    void *memory, tof_picture *picture);

/* Sums become 0: those of direct light only where scattered light comes beside it. */
void picture_clear(tof_picture *picture, const cm_tof_options *options, cm_pool *pool);

/* Adds part times the light of a time to the sums. Flags of motion are set where the middles see something else than
 * before; is_first: there is no before. */
cm_status picture_add(const tof_scenery *scenery, double part, int is_first, cm_pool *pool,
                      tof_picture *picture);

/* Marks cells that outlines and edges of what is in front of the camera cross, or come near (edge_marks.c).
 * CM_OK; CM_ERROR_MEMORY. */
cm_status mark_edges(const tof_scenery *scenery, cm_pool *pool, uint8_t *mark);

/* Adds the bits of lamps whose cones do not reach what was met to those of shadows: their rims are edges, too. */
void find_outside_cones(const tof_scenery *scenery, size_t n, tof_light_block *light);

#endif
