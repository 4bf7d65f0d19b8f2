/* SPDX-License-Identifier: MIT */
#include "ewa_window.h"
#include "fetch.h"

#include <string.h>

/* So many rows further down memory is asked for: rows of a window lie far from one another. */
#define FETCHED 8

/* Bytes that come from memory together. */
#define LINE 64

/* Vectors read so many numbers behind the box, which must not be infinite. */
#define BEHIND 8

/* A window under way. */
typedef struct window_desk
{
    const cm_ewa_level *at;
    const cm_ewa_box *box;
    size_t width;
    size_t height;
    size_t line;   /* floats of a channel of a row */
    float *window; /* its first number */
} window_desk;

static void fetch_bytes(const char *from, size_t n)
{
    for (size_t i = 0; i < n; i += LINE)
    {
        CM_FETCH(from + i);
    }
}

static void clear_behind(const window_desk *desk, float *to)
{
    for (size_t c = 0; c < desk->at->ewa->pyramid.pictures.channels; c++)
    {
        memset(to + c * desk->line + desk->width, 0, BEHIND * sizeof *to);
    }
}

/* Rows of whole numbers. Behind each there are zeros, or other numbers of the level. */
static void read_whole(const window_desk *desk)
{
    const cm_ewa_level *at = desk->at;
    const cm_padded *level = &at->ewa->pyramid.level[at->level];
    const ptrdiff_t first = (at->row + desk->box->top) * level->row + at->column + desk->box->left;
    const size_t lines = level->channels;
    float *to = desk->window;
    for (size_t row = 0; row < desk->height; row++)
    {
        const int16_t *from = level->whole[at->plane] + first + (ptrdiff_t)row * level->row;
        for (size_t c = 0; c < lines; c++, from += level->channel, to += desk->line)
        {
            if (row + FETCHED < desk->height)
            {
                fetch_bytes((const char *)(from + FETCHED * level->row),
                            desk->width * sizeof *from);
            }
            at->ewa->set->from_whole(desk->line, from, CM_PADDED_ONE, to);
        }
    }
}

/* Rows of bytes that mean what is stored, all of them inside the plane. 0 if they are not. */
static int read_bytes(const window_desk *desk)
{
    const cm_ewa_level *at = desk->at;
    const cm_level_reader *reader = &at->ewa->pyramid.reader;
    const size_t channels = reader->level->channels;
    const int32_t left = at->column + desk->box->left, width = (int32_t)desk->width;
    const uint8_t *first =
        cm_level_stored(reader, at->plane, left, at->row + desk->box->top, width);
    const uint8_t *last =
        cm_level_stored(reader, at->plane, left, at->row + desk->box->bottom, width);
    if (reader->level->values->type != CM_PIXEL_U8 || first == NULL || last == NULL)
    {
        return 0;
    }
    const ptrdiff_t stride = reader->level->plane[at->plane].row_stride;
    float *to = desk->window;
    for (size_t row = 0; row < desk->height; row++, to += desk->line * channels)
    {
        const uint8_t *from = first + (ptrdiff_t)row * stride;
        if (row + FETCHED < desk->height)
        {
            fetch_bytes((const char *)(from + FETCHED * stride), desk->width * channels);
        }
        at->ewa->set->part_bytes(from, channels, desk->width, reader->scale, to,
                                 (ptrdiff_t)desk->line);
        clear_behind(desk, to);
    }
    return 1;
}

/* Rows of pictures, whatever they are. */
static void read_pictures(const window_desk *desk, float *run)
{
    const cm_ewa_level *at = desk->at;
    const cm_level_reader *reader = &at->ewa->pyramid.reader;
    const size_t channels = reader->level->channels;
    float *to = desk->window;
    for (int32_t row = desk->box->top; row <= desk->box->bottom; row++, to += desk->line * channels)
    {
        cm_level_read(reader, at->plane, at->column + desk->box->left, at->row + row,
                      (int32_t)desk->width, run);
        at->ewa->set->part_channels(run, channels, desk->width, to, (ptrdiff_t)desk->line);
        clear_behind(desk, to);
    }
}

cm_status cm_ewa_window(const cm_ewa_level *at, const cm_ewa_box *box, cm_scratch *scratch,
                        cm_ewa_pixels *pixels)
{
    const size_t channels = at->ewa->pyramid.pictures.channels;
    window_desk desk = {.at = at,
                        .box = box,
                        .width = (size_t)(box->right - box->left + 1),
                        .height = (size_t)(box->bottom - box->top + 1)};
    desk.line = (desk.width + (at->level > 0 ? 0 : BEHIND) + 15) / 16 * 16;
    const cm_status status = cm_scratch_room(
        scratch, (desk.height + 1) * desk.line * channels * sizeof(float) + CM_WINDOW_SLACK);
    if (status != CM_OK)
    {
        return status;
    }
    desk.window = (float *)(void *)scratch->bytes;
    if (at->level > 0)
    {
        read_whole(&desk);
    }
    else if (!read_bytes(&desk))
    {
        read_pictures(&desk, desk.window + desk.height * desk.line * channels);
    }
    pixels->row = (ptrdiff_t)(desk.line * channels);
    pixels->channel = (ptrdiff_t)desk.line;
    pixels->channels = channels;
    pixels->first = desk.window - box->top * pixels->row - box->left;
    return CM_OK;
}

/* ---- before it is needed ---- */

/* Where a level's pixels lie, in bytes. */
typedef struct level_memory
{
    const char *first;
    ptrdiff_t row;
    ptrdiff_t pixel;
    ptrdiff_t line; /* from channel to channel of those that are apart */
    size_t lines;
} level_memory;

static level_memory memory_of(const cm_ewa *ewa, unsigned k, unsigned plane)
{
    const cm_level_plane *pictures = &ewa->pyramid.pictures.plane[plane];
    const cm_padded *level = &ewa->pyramid.level[k];
    const ptrdiff_t size = ewa->pyramid.is_whole ? sizeof(int16_t) : sizeof(float);
    if (k == 0)
    {
        return (level_memory){(const char *)pictures->pixels, pictures->row_stride,
                              pictures->pixel_stride, 0, 1};
    }
    return (level_memory){ewa->pyramid.is_whole ? (const char *)level->whole[plane]
                                                : (const char *)level->first[plane],
                          level->row * size, level->pixel * size, level->channel * size,
                          level->channels};
}

/* Rows of a level that a row of pixels has for itself, or nearly so. */
#define FETCHED_ROWS 3

/* Of every fourth pixel, on the level that the one in the middle wants. */
void cm_ewa_fetch(const cm_ewa *ewa, const cm_group *group)
{
    cm_ewa_axes axes;
    const unsigned middle = group->count / 2;
    if (!group->is_bounded)
    {
        return;
    }
    ewa->set->ewa_axes(1, group->by_column[0] + middle, group->by_column[1] + middle,
                       group->by_row[0] + middle, group->by_row[1] + middle, ewa->least,
                       ewa->pyramid.count, &axes);
    const unsigned k = (unsigned)axes.level[0];
    if (atomic_load(&ewa->pyramid.made) <= k)
    {
        return;
    }
    const level_memory level = memory_of(ewa, k, group->plane);
    const float across = (float)ewa->width[k] / (float)ewa->width[0];
    const float down = (float)ewa->height[k] / (float)ewa->height[0];
    const float x = (float)group->column * across, y = (float)group->row * down;
    for (unsigned i = 2; i < group->count; i += 4)
    {
        const char *at = level.first + (int32_t)(y + group->y[i] * down) * level.row +
                         (int32_t)(x + group->x[i] * across) * level.pixel;
        for (size_t c = 0; c < level.lines; c++, at += level.line)
        {
            for (ptrdiff_t row = 0; row < FETCHED_ROWS; row++)
            {
                CM_FETCH(at + row * level.row);
            }
        }
    }
}
