/* SPDX-License-Identifier: MIT
 *
 * A mapping, as its loops read it.
 */
#ifndef LIBCUBEMAP_BATCH_MAPPING_OBJECT_H
#define LIBCUBEMAP_BATCH_MAPPING_OBJECT_H

#include <cubemap/mapping.h>
#include <cubemap/options.h>

#include "batch_set.h"
#include "turn.h"

struct cm_mapping
{
    const cm_mapping_info *info;
    size_t index; /* in the catalogue */
    double parameter[CM_PARAMETERS_MAX];
    size_t azimuthal; /* in the catalogue: the parts of a map that is made of parts */
    size_t square;
    double area_scale; /* 6 / pi over the area of the map per area of what it shows of the sphere */
    int is_folded;     /* both hemispheres go to the disc */
    int is_turned;     /* the centre is not the north pole in longitude 0 */
    double axes_f64
        [9]; /* then the axes about the centre, by rows: south, east and outwards at a north pole */
    float axes_f32[9];
    cm_frame frame;
    cm_turn turn;
    cm_constants_f64 constants_f64;
    cm_constants_f32 constants_f32;
    cm_tier tier;
    const cm_batch_set *set;
    cm_batch_f64 batch_f64;
    cm_batch_f32 batch_f32;
    size_t lanes_f64; /* what batch_f64 takes whole multiples of */
    size_t lanes_f32;
    /* One point alone, and what takes those that it does not. */
    cm_lone_f64 lone_f64, otherwise_f64;
    cm_lone_f32 lone_f32, otherwise_f32;
    unsigned last_face;
};

/* Is it computed by part_loops.inc? */
static inline int cm_mapping_has_parts(const cm_mapping *mapping)
{
    return mapping->info->kind == CM_KIND_DISC_SQUARE || mapping->info->kind == CM_KIND_AZIMUTHAL ||
           mapping->info->parts != NULL;
}

#endif
