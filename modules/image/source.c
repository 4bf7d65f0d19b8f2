/* SPDX-License-Identifier: MIT
 *
 * A source made ready for a filter.
 */
#include "source.h"
#include "auto.h"
#include "past_caches.h"
#include "spline_stripes.h"
#include "wait_a_while.h"

#include <stdlib.h>
#include <string.h>

cm_status cm_pictures_check(const cm_surface *surface, const cm_image *pictures)
{
    for (uint32_t i = 0; i < surface->pictures; i++)
    {
        const cm_image *picture = &pictures[i];
        if (picture->size != sizeof *picture || picture->data == NULL ||
            cm_pixel_size(picture->type) == 0 || picture->channels == 0 ||
            picture->channels > CM_CHANNELS_MAX)
        {
            return CM_ERROR_ARGUMENT;
        }
        if (picture->width != surface->picture_width ||
            picture->height != surface->picture_height || picture->type != pictures->type ||
            picture->channels != pictures->channels)
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

size_t cm_pixel_size(cm_pixel_type type)
{
    switch (type)
    {
    case CM_PIXEL_U8:
        return 1;
    case CM_PIXEL_U16:
    case CM_PIXEL_HALF:
        return 2;
    case CM_PIXEL_FLOAT:
        return 4;
    }
    return 0;
}

cm_values cm_values_of(const cm_plan *plan, const cm_image *picture)
{
    const cm_plan_options *options = &plan->options;
    const int can_skip = options->not_finite == CM_NOT_FINITE_SKIP &&
                         (picture->type == CM_PIXEL_HALF || picture->type == CM_PIXEL_FLOAT);
    cm_values values = {.type = picture->type,
                        .channels = picture->channels,
                        .working = picture->channels + (can_skip ? 1 : 0),
                        .transfer = options->transfer,
                        .gamma = options->gamma,
                        .alpha = options->alpha,
                        .alpha_multiplied = options->alpha_multiplied,
                        .vector = options->vector,
                        .not_finite = options->not_finite,
                        .dither = options->dither};
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            values.turn[i][j] = (float)plan->turn[i][j];
        }
    }
    return values;
}

/* May bytes be mixed as they are? */
static int bytes_will_do(const cm_plan *plan, const cm_image *from, cm_filter filter)
{
    const cm_plan_options *options = &plan->options;
    return from->type == CM_PIXEL_U8 && options->transfer == CM_TRANSFER_STORED &&
           (options->alpha == 0 || options->alpha_multiplied) && options->vector == 0 &&
           !options->dither && filter != CM_FILTER_BSPLINE5 && filter != CM_FILTER_EWA;
}

static void choose_sampler(cm_source *source, int is_bytes)
{
    const cm_sample_set *set = source->set;
    switch (source->filter)
    {
    case CM_FILTER_NEAREST:
        source->taps = 1;
        source->sampler = is_bytes ? set->nearest_u8 : set->nearest_float;
        break;
    case CM_FILTER_BILINEAR:
        source->taps = 2;
        source->sampler = is_bytes ? set->bilinear_u8 : set->bilinear_float;
        source->find_places =
            is_bytes && (source->values.working == 3 || source->values.working == 4)
                ? set->places_u8
                : NULL;
        source->apart = set->bilinear_u8_apart;
        break;
    case CM_FILTER_CATMULL_ROM:
    case CM_FILTER_MITCHELL:
        source->taps = 4;
        source->sampler = is_bytes ? set->taps4_u8 : set->taps4_float;
        break;
    default:
        source->taps = 6;
        source->sampler = is_bytes ? set->taps6_u8 : set->taps6_float;
        break;
    }
}

/* Coefficients that are larger wait until a part of a target needs them. */
#define KEPT_AT_ONCE ((size_t)32 << 20)

static cm_status make_spline(cm_source *source, unsigned threads)
{
    const cm_plan *plan = source->plan;
    return cm_spline_make(plan->from, source->pictures, &source->values, source->set,
                          plan->options.memory, threads, &source->coefficients, &source->level);
}

/* Memory of the caller's is asked for at once. */
static cm_status prepare_spline(cm_source *source, const cm_image *from, unsigned threads)
{
    const cm_surface *surface = source->plan->from;
    memcpy(source->pictures, from, surface->pictures * sizeof *from);
    if (source->plan->options.memory != NULL || !cm_spline_stripes_suit(surface) ||
        cm_spline_bytes(surface, &source->values) <= KEPT_AT_ONCE)
    {
        return make_spline(source, threads);
    }
    source->level.channels = source->values.working;
    source->level.pixel_size = source->values.working * sizeof(float);
    atomic_store(&source->state, CM_SOURCE_LATER);
    return CM_OK;
}

cm_status cm_source_complete(const cm_source *source, unsigned threads)
{
    cm_source *own = (cm_source *)(uintptr_t)source; /* they are all made by cm_source_create */
    int state = atomic_load(&own->state);
    while (state != CM_SOURCE_READY)
    {
        state = CM_SOURCE_LATER;
        if (atomic_compare_exchange_strong(&own->state, &state, CM_SOURCE_BUSY))
        {
            const cm_status status = make_spline(own, threads);
            atomic_store(&own->state, status == CM_OK ? CM_SOURCE_READY : CM_SOURCE_LATER);
            return status;
        }
        if (state == CM_SOURCE_BUSY)
        {
            cm_wait_a_while();
        }
    }
    return CM_OK;
}

static cm_status prepare(cm_source *source, const cm_image *from, unsigned threads)
{
    const cm_plan *plan = source->plan;
    const cm_memory *memory = plan->options.memory;
    source->values = cm_values_of(plan, from);
    source->set = cm_sample_set_find(plan->options.instructions);
    source->places = cm_place_set_find(plan->options.instructions);
    if (source->filter == CM_FILTER_AUTO)
    {
        const cm_status status = cm_auto_filter(plan, from, &source->values, source->set,
                                                source->target_type, &source->filter);
        if (status != CM_OK)
        {
            return status;
        }
    }
    const int is_bytes =
        source->target_type == CM_PIXEL_U8 && bytes_will_do(plan, from, source->filter);
    choose_sampler(source, is_bytes);
    if (cm_filter_taps(source->filter) != 0)
    {
        cm_filter_table_fill(source->filter, &source->table);
    }
    if (source->filter == CM_FILTER_BSPLINE5)
    {
        return prepare_spline(source, from, threads);
    }
    if (source->filter == CM_FILTER_EWA)
    {
        cm_filter_table_fill(CM_FILTER_SPLINE36, &source->table);
        source->level.channels = source->values.working;
        source->level.pixel_size = source->values.working * sizeof(float);
        /* what is between bytes as they are, for bytes again, needs no more than 14 bits behind the point */
        const int is_whole = from->type == CM_PIXEL_U8 && source->target_type == CM_PIXEL_U8 &&
                             plan->options.transfer == CM_TRANSFER_STORED &&
                             plan->options.vector == 0;
        return cm_ewa_make(plan, from, &source->values, source->set, &source->table, is_whole,
                           threads, &source->ewa);
    }
    const int32_t reach = source->taps < 2 ? 1 : source->taps / 2;
    return cm_level_of_pictures(plan->from, from, &source->values, source->set, is_bytes, reach,
                                memory, threads, &source->level);
}

cm_status cm_source_create(const cm_plan *plan, const cm_image *from, cm_pixel_type target_type,
                           unsigned threads, cm_source **source)
{
    if (plan == NULL || from == NULL || source == NULL || cm_pixel_size(target_type) == 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_pictures_check(plan->from, from);
    if (status == CM_OK &&
        (plan->options.alpha > from->channels ||
         (plan->options.vector != 0 && plan->options.vector + 2 > from->channels)))
    {
        status = CM_ERROR_RANGE;
    }
    if (status != CM_OK)
    {
        return status;
    }
    void *memory;
    cm_source *made = cm_zeros_in_lines(sizeof *made, &memory);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->memory = memory;
    made->plan = plan;
    made->target_type = target_type;
    atomic_init(&made->state, CM_SOURCE_READY);
    made->filter = plan->options.filter;
    status = prepare(made, from, threads);
    if (status != CM_OK)
    {
        cm_source_destroy(made);
        return status;
    }
    *source = made;
    return CM_OK;
}

void cm_source_destroy(cm_source *source)
{
    if (source != NULL)
    {
        cm_level_free(&source->level);
        cm_padded_free(&source->coefficients);
        cm_ewa_free(&source->ewa);
        free(source->memory);
    }
}

cm_filter cm_source_filter(const cm_source *source)
{
    return source->filter;
}
