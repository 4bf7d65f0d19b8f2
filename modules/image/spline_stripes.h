/* SPDX-License-Identifier: MIT
 *
 * The coefficients of spline.h, stripe by stripe: some rows of one plane at a time, from its lower edge upwards, with the
 * bits that they have when all are kept.
 *   forth    a walk down the plane first, which keeps what the recursions have reached at the beginning of each stripe
 *   back     then stripes upwards: rows are made once more, forth from what was kept, and back from the stripe below
 *   window   the stripe's rows, and some of those below, which footprints that begin in the stripe reach
 * Numbers that no spline goes through have to be filled from all sides (spline_holes.h): that there are such is told.
 */
#ifndef MODULES_IMAGE_SPLINE_STRIPES_H
#define MODULES_IMAGE_SPLINE_STRIPES_H

#include "border_values.h"
#include "spline.h"

typedef struct cm_spline_stripes cm_spline_stripes;

/* What all coefficients of the surface's pictures take at once, in bytes. */
size_t cm_spline_bytes(const cm_surface *surface, const cm_values *values);

/* Can it be done? Planes must go on everywhere, by copies of their pixels or on a cube's other faces. */
int cm_spline_stripes_suit(const cm_surface *surface);

/* below: rows below a stripe that are needed with it. The stripes are as high as `bytes` allow, for all memory.
 * CM_OK or CM_ERROR_MEMORY; cm_spline_stripes_destroy frees what there is. */
cm_status cm_spline_stripes_create(const cm_surface *surface, const cm_image *pictures,
                                   const cm_values *values, const cm_sample_set *set, int32_t below,
                                   size_t bytes, unsigned threads, cm_spline_stripes **stripes);
void cm_spline_stripes_destroy(cm_spline_stripes *stripes);

/* The memory that cm_spline_stripes_create would take, in bytes. */
size_t cm_spline_stripes_bytes(const cm_surface *surface, const cm_values *values, int32_t below,
                               size_t bytes);

/* Would it make one stripe of a plane? */
int cm_spline_stripes_are_one(const cm_surface *surface, const cm_values *values, int32_t below,
                              size_t bytes);

/* Of a plane, and in which of them a row is. */
unsigned cm_spline_stripes_count(const cm_spline_stripes *stripes);
unsigned cm_spline_stripes_of(const cm_spline_stripes *stripes, int32_t row);

/* A plane is begun; the stripe above the one before is made, first of all the last one. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_spline_stripes_begin(cm_spline_stripes *stripes, unsigned plane, unsigned threads);
cm_status cm_spline_stripes_next(cm_spline_stripes *stripes, unsigned threads);

/* Were there numbers that no spline goes through, by now? Then coefficients are not right. */
int cm_spline_stripes_have_holes(const cm_spline_stripes *stripes);

/* Its plane that is under way has the rows of the window. */
const cm_level *cm_spline_stripes_level(const cm_spline_stripes *stripes);

#endif
