/* SPDX-License-Identifier: MIT
 *
 * What a source is inside.
 */
#ifndef MODULES_IMAGE_SOURCE_H
#define MODULES_IMAGE_SOURCE_H

#include "ewa.h"
#include "place_set.h"
#include "resample_plan.h"

struct cm_source
{
    const cm_plan *plan;
    cm_filter filter; /* never CM_FILTER_AUTO */
    cm_pixel_type target_type;
    cm_values values; /* as they are stored in the source */
    const cm_sample_set *set;
    const cm_place_set *places;
    cm_sampler *sampler;
    cm_places_finder *find_places; /* of `apart`; NULL if there is none */
    cm_apart_sampler *apart;       /* the same as sampler, into rows */
    int32_t taps;                  /* in a row: 1, 2, 4 or 6 */
    cm_filter_table table;
    cm_level level;
    cm_ewa ewa;             /* of CM_FILTER_EWA */
    cm_padded coefficients; /* of CM_FILTER_BSPLINE5, which level looks at */
};

/* Do the pictures suit the surface, and one another? CM_OK, CM_ERROR_ARGUMENT or CM_ERROR_RANGE. */
cm_status cm_pictures_check(const cm_surface *surface, const cm_image *pictures);

/* The values of a group, as the level has them: `to` has room for a multiple of 16 pixels. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_source_sample(const cm_source *source, cm_group *group, cm_scratch *scratch,
                           unsigned char *to);

/* What a plan makes of pixels that are stored like this. */
cm_values cm_values_of(const cm_plan *plan, const cm_image *picture);

#endif
