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
    if (!cm_values_are_stored(values) || (!is_whole && values->not_finite != CM_NOT_FINITE_SPREAD))
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

/* A run of pixels that are all inside, or all beyond the same edge, to `to`. */
typedef struct read_run
{
    const cm_level_reader *reader;
    unsigned plane;
    int32_t column;
    int32_t row;
    int32_t count;
} read_run;

/* The run's numbers as they are stored, if reader->convert may have them; else NULL. */
static const void *stored_run(const read_run *run)
{
    const cm_level *level = run->reader->level;
    const cm_level_plane *from = &level->plane[run->plane];
    const size_t dense = level->channels * cm_pixel_size(level->values->type);
    const int is_inside = run->row >= 0 && run->row < (int32_t)level->height && run->column >= 0 &&
                          run->column < (int32_t)level->width;
    return run->reader->convert != NULL && is_inside && from->pixel_stride == (ptrdiff_t)dense
               ? from->pixels + run->row * from->row_stride + run->column * from->pixel_stride
               : NULL;
}

const void *cm_level_stored(const cm_level_reader *reader, unsigned plane, int32_t column,
                            int32_t row, int32_t count)
{
    const read_run run = {reader, plane, column, row, count};
    const int is_inside = column + count <= (int32_t)reader->level->width;
    return is_inside ? stored_run(&run) : NULL;
}

/* The first run of pixels of a row; returns how many there are. */
static int32_t begin_run(const cm_level_reader *reader, unsigned plane, int32_t column, int32_t row,
                         int32_t count, read_run *run)
{
    const int32_t width = (int32_t)reader->level->width;
    const int32_t turns = reader->period == 0 ? 0
                          : column < 0        ? (column + 1) / width - 1
                                              : column / width;
    const int32_t at = column - turns * width;
    const int32_t most = at < 0 ? -at : at < width ? width - at : count;
    *run = (read_run){reader, plane, at, row, count < most ? count : most};
    return run->count;
}

static void read_floats(const read_run *run, float *to)
{
    const cm_level_reader *reader = run->reader;
    const void *stored = stored_run(run);
    if (stored != NULL)
    {
        reader->convert((size_t)run->count * reader->level->channels, stored, reader->scale, to);
        return;
    }
    cm_level_row(reader->level, run->plane, run->column, run->row, run->count, (unsigned char *)to);
}

void cm_level_read(const cm_level_reader *reader, unsigned plane, int32_t column, int32_t row,
                   int32_t count, float *to)
{
    while (count > 0)
    {
        read_run run;
        const int32_t n = begin_run(reader, plane, column, row, count, &run);
        read_floats(&run, to);
        to += (size_t)n * reader->level->channels;
        column += n;
        count -= n;
    }
}

void cm_level_read_whole(const cm_level_reader *reader, const cm_filter_set *set, unsigned plane,
                         int32_t column, int32_t row, int32_t count, float one, float *desk,
                         int16_t *to)
{
    while (count > 0)
    {
        read_run run;
        const int32_t n = begin_run(reader, plane, column, row, count, &run);
        const size_t numbers = (size_t)n * reader->level->channels;
        const void *stored = stored_run(&run);
        if (stored != NULL && reader->level->values->type == CM_PIXEL_U8)
        {
            set->whole_of_bytes(numbers, stored, to);
        }
        else
        {
            read_floats(&run, desk);
            set->to_whole(numbers, desk, one, to);
        }
        to += numbers;
        column += n;
        count -= n;
    }
}
