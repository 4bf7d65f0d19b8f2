/* SPDX-License-Identifier: MIT
 *
 * Levels and borders as pictures.
 */
#include <cubemap/mips.h>
#include <cubemap/threads.h>

#include "modules/memory/checked_size.h"
#include "pyramid.h"
#include "source.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct cm_mips
{
    uint32_t pictures;
    uint32_t count;
    cm_image *picture; /* those of level 0, of level 1 and so on */
};

/* ---- pictures from planes of floats ---- */

/* Pixels that are put at once. */
#define RUN 256

typedef struct store_job
{
    const cm_padded *padded;
    const cm_surface *layout; /* where planes stand; NULL: one picture each, upright */
    const cm_values *values;
    const cm_image *to;
    int32_t border; /* rows and columns of it that are wanted */
    atomic_int failed;
} store_job;

/* Where in which picture a plane's pixel is, and how far the next of its row is. */
static unsigned char *pixel_of(const store_job *job, unsigned plane, uint32_t column, uint32_t row,
                               uint32_t place[2], ptrdiff_t *step)
{
    const cm_placement upright = {.picture = plane};
    const cm_placement *stand = job->layout != NULL ? &job->layout->placement[plane] : &upright;
    const cm_image *picture = &job->to[stand->picture];
    const ptrdiff_t size = (ptrdiff_t)(picture->channels * cm_pixel_size(picture->type));
    const ptrdiff_t right = picture->pixel_stride != 0 ? picture->pixel_stride : size;
    const ptrdiff_t down = picture->row_stride != 0 ? picture->row_stride : right * picture->width;
    place[0] = column;
    place[1] = row;
    if (job->layout != NULL)
    {
        cm_placement_pixel(job->layout, plane, column, row, &place[0], &place[1]);
    }
    const ptrdiff_t along = stand->turn & CM_TURN_EXCHANGED ? down : right;
    const unsigned back = stand->turn & CM_TURN_EXCHANGED ? CM_TURN_ROWS : CM_TURN_COLUMNS;
    *step = stand->turn & back ? -along : along;
    return (unsigned char *)picture->data + place[1] * down + place[0] * right;
}

static void store_run(const store_job *job, unsigned plane, uint32_t column, uint32_t row,
                      uint32_t count, float *desk)
{
    const cm_padded *padded = job->padded;
    const ptrdiff_t first_row = (ptrdiff_t)row - job->border;
    const ptrdiff_t first_column = (ptrdiff_t)column - job->border;
    const float *from =
        padded->first[plane] + first_row * padded->row + first_column * padded->pixel;
    uint32_t place[2];
    ptrdiff_t step;
    unsigned char *to = pixel_of(job, plane, column, row, place, &step);
    for (uint32_t i = 0; i < count; i++)
    {
        for (uint32_t c = 0; c < padded->channels; c++)
        {
            desk[(size_t)i * padded->channels + c] =
                from[(ptrdiff_t)i * padded->pixel + c * padded->channel];
        }
    }
    cm_values_store(job->values, desk, count, place[0], place[1], to, step);
}

static void store_rows(size_t begin, size_t end, void *user)
{
    store_job *job = user;
    const cm_padded *padded = job->padded;
    const uint32_t wide = padded->width + 2 * (uint32_t)job->border;
    const uint32_t high = padded->height + 2 * (uint32_t)job->border;
    float *desk = cm_array_of(RUN * padded->channels, sizeof(float));
    if (desk == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    for (size_t at = begin; at < end; at++)
    {
        for (uint32_t column = 0; column < wide; column += RUN)
        {
            store_run(job, (unsigned)(at / high), column, (uint32_t)(at % high),
                      wide - column < RUN ? wide - column : RUN, desk);
        }
    }
    free(desk);
}

static cm_status store(store_job *job, unsigned threads)
{
    const size_t high = job->padded->height + 2 * (size_t)job->border;
    atomic_init(&job->failed, CM_OK);
    cm_run_threads(threads, job->padded->planes * high, 64, store_rows, job);
    return (cm_status)atomic_load(&job->failed);
}

/* ---- levels ---- */

/* Places of the planes of a level, and the size of its pictures. */
static cm_surface layout_of(const cm_surface *surface, uint32_t width, uint32_t height)
{
    cm_surface layout = *surface;
    layout.width = width;
    layout.height = height;
    for (unsigned plane = 0; plane < surface->planes; plane++)
    {
        cm_placement *place = &layout.placement[plane];
        const int exchanged = (place->turn & CM_TURN_EXCHANGED) != 0;
        const uint64_t old_width = exchanged ? surface->height : surface->width;
        const uint64_t old_height = exchanged ? surface->width : surface->height;
        place->column =
            (uint32_t)(place->column * (uint64_t)(exchanged ? height : width) / old_width);
        place->row = (uint32_t)(place->row * (uint64_t)(exchanged ? width : height) / old_height);
    }
    /* as many planes beside and above one another as before, whole ones */
    const uint32_t columns = (surface->picture_width + surface->width - 1) / surface->width;
    const uint32_t rows = (surface->picture_height + surface->height - 1) / surface->height;
    layout.picture_width = columns * width;
    layout.picture_height = rows * height;
    return layout;
}

static cm_status make_pictures(const cm_image *given, const cm_surface *layout, cm_image *picture)
{
    for (uint32_t i = 0; i < layout->pictures; i++)
    {
        picture[i] = (cm_image){.size = sizeof(cm_image),
                                .type = given->type,
                                .width = layout->picture_width,
                                .height = layout->picture_height,
                                .channels = given->channels};
        picture[i].data = calloc((size_t)layout->picture_width * layout->picture_height,
                                 given->channels * cm_pixel_size(given->type));
        if (picture[i].data == NULL)
        {
            return CM_ERROR_MEMORY;
        }
    }
    return CM_OK;
}

static cm_status fill(const cm_surface *surface, const cm_image *pictures, const cm_values *values,
                      const cm_sample_set *set, const cm_memory *memory, unsigned threads,
                      cm_mips *mips)
{
    cm_pyramid pyramid;
    cm_status status = cm_pyramid_make(surface, pictures, values, set, CM_PYRAMID_HALVES, 0, 0,
                                       mips->count, memory, threads, &pyramid);
    if (status != CM_OK)
    {
        return status;
    }
    for (uint32_t k = 1; k < mips->count && status == CM_OK; k++)
    {
        const cm_padded *level = &pyramid.level[k];
        cm_image *picture = mips->picture + (size_t)k * mips->pictures;
        const cm_surface layout = layout_of(surface, level->width, level->height);
        status = make_pictures(pictures, &layout, picture);
        store_job job = {.padded = level, .layout = &layout, .values = values, .to = picture};
        status = status == CM_OK ? store(&job, threads) : status;
    }
    cm_pyramid_free(&pyramid);
    return status;
}

/* What values are, by a plan from the surface to itself. */
static cm_status values_of(const cm_surface *surface, const cm_image *pictures,
                           const cm_plan_options *options, cm_values *values,
                           const cm_sample_set **set)
{
    cm_plan *plan;
    cm_plan_options wish = {.size = sizeof wish};
    if (options != NULL)
    {
        wish = *options;
        wish.filter = CM_FILTER_NEAREST;
        wish.vector = 0;
        wish.tolerance = 0.0;
        wish.pixels_most = 0.0;
    }
    cm_status status = cm_pictures_check(surface, pictures);
    if (status != CM_OK)
    {
        return status;
    }
    if (wish.alpha > pictures->channels)
    {
        return CM_ERROR_RANGE;
    }
    status = cm_plan_create(surface, surface, &wish, &plan);
    if (status == CM_OK)
    {
        *values = cm_values_of(plan, pictures);
        *set = cm_sample_set_find(wish.instructions);
        cm_plan_destroy(plan);
    }
    return status;
}

cm_status cm_mips_create(const cm_surface *surface, const cm_image *pictures,
                         const cm_plan_options *options, unsigned threads, cm_mips **mips)
{
    cm_values values;
    const cm_sample_set *set;
    cm_level_size sizes[CM_LEVELS_MAX];
    if (surface == NULL || pictures == NULL || mips == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = values_of(surface, pictures, options, &values, &set);
    if (status != CM_OK)
    {
        return status;
    }
    cm_mips *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const cm_memory *memory = options == NULL ? NULL : options->memory;
    made->pictures = surface->pictures;
    made->count = cm_pyramid_sizes(CM_PYRAMID_HALVES, surface->width, surface->height, sizes);
    made->picture = calloc((size_t)made->count * made->pictures, sizeof *made->picture);
    status = CM_ERROR_MEMORY;
    if (made->picture != NULL)
    {
        memcpy(made->picture, pictures, made->pictures * sizeof *pictures);
        status =
            made->count > 1 ? fill(surface, pictures, &values, set, memory, threads, made) : CM_OK;
    }
    if (status != CM_OK)
    {
        cm_mips_destroy(made);
        return status;
    }
    *mips = made;
    return CM_OK;
}

void cm_mips_destroy(cm_mips *mips)
{
    if (mips == NULL)
    {
        return;
    }
    for (size_t i = mips->pictures;
         mips->picture != NULL && i < (size_t)mips->count * mips->pictures; i++)
    {
        free(mips->picture[i].data);
    }
    free(mips->picture);
    free(mips);
}

uint32_t cm_mips_count(const cm_mips *mips)
{
    return mips->count;
}

const cm_image *cm_mips_pictures(const cm_mips *mips, uint32_t level)
{
    return level < mips->count ? mips->picture + (size_t)level * mips->pictures : NULL;
}

/* ---- borders ---- */

static cm_status check_targets(const cm_surface *surface, const cm_image *pictures, uint32_t border,
                               const cm_image *to)
{
    for (uint32_t plane = 0; plane < surface->planes; plane++)
    {
        if (to[plane].size != sizeof *to || to[plane].data == NULL ||
            cm_pixel_size(to[plane].type) == 0)
        {
            return CM_ERROR_ARGUMENT;
        }
        if (to[plane].width != surface->width + 2 * border ||
            to[plane].height != surface->height + 2 * border ||
            to[plane].channels != pictures->channels || to[plane].type != to->type)
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

cm_status cm_border(const cm_surface *surface, const cm_image *pictures, uint32_t border,
                    const cm_plan_options *options, unsigned threads, cm_image *to)
{
    cm_values values;
    const cm_sample_set *set;
    if (surface == NULL || pictures == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = values_of(surface, pictures, options, &values, &set);
    status = status == CM_OK && border > CM_BORDER_MOST ? CM_ERROR_RANGE : status;
    status = status == CM_OK ? check_targets(surface, pictures, border, to) : status;
    if (status != CM_OK)
    {
        return status;
    }
    cm_padded padded;
    status = cm_padded_create(surface, surface->width, surface->height, values.working,
                              (int32_t)border, (int32_t)border, CM_PADDED_PIXELS,
                              options == NULL ? NULL : options->memory, threads, &padded);
    if (status == CM_OK && (padded.beside < (int32_t)border || padded.beyond < (int32_t)border))
    {
        status = CM_ERROR_RANGE;
    }
    else if (status == CM_OK)
    {
        status = cm_padded_load(&padded, surface, pictures, &values, set, threads, 0.0f, NULL);
    }
    if (status == CM_OK)
    {
        values.type = to->type;
        store_job job = {.padded = &padded, .values = &values, .to = to, .border = (int32_t)border};
        status = store(&job, threads);
    }
    cm_padded_free(&padded);
    return status;
}
