/* SPDX-License-Identifier: MIT
 *
 * Pieces of a level as floats, on which footprints are laid.
 */
#ifndef MODULES_IMAGE_EWA_WINDOW_H
#define MODULES_IMAGE_EWA_WINDOW_H

#include "ewa_object.h"

/* A level of a plane, and the pixel of it that places are from. */
typedef struct cm_ewa_level
{
    const cm_ewa *ewa;
    unsigned level;
    unsigned plane;
    int32_t column;
    int32_t row;
} cm_ewa_level;

/* The first and the last column and row, from that pixel. */
typedef struct cm_ewa_box
{
    int32_t left;
    int32_t right;
    int32_t top;
    int32_t bottom;
} cm_ewa_box;

/* The box's pixels as floats, channel by channel, in the scratch. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_ewa_window(const cm_ewa_level *at, const cm_ewa_box *box, cm_scratch *scratch,
                        cm_ewa_pixels *pixels);

/* Asks for what a group needs, while the block before it is done. */
void cm_ewa_fetch(const cm_ewa *ewa, const cm_group *group);

#endif
