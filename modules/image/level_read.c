/* SPDX-License-Identifier: MIT
 *
 * Rows of a level as floats.
 */
#include "level_object.h"

#include <string.h>

/* What makes floats of numbers that are mixed as they are stored; NULL for floats, and for what is more than that. */
static cm_converter *converter_of(const cm_values *values, const cm_sample_set *set, float *scale)
{
    const int is_whole = values->type == CM_PIXEL_U8 || values->type == CM_PIXEL_U16;
    *scale = values->type == CM_PIXEL_U8    ? 1.0f / 255.0f
             : values->type == CM_PIXEL_U16 ? 1.0f / 65535.0f
                                            : 1.0f;
    if (values->transfer != CM_TRANSFER_STORED ||
        (values->alpha != 0 && !values->alpha_multiplied) ||
        (!is_whole && values->not_finite != CM_NOT_FINITE_SPREAD))
    {
        return NULL;
    }
    return values->type == CM_PIXEL_U8     ? set->u8_to_float
           : values->type == CM_PIXEL_U16  ? set->u16_to_float
           : values->type == CM_PIXEL_HALF ? set->half_to_float
                                           : NULL;
}

cm_level_reader cm_level_reader_of(const cm_level *level, const cm_surface *surface,
                                   const cm_sample_set *set)
{
    cm_level_reader reader = {.level = level};
    reader.convert = level->gaps == NULL ? converter_of(level->values, set, &reader.scale) : NULL;
    reader.period = surface->period == (double)level->width ? (int32_t)level->width : 0;
    return reader;
}

/* Pixels that are all inside, or all beyond the same edge. */
static void read_run(const cm_level_reader *reader, unsigned plane, int32_t column, int32_t row,
                     int32_t count, float *to)
{
    const cm_level *level = reader->level;
    const cm_level_plane *from = &level->plane[plane];
    const size_t dense = level->channels * cm_pixel_size(level->values->type);
    const int is_inside =
        row >= 0 && row < (int32_t)level->height && column >= 0 && column < (int32_t)level->width;
    if (reader->convert != NULL && is_inside && from->pixel_stride == (ptrdiff_t)dense)
    {
        reader->convert((size_t)count * level->channels,
                        from->pixels + row * from->row_stride + column * from->pixel_stride,
                        reader->scale, to);
        return;
    }
    cm_level_row(level, plane, column, row, count, (unsigned char *)to);
}

void cm_level_read(const cm_level_reader *reader, unsigned plane, int32_t column, int32_t row,
                   int32_t count, float *to)
{
    const int32_t width = (int32_t)reader->level->width;
    while (count > 0)
    {
        const int32_t turns = reader->period == 0 ? 0
                              : column < 0        ? (column + 1) / width - 1
                                                  : column / width;
        const int32_t at = column - turns * width;
        const int32_t most = at < 0 ? -at : at < width ? width - at : count;
        const int32_t n = count < most ? count : most;
        read_run(reader, plane, at, row, n, to);
        to += (size_t)n * reader->level->channels;
        column += n;
        count -= n;
    }
}
