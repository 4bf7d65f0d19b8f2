/* SPDX-License-Identifier: MIT
 *
 * Planes of floats in memory of their own, each with a border of what the sphere has beyond its edges.
 */
#ifndef MODULES_IMAGE_PADDED_H
#define MODULES_IMAGE_PADDED_H

#include "level_object.h"

#include <cubemap/mips.h>

/* The channels of a pixel are one beside the other, or each row has them one after the other. */
typedef enum cm_padded_order
{
    CM_PADDED_PIXELS,
    CM_PADDED_CHANNELS
} cm_padded_order;

/* What a value of 1 is in planes of whole numbers, which have values between -2 and 2. */
#define CM_PADDED_ONE 16384.0f

/* Strides are in numbers. Behind each row there are CM_WINDOW_SLACK bytes of zeros at least. */
typedef struct cm_padded
{
    uint32_t planes;
    uint32_t width;
    uint32_t height;
    uint32_t channels;
    int32_t beside; /* columns beyond the left and the right edge */
    int32_t beyond; /* rows beyond the upper and the lower one */
    ptrdiff_t pixel;
    ptrdiff_t channel;
    ptrdiff_t row;
    size_t plane_floats;
    int is_whole;           /* are numbers int16_t, CM_PADDED_ONE for 1? */
    int goes_on;            /* may values be continued where nothing is, as level_rim.h has it? */
    const cm_memory *owner; /* of memory; NULL: the system */
    float *memory;
    float
        *first[CM_PLANES_MAX]; /* the pixel (0, 0) of each plane; NULL if they are whole numbers */
    int16_t *whole[CM_PLANES_MAX];
} cm_padded;

/* Sizes and strides for the surface's planes in that size, without memory. `beside` and `beyond` are what is wanted:
 * smaller planes have less of what cannot be known, see cm_padded_border. */
void cm_padded_shape(const cm_surface *surface, uint32_t width, uint32_t height, uint32_t channels,
                     int32_t beside, int32_t beyond, cm_padded_order order, cm_padded *shape);

/* Room for a shape's planes, as floats or whole numbers, of `memory` or, if that is NULL, the system, with zeros behind
 * rows. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_padded_allocate(int is_whole, const cm_memory *memory, unsigned threads,
                             cm_padded *shape);

/* Both for floats. */
cm_status cm_padded_create(const cm_surface *surface, uint32_t width, uint32_t height,
                           uint32_t channels, int32_t beside, int32_t beyond, cm_padded_order order,
                           const cm_memory *memory, unsigned threads, cm_padded *padded);

/* Leaves the shape alone. */
void cm_padded_release(cm_padded *padded);

void cm_padded_free(cm_padded *padded);

/* What a plane with that extent can have of a border so wide. */
int32_t cm_border_of(const cm_surface *surface, uint32_t extent, int32_t wanted);

/* The pixels of pictures of the surface, if the planes have its size, and then the border. *has_more, which may be NULL:
 * are there numbers among the pictures' own that are larger than `most`, or none? CM_OK or CM_ERROR_MEMORY. */
cm_status cm_padded_load(cm_padded *padded, const cm_surface *surface, const cm_image *pictures,
                         const cm_values *values, const cm_sample_set *set, unsigned threads,
                         float most, int *has_more);

/* The border from the planes' own pixels, of whatever size, interpolated inside the neighbour by six points each way. Directions there are
 * the kind's own or extrapolated (surface_beyond.c), so that a plane of faces has borders of half its extent at most, and
 * never less than CM_BORDER_LEAST. */
void cm_padded_border(const cm_padded *padded, const cm_surface *surface, const cm_filter_set *set,
                      unsigned threads);

/* What filters need at least: taps have 3, the halving of levels 6. */
#define CM_BORDER_LEAST 6

/* Pixels beside a map with gaps that have what the sphere has there: as far as a spline's coefficients see it. */
#define CM_BESIDE_MAP 20

/* Elements of cm_run_threads for a task: its chunks begin at multiples of it (threads.h). */
#define CM_TASK 64

#endif
