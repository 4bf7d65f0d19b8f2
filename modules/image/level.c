/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "level_rim.h"

#include <stdlib.h>
#include <string.h>

/* ---- windows ---- */

/* Bytes of a plane's skirt: rows above and below as wide as the plane with both ends, columns as high as it. */
static size_t skirt_size(const cm_level *level)
{
    const size_t reach = (size_t)level->reach;
    return cm_size_product(level->pixel_size * 2 * reach, level->width + 2 * reach + level->height);
}

unsigned char *cm_level_skirt_pixel(const cm_level *level, unsigned plane, int32_t column,
                                    int32_t row)
{
    const size_t reach = (size_t)level->reach;
    const size_t wide = level->width + 2 * reach;
    const size_t right = (size_t)(column + level->reach);
    size_t index;
    if (row < 0)
    {
        index = (size_t)(row + level->reach) * wide + right;
    }
    else if (row >= (int32_t)level->height)
    {
        index = (reach + (size_t)row - level->height) * wide + right;
    }
    else
    {
        const size_t before = 2 * reach * wide + (column < 0 ? 0 : reach * level->height);
        index = before + (size_t)row * reach + (column < 0 ? right : (size_t)column - level->width);
    }
    return level->plane[plane].skirt + index * level->pixel_size;
}

void cm_level_load(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t count, unsigned char *to)
{
    const cm_level_plane *from = &level->plane[plane];
    const unsigned char *pixel =
        from->pixels + row * from->row_stride + column * from->pixel_stride;
    if (!level->is_plain)
    {
        cm_values_load(level->values, pixel, from->pixel_stride, (size_t)count,
                       (float *)(void *)to);
    }
    else if (from->pixel_stride == (ptrdiff_t)level->pixel_size)
    {
        memcpy(to, pixel, (size_t)count * level->pixel_size);
    }
    else
    {
        for (int32_t i = 0; i < count; i++)
        {
            memcpy(to + (size_t)i * level->pixel_size, pixel + i * from->pixel_stride,
                   level->pixel_size);
        }
    }
}

void cm_level_row(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t width,
                  unsigned char *to)
{
    const int32_t right = (int32_t)level->width;
    if (row < 0 || row >= (int32_t)level->height)
    {
        memcpy(to, cm_level_skirt_pixel(level, plane, column, row),
               (size_t)width * level->pixel_size);
        return;
    }
    const int32_t end = column + width;
    int32_t at = column;
    while (at < end)
    {
        const int inside = at >= 0 && at < right;
        const int32_t count = (at < 0   ? cm_level_least(end, 0)
                               : inside ? cm_level_least(end, right)
                                        : end) -
                              at;
        unsigned char *here = to + (size_t)(at - column) * level->pixel_size;
        if (inside)
        {
            cm_level_load(level, plane, at, row, count, here);
            if (level->gaps != NULL)
            {
                cm_gaps_put(level, plane, at, row, count, here);
            }
        }
        else
        {
            memcpy(here, cm_level_skirt_pixel(level, plane, at, row),
                   (size_t)count * level->pixel_size);
        }
        at += count;
    }
}

int cm_level_there(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                   int32_t width, int32_t height)
{
    const cm_level_plane *from = &level->plane[plane];
    const int32_t reach = from->skirt == NULL ? level->reach : 0;
    if (!level->is_plain || from->pixel_stride != (ptrdiff_t)level->pixel_size || column < -reach ||
        row < -reach || column + width > (int32_t)level->width + reach ||
        row + height > (int32_t)level->height + reach)
    {
        return 0;
    }
    if (level->gaps != NULL && cm_gaps_touch(level, plane, column, row, width, height))
    {
        return 0;
    }
    const int32_t lowest = from->row_stride < 0 ? row : row + height - 1;
    const unsigned char *last =
        from->pixels + lowest * from->row_stride + (column + width) * from->pixel_stride;
    return from->end - last >= CM_WINDOW_SLACK;
}

void cm_level_own(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                  cm_window *window)
{
    const cm_level_plane *from = &level->plane[plane];
    window->data = from->pixels + row * from->row_stride + column * from->pixel_stride;
    window->row_stride = from->row_stride;
    window->channels = level->channels;
}

cm_status cm_scratch_room(cm_scratch *scratch, size_t size)
{
    if (size > scratch->size)
    {
        unsigned char *bytes = malloc(size);
        if (bytes == NULL)
        {
            return CM_ERROR_MEMORY;
        }
        free(scratch->bytes);
        scratch->bytes = bytes;
        scratch->size = size;
        memset(bytes, 0, size);
    }
    return CM_OK;
}

cm_status cm_level_window(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                          int32_t width, int32_t height, cm_scratch *scratch, cm_window *window)
{
    window->channels = level->channels;
    if (cm_level_there(level, plane, column, row, width, height))
    {
        cm_level_own(level, plane, column, row, window);
        return CM_OK;
    }
    const size_t stride = ((size_t)width * level->pixel_size + CM_WINDOW_SLACK + 63) / 64 * 64;
    const cm_status status = cm_scratch_room(scratch, stride * (size_t)height);
    for (int32_t i = 0; status == CM_OK && i < height; i++)
    {
        cm_level_row(level, plane, column, row + i, width, scratch->bytes + (size_t)i * stride);
    }
    window->data = scratch->bytes;
    window->row_stride = (ptrdiff_t)stride;
    return status;
}

/* ---- life ---- */

static void lay_plane(cm_level *level, const cm_surface *surface, const cm_image *pictures,
                      unsigned plane)
{
    const cm_placement *place = &surface->placement[plane];
    const cm_image *picture = &pictures[place->picture];
    const ptrdiff_t pixel = picture->pixel_stride != 0
                                ? picture->pixel_stride
                                : (ptrdiff_t)(picture->channels * cm_pixel_size(picture->type));
    const ptrdiff_t row = picture->row_stride != 0 ? picture->row_stride : pixel * picture->width;
    uint32_t column, first_row;
    cm_level_plane *to = &level->plane[plane];
    cm_placement_pixel(surface, plane, 0, 0, &column, &first_row);
    to->pixels = (const unsigned char *)picture->data + first_row * row + column * pixel;
    const int exchanged = (place->turn & CM_TURN_EXCHANGED) != 0;
    const ptrdiff_t right = place->turn & CM_TURN_COLUMNS ? -pixel : pixel;
    const ptrdiff_t down = place->turn & CM_TURN_ROWS ? -row : row;
    to->pixel_stride = exchanged ? down : right;
    to->row_stride = exchanged ? right : down;
    const ptrdiff_t lowest = row < 0 ? 0 : row * (ptrdiff_t)(picture->height - 1);
    to->end = (const unsigned char *)picture->data + lowest + pixel * picture->width;
}

cm_status cm_level_of_pictures(const cm_surface *surface, const cm_image *pictures,
                               const cm_values *values, const cm_sample_set *set, int is_bytes,
                               int32_t reach, const cm_memory *memory, unsigned threads,
                               cm_level *level)
{
    memset(level, 0, sizeof *level);
    level->values = values;
    level->set = set;
    level->planes = surface->planes;
    level->width = surface->width;
    level->height = surface->height;
    level->channels = values->working;
    level->is_bytes = is_bytes;
    level->pixel_size = values->working * (is_bytes ? 1 : sizeof(float));
    level->is_stored = 1;
    level->is_plain = is_bytes || cm_values_are_plain(values);
    level->reach = reach;
    for (unsigned plane = 0; plane < level->planes; plane++)
    {
        lay_plane(level, surface, pictures, plane);
        level->plane[plane].skirt = malloc(cm_size_sum(skirt_size(level), CM_WINDOW_SLACK));
        if (level->plane[plane].skirt == NULL)
        {
            cm_level_free(level);
            return CM_ERROR_MEMORY;
        }
    }
    const cm_status status =
        surface->has_gaps ? cm_gaps_create(level, surface, threads, &level->gaps) : CM_OK;
    if (status != CM_OK)
    {
        cm_level_free(level);
        return status;
    }
    if (reach > 0)
    {
        cm_level_fill_skirt(level, surface, memory, threads);
    }
    return CM_OK;
}

void cm_level_free(cm_level *level)
{
    cm_gaps_free(level->gaps);
    level->gaps = NULL;
    for (unsigned plane = 0; plane < level->planes; plane++)
    {
        free(level->plane[plane].skirt);
        level->plane[plane].skirt = NULL;
    }
}
