/* SPDX-License-Identifier: MIT
 *
 * What a source is inside.
 */
#ifndef MODULES_IMAGE_SOURCE_H
#define MODULES_IMAGE_SOURCE_H

#include "ewa.h"
#include "place_set.h"
#include "resample_plan.h"

#include <stdatomic.h>

struct cm_source
{
    cm_filter_table
        table;    /* begins where a line of memory does, so that no row of it lies in two */
    void *memory; /* in which the source lies */
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
    cm_level level;
    cm_ewa ewa;                       /* of CM_FILTER_EWA */
    cm_padded coefficients;           /* of CM_FILTER_BSPLINE5, which level looks at */
    cm_image pictures[CM_PLANES_MAX]; /* what they are made of when they are needed */
    atomic_int state;                 /* cm_source_state */
};

/* Large coefficients are made when a part of a target is asked for: all of it does not need them at once. */
typedef enum cm_source_state
{
    CM_SOURCE_READY,
    CM_SOURCE_LATER,
    CM_SOURCE_BUSY /* some thread makes them */
} cm_source_state;

/* A source that is not ready becomes so. CM_OK or CM_ERROR_MEMORY, after which it may be tried again. */
cm_status cm_source_complete(const cm_source *source, unsigned threads);

/* Do the pictures suit the surface, and one another? CM_OK, CM_ERROR_ARGUMENT or CM_ERROR_RANGE. */
cm_status cm_pictures_check(const cm_surface *surface, const cm_image *pictures);

/* The rows of its plane that a group may touch, from *first to before *end. The group is filled up to a multiple of 16. */
void cm_source_rows(const cm_source *source, cm_group *group, int32_t *first, int32_t *end);

/* Asks for what a group needs, while the block before it is done. */
void cm_source_fetch(const cm_source *source, const cm_group *group);

/* The values of a group, as the level has them: `to` has room for a multiple of 16 pixels. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_source_sample(const cm_source *source, cm_group *group, cm_scratch *scratch,
                           unsigned char *to);

/* What a plan makes of pixels that are stored like this. */
cm_values cm_values_of(const cm_plan *plan, const cm_image *picture);

#endif
