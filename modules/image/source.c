/* SPDX-License-Identifier: MIT
 *
 * A source made ready for a filter.
 */
#include "source.h"
#include "auto.h"
#include "spline.h"

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
        return cm_spline_make(plan->from, from, &source->values, source->set, memory, threads,
                              &source->coefficients, &source->level);
    }
    if (source->filter == CM_FILTER_EWA)
    {
        cm_filter_table_fill(CM_FILTER_SPLINE36, &source->table);
        source->level.channels = source->values.working;
        source->level.pixel_size = source->values.working * sizeof(float);
        /* what is between bytes as they are, for bytes again, needs no more than 14 bits behind the point */
        const int is_whole = from->type == CM_PIXEL_U8 && source->target_type == CM_PIXEL_U8 &&
                             plan->options.transfer == CM_TRANSFER_STORED;
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
    cm_source *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->plan = plan;
    made->target_type = target_type;
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
        free(source);
    }
}

cm_filter cm_source_filter(const cm_source *source)
{
    return source->filter;
}
