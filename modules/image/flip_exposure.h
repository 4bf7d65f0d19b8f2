/* SPDX-License-Identifier: MIT
 *
 * The exposures of HDR-FLIP: P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moller, "Visualizing errors in rendered
 * high dynamic range images", Eurographics Short Papers 2021, section 3.
 */
#ifndef IMAGE_FLIP_EXPOSURE_H
#define IMAGE_FLIP_EXPOSURE_H

#include "compare_pixels.h"

typedef struct cm_flip_exposures
{
    double start; /* in powers of two */
    double stop;
    uint32_t count; /* 1 or more */
} cm_flip_exposures;

/* Those of the options, or by the luminances of the reference's pixels that count and are finite. */
cm_status cm_flip_find_exposures(const cm_compare_pair *pair, const cm_compare_options *options,
                                 cm_flip_exposures *exposures);

/* What light is multiplied by in exposure index below count. */
double cm_flip_exposure_at(const cm_flip_exposures *exposures, uint32_t index);

#endif
