/* SPDX-License-Identifier: MIT
 *
 * What CAM16 makes of its viewing conditions.
 */
#ifndef COLORMAP_CAM16_H
#define COLORMAP_CAM16_H

#include <cubemap/colormap.h>

typedef struct cm_cam16_conditions
{
    double gain[3];    /* D_R, D_G, D_B: adaptation to the white */
    double level;      /* F_L */
    double exponent;   /* c z */
    double brightness; /* N_bb, and N_cb, which is the same */
    double chroma;     /* (1.64 - 0.29^n)^0.73 */
    double of_white;   /* A_w */
} cm_cam16_conditions;

void cm_cam16_prepare(const cm_colormap_viewing *viewing, cm_cam16_conditions *conditions);

/* The viewing conditions of sRGB. */
void cm_cam16_prepare_srgb(cm_cam16_conditions *conditions);

/* As cm_colormap_linear_from_ucs, with conditions that are at hand; a colour that no light has may have numbers among
 * its NaN. */
void cm_cam16_linear_from_ucs(const cm_cam16_conditions *conditions, const double ucs[3],
                              double linear[3]);

#endif
